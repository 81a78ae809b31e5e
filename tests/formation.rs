//! Roads about centre lines: closed forms, tight bends, refusals, random lines, and real ones.

#![allow(clippy::print_stderr, reason = "tells what was skipped")]

mod common;

use common::build::{build, design, line, open, ring};
use common::lines::Random;
use common::oracle::Polyline;
use glam::{DVec2, DVec3};
use slopegen::formation::{self, Crossfall, Formation, FormationError};
use slopegen::model::{Design, Extent, Line, Part, Slope};
use slopegen::surface::Surface;

fn road(width: f64, left: f64, right: f64) -> Formation {
    Formation { width, crossfall: Crossfall { left, right }, chord: 1e-3 }
}

fn widened(lines: &[Polyline], formation: &Formation) -> Result<Line, FormationError> {
    formation::widen(&line(lines), "road.geojson", formation).map(|formed| formed.line)
}

#[track_caller]
fn wide(lines: &[Polyline], formation: &Formation) -> Line {
    widened(lines, formation).unwrap_or_else(|e| panic!("{e}"))
}

/// Plan area of a ring, positive when clockwise, as roads run.
fn area(ring: &[DVec3]) -> f64 {
    let p = |i: usize| (ring[i % ring.len()] - ring[0]).truncate();
    -0.5 * (0..ring.len()).map(|i| p(i).perp_dot(p(i + 1))).sum::<f64>()
}

/// Plan area and volume below the platform, down to `z`.
fn platform(surface: &Surface, z: f64) -> (f64, f64) {
    let (mut area, mut volume) = (0.0, 0.0);
    for t in (0..surface.tin.triangles.len()).filter(|&t| surface.tin.parts[t] == Part::Platform) {
        let [a, b, c] = surface.tin.corners(t);
        let own = 0.5 * (b - a).truncate().perp_dot((c - a).truncate());
        assert!(own > 0.0, "{own}: {a} {b} {c}");
        area += own;
        volume += own * ((a.z + b.z + c.z) / 3.0 - z);
    }
    (area, volume)
}

#[track_caller]
fn close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs().max(1.0), "{found} against {expected}");
}

#[test]
fn a_straight_road_is_a_rectangle_with_a_crown() {
    // Length 50 (30, 40), width 7, 3 % and 5 %: the body above the lower plane is W L z̄, each half 3.5 · L · (10 − fall · 1.75).
    for shift in [0.0, 500_000.0] {
        let at = |x: f64, y: f64| [x + shift, y + 10.0 * shift, 10.0];
        let line = wide(&[open(&[at(0.0, 0.0), at(12.0, 16.0), at(30.0, 40.0)])], &road(7.0, 0.03, 0.05));
        let ring = &line.chains[0];
        assert_eq!(ring.vertices.len(), 8);
        close(area(&ring.vertices), 350.0, 1e-9);
        let surface = build(&line, &design(0.5, Extent::Height(3.0)));
        let (plan, volume) = platform(&surface, 0.0);
        close(plan, 350.0, 1e-9);
        close(volume, 50.0 * 3.5 * (10.0 - 0.03 * 1.75) + 50.0 * 3.5 * (10.0 - 0.05 * 1.75), 1e-9);
        // Heights of the four corners: the left edge comes first.
        let heights: Vec<f64> = ring.vertices.iter().map(|v| v.z).collect();
        let (left, right) = (10.0 - 3.5 * 0.03, 10.0 - 3.5 * 0.05);
        for (found, expected) in heights.iter().zip([left, left, left, 10.0, right, right, right, 10.0]) {
            close(*found, expected, 1e-12);
        }
        let stations = &ring.axis.as_ref().unwrap().stations;
        for (found, expected) in stations.iter().zip([0.0, 20.0, 50.0, 50.0, 50.0, 20.0, 0.0, 0.0, 0.0]) {
            close(*found, expected, 1e-12);
        }
    }
}

