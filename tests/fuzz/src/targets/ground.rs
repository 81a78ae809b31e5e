//! Small lines on small grounds: all that the program says about them, against sums over pairs of triangles.

use super::choices::Choices;
use super::messages::telling;
use super::oracle::{self, Polyline};
use super::{drawn, limits, tins};
use glam::{DVec2, DVec3};
use slopegen::ground::{Amounts, Ground, GroundError, Options, Site};
use slopegen::kernel::frame::Frame;
use slopegen::mesh::check::{HalfEdges, check};
use slopegen::model::{Design, Extent, Line, Part, Sheet, Side, Slope, Terrain, Tin};
use slopegen::overlay::{self, OverlayError};
use slopegen::pipeline::Wishes;
use slopegen::surface::SurfaceError;
use slopegen::terrain::check_overlap;
use slopegen::validate::check_steepness;

/// Rounding of brute force over the whole ground, relative to the product of area and height.
const ROUNDING: f64 = 1e-10;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let k = drawn::slope(&mut choices);
    let cut = if choices.below(2) == 0 { k } else { drawn::slope(&mut choices) };
    let width = [None, None, None, Some(1.0), Some(3.0), Some(8.0)][choices.below(6)];
    let direction = choices.below(4);
    let side = [None, None, None, Some(Side::Both), Some(Side::Left), Some(Side::Outside), Some(Side::Inside)][choices.below(7)];
    // A road has its slopes outside.
    let side = if width.is_some() { None } else { side };
    let tolerance = [0.01, 0.001, 0.1][choices.below(3)];
    let options = Options {
        allow_open: choices.below(2) == 0,
        finished: choices.below(4) != 3,
        stations: [None, Some(5.0)][choices.below(2)],
        keep: true,
    };
    let terrain = ground(&mut choices, k);
    let (line, typed) = match drawn::line(&mut choices, k.min(cut), width) {
        Ok(drawn) => drawn,
        Err(message) => return telling(&message),
    };
    if terrain.triangles.is_empty() {
        return;
    }
    if let Err(defects) = check_overlap(&terrain, "ground", &line, "a") {
        return telling(&defects.to_string());
    }
    let slope = |ratio: f64| Slope::from_ratio(ratio).expect("slopes are positive");
    let both = [(slope(k), Sheet::Falling), (slope(cut), Sheet::Rising)];
    let wanted = match direction {
        0 => &both[..1],
        1 => &both[1..],
        _ => &both[..],
    };
    let mut site = Site::new(&line, terrain.clone(), "ground");
    let mut designs = Vec::new();
    for &(slope, sheet) in wanted {
        if let Err(defects) = check_steepness(&line, "a", slope) {
            return telling(&defects.to_string());
        }
        let end = site.end(slope, sheet, tolerance);
        let wishes =
            Wishes { slope, sheet, side, extent: Some(Extent::Elevation(end)), interval: None, levels: Vec::new(), tolerance };
        match wishes.settle(&line, "a", &mut Vec::new()) {
            Ok(design) => designs.push(design),
            Err(error) => return telling(&error.to_string()),
        }
    }
    let shown = || {
        let ground = tins::obj(&terrain);
        format!("{typed}{ground}{k} {cut} {side:?} {width:?} {direction} {tolerance} {options:?}\n")
    };
    limits::show(&shown);
    match site.build(&designs, &options, &()) {
        Ok(built) => Look { line: &line, designs: &designs, terrain: &terrain, built: &built }.all(),
        Err(error) => match limit(&error) {
            Some(kind) => limits::note(kind, bytes, &format!("{error}\n{}", shown())),
            None => assert!(error.to_string().contains("\n   = help: "), "{error}"),
        },
    }
}

/// The kind of an error that is a limit of the program.
fn limit(error: &GroundError) -> Option<&'static str> {
    match error {
        GroundError::Surface(SurfaceError::Unclosed { .. }) => Some("ground-unclosed"),
        GroundError::Surface(SurfaceError::Unsound { .. }) => Some("ground-unsound-surface"),
        GroundError::Surface(SurfaceError::Flat { .. }) => Some("ground-flat"),
        GroundError::Surface(SurfaceError::Cancelled) => panic!("nobody cancelled"),
        GroundError::Cut { .. } => Some("ground-cut"),
        GroundError::OpenMesh { .. } => Some("ground-open-mesh"),
        GroundError::Unsound { .. } => Some("ground-unsound"),
        _ => None,
    }
}

