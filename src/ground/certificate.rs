//! The certificate of a design on its ground.

use super::GroundError;
use super::cell::TOUCH;
use super::found::Found;
use super::patch::NONE;
use crate::mesh::check::Soundness;
use crate::model::{Design, Part, Sheet, Tin};
use crate::surface::{
    CONE_BOUND, Certificate, Deviations, MEASURABLE_HEIGHT, STRIP_BOUND, flaw, height_deviation, height_rounding,
};
use glam::DVec3;

/// How far places are moved when design and ground become one mesh, in plan (length units): twice
/// `nodes::WELD`.
const MOVED: f64 = 4e-8;

/// Measures the design cut off at the ground. Pairing and the edges of the line are those of the sheets before they are cut: where
/// neither side has works there is no edge left.
///
/// # Errors
/// [`GroundError::Unsound`] if a figure is out of bounds.
pub(super) fn certificate(found: &Found, design: &Tin, soundness: &Soundness) -> Result<Certificate, GroundError> {
    let heights: Vec<f64> = found.designs.iter().map(|sheet| height_off(found, sheet, design)).collect();
    let sheets = || found.surfaces.iter().map(|surface| &surface.certificate);
    let certificate = Certificate {
        paired: sheets().all(|sheet| sheet.paired),
        manifold: soundness.manifold(),
        overlaps: soundness.overlaps,
        input_edges_kept: sheets().all(|sheet| sheet.input_edges_kept),
        height_max_deviation: heights.iter().copied().fold(0.0, f64::max),
        ..Certificate::default()
    }
    .with(deviations(found, design));
    let flaw = flaw(soundness, design).or_else(|| {
        let (strip, cone) = (certificate.strip_max_deviation_deg, certificate.sector_max_deviation_deg);
        (strip > STRIP_BOUND || cone > CONE_BOUND).then(|| format!("a slope triangle is {:.4}° off the slope", strip.max(cone)))
    });
    let flaw = flaw.or_else(|| {
        let allowed = |sheet: &Design| sheet.tolerance + height_rounding(design) + TOUCH + MOVED * sheet.slope.ratio();
        let (height, sheet) = heights.iter().zip(found.designs).find(|&(&height, sheet)| height > allowed(sheet))?;
        Some(format!("a height is {height:.6} off the sheet, tolerance {}", sheet.tolerance))
    });
    match flaw {
        Some(what) => Err(GroundError::Unsound { mesh: "design", what }),
        None => Ok(certificate),
    }
}

/// Largest difference in height between the slopes of a sheet, where the ground has left them, and the sheet of the given line.
fn height_off(found: &Found, sheet: &Design, design: &Tin) -> f64 {
    let part = match sheet.sheet {
        Sheet::Rising => Part::CutSlope,
        Sheet::Falling => Part::FillSlope,
    };
    height_deviation(found.line, sheet, design, |t| design.parts[t] == part)
}

/// Deviations of the triangles of slopes from their slope.
fn deviations(found: &Found, design: &Tin) -> Deviations {
    let angle = |sheet: Sheet| found.designs.iter().find(|d| d.sheet == sheet).map(|d| d.slope.ratio().atan());
    let (rising, falling) = (angle(Sheet::Rising), angle(Sheet::Falling));
    let mut deviations = Deviations::default();
    for (t, &a) in found.trimmed.from.iter().enumerate() {
        let foot = found.shape.foot_of[a as usize];
        let alpha = if design.parts[t] == Part::CutSlope { rising } else { falling };
        if let Some(alpha) = alpha.filter(|_| foot != NONE) {
            deviations
                .take(design.corners(t), alpha, found.shape.feet[foot as usize].on_cone, |corners, _| is_measurable(corners));
        }
    }
    deviations
}

/// A sliver along the daylight line has no normal that its own rounding would not turn.
fn is_measurable([a, b, c]: [DVec3; 3]) -> bool {
    let base = (b - a).length().max((c - b).length()).max((a - c).length());
    (b - a).cross(c - a).length() > base * MEASURABLE_HEIGHT
}
