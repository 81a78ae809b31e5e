//! Arguments as typed → jobs in which everything is checked that can be without the input.

use super::args::{BuildArgs, DirectionArg, FormatArg, InputArgs, SampleArgs, SideArg, SlopeArgs, VolumeArgs};
use super::checks::{Checks, LEAST_LENGTH, UsageErrors, ending, placed, targets};
use super::number::{self, Rule};
use crate::formation::{Crossfall, Formation};
use crate::model::{Bulking, Extent, Sheet, Side, Slope};
use crate::pipeline::{
    Against, Area, BuildJob, GroundInput, Lattice, LineInput, LocalOrigin, Rasters, SampleJob, VolumeJob, Where, Wishes,
};
use crate::plot::Drawing;
use crate::read::terrain::TerrainOptions;
use crate::read::{InputFormat, Pick, ReadOptions};
use crate::report::{ReportFormat, RunRecord};
use crate::write::{LineFormat, MeshFormat, RasterFormat, Target};
use glam::{DVec2, DVec3};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// The narrowest road, in the length unit: the sides of a narrower one are one among the errors of coordinates.
const LEAST_WIDTH: f64 = 0.001;

/// How far breaklines may miss rings where no tolerance is given, in the length unit: the default of `--tolerance`.
const DEFAULT_TOLERANCE: f64 = 0.01;

/// Part of the tolerance that rounded corners of roads may use: a third.
const CHORDS: f64 = 3.0;

/// More threads than any machine this runs on has processors.
const MOST_THREADS: usize = 1024;

/// Outputs of a surface, as meshes and as rasters.
type Surfaces = (Vec<(Target, MeshFormat)>, Vec<(Target, RasterFormat)>);

impl Checks {
    /// The slopes, each with its sheet: one, or with existing ground both.
    fn slopes(&mut self, args: &SlopeArgs, on_ground: bool) -> Vec<(Slope, Sheet)> {
        let slope = self.slope("--slope", args.slope.as_ref());
        let cut = self.slope("--cut-slope", args.cut_slope.as_ref());
        let fill = self.slope("--fill-slope", args.fill_slope.as_ref());
        let direction = args.direction.unwrap_or(if on_ground { DirectionArg::Auto } else { DirectionArg::Down });
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
        for (sheet, own, given, name, verb) in wanted {
            if !given && args.slope.is_none() {
                self.refuse(format!(
                    "no slope was given for a surface that {verb}\n  --> --slope\n   \
                     = help: give `--slope` or `{name}`, such as 1:1.5, 2H:1V, 1in2, 50% or 26.57deg"
                ));
            }
            slopes.extend(own.or(slope).map(|slope| (slope, sheet)));
        }
        slopes
    }

    fn input(&mut self, args: &InputArgs) -> LineInput {
        let format = args.input_format.map(|format| match format {
            FormatArg::Geojson => InputFormat::GeoJson,
            FormatArg::Csv => InputFormat::Csv,
            FormatArg::Landxml => InputFormat::LandXml,
            FormatArg::Dxf => InputFormat::Dxf,
        });
        let csv_order = self.order("--csv-order", args.csv_order.as_ref());
        let tolerance = DEFAULT_TOLERANCE;
        let formation = self.formation(args, tolerance);
        let unit = self.unit(args.units.as_ref());
        let pick = Pick { features: args.feature.clone(), layers: args.layer.clone(), ..Pick::default() };
        let options = ReadOptions { format, csv_order, pick, unit, ..ReadOptions::default() };
        LineInput { path: args.input.clone(), options, closed: args.closed, formation, unit, tolerance }
    }

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

    /// How soil changes its volume; what is not given is nought.
    fn bulking(&mut self, args: &BuildArgs) -> Option<Bulking> {
        let mut share = |option, text: Option<&String>, limits| {
            text.map_or(Some(0.0), |text| self.take(number::share(option, text, &limits)))
        };
        let swell = share("--swell", args.swell.as_ref(), Bulking::SWELL);
        let shrink = share("--shrink", args.shrink.as_ref(), Bulking::SHRINK);
        let given = args.swell.is_some() || args.shrink.is_some();
        swell.zip(shrink).filter(|_| given).and_then(|(swell, shrink)| Bulking::new(swell, shrink))
    }

