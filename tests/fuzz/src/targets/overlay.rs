//! Volumes between small surfaces of whole numbers, where everything coincides with something.

use super::choices::Choices;
use super::exact::{self, Sums};
use super::tins::Whole;
use super::{limits, tins};
use slopegen::overlay::{Between, MOST_DOUBLE, OverlayError, Surface, between, to_elevation};

/// Rounding, relative to the product of area and height.
const ROUNDING: f64 = 1e-11;

/// Common areas below this may be taken for none.
const NONE: f64 = 1e-8;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let style = choices.byte();
    let side = if style & 1 == 0 { 12 } else { 4 };
    let far = style & 2 != 0;
    let design = Whole::drawn(&mut choices, side, 6);
    let existing = match choices.below(3) {
        0 => design.other_heights(&mut choices, 3),
        _ => Whole::drawn(&mut choices, side, 6),
    };
    let within = (style & 12 == 12).then(|| Whole::drawn(&mut choices, side, 0));
    let terrains = [&design, &existing].map(|mesh| mesh.terrain(far));
    let area = within.as_ref().map(|mesh| mesh.terrain(far));
    // An area that lies on itself counts twice: it is made of rings, which do not.
    if within.as_ref().is_some_and(|mesh| exact::double(mesh) > 0.0) {
        return;
    }
    limits::show(&|| {
        [Some(&terrains[0]), Some(&terrains[1]), area.as_ref()].map(|t| t.map(tins::obj).unwrap_or_default()).join("\n")
    });
    let found = between(&terrains[0], &terrains[1], area.as_ref());
    check(&design, &existing, within.as_ref(), false, &found);
    let level = i64::from(choices.byte() % 13) - 6;
    let flat = Whole { vertices: existing.vertices.iter().map(|v| [v[0], v[1], level]).collect(), ..existing.clone() };
    let found = to_elevation(&terrains[1], level as f64, area.as_ref());
    if exact::double(&existing) == 0.0 && !existing.triangles.is_empty() {
        // Only cells of a triangle with itself: others share at most a side.
        check(&flat, &existing, within.as_ref(), true, &found);
    }
}

/// `plane`: whether the design is a plane, which goes on over all of the area, and has no mesh of its own.
fn check(design: &Whole, existing: &Whole, within: Option<&Whole>, plane: bool, found: &Result<Between, OverlayError>) {
    // Only the triangles near the other surface, or near the area, are looked at.
    let near = [within.unwrap_or(existing), within.unwrap_or(design)];
    let kept = [design.near(near[0]), existing.near(near[1])];
    let double = [exact::double(&kept[0]), exact::double(&kept[1])];
    let sums = exact::between(design, existing, within);
    match found {
        Ok(found) => {
            for (mesh, double) in [design, existing].into_iter().zip(double) {
                assert!(double <= MOST_DOUBLE * exact::area(mesh), "{double} lie double and were not seen");
            }
            // What counts double lies in neither sum for sure.
            if double == [0.0; 2] {
                agree(&sums, found);
            }
            let area = |mesh: &Whole| within.map_or_else(|| exact::area(mesh), |area| exact::between(mesh, area, None).common);
            let reach = if plane { within.unwrap_or(design) } else { design };
            let beside = [area(reach), area(existing)].map(|area| area - sums.common);
            let said = [found.areas.design_uncovered, found.areas.existing_uncovered];
            for (said, beside) in said.iter().zip(beside) {
                assert!((said - beside).abs() < 1e-6, "beside {said} for {beside}");
            }
        }
        Err(OverlayError::Empty(surface)) => {
            let mesh = if *surface == Surface::Design { design } else { existing };
            // Only the part near the other one is looked at.
            assert!(mesh.triangles.is_empty() || sums.common < NONE, "{surface:?} is not empty");
        }
        Err(OverlayError::Apart { .. } | OverlayError::Outside { .. }) => {
            assert!(sums.common < NONE, "{} are shared", sums.common)
        }
        Err(OverlayError::Double { surface, .. }) => {
            assert!(double[usize::from(*surface == Surface::Existing)] > 0.0, "{surface:?} does not lie on itself");
        }
    }
}

fn agree(sums: &Sums, found: &Between) {
    let bound = ROUNDING * (1.0 + sums.common) * (1.0 + sums.deepest_cut + sums.deepest_fill);
    let near =
        |what: &str, found: f64, exact: f64, bound: f64| assert!((found - exact).abs() <= bound, "{what} {found} for {exact}");
    near("cut", found.cut, sums.cut, bound);
    near("fill", found.fill, sums.fill, bound);
    near("common area", found.common_area(), sums.common, bound);
    // Places are found in slivers too.
    near("deepest cut", found.deepest_cut.map_or(0.0, |d| d.depth), sums.deepest_cut, 1e-7);
    near("deepest fill", found.deepest_fill.map_or(0.0, |d| d.depth), sums.deepest_fill, 1e-7);
}
