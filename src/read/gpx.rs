//! GPS tracks: known, and refused with what can be done.

use super::ReadError;

/// A track of a GPS receiver is no survey: degrees, and heights off by metres. The message tells what is in the file, and names
/// the UTM zone of its middle for those who want a sketch all the same.
pub(super) fn refuse(label: &str, bytes: &[u8]) -> ReadError {
    let count = |tag: &[u8]| memchr::memmem::find_iter(bytes, tag).count();
    let points =
        [("tracks", "track", count(b"<trkpt")), ("routes", "route", count(b"<rtept")), ("waypoints", "way", count(b"<wpt"))];
    let told: Vec<String> = points
        .iter()
        .filter(|(.., n)| *n > 0)
        .map(|(_, of, n)| format!("{n} {of} point{}", if *n == 1 { "" } else { "s" }))
        .collect();
    let mut figures = if told.is_empty() { "no points".to_owned() } else { told.join(", ") };
    let range = |name: &[u8]| {
        let values = memchr::memmem::find_iter(bytes, name).filter_map(|at| attribute(bytes.get(at + name.len()..)?));
        values.fold(None, |range: Option<(f64, f64)>, v| Some(range.map_or((v, v), |(lo, hi)| (lo.min(v), hi.max(v)))))
    };
    let (lat, lon) = (range(b" lat="), range(b" lon="));
    let mut zone = "EPSG:25832, with the code of your grid".to_owned();
    if let (Some((south, north)), Some((west, east))) = (lat, lon) {
        figures.push_str(&format!("; latitude {south} to {north}, longitude {west} to {east}"));
        // UTM zones are 6° wide, from 180° west; EPSG 32601 to 32660 in the north, 32701 to 32760 in the south (WGS 84).
        let number = ((0.5 * (west + east) + 180.0) / 6.0).floor().clamp(0.0, 59.0) as u32 + 1;
        let code = if south + north >= 0.0 { 32_600 } else { 32_700 } + number;
        zone = format!("EPSG:{code}, or the code of your grid");
    }
    let layer = points.iter().find(|(.., n)| *n > 0).map_or("tracks", |(layer, ..)| layer);
    let (code, rest) = zone.split_once(',').unwrap_or((&zone, ""));
    ReadError::Content {
        what: "a GPS track is no survey: its positions are degrees, its heights good to metres at best".into(),
        at: label.to_owned(),
        figures,
        help: format!(
            "survey the line; for a sketch project it first: `ogr2ogr -f GeoJSON -t_srs {code} --config GPX_ELE_AS_25D YES \
             line.geojson {label} {layer}`,{rest}"
        ),
    }
}

/// The degrees in quotes at the beginning of a text.
fn attribute(text: &[u8]) -> Option<f64> {
    let (&quote, rest) = text.split_first().filter(|(quote, _)| matches!(quote, b'"' | b'\''))?;
    // Longer than degrees with all digits of a double.
    let end = rest.iter().take(40).position(|&byte| byte == quote)?;
    super::decimal::number(&rest[..end]).filter(|degrees| degrees.abs() <= 360.0)
}
