//! Numbers and tables of the pages.

pub(super) use crate::model::digits::typeset as plain;
use crate::model::message::printable;
use crate::report::Input;
use maud::{Markup, html};

/// Digits before the point from which on they are grouped by threes.
const GROUPED: usize = 5;

/// A figure with thousands set apart. The gaps are of the style, not of the text: copied figures have none.
pub(super) fn number(value: f64, decimals: usize) -> Markup {
    let text = plain(value, decimals);
    let (sign, text) = text.strip_prefix('−').map_or(("", text.as_str()), |rest| ("−", rest));
    let (whole, rest) = text.find('.').map_or((text, ""), |dot| text.split_at(dot));
    html! { (sign) (grouped(whole)) (rest) }
}

/// A whole number with thousands set apart.
pub(super) fn count(count: usize) -> Markup {
    grouped(&count.to_string())
}

fn grouped(digits: &str) -> Markup {
    let first = if digits.len() < GROUPED { digits.len() } else { (digits.len() - 1) % 3 + 1 };
    html! {
        (digits.get(..first).unwrap_or(digits))
        @for group in digits.as_bytes().get(first..).unwrap_or_default().chunks(3) {
            span.d { (String::from_utf8_lossy(group)) }
        }
    }
}

/// A row of a list of facts.
pub(super) struct Fact {
    name: Markup,
    value: Markup,
    under: bool,
}

impl Fact {
    pub(super) fn new(name: &str, value: Markup) -> Self {
        Self { name: html! { (name) }, value, under: false }
    }

    /// A part of the one above.
    pub(super) fn under(name: &str, value: Markup) -> Self {
        Self { under: true, ..Self::new(name, value) }
    }
}

/// Lengths, areas and volumes with their unit.
#[derive(Clone, Copy)]
pub(super) struct Units<'a>(pub(super) &'a str);

impl Units<'_> {
    pub(super) fn length(self, value: f64) -> Markup {
        html! { (number(value, 3)) " " (self.0) }
    }

    pub(super) fn area(self, value: f64) -> Markup {
        html! { (number(value, 2)) " " (self.0) "²" }
    }

    pub(super) fn volume(self, value: f64) -> Markup {
        html! { (number(value, 2)) " " (self.0) "³" }
    }
}

/// A table of names and values.
pub(super) fn facts(caption: &str, rows: &[Fact]) -> Markup {
    html! {
        div.scroll {
            table.facts {
                caption { (caption) }
                tbody {
                    @for row in rows {
                        tr { th.in[row.under] scope="row" { (row.name) } td.n { (row.value) } }
                    }
                }
            }
        }
    }
}

/// The name of a job: that of its first input, without folders.
pub(super) fn title(inputs: &[Input]) -> &str {
    match inputs.first().map_or("", |input| input.path.as_str()) {
        "-" => "standard input",
        path => path.rsplit(['/', '\\']).next().unwrap_or(path),
    }
}

/// Text from a file.
pub(super) fn name(text: &str) -> Markup {
    html! { (printable(text)) }
}

/// A depth's place.
pub(super) fn point(x: f64, y: f64, z: Option<f64>) -> String {
    let z = z.map_or_else(String::new, |z| format!(", elevation {}", plain(z, 3)));
    format!("E {}, N {}{z}", plain(x, 3), plain(y, 3))
}

/// Heading of a table of depths.
pub(super) fn depths_head() -> Markup {
    html! {
        thead { tr { th scope="col" { "Depth" } th.n scope="col" { "Greatest" } th.n scope="col" { "Mean" }
            th scope="col" { "Place of the greatest" } } }
    }
}

/// A row of it.
pub(super) fn depths_row(title: &str, class: &str, most: f64, mean: Option<f64>, place: &Markup, units: Units<'_>) -> Markup {
    html! {
        tr {
            th.(class) scope="row" { (title) } td.n { (units.length(most)) }
            td.n { @if let Some(mean) = mean { (units.length(mean)) } } td.w { (place) }
        }
    }
}

/// The files read.
pub(super) fn inputs(inputs: &[Input]) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Files read" {
            table {
                caption { "The files read, with the SHA-256 of their bytes: the same digits, the same file" }
                thead {
                    tr { th scope="col" { "Used for" } th scope="col" { "File" } th scope="col" { "Format" }
                        th.n scope="col" { "Bytes" } th scope="col" { "Coordinate system" } th scope="col" { "SHA-256" } }
                }
                tbody {
                    @for input in inputs {
                        tr {
                            th scope="row" { (name(&input.role)) }
                            td.p { @if input.path == "-" { "standard input" } @else { (name(&input.path)) } }
                            td { (name(&input.format)) }
                            td.n { (input.bytes) }
                            td { @if let Some(crs) = &input.crs { (name(crs)) } @else { span.soft { "not given" } } }
                            td.w { code { (name(&input.sha256)) } }
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_those_of_the_report() {
        for (value, decimals, expected) in
            [(0.0, 2, "0.00"), (-0.004, 2, "0.00"), (-0.006, 2, "−0.01"), (1234.5, 2, "1234.50"), (-12_345.678, 1, "−12345.7")]
        {
            assert_eq!(plain(value, decimals), expected);
        }
    }

    #[test]
    fn thousands_stand_apart_without_a_character() {
        let text = |markup: Markup| {
            let html = markup.into_string();
            (html.matches("<span").count(), html.replace("<span class=\"d\">", "").replace("</span>", ""))
        };
        assert_eq!(text(number(9999.5, 1)), (0, "9999.5".into()));
        assert_eq!(text(number(-12_345.678, 2)), (1, "−12345.68".into()));
        assert_eq!(number(-12_345.678, 2).into_string(), "−12<span class=\"d\">345</span>.68");
        assert_eq!(text(count(1_234_567)), (2, "1234567".into()));
        assert_eq!(text(count(0)), (0, "0".into()));
        assert_eq!(text(number(123_456.0, 0)), (1, "123456".into()));
    }
}
