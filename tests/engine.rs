//! The whole engine on random lines, against formulas of its own and a brute force that shares no code with it.

mod common;

use common::build::{design, line};
use common::lines::{Case, Random, case, star};
use common::measure::{area, curves, enclosed, fill_above, net_above, open_edges, triangles};
use common::oracle::{self, Polyline};
use slopegen::model::{CurveKind, Design, Extent, Line, Part, Sheet, Side};
use slopegen::surface::{self, Surface};

/// Triangles whose heights are compared with the brute force.
const SAMPLES: usize = 400;

/// Lower triangles (length units) are too small for an angle.
const MEASURABLE_HEIGHT: f64 = 1e-4;

/// What is built, for messages and for the brute force.
struct Job {
    name: String,
    lines: Vec<Polyline>,
    design: Design,
    /// Plane of the volumes.
    reference: Option<f64>,
}

impl Job {
    fn k(&self) -> f64 {
        self.design.slope.ratio()
    }

    fn rising(&self) -> bool {
        self.design.sheet == Sheet::Rising
    }

    #[track_caller]
    fn build(&self) -> Surface {
        surface::build(&line(&self.lines), &self.design, self.reference, &()).unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }
}

/// A random sheet, side and extent for a case; the same for the same seed.
fn job(seed: u64, size: usize, tolerance: f64) -> Job {
    let Case { name, k, lines, .. } = case(seed, size);
    let random = &mut Random::new(seed ^ 0xABCD);
    let sheet = [Sheet::Falling, Sheet::Rising][random.below(2)];
    let one_side = [Side::Both, Side::Both, Side::Left, Side::Right][random.below(4)];
    let side = if lines.iter().any(|l| l.closed) { Side::Both } else { one_side };
    let extent = extent(random, &line(&lines), k, sheet);
    let design = Design { sheet, side_of_lines: side, side_of_rings: side, tolerance, ..design(k, extent) };
    // Half of the planes pass through the line.
    let (low, high) = line(&lines).elevation_range();
    let reference = (random.below(2) == 0).then(|| random.between(low, high + 1e-3));
    Job { name: format!("{name}, size {size}: {design:?}"), lines, design, reference }
}

/// Up to 12 beyond the line, as an elevation, a height or a distance.
fn extent(random: &mut Random, line: &Line, k: f64, sheet: Sheet) -> Extent {
    let (low, high) = line.elevation_range();
    let depth = random.between(1.0, 12.0);
    match (random.below(3), sheet) {
        (0, Sheet::Falling) => Extent::Elevation(low - depth),
        (0, Sheet::Rising) => Extent::Elevation(high + depth),
        (1, _) => Extent::Height(depth),
        _ => Extent::Distance(depth / k),
    }
}

/// The volumes of a coarse surface differ from those of a much finer one by no more than both say they may.
#[test]
fn volumes_are_within_their_bounds() {
    let mut used = 0.0_f64;
    for seed in 0..160 {
        let mut coarse = job(seed, [12, 60, 250][seed as usize % 3], 0.1);
        if seed % 4 == 0 {
            coarse.design.extent = Extent::Distance(6.0 / coarse.k());
        }
        let (a, name) = (coarse.build().volumes, coarse.name.clone());
        let design = Design { tolerance: 1e-3, ..coarse.design };
        let b = Job { design, reference: Some(a.reference), ..coarse }.build().volumes;
        let off = (a.cut - b.cut).abs().max((a.fill - b.fill).abs());
        let bound = a.error_bound + b.error_bound + 1e-9 * (1.0 + a.cut + a.fill);
        assert!(off <= bound, "seed {seed}, {name}: {off} apart, {bound} allowed: {a:?} {b:?}");
        used = used.max(off / bound);
    }
    // Bounds that allow anything would pass as well.
    assert!(used > 0.25, "{used} of a bound used at most");
}

