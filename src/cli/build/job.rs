//! Arguments of `slopegen build` as typed → a job in which everything is checked that can be without the input.

use super::super::line::CHORDS;
use super::super::number::{self, Rule};
use super::super::usage::{Checks, LEAST_LENGTH, UsageErrors, targets};
use super::{BuildArgs, SideArg};
use crate::model::{Bulking, Extent, Side};
use crate::pipeline::{BuildJob, GroundInput, LocalOrigin, Rasters, Wishes};
use crate::plot::Drawing;
use crate::read::Pick;
use crate::read::terrain::TerrainOptions;
use crate::report::{ReportFormat, RunRecord};
use crate::write::{LineFormat, MeshFormat, RasterFormat, Target};
use glam::DVec3;
use std::ffi::{OsStr, OsString};
use std::path::Path;

/// Outputs of a surface, as meshes and as rasters.
type Surfaces = (Vec<(Target, MeshFormat)>, Vec<(Target, RasterFormat)>);

/// The job of `slopegen build`.
///
/// # Errors
/// Everything wrong with the arguments.
pub(in crate::cli) fn job(args: &BuildArgs) -> Result<BuildJob, UsageErrors> {
    let mut checks = Checks::default();
    let mut input = checks.input(&args.input);
    let slopes = checks.slopes(&args.slope, args.terrain.is_some());
    let extent = checks.extent(args);
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
    checks.with_ground(args);
    let side = checks.side(args, slopes.len() > 1);

    let outputs = if args.output.is_empty() { vec![default_output(&args.input.input)] } else { args.output.clone() };
    let (meshes, design) = checks.surfaces(&outputs);
    let (finished, finished_rasters) = checks.surfaces(&args.finished);
    let rasters = checks.rasters(args, design, finished_rasters);
    let lines = checks.outputs(&args.lines, LineFormat::of);
    let stakes = checks.ending(&args.stakes, "table of slope stakes", &["csv"], "`.csv`");
    let plots = checks.plots(args);
    let station_tables = checks.ending(&args.station_table, "table", &["csv"], "`.csv`");
    let local_origin = args.local_origin.as_ref().and_then(|text| checks.take(local_origin(text)));
    checks.counted_from(args, meshes.iter().chain(&finished));
    let reports = checks.outputs(&args.report, ReportFormat::of);
    let drawn = plots.iter().any(|(_, d)| *d == Drawing::Sections) || reports.iter().any(|(_, format)| format.draws());
    let sections = checks.sections(args, drawn);
    let csv_order = checks.order("--terrain-order", args.terrain_order.as_ref());
    let ground = args.terrain.as_ref().map(|path| GroundInput {
        path: path.clone(),
        options: TerrainOptions {
            csv_order,
            pick: Pick {
                surface: args.surface.clone(),
                layers: args.terrain_layer.clone(),
                classes: args.class.clone(),
                ..Pick::default()
            },
            unit: input.unit,
            ..TerrainOptions::default()
        },
        allow_open: args.allow_open,
    });
    let wish = |(slope, sheet), tolerance| Wishes { slope, sheet, side, extent, interval, levels: levels.clone(), tolerance };
    let job = tolerance.filter(|_| !slopes.is_empty()).map(|tolerance| BuildJob {
        input,
        wishes: slopes.into_iter().map(|slope| wish(slope, tolerance)).collect(),
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
        local_origin,
        reports,
        run: Some(RunRecord::new("build", args.options.clone())),
    });
    let mut job = checks.finish(job)?;
    // The report is seen where nothing else goes to standard output.
    if !args.running.quiet && !job.footprint().outputs.contains(&Target::Stdout) {
        job.reports.push((Target::Stdout, ReportFormat::Text));
    }
    Ok(job)
}

impl Checks {
    /// Where the slopes end; the parser takes one of these options only.
    fn extent(&mut self, args: &BuildArgs) -> Option<Extent> {
        let elevation = self.number("--to-elevation", args.to_elevation.as_ref(), Rule::Coordinate).map(Extent::Elevation);
        let height = self.number("--height", args.height.as_ref(), Rule::AtLeast(LEAST_LENGTH)).map(Extent::Height);
        let distance = self.number("--distance", args.distance.as_ref(), Rule::AtLeast(LEAST_LENGTH)).map(Extent::Distance);
        elevation.or(height).or(distance)
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

    /// Refuses options that mean nothing without existing ground, and the one that means nothing with it.
    fn with_ground(&mut self, args: &BuildArgs) {
        if args.terrain.is_some() {
            if let Some(z) = &args.reference {
                self.refuse(format!(
                    "volumes are taken against the existing ground\n  --> --reference {z}\n   \
                     = help: leave out `--reference`, or `--terrain`"
                ));
            }
            return;
        }
        let first = |names: &[OsString]| names.first().map(|name| name.to_string_lossy().into_owned());
        for (option, text) in [
            ("--stations", args.stations.clone().filter(|_| args.stakes.is_empty())),
            ("--swell", args.swell.clone()),
            ("--shrink", args.shrink.clone()),
            ("--finished", first(&args.finished)),
            ("--station-table", first(&args.station_table)),
            ("--allow-open", args.allow_open.then(String::new)),
        ] {
            if let Some(text) = text {
                self.refuse(format!(
                    "`{option}` needs existing ground\n  --> {option} {text}\n   = help: give the ground with `--terrain`"
                ));
            }
        }
    }

    /// The side of the line, if asked for; `both_sheets`: slopes may rise and fall.
    fn side(&mut self, args: &BuildArgs, both_sheets: bool) -> Option<Side> {
        let side = args.side.map(SideArg::side);
        if args.input.width.is_some() && side.is_some_and(|side| side != Side::Outside) {
            let help = "leave `--side` out; `outside` says the same";
            self.refuse(format!(
                "a road has its slopes outside\n  --> --side\n   = `--width` makes a ring of the edges of the road\n   = help: {help}"
            ));
        }
        if side == Some(Side::Inside) && both_sheets {
            self.refuse(
                "slopes inside a ring need a direction\n  --> --side inside\n   \
                 = help: choose `--direction down` for a pit from its rim, or `--direction up` for a mound from its foot"
                    .to_owned(),
            );
        }
        side
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

    /// Refuses an origin that no mesh is counted from.
    fn counted_from<'a>(&mut self, args: &BuildArgs, mut meshes: impl Iterator<Item = &'a (Target, MeshFormat)>) {
        let Some(text) = args.local_origin.as_ref().filter(|_| self.is_clean()) else { return };
        if !meshes.any(|(_, format)| format.is_single() || format.takes_origin()) {
            let help = "name an output that ends in `.obj`, `.ply`, `.stl` or `.glb`, or leave out `--local-origin`";
            self.refuse(format!("no output counts from a local origin\n  --> --local-origin={text}\n   = help: {help}"));
        }
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
}

/// The input's name with the ending of a mesh, in the working folder.
pub(in crate::cli) fn default_output(input: &Path) -> OsString {
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
