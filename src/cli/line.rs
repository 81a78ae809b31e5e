//! The line and its slopes as `build` and `sample` take them: arguments, and what is checked of them.

use super::help;
use super::number::Rule;
use super::usage::{Checks, placed};
use crate::formation::{Crossfall, Formation};
use crate::model::{Sheet, Slope};
use crate::pipeline::LineInput;
use crate::read::{InputFormat, Pick, ReadOptions};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// The narrowest road, in the length unit: the sides of a narrower one are one among the errors of coordinates.
const LEAST_WIDTH: f64 = 0.001;

/// How far breaklines may miss rings where no tolerance is given, in the length unit: the default of `--tolerance`.
const DEFAULT_TOLERANCE: f64 = 0.01;

/// Part of the tolerance that rounded corners of roads may use: a third.
pub(super) const CHORDS: f64 = 3.0;

#[derive(Debug, Args)]
pub(super) struct InputArgs {
    /// The line: .geojson, .json, .csv, .txt, .tsv, .xyz, .xml (LandXML) or .dxf; - is standard input. For `build` also a job
    /// file, .toml
    #[arg(value_name = "INPUT")]
    pub(super) input: PathBuf,
    /// Format of the input [default: by its extension]
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = help::INPUT)]
    pub(super) input_format: Option<FormatArg>,
    /// Columns of a text file without a header, such as xyz or pnezd
    ///
    /// x or e easting, y or n northing, z elevation, l line id, p point number, d description, _ a column to skip.
    #[arg(long, value_name = "ORDER", help_heading = help::INPUT)]
    pub(super) csv_order: Option<String>,
    /// Use only the lines of this name, where a file has several; may be repeated
    #[arg(long, value_name = "NAME", help_heading = help::INPUT)]
    pub(super) feature: Vec<String>,
    /// Use only the lines on this layer of a drawing; may be repeated [default: all that are on]
    #[arg(long, value_name = "NAME", help_heading = help::INPUT)]
    pub(super) layer: Vec<String>,
    /// Unit of the figures, and of files that declare none: m, ft (0.3048 m) or us-ft (1200/3937 m) [default: that of the line,
    /// else m]
    #[arg(long, value_name = "UNIT", help_heading = help::INPUT)]
    pub(super) units: Option<String>,
    /// Make rings of lines that do not end where they begin
    #[arg(long, help_heading = help::INPUT)]
    pub(super) closed: bool,
    /// Make roads of this width about open lines; platform and slopes are built from their edges
    #[arg(long, value_name = "W", allow_negative_numbers = true, help_heading = help::INPUT)]
    pub(super) width: Option<String>,
    /// Fall from the centre line of roads to their edges: 2.5%, 1:40, or LEFT,RIGHT such as 2.5%,-2.5%
    #[arg(long, value_name = "C", requires = "width", allow_hyphen_values = true, help_heading = help::INPUT)]
    pub(super) crossfall: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct SlopeArgs {
    /// The side slope: 1:1.5, 2H:1V, 1in2, 50% or 26.57deg
    #[arg(short, long, value_name = "S", allow_hyphen_values = true, help_heading = help::SURFACE)]
    pub(super) slope: Option<String>,
    /// Slope of surfaces that rise from the line, instead of --slope
    #[arg(long, value_name = "S", allow_hyphen_values = true, help_heading = help::SURFACE)]
    pub(super) cut_slope: Option<String>,
    /// Slope of surfaces that fall from the line, instead of --slope
    #[arg(long, value_name = "S", allow_hyphen_values = true, help_heading = help::SURFACE)]
    pub(super) fill_slope: Option<String>,
    /// Whether the surface falls from the line (fill), rises (cut), or does what the ground asks for [default: auto with
    /// --terrain, else down]
    #[arg(long, value_enum, help_heading = help::SURFACE)]
    pub(super) direction: Option<DirectionArg>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DirectionArg {
    Down,
    Up,
    Auto,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FormatArg {
    Geojson,
    Csv,
    Landxml,
    Dxf,
}

impl FormatArg {
    fn format(self) -> InputFormat {
        match self {
            Self::Geojson => InputFormat::GeoJson,
            Self::Csv => InputFormat::Csv,
            Self::Landxml => InputFormat::LandXml,
            Self::Dxf => InputFormat::Dxf,
        }
    }
}

impl SlopeArgs {
    /// Which way the surface goes.
    fn direction(&self, on_ground: bool) -> DirectionArg {
        self.direction.unwrap_or(if on_ground { DirectionArg::Auto } else { DirectionArg::Down })
    }

    /// The slopes that are given and have no surface: of a sheet that is not built, or `--slope` where all sheets have their own.
    fn idle(&self, on_ground: bool) -> Vec<&'static str> {
        let direction = self.direction(on_ground);
        let [falls, rises] = [direction != DirectionArg::Up, direction != DirectionArg::Down];
        let [cut, fill] = [self.cut_slope.is_some(), self.fill_slope.is_some()];
        let idle = [
            (SLOPE, self.slope.is_some() && (!falls || fill) && (!rises || cut)),
            (CUT_SLOPE, cut && !rises),
            (FILL_SLOPE, fill && !falls),
        ];
        idle.into_iter().filter(|(_, idle)| *idle).map(|(name, _)| name).collect()
    }

    /// Slopes from a job file give way to what was typed in: all to a `--slope`, and those without a surface to whatever changes what
    /// surfaces there are, or gives them slopes. `typed`: whether an argument was typed in. Returns the options that are gone.
    pub(super) fn give_way(&mut self, on_ground: bool, typed: impl Fn(&str) -> bool) -> Vec<&'static str> {
        let changes = ["slope", "cut_slope", "fill_slope", "direction", "terrain"].into_iter().any(&typed);
        let own = [CUT_SLOPE, FILL_SLOPE].into_iter().filter(|_| typed("slope"));
        let mut gone: Vec<&'static str> = own.collect();
        gone.extend(self.idle(on_ground).into_iter().filter(|_| changes));
        let id = |name: &str| name.replace('-', "_");
        gone.retain(|name| !typed(&id(name)));
        for name in &gone {
            match *name {
                CUT_SLOPE => self.cut_slope = None,
                FILL_SLOPE => self.fill_slope = None,
                _ => self.slope = None,
            }
        }
        gone
    }
}