    /// Where drawings go, and that there is what they need.
    fn plots(&mut self, args: &BuildArgs) -> Vec<(Target, Drawing)> {
        let mut plots = Vec::new();
        for target in targets(&args.plot) {
            let drawing = self.take(Drawing::of(&target).map_err(|error| error.to_string()));
            plots.extend(drawing.map(|drawing| (target, drawing)));
        }
        for (target, drawing) in &plots {
            let lacks = match drawing {
                Drawing::Haul if args.terrain.is_none() || args.stations.is_none() => {
                    Some(("the mass haul needs stations on existing ground", "give `--terrain` and `--stations`"))
                }
                Drawing::Sections if args.section.is_empty() && args.stations.is_none() => {
                    Some(("cross-sections need stations", "choose some with `--section 40,80,120`, or give `--stations`"))
                }
                _ => None,
            };
            if let Some((what, help)) = lacks {
                self.refuse(format!("{what}\n  --> --plot {target}\n   = help: {help}"));
            }
        }
        plots
    }

    /// Stations of cross-sections, ascending; `drawn`: whether an output has any.
    fn sections(&mut self, args: &BuildArgs, drawn: bool) -> Vec<f64> {
        let mut stations: Vec<f64> =
            args.section.iter().filter_map(|text| self.number("--section", Some(text), Rule::Coordinate)).collect();
        stations.sort_by(f64::total_cmp);
        stations.dedup();
        if !args.section.is_empty() && !drawn {
            let given = args.section.join(",");
            let help = "ask for a drawing of them, such as `--plot sections.svg`, or for `--report report.html`";
            self.refuse(format!("`--section` says where cross-sections are drawn\n  --> --section {given}\n   = help: {help}"));
        }
        stations
    }

    /// Outputs of a surface: meshes, and rasters by the endings of their names.
    fn surfaces(&mut self, names: &[OsString]) -> Surfaces {
        let (mut meshes, mut rasters) = (Vec::new(), Vec::new());
        for target in targets(names) {
            if RasterFormat::is_named(&target) {
                let format = self.format(RasterFormat::of(&target));
                rasters.extend(format.map(|format| (target, format)));
            } else {
                let format = self.format(MeshFormat::of(&target));
                meshes.extend(format.map(|format| (target, format)));
            }
        }
        (meshes, rasters)
    }

    /// Rasters need cells, and cells rasters.
    fn rasters(
        &mut self,
        args: &BuildArgs,
        design: Vec<(Target, RasterFormat)>,
        finished: Vec<(Target, RasterFormat)>,
    ) -> Rasters {
        let cell = self.number("--cell", args.cell.as_ref(), Rule::AtLeast(LEAST_LENGTH));
        match (&args.cell, design.first().or(finished.first())) {
            (None, Some((target, _))) => self.refuse(format!(
                "a raster needs the side of its cells\n  --> {target}\n   = help: give it with `--cell`, such as `--cell 0.5`"
            )),
            (Some(text), None) if self.is_clean() => self.refuse(format!(
                "there is no raster that cells could be for\n  --> --cell {text}\n   = help: name an output that ends in {}, or leave \
                 out `--cell`",
                RasterFormat::KNOWN
            )),
            _ => {}
        }
        Rasters { cell: cell.unwrap_or(0.0), design, finished }
    }

    /// Refuses options that mean nothing without existing ground.
    fn needs_ground(&mut self, options: &[(&str, Option<&String>)]) {
        for (option, text) in options {
            if let Some(text) = text {
                self.refuse(format!(
                    "`{option}` needs existing ground\n  --> {option} {text}\n   = help: give the ground with `--terrain`"
                ));
            }
        }
    }
}

