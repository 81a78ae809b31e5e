//! Readers of lines and points.

use super::choices::Choices;
use super::messages::telling;
use super::written;
use slopegen::model::{LengthUnit, Role};
use slopegen::read::{self, ColumnOrder, InputFormat, Pick, RawInput, ReadOptions};
use slopegen::validate::{self, Checked, Options};

const LABEL: &str = "a";

/// Column orders to choose from; the first: none.
const ORDERS: [&str; 8] = ["", "xyz", "yxz", "pnezd", "lenz_", "xy", "_xyzl", "zyx"];

fn order(choices: &mut Choices<'_>) -> Option<ColumnOrder> {
    choices.of(&ORDERS).parse().ok()
}

/// The first bytes are options, the rest is the file.
pub(crate) fn read(bytes: &[u8], format: InputFormat) {
    let mut choices = Choices::new(bytes);
    let flags = choices.byte();
    let csv_order = order(&mut choices);
    let named = |bit: u8, name: &str| if flags & bit != 0 { vec![name.to_owned()] } else { Vec::new() };
    let dxf = format == InputFormat::Dxf;
    let pick = Pick { features: named(1, "a"), layers: if dxf { named(2, "0") } else { Vec::new() }, ..Pick::default() };
    let unit =
        [None, Some(LengthUnit::Metre), Some(LengthUnit::Foot), Some(LengthUnit::UsSurveyFoot)][usize::from(flags >> 2 & 3)];
    let options = ReadOptions { format: Some(format), csv_order, pick, unit, ..ReadOptions::default() };
    let closed = flags & 16 != 0;
    let file = choices.rest();
    if format == InputFormat::Csv {
        points(file, options.csv_order.as_ref());
    }
    match read::parse_line(LABEL, file, &options) {
        Err(error) => telling(&error.to_string()),
        Ok(raw) => look(&raw, file, closed),
    }
}

fn points(file: &[u8], order: Option<&ColumnOrder>) {
    match read::parse_points(LABEL, file, order) {
        Err(error) => telling(&error.to_string()),
        Ok(read) => {
            assert!(!read.points.is_empty());
            let rows = rows_of(file);
            assert!(read.points.iter().all(|p| p.x.is_finite() && p.y.is_finite() && (1..=rows).contains(&p.row)));
        }
    }
}

/// Rows a text can have at most, whatever its encoding and its ends of lines.
fn rows_of(file: &[u8]) -> u32 {
    file.iter().filter(|b| matches!(b, b'\n' | b'\r')).count() as u32 + 1
}

fn look(raw: &RawInput, file: &[u8], closed: bool) {
    assert_eq!(raw.source.bytes, file.len() as u64);
    assert!(!raw.lines.is_empty(), "nothing was read, and nothing said");
    let rows = rows_of(file);
    for line in &raw.lines {
        assert!(line.vertices.iter().all(|v| v.row.is_none_or(|row| (1..=rows).contains(&row))));
    }
    match validate::check(raw, &Options { closed }) {
        Err(defects) => telling(&defects.to_string()),
        Ok(checked) => {
            invariants(raw, &checked);
            written::lines_again(&checked);
        }
    }
}

/// Those that `Chain` and `Breakline` promise.
fn invariants(raw: &RawInput, checked: &Checked) {
    assert!(!checked.line.chains.is_empty());
    let longest = raw.lines.iter().map(|l| l.vertices.len()).max().unwrap_or(0) as u32;
    for chain in &checked.line.chains {
        let n = chain.vertices.len();
        assert!(n >= if chain.closed() { 3 } else { 2 });
        assert_eq!(n, chain.places.len());
        assert!(chain.vertices.iter().all(|v| v.is_finite() && v.abs().max_element() <= validate::INPUT_LIMIT));
        assert!(chain.places.iter().all(|p| (1..=longest).contains(&p.vertex)));
        assert!(matches!(chain.role, Role::Open) || chain.closed());
        for i in 0..chain.segment_count() {
            let (a, b) = chain.segment(i);
            assert!(a.truncate().distance(b.truncate()) > 0.99 * validate::MERGE_DISTANCE, "{a} {b}");
        }
    }
    for line in &checked.line.breaklines {
        assert!(!line.vertices.is_empty() && line.vertices.len() == line.places.len());
        assert!(line.vertices.iter().all(|v| v.is_finite() && v.abs().max_element() <= validate::INPUT_LIMIT));
    }
}
