//! The report for machines.

use crate::write::EncodeError;
use serde::Serialize;
use serde_json::Value;
use std::io::Write;

/// Writes a report as indented JSON, with a line break at the end.
///
/// # Errors
/// [`EncodeError::ReportNotFinite`] names the first figure that is NaN or infinite, and nothing is written;
/// [`EncodeError::Report`] from the sink.
pub fn write_json(out: &mut (impl Write + ?Sized), report: &impl Serialize) -> Result<(), EncodeError> {
    all_finite(report)?;
    serde_json::to_writer_pretty(&mut *out, report)?;
    writeln!(out)?;
    Ok(())
}

/// Refuses reports with a figure that is NaN or infinite.
///
/// # Errors
/// [`EncodeError::ReportNotFinite`] names the first.
pub(super) fn all_finite(report: &impl Serialize) -> Result<(), EncodeError> {
    // JSON has no NaN: serde_json turns it into null. No key of a report is ever null on purpose.
    match first_null(&serde_json::to_value(report)?, "") {
        Some(path) => Err(EncodeError::ReportNotFinite(path)),
        None => Ok(()),
    }
}

/// Dotted path of the first null, such as `line.buried[2].depth`; `path` leads to `value`.
fn first_null(value: &Value, path: &str) -> Option<String> {
    match value {
        Value::Null => Some(path.to_owned()),
        Value::Array(items) => items.iter().enumerate().find_map(|(i, item)| first_null(item, &format!("{path}[{i}]"))),
        Value::Object(items) => items.iter().find_map(|(key, item)| {
            let dot = if path.is_empty() { "" } else { "." };
            first_null(item, &format!("{path}{dot}{key}"))
        }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::testing::{compare, full, least, on_ground};
    use crate::report::{Detail, Report};

    fn json(report: &Report) -> String {
        let mut bytes = Vec::new();
        write_json(&mut bytes, report).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn a_full_report_is_pinned() {
        compare(&json(&full()), include_str!("../../tests/golden/report.json"), "report.json");
    }

    #[test]
    fn a_full_report_on_ground_is_pinned() {
        compare(&json(&on_ground()), include_str!("../../tests/golden/report_ground.json"), "report_ground.json");
    }

    #[test]
    fn a_full_comparison_is_pinned() {
        let write = |report| {
            let mut bytes = Vec::new();
            write_json(&mut bytes, &report).unwrap();
            String::from_utf8(bytes).unwrap()
        };
        let golden = include_str!("../../tests/golden/between.json");
        crate::report::testing::compare(&write(crate::report::between::testing::full()), golden, "between.json");
        let least = write(crate::report::between::testing::least());
        for key in ["\"run\"", "\"result\"", "\"cells\"", "_at", "within", "path\": \"site", "null"] {
            assert!(!least.contains(key), "{key} in {least}");
        }
    }

    #[test]
    fn keys_that_do_not_apply_are_left_out() {
        let text = json(&least());
        for key in [
            "crs", "cut\":", "volumes", "depths", "areas", "daylight", "stations", "pads", "terrain", "finished", "section",
            "null",
        ] {
            assert!(!text.contains(key), "{key} in {text}");
        }
        assert!(text.ends_with("}\n"));
    }

    #[test]
    fn a_figure_that_is_none_is_named() {
        let refuse = |change: fn(&mut Report)| {
            let mut report = full();
            change(&mut report);
            let mut bytes = Vec::new();
            let error = write_json(&mut bytes, &report).unwrap_err();
            assert!(bytes.is_empty());
            error.to_string()
        };
        let expected = |path: &str| format!("report figure `{path}` is not a finite number; this is a bug in the program");
        assert_eq!(refuse(|r| r.certificate.height_max_deviation = f64::NAN), expected("certificate.height_max_deviation"));
        assert_eq!(refuse(|r| r.line.buried[1].depth = f64::INFINITY), expected("line.buried[1].depth"));
        assert_eq!(refuse(|r| r.levels[2] = f64::NAN), expected("levels[2]"));
        assert_eq!(refuse(|r| r.extent.value = Some(f64::NAN)), expected("extent.value"));
        assert_eq!(
            refuse(|r| drop(r.warnings[0].details.insert("depth", Detail::Number(f64::NAN)))),
            expected("warnings[0].depth")
        );
    }
}
