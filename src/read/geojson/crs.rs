//! What a GeoJSON document says about its reference system.

use crate::read::{CoordinateKind, Source};
use geojson::{JsonObject, JsonValue};

/// Name of the reference system: the old `crs` member or the JSON-FG `coordRefSys`.
pub(super) fn read(foreign: Option<&JsonObject>, source: &mut Source) {
    let Some(foreign) = foreign else { return };
    let text = |value: &JsonValue| match value {
        JsonValue::String(text) => Some(text.clone()),
        JsonValue::Null => None,
        other => Some(other.to_string()),
    };
    let old = foreign.get("crs").and_then(|crs| {
        let properties = crs.get("properties");
        properties.and_then(|p| p.get("name").or_else(|| p.get("href")).or_else(|| p.get("code"))).and_then(text)
    });
    source.crs = foreign.get("coordRefSys").and_then(text).or(old);
    source.kind = match &source.crs {
        None => CoordinateKind::Unknown,
        Some(name) if is_geographic(name) => CoordinateKind::Degrees,
        Some(_) => CoordinateKind::Lengths,
    };
}

/// Whether a reference system is known to count in degrees: CRS84 and its kin, and the EPSG codes from 4001 to 4999 and of
/// newer geographic systems, which hold geographic systems (and a few geocentric ones, no plan coordinates either).
pub(in crate::read) fn is_geographic(name: &str) -> bool {
    const NEWER: [u32; 12] = [6318, 6319, 6322, 6325, 6783, 7843, 7844, 8237, 8246, 8860, 9000, 10414];
    const SHORTEST_CODE: usize = 4;
    let upper = name.to_ascii_uppercase();
    if ["CRS84", "CRS83", "CRS27"].iter().any(|known| upper.contains(known)) || upper.starts_with("GCS_") {
        return true;
    }
    if ["WGS84", "WGS 84", "WGS1984"].contains(&upper.trim()) {
        return true;
    }
    // The first code: a second one is the vertical part. Shorter numbers are versions.
    let code = upper.split(|c: char| !c.is_ascii_digit()).find(|digits| digits.len() >= SHORTEST_CODE);
    let code = code.and_then(|digits| digits.parse::<u32>().ok());
    upper.contains("EPSG") && code.is_some_and(|code| (4001..=4999).contains(&code) || NEWER.contains(&code))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reference_systems_in_degrees() {
        for name in [
            "urn:ogc:def:crs:OGC:1.3:CRS84",
            "urn:ogc:def:crs:EPSG::4326",
            "urn:ogc:def:crs:EPSG:9.8.15:4258",
            "EPSG:4326",
            "EPSG:4326+5773",
            "[OGC:CRS84]",
            "http://www.opengis.net/def/crs/EPSG/0/7844",
            "WGS 84",
        ] {
            assert!(is_geographic(name), "{name}");
        }
        for name in ["urn:ogc:def:crs:EPSG::25832", "EPSG:2193+4440", "WGS 84 / UTM zone 32N", "EPSG:31467", "local", ""] {
            assert!(!is_geographic(name), "{name}");
        }
    }
}
