//! The engine without ground: small lines, all slopes, sides and ends.

use super::choices::Choices;
use super::messages::telling;
use super::{drawn, limits, oracle};
use glam::{DVec2, DVec3};
use oracle::Polyline;
use slopegen::mesh::check::{HalfEdges, check};
use slopegen::model::{Design, Extent, Line, Part, Sheet, Side, Slope};
use slopegen::pipeline::Wishes;
use slopegen::surface::{self, Surface, SurfaceError};
use slopegen::validate::check_steepness;

/// Rounding of brute force, relative to the largest coordinate.
const ROUNDING: f64 = 1e-11;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let k = drawn::slope(&mut choices);
    let sheet = if choices.below(2) == 0 { Sheet::Falling } else { Sheet::Rising };
    let side =
        [None, Some(Side::Both), Some(Side::Left), Some(Side::Right), Some(Side::Inside), Some(Side::Outside)][choices.below(6)];
    let fine = [0.01, 0.003, 0.03][choices.below(3)];
    let deep = [1.0, 2.0, 4.0, 10.0, 0.5, choices.between(0.1, 12.0)][choices.below(6)];
    let reached = choices.below(3);
    // Coarse, so that meshes are small.
    let tolerance = fine * k.max(1.0) * deep.max(1.0);
    let levels = [0.0, 3.0, 8.0][choices.below(3)];
    let width = [None, None, None, Some(1.0), Some(3.0), Some(8.0)][choices.below(6)];
    // A road has its slopes outside.
    let side = if width.is_some() { None } else { side };
    let (line, typed) = match drawn::line(&mut choices, k, width) {
        Ok(drawn) => drawn,
        Err(message) => return telling(&message),
    };
    let (low, high) = line.elevation_range();
    let interval = (levels > 0.0).then_some((high - low + deep * k) / levels);
    let extent = match (reached, sheet) {
        (0, Sheet::Falling) => Extent::Elevation(low - deep * k),
        (0, Sheet::Rising) => Extent::Elevation(high + deep * k),
        (1, _) => Extent::Height(deep * k),
        _ => Extent::Distance(deep),
    };
    let slope = Slope::from_ratio(k).expect("slopes are positive");
    if let Err(defects) = check_steepness(&line, "a", slope) {
        return telling(&defects.to_string());
    }
    let wishes = Wishes { slope, sheet, side, extent: Some(extent), interval, levels: Vec::new(), tolerance };
    let design = match wishes.settle(&line, "a", &mut Vec::new()) {
        Ok(design) => design,
        Err(error) => return telling(&error.to_string()),
    };
    let shown = || format!("{typed}{wishes:?}\n");
    limits::show(&shown);
    match surface::build(&line, &design, None, &()) {
        Ok(surface) => Look { line: &line, design: &design, surface: &surface, bytes, shown: &shown }.all(),
        Err(error) => refused(&error, bytes, &shown),
    }
}

/// Limits of the program are noted, other refusals have a cure.
fn refused(error: &SurfaceError, bytes: &[u8], shown: &dyn Fn() -> String) {
    let kind = match error {
        SurfaceError::Unclosed { .. } => "unclosed",
        SurfaceError::Flat { .. } => "flat",
        SurfaceError::Unsound { .. } => "unsound",
        SurfaceError::Cancelled => panic!("nobody cancelled"),
        _ => return assert!(error.to_string().contains("\n   = help: "), "{error}"),
    };
    limits::note(kind, bytes, &format!("{error}\n{}", shown()));
}

struct Look<'a> {
    line: &'a Line,
    design: &'a Design,
    surface: &'a Surface,
    bytes: &'a [u8],
    shown: &'a dyn Fn() -> String,
}

