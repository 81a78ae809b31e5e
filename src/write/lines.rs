//! Line work as GeoJSON.

use super::head::finite;
use super::number::push_f64;
use super::obj::flush_if_full;
use super::{EncodeError, GENERATOR};
use crate::model::LineFeature;
use std::io::Write;

/// Writes line work as a GeoJSON `FeatureCollection` of 3D `LineString`s in world coordinates, shortest digits that read back
/// to the same bits. Returns the number of features written.
///
/// Properties: `kind` always, `elevation` for level curves, `chain` for hinges and breaklines, `part` for daylight lines.
/// `crs`, the name of the coordinate system as the input gave it, becomes the (old, widely read) named `crs` member. Features are
/// sorted by kind, then elevation, and otherwise stay in the given order. One of fewer than two points is no line and is left
/// out.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a coordinate or elevation that is no number.
pub fn write_lines(out: &mut (impl Write + ?Sized), features: &[LineFeature], crs: Option<&str>) -> Result<usize, EncodeError> {
    let order = in_order(features);
    let mut bytes = Vec::new();
    bytes.extend_from_slice(b"{\"type\":\"FeatureCollection\",\n\"generator\":");
    push_json_string(&mut bytes, GENERATOR)?;
    if let Some(name) = crs {
        bytes.extend_from_slice(b",\n\"crs\":{\"type\":\"name\",\"properties\":{\"name\":");
        push_json_string(&mut bytes, name)?;
        bytes.extend_from_slice(b"}}");
    }
    bytes.extend_from_slice(b",\n\"features\":[");
    for (position, &i) in order.iter().enumerate() {
        bytes.extend_from_slice(if position == 0 { b"\n" } else { b",\n" });
        push_feature(out, &mut bytes, &features[i], i)?;
    }
    bytes.extend_from_slice(b"\n]}\n");
    out.write_all(&bytes)?;
    Ok(order.len())
}

/// Features by kind, then elevation, otherwise in the given order. One of fewer than two points is no line and is left out.
pub(super) fn in_order(features: &[LineFeature]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..features.len()).filter(|&i| features[i].points.len() >= 2).collect();
    order.sort_by(|&a, &b| {
        let key = |i: usize| (features[i].kind, features[i].elevation.unwrap_or(f64::NEG_INFINITY));
        let ((kind_a, z_a), (kind_b, z_b)) = (key(a), key(b));
        kind_a.cmp(&kind_b).then(z_a.total_cmp(&z_b))
    });
    order
}

/// Appends one feature, `index` its position in the caller's list.
fn push_feature(
    out: &mut (impl Write + ?Sized),
    bytes: &mut Vec<u8>,
    feature: &LineFeature,
    index: usize,
) -> Result<(), EncodeError> {
    let finite = |value| finite(value, "line feature", index + 1);
    bytes.extend_from_slice(b"{\"type\":\"Feature\",\"properties\":{\"kind\":\"");
    bytes.extend_from_slice(feature.kind.name().as_bytes());
    bytes.push(b'"');
    if let Some(elevation) = feature.elevation {
        bytes.extend_from_slice(b",\"elevation\":");
        push_f64(bytes, finite(elevation)?);
    }
    if let Some(chain) = &feature.chain {
        bytes.extend_from_slice(b",\"chain\":");
        push_json_string(bytes, chain)?;
    }
    if let Some(part) = feature.part {
        bytes.extend_from_slice(b",\"part\":");
        push_json_string(bytes, part.name())?;
    }
    bytes.extend_from_slice(b"},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[");
    for (j, point) in feature.points.iter().enumerate() {
        bytes.extend_from_slice(if j == 0 { b"[" } else { b",[" });
        for (k, value) in point.to_array().into_iter().enumerate() {
            if k > 0 {
                bytes.push(b',');
            }
            push_f64(bytes, finite(value)?);
        }
        bytes.push(b']');
        flush_if_full(out, bytes)?;
    }
    bytes.extend_from_slice(b"]}}");
    Ok(())
}