/// A slope on one side of a level arc ends in rulings at right angles to its ends. With radius R, angle φ and width D its volume above
/// the plane at the end is `φ k (R D²/2 + D³/6)` on the outside.
#[test]
fn slopes_on_one_side_end_at_right_angles() {
    let (radius, angle, k, width, count) = (60.0_f64, 0.9, 0.5, 8.0, 3000);
    let point = |i: usize| {
        let (sin, cos) = (angle * i as f64 / f64::from(count)).sin_cos();
        [radius * cos, radius * sin, 0.0]
    };
    let arc = common::build::open(&(0..=count as usize).map(point).collect::<Vec<_>>());
    let expected = angle * k * (radius * width * width / 2.0 + width.powi(3) / 6.0);
    for (extent, tolerance) in
        [(Extent::Height(k * width), 0.1), (Extent::Elevation(-k * width), 0.1), (Extent::Distance(width), 1e-3)]
    {
        // Counter-clockwise: the outside is on the right.
        let design = Design { side_of_lines: Side::Right, tolerance, ..design(k, extent) };
        let volumes = surface::build(&line(std::slice::from_ref(&arc)), &design, Some(-k * width), &()).unwrap().volumes;
        let off = (volumes.fill - expected).abs();
        assert!(off <= volumes.error_bound, "{off} off, {} allowed", volumes.error_bound);
        assert!(volumes.error_bound < 0.03 * expected, "{} allowed of {expected}", volumes.error_bound);
    }
}

/// Checks a surface with nothing but its triangles, the job and the brute force.
fn examine(job: &Job, surface: &Surface) {
    slopes_and_heights(job, surface);
    sums(job, surface);
    level_curves(job, surface);
    let (name, certificate) = (&job.name, surface.certificate);
    assert!(certificate.paired && certificate.manifold && certificate.input_edges_kept, "{name}: {certificate:?}");
    assert_eq!((certificate.overlaps, certificate.triangles_beyond_0_1deg), (0, 0), "{name}");
    assert!(certificate.height_max_deviation <= job.design.tolerance + 1e-8, "{name}: {certificate:?}");
}

/// Counter-clockwise triangles of the right slope, on the sheet.
fn slopes_and_heights(job: &Job, surface: &Surface) {
    let (name, k, tin) = (&job.name, job.k(), &surface.tin);
    let random = &mut Random::new(99);
    assert!(!tin.triangles.is_empty(), "{name}: no triangles");
    let slope_part = if job.rising() { Part::CutSlope } else { Part::FillSlope };
    for (t, (corners, part)) in triangles(surface).enumerate() {
        let [a, b, c] = corners;
        assert!(area(corners) > 0.0, "{name}: triangle {t} has plan area {}", area(corners));
        if part == Part::Platform {
            continue;
        }
        assert_eq!(part, slope_part, "{name}");
        let normal = (b - a).cross(c - a);
        let drop = a.z.max(b.z).max(c.z) - a.z.min(b.z).min(c.z);
        let off = (normal.truncate().length().atan2(normal.z) - k.atan()).to_degrees().abs();
        assert!(drop < MEASURABLE_HEIGHT || off < 0.1, "{name}: triangle {t} is {off}° off, drop {drop}");
        if random.below(1 + tin.triangles.len() / SAMPLES) == 0 {
            let (u, v) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            for p in [a, a + (b - a) * u + (c - a) * v] {
                let p = tin.frame.to_world(p);
                let f = oracle::height(&job.lines, k, job.rising(), p.x, p.y);
                let bound = job.design.tolerance + 1e-12 * p.abs().max_element();
                assert!((f - p.z).abs() <= bound, "{name}: triangle {t} at {p}: the sheet is at {f}");
            }
        }
    }
}

