//! Longer texts of the help and of the manual pages, and their colours.

use anstyle::{AnsiColor, Style};
use std::fmt::Write as _;

pub(super) const INPUT: &str = "Input";
pub(super) const SURFACE: &str = "Surface";
pub(super) const PLACES: &str = "Places";
pub(super) const CHECKS: &str = "Checks";
pub(super) const OUTPUT: &str = "Output";
pub(super) const RUNNING: &str = "Running";

/// What the program exits with; also in the manual pages.
pub(super) const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  the work could not be done: bad geometry, nothing to build
  2  wrong usage
  3  an input could not be read
  4  an output could not be written
  5  the result did not pass its checks, or a bound; a report or the self-test is not what it must be
  6  there is not enough memory
  130  interrupted (129 hung up, 143 terminated)";

const AFTER: &str = "\
Examples:
  slopegen build road.geojson --width 7 --terrain ground.obj --cut-slope 1:1 --fill-slope 1:1.5
      cuttings and embankments of a road on existing ground
  slopegen build job.toml
      the same from a file of options
  slopegen volume design.obj ground.obj
      cut and fill between two surfaces
  slopegen info ground.obj
      what a file holds, and what is wrong with it

All lengths are in the unit of the input, which must be projected. `slopegen build --help` and so on have more examples.";

const AFTER_BUILD: &str = "\
Examples:
  slopegen build road.geojson --width 7 --terrain ground.obj --cut-slope 1:1 --fill-slope 1:1.5 --finished finished.obj
      cuttings and embankments of a road on existing ground: the works, volumes, and the whole ground with the works in it
  slopegen build pad.geojson --slope 1:2 --terrain ground.ply --stations 20 --swell 25% --shrink 10% --report pad.html
      the same for a building pad, with figures along its edge and the change in volume of the soil, on a page with drawings
  slopegen build pad.geojson --slope 1:2 --terrain ground.obj -o pad.xml -o pad.dxf --finished after.glb
      the design for a rover (LandXML, DXF), the ground after the works for a viewer
  slopegen build road.geojson --slope 1:1.5
      embankment on both sides of a road, 10 below its lowest vertex: road.obj, report on standard output
  slopegen build road.geojson --slope 1:1.5 --width 8 --crossfall 2.5%
      the same for a road 8 wide: platform with a crown, slopes from its edges
  slopegen build pad.geojson --slope 1:2 --to-elevation 405 -o pad.ply --lines pad_lines.geojson --report pad.json
      building pad above level ground, with line work and report
  slopegen build pit.csv --closed --side inside --slope 45deg --height 6 -o pit.obj
      excavation inside a rim of surveyed points, 6 deep
  slopegen build road.geojson --direction up --cut-slope 1:1 --distance 20 --interval 0.5 -o cut.obj
      cutting along a road, 20 wide on either side
  slopegen build job.toml --slope 1:2
      options from a file of lines such as `slope = '1:1.5'`; those of the command line win
  slopegen build road.geojson --width 7 --terrain ground.obj --slope 1:1.5 --stations 20 --plot plan.svg --plot sections.svg
      drawings: a plan with cut and fill, and cross-sections every 20
  cat road.geojson | slopegen build - --input-format geojson --slope 1:1.5 -o - > road.obj

1:1.5 is one vertical to 1.5 horizontal. 1:0.5 could be read either way and is refused: write 1V:0.5H or 1H:0.5V.";

const AFTER_VOLUME: &str = "\
Examples:
  slopegen volume design.obj ground.obj --report volume.json
  slopegen volume may.xyz april.xyz --within lot.geojson
      between two surveys, inside the boundary of a lot
  slopegen volume stockpile.ply --to-elevation 102.5
      what lies above a level (cut), and what is missing below it (fill)

Cut is where DESIGN lies below EXISTING, fill where it lies above; only where both are. Faces are taken as they are given.";

const AFTER_SAMPLE: &str = "\
Examples:
  slopegen sample road.geojson --slope 1:1.5 --at points.csv -o heights.csv
  slopegen sample road.geojson --slope 1:1.5 --raster road.asc --cell 0.5
  slopegen sample pit.csv --closed --slope 1:1 --raster pit.asc --cell 1 --box 500290,5400420,500390,5400500
  echo 500100,5400200 | slopegen sample road.geojson --slope 1:1.5 --at - --at-order xy

Heights are those of the closed form of the given line, on both sides of it and as far as you ask: nothing is simplified.";

const AFTER_CHECK: &str = "\
Examples:
  slopegen check ground.obj
      is it a sound surface: oriented, without overlaps, cracks and T-junctions? With places, slopes and angles
  slopegen check road.obj --slope 1:1.5
      and do its slopes keep 1V:1.5H within 0.1 degrees?
  slopegen check design.ply --slope 1:2 --tolerance-deg 0.5 --max-off 2% --part batter --report check.json
      the group `batter` of another program's mesh: 2 % of its area may be off by more than half a degree

The mesh is taken as it is in the file; vertices at exactly the same place are taken as one. Exits with 5 when the surface is
not sound or does not keep the slope, with 0 when there are only remarks.";