/// The job of `slopegen build`.
///
/// # Errors
/// Everything wrong with the arguments.
pub(super) fn build_job(args: &BuildArgs) -> Result<BuildJob, UsageErrors> {
    let mut checks = Checks::default();
    let mut input = checks.input(&args.input);
    let slopes = checks.slopes(&args.slope, args.terrain.is_some());
    let extent = [
        checks.number("--to-elevation", args.to_elevation.as_ref(), Rule::Coordinate).map(Extent::Elevation),
        checks.number("--height", args.height.as_ref(), Rule::AtLeast(LEAST_LENGTH)).map(Extent::Height),
        checks.number("--distance", args.distance.as_ref(), Rule::AtLeast(LEAST_LENGTH)).map(Extent::Distance),
    ];
    let interval = checks.number("--interval", args.interval.as_ref(), Rule::Positive);
    let levels: Vec<f64> = args.level.iter().filter_map(|z| checks.number("--level", Some(z), Rule::Coordinate)).collect();
    let tolerance = checks.number("--tolerance", Some(&args.tolerance), Rule::AtLeast(LEAST_LENGTH));
    if let Some(tolerance) = tolerance {
        input.tolerance = tolerance;
        input.options.chord = tolerance / CHORDS;
        input.formation.iter_mut().for_each(|road| road.chord = tolerance / CHORDS);
    }
    let reference = checks.number("--reference", args.reference.as_ref(), Rule::Coordinate);
    let stations = checks.number("--stations", args.stations.as_ref(), Rule::AtLeast(LEAST_LENGTH));
    let bulking = checks.bulking(args);
    if args.terrain.is_none() {
        let finished = args.finished.first().map(|name| name.to_string_lossy().into_owned());
        let table = args.station_table.first().map(|name| name.to_string_lossy().into_owned());
        checks.needs_ground(&[
            ("--stations", args.stations.as_ref().filter(|_| args.stakes.is_empty())),
            ("--swell", args.swell.as_ref()),
            ("--shrink", args.shrink.as_ref()),
            ("--finished", finished.as_ref()),
            ("--station-table", table.as_ref()),
            ("--allow-open", args.allow_open.then(String::new).as_ref()),
        ]);
    } else if let Some(z) = &args.reference {
        checks.refuse(format!(
            "volumes are taken against the existing ground\n  --> --reference {z}\n   \
             = help: leave out `--reference`, or `--terrain`"
        ));
    }
    let side = args.side.map(|side| match side {
        SideArg::Left => Side::Left,
        SideArg::Right => Side::Right,
        SideArg::Both => Side::Both,
        SideArg::Inside => Side::Inside,
        SideArg::Outside => Side::Outside,
    });

    if args.input.width.is_some() && side.is_some_and(|side| side != Side::Outside) {
        let help = "leave `--side` out; `outside` says the same";
        checks.refuse(format!(
            "a road has its slopes outside\n  --> --side\n   = `--width` makes a ring of the edges of the road\n   = help: {help}"
        ));
    }

    let outputs = if args.output.is_empty() { vec![default_output(&args.input.input)] } else { args.output.clone() };
    let (meshes, design) = checks.surfaces(&outputs);
    if side == Some(Side::Inside) && slopes.len() > 1 {
        checks.refuse(
            "slopes inside a ring need a direction\n  --> --side inside\n   \
             = help: choose `--direction down` for a pit from its rim, or `--direction up` for a mound from its foot"
                .to_owned(),
        );
    }
    let (finished, finished_rasters) = checks.surfaces(&args.finished);
    let rasters = checks.rasters(args, design, finished_rasters);
    let mut lines = Vec::new();
    for target in targets(&args.lines) {
        let format = checks.format(LineFormat::of(&target));
        lines.extend(format.map(|format| (target, format)));
    }
    let stakes = targets(&args.stakes);
    for target in &stakes {
        checks.format(ending(target, "table of slope stakes", &["csv"], "`.csv`"));
    }
    let plots = checks.plots(args);
    let station_tables = targets(&args.station_table);
    for target in &station_tables {
        checks.format(ending(target, "table", &["csv"], "`.csv`"));
    }
    let origin = args.local_origin.as_ref().and_then(|text| checks.take(local_origin(text)));
    let mut reports = Vec::new();
    for target in targets(&args.report) {
        let format = checks.format(ReportFormat::of(&target));
        reports.extend(format.map(|format| (target, format)));
    }
    let drawn = plots.iter().any(|(_, d)| *d == Drawing::Sections) || reports.iter().any(|(_, format)| format.draws());
    let sections = checks.sections(args, drawn);
    let used = meshes
        .iter()
        .chain(&finished)
        .map(|(t, _)| t)
        .chain(lines.iter().map(|(t, _)| t))
        .chain(&stakes)
        .chain(plots.iter().map(|(t, _)| t))
        .chain(&station_tables)
        .chain(reports.iter().map(|(t, _)| t))
        .any(|t| *t == Target::Stdout);
    if !used && !args.running.quiet {
        reports.push((Target::Stdout, ReportFormat::Text));
    }

    let extent = extent.into_iter().flatten().next();
    let unit = input.unit;
    let csv_order = checks.order("--terrain-order", args.terrain_order.as_ref());
    let ground = args.terrain.as_ref().map(|path| GroundInput {
        path: path.clone(),
        options: TerrainOptions {
            format: None,
            csv_order,
            pick: Pick {
                surface: args.surface.clone(),
                layers: args.terrain_layer.clone(),
                classes: args.class.clone(),
                ..Pick::default()
            },
            unit,
            ..TerrainOptions::default()
        },
        allow_open: args.allow_open,
    });
    let job = tolerance.filter(|_| !slopes.is_empty()).map(|tolerance| BuildJob {
        input,
        wishes: slopes
            .into_iter()
            .map(|(slope, sheet)| Wishes { slope, sheet, side, extent, interval, levels: levels.clone(), tolerance })
            .collect(),
        ground,
        reference,
        stations,
        bulking,
        strict: args.strict,
        meshes,
        finished,
        rasters,
        lines,
        stakes,
        plots,
        sections,
        station_tables,
        local_origin: origin,
        reports,
        run: Some(RunRecord::new("build", args.options.clone())),
    });
    checks.finish(job)
}

