//! The page around the sections: head, table of contents, foot.

use super::view::View;
use crate::model::message::printable;
use crate::plot;
use crate::report::page::NOTE;
use crate::report::{Tool, Warning, WarningKind};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sha2::{Digest as _, Sha256};

/// The style sheet.
const STYLE: &str = include_str!("page.css");
/// The script of the 3D view, the only one.
const VIEWER: &str = include_str!("viewer.js");

/// A part of a page.
pub(super) struct Section {
    /// Its place in the page, unique.
    pub(super) id: &'static str,
    /// Heading, also in the table of contents.
    pub(super) title: &'static str,
    /// What follows the heading.
    pub(super) body: Markup,
}

/// A page.
pub(super) struct Page<'a> {
    /// What kind of report it is, above the title.
    pub(super) kind: &'static str,
    /// The title: name of the job.
    pub(super) title: &'a str,
    /// Verdict and key figures.
    pub(super) summary: Markup,
    /// What the reader should know.
    pub(super) warnings: &'a [Warning],
    /// All that follows.
    pub(super) sections: Vec<Section>,
    /// Data of the 3D view; the script is there only with it.
    pub(super) view: Option<&'a View>,
    /// The program.
    pub(super) tool: &'a Tool,
}

impl Page<'_> {
    /// The whole document.
    pub(super) fn render(&self) -> String {
        let title = printable(self.title);
        // Nothing may be fetched, and no script may run but the one whose hash stands here.
        let script = self
            .view
            .map_or_else(|| "'none'".to_owned(), |_| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(VIEWER.as_bytes()))));
        let policy = format!(
            "default-src 'none'; style-src 'unsafe-inline'; script-src {script}; img-src data:; base-uri 'none'; form-action 'none'"
        );
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(policy);
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    meta name="generator" content={ (self.tool.name) " " (self.tool.version) };
                    title { (title) " · " (self.kind) }
                    link rel="icon" href="data:,";
                    style { (PreEscaped(STYLE)) (PreEscaped(plot::css())) }
                }
                body {
                    header {
                        p.kind { (self.kind) }
                        h1 { (title) }
                        (self.summary)
                        p.soft.small { (NOTE) }
                    }
                    nav aria-label="Contents" {
                        ol {
                            @if weighty(self.warnings) > 0 { li { a href="#warnings" { "Warnings" } } }
                            @for section in &self.sections { li { a href={ "#" (section.id) } { (section.title) } } }
                            @if self.warnings.len() > weighty(self.warnings) { li { a href="#notes" { "Notes" } } }
                        }
                    }
                    main {
                        @if weighty(self.warnings) > 0 {
                            section.warnings id="warnings" aria-labelledby="warnings-title" {
                                h2 id="warnings-title" { "Warnings" }
                                (listed(self.warnings, WarningKind::Warning))
                            }
                        }
                        @for section in &self.sections {
                            section id=(section.id) aria-labelledby={ (section.id) "-title" } {
                                h2 id={ (section.id) "-title" } { (section.title) }
                                (section.body)
                            }
                        }
                        @if self.warnings.len() > weighty(self.warnings) {
                            section.notes id="notes" aria-labelledby="notes-title" {
                                h2 id="notes-title" { "Notes" }
                                (listed(self.warnings, WarningKind::Note))
                            }
                        }
                    }
                    footer {
                        p {
                            "Made by " (self.tool.name) " " (self.tool.version) " from the files named under "
                            a href="#inputs" { "Inputs" }
                            ". The same inputs and options give the same page, byte for byte."
                        }
                        p {
                            strong { "Before setting out or settling an account " }
                            "check control, datum, units and date of the survey: the figures are exact for the files, and say nothing about \
                             whether these show the site as it is."
                        }
                    }
                    @if let Some(view) = self.view {
                        script type="application/json" id="mesh" { (PreEscaped(&view.data)) }
                        script { (PreEscaped(VIEWER)) }
                    }
                }
            }
        };
        page.into_string()
    }
}

/// Number of those that are about the result.
fn weighty(warnings: &[Warning]) -> usize {
    warnings.iter().filter(|warning| warning.kind == WarningKind::Warning).count()
}

/// How many warnings there are, and where: an entry of the marks at the top, if there are any.
pub(super) fn noted(warnings: &[Warning]) -> Markup {
    let count = weighty(warnings);
    html! {
        @if count > 0 {
            li.warn { a href="#warnings" { (count) @if count == 1 { " warning" } @else { " warnings" } } }
        }
    }
}

fn listed(warnings: &[Warning], kind: WarningKind) -> Markup {
    html! {
        ul {
            @for warning in warnings.iter().filter(|warning| warning.kind == kind) {
                li {
                    pre { @for (i, line) in warning.message.lines().enumerate() { @if i > 0 { "\n" } (printable(line)) } }
                    code.soft.small { (printable(&warning.code)) }
                }
            }
        }
    }
}
