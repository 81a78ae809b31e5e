//! The certificate of a design on its ground.

use super::GroundError;
use super::figures::Found;
use super::patch::NONE;
use crate::mesh::check::Soundness;
use crate::model::{Part, Sheet, Tin};
use crate::surface::{CONE_BOUND, Certificate, Deviations, MEASURABLE_HEIGHT, STRIP_BOUND, flaw};
use glam::DVec3;

/// Measures the design cut off at the ground; what cutting does not change is taken from the whole sheets.
///
/// # Errors
/// [`GroundError::Unsound`] if a figure is out of bounds.
pub(super) fn certificate(found: &Found, design: &Tin, soundness: &Soundness) -> Result<Certificate, GroundError> {
    let sheets = || found.surfaces.iter().map(|surface| &surface.certificate);
    let certificate = Certificate {
        paired: sheets().all(|sheet| sheet.paired),
        manifold: soundness.manifold(),
        overlaps: soundness.overlaps,
        input_edges_kept: sheets().all(|sheet| sheet.input_edges_kept),
        height_max_deviation: sheets().map(|sheet| sheet.height_max_deviation).fold(0.0, f64::max),
        ..Certificate::default()
    }
    .with(deviations(found, design));
    let flaw = flaw(soundness, design).or_else(|| {
        let (strip, cone) = (certificate.strip_max_deviation_deg, certificate.sector_max_deviation_deg);
        (strip > STRIP_BOUND || cone > CONE_BOUND).then(|| format!("a slope triangle is {:.4}° off the slope", strip.max(cone)))
    });
    match flaw {
        Some(what) => Err(GroundError::Unsound { mesh: "design", what }),
        None => Ok(certificate),
    }
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
            deviations.take(design.corners(t), alpha, found.shape.feet[foot as usize].on_cone, is_measurable);
        }
    }
    deviations
}

/// A sliver along the daylight line has no normal that its own rounding would not turn.
fn is_measurable([a, b, c]: [DVec3; 3]) -> bool {
    let base = (b - a).length().max((c - b).length()).max((a - c).length());
    (b - a).cross(c - a).length() > base * MEASURABLE_HEIGHT
}
