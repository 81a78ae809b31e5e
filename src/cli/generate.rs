//! Completions and manual pages, from the same declarations and texts as the help.

use super::help;
use super::usage::UsageErrors;
use crate::pipeline::Error;
use crate::write::{EncodeError, Outputs, Target};
use clap::{Args, Command};
use clap_complete::Shell;
use clap_mangen::Man;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Name of the program, of its manual pages and of what is completed.
const PROGRAM: &str = "slopegen";

#[derive(Debug, Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum, value_name = "SHELL")]
    pub(super) shell: Shell,
}

#[derive(Debug, Args)]
pub(super) struct ManArgs {
    /// The command whose page is wanted [default: that of the program itself]
    #[arg(value_name = "COMMAND", conflicts_with = "out")]
    pub(super) of: Option<String>,
    /// Write the pages of the program and of all its commands into this folder
    #[arg(long, value_name = "DIR", help_heading = help::OUTPUT)]
    pub(super) out: Option<PathBuf>,
}

/// Writes the completions of a shell to standard output.
pub(super) fn completions(args: &CompletionsArgs) -> Result<(), Error> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut super::command(), PROGRAM, &mut script);
    write(vec![(Target::Stdout, script)])
}

/// Writes manual pages: one to standard output, or all into a folder.
pub(super) fn man(args: &ManArgs) -> anyhow::Result<()> {
    // What the program itself calls `slopegen help` is no command with a page.
    let mut program = super::command().disable_help_subcommand(true);
    program.build();
    if let Some(folder) = &args.out {
        let pages = std::iter::once(&program).chain(program.get_subcommands());
        let file = |command: &Command| folder.join(format!("{}.1", name(command)));
        let files = pages.map(|command| Ok((Target::File(file(command)), page(command)?)));
        write(files.collect::<Result<_, EncodeError>>().map_err(failed)?)?;
        return Ok(());
    }
    let command = match &args.of {
        None => &program,
        Some(name) => program.find_subcommand(name).ok_or_else(|| {
            let names: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
            UsageErrors::one(format!("there is no command `{name}`\n  --> man\n   = help: give one of {}", names.join(", ")))
        })?,
    };
    write(vec![(Target::Stdout, page(command).map_err(failed)?)])?;
    Ok(())
}

fn failed(cause: EncodeError) -> Error {
    crate::write::WriteError::Write { target: Target::Stdout, cause }.into()
}

fn write(contents: Vec<(Target, Vec<u8>)>) -> Result<(), Error> {
    let targets: Vec<Target> = contents.iter().map(|(target, _)| target.clone()).collect();
    let mut outputs = Outputs::open::<PathBuf>(&targets, &[])?;
    for (index, (_, bytes)) in contents.iter().enumerate() {
        outputs.write(index, |out| Ok(out.write_all(bytes)?))?;
    }
    Ok(outputs.commit()?)
}

fn name(command: &Command) -> &str {
    command.get_display_name().unwrap_or(command.get_name())
}

/// A manual page.
fn page(command: &Command) -> Result<Vec<u8>, EncodeError> {
    let version = command.get_version().unwrap_or(env!("CARGO_PKG_VERSION"));
    let man = Man::new(command.clone()).source(format!("{PROGRAM} {version}")).manual("User commands");
    let mut out = Vec::new();
    man.render_title(&mut out)?;
    man.render_name_section(&mut out)?;
    man.render_synopsis_section(&mut out)?;
    man.render_description_section(&mut out)?;
    man.render_options_section(&mut out)?;
    if command.has_subcommands() {
        man.render_subcommands_section(&mut out)?;
    }
    let (examples, more) = help::text(command.get_name()).split_once("\n\n").unwrap_or((help::text(command.get_name()), ""));
    section(&mut out, "EXAMPLES", examples.strip_prefix("Examples:\n").unwrap_or(examples), true);
    if !more.is_empty() {
        section(&mut out, "NOTES", more, false);
    }
    let codes = help::EXIT_CODES.split_once('\n').map_or(help::EXIT_CODES, |(_, codes)| codes);
    section(&mut out, "EXIT STATUS", codes, true);
    if command.get_name() != PROGRAM {
        section(&mut out, "SEE ALSO", &format!("{PROGRAM}(1)"), false);
    }
    Ok(out)
}

/// A section of text; `as_it_is`: with its own line breaks.
fn section(out: &mut Vec<u8>, title: &str, text: &str, as_it_is: bool) {
    let mut page = format!(".SH \"{title}\"\n");
    let (begin, end) = if as_it_is { (".nf\n", ".fi\n") } else { ("", "") };
    page.push_str(begin);
    for line in text.lines() {
        let line = line.replace('\\', "\\e").replace('-', "\\-");
        // A full stop or an apostrophe at the beginning would be a request.
        let guard = if line.starts_with(['.', '\'']) { "\\&" } else { "" };
        let _ = writeln!(page, "{guard}{line}");
    }
    page.push_str(end);
    out.extend_from_slice(page.as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_guarded() {
        let mut out = Vec::new();
        section(&mut out, "A", ".x\n'y\na\\b --c\n", true);
        assert_eq!(String::from_utf8(out).unwrap(), ".SH \"A\"\n.nf\n\\&.x\n\\&'y\na\\eb \\-\\-c\n.fi\n");
    }
}
