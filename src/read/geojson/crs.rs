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
        Some(name) => kind_of(name),
    };
}

/// Codes of EPSG from 4001 to 4999 that are projected systems; the others of this range count in degrees, apart from a few
/// geocentric and vertical ones. First and last of each run; gaps hold no code. Source: EPSG Dataset 12.029 (2025-10-03), as in the
/// database of PROJ.
const PROJECTED: [(u32, u32); 18] = [
    (4026, 4026),
    (4037, 4038),
    (4048, 4051),
    (4056, 4071),
    (4082, 4096),
    (4217, 4217),
    (4390, 4462),
    (4467, 4467),
    (4471, 4471),
    (4474, 4474),
    (4484, 4489),
    (4491, 4554),
    (4559, 4589),
    (4647, 4656),
    (4766, 4800),
    (4812, 4812),
    (4822, 4822),
    (4826, 4880),
];

/// Codes of EPSG that count in degrees beside those from 4001 to 4999: those often met.
const DEGREES: [u32; 18] =
    [3819, 3821, 3824, 3889, 3906, 5681, 6318, 6319, 6322, 6325, 6668, 6783, 7843, 7844, 8237, 8246, 9000, 10414];

/// Codes of EPSG of all kinds, geographic ones among them, given out in the order in which they came.
const MIXED: std::ops::RangeInclusive<u32> = 5000..=19_999;

/// What a reference system counts in by its name: degrees for CRS84 and its kin and for EPSG codes known as geographic. Of
/// newer codes nothing is said: the coordinates have to tell. All else counts as projected.
pub(in crate::read) fn kind_of(name: &str) -> CoordinateKind {
    const SHORTEST_CODE: usize = 4;
    let upper = name.to_ascii_uppercase();
    if ["CRS84", "CRS83", "CRS27"].iter().any(|known| upper.contains(known)) || upper.starts_with("GCS_") {
        return CoordinateKind::Degrees;
    }
    if ["WGS84", "WGS 84", "WGS1984"].contains(&upper.trim()) {
        return CoordinateKind::Degrees;
    }
    // The first code: a second one is the vertical part. Shorter numbers are versions.
    let code = upper.split(|c: char| !c.is_ascii_digit()).find(|digits| digits.len() >= SHORTEST_CODE);
    match code.and_then(|digits| digits.parse::<u32>().ok()).filter(|_| upper.contains("EPSG")) {
        Some(code) if DEGREES.contains(&code) => CoordinateKind::Degrees,
        Some(code) if (4001..=4999).contains(&code) => {
            let projected = PROJECTED.iter().any(|&(first, last)| (first..=last).contains(&code));
            if projected { CoordinateKind::Lengths } else { CoordinateKind::Degrees }
        }
        Some(code) if MIXED.contains(&code) => CoordinateKind::Unknown,
        _ => CoordinateKind::Lengths,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_reference_systems() {
        for name in [
            "urn:ogc:def:crs:OGC:1.3:CRS84",
            "urn:ogc:def:crs:EPSG::4326",
            "urn:ogc:def:crs:EPSG:9.8.15:4258",
            "EPSG:4326",
            "EPSG:4326+5773",
            "[OGC:CRS84]",
            "http://www.opengis.net/def/crs/EPSG/0/7844",
            "WGS 84",
            // CGCS2000, ETRS89 in three dimensions.
            "EPSG:4490",
            "EPSG:4937",
        ] {
            assert_eq!(kind_of(name), CoordinateKind::Degrees, "{name}");
        }
        for name in ["urn:ogc:def:crs:EPSG::25832", "EPSG:2193+4440", "WGS 84 / UTM zone 32N", "EPSG:31467", "local", ""] {
            assert_eq!(kind_of(name), CoordinateKind::Lengths, "{name}");
        }
        // ETRS89 / UTM zone 32N (zE-N), CGCS2000 / 3-degree Gauss-Kruger CM 117E, ETRS89 / LCC Germany (N-E).
        for name in ["urn:ogc:def:crs:EPSG::4647", "EPSG:4548", "EPSG:4839+5783"] {
            assert_eq!(kind_of(name), CoordinateKind::Lengths, "{name}");
        }
        // DB_REF / 3-degree Gauss-Kruger zone 2 (E-N), RDN2008: the code alone does not tell which is which.
        for name in ["EPSG:5682", "EPSG:6706"] {
            assert_eq!(kind_of(name), CoordinateKind::Unknown, "{name}");
        }
    }
}
