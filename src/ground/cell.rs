//! One cell of the common refinement: a triangle of the design over a triangle of the ground.
//!
//! Which corners a cell has is decided by exact signs on given vertices alone, never on computed points. So every corner has a
//! name that all cells around it agree on, also where vertices and edges of design and ground coincide, and cells are glued by
//! name, never by coordinates.

use super::patch::{NONE, Patch};
use super::shape::Shape;
use crate::kernel::orientation::{self, Turn, turn};
use glam::{DVec2, DVec3};

/// Name of a point of the common refinement. Edges are named by their ends, the lower first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Label {
    /// Vertex of the ground (also where a vertex of the design lies on it in plan).
    Ground(u32),
    /// Vertex of the design.
    Design(u32),
    /// An edge of the design and one of the ground cross in plan.
    Cross([u32; 2], [u32; 2]),
    /// An edge of the design meets a triangle of the ground.
    DesignMeets([u32; 2], u32),
    /// An edge of the ground meets a triangle of the design.
    GroundMeets([u32; 2], u32),
    /// Coinciding edges of design and ground change sides.
    EdgesMeet([u32; 2], [u32; 2]),
}

/// A corner of a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) label: Label,
    /// Place in plan.
    pub(crate) at: DVec2,
    /// Height of the design.
    pub(crate) z: f64,
    /// Height of the design above the ground.
    pub(crate) h: f64,
    /// The vertex of the design here, [`NONE`] if there is none.
    pub(crate) vertex: u32,
    /// Sides of the design triangle it lies on, one bit each.
    pub(crate) on_design: u8,
    /// Sides of the ground triangle it lies on, one bit each.
    pub(crate) on_ground: u8,
    /// The side from this corner to the next.
    pub(crate) side: Side,
}

/// What the side of a cell lies on: a side of the design triangle, of the ground triangle, both, or (inside) neither.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Side {
    pub(crate) design: Option<u8>,
    pub(crate) ground: Option<u8>,
}

impl Side {
    /// Through the inside of the cell.
    pub(crate) const INSIDE: Self = Self { design: None, ground: None };
}

/// Heights up to this (length units) count as none: the design then lies on the ground there.
pub(crate) const TOUCH: f64 = 1e-8;

/// On which side of the ground a corner lies.
pub(crate) fn class(h: f64) -> i8 {
    if h > TOUCH {
        1
    } else if h < -TOUCH {
        -1
    } else {
        0
    }
}

/// A corner while the cell is cut out.
#[derive(Clone, Copy, Debug)]
enum Raw {
    /// Corner of the design triangle.
    Design(u8),
    /// Corner of the ground triangle.
    Ground(u8),
    /// Side of the design triangle with the line of a side of the ground triangle.
    Cross(u8, u8),
}

/// Most corners a cell passes through: six, and one for each cut.
const MOST: usize = 9;

/// A triangle of the design and one of the ground, with the signs of their corners.
struct Pair<'a> {
    shape: &'a Shape,
    patch: &'a Patch,
    a: [u32; 3],
    b: [u32; 3],
    pa: [DVec3; 3],
    pb: [DVec3; 3],
    /// `design[i][k]`: side of ground side `k` on which design corner `i` lies; positive inside.
    design: [[i8; 3]; 3],
    /// `ground[j][i]`: side of design side `i` on which ground corner `j` lies; positive inside.
    ground: [[i8; 3]; 3],
}

/// Cuts out the cell of design triangle `a` and ground triangle `b`: its corners counter-clockwise in `out`, which stays empty
/// unless the two share some area.
pub(crate) fn cell(shape: &Shape, patch: &Patch, a: u32, b: u32, out: &mut Vec<Corner>) {
    out.clear();
    let Some(pair) = Pair::new(shape, patch, a, b) else { return };
    let mut corners: [(Raw, Side); MOST] = [(Raw::Design(0), Side::INSIDE); MOST];
    let mut count = 3;
    for (i, corner) in corners.iter_mut().enumerate().take(3) {
        *corner = (Raw::Design(i as u8), Side { design: Some(i as u8), ground: None });
    }
    for k in 0..3_u8 {
        count = pair.cut(&mut corners, count, k);
        if count < 3 {
            return;
        }
    }
    for &(raw, side) in &corners[..count] {
        let corner = pair.corner(raw, side);
        if out.last().is_none_or(|last: &Corner| last.label != corner.label) {
            out.push(corner);
        } else if let Some(last) = out.last_mut() {
            last.side = side;
        }
    }
    while out.len() > 1 && out[0].label == out[out.len() - 1].label {
        out.pop();
    }
    if out.len() < 3 {
        out.clear();
    }
}