/// The job of `slopegen sample`.
///
/// # Errors
/// Everything wrong with the arguments.
pub(super) fn sample_job(args: &SampleArgs) -> Result<SampleJob, UsageErrors> {
    let mut checks = Checks::default();
    let input = checks.input(&args.input);
    let slope = checks.slopes(&args.slope, false).into_iter().next();
    let place = match (&args.at, &args.raster) {
        (Some(path), _) => {
            let csv_order = checks.order("--at-order", args.at_order.as_ref());
            if path == Path::new("-") && args.input.input == Path::new("-") {
                let help = "give a file for one of them";
                checks.refuse(format!("line and points cannot both come from standard input\n  --> --at -\n   = help: {help}"));
            }
            let output = args.output.as_deref().map_or(Target::Stdout, Target::from_arg);
            checks.format(ending(&output, "file of points", &["csv", "txt", "xyz"], "`.csv`, `.txt` or `.xyz`"));
            Some((Where::Points { path: path.clone(), options: ReadOptions { csv_order, ..ReadOptions::default() } }, output))
        }
        (None, Some(raster)) => {
            let output = Target::from_arg(raster);
            let format = checks.format(RasterFormat::of(&output));
            let cell = checks.number("--cell", args.cell.as_ref(), Rule::AtLeast(LEAST_LENGTH));
            let area = args.area.as_ref().map(|text| checks.take(area(text)));
            // An area that was given and cannot be read leaves no grid.
            let area = area.map_or(Some(None), |area| area.map(Some));
            match (cell, area, format) {
                (Some(cell), Some(area), Some(format)) => Some((Where::Raster(Lattice { cell, area }, format), output)),
                _ => None,
            }
        }
        // The parser asks for one of them.
        (None, None) => None,
    };
    let job = slope.zip(place).map(|((slope, sheet), (at, output))| SampleJob { input, slope, sheet, at, output });
    checks.finish(job)
}