#[test]
fn a_bend_keeps_its_mitre_and_its_area() {
    // Mitred strips are trapezoids whose middle is the centre line: W L whatever the angle, up to the longest mitre. Beyond, the
    // outside is a sector: W L − (W/2)² (tan(δ/2) − δ/2).
    for degrees in [10.0_f64, 45.0, 90.0, 96.0, 97.0, 120.0, 135.0_f64] {
        for side in [1.0, -1.0] {
            let delta = degrees.to_radians();
            let (sin, cos) = delta.sin_cos();
            let formation = Formation { chord: 1e-7, ..road(8.0, 0.02, 0.02) };
            let line = wide(&[open(&[[-50.0, 0.0, 5.0], [0.0, 0.0, 5.0], [50.0 * cos, side * 50.0 * sin, 5.0]])], &formation);
            let missing = if degrees > 96.4 { 16.0 * ((0.5 * delta).tan() - 0.5 * delta) } else { 0.0 };
            close(area(&line.chains[0].vertices), 800.0 - missing, 1e-6);
            let surface = build(&line, &design(0.5, Extent::Height(2.0)));
            // Rounded corners are simplified within a third of the tolerance.
            close(platform(&surface, 0.0).0, area(&line.chains[0].vertices), 1e-4);
            for v in &line.chains[0].vertices {
                assert!((v.z - 5.0).abs() < 1e-12 || (v.z - (5.0 - 0.08)).abs() < 1e-12);
            }
        }
    }
}

/// A straight leg, an arc of `turn` radians (left positive) about `radius`, another leg; rising by `gradient`.
fn bend(leg: f64, radius: f64, turn: f64, steps: usize, gradient: f64) -> Polyline {
    let mut plan = vec![DVec2::ZERO, DVec2::new(0.5 * leg, 0.0)];
    let centre = DVec2::new(leg, radius * turn.signum());
    for i in 0..=steps {
        let angle = turn * i as f64 / steps as f64;
        plan.push(centre + DVec2::from_angle(angle).rotate(DVec2::new(leg, 0.0) - centre));
    }
    let last = plan[plan.len() - 1];
    plan.push(last + leg * DVec2::from_angle(turn));
    let mut station = 0.0;
    let mut points = Vec::new();
    for (i, p) in plan.iter().enumerate() {
        station += if i > 0 { p.distance(plan[i - 1]) } else { 0.0 };
        points.push([p.x, p.y, 100.0 + gradient * station]);
    }
    open(&points)
}

/// Whether a place lies closer to the line than `half`, beyond its ends not counted.
fn covered(line: &[[f64; 3]], p: DVec2, half: f64) -> bool {
    line.windows(2).any(|w| {
        let (a, b) = (DVec2::new(w[0][0], w[0][1]), DVec2::new(w[1][0], w[1][1]));
        let s = (p - a).dot(b - a) / (b - a).length_squared();
        p.distance(a.lerp(b, s.clamp(0.0, 1.0))) <= half && ((0.0..=1.0).contains(&s) || !is_end(line, a, b, s))
    })
}

/// Whether the clamped foot is an end of the line.
fn is_end(line: &[[f64; 3]], a: DVec2, b: DVec2, s: f64) -> bool {
    let end = |p: &[f64; 3]| DVec2::new(p[0], p[1]);
    (s < 0.0 && a == end(&line[0])) || (s > 1.0 && b == end(&line[line.len() - 1]))
}

fn inside(ring: &[DVec3], p: DVec2) -> bool {
    (0..ring.len()).fold(false, |odd, i| {
        let (a, b) = (ring[i].truncate(), ring[(i + 1) % ring.len()].truncate());
        odd ^ ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y))
    })
}

#[test]
fn tight_bends_cover_what_lies_within_half_the_width() {
    // Against brute force: a place belongs to the road if it is within half the width of the line.
    for radius in [0.5, 1.0, 2.0, 3.9] {
        for turn in [0.6, 1.5, 2.2] {
            for side in [1.0, -1.0] {
                let bend = bend(30.0, radius, side * turn, 24, 0.04);
                let line = wide(std::slice::from_ref(&bend), &road(8.0, 0.025, 0.025));
                let ring = &line.chains[0].vertices;
                let mut random = Random::new(7);
                let mut wrong = 0;
                for _ in 0..20_000 {
                    let p = DVec2::new(random.between(-2.0, 70.0), random.between(-45.0, 45.0));
                    wrong += usize::from(covered(&bend.points, p, 4.0) != inside(ring, p));
                }
                // Mitres of the outside stand beyond the half width by 4 (1 / cos(δ/2) − 1) for steps of δ = turn / 24.
                assert!(wrong <= 5, "radius {radius}, turn {turn}: {wrong}");
                let surface = build(&line, &design(0.9, Extent::Height(3.0)));
                close(platform(&surface, 0.0).0, area(ring), 1e-5);
            }
        }
    }
}

