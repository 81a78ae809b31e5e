//! Sums over the cells of the common refinement.

use super::cell::{CUT, HEIGHT, Patch, Ring};
use super::fabric::Linked;
use super::pieces::Pieces;
use super::volume::{AREA_ROUNDING, Areas, Between, Depth, SAME_HEIGHT};
use super::walker::Walker;
use crate::kernel::frame::Frame;
use crate::kernel::sum::Sum;
use glam::DVec3;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Triangles of a piece of work. Fixed, so that sums are taken in the same order on any number of threads.
const CHUNK: usize = 4096;

/// Figures of a piece of the work. Heights are those of the mesh laid over, above the other one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    above: Side,
    below: Side,
    unaffected: Sum,
    pub(super) cells: usize,
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
    pub(super) fn mirrored(mut self) -> Self {
        std::mem::swap(&mut self.above, &mut self.below);
        for side in [&mut self.above, &mut self.below] {
            side.place.z += side.other;
            side.other = -side.other;
        }
        self
    }

    /// Plan area of all cells.
    pub(super) fn common(&self) -> f64 {
        let mut common = self.below.area;
        common.join(self.above.area);
        common.join(self.unaffected);
        common.value()
    }

    /// The figures, if the mesh laid over is the design.
    pub(super) fn into_between(self, frame: Frame, design_area: f64, existing_area: f64) -> Between {
        let depth = |side: &Side| (side.deepest > 0.0).then(|| Depth { depth: side.deepest, place: frame.to_world(side.place) });
        let common = self.common();
        let rest = |area: f64| {
            let rest = area - common;
            if rest > AREA_ROUNDING * area { rest } else { 0.0 }
        };
        Between {
            cut: self.below.volume.value(),
            fill: self.above.volume.value(),
            areas: Areas {
                cut: self.below.area.value(),
                fill: self.above.area.value(),
                unaffected: self.unaffected.value(),
                design_uncovered: rest(design_area),
                existing_uncovered: rest(existing_area),
                within: None,
            },
            deepest_cut: depth(&self.below),
            deepest_fill: depth(&self.above),
            cells: self.cells,
            ..Between::default()
        }
    }
}

/// Lays all triangles of `over` on `under`.
pub(super) fn sweep(over: &impl Pieces, under: &Linked<'_>) -> Tally {
    let done = in_chunks(
        over.count(),
        || Walker::new(under),
        |walker, range| {
            let mut tally = Tally::default();
            walker.reset();
            for t in range {
                lay(over.piece(t), walker, under, &mut tally);
            }
            tally
        },
    );
    join(&done)
}

/// All triangles of `existing` against the plane at `elevation`, which is the design.
pub(super) fn level(existing: &impl Pieces, elevation: f64) -> Tally {
    let done = in_chunks(
        existing.count(),
        || (),
        |(), range| {
            let mut tally = Tally::default();
            for t in range {
                // The patch is the plane's: heights above the ground, places on the plane.
                let ground = existing.piece(t);
                let patch = Patch::new(ground.map(|p| DVec3::new(p.x, p.y, elevation)));
                let mut sums = Cells::default();
                sums.add(&Ring::whole(ground.map(|p| patch.corner(p))), &patch, &ground, &mut tally);
                sums.finish(&patch, &mut tally);
            }
            tally
        },
    );
    join(&done)
}

fn join(done: &[Tally]) -> Tally {
    let mut all = Tally::default();
    done.iter().for_each(|tally| all.join(tally));
    all
}