/// The job of `slopegen volume`.
///
/// # Errors
/// Everything wrong with the arguments.
pub(super) fn volume_job(args: &VolumeArgs) -> Result<VolumeJob, UsageErrors> {
    let mut checks = Checks::default();
    let against = match &args.existing {
        Some(existing) => Some(Against::Existing { design: args.design.clone(), existing: existing.clone() }),
        None => checks
            .number("--to-elevation", args.to_elevation.as_ref(), Rule::Coordinate)
            .map(|elevation| Against::Elevation { existing: args.design.clone(), elevation }),
    };
    let csv_order = checks.order("--csv-order", args.csv_order.as_ref());
    let mut reports = Vec::new();
    for target in targets(&args.report) {
        let format = checks.format(ReportFormat::of(&target));
        reports.extend(format.map(|format| (target, format)));
    }
    if reports.iter().all(|(target, _)| *target != Target::Stdout) && !args.running.quiet {
        reports.push((Target::Stdout, ReportFormat::Text));
    }
    let within = args.within.clone();
    let run = Some(RunRecord::new("volume", args.options.clone()));
    let unit = checks.unit(args.units.as_ref());
    // A surface that is brought to a level is the first one given, and the existing one.
    let existing = if args.existing.is_some() { &args.existing_surface } else { &args.surface };
    let paths = [Some(&args.design), args.existing.as_ref()];
    // Classes are meant for the clouds among the files.
    let cloud = |path: &PathBuf| InputFormat::from_path(path).is_none_or(|format| format == InputFormat::Las);
    let no_cloud = !paths.iter().flatten().any(|path| cloud(path));
    let pick = |surface: &Option<String>, path: Option<&PathBuf>| Pick {
        surface: surface.clone(),
        classes: if no_cloud || path.is_some_and(cloud) { args.class.clone() } else { Vec::new() },
        ..Pick::default()
    };
    let picks = [pick(&args.surface, paths[0]), pick(existing, paths[1].or(paths[0]))];
    checks.finish(against.map(|against| VolumeJob { against, csv_order, picks, unit, within, reports, run }))
}

/// Number of threads asked for.
///
/// # Errors
/// What is wrong with it.
pub(super) fn threads(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(n) if (1..=MOST_THREADS).contains(&n) => Ok(n),
        _ => Err(format!(
            "`{text}` is not a number of threads\n  --> --threads {text}\n   = help: give a whole number from 1 to {MOST_THREADS}"
        )),
    }
}

/// The input's name with the ending of a mesh, in the working folder.
pub(super) fn default_output(input: &Path) -> OsString {
    let stem = if input == Path::new("-") { None } else { input.file_stem() };
    let mut name = stem.unwrap_or(OsStr::new("slopegen")).to_owned();
    name.push(".obj");
    name
}

/// Reads `X,Y,Z` or `auto`.
fn local_origin(text: &str) -> Result<LocalOrigin, String> {
    if text.eq_ignore_ascii_case("auto") {
        return Ok(LocalOrigin::Auto);
    }
    let fields: Vec<&str> = text.split(',').collect();
    if fields.len() != 3 {
        return Err(format!(
            "an origin has three numbers\n  --> --local-origin={text}\n   \
             = help: give `--local-origin=X,Y,Z`, decimals behind a point, or `--local-origin` alone"
        ));
    }
    let numbers =
        fields.iter().map(|field| number::read("--local-origin", field, Rule::Coordinate)).collect::<Result<Vec<f64>, _>>()?;
    Ok(LocalOrigin::At(DVec3::from_slice(&numbers)))
}

/// Reads `XMIN,YMIN,XMAX,YMAX`.
fn area(text: &str) -> Result<Area, String> {
    let refuse = |what: &str, help: &str| Err(format!("{what}\n  --> --box {text}\n   = help: {help}"));
    let fields: Vec<&str> = text.split(',').collect();
    if fields.len() != 4 {
        return refuse("a box has four numbers", "give `--box XMIN,YMIN,XMAX,YMAX`, decimals behind a point");
    }
    let numbers = fields.iter().map(|field| number::read("--box", field, Rule::Coordinate)).collect::<Result<Vec<f64>, _>>()?;
    let (min, max) = (DVec2::new(numbers[0], numbers[1]), DVec2::new(numbers[2], numbers[3]));
    if !(min.cmplt(max).all()) {
        return refuse("the box is empty", "give the south-west corner first: XMIN below XMAX, YMIN below YMAX");
    }
    Ok(Area { min, max })
}
