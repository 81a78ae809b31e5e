//! Cut and fill between two meshes.

use super::boxes::Box2;
use super::cell::{CUT, Corner, HEIGHT, Patch, Ring};
use super::fabric::{Fabric, Linked};
use super::layers;
use super::walker::Walker;
use crate::kernel::frame::Frame;
use crate::kernel::sum::Sum;
use crate::model::Terrain;
use glam::{DVec2, DVec3};
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Heights within this of each other are the same, in the length unit: the area where no point of a cell differs by more is
/// unaffected. Its volume counts all the same.
pub const SAME_HEIGHT: f64 = 1e-6;

/// Share of the plan area that rounding may add or take: less does not count as uncovered, or as lying double.
pub const AREA_ROUNDING: f64 = 1e-9;

/// Share of the plan area that may lie double before a mesh is refused: slivers along a seam, from rounded coordinates.
pub const MOST_DOUBLE: f64 = 1e-6;

/// Triangles of a piece of work. Fixed, so that sums are taken in the same order on any number of threads.
const CHUNK: usize = 4096;

/// One of the two surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// The surface after the works.
    Design,
    /// The surface before.
    Existing,
}

impl Surface {
    /// Its name in messages and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Design => "design",
            Self::Existing => "existing",
        }
    }
}

/// Plan areas, in the square of the length unit; not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Areas {
    /// Where the existing surface is higher.
    pub cut: f64,
    /// Where the design is higher.
    pub fill: f64,
    /// Where they are the same, within [`SAME_HEIGHT`].
    pub unaffected: f64,
    /// Design that does not lie over the existing surface: it has no volume.
    pub design_uncovered: f64,
    /// Existing surface that does not lie under the design.
    pub existing_uncovered: f64,
}

/// A greatest depth and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Vertical distance of the surfaces; positive.
    pub depth: f64,
    /// Where, on the design, in world coordinates.
    pub place: DVec3,
}

/// Everything between two surfaces over the plan area they share. Units are those of the coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Between {
    /// `∫ max(existing − design, 0)`.
    pub cut: f64,
    /// `∫ max(design − existing, 0)`.
    pub fill: f64,
    /// Plan areas.
    pub areas: Areas,
    /// Deepest cut, if there is any.
    pub deepest_cut: Option<Depth>,
    /// Deepest fill, if there is any.
    pub deepest_fill: Option<Depth>,
    /// Cells of the common refinement.
    pub cells: usize,
    /// Plan area seen to lie double in the design and in the existing mesh; less than [`MOST_DOUBLE`] of each.
    pub double: [f64; 2],
}

impl Between {
    /// `cut − fill`.
    pub fn net(&self) -> f64 {
        self.cut - self.fill
    }

    /// Plan area the two surfaces share.
    pub fn common_area(&self) -> f64 {
        self.areas.cut + self.areas.fill + self.areas.unaffected
    }
}

/// Why there is nothing between two surfaces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OverlayError {
    /// A mesh without plan area.
    #[error("the {} mesh has no area in plan", .0.name())]
    Empty(Surface),
    /// The meshes share no plan area.
    #[error("the two meshes share no area in plan\n   = {}\n   = {}", boxed("design", .design), boxed("existing", .existing))]
    Apart {
        /// Box of the design in world coordinates.
        design: [DVec2; 2],
        /// Box of the existing surface.
        existing: [DVec2; 2],
    },
    /// A mesh lies on itself.
    #[error(
        "triangles of the {} mesh lie on each other in plan\n   = {area:.3} or more of {of:.3} square units lie double, first near \
         {:.3}, {:.3}",
        .surface.name(), .at.x, .at.y
    )]
    Double {
        /// Which mesh.
        surface: Surface,
        /// Plan area seen to lie double.
        area: f64,
        /// Plan area of all its triangles.
        of: f64,
        /// A place in world coordinates.
        at: DVec2,
    },
}

fn boxed(name: &str, [lo, hi]: &[DVec2; 2]) -> String {
    format!("{name}: x {:.3} to {:.3}, y {:.3} to {:.3}", lo.x, hi.x, lo.y, hi.y)
}

