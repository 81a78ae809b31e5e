//! Pads and straight lines on planes: the program and the brute force against closed forms.

use crate::common::build::{open, rectangle, regular, ring};
use crate::common::lines::Random;
use crate::common::oracle::Polyline;
use crate::figures::Figures;
use crate::oracle::sample;
use crate::planar::{self, Tilt};
use crate::run::build;
use crate::site::Site;
use crate::tin::{Box2, Ground, about};

/// Works on a plane.
struct Case {
    name: &'static str,
    line: Polyline,
    tilt: Tilt,
    cut: f64,
    fill: f64,
    /// What the case is for: whether there is cut, whether there is fill.
    kinds: [bool; 2],
}

/// Room about the works.
const BOX: Box2 = [[-60.0, -60.0], [60.0, 60.0]];

impl Case {
    fn expected(&self) -> Figures {
        match (&self.line.points[..], self.line.closed) {
            (points, true) => planar::pad(points, self.tilt, self.cut, self.fill),
            (&[from, to], false) => planar::line(from, to, self.tilt, self.cut, self.fill),
            _ => panic!("{}: a line of two points or a ring", self.name),
        }
    }

    fn site(&self, ground: Ground) -> Site {
        Site { cut_slope: self.cut, fill_slope: self.fill, ..Site::new(vec![self.line.clone()], 1.0, ground) }
    }
}

/// A rectangle about the origin with heights in the plane `z + slope·(x, y)`.
fn sloping(length: f64, width: f64, z: f64, slope: [f64; 2]) -> Polyline {
    let mut given = rectangle([-length / 2.0, -width / 2.0, 0.0], length, width);
    given.points.iter_mut().for_each(|p| p[2] = z + slope[0] * p[0] + slope[1] * p[1]);
    given
}

fn cases() -> Vec<Case> {
    let level = Tilt { level: 100.0, gradient: [0.0; 2] };
    let tilted = Tilt { level: 100.0, gradient: [0.0, 0.2] };
    let askew = Tilt { level: 100.0, gradient: [0.12, -0.15] };
    let (cut, fill, both) = ([true, false], [false, true], [true, true]);
    let case = |name, line, tilt, [cut, fill]: [f64; 2], kinds| Case { name, line, tilt, cut, fill, kinds };
    let triangle = ring(&[[-20.0, -15.0, 0.0], [25.0, -10.0, 0.0], [0.0, 20.0, 0.0]]);
    let at = |line: &Polyline, z: f64| Polyline {
        points: line.points.iter().map(|&[x, y, h]| [x, y, h + z]).collect(),
        closed: line.closed,
    };
    vec![
        case("pad on level ground", sloping(30.0, 20.0, 105.0, [0.0; 2]), level, [1.0, 0.5], fill),
        case("pit in level ground", sloping(30.0, 20.0, 95.0, [0.0; 2]), level, [2.0 / 3.0, 0.5], cut),
        case("pad with a fall on level ground", sloping(24.0, 24.0, 103.0, [0.05, 0.03]), level, [1.0, 0.5], fill),
        case("pad with a fall, half in the ground", sloping(24.0, 24.0, 100.0, [0.1, 0.03]), level, [1.0, 0.5], both),
        case("pad above a slope", sloping(30.0, 20.0, 105.0, [0.0; 2]), tilted, [1.0, 0.5], fill),
        case("pad below a slope", sloping(30.0, 20.0, 95.0, [0.0; 2]), tilted, [1.0, 0.5], cut),
        case("pad half in a slope", sloping(30.0, 20.0, 100.0, [0.0; 2]), tilted, [1.0, 0.5], both),
        case("pad half in a slope, other slopes", sloping(30.0, 20.0, 100.3, [0.0; 2]), tilted, [0.4, 0.8], both),
        case("pad half in a slope, askew", sloping(26.0, 18.0, 100.7, [0.0; 2]), askew, [1.0, 2.0 / 3.0], both),
        case("falling pad half in a slope, askew", sloping(26.0, 18.0, 100.2, [-0.06, 0.08]), askew, [0.8, 0.6], both),
        case("triangle above a slope", at(&triangle, 104.0), tilted, [1.0, 0.5], fill),
        case("triangle in a slope", at(&triangle, 100.0), askew, [1.5, 0.5], both),
        case("nine corners in a slope", regular(9, 17.0, 99.0), askew, [0.5, 0.6], both),
        case("line along a cross-fall", open(&[[-20.0, 0.0, 103.0], [20.0, 0.0, 103.0]]), tilted, [1.0, 0.5], fill),
        case("trench along a cross-fall", open(&[[-20.0, 0.0, 97.0], [20.0, 0.0, 97.0]]), tilted, [0.5, 1.0], cut),
        case("rising line along a cross-fall", open(&[[-20.0, 0.0, 103.0], [20.0, 4.0, 106.0]]), tilted, [1.0, 0.5], fill),
        case("line out of a slope", open(&[[-20.0, -3.0, 97.0], [20.0, 4.0, 104.0]]), tilted, [1.0, 0.5], both),
        case("line down a slope", open(&[[0.0, 25.0, 102.0], [0.0, -25.0, 99.0]]), tilted, [0.7, 0.5], both),
        case("line askew through a slope", open(&[[-22.0, -9.0, 98.0], [15.0, 20.0, 101.0]]), askew, [1.0, 0.6], both),
        case("a cone on a slope", open(&[[0.0, 0.0, 106.0], [0.01, 0.0, 106.0]]), tilted, [1.0, 0.5], fill),
        case("a funnel in a slope", open(&[[0.0, 0.0, 94.0], [0.01, 0.0, 94.0]]), askew, [0.5, 1.0], cut),
    ]
}

