//! What the name of a coordinate reference system says.

/// The code of a reference system whose name is one of the EPSG register and nothing besides: `EPSG:25832`,
/// `urn:ogc:def:crs:EPSG::25832`, `http://www.opengis.net/def/crs/EPSG/0/25832`.
pub(super) fn epsg(crs: &str) -> Option<&str> {
    let upper = crs.trim().to_ascii_uppercase();
    let named =
        ["EPSG:", "URN:OGC:DEF:CRS:EPSG:", "HTTP://WWW.OPENGIS.NET/DEF/CRS/EPSG/", "HTTPS://WWW.OPENGIS.NET/DEF/CRS/EPSG/"];
    let code = crs.trim().rsplit([':', '/']).next().unwrap_or("");
    let fits = named.iter().any(|prefix| upper.starts_with(prefix));
    (fits && !code.is_empty() && code.bytes().all(|b| b.is_ascii_digit())).then_some(code)
}

/// Whether a reference system is given as well-known text (WKT).
pub(super) fn is_wkt(crs: &str) -> bool {
    const KEYWORDS: [&str; 8] = ["PROJC", "GEOGC", "GEODC", "COMPD_CS", "COMPOUNDCRS", "BOUNDCRS", "LOCAL_CS", "ENGCRS"];
    let upper = crs.trim_start().to_ascii_uppercase();
    upper.contains('[') && KEYWORDS.iter().any(|keyword| upper.starts_with(keyword))
}

/// The code of the EPSG register that a name holds, for formats that tell plan and heights apart: that of the plan, as far as
/// GeoTIFF has room for it.
#[cfg(feature = "geotiff")]
pub(super) fn plan_epsg(crs: &str) -> Option<u32> {
    /// Codes that GeoTIFF has room for (OGC GeoTIFF 1.1, requirement class 10).
    const CODES: std::ops::RangeInclusive<u32> = 1024..=32766;
    plan_code(crs).filter(|code| CODES.contains(code))
}

/// The code of the EPSG register that a name holds: as [`epsg`], and of several codes, as in `EPSG:25832+7837`, the first, which is
/// that of the plan.
fn plan_code(crs: &str) -> Option<u32> {
    const SHORTEST_CODE: usize = 4;
    let upper = crs.to_ascii_uppercase();
    let (_, rest) = upper.split_once("EPSG")?;
    let figures = rest.split(|c: char| !c.is_ascii_digit() && !":/.".contains(c)).next()?;
    let code = figures.split(|c: char| !c.is_ascii_digit()).find(|digits| digits.len() >= SHORTEST_CODE)?;
    code.parse().ok()
}

/// Name of a reference system as a file gives it.
#[derive(Clone, Copy, Debug)]
pub struct SystemName<'a>(pub &'a str);

impl SystemName<'_> {
    /// Whether two names are those of different systems: of two codes of the EPSG register, or without one of two names whose letters
    /// and figures differ. A code and a name, and well-known text, cannot be compared, and do not contradict anything.
    pub fn contradicts(self, other: Self) -> bool {
        match (plan_code(self.0), plan_code(other.0)) {
            (Some(a), Some(b)) => a != b,
            (None, None) if !is_wkt(self.0) && !is_wkt(other.0) => self.bare() != other.bare(),
            _ => false,
        }
    }

    /// Its letters and figures, all small.
    fn bare(self) -> String {
        self.0.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_of_the_register() {
        for crs in [
            "EPSG:25832",
            " epsg:25832",
            "urn:ogc:def:crs:EPSG::25832",
            "urn:ogc:def:crs:EPSG:9.8.1:25832",
            "http://www.opengis.net/def/crs/EPSG/0/25832",
        ] {
            assert_eq!(epsg(crs), Some("25832"), "{crs}");
        }
        for crs in ["", "EPSG:", "EPSG:25832+7837", "EPSG:25832;", "ESRI:102100", "UTM 32", "EPSG:abc"] {
            assert_eq!(epsg(crs), None, "{crs}");
        }
    }

    #[test]
    fn names_contradict_each_other() {
        let contradict = |a: &str, b: &str| SystemName(a).contradicts(SystemName(b)) && SystemName(b).contradicts(SystemName(a));
        for (a, b) in [("EPSG:25832", "EPSG:25833"), ("urn:ogc:def:crs:EPSG::25832", "EPSG:3857"), ("UTM 32", "UTM 33")] {
            assert!(contradict(a, b), "{a} {b}");
        }
        for (a, b) in [
            ("EPSG:25832", "urn:ogc:def:crs:EPSG::25832"),
            ("EPSG:25832", "epsg:25832+7837"),
            ("EPSG:25832", "ETRS89.UTM-32N"),
            ("ETRS89 / UTM 32N", "etrs89/utm32n"),
            ("UTM 32", "PROJCS[\"ETRS89 / UTM zone 32N\",GEOGCS[…]]"),
        ] {
            assert!(!contradict(a, b), "{a} {b}");
        }
    }

    #[test]
    fn well_known_text_is_told() {
        assert!(is_wkt("PROJCS[\"ETRS89 / UTM zone 32N\",GEOGCS[…]]"));
        assert!(is_wkt(" PROJCRS[\"x\"]"));
        assert!(!is_wkt("EPSG:25832"));
        assert!(!is_wkt("PROJCS without brackets"));
    }

    #[cfg(feature = "geotiff")]
    #[test]
    fn codes_are_found_in_names() {
        for (name, code) in [
            ("EPSG:25832", Some(25832)),
            ("urn:ogc:def:crs:EPSG::25832", Some(25832)),
            ("urn:ogc:def:crs:EPSG:9.8.15:2193", Some(2193)),
            ("http://www.opengis.net/def/crs/EPSG/0/25832", Some(25832)),
            ("epsg:2193+4440", Some(2193)),
            ("WGS 84 / UTM zone 32N", None),
            ("EPSG version 9, grid 25832", None),
            ("EPSG:900913", None),
            ("", None),
        ] {
            assert_eq!(plan_epsg(name), code, "{name}");
        }
    }
}