const AFTER_BATCH: &str = "\
Examples:
  slopegen batch site/*.toml
      all jobs, each done whatever becomes of the others; a table at the end
  slopegen batch site --jobs 4 --report summary.json --quiet
      all job files of a folder, four at a time
  slopegen batch --list jobs.txt --fail-fast
      the job files named in a text file; none is begun after the first that fails

Exits with 0 when all jobs are done, else with the gravest of their codes: 130, 6, 4, 3, 2, 5, 1 in this order.";

const AFTER_DIFF: &str = "\
Examples:
  slopegen diff may.json june.json
      what differs between two reports of `build` or `volume`: inputs, parameters, volumes, areas, stations
  slopegen diff a.json b.json --max-volume 0.5% --max-height 0.02
      exits with 5 if cut or fill differ by more than half a percent, or the greatest depths by more than 0.02
  slopegen diff a.ply b.obj --max-height 0.01 --report diff.json
      the greatest height difference of two surfaces, and where; exits with 5 beyond 0.01
  slopegen diff before.json after.json --exact
      exits with 5 if any figure differs

Differences are B less A. Times, paths and the version of the program are told but never count.";

const AFTER_INFO: &str = "\
Examples:
  slopegen info ground.obj
      format, checksum, vertices and faces, box, units, and every defect
  slopegen info survey.csv --csv-order pnezd --report survey.json
  slopegen info job.toml --strict
      exits with 5 if the options of the job have a defect

Lines, ground, job files and reports are told by name, else by content. Exits with 3 when the file cannot be read.";

const AFTER_VERIFY: &str = "\
Examples:
  slopegen verify road.json
      builds again in memory as the report says, and compares inputs, figures, hashes and the files written
  slopegen verify archive/road.json --input-dir survey
      the same with the inputs from a folder

Nothing is written. Exits with 5 if anything differs, and tells what.";

const AFTER_SELFTEST: &str = "\
Examples:
  slopegen selftest
      computes cases with known figures, and compares
  slopegen selftest --report selftest.json --report selftest.txt --quiet
      the same for the files of a quality system

Needs no files. Exits with 5 if a figure is beyond its bound, and names it.";

const AFTER_COMPLETIONS: &str = "\
Examples:
  slopegen completions bash > ~/.local/share/bash-completion/completions/slopegen
  slopegen completions zsh > ~/.zfunc/_slopegen
  slopegen completions fish > ~/.config/fish/completions/slopegen.fish";

const AFTER_MAN: &str = "\
Examples:
  slopegen man | man -l -
      the page of the program
  slopegen man build > slopegen-build.1
  slopegen man --out ~/.local/share/man/man1
      the pages of the program and of all its commands";

/// Longer texts by the command they belong to.
const TEXTS: [(&str, &str); 11] = [
    ("build", AFTER_BUILD),
    ("volume", AFTER_VOLUME),
    ("sample", AFTER_SAMPLE),
    ("check", AFTER_CHECK),
    ("batch", AFTER_BATCH),
    ("diff", AFTER_DIFF),
    ("info", AFTER_INFO),
    ("verify", AFTER_VERIFY),
    ("selftest", AFTER_SELFTEST),
    ("completions", AFTER_COMPLETIONS),
    ("man", AFTER_MAN),
];

/// The longer text of a command; of the program itself for its own name.
pub(super) fn text(command: &str) -> &'static str {
    TEXTS.iter().find(|(name, _)| *name == command).map_or(AFTER, |(_, text)| text)
}

/// Puts the longer texts below the help of all commands, and colours on them.
pub(super) fn dressed(mut command: clap::Command) -> clap::Command {
    let whole = format!("{AFTER}\n\n{EXIT_CODES}");
    command = command.styles(styles()).after_help(styled(&whole));
    for (name, text) in TEXTS {
        command = command.mut_subcommand(name, |sub| sub.after_help(styled(text)));
    }
    command
}

/// Colours of the help; terminals only.
fn styles() -> clap::builder::Styles {
    let colour = |colour: AnsiColor| colour.on_default();
    clap::builder::Styles::styled()
        .header(Style::new().bold())
        .usage(Style::new().bold())
        .literal(colour(AnsiColor::Cyan).bold())
        .placeholder(colour(AnsiColor::Cyan))
        .error(colour(AnsiColor::Red).bold())
        .invalid(colour(AnsiColor::Yellow))
        .valid(colour(AnsiColor::Green))
}

/// A longer text whose headings and commands have the styles of the rest of the help.
fn styled(text: &str) -> clap::builder::StyledStr {
    let styles = styles();
    let mut shown = String::new();
    for (number, line) in text.lines().enumerate() {
        // The line break stands within the style: what breaks long lines begins to count there.
        let begin = if number > 0 { "\n" } else { "" };
        let style = if line.ends_with(':') && !line.starts_with(' ') {
            styles.get_header()
        } else if line.starts_with("  slopegen") {
            styles.get_literal()
        } else {
            &Style::new()
        };
        // Writing to a String cannot fail.
        let _ = write!(shown, "{style}{begin}{line}{style:#}");
    }
    shown.into()
}