#[test]
fn a_bend_of_a_circle_has_the_area_of_the_ring_sector() {
    // Radius 20, half a turn, width 8: π 20 · 8 for the arc, with inscribed chords smaller by 1 − sinc.
    let bend = bend(30.0, 20.0, std::f64::consts::PI, 180, 0.0);
    let line = wide(&[bend], &road(8.0, 0.0, 0.0));
    let chord = 2.0 * 20.0 * (std::f64::consts::PI / 360.0).sin() * 180.0;
    close(area(&line.chains[0].vertices), 8.0 * (60.0 + chord), 1e-12);
}

#[test]
fn the_step_of_a_tight_bend_is_shared_and_levelled() {
    // Two legs at a right angle joined by an arc of radius 1, width 8, 5 % up: the edges cross where x = leg − 3, y = 4 in the
    // frame of the bend, 3 before the arc and 3 behind it; so they differ by 5 % of 6 + π/2 (chords a little less).
    let bend = bend(30.0, 1.0, 0.5 * std::f64::consts::PI, 8, 0.05);
    let formed = formation::widen(&line(&[bend]), "a", &road(8.0, 0.0, 0.0)).unwrap();
    let ring = &formed.line.chains[0];
    let fold = ring.vertices.iter().position(|v| v.truncate().distance(DVec2::new(27.0, 4.0)) < 1e-9).unwrap();
    let arc = 16.0 * (std::f64::consts::PI / 32.0).sin();
    close(ring.axis.as_ref().unwrap().stations[fold], 30.0 + 0.5 * arc, 1e-9);
    close(ring.vertices[fold].z, 100.0 + 0.05 * (30.0 + 0.5 * arc), 1e-9);
    assert_eq!(formed.notes[0].code, "bend-cut-off");
    assert!(formed.notes[0].message.contains(&format!("{:.3}", 0.05 * (6.0 + arc))), "{}", formed.notes[0].message);
}

#[test]
fn reversing_the_line_changes_sides() {
    let mut random = Random::new(3);
    for _ in 0..20 {
        let there = wander(&mut random, 12, 30.0, 0.9);
        let mut back = there.clone();
        back.points.reverse();
        let (Ok(a), Ok(b)) = (widened(&[there], &road(6.0, 0.02, -0.03)), widened(&[back], &road(6.0, -0.03, 0.02))) else {
            continue;
        };
        let (a, b) = (&a.chains[0], &b.chains[0]);
        assert_eq!(a.vertices.len(), b.vertices.len());
        for v in &a.vertices {
            let near = b.vertices.iter().map(|w| v.distance(*w)).fold(f64::INFINITY, f64::min);
            assert!(near < 1e-9, "{v} has no counterpart: {near}");
        }
    }
}

/// A random line: steps up to `step`, turns up to `turn` radians, gentle gradients.
fn wander(random: &mut Random, count: usize, step: f64, turn: f64) -> Polyline {
    let (mut p, mut z, mut direction) = (DVec2::ZERO, 50.0, 0.0);
    let mut points = vec![[p.x, p.y, z]];
    for _ in 0..count {
        let length = random.between(0.02 * step, step);
        direction += random.between(-turn, turn);
        p += length * DVec2::from_angle(direction);
        z += length * random.between(-0.06, 0.06);
        points.push([p.x, p.y, z]);
    }
    open(&points)
}

/// Nothing further than the longest mitre from the line belongs to its road, all that is nearer than half the width does, the
/// square ends aside.
fn check_cover(centre: &[[f64; 3]], ring: &[DVec3], random: &mut Random, case: usize) {
    let (lo, hi) =
        ring.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(lo, hi), v| (lo.min(v.truncate()), hi.max(v.truncate())));
    let end = |p: &[f64; 3]| DVec2::new(p[0], p[1]);
    let ends = [end(&centre[0]), end(&centre[centre.len() - 1])];
    for _ in 0..300 {
        let p = DVec2::new(random.between(lo.x, hi.x), random.between(lo.y, hi.y));
        if inside(ring, p) {
            assert!(covered(centre, p, 6.0 + 1e-9), "case {case}: {p} is no part of the road");
        } else {
            let near_end = ends.iter().any(|e| e.distance(p) < 8.0);
            assert!(near_end || !covered(centre, p, 4.0 - 1e-9), "case {case}: {p} is missing");
        }
    }
}

