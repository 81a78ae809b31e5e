//! `slopegen build`: arguments, and what is told of the files that were written.

mod job;

use super::exit_code::Code;
use super::help;
use super::line::{InputArgs, SlopeArgs};
use super::running::{Run, Running};
use crate::model::Side;
use crate::pipeline;
use crate::report::{Options, write_text};
use crate::write::{MeshFormat, Target};
use clap::{ArgGroup, Args, ValueEnum};
use std::ffi::OsString;
use std::path::PathBuf;

pub(super) use job::{default_output, job};

#[derive(Debug, Args)]
#[command(group = ArgGroup::new("end").args(["to_elevation", "height", "distance"]))]
pub(super) struct BuildArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    #[command(flatten)]
    pub(super) slope: SlopeArgs,

    /// Side of the line to build on [default: both for lines, outside for rings]
    ///
    /// Left and right are seen in the order of the vertices; inside and outside need rings.
    #[arg(long, value_enum, help_heading = help::SURFACE)]
    pub(super) side: Option<SideArg>,
    /// End the slopes at elevation Z
    ///
    /// Without an end, slopes go to the ground; without --terrain 10 length units beyond the lowest vertex (the highest, for
    /// slopes that rise).
    #[arg(long, value_name = "Z", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) to_elevation: Option<String>,
    /// End the slopes H below (above) where they leave the line
    #[arg(long, value_name = "H", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) height: Option<String>,
    /// End the slopes D from the line, in plan along the line of steepest descent
    #[arg(long, value_name = "D", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) distance: Option<String>,
    /// Height between level curves [default: a round number that gives 10 to 25 of them]
    #[arg(long, value_name = "DZ", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) interval: Option<String>,
    /// Level curves at these elevations, such as 402.5,404; alone or beside those of --interval
    #[arg(long, value_name = "Z", value_delimiter = ',', allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) level: Vec<String>,
    /// Greatest height error of the whole mesh
    #[arg(long, value_name = "T", default_value = "0.01", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) tolerance: String,
    /// Take volumes against the plane at elevation Z [default: where the slopes end]; not with --terrain
    #[arg(long, value_name = "Z", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) reference: Option<String>,
    /// Existing ground: .xml (LandXML), .dxf, .obj, .ply, .tif, .asc, .las, .laz, or points as .csv, .xyz, .txt; slopes then end
    /// where they meet it
    #[arg(long, value_name = "FILE", help_heading = help::INPUT)]
    pub(super) terrain: Option<PathBuf>,
    /// Columns of a ground of points without a header, such as xyz or pnezd
    #[arg(long, value_name = "ORDER", requires = "terrain", help_heading = help::INPUT)]
    pub(super) terrain_order: Option<String>,
    /// Which surface of a LandXML file with several of them is the ground
    #[arg(long, value_name = "NAME", requires = "terrain", help_heading = help::INPUT)]
    pub(super) surface: Option<String>,
    /// Take the ground from these layers of a drawing only; may be repeated [default: all that are on]
    #[arg(long, value_name = "NAME", requires = "terrain", help_heading = help::INPUT)]
    pub(super) terrain_layer: Vec<String>,
    /// Points of these classes of a LAS or LAZ file are ground, such as 2 or 2,8 [default: 2]
    #[arg(long, value_name = "N", requires = "terrain", value_delimiter = ',', help_heading = help::INPUT)]
    pub(super) class: Vec<u8>,
    /// Accept slopes that end without meeting the ground, and platforms partly beside it
    #[arg(long, help_heading = help::SURFACE)]
    pub(super) allow_open: bool,
    /// Write the whole ground with the works in it, in any format of -o; may be repeated
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) finished: Vec<OsString>,
    /// Cut and fill for every D along the line, with cross-sections and the running net; stations of slope stakes
    ///
    /// Needs existing ground, or --stakes.
    #[arg(long, value_name = "D", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) stations: Option<String>,
    /// Gain in volume of soil when it is dug: 25% or 0.25
    #[arg(long, value_name = "P", allow_hyphen_values = true, help_heading = help::SURFACE)]
    pub(super) swell: Option<String>,
    /// Loss in volume of soil when it is compacted, against its volume in the ground: 10% or 0.1
    #[arg(long, value_name = "P", allow_hyphen_values = true, help_heading = help::SURFACE)]
    pub(super) shrink: Option<String>,
    /// Refuse lines of which a part lies buried under the slope of another part
    #[arg(long, help_heading = help::SURFACE)]
    pub(super) strict: bool,

    /// Write the mesh: .obj, .ply, .xml (LandXML), .dxf, .stl, .glb, or a raster, .tif or .asc; may be repeated [default: the
    /// input's name with .obj, in the working folder]
    #[arg(short, long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) output: Vec<OsString>,
    /// Side of the cells of rasters; heights are those of the mesh at their centres
    #[arg(long, value_name = "C", allow_negative_numbers = true, help_heading = help::OUTPUT)]
    pub(super) cell: Option<String>,
    /// Write the report; .json, .txt, .md or .html, may be repeated. As text to standard output as well, unless --quiet
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) report: Vec<OsString>,
    /// Write slope stakes for every --stations and side: hinge, catch point, distances, slope; .csv, may be repeated
    #[arg(long, value_name = "FILE", requires = "stations", help_heading = help::OUTPUT)]
    pub(super) stakes: Vec<OsString>,
    /// Draw as SVG; the name ends in plan.svg, profile.svg, sections.svg or haul.svg, which says what; may be repeated
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) plot: Vec<OsString>,
    /// Stations of the cross-sections drawn, such as 40,80,120 [default: those of --stations]
    #[arg(long, value_name = "S", value_delimiter = ',', allow_negative_numbers = true, help_heading = help::OUTPUT)]
    pub(super) section: Vec<String>,
    /// Write the table of stations, all digits; .csv, may be repeated; needs --stations
    #[arg(long, value_name = "FILE", requires = "stations", help_heading = help::OUTPUT)]
    pub(super) station_table: Vec<OsString>,
    /// Write level curves, creases, hinge, daylight line and boundary: .geojson, .xml (LandXML) or .dxf; may be repeated
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) lines: Vec<OsString>,
    /// Count the coordinates of meshes for viewers (.obj, .ply, .stl, .glb) from a point near them, told in FILE.origin.json
    ///
    /// Alone or with `auto` a round point south-west of the mesh. STL and GLB are always written like this. LandXML and DXF keep
    /// world coordinates.
    #[arg(
        long,
        value_name = "X,Y,Z",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "auto",
        allow_hyphen_values = true,
        help_heading = help::OUTPUT
    )]
    pub(super) local_origin: Option<String>,

    #[command(flatten)]
    pub(super) running: Running,

    /// What was given, for the report.
    #[arg(skip)]
    pub(super) options: Options,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum SideArg {
    Left,
    Right,
    Both,
    Inside,
    Outside,
}