/// Squares with diagonals either way, whole heights or any, with holes now and then.
fn ground(choices: &mut Choices<'_>, k: f64) -> Terrain {
    let style = choices.byte();
    let n = 2 + choices.below(5);
    let cell = [10.0, 16.0, 5.0, 4.0][choices.below(4)];
    let half = cell * n as f64 / 2.0;
    let rise = [0.0, 1.0, 2.0, 0.25][choices.below(4)] * k * cell / 4.0;
    let lift = choices.between(-1.0, 1.0) * if style & 1 == 0 { 0.0 } else { 8.0 * k };
    let lift = if style & 2 == 0 { lift.round() } else { lift };
    let mut vertices = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            let bump = f64::from(choices.byte() % 9) - 4.0;
            let inner = i > 0 && j > 0 && i < n && j < n;
            let jitter =
                if style & 4 != 0 && inner { DVec2::new(choices.part(), choices.part()) * 0.6 - 0.3 } else { DVec2::ZERO };
            let p = (DVec2::new(i as f64, j as f64) + jitter) * cell - half;
            vertices.push(p.extend(lift + rise * bump));
        }
    }
    let mut triangles = Vec::new();
    let holes = if style & 24 == 24 { choices.byte() } else { 0 };
    for i in 0..n {
        for j in 0..n {
            let at = |i: usize, j: usize| (i * (n + 1) + j) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if holes >> ((i * n + j) % 8) & 1 == 1 {
                continue;
            }
            triangles.extend(if style & 32 == 0 || (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    Terrain { frame: Frame::WORLD, vertices, triangles }
}

/// Lower heights count for the volumes, but not for the meshes.
const TOUCH: f64 = 1e-8;

struct Look<'a> {
    line: &'a Line,
    designs: &'a [Design],
    terrain: &'a Terrain,
    built: &'a Ground,
}

impl Look<'_> {
    fn all(&self) {
        sound(&self.built.design, "design");
        self.heights();
        self.sums();
        if let Some(finished) = &self.built.finished {
            sound(finished, "finished ground");
            self.worth(finished);
        }
    }

    /// Slopes against the envelopes of all cones.
    fn heights(&self) {
        let chain = |c: &slopegen::model::Chain| Polyline {
            points: c.vertices.iter().map(|v| v.to_array()).collect(),
            closed: c.closed(),
        };
        let lines: Vec<Polyline> = self.line.chains.iter().map(chain).collect();
        let tin = &self.built.design;
        let step = tin.triangles.len() / 100 + 1;
        for t in (0..tin.triangles.len()).step_by(step) {
            let sheet = match tin.parts[t] {
                Part::FillSlope => Sheet::Falling,
                Part::CutSlope => Sheet::Rising,
                _ => continue,
            };
            let design = self.designs.iter().find(|d| d.sheet == sheet).expect("slopes are of a design");
            let scale = self.line.chains.iter().flat_map(|c| &c.vertices).fold(100.0, |m, v| v.abs().max_element().max(m));
            let [a, b, c] = tin.corners(t);
            for p in [(a + b + c) / 3.0, 0.5 * (a + b), a] {
                let w = tin.frame.to_world(p);
                let z = oracle::height(&lines, design.slope.ratio(), sheet == Sheet::Rising, w.x, w.y);
                assert!((z - w.z).abs() <= design.tolerance + 1e-10 * scale, "height {} for {z} at ({}, {})", w.z, w.x, w.y);
            }
        }
    }

    /// All by part, and all by station, is all.
    fn sums(&self) {
        let tallied = &self.built.tallied;
        let total = tallied.total;
        assert!(
            [total.cut, total.fill, total.cut_area, total.fill_area, total.level_area].iter().all(|v| v.is_finite() && *v >= 0.0),
            "{total:?}"
        );
        let parts = Amounts::sum([&tallied.platform, &tallied.fill_slope, &tallied.cut_slope]);
        let stations = Amounts::sum(tallied.axes.iter().flatten().map(|i| &i.amounts).chain([&tallied.pads]));
        for other in [parts, stations] {
            let bound = ROUNDING * (1.0 + total.cut + total.fill);
            assert!((other.cut - total.cut).abs() <= bound && (other.fill - total.fill).abs() <= bound, "{other:?} {total:?}");
        }
        let area: f64 = (0..self.built.design.triangles.len()).map(|t| area(self.built.design.corners(t))).sum();
        if self.built.complete {
            assert!((area - total.plan_area()).abs() <= 1e-6 * (1.0 + area), "plan area {} for {area}", total.plan_area());
        }
    }

    /// Cut and fill against the volume between the ground before and after.
    fn worth(&self, finished: &Tin) {
        let after = Terrain { frame: finished.frame, vertices: finished.vertices.clone(), triangles: finished.triangles.clone() };
        let total = self.built.tallied.total;
        let whole: f64 = (0..self.terrain.triangles.len()).map(|t| area(self.terrain.corners(t))).sum();
        let high = self.terrain.vertices.iter().chain(&after.vertices).fold(0.0, |m: f64, v| m.max(v.z.abs()));
        let bound = (ROUNDING * (1.0 + high) + TOUCH) * (1.0 + whole);
        match overlay::between(&after, self.terrain, None) {
            Ok(found) => {
                assert!((found.cut - total.cut).abs() <= bound, "cut {}, by the overlay {}", total.cut, found.cut);
                assert!((found.fill - total.fill).abs() <= bound, "fill {}, by the overlay {}", total.fill, found.fill);
            }
            Err(error @ OverlayError::Double { .. }) => panic!("{error}"),
            Err(error) => panic!("the finished ground is elsewhere: {error}"),
        }
        let [cut, fill] = clipped(&after, self.terrain);
        assert!((cut - total.cut).abs() <= bound, "cut {}, by brute force {cut}", total.cut);
        assert!((fill - total.fill).abs() <= bound, "fill {}, by brute force {fill}", total.fill);
        // Also where works go on beyond the ground: they end with it.
        let covered: f64 = (0..after.triangles.len()).map(|t| area(after.corners(t))).sum();
        assert!((covered - whole).abs() <= ROUNDING * (1.0 + whole), "the finished ground has {covered} of {whole}");
    }
}

fn sound(tin: &Tin, what: &str) {
    assert_eq!(tin.parts.len(), tin.triangles.len());
    assert!(tin.vertices.iter().all(|v| v.is_finite()));
    let edges = HalfEdges::new(tin.vertices.len(), &tin.triangles);
    let sound = check(&tin.vertices, &tin.triangles, &edges);
    assert!(sound.turned == 0 && sound.repeated_edges == 0 && sound.overlaps == 0, "{what}: {sound:?}");
}

fn area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).truncate().perp_dot((c - a).truncate())
}