/// Cut, fill and what goes with them between `design` and `existing`, over the plan area they share.
///
/// Exact for the two meshes: every cell of their common refinement is a prism, split where its height changes sign. Arithmetic is
/// relative to the corners of each triangle, sums are compensated.
///
/// # Errors
/// [`OverlayError`]; a mesh that lies on itself is refused, because its volume would count twice.
///
/// # Accuracy
/// Relative rounding of each cell is a few units in the last place times the ratio of the two triangles' sizes; see
/// `docs/theory.md`, section 15, and the tests `tests/overlay`.
pub fn between(design: &Terrain, existing: &Terrain) -> Result<Between, OverlayError> {
    let frame = if design.frame == existing.frame { existing.frame } else { common_frame(design, existing) };
    let boxes = [design, existing].map(|mesh| shifted_box(mesh, frame));
    let [d, e] = [(design, Surface::Design, &boxes[1]), (existing, Surface::Existing, &boxes[0])]
        .map(|(mesh, surface, keep)| (Fabric::new(mesh, frame, keep), surface));
    for (fabric, surface) in [&d, &e] {
        // Written so that an area that is no number is refused as well.
        if !(fabric.area > 0.0) {
            return Err(OverlayError::Empty(*surface));
        }
    }
    let (d, e) = (d.0, e.0);
    let world = |b: &Box2| [b.lo, b.hi].map(|p| frame.to_world(p.extend(0.0)).truncate());
    let apart = || OverlayError::Apart { design: world(&boxes[0]), existing: world(&boxes[1]) };
    let [linked_design, linked_existing] = [Linked::new(&d), Linked::new(&e)];
    let mut double = [0.0; 2];
    for (i, (mesh, surface)) in [(&linked_design, Surface::Design), (&linked_existing, Surface::Existing)].into_iter().enumerate()
    {
        let found = layers::double(mesh);
        double[i] = found.area;
        if found.area > MOST_DOUBLE * mesh.fabric.area {
            let at = frame.to_world(found.at.extend(0.0)).truncate();
            return Err(OverlayError::Double { surface, area: found.area, of: mesh.fabric.area, at });
        }
    }
    // The finer mesh is laid over the coarser one: its triangles have few cells each, which lie near each other.
    let tally =
        if d.triangles.len() >= e.triangles.len() { sweep(&d, &linked_existing) } else { sweep(&e, &linked_design).mirrored() };
    if tally.cells == 0 {
        return Err(apart());
    }
    Ok(tally.into_between(frame, d.area, e.area, double))
}

/// A frame for both meshes.
fn common_frame(design: &Terrain, existing: &Terrain) -> Frame {
    let b = shifted_box(design, Frame::WORLD).join(shifted_box(existing, Frame::WORLD));
    Frame::around(b.lo, b.hi)
}

/// The box of the vertices in use, in `frame`.
fn shifted_box(mesh: &Terrain, frame: Frame) -> Box2 {
    let used = mesh.triangles.as_flattened().iter().map(|&v| mesh.vertices[v as usize].truncate());
    let b = Box2::around(used);
    let shift = mesh.frame.origin() - frame.origin();
    Box2 { lo: b.lo + shift, hi: b.hi + shift }
}

/// Figures of a piece of the work. Heights are those of the mesh laid over, above the other one.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    above: Side,
    below: Side,
    unaffected: Sum,
    cells: usize,
}

/// One sign of the height.
#[derive(Clone, Copy, Debug, Default)]
struct Side {
    volume: Sum,
    area: Sum,
    deepest: f64,
    /// Where it is deepest, on the mesh laid over.
    place: DVec3,
    /// Height of the other mesh there, above that one.
    other: f64,
}

impl Side {
    fn join(&mut self, later: &Self) {
        self.volume.join(later.volume);
        self.area.join(later.area);
        if later.deepest > self.deepest {
            (self.deepest, self.place, self.other) = (later.deepest, later.place, later.other);
        }
    }
}

impl Tally {
    fn join(&mut self, later: &Self) {
        self.above.join(&later.above);
        self.below.join(&later.below);
        self.unaffected.join(later.unaffected);
        self.cells += later.cells;
    }

    /// The same seen from the other mesh.
    fn mirrored(mut self) -> Self {
        std::mem::swap(&mut self.above, &mut self.below);
        for side in [&mut self.above, &mut self.below] {
            side.place.z += side.other;
            side.other = -side.other;
        }
        self
    }

    fn into_between(self, frame: Frame, design_area: f64, existing_area: f64, double: [f64; 2]) -> Between {
        let depth = |side: &Side| (side.deepest > 0.0).then(|| Depth { depth: side.deepest, place: frame.to_world(side.place) });
        let (cut, fill, unaffected) = (self.below.area.value(), self.above.area.value(), self.unaffected.value());
        let mut common = self.below.area;
        common.join(self.above.area);
        common.join(self.unaffected);
        let rest = |area: f64| {
            let rest = area - common.value();
            if rest > AREA_ROUNDING * area { rest } else { 0.0 }
        };
        Between {
            cut: self.below.volume.value(),
            fill: self.above.volume.value(),
            areas: Areas { cut, fill, unaffected, design_uncovered: rest(design_area), existing_uncovered: rest(existing_area) },
            deepest_cut: depth(&self.below),
            deepest_fill: depth(&self.above),
            cells: self.cells,
            double,
        }
    }
}

