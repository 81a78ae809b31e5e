//! Reports of this program, read back.

use super::ReadError;
use super::error::refuse;
use serde_json::Value;
use std::io::Read as _;
use std::path::Path;

/// What the schemas of all reports begin with.
const FAMILY: &str = "slopegen-";

/// A report as read.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Path as given.
    pub label: String,
    /// Its length in bytes.
    pub bytes: u64,
    /// SHA-256 of the bytes, in lower-case hexadecimal digits.
    pub sha256: String,
    /// Name and version of its keys, such as `slopegen-report/1`.
    pub schema: String,
    /// All of it.
    pub value: Value,
}

/// Reads a file if it is a report of this program; `None` if it is something else, whatever its name.
///
/// # Errors
/// [`ReadError`] when the file cannot be opened, or is cut off or changed so that it is no JSON any more.
pub fn read_document(path: &Path) -> Result<Option<Document>, ReadError> {
    let label = path.display().to_string();
    let open = |cause| ReadError::Open { label: label.clone(), cause };
    let mut file = std::fs::File::open(path).map_err(open)?;
    // Ground may be large, and is looked at no further.
    let mut bytes = Vec::new();
    file.by_ref().take(HEAD as u64).read_to_end(&mut bytes).map_err(open)?;
    if !may_be_report(&bytes) {
        return Ok(None);
    }
    file.read_to_end(&mut bytes).map_err(open)?;
    parse_document(&label, &bytes)
}

/// Bytes at the beginning that have the schema of a report: it is the first key.
const HEAD: usize = 200;

fn may_be_report(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]);
    let begins = head.trim_start_matches('\u{feff}').trim_start().starts_with('{');
    begins && head.contains("\"schema\"") && head.contains(FAMILY)
}

/// Reads a report from bytes; `label` names them in messages.
///
/// # Errors
/// As [`read_document`].
pub fn parse_document(label: &str, bytes: &[u8]) -> Result<Option<Document>, ReadError> {
    if !may_be_report(bytes) {
        return Ok(None);
    }
    let bytes_of_json = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let value: Value = serde_json::from_slice(bytes_of_json).map_err(|cause| {
        let at = format!("{label}, line {}, column {}", cause.line(), cause.column());
        refuse("the report is damaged", at, cause.to_string(), "write it again, with the command that made it")
    })?;
    let Some(schema) = value.get("schema").and_then(Value::as_str).filter(|schema| schema.starts_with(FAMILY)) else {
        return Ok(None);
    };
    Ok(Some(Document {
        label: label.to_owned(),
        bytes: bytes.len() as u64,
        sha256: super::sha256(bytes),
        schema: schema.to_owned(),
        value,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_are_told_from_other_files() {
        let of = |text: &str| parse_document("a.json", text.as_bytes());
        let report = of("\u{feff} {\"schema\": \"slopegen-report/1\", \"volumes\": {\"cut\": 1.5}}").unwrap().unwrap();
        assert_eq!((report.schema.as_str(), report.value["volumes"]["cut"].as_f64()), ("slopegen-report/1", Some(1.5)));
        for other in
            ["", "{}", "{\"type\": \"Feature\"}", "v 0 0 0", "{\"schema\": \"other/1\"}", "{\"schema\": 1, \"a\": \"slopegen-\"}"]
        {
            assert_eq!(of(other).unwrap(), None, "{other}");
        }
        let error = of("{\"schema\": \"slopegen-report/1\", \"volumes\": {").unwrap_err().to_string();
        assert!(error.starts_with("the report is damaged\n  --> a.json, line 1, column "), "{error}");
        // Nesting is bounded by the parser.
        assert!(of(&format!("{{\"schema\": \"slopegen-report/1\", \"a\": {}", "[".repeat(100_000))).is_err());
    }
}
