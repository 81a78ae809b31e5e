//! What is wrong with a mesh from anywhere, and where; its slopes and angles. Nothing is taken for granted: vertices may be no
//! numbers or not shared, triangles turned, upright, without area, there twice, over each other.
//!
//! The order matters. Vertices at exactly the same place are taken as one. Triangles that cannot be looked at (corners that are
//! no numbers, corners that fall together, triangles there twice) are told and left out, so that they do not show up again as
//! something else. What remains is looked at as edges, as boundary, as shapes, as cover of the plan and along its seams.

mod bound;
mod boundary;
mod edges;
mod faces;
mod finding;
mod overlap;
mod seams;
mod shape;
#[cfg(test)]
mod tests;
mod weld;

pub use bound::{Bound, Kept};
pub use boundary::{Loop, LoopKind, Piece};
pub use finding::{Finding, Kind, Place, Severity};
pub use shape::{ANGLE_BINS, Angles, Common, LEVEL_DEG, SLOPE_BINS, Share, Slopes, UPRIGHT_DEG};

use crate::kernel::frame::Frame;
use edges::Edges;
use faces::Faces;
use finding::Collector;
use glam::{DVec2, DVec3};
use shape::Spread;

/// Largest coordinate that is taken seriously, absolute. Its square, and the cube, are far from the end of all numbers.
pub const LIMIT: f64 = 1e15;

/// Triangles lower than this over their longest side are too thin for an angle to be told: at 0.1 mm, rounding to the micrometre
/// turns them by half a degree. In the unit of the mesh.
pub const THIN: f64 = 1e-4;

/// Triangles with a smaller angle are needles, in degrees.
pub const NEEDLE_DEG: f64 = 1.0;

/// What is closer together than this should be joined: a millimetre, in the unit of the mesh.
pub const GAP: f64 = 1e-3;

/// But no more than this share of the median length of sides, for meshes in kilometres or of very fine work.
pub const GAP_SHARE: f64 = 0.01;

/// Triangles that reach no deeper into each other than this share of the gap overlap by rounding only: a micrometre, where the
/// gap is a millimetre.
pub const HAIRLINE: f64 = 1e-3;

/// A mesh stands if it has this many times more area seen from the side than in plan.
const STANDING: f64 = 2.0;

/// A mesh as it came.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Vertices in world coordinates.
    pub vertices: &'a [DVec3],
    /// Vertex indices; those out of range are told as not usable.
    pub triangles: &'a [[u32; 3]],
    /// The face of the file each triangle is a part of, counted from 0. Empty: every triangle is a face.
    pub faces: &'a [u32],
    /// The group of each triangle, an index into `names`. Empty: all are in the first.
    pub groups: &'a [u32],
    /// Names of the groups; empty if there are none.
    pub names: &'a [String],
}

/// How to look at it.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Plan distance within which vertices and edges should be joined. `None`: [`GAP`], or [`GAP_SHARE`] of the median side if
    /// that is less.
    pub gap: Option<f64>,
    /// How many places of each kind are kept.
    pub places: usize,
    /// A slope to be kept.
    pub bound: Option<Bound>,
}

/// What a mesh is like.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// Everything found, worst kinds first.
    pub findings: Vec<Finding>,
    /// The plan distance used for seams.
    pub gap: f64,
    /// Lower left and upper right of the vertices used, in world coordinates; `None` without any.
    pub extent: Option<(DVec3, DVec3)>,
    /// The boundary, longest loops first.
    pub loops: Vec<Loop>,
    /// The pieces, largest first.
    pub pieces: Vec<Piece>,
    /// Slopes of the whole surface.
    pub slopes: Slopes,
    /// Slopes of the groups that have names, in their order.
    pub groups: Vec<Slopes>,
    /// Smallest angles.
    pub angles: Angles,
    /// How the stated slope is kept.
    pub kept: Option<Kept>,
}

impl Quality {
    /// Whether nothing is wrong with the mesh; a stated slope has no say in it.
    pub fn sound(&self) -> bool {
        self.findings.iter().all(|finding| finding.severity == Severity::Remark)
    }

    /// Whether the mesh is sound and keeps the slope stated, if one is.
    pub fn passed(&self) -> bool {
        self.sound() && self.kept.as_ref().is_none_or(|kept| kept.passed)
    }

    /// The finding of one kind.
    pub fn finding(&self, kind: Kind) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.kind == kind)
    }
}

/// A mesh about a local origin.
struct Subject<'a> {
    frame: Frame,
    vertices: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    faces: &'a [u32],
}

impl Subject<'_> {
    /// A place, numbered for people.
    fn place(&self, at: DVec3, triangles: &[usize], vertices: &[u32]) -> Place {
        Place {
            at: self.frame.to_world(at),
            triangles: triangles.iter().map(|&t| self.faces.get(t).map_or(t, |&face| face as usize) + 1).collect(),
            vertices: vertices.iter().map(|&v| v as usize + 1).collect(),
            figures: Vec::new(),
        }
    }
}