/// Lays all triangles of `over` on `under`, in pieces of fixed size.
fn sweep(over: &Fabric, under: &Linked<'_>) -> Tally {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, Tally)>> = Mutex::default();
    rayon::broadcast(|_| {
        let mut walker = None;
        loop {
            let chunk = next.fetch_add(1, Ordering::Relaxed);
            let from = chunk * CHUNK;
            if from >= over.triangles.len() {
                break;
            }
            let walker = walker.get_or_insert_with(|| Walker::new(under));
            walker.reset();
            let mut tally = Tally::default();
            for t in from..(from + CHUNK).min(over.triangles.len()) {
                lay(over.corners(t as u32), walker, under, &mut tally);
            }
            done.lock().unwrap_or_else(PoisonError::into_inner).push((chunk, tally));
        }
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_unstable_by_key(|(chunk, _)| *chunk);
    let mut all = Tally::default();
    done.iter().for_each(|(_, tally)| all.join(tally));
    all
}

/// Lays one triangle on the mesh.
fn lay(corners: [DVec3; 3], walker: &mut Walker<'_>, under: &Linked<'_>, tally: &mut Tally) {
    let patch = Patch::new(corners);
    let scale = patch.double_area;
    let same = SAME_HEIGHT * scale;
    let mut sums = [[0.0; 2]; 2];
    let mut unaffected = 0.0;
    walker.over(&patch, |t, ring| {
        tally.cells += 1;
        let whole;
        let ring = if ring.edges().iter().all(|&e| e >= CUT) {
            // The whole triangle lies inside one of the other mesh, which may be far larger: heights are taken from its plane.
            whole = level_with(*ring, &patch, under.fabric.corners(t));
            &whole
        } else {
            ring
        };
        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        for c in ring.corners() {
            low = low.min(c[HEIGHT]);
            high = high.max(c[HEIGHT]);
        }
        if high > tally.above.deepest * scale {
            note_deepest(&mut tally.above, &patch, ring, high, 1.0);
        }
        if -low > tally.below.deepest * scale {
            note_deepest(&mut tally.below, &patch, ring, low, -1.0);
        }
        let (area, volume) = ring.measure();
        if high <= same && -low <= same {
            unaffected += area;
            add_volumes(&mut sums, ring, low, high, volume);
        } else if low == 0.0 {
            sums[0][0] += area;
            sums[0][1] += volume;
        } else if high == 0.0 {
            sums[1][0] += area;
            sums[1][1] -= volume;
        } else {
            let split = halves(ring);
            for (sum, half) in sums.iter_mut().zip(split) {
                sum[0] += half.0;
                sum[1] += half.1;
            }
        }
    });
    // The ring's coordinates are areas: they are `double_area` times as large as shares of the triangle.
    for (side, [area, volume]) in [&mut tally.above, &mut tally.below].into_iter().zip(sums) {
        side.area.add(0.5 * area / scale);
        side.volume.add(volume / scale / scale / 6.0);
    }
    tally.unaffected.add(0.5 * unaffected / scale);
}

/// Area and volume of the part of a ring above the other mesh, and of the part below.
fn halves(ring: &Ring) -> [(f64, f64); 2] {
    let mut part = Ring::EMPTY;
    ring.above(&mut part);
    let above = part.measure();
    ring.mirrored().above(&mut part);
    [above, part.measure()]
}

/// Adds volumes only.
fn add_volumes(sums: &mut [[f64; 2]; 2], ring: &Ring, low: f64, high: f64, volume: f64) {
    if low == 0.0 {
        sums[0][1] += volume;
    } else if high == 0.0 {
        sums[1][1] -= volume;
    } else {
        for (sum, half) in sums.iter_mut().zip(halves(ring)) {
            sum[1] += half.1;
        }
    }
}

/// The ring with heights above the plane of `plane`, taken directly.
fn level_with(mut ring: Ring, patch: &Patch, plane: [DVec3; 3]) -> Ring {
    let other = Patch::new(plane);
    // Seen from the plane, the height of a point is that of the plane above it: the other way round.
    ring.with_heights(|c: &Corner| -other.corner(patch.point(c))[HEIGHT] / other.double_area * patch.double_area);
    ring
}

#[cold]
fn note_deepest(side: &mut Side, patch: &Patch, ring: &Ring, height: f64, sign: f64) {
    if let Some(c) = ring.corners().iter().find(|c| c[HEIGHT] == height) {
        side.deepest = sign * height / patch.double_area;
        side.place = patch.point(c);
        side.other = -height / patch.double_area;
    }
}