/// Names of the options that give slopes.
const SLOPE: &str = "slope";
const CUT_SLOPE: &str = "cut-slope";
const FILL_SLOPE: &str = "fill-slope";

impl Checks {
    /// The slopes, each with its sheet: one, or with existing ground both.
    pub(super) fn slopes(&mut self, args: &SlopeArgs, on_ground: bool) -> Vec<(Slope, Sheet)> {
        let slope = self.slope("--slope", args.slope.as_ref());
        let cut = self.slope("--cut-slope", args.cut_slope.as_ref());
        let fill = self.slope("--fill-slope", args.fill_slope.as_ref());
        let direction = args.direction(on_ground);
        if direction == DirectionArg::Auto && !on_ground {
            self.refuse(
                "the direction `auto` needs existing ground\n  --> --direction auto\n   \
                 = help: give the ground with `--terrain`, or choose `--direction down` or `up`"
                    .to_owned(),
            );
        }
        let falling = (Sheet::Falling, fill, args.fill_slope.is_some(), "--fill-slope", "falls");
        let rising = (Sheet::Rising, cut, args.cut_slope.is_some(), "--cut-slope", "rises");
        let wanted = match direction {
            DirectionArg::Down => vec![falling],
            DirectionArg::Up => vec![rising],
            DirectionArg::Auto => vec![falling, rising],
        };
        let mut slopes = Vec::new();
        let mut known = direction != DirectionArg::Auto || on_ground;
        for (sheet, own, given, name, verb) in wanted {
            if !given && args.slope.is_none() {
                known = false;
                self.refuse(format!(
                    "no slope was given for a surface that {verb}\n  --> --slope\n   \
                     = help: give `--slope` or `{name}`, such as 1:1.5, 2H:1V, 1in2, 50% or 26.57deg"
                ));
            }
            slopes.extend(own.or(slope).map(|slope| (slope, sheet)));
        }
        if known {
            self.idle_slopes(args, on_ground);
        }
        slopes
    }

    /// Refuses slopes that no surface has.
    fn idle_slopes(&mut self, args: &SlopeArgs, on_ground: bool) {
        for name in args.idle(on_ground) {
            let (text, what, help) = match name {
                CUT_SLOPE => {
                    (&args.cut_slope, "no surface rises that could have the slope", "choose `--direction up`, or leave it out")
                }
                FILL_SLOPE => {
                    (&args.fill_slope, "no surface falls that could have the slope", "choose `--direction down`, or leave it out")
                }
                _ => (
                    &args.slope,
                    "no surface is left that could have the slope",
                    "leave out `--slope`, or the slope in its place",
                ),
            };
            let text = text.as_deref().unwrap_or_default();
            self.refuse(format!("{what}\n  --> --{name} {text}\n   = help: {help}"));
        }
    }

    /// The line; what depends on the tolerance has that of the default.
    pub(super) fn input(&mut self, args: &InputArgs) -> LineInput {
        let format = args.input_format.map(FormatArg::format);
        let csv_order = self.order("--csv-order", args.csv_order.as_ref());
        let tolerance = DEFAULT_TOLERANCE;
        let formation = self.formation(args, tolerance);
        let unit = self.unit(args.units.as_ref());
        let pick = Pick { features: args.feature.clone(), layers: args.layer.clone(), ..Pick::default() };
        let options = ReadOptions { format, csv_order, pick, unit, ..ReadOptions::default() };
        LineInput { path: args.input.clone(), options, closed: args.closed, formation, unit, tolerance }
    }

    /// The road that is made of the line.
    fn formation(&mut self, args: &InputArgs, tolerance: f64) -> Option<Formation> {
        let width = self.number("--width", args.width.as_ref(), Rule::AtLeast(LEAST_WIDTH));
        let crossfall = args
            .crossfall
            .as_ref()
            .map(|text| self.take(text.parse::<Crossfall>().map_err(|error| placed(&error.to_string(), "--crossfall", text))));
        if args.width.is_some() && args.closed {
            let help = "leave `--closed` out for the centre line of a road, or `--width` for a ring";
            self.refuse(format!(
                "`--width` needs open lines, and `--closed` makes rings of them\n  --> --width\n   = help: {help}"
            ));
        }
        let crossfall = crossfall.unwrap_or(Some(Crossfall::default()));
        width.zip(crossfall).map(|(width, crossfall)| Formation { width, crossfall, chord: tolerance / CHORDS })
    }
}