#[test]
fn cases_are_what_they_say() {
    for case in cases() {
        let e = case.expected();
        assert_eq!([e.cut > 1.0, e.fill > 1.0], case.kinds, "{}: {e:?}", case.name);
        assert_eq!([e.cut == 0.0, e.fill == 0.0], case.kinds.map(|k| !k), "{}: {e:?}", case.name);
    }
}

/// Brute force and closed form share nothing but the meaning of the words.
#[test]
fn brute_force_agrees() {
    for case in cases() {
        let ground = Ground::grid(BOX, 8, 8, |x, y| case.tilt.height(x, y));
        let (coarse, fine) = (sample(&case.site(ground.clone()), BOX, 150), sample(&case.site(ground), BOX, 450));
        let expected = case.expected();
        fine.roughly(&expected, 1e-3, case.name);
        // Nine times as many cells: at least a third of the error, where there is any to speak of.
        let off = |f: &Figures| (f.cut - expected.cut).abs().max((f.fill - expected.fill).abs());
        let noise = 2e-4 * (expected.cut + expected.fill);
        assert!(off(&fine) <= (off(&coarse) / 3.0).max(noise), "{}: {} after {}", case.name, off(&fine), off(&coarse));
    }
}

/// Planes are planes however they are triangulated. Chords on cones leave less fill, and less cut, never more.
#[test]
fn program_agrees() {
    let random = &mut Random::new(12);
    for case in cases() {
        let height = |x: f64, y: f64| case.tilt.height(x, y);
        for ground in [Ground::grid(BOX, 1, 1, height), Ground::jittered(random, BOX, 23, height)] {
            let site = case.site(ground);
            let built = build(&site, "");
            agrees(case.name, &site, &built, &case.expected());
            assert_eq!(built.number("daylight.open_length"), 0.0, "{}", case.name);
            assert_eq!(built.report["volumes"]["complete"], true, "{}", case.name);
        }
    }
}

