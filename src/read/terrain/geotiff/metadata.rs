//! What GDAL adds to a GeoTIFF: scale, offset and unit of heights, and the value that stands for none.

use super::super::geokeys::Unit;
use quick_xml::Reader;
use quick_xml::events::Event;

/// Most bytes of metadata that are looked at.
const MOST_BYTES: usize = 1 << 20;

/// How stored values become heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Metadata {
    /// Heights are value · scale + offset.
    pub(super) scale: f64,
    pub(super) offset: f64,
    /// Their unit, where it is one that is known.
    pub(super) unit: Unit,
}

impl Metadata {
    /// From the XML of the tag `GDAL_METADATA`; what cannot be understood says nothing.
    pub(super) fn read(text: &[u8]) -> Self {
        let mut found = Self { scale: 1.0, offset: 0.0, unit: Unit::Unsaid };
        let text = text.split(|b| *b == 0).next().unwrap_or(text);
        let Ok(text) = std::str::from_utf8(&text[..text.len().min(MOST_BYTES)]) else { return found };
        let mut reader = Reader::from_str(text);
        let mut role: Option<String> = None;
        while let Ok(event) = reader.read_event() {
            match event {
                Event::Start(tag) => {
                    let attribute = |name: &str| tag.try_get_attribute(name).ok().flatten().map(|a| a.value.into_owned());
                    let first = attribute("sample").is_none_or(|sample| sample == "0");
                    role = attribute("role").filter(|_| first);
                }
                Event::Text(value) => {
                    let Some(role) = &role else { continue };
                    let value: &str = &value;
                    let number = value.trim().parse::<f64>().ok().filter(|number| number.is_finite());
                    match role.as_str() {
                        "scale" => found.scale = number.filter(|number| *number != 0.0).unwrap_or(found.scale),
                        "offset" => found.offset = number.unwrap_or(found.offset),
                        "unittype" => found.unit = unit(value.trim()),
                        _ => {}
                    }
                }
                Event::End(_) => role = None,
                Event::Eof => break,
                _ => {}
            }
        }
        found
    }
}

fn unit(text: &str) -> Unit {
    Unit::of(match text.to_ascii_lowercase().as_str() {
        "m" | "metre" | "metres" | "meter" | "meters" => 9001,
        "ft" | "foot" | "feet" | "international foot" | "international feet" => 9002,
        "us-ft" | "ftus" | "us survey foot" | "us survey feet" | "foot_us" | "us_survey_foot" => 9003,
        _ => return Unit::Unsaid,
    })
}

/// The number that stands for no height; `Err` with the text if it is none. The text may go on behind its end.
pub(super) fn no_data(text: &[u8]) -> Result<f64, String> {
    let text = text.split(|b| *b == 0).next().unwrap_or(text);
    let text = String::from_utf8_lossy(&text[..text.len().min(64)]).trim().to_owned();
    let number = if text.to_ascii_lowercase().trim_start_matches(['-', '+']).starts_with("nan") {
        Some(f64::NAN)
    } else {
        text.parse().ok()
    };
    number.ok_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::LengthUnit;

    #[test]
    fn scale_offset_and_unit_of_the_first_band() {
        let text = b"<GDALMetadata>\n  <Item name=\"OFFSET\" sample=\"0\" role=\"offset\">100</Item>\n  <Item name=\"SCALE\" sample=\"0\" \
            role=\"scale\">0.1</Item>\n <Item name=\"SCALE\" sample=\"1\" role=\"scale\">7</Item><Item name=\"UNITTYPE\" sample=\"0\" \
            role=\"unittype\">US survey foot</Item>\n <Item name=\"AREA\">5</Item></GDALMetadata>\0";
        assert_eq!(Metadata::read(text), Metadata { scale: 0.1, offset: 100.0, unit: Unit::Known(LengthUnit::UsSurveyFoot) });
        for odd in [&b"<Item role=\"scale\">0</Item>"[..], b"<Item role=\"scale\">x</Item>", b"<Item", b"\xFF", b""] {
            assert_eq!(Metadata::read(odd), Metadata { scale: 1.0, offset: 0.0, unit: Unit::Unsaid });
        }
    }

    #[test]
    fn markers_for_no_height() {
        assert_eq!(no_data(b"-9999\0"), Ok(-9999.0));
        assert_eq!(no_data(b" -3.40282347e+38 \0\0garbage"), Ok(-3.402_823_47e38));
        assert!(no_data(b"nan\0").unwrap().is_nan());
        assert!(no_data(b"-NaN").unwrap().is_nan());
        assert_eq!(no_data(b"none"), Err("none".into()));
    }
}