impl SideArg {
    fn side(self) -> Side {
        match self {
            Self::Left => Side::Left,
            Self::Right => Side::Right,
            Self::Both => Side::Both,
            Self::Inside => Side::Inside,
            Self::Outside => Side::Outside,
        }
    }
}

/// Builds, and tells of the files with the sizes of their meshes.
pub(super) fn run(args: &BuildArgs) -> anyhow::Result<Code> {
    let mut job = job(args)?;
    let all = job.footprint().outputs;
    let run = Run::beside(&args.running, &mut job.reports, &all)?;
    let built = pipeline::build(&job, &run.console)?;
    run.show(|out| write_text(out, &built.report))?;
    let size = |vertices: usize, triangles: usize| format!("{vertices} vertices, {triangles} triangles");
    let design = size(built.report.surface.vertices, built.report.surface.triangles);
    let finished = built.report.finished.map_or_else(String::new, |finished| size(finished.vertices, finished.triangles));
    for target in &built.written {
        let is_among = |meshes: &[(Target, MeshFormat)]| meshes.iter().any(|(mesh, _)| mesh == target);
        let sizes = [(is_among(&job.meshes), design.as_str()), (is_among(&job.finished), finished.as_str())];
        let size = sizes.iter().find(|(is_it, _)| *is_it).map_or("", |(_, size)| size);
        run.console.wrote(target, size);
    }
    Ok(Code::Done)
}