/// Within what the report itself vouches for, which must be within the tolerance times the area of the works.
#[track_caller]
pub(crate) fn agrees(name: &str, site: &Site, built: &crate::run::Built, expected: &Figures) {
    let found = built.figures();
    let bound = built.number("volumes.error_bound");
    assert!(bound <= site.tolerance * (expected.cut_area + expected.fill_area), "{name}: error bound {bound}");
    let rounding = 1e-9 * (expected.cut + expected.fill);
    for (what, found, wanted) in [("cut", found.cut, expected.cut), ("fill", found.fill, expected.fill)] {
        assert!(found <= wanted + rounding, "{name}: {what} {found} for {wanted}");
        assert!(found >= wanted - bound - rounding, "{name}: {what} {found} for {wanted}, bound {bound}");
    }
    let net = built.number("volumes.net");
    assert!((net - (found.cut - found.fill)).abs() <= rounding, "{name}: net {net}");
    // The rim moves in by the tolerance over the relative fall, some ten times the tolerance, on arcs as long as the works.
    found.areas_near(expected, site.tolerance, name);
}

/// Slopes and platform apart, on a pad half in a slope: the slopes have `√(1 + k²)` of their plan area, the platform its own.
#[test]
fn true_areas() {
    let tilt = Tilt { level: 100.0, gradient: [0.0, 0.2] };
    let line = sloping(30.0, 20.0, 100.0, [0.0; 2]);
    let (cut, fill) = (1.0, 0.5);
    let inside = planar::platform(&line.points, tilt);
    let slopes = planar::pad(&line.points, tilt, cut, fill) - inside;
    let ground = Ground::grid(about(60.0), 13, 11, |x, y| tilt.height(x, y));
    let site = Site::new(vec![line], fill, ground).cut_slope(cut);
    let built = build(&site, "");
    for (key, expected) in [
        ("surface.platform_area", 600.0),
        ("surface.cut_slope_area", slopes.cut_area * 1_f64.hypot(cut)),
        ("surface.fill_slope_area", slopes.fill_area * 1_f64.hypot(fill)),
    ] {
        let found = built.number(key);
        assert!((found - expected).abs() < 1e-4 * expected, "{key}: {found} for {expected}");
    }
    // By symmetry the platform is half cut and half fill: 0.2 · 30 · 10²/2.
    assert!((inside.cut - 300.0).abs() < 1e-9 && (inside.fill - 300.0).abs() < 1e-9);
}

/// Figures from books. A pond with a bottom of 40 by 100 ft, 12 ft deep, sides 2H:1V (USDA, Agriculture Handbook 590: 97 536 ft³
/// with mitred corners; with round ones less by `4(1 − π/4)·24²·12/3`). A round pad of radius 50 at 50 above level ground, slope
/// 0.5 (the example of GRASS r.earthworks): the frustum `π·50/3·(150² + 150·50 + 50²)`, of which a polygon of 720 corners has all
/// but the segments of its circles.
#[test]
fn textbook() {
    let level = |half: f64| Ground::grid(about(half), 10, 10, |_, _| 0.0);
    let pond = Site::new(vec![sloping(100.0, 40.0, -12.0, [0.0; 2])], 0.5, level(100.0));
    let built = build(&pond, "");
    let cut = 97_536.0 - 4.0 * (1.0 - std::f64::consts::FRAC_PI_4) * 24.0 * 24.0 * 12.0 / 3.0;
    assert!((cut - 95_558.23).abs() < 0.01);
    let (found, bound) = (built.figures(), built.number("volumes.error_bound"));
    assert!(found.cut <= cut * (1.0 + 1e-12) && found.cut >= cut - bound && found.fill == 0.0, "{found:?} for {cut}");
    let pad = Site::new(vec![regular(720, 50.0, 50.0)], 0.5, level(200.0));
    let built = build(&pad, "");
    let (found, fill) = (built.figures(), 1_701_696.02);
    // Inscribed: the pad is short of its circle by 1 − sin(τ/720)/(τ/720), 1.3e-5 of it, over a height of 50; the rest is the
    // bound.
    let short = 1.3e-5 * std::f64::consts::PI * 50.0 * 50.0 * 50.0 * 3.0 + built.number("volumes.error_bound");
    assert!(
        found.fill <= fill + 0.01 && found.fill >= fill - short && found.cut == 0.0,
        "{found:?} for {fill}, short by {short}"
    );
}