/// Appends a string in quotes, escaped as JSON asks.
fn push_json_string(bytes: &mut Vec<u8>, text: &str) -> Result<(), EncodeError> {
    Ok(serde_json::to_writer(bytes, text)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::CurveKind;
    use geojson::{FeatureCollection, GeometryValue};
    use glam::DVec3;

    fn feature(kind: CurveKind, points: &[[f64; 3]], elevation: Option<f64>, chain: Option<&str>) -> LineFeature {
        LineFeature {
            kind,
            points: points.iter().map(|p| DVec3::from(*p)).collect(),
            elevation,
            chain: chain.map(Into::into),
            part: None,
        }
    }

    fn text(features: &[LineFeature], crs: Option<&str>) -> String {
        let mut bytes = Vec::new();
        write_lines(&mut bytes, features, crs).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn text_is_as_documented() {
        let features = [
            feature(CurveKind::Hinge, &[[0.0, 0.5, 12.0], [1e21, 2.0, 3.25]], None, Some("a \"b\"\n")),
            feature(CurveKind::LevelCurve, &[[0.0, 0.0, 11.0], [1.0, 0.0, 11.0]], Some(11.0), None),
            feature(CurveKind::LevelCurve, &[[0.0, 0.0, 2.5], [1.0, 0.0, 2.5]], Some(2.5), None),
            feature(CurveKind::LevelCurve, &[[0.0, 0.0, 1.0]], Some(1.0), None),
        ];
        let expected = format!(
            r#"{{"type":"FeatureCollection",
"generator":"{GENERATOR}",
"crs":{{"type":"name","properties":{{"name":"urn:ogc:def:crs:EPSG::25832"}}}},
"features":[
{{"type":"Feature","properties":{{"kind":"level_curve","elevation":2.5}},"geometry":{{"type":"LineString","coordinates":[[0,0,2.5],[1,0,2.5]]}}}},
{{"type":"Feature","properties":{{"kind":"level_curve","elevation":11}},"geometry":{{"type":"LineString","coordinates":[[0,0,11],[1,0,11]]}}}},
{{"type":"Feature","properties":{{"kind":"hinge","chain":"a \"b\"\n"}},"geometry":{{"type":"LineString","coordinates":[[0,0.5,12],[1e+21,2,3.25]]}}}}
]}}
"#
        );
        assert_eq!(text(&features, Some("urn:ogc:def:crs:EPSG::25832")), expected);
    }

    #[test]
    fn a_geojson_reader_gets_the_same_bits() {
        let points: Vec<[f64; 3]> =
            (0..5000).map(|i| f64::from(i).sin()).map(|s| [500_000.1 + s, 5e6 + s / 3.0, s * 1e-9]).collect();
        let text = text(&[feature(CurveKind::Ridge, &points, None, None)], None);
        let read: FeatureCollection = text.parse().unwrap();
        let geometry = &read.features[0].geometry.as_ref().unwrap().value;
        let GeometryValue::LineString { coordinates } = geometry else { panic!("{geometry:?}") };
        assert_eq!(coordinates.len(), points.len());
        for (read, given) in coordinates.iter().zip(&points) {
            assert_eq!(read.as_slice(), given);
        }
    }

    #[test]
    fn nothing_to_write_is_still_a_collection() {
        assert_eq!(text(&[], None).parse::<FeatureCollection>().unwrap().features.len(), 0);
    }

    #[test]
    fn a_number_that_is_none_is_refused() {
        let bad = feature(CurveKind::Valley, &[[0.0, 0.0, f64::NAN], [1.0, 0.0, 0.0]], None, None);
        let error = write_lines(&mut Vec::new(), &[bad], None).unwrap_err();
        assert!(matches!(error, EncodeError::NotFinite { what: "line feature", index: 1, .. }));
    }
}