#[test]
fn random_roads_are_sound_or_refused() {
    let mut random = Random::new(11);
    let (mut built, mut refused, mut covered) = (0, 0, 0);
    for case in 0..400 {
        let (step, turn) = [(30.0, 0.5), (12.0, 0.8), (6.0, 0.7), (2.0, 0.5), (60.0, 1.6)][case % 5];
        let centre = wander(&mut random, 40, step, turn);
        let length: f64 = centre.points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
        let fall = random.between(-0.04, 0.04);
        match widened(std::slice::from_ref(&centre), &road(8.0, fall, fall)) {
            Err(FormationError::Invalid(defects)) => panic!("case {case} not seen before the rings: {defects}"),
            Err(_) => refused += 1,
            Ok(line) => {
                // The certificate is part of the build; slopes over platforms are refused there.
                let plan = area(&line.chains[0].vertices);
                // Rounded corners take from the area, tight bends count twice in W L.
                assert!(plan > 4.0 * length && plan < 10.0 * length, "case {case}: {plan} of {}", 8.0 * length);
                check_cover(&centre.points, &line.chains[0].vertices, &mut random, case);
                let label = "road.geojson";
                let design = design(1.0, Extent::Height(2.0));
                if slopegen::validate::check_steepness(&line, label, design.slope).is_err() {
                    refused += 1;
                    continue;
                }
                match slopegen::surface::build(&line, &design, None, &()) {
                    Ok(surface) => {
                        // Vertices of the edges that stand out by less than a third of the tolerance are dropped.
                        close(platform(&surface, 0.0).0, plan, 1e-5);
                        let on_axis = &surface.platform_stations;
                        let used = (0..surface.tin.triangles.len()).filter(|&t| surface.tin.parts[t] == Part::Platform);
                        for v in used.flat_map(|t| surface.tin.triangles[t]) {
                            assert!(on_axis.binary_search_by_key(&v, |s| s.vertex).is_ok(), "case {case}: vertex {v}");
                        }
                        built += 1;
                    }
                    Err(slopegen::surface::SurfaceError::PlatformCovered { .. }) => covered += 1,
                    Err(error) => panic!("case {case}: {error}\n{:?}", centre.points),
                }
            }
        }
    }
    eprintln!("{built} built, {refused} refused, {covered} covered");
    assert!(built > 200, "{built} built, {refused} refused, {covered} covered");
}

#[test]
fn noisy_lines_are_sound_or_refused() {
    // A track as receivers record it: points closer together than their errors, far closer than the width.
    let mut random = Random::new(5);
    let (mut formed, mut refused) = (0, 0);
    for case in 0..60 {
        let noise = [0.01, 0.1, 0.2][case % 3];
        let points: Vec<[f64; 3]> = (0..200)
            .map(|i| {
                let x = 0.5 * f64::from(i);
                let shift = DVec2::new(random.between(-noise, noise), random.between(-noise, noise));
                [x + shift.x, 20.0 * (x / 25.0).sin() + shift.y, 10.0 + 0.01 * x]
            })
            .collect();
        match widened(&[open(&points)], &road(8.0, 0.02, 0.02)) {
            Ok(line) => {
                check_cover(&points, &line.chains[0].vertices, &mut random, case);
                let design = design(1.0, Extent::Height(2.0));
                if slopegen::validate::check_steepness(&line, "a", design.slope).is_ok() {
                    let surface = build(&line, &design);
                    close(platform(&surface, 0.0).0, area(&line.chains[0].vertices), 1e-3);
                }
                formed += 1;
            }
            Err(FormationError::Invalid(defects)) => panic!("case {case}: {defects}"),
            Err(error) => {
                eprintln!("case {case}: {error}");
                refused += 1;
            }
        }
    }
    assert!(formed > 50, "{formed} formed, {refused} refused");
}

