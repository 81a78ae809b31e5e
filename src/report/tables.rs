//! Rows of a report as tables for spreadsheets: CSV after RFC 4180 but with plain line feeds, UTF-8, a header, all digits,
//! a point before decimals.
//!
//! Names of columns are those of the JSON report, keys within keys joined by `_`. A figure that does not apply is an empty field,
//! so that the columns are always the same.

use super::{PadRow, Report, StationRow};
use crate::write::{EncodeError, push_field, push_figure};
use std::io::Write;

/// Columns of the table of stations. The unit is that of lengths; areas are in its square, volumes in its cube.
pub const STATION_COLUMNS: [&str; 26] = [
    "chain",
    "unit",
    "from",
    "to",
    "cut",
    "fill",
    "cut_area",
    "fill_area",
    "net_cumulative",
    "net_cumulative_compacted",
    "section_from_cut",
    "section_from_fill",
    "section_from_left",
    "section_from_right",
    "section_middle_cut",
    "section_middle_fill",
    "section_middle_left",
    "section_middle_right",
    "section_to_cut",
    "section_to_fill",
    "section_to_left",
    "section_to_right",
    "average_end_area_cut",
    "average_end_area_fill",
    "prismoidal_cut",
    "prismoidal_fill",
];

/// Writes one row for every row of `stations`; `pads` follow as a row without chain and stations, so that `cut` and `fill` add up
/// to the volumes.
///
/// # Errors
/// [`EncodeError::ReportNotFinite`] names a figure that is NaN or infinite; [`EncodeError::Io`] from the sink.
pub fn write_station_table(out: &mut (impl Write + ?Sized), report: &Report) -> Result<(), EncodeError> {
    let unit = report.units.length;
    let mut bytes = (STATION_COLUMNS.join(",") + "\n").into_bytes();
    let rows = report.stations.iter().flatten().map(|row| (row.chain.as_str(), figures(row)));
    for (number, (chain, figures)) in rows.chain(report.pads.iter().map(|pads| ("", pad(pads)))).enumerate() {
        push_field(&mut bytes, chain);
        bytes.push(b',');
        bytes.extend_from_slice(unit.as_bytes());
        for (name, figure) in STATION_COLUMNS[2..].iter().zip(figures) {
            bytes.push(b',');
            match figure {
                Some(figure) if !figure.is_finite() => {
                    return Err(EncodeError::ReportNotFinite(format!("stations[{number}].{name}")));
                }
                Some(figure) => push_figure(&mut bytes, figure),
                None => {}
            }
        }
        bytes.push(b'\n');
    }
    out.write_all(&bytes)?;
    Ok(())
}

/// Figures of a row in the order of the columns.
fn figures(row: &StationRow) -> Vec<Option<f64>> {
    let mut figures = [row.from, row.to, row.cut, row.fill, row.cut_area, row.fill_area, row.net_cumulative].map(Some).to_vec();
    figures.push(row.net_cumulative_compacted);
    match &row.sections {
        Some(seen) => {
            let ends = [seen.section.from, seen.section.middle, seen.section.to];
            figures.extend(ends.iter().flat_map(|end| [end.cut, end.fill, end.left, end.right]).map(Some));
            figures
                .extend([seen.average_end_area, seen.prismoidal].iter().flat_map(|volume| [volume.cut, volume.fill]).map(Some));
        }
        None => figures.resize(STATION_COLUMNS.len() - 2, None),
    }
    figures
}

fn pad(pads: &PadRow) -> Vec<Option<f64>> {
    let mut figures = vec![None, None];
    figures.extend([pads.cut, pads.fill, pads.cut_area, pads.fill_area].map(Some));
    figures.resize(STATION_COLUMNS.len() - 2, None);
    figures
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::testing::{compare, full, on_ground};
    use serde_json::Value;

    fn table(report: &Report) -> String {
        let mut bytes = Vec::new();
        write_station_table(&mut bytes, report).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn the_table_is_pinned() {
        compare(&table(&on_ground()), include_str!("../../tests/golden/stations.csv"), "stations.csv");
    }

    /// Every figure of the JSON report is in the column of its name, to the last bit, and no other column has anything.
    #[test]
    fn columns_are_the_keys_of_the_json_report() {
        let mut report = on_ground();
        report.stations.as_mut().unwrap()[1].chain = "a \"b\", c\nd".into();
        report.stations.as_mut().unwrap()[0].sections = None;
        let text = table(&report);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().unwrap().clone();
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        let json = serde_json::to_value(&report).unwrap();
        let stations = json["stations"].as_array().unwrap();
        assert_eq!(rows.len(), stations.len() + 1);
        for (row, station) in rows.iter().zip(stations.iter().chain([&json["pads"]])) {
            let mut flat = vec![("unit".to_owned(), Value::from("m"))];
            flatten("", station, &mut flat);
            let filled = row.iter().filter(|field| !field.is_empty()).count();
            assert_eq!(filled, flat.len(), "{row:?}");
            for (key, value) in flat {
                let field = &row[header.iter().position(|name| name == key).unwrap_or_else(|| panic!("no column {key}"))];
                match value {
                    Value::String(text) => assert_eq!(field, text),
                    value => assert_eq!(field.parse::<f64>().unwrap(), value.as_f64().unwrap(), "{key}"),
                }
            }
        }
    }

    fn flatten(path: &str, value: &Value, flat: &mut Vec<(String, Value)>) {
        match value {
            Value::Object(keys) => {
                let join = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}_{key}") };
                keys.iter().for_each(|(key, value)| flatten(&join(key), value, flat));
            }
            other => flat.push((path.to_owned(), other.clone())),
        }
    }

    #[test]
    fn rows_add_up_to_the_volumes() {
        let report = on_ground();
        let text = table(&report);
        let sum = |column: usize| -> f64 {
            text.lines().skip(1).map(|line| line.split(',').nth(column).unwrap().parse::<f64>().unwrap()).sum()
        };
        let volumes = report.volumes.unwrap();
        assert!((sum(4) - volumes.cut).abs() < 1e-9 && (sum(5) - volumes.fill).abs() < 1e-9);
    }

    #[test]
    fn without_stations_there_is_a_header() {
        assert_eq!(table(&full()), STATION_COLUMNS.join(",") + "\n");
    }

    #[test]
    fn no_figure_is_lost_in_silence() {
        let mut report = on_ground();
        report.stations.as_mut().unwrap()[2].fill = f64::NAN;
        let error = write_station_table(&mut Vec::new(), &report).unwrap_err();
        assert!(error.to_string().contains("`stations[2].fill`"), "{error}");
    }
}
