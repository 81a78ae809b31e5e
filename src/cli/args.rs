//! Arguments as typed: what the parser can check by itself, and the words of the help.

use super::batch::BatchArgs;
use super::check::CheckArgs;
use super::diff::DiffArgs;
use super::generate::{CompletionsArgs, ManArgs};
use super::help;
use super::info::InfoArgs;
use super::selftest::SelftestArgs;
use super::verify::VerifyArgs;
use crate::report::Options;
use clap::{ArgAction, ArgGroup, Args, CommandFactory as _, Parser, Subcommand, ValueEnum};
use std::ffi::OsString;
use std::path::PathBuf;

/// The whole command line, for those who generate from it: with the styles and the long texts of the help.
pub fn command() -> clap::Command {
    help::dressed(Arguments::command())
}

/// Surfaces of constant slope through a 3D line, for earthworks
#[derive(Debug, Parser)]
#[command(name = "slopegen", version, arg_required_else_help = true, max_term_width = 110)]
pub(super) struct Arguments {
    /// Colours: on terminals only, always, or never
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value = "auto", help_heading = help::RUNNING)]
    pub(super) color: ColorArg,
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Build the surface and write mesh, line work and report
    #[command(arg_required_else_help = true)]
    Build(Box<BuildArgs>),
    /// Exact cut and fill between two surfaces, or a surface and a level
    #[command(arg_required_else_help = true)]
    Volume(Box<VolumeArgs>),
    /// Exact heights of the surface at points or as a raster
    #[command(arg_required_else_help = true)]
    Sample(Box<SampleArgs>),
    /// Look at a mesh from anywhere: soundness, slopes, angles
    #[command(arg_required_else_help = true)]
    Check(Box<CheckArgs>),
    /// Build many jobs at once, with one summary
    #[command(arg_required_else_help = true)]
    Batch(Box<BatchArgs>),
    /// What differs between two reports, or between two surfaces
    #[command(arg_required_else_help = true)]
    Diff(Box<DiffArgs>),
    /// What a file holds, and what is wrong with it
    #[command(arg_required_else_help = true)]
    Info(Box<InfoArgs>),
    /// Run a report again and compare
    #[command(arg_required_else_help = true)]
    Verify(Box<VerifyArgs>),
    /// Compute cases with known figures on this machine and compare
    Selftest(SelftestArgs),
    /// Completions for a shell, to standard output
    #[command(arg_required_else_help = true)]
    Completions(CompletionsArgs),
    /// Manual pages
    Man(ManArgs),
}

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
    /// Write the report; .json, .txt, .md or .html, may be repeated [default: as text to standard output]
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

#[derive(Debug, Args)]
#[command(group = ArgGroup::new("where").args(["at", "raster"]).required(true))]
pub(super) struct SampleArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    #[command(flatten)]
    pub(super) slope: SlopeArgs,

    /// Heights at the points of a text file with columns x and y; - is standard input
    #[arg(long, value_name = "POINTS", help_heading = help::PLACES)]
    pub(super) at: Option<PathBuf>,
    /// Columns of POINTS without a header, such as xy or pen
    #[arg(long, value_name = "ORDER", requires = "at", conflicts_with = "raster", help_heading = help::PLACES)]
    pub(super) at_order: Option<String>,
    /// Heights at the nodes of a grid, written as a raster, .tif or .asc; - is standard output, .asc
    #[arg(long, value_name = "FILE", requires = "cell", conflicts_with = "output", help_heading = help::PLACES)]
    pub(super) raster: Option<OsString>,
    /// Distance of the nodes of the grid
    #[arg(long, value_name = "C", requires = "raster", conflicts_with = "at", allow_negative_numbers = true, help_heading = help::PLACES)]
    pub(super) cell: Option<String>,
    /// Box of the grid [default: that of the line, grown by a tenth of its longer side or by 5 cells]
    #[arg(
        long = "box",
        value_name = "XMIN,YMIN,XMAX,YMAX",
        requires = "raster",
        conflicts_with = "at",
        allow_hyphen_values = true,
        help_heading = help::PLACES
    )]
    pub(super) area: Option<String>,

    /// Write the points to a .csv file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) output: Option<OsString>,

    #[command(flatten)]
    pub(super) running: Running,
}