/// Two corners 2 cm apart that turn the inner edge by just half the width: what is left of it between the two is a hair long, or less
/// than nothing, with the step of the centre line in it. The road is the same all the way.
#[test]
fn bends_as_tight_as_half_the_width_to_the_last_digits() {
    let (half, part, gradient): (f64, f64, f64) = (4.0, 0.02, 0.08);
    let built = |left: f64| {
        let turn = 2.0 * ((part - left) / (2.0 * half)).atan();
        let mut points = vec![[-20.0, 0.0, 0.0], [0.0, 0.0, 20.0 * gradient]];
        for (i, length) in [part, 20.0].into_iter().enumerate() {
            let (sin, cos) = (turn * (i + 1) as f64).sin_cos();
            let [x, y, z] = points[i + 1];
            points.push([x + length * cos, y + length * sin, z + gradient * length]);
        }
        let line = wide(&[open(&points)], &road(2.0 * half, 0.0, 0.0));
        assert!(slopegen::validate::check_steepness(&line, "a", Slope::from_ratio(2.0 / 3.0).unwrap()).is_ok(), "{left}");
        let surface = build(&line, &design(2.0 / 3.0, Extent::Height(2.0)));
        (platform(&surface, 0.0).0, surface.volumes.fill, surface.areas.plan)
    };
    let (area, fill, plan) = built(-1e-5);
    for left in [-1e-3, -1e-7, 0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 3e-4] {
        let found = built(left);
        close(found.0, area, 1e-4);
        close(found.1, fill, 1e-3);
        close(found.2, plan, 1e-3);
    }
}

/// Many tight bends are bends: thirty right angles of radius 2, left and right in turn, under a road 8 wide.
#[test]
fn many_bends_are_no_kinks() {
    let (mut p, mut direction) = (DVec2::ZERO, 0.0_f64);
    let mut points = vec![p];
    for bend in 0..30 {
        let sign = if bend % 2 == 0 { 1.0 } else { -1.0 };
        for i in 0..=6 {
            let (turn, length) = if i == 0 { (0.0, 30.0) } else { (sign * std::f64::consts::PI / 12.0, 0.5) };
            direction += turn;
            p += length * DVec2::from_angle(direction);
            points.push(p);
        }
    }
    points.push(p + 30.0 * DVec2::from_angle(direction));
    let centre: Vec<[f64; 3]> = points.iter().map(|p| [p.x, p.y, 1.0]).collect();
    let formed = formation::widen(&line(&[open(&centre)]), "a", &road(8.0, 0.0, 0.0)).unwrap();
    let codes: Vec<_> = formed.notes.iter().map(|note| note.code).collect();
    assert_eq!(codes, ["bend-cut-off"]);
    assert!(formed.notes[0].message.ends_with("is cut off: 30"), "{}", formed.notes[0].message);
}

