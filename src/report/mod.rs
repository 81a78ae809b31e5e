//! What a run has to tell: as data ([`Report`]), as JSON for machines, as text, Markdown and as a page for people, its rows as
//! tables.

pub mod batch;
pub mod between;
pub mod build;
pub mod check;
pub mod common;
pub mod diff;
pub mod ground;
pub mod html;
pub mod info;
pub mod json;
mod page;
pub mod result;
pub mod schema;
pub mod selftest;
pub mod tables;
pub mod text;
pub mod verify;
pub mod volumes;

#[cfg(test)]
mod testing;

pub use batch::{BATCH_SCHEMA, BatchReport, JobResult, JobRow, JobVolumes, render_batch};
pub use between::BetweenReport;
pub use build::*;
pub use check::{CHECK_SCHEMA, CheckReport, Checked, render_check, render_check_markdown};
pub use common::*;
pub use diff::{DIFF_SCHEMA, DiffReport, render_diff};
pub use ground::{
    Daylight, EndArea, FinishedFigures, GroundAreas, PadRow, SectionRow, SectionSlopes, SlopeRange, StationRow, TerrainFigures,
    ThreeSections, station_rows,
};
pub use info::{INFO_SCHEMA, InfoReport, render_info};
pub use json::write_json;
pub use result::{Options, OutputFile, ResultFigures, RunRecord, platform};
pub use selftest::{CaseRow, FigureRow, HashRow, SELFTEST_SCHEMA, SelftestReport, render_selftest};
pub use tables::write_station_table;
pub use text::{write_between, write_between_markdown, write_markdown, write_text};
pub use verify::{Verified, render_verified};
pub use volumes::{
    Balance, BulkingFigures, CutFillFigures, DepthPlace, Depths, METHOD, METHOD_TEXT, Reference, SIGN_RULE, VolumeParts, Volumes,
};

use crate::plot::Scene;
use crate::write::{EncodeError, Target, UnknownFormat, ending};
use std::io::Write;

/// The formats a report can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportFormat {
    /// Schema `slopegen-report/1`.
    Json,
    /// For people.
    Text,
    /// The same for those who publish it.
    Markdown,
    /// For people with a browser: one page with drawings, that needs nothing else.
    Html,
}

impl ReportFormat {
    /// The format of a target: by the ending of its name, upper or lower case. Standard output and existing devices and pipes
    /// whose names end in none of them take text.
    ///
    /// # Errors
    /// [`UnknownFormat`] for any other ending, or none.
    pub fn of(target: &Target) -> Result<Self, UnknownFormat> {
        let Target::File(path) = target else { return Ok(Self::Text) };
        match ending(path).as_deref() {
            Some("json") => Ok(Self::Json),
            Some("txt") => Ok(Self::Text),
            Some("md" | "markdown") => Ok(Self::Markdown),
            Some("html" | "htm") => Ok(Self::Html),
            _ if target.is_stream() => Ok(Self::Text),
            _ => Err(UnknownFormat { what: "report", path: path.clone(), known: "`.json`, `.txt`, `.md` or `.html`" }),
        }
    }

    /// Whether it shows the scene, not only figures.
    pub fn draws(self) -> bool {
        self == Self::Html
    }

    /// Writes a report in this format; the page draws `scene`, with cross-sections at `sections` or, without any, where it sees
    /// fit.
    ///
    /// # Errors
    /// As [`write_json`], [`write_text`] and [`html::write_html`].
    pub fn write(
        self,
        out: &mut (impl Write + ?Sized),
        report: &Report,
        scene: &Scene<'_>,
        sections: &[f64],
    ) -> Result<(), EncodeError> {
        match self {
            Self::Json => write_json(out, report),
            Self::Text => write_text(out, report),
            Self::Markdown => write_markdown(out, report),
            Self::Html => html::write_html(out, report, scene, sections),
        }
    }

    /// Writes a report that is JSON or else text.
    ///
    /// # Errors
    /// As [`write_json`].
    pub fn write_plain(
        self,
        out: &mut (impl Write + ?Sized),
        report: &impl serde::Serialize,
        text: impl FnOnce() -> String,
    ) -> Result<(), EncodeError> {
        if self == Self::Json { write_json(out, report) } else { Ok(out.write_all(text().as_bytes())?) }
    }

    /// Writes the report of a comparison in this format.
    ///
    /// # Errors
    /// As [`write_json`], [`write_between`] and [`html::write_between_html`].
    pub fn write_between(self, out: &mut (impl Write + ?Sized), report: &BetweenReport) -> Result<(), EncodeError> {
        match self {
            Self::Json => write_json(out, report),
            Self::Text => write_between(out, report),
            Self::Markdown => write_between_markdown(out, report),
            Self::Html => html::write_between_html(out, report),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_names_the_format() {
        let of = |name: &str| ReportFormat::of(&Target::File(name.into()));
        assert_eq!(of("r.JSON"), Ok(ReportFormat::Json));
        assert_eq!(of("r.txt"), Ok(ReportFormat::Text));
        assert_eq!(of("r.Html"), Ok(ReportFormat::Html));
        assert_eq!(of("r.Md"), Ok(ReportFormat::Markdown));
        assert_eq!(ReportFormat::of(&Target::Stdout), Ok(ReportFormat::Text));
        assert_eq!(
            of("r.pdf").unwrap_err().to_string(),
            "no format is known for the ending `.pdf`\n  --> r.pdf\n   = help: end the name of a report in `.json`, `.txt`, `.md` or \
             `.html`"
        );
    }

    #[test]
    fn the_word_for_net() {
        for (cut, fill, expected) in [
            (2.0, 1.0, Balance::Surplus),
            (1.0, 2.0, Balance::Deficit),
            (0.0, 0.0, Balance::Balanced),
            (1e6, 1e6 + 1e-4, Balance::Balanced),
            (1e6, 1e6 + 1e-2, Balance::Deficit),
            (1e-12, 0.0, Balance::Surplus),
        ] {
            assert_eq!(Balance::of(cut, fill), expected, "{cut} {fill}");
        }
    }
}