impl<'a> Pair<'a> {
    /// `None` where a side of one has the whole other triangle on its outer side.
    fn new(shape: &'a Shape, patch: &'a Patch, a: u32, b: u32) -> Option<Self> {
        let (a, b) = (shape.triangles[a as usize], patch.triangles[b as usize]);
        let pa = a.map(|v| shape.vertices[v as usize]);
        let pb = b.map(|v| patch.vertices[v as usize]);
        let (min, max) = (|p: &[DVec3; 3]| p[0].min(p[1]).min(p[2]), |p: &[DVec3; 3]| p[0].max(p[1]).max(p[2]));
        if max(&pa).truncate().cmple(min(&pb).truncate()).any() || max(&pb).truncate().cmple(min(&pa).truncate()).any() {
            return None;
        }
        let ground = signs(&pb, &pa)?;
        let design = signs(&pa, &pb)?;
        Some(Self { shape, patch, a, b, pa, pb, design, ground })
    }

    /// The side of ground side `k` on which a corner lies.
    fn sign(&self, raw: Raw, k: u8) -> i8 {
        match raw {
            Raw::Design(i) => self.design[i as usize][k as usize],
            // Corner j lies on sides j − 1 and j.
            Raw::Ground(j) => i8::from(k == (j + 1) % 3),
            Raw::Cross(_, m) if m == k => 0,
            Raw::Cross(i, m) => {
                // On the line of side m, seen along it with the inside on the left: the crossing lies before the corner that
                // m shares with k, or beyond it, as that corner lies on one side of the design's side or the other.
                let (corner, ahead) = if k == (m + 1) % 3 { (k, 1) } else { (m, -1) };
                let leaving = if self.design[i as usize][m as usize] > 0 { 1 } else { -1 };
                self.ground[corner as usize][i as usize] * leaving * ahead
            }
        }
    }

    /// The corner where a side meets the line of ground side `k`, whose two sides its ends lie on.
    fn meet(&self, side: Side, k: u8) -> Raw {
        match side {
            Side { ground: Some(m), .. } => Raw::Ground(if k == (m + 1) % 3 { k } else { m }),
            Side { design, .. } => {
                let i = design.unwrap_or(0);
                let through = |j: u8| self.ground[j as usize][i as usize] == 0;
                if through(k) {
                    Raw::Ground(k)
                } else if through((k + 1) % 3) {
                    Raw::Ground((k + 1) % 3)
                } else {
                    Raw::Cross(i, k)
                }
            }
        }
    }

    /// Keeps what lies on the inner side of ground side `k`.
    fn cut(&self, corners: &mut [(Raw, Side); MOST], count: usize, k: u8) -> usize {
        let before = *corners;
        let along = Side { design: None, ground: Some(k) };
        let mut kept = 0;
        let mut push = |raw: Raw, side: Side| {
            if kept < MOST {
                corners[kept] = (raw, side);
                kept += 1;
            }
        };
        for n in 0..count {
            let (raw, side) = before[n];
            let (from, to) = (self.sign(raw, k), self.sign(before[(n + 1) % count].0, k));
            match (from, to) {
                (0, 0) => push(raw, Side { ground: Some(k), ..side }),
                (0.., 0..) => push(raw, side),
                (0, _) => push(raw, along),
                (1.., _) => {
                    push(raw, side);
                    push(self.meet(side, k), along);
                }
                (_, 1..) => push(self.meet(side, k), side),
                _ => {}
            }
        }
        kept
    }

    fn corner(&self, raw: Raw, side: Side) -> Corner {
        let (label, at, z, h) = match raw {
            Raw::Design(i) => self.design_corner(i),
            Raw::Ground(j) => self.ground_corner(j),
            Raw::Cross(i, k) => self.crossing(i, k),
        };
        let vertex = if let Raw::Design(i) = raw { self.a[i as usize] } else { NONE };
        let (on_design, on_ground) = match raw {
            Raw::Design(i) => (around(i), zeros(self.design[i as usize])),
            Raw::Ground(j) => (zeros(self.ground[j as usize]), around(j)),
            Raw::Cross(i, k) => (1 << i, 1 << k),
        };
        Corner { label, at, z, h, vertex, on_design, on_ground, side }
    }