/// A winding road on a vertical curve, its vertices 5 cm apart with three digits: every vertex is a kink of its own, and the edges fold
/// thousands of times. The platform keeps its heights all the same, `z` of the line 4 beside it, and its area, width times length.
#[test]
fn dense_lines_with_rounded_coordinates() {
    let (count, spacing, half) = (4000, 0.05, 4.0);
    let exact = |s: f64| {
        let (x, y) = (s, 15.0 * (s / 30.0).sin());
        [x, y, 100.0 + 0.05 * s - 0.0006 * s * s]
    };
    let rounded = |digits: f64| -> Vec<[f64; 3]> {
        (0..count).map(|i| exact(spacing * f64::from(i)).map(|c| (c * digits).round() / digits)).collect()
    };
    let mut found = Vec::new();
    for (digits, noisy, bound) in [(1e9, false, 1e-4), (1e3, false, 0.01), (2e2, true, 0.04)] {
        let formed = formation::widen(&common::build::line(&[open(&rounded(digits))]), "a", &road(2.0 * half, 0.0, 0.0)).unwrap();
        let codes: Vec<_> = formed.notes.iter().map(|note| note.code).collect();
        assert_eq!(codes.contains(&"line-too-dense"), noisy, "{codes:?}");
        let line = &formed.line;
        assert!(slopegen::validate::check_steepness(line, "a", Slope::from_ratio(0.5).unwrap()).is_ok(), "{digits}");
        let ring = &line.chains[0].vertices;
        // Heights along the ring, weighed with its length, against those of the line abreast.
        let (mut off, mut squares, mut length) = (0.0, 0.0, 0.0);
        for (a, b) in ring.iter().zip(ring.iter().skip(1)) {
            let middle = 0.5 * (*a + *b);
            // The foot on the exact line, by Newton's method from the station below.
            let mut s = middle.x;
            for _ in 0..50 {
                let (d, n) = (15.0 / 30.0 * (s / 30.0).cos(), -15.0 / 900.0 * (s / 30.0).sin());
                let (ex, ey) = (s - middle.x, 15.0 * (s / 30.0).sin() - middle.y);
                s -= (ex + ey * d) / (1.0 + d * d + ey * n);
            }
            let piece = a.truncate().distance(b.truncate());
            let error = middle.z - exact(s)[2];
            (off, squares, length) = (off + error * piece, squares + error * error * piece, length + piece);
        }
        assert!((off / length).abs() < 1e-3, "{digits}: {} off on average", off / length);
        assert!((squares / length).sqrt() < bound, "{digits}: {} off", (squares / length).sqrt());
        found.push(area(ring));
    }
    close(found[1], found[0], 2e-3);
    close(found[2], found[0], 5e-3);
}

#[test]
fn refusals_name_places_figures_and_cures() {
    let message = |points: &[[f64; 3]], width| widened(&[open(points)], &road(width, 0.0, 0.0)).unwrap_err().to_string();
    // Two legs 5 apart under a road 8 wide.
    assert_eq!(
        message(&[[0., 0., 1.], [100., 0., 1.], [100., 5., 1.], [0., 5., 1.]], 8.0),
        "the road of `line 1` lies on itself\n  --> road.geojson, vertices 0 to 0\n   = near stations 0.000 and 205.000 the centre \
         line is 5.000 apart, the width is 8\n   = help: give `--width` 4.99 or less, move the legs apart, or build them one by one"
    );
    // Legs that come back near the start, far beyond a bend.
    let loop_back = [[0., 0., 1.], [100., 0., 1.], [100., 60., 1.], [50., 60., 1.], [50., 3., 1.]];
    assert!(message(&loop_back, 8.0).contains("near stations 50.000 and 267.000 the centre line is 3.000 apart"));
    assert!(message(&[[0., 0., 1.], [50., 0., 1.], [20., 0., 1.]], 8.0).contains("straight back"));
    let pad = ring(&[[20., -1., 1.], [22., -1., 1.], [22., 1., 1.], [20., 1., 1.]]);
    let error = widened(&[open(&[[0., 0., 1.], [50., 0., 1.]]), pad], &road(8.0, 0.0, 0.0)).unwrap_err().to_string();
    assert!(error.starts_with("ring `line 2` lies inside the road of `line 1`\n  --> road.geojson, part 2, vertex 0"), "{error}");
    // A road on a pad is no hole in it; nor is one beside it on anything.
    let pad = ring(&[[0., 0., 1.], [50., 0., 1.], [50., 40., 1.], [0., 40., 1.]]);
    let across = |y: f64| open(&[[10., y, 2.], [40., y, 2.]]);
    let error = widened(&[pad.clone(), across(20.)], &road(4.0, 0.0, 0.0)).unwrap_err().to_string();
    assert_eq!(
        error,
        "the road of `line 2` lies inside ring `line 1`\n  --> road.geojson, part 2, vertex 0\n   = its edge begins at x 10.000, y \
         22.000\n   = help: build them one by one: the ring first, and the road on that as `--terrain` (see `--finished`); for a line \
         that shapes the platform of the ring, set its `role` to `breakline`"
    );
    let error = widened(&[across(2.0), pad.clone()], &road(4.0, 0.0, 0.0)).unwrap_err().to_string();
    assert!(error.starts_with("the road of `line 1` lies inside ring `line 2`"), "{error}");
    let error = widened(&[open(&[[0., 0., 1.], [50., 0., 1.]]), open(&[[20., -1., 1.], [20.5, -1., 1.]])], &road(8.0, 0.0, 0.0));
    assert!(matches!(error, Err(FormationError::Invalid(_))), "{error:?}");
    assert!(widened(&[pad, across(42.0), across(50.0)], &road(4.0, 0.0, 0.0)).is_ok());
    // Legs that touch.
    let touching = message(&[[0., 0., 1.], [100., 0., 1.], [100., 40., 1.], [0., 40., 1.], [0., 8., 1.], [60., 8., 1.]], 8.0);
    assert!(touching.contains("8.000 apart, the width is 8\n   = help: give `--width` 7.99 or less"), "{touching}");
    // An S of legs of 2: from a width of 1.9 on the inner edges pass on the wrong side of the ends, at 6 and more without crossing.
    let s_bend = [[0., 0., 1.], [2., 0., 1.], [0., 2., 1.], [2., 2., 1.]];
    assert!(widened(&[open(&s_bend)], &road(1.5, 0.0, 0.0)).is_ok());
    for width in [1.9, 3.0, 4.0, 6.0, 8.0, 100.0] {
        let refused = message(&s_bend, width);
        assert!(refused.contains("has no inner edge") || refused.contains("lies on itself"), "{width}: {refused}");
    }
    // A bow tie.
    let crossed = message(&[[0., 0., 1.], [50., 0., 1.], [50., 20., 1.], [25., -20., 1.]], 2.0);
    assert!(crossed.contains("near stations 37.500 and 93.585 the centre line is 0.000 apart"), "{crossed}");
    let error = FormationError::NoRoom { name: "a".into(), at: "b, vertex 2".into(), station: 5.0, length: 9.0, width: 8.0 };
    assert!(
        error
            .to_string()
            .starts_with("the road of `a` has no inner edge\n  --> b, vertex 2\n   = from the bend at station 5.000")
    );
    let pad = ring(&[[0., 0., 1.], [9., 0., 1.], [9., 9., 1.]]);
    assert!(matches!(widened(&[pad], &road(8.0, 0.0, 0.0)), Err(FormationError::NoCentreLine { rings: 1, .. })));
    // Two roads that cross.
    let crossing = [open(&[[0., 0., 1.], [50., 0., 1.]]), open(&[[25., -25., 1.], [25., 25., 1.]])];
    assert!(matches!(widened(&crossing, &road(8.0, 0.0, 0.0)), Err(FormationError::Invalid(d)) if d.has("rings-cross")));
}

