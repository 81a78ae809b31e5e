//! How deep slopes must be built to meet the ground within the mesh.

use super::Site;
use crate::ground::cell;
use crate::ground::shape::Shape;
use crate::ground::thinned::thinned;
use crate::ground::works::{Flood, Sink};
use crate::model::{Design, Extent, Part, Sheet, Slope};
use crate::slope::levels;
use crate::surface::Watch;

/// Slopes are built this part of their depth beyond the lowest (highest) ground they can reach, and at least
/// [`LEAST_BEYOND`] tolerances: they then meet the ground within the mesh.
const BEYOND: f64 = 0.01;

/// See [`BEYOND`].
const LEAST_BEYOND: f64 = 10.0;

/// How deep the works are is found with this many times the tolerance.
const COARSER: f64 = 8.0;

impl Site<'_> {
    /// Finds how far slopes of a sheet can reach before they meet the ground, and the elevation at which that is.
    pub fn end(&mut self, slope: Slope, sheet: Sheet, tolerance: f64) -> f64 {
        let reach = self.bounds.reach(&self.terrain.frame, self.line, slope, sheet, tolerance);
        let (low, high) = self.line.elevation_range();
        let end = match sheet {
            Sheet::Falling => {
                let end = reach.lowest.min(low);
                end - beyond(high - end, tolerance)
            }
            Sheet::Rising => {
                let end = reach.highest.max(high);
                end + beyond(end - low, tolerance)
            }
        };
        self.reaches.push(reach);
        self.ends.push((sheet, end));
        end
    }

    /// The designs with ends just beyond the ground that they really meet, where the end was one of [`Self::end`].
    ///
    /// A first, coarse build tells how deep the works are. So the meshes do not depend on how tightly the ground could be bounded
    /// beforehand: not on its triangles, nor on where the grid of the bounds lies.
    pub(super) fn as_deep_as_needed(&self, designs: &[Design], watch: &dyn Watch) -> Vec<Design> {
        let free = |design: &Design| {
            self.ends.iter().any(|&(sheet, end)| sheet == design.sheet && design.extent == Extent::Elevation(end))
        };
        if !designs.iter().any(free) {
            return designs.to_vec();
        }
        let coarse = |design: &Design| Design {
            tolerance: COARSER * design.tolerance,
            interval: None,
            levels: Vec::new(),
            ..design.clone()
        };
        let coarse = self.in_common(&designs.iter().map(coarse).collect::<Vec<_>>());
        // Sheets of the thinned line move by half of the slack below at most.
        let steepest = coarse.iter().map(|design| design.slope.ratio() / design.tolerance).fold(0.0, f64::max);
        let thin = thinned(self.line, 0.25 / steepest);
        let line = thin.as_ref().unwrap_or(self.line);
        // Whatever is wrong is found again, and told, in the build proper.
        let Ok(surfaces) = self.surfaces(line, &coarse, watch) else { return designs.to_vec() };
        let Some(shape) = Shape::new(&surfaces.iter().collect::<Vec<_>>(), false) else { return designs.to_vec() };
        let mut depth = Depth { shape: &shape, lowest: f64::INFINITY, highest: f64::NEG_INFINITY };
        Flood::run(&shape, &self.patch(&shape, false), false, &mut depth);
        let (low, high) = self.line.elevation_range();
        let deepened = |design: &Design| {
            let Extent::Elevation(given) = design.extent else { return design.clone() };
            let slack = COARSER * design.tolerance;
            let end = match design.sheet {
                Sheet::Falling => {
                    let end = depth.lowest.min(low) - slack;
                    given.max(rounded(end - beyond(high - end, slack), high - end, f64::floor))
                }
                Sheet::Rising => {
                    let end = depth.highest.max(high) + slack;
                    given.min(rounded(end + beyond(end - low, slack), end - low, f64::ceil))
                }
            };
            if free(design) { Design { extent: Extent::Elevation(end), ..design.clone() } } else { design.clone() }
        };
        designs.iter().map(deepened).collect()
    }
}

/// Finds how deep the works reach.
struct Depth<'a> {
    shape: &'a Shape,
    lowest: f64,
    highest: f64,
}

impl Sink for Depth<'_> {
    fn take(&mut self, a: u32, corners: &[cell::Corner]) {
        match self.shape.parts[a as usize] {
            Part::FillSlope => self.lowest = corners.iter().fold(self.lowest, |z, c| z.min(c.z)),
            Part::CutSlope => self.highest = corners.iter().fold(self.highest, |z, c| z.max(c.z)),
            _ => {}
        }
    }
}

/// See [`BEYOND`].
fn beyond(depth: f64, tolerance: f64) -> f64 {
    (BEYOND * depth).max(LEAST_BEYOND * tolerance)
}

/// An end on a coarse scale, so that it does not move with every digit of the ground.
fn rounded(end: f64, depth: f64, round: fn(f64) -> f64) -> f64 {
    let step = levels::round_interval(depth.max(f64::MIN_POSITIVE)) / 4.0;
    round(end / step) * step
}
