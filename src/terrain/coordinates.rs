//! What the coordinates of ground say by themselves: box, precision, degrees.

use super::place::{defect, point, short};
use super::upright;
use crate::kernel::plan_box::PlanBox;
use crate::model::{Defect, Defects, Note};
use crate::read::{CoordinateKind, InputFormat, Source};
use crate::validate::{self, INPUT_LIMIT};
use glam::DVec3;

/// Coordinates that are all of single precision are told of if its steps are at least this wide, in the length unit: finer ones
/// are below what is surveyed.
const COARSE: f64 = 1e-3;

/// Bits of a double that are zero in a number of single precision: 52 − 23 of its fraction.
const BEYOND_SINGLE: u64 = (1 << 29) - 1;

/// Extents and precision of the vertices that triangles use (of all points, where there are no triangles).
pub(super) struct Coordinates {
    /// Lower corner of the box, in world coordinates.
    pub(super) lo: DVec3,
    /// Upper corner.
    pub(super) hi: DVec3,
    /// All bits that are set in a plan coordinate, and whether any is not whole.
    bits: u64,
    fractions: bool,
}

/// How to tell a marker for missing heights in a file.
fn without_marker(source: &Source, marker: f64) -> String {
    match source.format {
        InputFormat::GeoTiff => {
            format!("declare it in the file, e.g. `gdal_translate -a_nodata {marker} {} declared.tif`", source.label)
        }
        InputFormat::Asc => format!("declare it in the head of the file: `NODATA_value {marker}`"),
        InputFormat::Csv | InputFormat::Las => "take such points out".to_owned(),
        _ => "take such points out, and the faces that use them".to_owned(),
    }
}

impl Default for Coordinates {
    /// Those of no vertices.
    fn default() -> Self {
        Self { lo: DVec3::INFINITY, hi: DVec3::NEG_INFINITY, bits: 0, fractions: false }
    }
}

impl Coordinates {
    pub(super) fn new(vertices: &[DVec3]) -> Self {
        let mut all = Self::default();
        vertices.iter().for_each(|v| all.take(*v));
        all
    }

    #[inline]
    pub(super) fn take(&mut self, v: DVec3) {
        self.lo = self.lo.min(v);
        self.hi = self.hi.max(v);
        self.bits |= v.x.to_bits() | v.y.to_bits();
        self.fractions |= v.x.fract() != 0.0 || v.y.fract() != 0.0;
    }

    pub(super) fn join(&mut self, other: &Self) {
        self.lo = self.lo.min(other.lo);
        self.hi = self.hi.max(other.hi);
        self.bits |= other.bits;
        self.fractions |= other.fractions;
    }

    /// Refuses markers for missing heights: their triangles would be cliffs.
    fn no_data(&self, vertices: &[DVec3], source: &Source, defects: &mut Defects) {
        if validate::no_data_markers([self.lo.z, self.hi.z].into_iter()).is_empty() {
            return;
        }
        let markers = validate::no_data_markers(vertices.iter().map(|v| v.z));
        const CODE: &str = "ground-no-data";
        for (i, v) in vertices.iter().enumerate().filter(|(_, v)| markers.contains(&v.z)) {
            defects.push(CODE, || Defect {
                code: CODE,
                what: "a point of the ground has a marker for a missing height".into(),
                at: format!("{}, vertex {} at {}", source.label, i + 1, point(*v)),
                figures: None,
                help: without_marker(source, v.z),
            });
        }
    }

    /// Looks at box and precision of `vertices`.
    pub(super) fn check(&self, vertices: &[DVec3], source: &Source, defects: &mut Defects, notes: &mut Vec<Note>) {
        let (lo, hi) = (self.lo, self.hi);
        let largest = lo.abs().max(hi.abs()).max_element();
        if !largest.is_finite() {
            // No vertex is used: told later.
            return;
        }
        if largest > INPUT_LIMIT {
            let figures = format!("x {} to {}, y {} to {}, z {} to {}", lo.x, hi.x, lo.y, hi.y, lo.z, hi.z);
            let help = "correct the coordinates; a marker for missing heights must not be a vertex";
            let what = "coordinates of the ground are beyond 10⁹";
            defects.extend(defect("ground-too-large", what, source.label.clone(), figures, help));
            return;
        }
        if let Err(upright) = upright::far_up(&source.label, lo, hi) {
            defects.extend(upright);
            return;
        }
        self.no_data(vertices, source, defects);
        match validate::degrees(source, PlanBox { lo: lo.truncate(), hi: hi.truncate() }) {
            validate::Verdict::Lengths => {}
            validate::Verdict::Refused(defect) => defects.push(defect.code, || defect),
            validate::Verdict::Noted(note) => notes.push(note),
        }
        // The widest step of single precision: 2⁻²³ of the power of two at or below the largest plan coordinate.
        let plan = lo.truncate().abs().max(hi.truncate().abs()).max_element();
        let step = 2.0_f64.powi(plan.max(COARSE).log2().floor() as i32 - 23);
        // Whole numbers are single by themselves as long as its step is not wider than one.
        // So are the nodes of grids, which stand at round steps from a round corner.
        let grid = matches!(source.format, InputFormat::Asc | InputFormat::GeoTiff);
        let telling = !grid && (self.fractions || step > 1.0);
        if source.kind != CoordinateKind::Degrees && self.bits & BEYOND_SINGLE == 0 && telling && step >= COARSE {
            let message = format!(
                "all plan coordinates of the ground are of single precision, in steps of up to {} at {}: they were rounded \
                 before they were written. Export the ground with double precision, or nearer to the origin",
                short(step),
                short(plan)
            );
            notes.push(Note::new("ground-single-precision", message));
        }
    }
}