#[test]
fn the_inside_of_a_bend_can_be_too_steep() {
    // Radius 5, width 8, 30 %: the inner edge has radius 1, five times as steep.
    let line = wide(&[bend(30.0, 5.0, 1.5, 24, 0.3)], &road(8.0, 0.0, 0.0));
    let slope = slopegen::model::Slope::from_ratio(0.5).unwrap();
    let text = slopegen::validate::check_steepness(&line, "a", slope).unwrap_err().to_string();
    assert!(text.contains("an edge of the road `line 1` is as steep"), "{text}");
    assert!(text.contains("of the centre line (the inside of a bend is shorter than the centre line)"), "{text}");
}

#[test]
fn time_grows_as_the_length_of_a_road() {
    // A winding road, its vertices a metre apart.
    let seconds = |count: i32| {
        let point = |i: i32| {
            let x = f64::from(i);
            [x, 60.0 * (x / 90.0).sin() + 0.004 * (x * 1.7).sin(), 20.0 + 3.0 * (x / 200.0).sin()]
        };
        let points: Vec<[f64; 3]> = (0..count).map(point).collect();
        let start = std::time::Instant::now();
        let line = wide(&[open(&points)], &road(8.0, 0.025, 0.025));
        build(&line, &slopegen::model::Design { tolerance: 0.01, ..design(0.66, Extent::Height(4.0)) });
        start.elapsed().as_secs_f64()
    };
    // Ten times as long: a hundred times the time, if it grew as the square.
    let (short, long) = (seconds(1000), seconds(10_000));
    assert!(long < 40.0 * short, "{short} s and {long} s");
}

