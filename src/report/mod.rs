//! What a run has to tell: as data ([`Report`]), as JSON for machines, as text and Markdown for people, its rows as tables.

pub mod between;
pub mod check;
pub mod ground;
pub mod json;
pub mod model;
mod page;
pub mod schema;
pub mod tables;
pub mod text;
pub mod volumes;

#[cfg(test)]
mod testing;

pub use between::BetweenReport;
pub use check::{CHECK_SCHEMA, CheckReport, Checked, render_check, render_check_markdown};
pub use ground::{
    Daylight, EndArea, FinishedFigures, GroundAreas, PadRow, SectionRow, SectionSlopes, SlopeRange, StationRow, TerrainFigures,
    ThreeSections, station_rows,
};
pub use json::write_json;
pub use model::*;
pub use tables::write_station_table;
pub use text::{write_between, write_between_markdown, write_markdown, write_text};
pub use volumes::{
    Balance, BulkingFigures, CutFillFigures, DepthPlace, Depths, METHOD, METHOD_TEXT, Reference, SIGN_RULE, VolumeParts, Volumes,
};

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
            _ if target.is_stream() => Ok(Self::Text),
            _ => Err(UnknownFormat { what: "report", path: path.clone(), known: "`.json`, `.txt` or `.md`" }),
        }
    }

    /// Writes a report in this format.
    ///
    /// # Errors
    /// As [`write_json`] and [`write_text`].
    pub fn write(self, out: &mut (impl Write + ?Sized), report: &Report) -> Result<(), EncodeError> {
        match self {
            Self::Json => write_json(out, report),
            Self::Text => write_text(out, report),
            Self::Markdown => write_markdown(out, report),
        }
    }

    /// Writes the report of a comparison in this format.
    ///
    /// # Errors
    /// As [`write_json`] and [`write_between`].
    pub fn write_between(self, out: &mut (impl Write + ?Sized), report: &BetweenReport) -> Result<(), EncodeError> {
        match self {
            Self::Json => write_json(out, report),
            Self::Text => write_between(out, report),
            Self::Markdown => write_between_markdown(out, report),
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
        assert_eq!(of("r.Md"), Ok(ReportFormat::Markdown));
        assert_eq!(ReportFormat::of(&Target::Stdout), Ok(ReportFormat::Text));
        assert_eq!(
            of("r.pdf").unwrap_err().to_string(),
            "no format is known for the ending `.pdf`\n  --> r.pdf\n   = help: end the name of a report in `.json`, `.txt` or `.md`"
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