/// Each directed edge once; areas and volumes are sums over the triangles, and what the boundary encloses.
fn sums(job: &Job, surface: &Surface) {
    let name = &job.name;
    let boundary = open_edges(name, surface);
    let mut balance = vec![0_i32; surface.tin.vertices.len()];
    for &[a, b] in &boundary {
        balance[a as usize] += 1;
        balance[b as usize] -= 1;
    }
    assert!(balance.iter().all(|&b| b == 0), "{name}: the boundary is not closed");
    let plan: f64 = triangles(surface).map(|t| area(t.0)).sum();
    // Rounding of sums over coordinates, their number and their size.
    let same = |found: f64, expected: f64, what: &str| {
        let size = surface.areas.plan * (1.0 + surface.volumes.cut_max.max(surface.volumes.fill_max));
        assert!((found - expected).abs() <= 1e-9 * size, "{name}: {what}: {found} for {expected}");
    };
    same(surface.areas.plan, plan, "plan area");
    same(enclosed(surface, &boundary), plan, "area inside the boundary");
    let (cut, fill) = (surface.volumes.cut, surface.volumes.fill);
    assert!(cut >= 0.0 && fill >= 0.0, "{name}: cut {cut}, fill {fill}");
    let plane = surface.volumes.reference;
    same(fill - cut, net_above(surface, plane), "fill less cut");
    same(fill, fill_above(surface, plane), "fill");
    // In plan a slope is smaller by cos α, but for chords of cones.
    let slopes: f64 = triangles(surface).filter(|t| t.1 != Part::Platform).map(|t| area(t.0)).sum();
    let expected = slopes * 1.0_f64.hypot(job.k());
    let found = surface.areas.fill_slope + surface.areas.cut_slope;
    assert!((found / expected - 1.0).abs() < 2e-3, "{name}: slope area {found} for {expected}");
    // An end at an elevation is all of the boundary, where both sides are built.
    if let (Extent::Elevation(end), Side::Both) = (job.design.extent, job.design.side_of_lines) {
        for v in boundary.as_flattened() {
            let z = surface.tin.vertices[*v as usize].z;
            assert!((z - end).abs() < 1e-6, "{name}: the boundary is at {z}");
        }
    }
}

/// Level curves lie on the boundary of the union of tapered capsules: their vertices exactly where nothing is simplified, and
/// their chords within the tolerance.
fn level_curves(job: &Job, surface: &Surface) {
    let (name, k) = (&job.name, job.k());
    let random = &mut Random::new(17);
    for curve in curves(surface, CurveKind::LevelCurve) {
        let c = curve.elevation.unwrap();
        assert!(surface.levels.contains(&c), "{name}: level {c} is none of {:?}", surface.levels);
        let i = random.below(curve.points.len() - 1);
        let (p, q) = (curve.points[i], curve.points[i + 1]);
        for p in [p, 0.5 * (p + q)] {
            assert!((p.z - c).abs() <= 1e-6, "{name}: level {c} has a point at {}", p.z);
            let distance = oracle::capsule_distance(&job.lines, k, job.rising(), c, p.x, p.y);
            let bound = (job.design.tolerance + 1e-6) / k;
            assert!(distance.abs() <= bound, "{name}: level {c}: {distance} from the capsules at {p}");
        }
    }
}

fn examine_all(seeds: std::ops::Range<u64>, size: usize, tolerance: f64) {
    for seed in seeds {
        let job = job(seed, size, tolerance);
        examine(&job, &job.build());
    }
}

#[test]
fn a_dozen_vertices() {
    examine_all(0..300, 12, 0.01);
}

#[test]
fn dozens_of_vertices() {
    examine_all(1000..1080, 60, 0.01);
}

#[test]
fn tight_tolerance() {
    examine_all(2000..2050, 12, 1e-6);
}

/// Inside a star-shaped ring: all of it is slope and floor, and the floor lies at the end.
#[test]
fn inside_of_stars_has_no_hole() {
    for seed in 0..40 {
        let random = &mut Random::new(seed);
        let k = random.between(0.3, 2.0);
        let n = 5 + random.below(30);
        let ring = star(random, n, 30.0, 2.0, 0.1, k);
        let sheet = [Sheet::Falling, Sheet::Rising][random.below(2)];
        let (low, high) = line(std::slice::from_ref(&ring)).elevation_range();
        let depth = random.between(0.5, 8.0);
        let end = if sheet == Sheet::Falling { low - depth } else { high + depth };
        let inside = Design { sheet, side_of_rings: Side::Inside, tolerance: 0.01, ..design(k, Extent::Elevation(end)) };
        let job = Job { name: format!("seed {seed}: {inside:?}"), lines: vec![ring], design: inside, reference: None };
        let surface = job.build();
        slopes_and_heights(&job, &surface);
        // The boundary is the ring itself: simplified within a third of the tolerance in height, that much/k in plan.
        let boundary = open_edges(&job.name, &surface);
        let (area_of_ring, length) = measure_ring(&job.lines[0]);
        let found = enclosed(&surface, &boundary);
        assert!((found - area_of_ring).abs() <= length * job.design.tolerance / k, "{}: {found} for {area_of_ring}", job.name);
        assert!((surface.areas.plan - found).abs() < 1e-9 * found, "{}: a hole", job.name);
        for (corners, part) in triangles(&surface).filter(|t| t.1 == Part::Platform) {
            assert!(corners.iter().all(|p| (p.z - end).abs() < 1e-6), "{}: {part:?} at {corners:?}", job.name);
        }
        let below = triangles(&surface).any(|t| t.1 == Part::Platform);
        let centre = oracle::height(&job.lines, k, job.rising(), 0.0, 0.0);
        let deeper = if sheet == Sheet::Falling { centre < end - 0.1 } else { centre > end + 0.1 };
        assert!(below || !deeper, "{}: no floor, but the sheet goes on to {centre}", job.name);
    }
}