impl Look<'_> {
    fn all(&self) {
        self.mesh();
        self.heights();
        self.cover();
        self.volumes();
        self.mirrored();
    }

    fn polylines(&self) -> Vec<Polyline> {
        let chain = |c: &slopegen::model::Chain| Polyline {
            points: c.vertices.iter().map(|v| v.to_array()).collect(),
            closed: c.closed(),
        };
        self.line.chains.iter().map(chain).collect()
    }

    /// The largest coordinate in the world, or 1.
    fn scale(&self) -> f64 {
        self.line.chains.iter().flat_map(|c| &c.vertices).fold(1.0, |m, v| m.max(v.abs().max_element()))
    }

    fn corners(&self, t: usize) -> [DVec3; 3] {
        self.surface.tin.corners(t)
    }

    fn mesh(&self) {
        let tin = &self.surface.tin;
        assert!(!tin.triangles.is_empty());
        assert_eq!(tin.parts.len(), tin.triangles.len());
        assert!(tin.vertices.iter().all(|v| v.is_finite()));
        let edges = HalfEdges::new(tin.vertices.len(), &tin.triangles);
        let sound = check(&tin.vertices, &tin.triangles, &edges);
        assert!(sound.manifold() && sound.overlaps == 0, "{sound:?}");
        let slopes = if self.design.sheet == Sheet::Falling { Part::FillSlope } else { Part::CutSlope };
        assert!(tin.parts.iter().all(|&p| p == slopes || p == Part::Platform));
    }

    /// Whether the edge of a platform lies below the slope of another edge, be it by less than the tolerance: that slope would have to
    /// pass over the platform, and is no part of what is built.
    fn is_covered(&self) -> bool {
        /// Places looked at on each edge.
        const PLACES: u32 = 16;
        let (lines, rising, k) = (self.polylines(), self.design.sheet == Sheet::Rising, self.design.slope.ratio());
        let sign = if rising { -1.0 } else { 1.0 };
        let rings = self.line.chains.iter().filter(|chain| chain.closed()).map(|chain| &chain.vertices);
        let edges = rings.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
        let mut places = edges.flat_map(|(a, b)| (0..PLACES).map(move |i| a.lerp(*b, f64::from(i) / f64::from(PLACES))));
        places.any(|p| sign * (oracle::height(&lines, k, rising, p.x, p.y) - p.z) > ROUNDING * self.scale())
    }

    /// Slopes against the envelope of all cones.
    fn heights(&self) {
        if self.is_covered() {
            return;
        }
        let (lines, rising, k) = (self.polylines(), self.design.sheet == Sheet::Rising, self.design.slope.ratio());
        let allowed = self.design.tolerance + ROUNDING * self.scale();
        let step = self.surface.tin.triangles.len() / 200 + 1;
        for t in (0..self.surface.tin.triangles.len()).step_by(step) {
            if self.surface.tin.parts[t] == Part::Platform {
                continue;
            }
            let [a, b, c] = self.corners(t);
            for p in [(a + b + c) / 3.0, 0.5 * (a + b), 0.5 * (b + c), a] {
                let w = self.surface.tin.frame.to_world(p);
                let z = oracle::height(&lines, k, rising, w.x, w.y);
                assert!((z - w.z).abs() <= allowed, "height {} for {z} at ({}, {})", w.z, w.x, w.y);
            }
        }
    }

    /// No place is covered twice; where it is known what is covered, it is.
    fn cover(&self) {
        let lines = self.polylines();
        let (rising, k) = (self.design.sheet == Sheet::Rising, self.design.slope.ratio());
        let tin = &self.surface.tin;
        let plans: Vec<[DVec2; 3]> = (0..tin.triangles.len()).map(|t| self.corners(t).map(DVec3::truncate)).collect();
        let boxes: Vec<[DVec2; 2]> = plans.iter().map(|[a, b, c]| [a.min(*b).min(*c), a.max(*b).max(*c)]).collect();
        let (mut lo, mut hi) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for [low, high] in &boxes {
            (lo, hi) = (lo.min(*low), hi.max(*high));
        }
        let rings = lines.iter().any(|l| l.closed);
        const SIDE: usize = 12;
        for i in 0..SIDE * SIDE {
            // Off every symmetry.
            let w = DVec2::new((i % SIDE) as f64 + 0.382, (i / SIDE) as f64 + 0.618) / SIDE as f64;
            let p = lo + (hi - lo) * w;
            let margin = 1e-9 * (hi - lo).max_element();
            let mut count = 0;
            let mut near = false;
            let mut on_slope = false;
            for (t, &[low, high]) in boxes.iter().enumerate() {
                if p.x < low.x - margin || p.y < low.y - margin || p.x > high.x + margin || p.y > high.y + margin {
                    continue;
                }
                let [a, b, c] = plans[t];
                let sides = [(a, b), (b, c), (c, a)].map(|(a, b)| (b - a).perp_dot(p - a) / (b - a).length());
                let least = sides[0].min(sides[1]).min(sides[2]);
                count += usize::from(least > margin);
                near |= least.abs() <= margin;
                on_slope |= least > margin && tin.parts[t] != Part::Platform;
            }
            assert!(count <= 1, "({}, {}) is covered {count} times", p.x, p.y);
            if near {
                continue;
            }
            let world = tin.frame.to_world(p.extend(0.0));
            let z = oracle::height(&lines, k, rising, world.x, world.y);
            let slack = 2.0 * self.design.tolerance + ROUNDING * self.scale();
            match self.design.extent {
                Extent::Elevation(end)
                    if self.design.side_of_lines == Side::Both && (!rings || self.design.side_of_rings == Side::Both) =>
                {
                    let above = if rising { end - z } else { z - end };
                    // A tolerance in height is one over the slope in plan.
                    if above.abs() > slack {
                        assert_eq!(count == 1, above > 0.0, "({}, {}) lies {above} above the end", world.x, world.y);
                    }
                }
                Extent::Elevation(_) => {}
                Extent::Height(h) | Extent::Distance(h) => {
                    let far = if matches!(self.design.extent, Extent::Height(_)) { h / k } else { h };
                    // On slopes: no further from the line than the longest ruling.
                    if on_slope {
                        let d = distance(&lines, world.truncate());
                        assert!(d <= far + slack / k + slack, "({}, {}) is {d} from the line, {far} asked for", world.x, world.y);
                    }
                }
            }
        }
    }

    /// Sums of prisms over all triangles.
    fn volumes(&self) {
        let v = &self.surface.volumes;
        let (mut cut, mut fill, mut plan) = (0.0, 0.0, 0.0);
        for t in 0..self.surface.tin.triangles.len() {
            let corners = self.corners(t);
            plan += area(corners);
            fill += above(corners, v.reference);
            cut += above(corners.map(|p| DVec3::new(p.x, p.y, -p.z)), -v.reference);
        }
        let bound = 1e-9 * (cut + fill) + 1e-9 * plan;
        assert!((cut - v.cut).abs() <= bound, "cut {} for {cut}", v.cut);
        assert!((fill - v.fill).abs() <= bound, "fill {} for {fill}", v.fill);
        assert!((plan - self.surface.areas.plan).abs() <= 1e-9 * plan, "area {} for {plan}", self.surface.areas.plan);
    }

    /// The other sheet of the line upside down has the same volumes.
    fn mirrored(&self) {
        let mut line = self.line.clone();
        line.chains.iter_mut().flat_map(|c| &mut c.vertices).for_each(|v| v.z = -v.z);
        line.breaklines.iter_mut().flat_map(|c| &mut c.vertices).for_each(|v| v.z = -v.z);
        let sheet = if self.design.sheet == Sheet::Falling { Sheet::Rising } else { Sheet::Falling };
        let extent = if let Extent::Elevation(z) = self.design.extent { Extent::Elevation(-z) } else { self.design.extent };
        let design = Design { sheet, extent, ..self.design.clone() };
        let other = match surface::build(&line, &design, Some(-self.surface.volumes.reference), &()) {
            Ok(other) => other,
            // Rounding, and shifts of what touches, differ upside down.
            Err(error) => return refused(&error, self.bytes, self.shown),
        };
        let (a, b) = (&self.surface.volumes, &other.volumes);
        let bound = 1e-9 * (a.cut + a.fill) + 1e-9 + a.error_bound + b.error_bound;
        assert!((a.cut - b.fill).abs() <= bound && (a.fill - b.cut).abs() <= bound, "{a:?} {b:?}");
    }
}

fn distance(lines: &[Polyline], p: DVec2) -> f64 {
    let to = |(a, b): ([f64; 3], [f64; 3])| {
        let (a, b) = (DVec2::new(a[0], a[1]), DVec2::new(b[0], b[1]));
        let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a + (b - a) * t)
    };
    lines.iter().flat_map(Polyline::segments).map(to).fold(f64::INFINITY, f64::min)
}

fn area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).truncate().perp_dot((c - a).truncate())
}

/// Volume of a triangle above a plane: what is above is cut out, and summed over a fan.
fn above(corners: [DVec3; 3], plane: f64) -> f64 {
    let mut kept: Vec<DVec3> = Vec::new();
    for (i, &p) in corners.iter().enumerate() {
        let q = corners[(i + 1) % 3];
        let (h, g) = (p.z - plane, q.z - plane);
        if h > 0.0 {
            kept.push(p);
        }
        if (h > 0.0) != (g > 0.0) {
            kept.push(p + (q - p) * (h / (h - g)));
        }
    }
    (2..kept.len()).map(|i| area([kept[0], kept[i - 1], kept[i]]) * ((kept[0].z + kept[i - 1].z + kept[i].z) / 3.0 - plane)).sum()
}
