//! The certificate: figures measured on the very mesh that is written.

use super::SurfaceError;
use super::body::Body;
use super::buried::hidden;
use crate::kernel::orientation::{Turn, turn};
use crate::mesh::check::{self, HalfEdges, Soundness};
use crate::model::{Design, Line, Part, Tin};
use crate::sheet::Heights;
use crate::slope::closure::SNAP;
use crate::slope::cover::Covers;
use crate::slope::trim::Sheet;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Triangles lower than this (length units) are too small for an angle.
pub(crate) const MEASURABLE_HEIGHT: f64 = 1e-4;

/// Bounds of the slope (degrees): in planar strips, on cones.
pub(crate) const STRIP_BOUND: f64 = 0.01;
pub(crate) const CONE_BOUND: f64 = 0.1;

/// Slope triangles off by more than this (degrees) are counted.
const COUNTED: f64 = 0.1;

/// Triangles whose heights are compared with the closed form of the given line: at their corners and centroid, or where there are
/// fewer at about as many places inside of them.
const HEIGHT_SAMPLES: usize = 2048;

/// Rounding allowed on top of the tolerance, relative to the largest coordinate.
const ROUNDING: f64 = 1e-12;

/// What was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certificate {
    /// Whether every piece of crease has its counterpart.
    pub paired: bool,
    /// Largest deviation of a strip triangle from the slope, degrees.
    pub strip_max_deviation_deg: f64,
    /// Largest deviation of a triangle of a cone sector, degrees.
    pub sector_max_deviation_deg: f64,
    /// Slope triangles off by more than 0.1°.
    pub triangles_beyond_0_1deg: usize,
    /// Largest difference between the mesh and the closed form of the given line, at sampled places.
    pub height_max_deviation: f64,
    /// Whether the mesh is an oriented manifold without degenerate triangles or unused vertices.
    pub manifold: bool,
    /// Pairs of boundary edges that cross in plan.
    pub overlaps: usize,
    /// Whether every given segment is a chain of mesh edges, buried stretches aside.
    pub input_edges_kept: bool,
}

/// Measures the mesh.
///
/// # Errors
/// [`SurfaceError::Unsound`] if a figure is out of bounds.
pub(crate) fn measure(
    line: &Line,
    design: &Design,
    sheet: &Sheet,
    body: &Body,
    edges: &HalfEdges,
    open: &[[u32; 2]],
    covers: &Covers,
) -> Result<Certificate, SurfaceError> {
    let (soundness, height_max_deviation) = rayon::join(
        || check::check_with(&body.tin.vertices, &body.tin.triangles, edges, open),
        || height_deviation(line, design, &body.tin, |t| body.tin.parts[t] != Part::Platform),
    );
    let certificate = Certificate {
        paired: true,
        manifold: soundness.manifold(),
        overlaps: soundness.overlaps,
        input_edges_kept: edges_kept(sheet, body, edges, covers),
        height_max_deviation,
        ..Certificate::default()
    }
    .with(deviations(design, body));
    let flaw = if let Some(flaw) = flaw(&soundness, &body.tin) {
        Some(flaw)
    } else if certificate.strip_max_deviation_deg > STRIP_BOUND {
        Some(format!("a strip triangle is {:.4}° off the slope", certificate.strip_max_deviation_deg))
    } else if certificate.sector_max_deviation_deg > CONE_BOUND {
        Some(format!("a cone triangle is {:.4}° off the slope", certificate.sector_max_deviation_deg))
    } else if certificate.height_max_deviation > design.tolerance + height_rounding(&body.tin) {
        Some(format!("a height is {:.6} off the sheet, tolerance {}", certificate.height_max_deviation, design.tolerance))
    } else if !certificate.input_edges_kept {
        Some("a segment of the line is not an edge of the mesh".into())
    } else {
        None
    };
    match flaw {
        Some(what) => Err(SurfaceError::Unsound { what }),
        None => Ok(certificate),
    }
}

/// Deviations of the triangles of a sheet from its slope.
fn deviations(design: &Design, body: &Body) -> Deviations {
    let alpha = design.slope.ratio().atan();
    // Vertices closer than SNAP are taken for one where facets meet: what a move of a corner by as much does to a triangle says nothing
    // of its slope. A narrow one is out of bounds only where it takes more.
    let moved = SNAP.max(height_rounding(&body.tin));
    let measurable = |corners: [DVec3; 3], deviation: f64| {
        let width = width(corners);
        width > SNAP && (deviation <= STRIP_BOUND || deviation.to_radians() * width > moved)
    };
    let found = (0..body.on_cone.len()).into_par_iter().fold(Deviations::default, |mut found, t| {
        found.take(body.tin.corners(t), alpha, body.on_cone[t], measurable);
        found
    });
    found.reduce(Deviations::default, Deviations::join)
}

/// Largest deviations of triangles from their slope, in degrees.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Deviations {
    strips: f64,
    sectors: f64,
    beyond_0_1deg: usize,
}