#[derive(Debug, Args)]
pub(super) struct VolumeArgs {
    /// The surface after the works: .obj, .ply, .xml (LandXML), .dxf, .asc, .tif, or points as .las, .laz, .csv, .txt, .xyz; with
    /// --to-elevation the surface before
    #[arg(value_name = "DESIGN")]
    pub(super) design: PathBuf,
    /// The surface before the works, in any of these formats
    #[arg(value_name = "EXISTING", required_unless_present = "to_elevation", conflicts_with = "to_elevation")]
    pub(super) existing: Option<PathBuf>,
    /// Bring the one surface given to elevation Z: cut is what lies above, fill what is missing below
    #[arg(long, value_name = "Z", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) to_elevation: Option<String>,
    /// Only inside the rings or polygons of this file: .geojson, .json, or a text file
    #[arg(long, value_name = "FILE", help_heading = help::SURFACE)]
    pub(super) within: Option<PathBuf>,
    /// Columns of text files of points without a header, such as xyz or pnezd
    #[arg(long, value_name = "ORDER", help_heading = help::INPUT)]
    pub(super) csv_order: Option<String>,
    /// Which surface of a LandXML file with several of them is the first one given
    #[arg(long, value_name = "NAME", help_heading = help::INPUT)]
    pub(super) surface: Option<String>,
    /// Which surface of a LandXML file with several of them is the one before the works
    #[arg(long, value_name = "NAME", conflicts_with = "to_elevation", help_heading = help::INPUT)]
    pub(super) existing_surface: Option<String>,
    /// Unit of the figures, and of files that declare none: m, ft (0.3048 m) or us-ft (1200/3937 m) [default: that of the first file, else m]
    #[arg(long, value_name = "UNIT", help_heading = help::INPUT)]
    pub(super) units: Option<String>,
    /// Points of these classes of LAS and LAZ files are the surface, such as 2 or 2,8 [default: 2]
    #[arg(long, value_name = "N", value_delimiter = ',', help_heading = help::INPUT)]
    pub(super) class: Vec<u8>,

    /// Write the report; .json, .txt, .md or .html, may be repeated [default: as text to standard output]
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) report: Vec<OsString>,

    #[command(flatten)]
    pub(super) running: Running,

    /// What was given, for the report.
    #[arg(skip)]
    pub(super) options: Options,
}

#[derive(Debug, Args)]
pub(super) struct InputArgs {
    /// The line: .geojson, .json, .csv, .txt, .tsv, .xyz, .xml (LandXML) or .dxf; - is standard input. For `build` also a job file,
    /// .toml
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
    /// Unit of the figures, and of files that declare none: m, ft (0.3048 m) or us-ft (1200/3937 m) [default: that of the line, else m]
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

#[derive(Debug, Args)]
pub(super) struct Running {
    /// Print errors only
    #[arg(short, long, help_heading = help::RUNNING)]
    pub(super) quiet: bool,
    /// Print how long each stage took
    #[arg(short, long, conflicts_with = "quiet", action = ArgAction::SetTrue, help_heading = help::RUNNING)]
    pub(super) verbose: bool,
    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = help::RUNNING)]
    pub(super) threads: Option<String>,
    /// Refuse work that would take more memory than this, such as 2GB or 1500MiB [default: what there is]
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true, help_heading = help::RUNNING)]
    pub(super) max_memory: Option<String>,
}

/// When there are colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ColorArg {
    Auto,
    Always,
    Never,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum SideArg {
    Left,
    Right,
    Both,
    Inside,
    Outside,
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
