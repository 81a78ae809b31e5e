//! Goes through the triangles of a mesh that share plan area with a given one.

use super::cell::{CUT, Corner, Patch, Ring, clip};
use super::fabric::Linked;
use crate::kernel::plan_box::PlanBox;
use crate::mesh::neighbours::NONE;
use glam::{DVec2, DVec3};
use std::ops::ControlFlow;

/// Steps of a walk towards a point before the tree is asked instead.
const LONGEST_WALK: usize = 256;

/// A triangle still to be entered, through one of its half-edges.
struct Step {
    half: u32,
    /// Ends of that half-edge.
    from: Corner,
    to: Corner,
}

/// One thread's means to go about a mesh.
pub(super) struct Walker<'a> {
    mesh: &'a Linked<'a>,
    /// Round in which each triangle was last looked at.
    seen: Vec<u32>,
    round: u32,
    steps: Vec<Step>,
    /// Where the last walk ended.
    hint: u32,
    ring: Ring,
    spare: Ring,
}

impl<'a> Walker<'a> {
    pub(super) fn new(mesh: &'a Linked<'a>) -> Self {
        let seen = vec![0; mesh.fabric.triangles.len()];
        Self { mesh, seen, round: 0, steps: Vec::new(), hint: NONE, ring: Ring::EMPTY, spare: Ring::EMPTY }
    }

    /// Forgets where it is, so that what follows does not depend on what was before.
    pub(super) fn reset(&mut self) {
        self.hint = NONE;
    }

    /// Calls `visit` with every triangle that shares plan area with the patch and with the part they share, each once.
    ///
    /// From one triangle inside, neighbours are entered across the edges that run through the patch. All that cannot be reached
    /// so has a rim inside the patch, so the triangles at the rim are tried too. A sliver shares no area with anything.
    pub(super) fn over(&mut self, patch: &Patch, mut visit: impl FnMut(u32, &Ring)) {
        if patch.is_sliver() {
            return;
        }
        self.round = self.round.wrapping_add(1);
        if self.round == 0 {
            self.seen.fill(0);
            self.round = 1;
        }
        let [a, b, c] = patch.corners.map(DVec3::truncate);
        let mut found = false;
        if let Some(t) = self.walk((a + b + c) / 3.0) {
            self.hint = t;
            found = self.enter(t, patch, &mut visit);
        }
        let bounds = PlanBox::of([a, b, c]);
        let mesh = self.mesh;
        mesh.rim_boxes.meeting(&bounds, |run| {
            for i in run {
                found |= self.enter_near(mesh.rim[i], &bounds, patch, &mut visit);
            }
            ControlFlow::Continue(())
        });
        if !found {
            mesh.boxes.meeting(&bounds, |run| {
                for t in run {
                    if self.enter_near(t as u32, &bounds, patch, &mut visit) {
                        self.hint = t as u32;
                        return ControlFlow::Break(());
                    }
                }
                ControlFlow::Continue(())
            });
        }
    }

    /// Like [`Self::over`], but asks the tree for all triangles: also finds those that lie on others.
    pub(super) fn over_all(&mut self, patch: &Patch, mut visit: impl FnMut(u32, &Ring)) {
        if patch.is_sliver() {
            return;
        }
        self.round = self.round.wrapping_add(1).max(1);
        let bounds = PlanBox::of(patch.corners.map(DVec3::truncate));
        let mesh = self.mesh;
        mesh.boxes.meeting(&bounds, |run| {
            for t in run {
                self.enter_near(t as u32, &bounds, patch, &mut visit);
            }
            ControlFlow::Continue(())
        });
    }

    fn enter_near(&mut self, t: u32, bounds: &PlanBox, patch: &Patch, visit: &mut impl FnMut(u32, &Ring)) -> bool {
        self.seen[t as usize] != self.round && self.mesh.fabric.bounds(t).meets(bounds) && self.enter(t, patch, visit)
    }

    /// Enters triangle `t` and all that can be reached from it. Whether it shares area with the patch.
    fn enter(&mut self, t: u32, patch: &Patch, visit: &mut impl FnMut(u32, &Ring)) -> bool {
        self.seen[t as usize] = self.round;
        let corners = self.mesh.fabric.corners(t).map(|p| patch.corner(p));
        let Some(ring) = clip(&corners, &mut self.ring, &mut self.spare) else { return false };
        leave(self.mesh, &self.seen, self.round, &mut self.steps, t, &corners, ring);
        visit(t, ring);
        while let Some(Step { half, from, to }) = self.steps.pop() {
            let (t, e) = (half / 3, half as usize % 3);
            if self.seen[t as usize] == self.round {
                continue;
            }
            self.seen[t as usize] = self.round;
            let fabric = self.mesh.fabric;
            let apex = fabric.vertices[fabric.triangles[t as usize][(e + 2) % 3] as usize];
            let mut corners = [[0.0; 4]; 3];
            corners[e] = from;
            corners[(e + 1) % 3] = to;
            corners[(e + 2) % 3] = patch.corner(apex);
            if let Some(ring) = clip(&corners, &mut self.ring, &mut self.spare) {
                leave(self.mesh, &self.seen, self.round, &mut self.steps, t, &corners, ring);
                visit(t, ring);
            }
        }
        true
    }

    /// A triangle at `p`, reached through neighbours; `None` if the way is barred or long. Near edges it may be the one beside.
    fn walk(&self, p: DVec2) -> Option<u32> {
        let mesh = self.mesh;
        if self.hint == NONE {
            return None;
        }
        let (mut t, mut entered) = (self.hint, NONE);
        for _ in 0..LONGEST_WALK {
            let corners = mesh.fabric.corners(t).map(DVec3::truncate);
            let beyond = (0..3_u32).find(|&e| {
                let (a, b) = (corners[e as usize], corners[(e as usize + 1) % 3]);
                3 * t + e != entered && (b - a).perp_dot(p - a) < 0.0
            });
            let Some(e) = beyond else { return Some(t) };
            entered = mesh.opposite[(3 * t + e) as usize];
            if entered == NONE {
                return None;
            }
            t = entered / 3;
        }
        None
    }
}

/// Notes the neighbours of `t` across the edges that the ring has left.
#[inline]
fn leave(mesh: &Linked<'_>, seen: &[u32], round: u32, steps: &mut Vec<Step>, t: u32, corners: &[Corner; 3], ring: &Ring) {
    for &e in ring.edges() {
        if e < CUT {
            let e = e as usize;
            let half = mesh.opposite[3 * t as usize + e];
            if half != NONE && seen[half as usize / 3] != round {
                steps.push(Step { half, from: corners[(e + 1) % 3], to: corners[e] });
            }
        }
    }
}