impl Deviations {
    /// Takes a triangle of a slope of the angle `alpha` (radians), unless it is too small for an angle: lower than
    /// [`MEASURABLE_HEIGHT`], or not `measurable`, which is asked only where it matters, with the deviation (degrees).
    pub(crate) fn take(
        &mut self,
        [a, b, c]: [DVec3; 3],
        alpha: f64,
        on_cone: bool,
        measurable: impl Fn([DVec3; 3], f64) -> bool,
    ) {
        if a.z.max(b.z).max(c.z) - a.z.min(b.z).min(c.z) <= MEASURABLE_HEIGHT {
            return;
        }
        let normal = (b - a).cross(c - a);
        let deviation = (normal.truncate().length().atan2(normal.z) - alpha).abs().to_degrees();
        let worst = if on_cone { &mut self.sectors } else { &mut self.strips };
        if deviation > worst.min(COUNTED) && measurable([a, b, c], deviation) {
            *worst = worst.max(deviation);
            self.beyond_0_1deg += usize::from(deviation > COUNTED);
        }
    }

    fn join(self, other: Self) -> Self {
        Self {
            strips: self.strips.max(other.strips),
            sectors: self.sectors.max(other.sectors),
            beyond_0_1deg: self.beyond_0_1deg + other.beyond_0_1deg,
        }
    }
}

impl Certificate {
    /// The same with the deviations found.
    pub(crate) fn with(self, found: Deviations) -> Self {
        Self {
            strip_max_deviation_deg: found.strips,
            sector_max_deviation_deg: found.sectors,
            triangles_beyond_0_1deg: found.beyond_0_1deg,
            ..self
        }
    }
}

/// What is wrong with a mesh that is no manifold, or whose boundary crosses itself.
pub(crate) fn flaw(soundness: &Soundness, tin: &Tin) -> Option<String> {
    let near = |p: DVec3| format!("first near ({:.3}, {:.3})", p.x, p.y);
    if !soundness.manifold() {
        let turned = (0..tin.triangles.len()).find(|&t| {
            let [a, b, c] = tin.corners(t).map(DVec3::truncate);
            turn(a, b, c) != Turn::Left
        });
        let first = turned.map(|t| format!(" ({})", near(tin.world(tin.triangles[t][0] as usize))));
        return Some(format!(
            "{} triangles turned over or degenerate{}, {} edges used twice, {} unused vertices",
            soundness.turned,
            first.unwrap_or_default(),
            soundness.repeated_edges,
            soundness.unused
        ));
    }
    let at = tin.frame.to_world(soundness.overlap_at?.extend(0.0));
    Some(format!("its boundary crosses itself {} times, {}", soundness.overlaps, near(at)))
}

/// Width in plan: the least height of the triangle.
fn width(corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners.map(DVec3::truncate);
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
    (b - a).perp_dot(c - a).abs() / longest
}

/// Largest difference in height between the sheet of the given line and triangles of its slopes, sampled.
pub(crate) fn height_deviation(line: &Line, design: &Design, tin: &Tin, is_slope: impl Fn(usize) -> bool) -> f64 {
    let slopes: Vec<usize> = (0..tin.triangles.len()).filter(|&t| is_slope(t)).collect();
    let step = slopes.len().div_ceil(HEIGHT_SAMPLES).max(1);
    let heights = Heights::new(line, design.slope, design.sheet);
    // Few triangles may be large ones: each is then looked at in more places, the middles of a regular division.
    let division = (1..).take_while(|n| n * (n + 1) / 2 * slopes.len().max(1) <= HEIGHT_SAMPLES).last().unwrap_or(1);
    let mut points = Vec::new();
    for &t in slopes.iter().step_by(step) {
        let corners = tin.corners(t);
        points.extend(corners);
        let [a, b, c] = corners;
        let places = (0..division).flat_map(|i| (0..division - i).map(move |j| [i, j].map(|i| i as f64 + 1.0 / 3.0)));
        points.extend(places.map(|[u, v]| a + ((b - a) * u + (c - a) * v) / division as f64));
    }
    let places: Vec<DVec2> = points.iter().map(|&p| tin.frame.to_world(p).truncate()).collect();
    heights.many(&places).iter().zip(&points).map(|(h, p)| (h - p.z).abs()).fold(0.0, f64::max)
}

/// Rounding allowed on top of the tolerance.
pub(crate) fn height_rounding(tin: &Tin) -> f64 {
    ROUNDING * tin.vertices.iter().fold(1.0_f64, |m, p| m.max(p.abs().max_element()))
}

/// Whether consecutive points of every edge with a wanted side are joined by mesh edges, where the edge shows.
fn edges_kept(sheet: &Sheet, body: &Body, edges: &HalfEdges, covers: &Covers) -> bool {
    sheet.network.edges.par_iter().zip(&body.edge_points).enumerate().all(|(e, (edge, points))| {
        if !(edge.wanted[0] || edge.wanted[1]) {
            return true;
        }
        points.windows(2).all(|w| {
            let used = w.iter().all(|p| p.id != u32::MAX);
            let joined = used && (edges.has(w[0].id, w[1].id) || edges.has(w[1].id, w[0].id));
            joined || hidden(sheet, covers, e as u32).iter().any(|(s, _)| (s[0]..=s[1]).contains(&(0.5 * (w[0].s + w[1].s))))
        })
    })
}