    fn design_corner(&self, i: u8) -> (Label, DVec2, f64, f64) {
        let p = self.pa[i as usize];
        let on = self.design[i as usize];
        let zero = |k: usize| on[k] == 0;
        if let Some(j) = (0..3).find(|&j| zero(j) && zero((j + 2) % 3)) {
            return (Label::Ground(self.b[j]), p.truncate(), p.z, p.z - self.pb[j].z);
        }
        let ground = match (0..3).find(|&k| zero(k)) {
            Some(k) => on_edge(self.b, &self.patch.vertices, k, p.truncate()),
            None => on_plane(&self.pb, p.truncate()),
        };
        (Label::Design(self.a[i as usize]), p.truncate(), p.z, p.z - ground)
    }

    fn ground_corner(&self, j: u8) -> (Label, DVec2, f64, f64) {
        let p = self.pb[j as usize];
        let on = self.ground[j as usize];
        let zero = |i: usize| on[i] == 0;
        let z = if let Some(i) = (0..3).find(|&i| zero(i) && zero((i + 2) % 3)) {
            self.pa[i].z
        } else {
            match (0..3).find(|&i| zero(i)) {
                Some(i) => on_edge(self.a, &self.shape.vertices, i, p.truncate()),
                None => on_plane(&self.pa, p.truncate()),
            }
        };
        (Label::Ground(self.b[j as usize]), p.truncate(), z, z - p.z)
    }

    fn crossing(&self, i: u8, k: u8) -> (Label, DVec2, f64, f64) {
        let edge = |t: [u32; 3], i: u8| {
            let (v, w) = (t[i as usize], t[(i as usize + 1) % 3]);
            [v.min(w), v.max(w)]
        };
        let (design, ground) = (edge(self.a, i), edge(self.b, k));
        let [p, q] = design.map(|v| self.shape.vertices[v as usize]);
        let [r, s] = ground.map(|v| self.patch.vertices[v as usize]);
        let plan = |p: DVec3| p.truncate();
        let t = orientation::crossing([plan(p), plan(q)], [plan(r), plan(s)]);
        let at = plan(p).lerp(plan(q), t);
        let z = p.z + t * (q.z - p.z);
        // The place on the ground's edge follows from the one on the design's: were it found by itself, the two would be far
        // apart on edges that are all but parallel.
        let along = plan(s) - plan(r);
        let u = ((at - plan(r)).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (Label::Cross(design, ground), at, z, z - (r.z + u * (s.z - r.z)))
    }
}

/// The two sides that meet in a corner, as bits.
fn around(corner: u8) -> u8 {
    1 << corner | 1 << ((corner + 2) % 3)
}

/// The sides on which a corner lies by its signs, as bits.
fn zeros(signs: [i8; 3]) -> u8 {
    (0..3).filter(|&k| signs[k] == 0).map(|k| 1 << k).sum()
}

/// Signs of the corners of `p` against the sides of `q`; `None` if all lie on the outer side of one, or on it.
fn signs(p: &[DVec3; 3], q: &[DVec3; 3]) -> Option<[[i8; 3]; 3]> {
    let mut signs = [[0; 3]; 3];
    for k in 0..3 {
        let (from, to) = (q[k].truncate(), q[(k + 1) % 3].truncate());
        let mut inside = false;
        for i in 0..3 {
            signs[i][k] = match turn(from, to, p[i].truncate()) {
                Turn::Left => 1,
                Turn::Right => -1,
                Turn::Straight => 0,
            };
            inside |= signs[i][k] > 0;
        }
        if !inside {
            return None;
        }
    }
    Some(signs)
}

/// Height of side `k` of triangle `t` at a point on it, the same from both of its triangles.
fn on_edge(t: [u32; 3], vertices: &[DVec3], k: usize, at: DVec2) -> f64 {
    let (v, w) = (t[k], t[(k + 1) % 3]);
    let (p, q) = (vertices[v.min(w) as usize], vertices[v.max(w) as usize]);
    let d = (q - p).truncate();
    p.z + (at - p.truncate()).dot(d) / d.length_squared() * (q.z - p.z)
}

/// Height of a plane at a point in plan, from the nearest corner.
pub(crate) fn on_plane(p: &[DVec3; 3], at: DVec2) -> f64 {
    let d = p.map(|v| v.truncate().distance_squared(at));
    let i = if d[0] <= d[1] && d[0] <= d[2] { 0 } else { 1 + usize::from(d[2] < d[1]) };
    let (o, u, v) = (p[i], p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
    let w = at - o.truncate();
    let area = u.truncate().perp_dot(v.truncate());
    o.z + (w.perp_dot(v.truncate()) * u.z + u.truncate().perp_dot(w) * v.z) / area
}
