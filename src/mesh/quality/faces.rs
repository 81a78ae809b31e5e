//! The triangles that can be looked at, over welded vertices.

use super::finding::{Collector, Kind, Place};
use super::{LIMIT, Subject, is_sound, weld};
use crate::kernel::orientation::{Turn, turn};
use glam::{DVec2, DVec3};

/// Which way a triangle faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Facing {
    /// Counter-clockwise in plan.
    Up,
    /// Clockwise in plan.
    Down,
    /// Without area in plan, but with one in space.
    Upright,
    /// Without area.
    None,
}

/// The triangles that can be looked at: corners finite and different, no triangle twice.
pub(super) struct Faces<'a> {
    pub(super) subject: &'a Subject<'a>,
    /// Corners of each triangle: of vertices at the same place always the first.
    pub(super) corners: Vec<[u32; 3]>,
    /// Index of each triangle in the mesh.
    pub(super) index: Vec<u32>,
    /// Which way each one faces.
    pub(super) facing: Vec<Facing>,
}

impl<'a> Faces<'a> {
    /// Welds the vertices and sorts out what cannot be looked at; what that finds goes to `found`.
    pub(super) fn new(subject: &'a Subject<'a>, keep: usize, found: &mut Vec<Collector>) -> Self {
        let vertices = subject.vertices;
        let sound: Vec<bool> = vertices.iter().map(|&v| is_sound(v)).collect();
        let first = weld::first_at_same_place(vertices.len(), |i| weld::in_space(vertices[i]));
        let mut faces = Self { subject, corners: Vec::new(), index: Vec::new(), facing: Vec::new() };
        let mut used = vec![false; vertices.len()];
        let [mut not_usable, mut degenerate] = [Kind::NotUsable, Kind::Degenerate].map(|kind| Collector::new(kind, keep));
        for (t, triangle) in subject.triangles.iter().enumerate() {
            for &v in triangle {
                if let Some(used) = used.get_mut(v as usize) {
                    *used = true;
                }
            }
            let usable = |&v: &u32| sound.get(v as usize) == Some(&true);
            if !triangle.iter().all(usable) {
                let at = triangle.iter().find(|&v| usable(v)).map_or(DVec3::ZERO, |&v| vertices[v as usize]);
                not_usable.add(0.0, || subject.place(at, &[t], triangle));
                continue;
            }
            let [a, b, c] = triangle.map(|v| first[v as usize]);
            let facing = facing([a, b, c].map(|v| vertices[v as usize]));
            if facing == Facing::None {
                degenerate.add(0.0, || subject.place(vertices[a as usize], &[t], triangle));
            }
            if a != b && b != c && c != a {
                faces.corners.push([a, b, c]);
                faces.index.push(t as u32);
                faces.facing.push(facing);
            }
        }
        let [mut not_finite, mut unused, mut unshared] =
            [Kind::NotFinite, Kind::Unused, Kind::Unshared].map(|kind| Collector::new(kind, keep));
        for (v, &p) in vertices.iter().enumerate() {
            if !sound[v] {
                // A place must have figures that can be written.
                let at = DVec3::from_array(p.to_array().map(|x| if x.abs() <= LIMIT { x } else { 0.0 }));
                not_finite.add(0.0, || subject.place(at, &[], &[v as u32]));
            } else if !used[v] {
                unused.add(0.0, || subject.place(p, &[], &[v as u32]));
            } else if first[v] as usize != v {
                unshared.add(0.0, || subject.place(p, &[], &[first[v], v as u32]));
            }
        }
        let duplicate = faces.drop_duplicates(keep);
        found.extend([not_finite, not_usable, degenerate, duplicate, unused, unshared]);
        faces
    }

    /// Keeps the first of triangles with the same corners.
    fn drop_duplicates(&mut self, keep: usize) -> Collector {
        let mut found = Collector::new(Kind::Duplicate, keep);
        let sorted: Vec<[u32; 3]> = self
            .corners
            .iter()
            .map(|&c| {
                let mut c = c;
                c.sort_unstable();
                c
            })
            .collect();
        let key = |f: usize| [u64::from(sorted[f][0]) << 32 | u64::from(sorted[f][1]), u64::from(sorted[f][2]), 0];
        let first = weld::first_at_same_place(sorted.len(), key);
        if first.iter().enumerate().all(|(f, &g)| f == g as usize) {
            return found;
        }
        for (f, &g) in first.iter().enumerate() {
            let g = g as usize;
            if f != g {
                let pair = [g, f].map(|f| self.index[f] as usize);
                found.add(0.0, || self.subject.place(self.centre(f), &pair, &[]));
            }
        }
        let kept: Vec<usize> = (0..first.len()).filter(|&f| first[f] as usize == f).collect();
        self.corners = kept.iter().map(|&f| self.corners[f]).collect();
        self.index = kept.iter().map(|&f| self.index[f]).collect();
        self.facing = kept.iter().map(|&f| self.facing[f]).collect();
        found
    }

    /// Number of triangles.
    pub(super) fn len(&self) -> usize {
        self.corners.len()
    }

    /// A vertex.
    pub(super) fn point(&self, v: u32) -> DVec3 {
        self.subject.vertices[v as usize]
    }

    /// A vertex in plan.
    pub(super) fn plan(&self, v: u32) -> DVec2 {
        self.point(v).truncate()
    }

    /// Corners of a triangle.
    pub(super) fn points(&self, f: usize) -> [DVec3; 3] {
        self.corners[f].map(|v| self.point(v))
    }

    /// Corners of a triangle in plan, counter-clockwise if it has an area there.
    pub(super) fn plan_up(&self, f: usize) -> [DVec2; 3] {
        let [a, b, c] = self.points(f).map(DVec3::truncate);
        if self.facing[f] == Facing::Down { [a, c, b] } else { [a, b, c] }
    }

    /// Centre of a triangle.
    pub(super) fn centre(&self, f: usize) -> DVec3 {
        let [a, b, c] = self.points(f);
        (a + b + c) / 3.0
    }

    /// A place on triangles of this list.
    pub(super) fn place(&self, at: DVec3, faces: &[usize], vertices: &[u32]) -> Place {
        let numbers: Vec<usize> = faces.iter().map(|&f| self.index[f] as usize).collect();
        self.subject.place(at, &numbers, vertices)
    }
}

/// Which way a triangle faces; exact.
fn facing([a, b, c]: [DVec3; 3]) -> Facing {
    match turn(a.truncate(), b.truncate(), c.truncate()) {
        Turn::Left => Facing::Up,
        Turn::Right => Facing::Down,
        Turn::Straight => {
            let flat = |project: fn(DVec3) -> DVec2| turn(project(a), project(b), project(c)) == Turn::Straight;
            if flat(|p| DVec2::new(p.x, p.z)) && flat(|p| DVec2::new(p.y, p.z)) { Facing::None } else { Facing::Upright }
        }
    }
}