/// Outside of star-shaped rings with their platform: one surface without a crack, bounded by the outer end only.
#[test]
fn outside_of_stars_is_joined_to_the_platform() {
    for seed in 0..40 {
        let random = &mut Random::new(seed ^ 0x5EED);
        let k = random.between(0.3, 2.0);
        let n = 4 + random.below(60);
        let ring = star(random, n, 30.0, 3.0, 0.1, k);
        let (low, _) = line(std::slice::from_ref(&ring)).elevation_range();
        let end = low - random.between(0.5, 20.0);
        let outside = Design { tolerance: 0.01, ..design(k, Extent::Elevation(end)) };
        let job = Job { name: format!("seed {seed}: {outside:?}"), lines: vec![ring], design: outside, reference: Some(0.1) };
        let surface = job.build();
        examine(&job, &surface);
        let (area_of_ring, length) = measure_ring(&job.lines[0]);
        let platform = surface.areas.platform;
        // A platform is not level: its area in space is no less than in plan.
        assert!(platform >= area_of_ring - length * job.design.tolerance / k, "{}: platform {platform}", job.name);
        let flat: f64 = triangles(&surface).filter(|t| t.1 == Part::Platform).map(|t| area(t.0)).sum();
        assert!((flat - area_of_ring).abs() <= length * job.design.tolerance / k, "{}: {flat} for {area_of_ring}", job.name);
        // One loop.
        let loops = curves(&surface, CurveKind::Boundary).count();
        assert_eq!(loops, 1, "{}", job.name);
    }
}

/// Plan area and length of a counter-clockwise ring.
fn measure_ring(ring: &Polyline) -> (f64, f64) {
    ring.segments().fold((0.0, 0.0), |(area, length), (a, b)| {
        (area + 0.5 * (a[0] * b[1] - a[1] * b[0]), length + (b[0] - a[0]).hypot(b[1] - a[1]))
    })
}

/// Long outlines, smooth and with 20 mm of noise: what dense input is like.
#[test]
fn thousands_of_vertices() {
    for (n, noise) in [(1_000, 0.0), (1_000, 0.02), (10_000, 0.0), (10_000, 0.02)] {
        let k = 0.5;
        let ring = star(&mut Random::new(n as u64), n, 300.0, 8.0, noise, k);
        let (low, _) = line(std::slice::from_ref(&ring)).elevation_range();
        let outside = Design { tolerance: 0.01, ..design(k, Extent::Elevation(low - 10.0)) };
        let job = Job { name: format!("{n} vertices, noise {noise}"), lines: vec![ring], design: outside, reference: Some(0.1) };
        let surface = job.build();
        examine(&job, &surface);
        // Every given vertex is on the hinge, where it was or within the share of the tolerance for simplifying.
        assert!(surface.simplified_max <= job.design.tolerance / 3.0, "{}: {}", job.name, surface.simplified_max);
        let hinge: usize = curves(&surface, CurveKind::Hinge).map(|l| l.points.len()).sum();
        assert!(hinge > n, "{}: {hinge} points on the hinge", job.name);
    }
}

/// Long roads: rough ones have creases from end to end.
#[test]
fn long_roads() {
    for seed in [4, 13, 102, 114] {
        let job = job(seed, 1_000, 0.01);
        examine(&job, &job.build());
    }
}