/// Cut and fill, every triangle against every other.
fn clipped(design: &Terrain, existing: &Terrain) -> [f64; 2] {
    let mut sums = [0.0; 2];
    let shift = (design.frame.origin() - existing.frame.origin()).extend(0.0);
    let boxed = |t: [DVec3; 3]| (t[0].min(t[1]).min(t[2]).truncate(), t[0].max(t[1]).max(t[2]).truncate());
    for d in 0..design.triangles.len() {
        let top = design.corners(d).map(|p| p + shift);
        let (lo, hi) = boxed(top);
        for e in 0..existing.triangles.len() {
            let base = existing.corners(e);
            let (low, high) = boxed(base);
            if lo.cmpgt(high).any() || low.cmpgt(hi).any() {
                continue;
            }
            let mut piece = top.to_vec();
            for i in 0..3 {
                let (a, b) = (base[i].truncate(), base[(i + 1) % 3].truncate());
                piece = keep(&piece, |p| (b - a).perp_dot(p.truncate() - a));
            }
            let over: Vec<DVec3> = piece.iter().map(|p| DVec3::new(p.x, p.y, p.z - plane(base, p.truncate()))).collect();
            sums[0] -= volume(&keep(&over, |p| -p.z));
            sums[1] += volume(&keep(&over, |p| p.z));
        }
    }
    sums
}

fn plane([a, b, c]: [DVec3; 3], p: DVec2) -> f64 {
    let normal = (b - a).cross(c - a);
    a.z - (normal.x * (p.x - a.x) + normal.y * (p.y - a.y)) / normal.z
}

/// The part of a convex polygon on which a linear function is not negative.
fn keep(polygon: &[DVec3], f: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (s, t) = (f(p), f(q));
        if s >= 0.0 {
            kept.push(p);
        }
        if (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0) {
            kept.push(p + (q - p) * (s / (s - t)));
        }
    }
    kept
}

fn volume(polygon: &[DVec3]) -> f64 {
    (2..polygon.len())
        .map(|i| area([polygon[0], polygon[i - 1], polygon[i]]) * (polygon[0].z + polygon[i - 1].z + polygon[i].z) / 3.0)
        .sum()
}
