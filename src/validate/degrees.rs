//! Longitude and latitude are no lengths.

use super::vertices::show;
use crate::model::{Defect, Defects, Note};
use crate::read::{CoordinateKind, InputFormat, RawInput};

/// An input with plan coordinates inside the range of degrees and an extent below this in both directions is taken for
/// degrees if it says nothing about itself and lies far from zero: one degree is 111 km, so earthworks in degrees are always
/// smaller, while earthworks in metres or feet are hardly ever smaller than one unit.
const EXTENT_OF_DEGREES: f64 = 1.0;

/// "Far from zero": further than this multiple of the extent. A small model drawn about its own origin is not.
const FAR: f64 = 10.0;

/// Refuses longitude and latitude.
///
/// An input that calls itself degrees (CRS or headings) is refused when its figures can be degrees; if they cannot, the
/// statement is wrong and a note says so. An input that calls itself projected is believed. Only one that says nothing is
/// judged by its figures, with the rule of the constants above, so that local site coordinates such as (0, 0) to (80, 40)
/// pass.
pub(super) fn check(raw: &RawInput, defects: &mut Defects, notes: &mut Vec<Note>) {
    let (mut lo, mut hi) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for vertex in raw.lines.iter().flat_map(|line| &line.vertices) {
        for (i, value) in [vertex.x, vertex.y].into_iter().enumerate() {
            lo[i] = lo[i].min(value);
            hi[i] = hi[i].max(value);
        }
    }
    if !(lo[0] <= hi[0] && lo[1] <= hi[1]) {
        return;
    }
    let in_range = lo[0] >= -180.0 && hi[0] <= 180.0 && lo[1] >= -90.0 && hi[1] <= 90.0;
    let extent = (hi[0] - lo[0]).max(hi[1] - lo[1]);
    let offset = lo.iter().chain(&hi).fold(0.0f64, |m, v| m.max(v.abs()));
    let degrees = match raw.source.kind {
        CoordinateKind::Lengths => false,
        CoordinateKind::Degrees => in_range,
        CoordinateKind::Unknown => in_range && extent < EXTENT_OF_DEGREES && offset > FAR * extent && extent > 0.0,
    };
    if degrees {
        defects.push("degrees", || {
            let (lon, lat) = (0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]));
            let said = match &raw.source.crs {
                Some(crs) => format!("; reference system: {crs}"),
                None => String::new(),
            };
            let zone = (((lon + 180.0) / 6.0).floor() as i64).clamp(0, 59) + 1;
            let epsg = if lat >= 0.0 { 32600 } else { 32700 } + zone;
            Defect {
                code: "degrees",
                what: "the coordinates are longitude and latitude in degrees, not lengths".into(),
                at: raw.source.label.clone(),
                figures: Some(format!("x {} to {}, y {} to {}{said}", show(lo[0]), show(hi[0]), show(lo[1]), show(hi[1]))),
                help: format!("project them first, e.g. `{}`, or to your national grid", command(raw, epsg)),
            }
        });
    } else if raw.source.kind == CoordinateKind::Degrees {
        notes.push(Note::new(
            "not-degrees",
            format!(
                "the file names a reference system in degrees ({}), but its coordinates are beyond them (x {} to {}, y {} to \
                 {}): taken as lengths",
                raw.source.crs.as_deref().unwrap_or("unknown"),
                show(lo[0]),
                show(hi[0]),
                show(lo[1]),
                show(hi[1])
            ),
        ));
    }
}

/// The `ogr2ogr` line that projects the input to UTM.
fn command(raw: &RawInput, epsg: i64) -> String {
    let label = &raw.source.label;
    match raw.source.format {
        InputFormat::GeoJson => {
            format!("ogr2ogr -f GeoJSON -s_srs EPSG:4326 -t_srs EPSG:{epsg} projected.geojson {label}")
        }
        // The old columns must go, or the new file has two for each direction.
        _ => format!(
            "ogr2ogr -f CSV -lco GEOMETRY=AS_XYZ -oo \"X_POSSIBLE_NAMES=lon*,x\" -oo \"Y_POSSIBLE_NAMES=lat*,y\" -oo \
             \"Z_POSSIBLE_NAMES=z,el*,h*,alt*\" -oo KEEP_GEOM_COLUMNS=NO -s_srs EPSG:4326 -t_srs EPSG:{epsg} projected.csv \
             {label}"
        ),
    }
}
