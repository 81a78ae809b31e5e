//! The whole command line as the parser sees it. What a command takes stands with the command.

use super::batch::BatchArgs;
use super::build::BuildArgs;
use super::check::CheckArgs;
use super::diff::DiffArgs;
use super::generate::{CompletionsArgs, ManArgs};
use super::help;
use super::info::InfoArgs;
use super::sample::SampleArgs;
use super::selftest::SelftestArgs;
use super::verify::VerifyArgs;
use super::volume::VolumeArgs;
use clap::{CommandFactory as _, Parser, Subcommand, ValueEnum};

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

/// When there are colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ColorArg {
    Auto,
    Always,
    Never,
}
