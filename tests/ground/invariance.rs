//! What must not change the figures: turning, moving, mirroring, reversing, starting elsewhere, finer ground.

use crate::common::lines::Random;
use crate::common::oracle::Polyline;
use crate::figures::Figures;
use crate::random::{pad, road};
use crate::run::{Built, build};
use crate::site::Site;

/// Lines, areas and counts that do not depend on where things stand, each with its power of the length unit.
fn others(built: &Built) -> Vec<(&'static str, f64, i32)> {
    [
        ("daylight.loops", 0),
        ("daylight.length", 1),
        ("daylight.open_length", 1),
        ("depths.cut_max", 1),
        ("depths.fill_max", 1),
        ("surface.plan_area", 2),
        ("surface.fill_slope_area", 2),
        ("surface.cut_slope_area", 2),
        ("surface.platform_area", 2),
    ]
    .map(|(key, power)| (key, built.number(key), power))
    .to_vec()
}

/// How many chords a cone has depends on how far slopes might reach, which is judged on the ground as it stands. Chords within
/// 1e-5 keep figures within the bar.
fn sites() -> Vec<(&'static str, Site)> {
    let all =
        [("road", road(2, 9)), ("other road", road(6, 12)), ("pad", pad(3, 6, 0.3)), ("pad on level ground", pad(4, 8, 0.0))];
    all.map(|(name, site)| (name, site.tolerance(1e-5))).to_vec()
}

#[track_caller]
fn same(name: &str, before: &Built, after: &Built, relative: f64) {
    after.figures().near(&before.figures(), relative, name);
    for ((key, a, power), (_, b, _)) in others(before).into_iter().zip(others(after)) {
        let scale = others(before).iter().filter(|o| o.2 == power).map(|o| o.1).fold(0.0, f64::max);
        assert!((a - b).abs() <= relative * scale, "{name}: {key} was {a}, is {b}");
    }
}

fn unchanged(relative: f64, change: impl Fn(&Site) -> Site) {
    for (name, site) in sites() {
        same(name, &build(&site, ""), &build(&change(&site), ""), relative);
    }
}

#[test]
fn turning() {
    let (sin, cos) = 33_f64.to_radians().sin_cos();
    unchanged(1e-6, |site| site.map(|[x, y, z]| [cos * x - sin * y, sin * x + cos * y, z]));
}

/// Far off, coordinates are multiples of 1e-9.
#[test]
fn moving() {
    unchanged(1e-6, |site| site.map(|[x, y, z]| [x + 500_000.0, y + 5_000_000.0, z]));
}

/// By a power of two, so that no height is rounded.
#[test]
fn lifting() {
    unchanged(1e-9, |site| site.map(|[x, y, z]| [x, y, z - 256.0]));
}

#[test]
fn mirroring_in_plan() {
    unchanged(1e-6, |site| site.map(|[x, y, z]| [-x, y, z]));
}

#[test]
fn reversing_lines() {
    let reversed = |l: &Polyline| Polyline { points: l.points.iter().rev().copied().collect(), closed: l.closed };
    unchanged(1e-6, |site| Site { lines: site.lines.iter().map(reversed).collect(), ..site.clone() });
}

#[test]
fn starting_rings_elsewhere() {
    unchanged(1e-6, |site| {
        let mut site = site.clone();
        site.lines.iter_mut().filter(|l| l.closed).for_each(|l| l.points.rotate_left(3));
        site
    });
}

/// Vertices and triangles in another order, and triangles that start at another corner.
#[test]
fn numbering_ground_otherwise() {
    unchanged(1e-9, |site| {
        let mut site = site.clone();
        let last = site.ground.vertices.len() - 1;
        site.ground.vertices.reverse();
        site.ground.triangles.iter_mut().for_each(|t| *t = [last - t[1], last - t[2], last - t[0]]);
        let random = &mut Random::new(5);
        for i in (1..site.ground.triangles.len()).rev() {
            site.ground.triangles.swap(i, random.bits() as usize % (i + 1));
        }
        site
    });
}

/// Every triangle in six pieces: the same ground up to the last digits of heights. Without cones, the same figures to as many.
#[test]
fn splitting_ground() {
    unchanged(1e-6, |site| Site { ground: site.ground.refined(), ..site.clone() });
    for site in [crate::wedges::dam_of_a_kind(), crate::wedges::dam_of_a_kind().upside_down()] {
        let finer = Site { ground: site.ground.refined().refined(), ..site.clone() };
        same("dam", &build(&site, ""), &build(&finer, ""), 1e-9);
    }
}

/// Upside down, cut is fill to the last digit: heights are only ever negated.
#[test]
fn mirroring_in_height() {
    for (name, site) in sites() {
        let (up, down) = (build(&site, ""), build(&site.upside_down(), ""));
        let exact = |a: &Figures, b: &Figures| a.near(b, 1e-12, name);
        exact(&down.figures(), &up.figures().swapped());
        for (key, mirrored) in [
            ("depths.cut_max", "depths.fill_max"),
            ("depths.fill_max", "depths.cut_max"),
            ("surface.cut_slope_area", "surface.fill_slope_area"),
            ("surface.fill_slope_area", "surface.cut_slope_area"),
            ("surface.platform_area", "surface.platform_area"),
            ("surface.plan_area", "surface.plan_area"),
            ("daylight.length", "daylight.length"),
            ("daylight.loops", "daylight.loops"),
        ] {
            let (a, b) = (up.number(key), down.number(mirrored));
            assert!((a - b).abs() <= 1e-12 * a.abs(), "{name}: {key} {a}, mirrored {b}");
        }
        assert!((up.number("volumes.net") + down.number("volumes.net")).abs() <= 1e-12 * up.figures().cut, "{name}");
    }
}

/// OBJ, PLY, faces turned over: one ground.
#[test]
fn formats_of_the_ground() {
    for (name, site) in sites() {
        let expected = build(&site, "").figures();
        let mut turned = site.ground.clone();
        turned.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        let folder = crate::run::Folder::of(&site).with("ground.ply", site.ground.ply()).with("turned.obj", turned.obj());
        for file in ["ground.ply", "turned.obj"] {
            let arguments = format!("line.geojson --terrain {file} {}", crate::run::options(&site));
            crate::run::build_in(&folder, &arguments).figures().near(&expected, 1e-12, &format!("{name}, {file}"));
        }
    }
}
