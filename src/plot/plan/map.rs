//! From the ground to paper.

use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::plot::Scene;
use crate::plot::lines::Stroke;
use glam::{DVec2, DVec3};

/// Paper left free around the works, in px.
const AROUND: f64 = 44.0;

/// The flattest and the tallest map, as shares of its width.
const FLATTEST: f64 = 0.34;
const TALLEST: f64 = 1.05;

/// A map: a window on the plan, north up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Map {
    frame: Frame,
    /// Its upper left corner in the local frame.
    corner: DVec2,
    /// Its size in px.
    pub(super) size: DVec2,
    /// px per unit of length.
    pub(super) scale: f64,
}

impl Map {
    /// The map of a scene that is `width` wide: design and line in the middle, with some ground around them.
    pub(super) fn of(scene: &Scene<'_>, width: f64) -> Option<Self> {
        let frame = scene.design.frame;
        let given = scene.line.chains.iter().flat_map(|chain| &chain.vertices).map(|v| frame.to_local(*v));
        let used = scene.design.triangles.iter().flatten().map(|v| scene.design.vertices[*v as usize]);
        let around = PlanBox::of(given.chain(used).map(DVec3::truncate));
        let extent = around.size();
        if !(extent.max_element() > 0.0 && extent.max_element().is_finite()) {
            return None;
        }
        let inner = width - 2.0 * AROUND;
        let tallest = TALLEST * width - 2.0 * AROUND;
        let scale = (inner / extent.x).min(tallest / extent.y);
        let height = (extent.y * scale + 2.0 * AROUND).max(FLATTEST * width).ceil();
        let size = DVec2::new(width, height);
        let corner = around.middle() + 0.5 * DVec2::new(-size.x, size.y) / scale;
        Some(Self { frame, corner, size, scale })
    }

    /// A place of the local frame on the map.
    pub(super) fn at(&self, p: DVec2) -> DVec2 {
        DVec2::new(p.x - self.corner.x, self.corner.y - p.y) * self.scale
    }

    /// A place of the world on the map.
    pub(super) fn of_world(&self, p: DVec3) -> DVec2 {
        self.at(self.frame.to_local(p).truncate())
    }

    /// The place in the local frame that is drawn at a point.
    pub(super) fn to_local(self, p: DVec2) -> DVec2 {
        self.corner + DVec2::new(p.x, -p.y) / self.scale
    }

    /// A line of the local frame on the map.
    pub(super) fn stroke(&self, mut stroke: Stroke) -> Stroke {
        stroke.points.iter_mut().for_each(|p| *p = self.at(*p));
        stroke
    }

    /// What the map shows, in the local frame.
    pub(super) fn local(&self) -> PlanBox {
        let extent = self.size / self.scale;
        PlanBox { lo: self.corner - DVec2::new(0.0, extent.y), hi: self.corner + DVec2::new(extent.x, 0.0) }
    }

    /// The same in the world.
    pub(super) fn world(&self) -> PlanBox {
        let PlanBox { lo, hi } = self.local();
        PlanBox { lo: lo + self.frame.origin(), hi: hi + self.frame.origin() }
    }

    /// Whether the map shows a point, `margin` px within its edge.
    pub(super) fn shows(&self, p: DVec2, margin: f64) -> bool {
        p.cmpge(DVec2::splat(margin)).all() && p.cmple(self.size - margin).all()
    }
}
