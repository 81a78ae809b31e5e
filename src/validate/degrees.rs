//! Longitude and latitude are no lengths.

use super::vertices::show;
use crate::kernel::plan_box::PlanBox;
use crate::model::{Defect, Defects, Note};
use crate::read::{CoordinateKind, InputFormat, RawInput, Source};
use glam::DVec2;

/// An input with plan coordinates inside the range of degrees and an extent below this in both directions is taken for
/// degrees if it says nothing about itself and lies far from zero: one degree is 111 km, so earthworks in degrees are always
/// smaller, while earthworks in metres or feet are hardly ever smaller than one unit.
const EXTENT_OF_DEGREES: f64 = 1.0;

/// "Far from zero": further than this multiple of the extent. A small model drawn about its own origin is not.
const FAR: f64 = 10.0;

/// What plan coordinates are.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Lengths.
    Lengths,
    /// Longitude and latitude.
    Refused(Defect),
    /// Lengths, although the file says otherwise.
    Noted(Note),
}

/// Refuses longitude and latitude.
pub(super) fn check(raw: &RawInput, defects: &mut Defects, notes: &mut Vec<Note>) {
    let vertices = raw.lines.iter().flat_map(|line| &line.vertices).map(|vertex| DVec2::new(vertex.x, vertex.y));
    match degrees(&raw.source, PlanBox::of(vertices)) {
        Verdict::Lengths => {}
        Verdict::Refused(defect) => defects.push(defect.code, || defect),
        Verdict::Noted(note) => notes.push(note),
    }
}

/// Whether the coordinates of an input, of which the plan box is given, are longitude and latitude.
///
/// An input that calls itself degrees (CRS or headings) is refused when its figures can be degrees; if they cannot, the
/// statement is wrong and a note says so. An input that calls itself projected is believed. Only one that says nothing is
/// judged by its figures, with the rule of the constants above, so that local site coordinates such as (0, 0) to (80, 40)
/// pass.
pub fn degrees(source: &Source, bounds: PlanBox) -> Verdict {
    if bounds.is_empty() {
        return Verdict::Lengths;
    }
    let PlanBox { lo, hi } = bounds;
    let in_range = lo.x >= -180.0 && hi.x <= 180.0 && lo.y >= -90.0 && hi.y <= 90.0;
    let extent = (hi - lo).max_element();
    let offset = lo.abs().max(hi.abs()).max_element();
    let degrees = match source.kind {
        CoordinateKind::Lengths => false,
        CoordinateKind::Degrees => in_range,
        CoordinateKind::Unknown => in_range && extent < EXTENT_OF_DEGREES && offset > FAR * extent && extent > 0.0,
    };
    let box_of = format!("x {} to {}, y {} to {}", show(lo.x), show(hi.x), show(lo.y), show(hi.y));
    if degrees {
        let middle = 0.5 * (lo + hi);
        let said = match &source.crs {
            Some(crs) => format!("; reference system: {crs}"),
            None => String::new(),
        };
        let zone = (((middle.x + 180.0) / 6.0).floor() as i64).clamp(0, 59) + 1;
        let epsg = if middle.y >= 0.0 { 32600 } else { 32700 } + zone;
        Verdict::Refused(Defect {
            code: "degrees",
            what: "the coordinates are longitude and latitude in degrees, not lengths".into(),
            at: source.label.clone(),
            figures: Some(format!("{box_of}{said}")),
            help: format!("project them first, e.g. `{}`, or to your national grid", command(source, epsg)),
        })
    } else if source.kind == CoordinateKind::Degrees {
        Verdict::Noted(Note::new(
            "not-degrees",
            format!(
                "the file names a reference system in degrees ({}), but its coordinates are beyond them ({box_of}): taken as \
                 lengths",
                source.crs.as_deref().unwrap_or("unknown"),
            ),
        ))
    } else {
        Verdict::Lengths
    }
}

/// The line that projects the input to UTM.
fn command(source: &Source, epsg: i64) -> String {
    let label = &source.label;
    match source.format {
        InputFormat::GeoJson => {
            format!("ogr2ogr -f GeoJSON -s_srs EPSG:4326 -t_srs EPSG:{epsg} projected.geojson {label}")
        }
        InputFormat::Asc => format!("gdalwarp -s_srs EPSG:4326 -t_srs EPSG:{epsg} -of AAIGrid {label} projected.asc"),
        InputFormat::GeoTiff => format!("gdalwarp -s_srs EPSG:4326 -t_srs EPSG:{epsg} {label} projected.tif"),
        InputFormat::Las => {
            format!("pdal translate {label} projected.laz reprojection --filters.reprojection.out_srs=EPSG:{epsg}")
        }
        // The old columns must go, or the new file has two for each direction.
        _ => format!(
            "ogr2ogr -f CSV -lco GEOMETRY=AS_XYZ -oo \"X_POSSIBLE_NAMES=lon*,x\" -oo \"Y_POSSIBLE_NAMES=lat*,y\" -oo \
             \"Z_POSSIBLE_NAMES=z,el*,h*,alt*\" -oo KEEP_GEOM_COLUMNS=NO -s_srs EPSG:4326 -t_srs EPSG:{epsg} projected.csv \
             {label}"
        ),
    }
}