/// Looks at a mesh. Time and memory grow nearly in proportion to its size, unless very many triangles lie over each other; then
/// the search is given up in time, and says so. At most 2³⁰ triangles.
pub fn examine(mesh: &Mesh<'_>, options: &Options) -> Quality {
    let keep = options.places;
    let extent = extent(mesh);
    let frame = extent.map_or(Frame::WORLD, |(lo, hi)| Frame::around(lo.truncate(), hi.truncate()));
    let vertices: Vec<DVec3> = mesh.vertices.iter().map(|&v| frame.to_local(v)).collect();
    let subject = Subject { frame, vertices: &vertices, triangles: mesh.triangles, faces: mesh.faces };

    let mut found = Vec::new();
    let faces = Faces::new(&subject, keep, &mut found);
    let gap = options.gap.unwrap_or_else(|| fitting_gap(&faces));
    let edges = Edges::new(&faces, gap, keep, &mut found);
    let (loops, order) = boundary::loops(&faces, &edges, gap);
    let pieces = boundary::pieces(&faces, &edges);
    boundary::remarks(&loops, &pieces, keep, &mut found);
    found.extend(overlap::overlaps(&faces, HAIRLINE * gap, keep));
    found.extend(seams::seams(&faces, &edges, &order, gap, keep));

    let mut slopes = Spread::default();
    let mut groups: Vec<Spread> = mesh.names.iter().map(|_| Spread::default()).collect();
    let mut bound = options.bound.as_ref().map(|bound| bound::Measured::new(bound, keep));
    let mut seen = DVec3::ZERO;
    let angles = shape::measure(&faces, keep, &mut found, |f, shape| {
        let group = mesh.groups.get(faces.index[f] as usize).copied().unwrap_or(0);
        slopes.add(f, shape);
        if let Some(spread) = groups.get_mut(group as usize) {
            spread.add(f, shape);
        }
        if let Some(bound) = &mut bound {
            bound.add(&faces, f, group, shape);
        }
        let [a, b, c] = faces.points(f);
        seen += (b - a).cross(c - a).abs();
    });
    let mut standing = Collector::new(Kind::Standing, keep);
    if faces.len() > 0 && seen.x.max(seen.y) > STANDING * seen.z {
        standing.add(0.0, || faces.place(faces.centre(0), &[], &[]));
    }
    let mut empty = Collector::new(Kind::Empty, 0);
    if faces.len() == 0 {
        empty.add(0.0, || faces.place(DVec3::ZERO, &[], &[]));
    }
    found.extend([standing, empty]);
    Quality {
        findings: findings(found, &faces),
        gap,
        extent,
        loops,
        pieces,
        slopes: slopes.finish(&faces),
        groups: groups.into_iter().map(|spread| spread.finish(&faces)).collect(),
        angles,
        kept: bound.map(bound::Measured::finish),
    }
}

/// The findings in order, searches given up as one.
fn findings(found: Vec<Collector>, faces: &Faces<'_>) -> Vec<Finding> {
    let mut findings: Vec<Finding> = found.into_iter().filter_map(Collector::finish).collect();
    findings.sort_by_key(|finding| finding.kind);
    findings.dedup_by(|later, first| {
        let same = later.kind == first.kind;
        if same {
            first.count += later.count;
        }
        same
    });
    // A surface that is clockwise throughout is sound: it is seen from below.
    let up = faces.facing.contains(&faces::Facing::Up);
    if let Some(clockwise) = findings.iter_mut().find(|finding| finding.kind == Kind::Clockwise && !up) {
        clockwise.severity = Severity::Remark;
    }
    findings.sort_by_key(|finding| (finding.severity == Severity::Remark, finding.kind));
    findings
}

/// Box of the vertices that triangles use and that can be taken seriously.
fn extent(mesh: &Mesh<'_>) -> Option<(DVec3, DVec3)> {
    let mut all: Option<(DVec3, DVec3)> = None;
    for v in mesh.triangles.as_flattened() {
        if let Some(&p) = mesh.vertices.get(*v as usize).filter(|p| is_sound(**p)) {
            all = Some(all.map_or((p, p), |(lo, hi)| (lo.min(p), hi.max(p))));
        }
    }
    all
}

/// Whether a vertex can be taken seriously.
fn is_sound(p: DVec3) -> bool {
    p.is_finite() && p.abs().max_element() <= LIMIT
}

/// [`GAP`], or a share of the median side in plan.
fn fitting_gap(faces: &Faces<'_>) -> f64 {
    let side = |c: &[u32; 3]| -> f64 {
        let [a, b, _] = c.map(|v| -> DVec2 { faces.plan(v) });
        (b - a).length()
    };
    let mut sides: Vec<f64> = faces.corners.iter().map(side).filter(|&side| side > 0.0).collect();
    if sides.is_empty() {
        return GAP;
    }
    let middle = sides.len() / 2;
    let (_, median, _) = sides.select_nth_unstable_by(middle, f64::total_cmp);
    GAP.min(GAP_SHARE * *median)
}