#[test]
fn real_centre_lines() {
    let Some(folder) = std::env::var_os("SLOPEGEN_DATA").map(|d| std::path::PathBuf::from(d).join("pairs")) else {
        eprintln!("skipped: SLOPEGEN_DATA is not set");
        return;
    };
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let folder = entry.unwrap().path();
        let read = |name: &str| {
            let raw = slopegen::read::read_line(&folder.join(name), &slopegen::read::ReadOptions::default()).unwrap();
            slopegen::validate::check(&raw, &slopegen::validate::Options::default()).unwrap().line
        };
        let figures: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(folder.join("reference.json")).unwrap()).unwrap();
        let Some(width) = figures["road"]["width"].as_f64() else { continue };
        let line = formation::widen(&read("road_centerline.geojson"), "centre line", &road(width, 0.0, 0.0)).unwrap().line;
        let given = read("road_platform.geojson");
        // The given platform is rounded to 0.001 and drawn without the vertices at the middle of the ends.
        for v in &given.chains[0].vertices {
            let near = line.chains[0].vertices.iter().map(|w| v.distance(*w)).fold(f64::INFINITY, f64::min);
            assert!(near < 2e-3, "{}: {v} is {near} off", folder.display());
        }
        close(area(&line.chains[0].vertices), area(&given.chains[0].vertices).abs(), 1e-4);
        let surface = build(&line, &slopegen::model::Design { tolerance: 0.01, ..design(0.5, Extent::Height(5.0)) });
        close(platform(&surface, 0.0).0, area(&line.chains[0].vertices), 1e-4);
        count += 1;
    }
    assert!(count >= 3, "only {count} pairs");
}

/// A road whose slopes end at an elevation between its ends: where its edge goes through that elevation, slope and platform share
/// a vertex. No open edge of the mesh has a vertex between its ends.
#[test]
fn slopes_that_end_along_a_road_leave_no_gap() {
    let points: Vec<[f64; 3]> =
        (0..40).map(f64::from).map(|i| [9.5 * i, 20.0 * (0.2 * i).sin(), 3.0 * (0.13 * i).sin()]).collect();
    for (left, right) in [(0.0, 0.0), (0.05, 0.02)] {
        let line = wide(&[open(&points)], &road(7.0, left, right));
        for end in [-2.5, -1.0, 0.0, 0.7, 1.3, 2.0, 2.9] {
            common::build::on_both_sheets(&line, &design(2.0 / 3.0, Extent::Elevation(end)), |surface| {
                let open = common::measure::open_edges("road", surface);
                let plan = |v: u32| surface.tin.vertices[v as usize].truncate();
                for &[a, b] in &open {
                    let (p, q) = (plan(a), plan(b));
                    for &[v, _] in open.iter().filter(|e| ![a, b].contains(&e[0])) {
                        let t = (plan(v) - p).dot(q - p) / (q - p).length_squared();
                        let off = (plan(v) - p).perp_dot(q - p).abs() / q.distance(p);
                        assert!(!(0.0..=1.0).contains(&t) || off > 1e-6, "{end}: {} lies between {p} and {q}", plan(v));
                    }
                }
            });
        }
    }
}

/// In bends with a gradient the platform is twisted, and which diagonals it has decides its heights: levels of the slopes have no part
/// in that. (They once had, which moved volumes by up to a thousandth from one tolerance to another.)
#[test]
fn the_platform_is_the_same_with_any_levels() {
    let zigzag = [[-0.2, 5.8, 0.1], [4.7, -3.7, -0.5], [8.6, -2.2, -0.1], [11.9, 5.9, -0.4], [16.8, 4.8, 0.4], [19.7, -3.9, 0.3]];
    let line = wide(&[open(&zigzag)], &road(3.0, 0.02, 0.04));
    let with = |interval: f64| {
        let surface = build(&line, &Design { interval: Some(interval), ..design(1.0, Extent::Elevation(-5.0)) });
        let on_edge = surface.tin.parts.iter().filter(|part| **part == Part::Platform).count();
        (on_edge, platform(&surface, -1.0))
    };
    let (few, (area, volume)) = with(10.0);
    for interval in [0.4, 0.11, 0.03] {
        let (more, (same_area, same_volume)) = with(interval);
        assert!(more > few + 4, "{more} triangles, {few} before: the levels cross the edge");
        close(same_area, area, 1e-12);
        close(same_volume, volume, 1e-12);
    }
}