/// Works on the numbers below `count` in chunks of fixed size and returns what came out of each, in order: the same for any
/// number of threads. Each thread gets tools of its own.
pub(super) fn in_chunks<T, R: Send>(
    count: usize,
    tools: impl Fn() -> T + Sync,
    work: impl Fn(&mut T, Range<usize>) -> R + Sync,
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, R)>> = Mutex::new(Vec::new());
    rayon::broadcast(|_| {
        let mut mine = None;
        loop {
            let chunk = next.fetch_add(1, Ordering::Relaxed);
            let from = chunk.saturating_mul(CHUNK);
            if from >= count {
                break;
            }
            let result = work(mine.get_or_insert_with(&tools), from..(from + CHUNK).min(count));
            done.lock().unwrap_or_else(PoisonError::into_inner).push((chunk, result));
        }
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_unstable_by_key(|(chunk, _)| *chunk);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Lays one triangle on the mesh.
fn lay(corners: [DVec3; 3], walker: &mut Walker<'_>, under: &Linked<'_>, tally: &mut Tally) {
    let patch = Patch::new(corners);
    let mut cells = Cells::default();
    walker.over(&patch, |t, ring| {
        tally.cells += 1;
        let other = under.fabric.corners(t);
        if ring.edges().iter().all(|&e| e >= CUT) {
            // The whole triangle lies inside one of the other mesh, which may be far larger.
            cells.add(&patch.above_plane(other), &patch, &other, tally);
        } else {
            cells.add(ring, &patch, &other, tally);
        }
    });
    cells.finish(&patch, tally);
}

/// Sums over the cells of one patch, in its coordinates.
#[derive(Default)]
struct Cells {
    /// Area and volume above, and below.
    sides: [[f64; 2]; 2],
    unaffected: f64,
}

impl Cells {
    /// Adds a cell; `other` is the triangle it has in common with the patch.
    #[inline]
    fn add(&mut self, ring: &Ring, patch: &Patch, other: &[DVec3; 3], tally: &mut Tally) {
        let scale = patch.double_area;
        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        for c in ring.corners() {
            low = low.min(c[HEIGHT]);
            high = high.max(c[HEIGHT]);
        }
        if high > tally.above.deepest * scale && ring.has_area(patch, other) {
            note_deepest(&mut tally.above, patch, ring, high, 1.0);
        }
        if -low > tally.below.deepest * scale && ring.has_area(patch, other) {
            note_deepest(&mut tally.below, patch, ring, low, -1.0);
        }
        let (area, volume) = ring.measure();
        let parts = if low == 0.0 {
            [[area, volume], [0.0; 2]]
        } else if high == 0.0 {
            [[0.0; 2], [area, -volume]]
        } else {
            halves(ring)
        };
        let same = high.max(-low) <= SAME_HEIGHT * scale;
        if same {
            self.unaffected += area;
        }
        for (side, part) in self.sides.iter_mut().zip(parts) {
            side[0] += if same { 0.0 } else { part[0] };
            side[1] += part[1];
        }
    }

    /// Hands over the sums. The coordinates are areas: all is larger than shares of the triangle by powers of its double area.
    fn finish(self, patch: &Patch, tally: &mut Tally) {
        let scale = patch.double_area;
        for (side, [area, volume]) in [&mut tally.above, &mut tally.below].into_iter().zip(self.sides) {
            side.area.add(0.5 * area / scale);
            side.volume.add(volume / scale / scale / 6.0);
        }
        tally.unaffected.add(0.5 * self.unaffected / scale);
    }
}

/// Area and volume of the part of a ring above the other mesh, and of the part below.
fn halves(ring: &Ring) -> [[f64; 2]; 2] {
    let mut part = Ring::EMPTY;
    ring.above(&mut part);
    let above = part.measure();
    ring.mirrored().above(&mut part);
    let below = part.measure();
    [[above.0, above.1], [below.0, below.1]]
}

#[cold]
fn note_deepest(side: &mut Side, patch: &Patch, ring: &Ring, height: f64, sign: f64) {
    if let Some(c) = ring.corners().iter().find(|c| c[HEIGHT] == height) {
        side.deepest = sign * height / patch.double_area;
        side.place = patch.point(c);
        side.other = -height / patch.double_area;
    }
}
