//! Works without ground below them: parts of the platform, and of the line.

use super::GroundError;
use super::feeder::Fed;
use super::shape::Shape;
use super::works::Works;
use crate::kernel::sum::Sum;
use crate::mesh::volume;
use crate::model::{Note, Part};
use crate::overlay::AREA_ROUNDING;
use glam::DVec2;

/// Length of line without ground up to this part of the whole is rounding.
const LENGTH_ROUNDING: f64 = 1e-9;

/// Platform that has no ground below it.
pub(super) struct Uncovered {
    /// Its plan area.
    area: f64,
    /// Plan area of all platforms.
    all: f64,
    /// The middle of the triangle with most of it, in the world.
    pub(super) at: DVec2,
}

impl Uncovered {
    pub(super) fn find(shape: &Shape, fed: &Fed) -> Option<Self> {
        let corners = |a: u32| shape.triangles[a as usize].map(|v| shape.vertices[v as usize]);
        let missing = |a: u32| volume::plan_area(corners(a)) - fed.covered[a as usize];
        let flats: Vec<u32> = (0..shape.triangles.len() as u32).filter(|&a| shape.parts[a as usize] == Part::Platform).collect();
        let area = flats.iter().map(|&a| missing(a)).collect::<Sum>().value();
        let all = flats.iter().map(|&a| volume::plan_area(corners(a))).collect::<Sum>().value();
        if area <= AREA_ROUNDING * all {
            return None;
        }
        let worst = flats.into_iter().max_by(|&a, &b| missing(a).total_cmp(&missing(b)))?;
        let [p, q, r] = corners(worst);
        Some(Self { area, all, at: shape.frame.to_world((p + q + r) / 3.0).truncate() })
    }

    pub(super) fn error(&self) -> GroundError {
        GroundError::Uncovered { area: self.area, all: self.all, x: self.at.x, y: self.at.y }
    }

    pub(super) fn note(&self) -> Note {
        let Self { area, all, at } = self;
        let message = format!(
            "there is no ground under {area:.3} of {all:.3} square units of the platform, most of it near ({:.3}, {:.3})",
            at.x, at.y
        );
        Note::new("platform-uncovered", message)
    }
}

/// Line that has no ground below it.
pub(super) struct Bare {
    /// Its length in plan.
    length: f64,
    /// Length in plan of all of the line.
    all: f64,
    /// The middle of the edge with most of it, in the world.
    at: DVec2,
}

impl Bare {
    pub(super) fn find(shape: &Shape, works: &Works) -> Option<Self> {
        let mut edges: Vec<([u32; 2], [f64; 2])> = works.over_ground.iter().map(|(&edge, &lengths)| (edge, lengths)).collect();
        edges.sort_unstable_by_key(|(edge, _)| *edge);
        let missing = |(_, [all, over]): &([u32; 2], [f64; 2])| all - over;
        let length = edges.iter().map(missing).collect::<Sum>().value();
        let all = edges.iter().map(|(_, [all, _])| *all).collect::<Sum>().value();
        if length <= LENGTH_ROUNDING * all {
            return None;
        }
        let (worst, _) = edges.into_iter().max_by(|p, q| missing(p).total_cmp(&missing(q)))?;
        let [p, q] = worst.map(|v| shape.vertices[v as usize]);
        Some(Self { length, all, at: shape.frame.to_world(0.5 * (p + q)).truncate() })
    }

    pub(super) fn error(&self) -> GroundError {
        GroundError::LineUncovered { length: self.length, all: self.all, x: self.at.x, y: self.at.y }
    }

    pub(super) fn note(&self) -> Note {
        let Self { length, all, at } = self;
        let message =
            format!("there is no ground under {length:.3} of {all:.3} of the line, most of it near ({:.3}, {:.3})", at.x, at.y);
        Note::new("line-uncovered", message)
    }
}
