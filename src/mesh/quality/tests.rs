use super::*;
use crate::model::Slope;
use proptest::prelude::*;
use spade::{DelaunayTriangulation, Point2, Triangulation};

/// A mesh of its own.
#[derive(Clone, Debug, Default)]
struct Own {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    groups: Vec<u32>,
    names: Vec<String>,
}

impl Own {
    fn new(vertices: &[(f64, f64, f64)], triangles: &[[u32; 3]]) -> Self {
        let vertices = vertices.iter().map(|&v| v.into()).collect();
        Self { vertices, triangles: triangles.to_vec(), ..Self::default() }
    }

    fn look(&self, bound: Option<Bound>) -> Quality {
        let mesh =
            Mesh { vertices: &self.vertices, triangles: &self.triangles, faces: &[], groups: &self.groups, names: &self.names };
        examine(&mesh, &Options { gap: None, places: 5, bound })
    }

    fn found(&self) -> Vec<(&'static str, usize)> {
        self.look(None).findings.iter().map(|finding| (finding.kind.code(), finding.count)).collect()
    }

    /// The errors alone.
    fn errors(&self) -> Vec<(&'static str, usize)> {
        let seen = self.look(None);
        let errors = seen.findings.iter().filter(|finding| finding.severity == Severity::Error);
        errors.map(|finding| (finding.kind.code(), finding.count)).collect()
    }

    fn vertex(&mut self, x: f64, y: f64, z: f64) -> u32 {
        self.vertices.push(DVec3::new(x, y, z));
        self.vertices.len() as u32 - 1
    }
}

/// A square of four triangles about its centre, 2 by 2.
fn square() -> Own {
    let corners = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 2.0, 0.0), (0.0, 2.0, 0.0), (1.0, 1.0, 1.0)];
    Own::new(&corners, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
}

#[test]
fn a_sound_surface_has_no_finding() {
    let seen = square().look(None);
    assert!(seen.findings.is_empty() && seen.sound() && seen.passed(), "{:?}", seen.findings);
    assert_eq!((seen.pieces.len(), seen.loops.len()), (1, 1));
    assert_eq!(
        (seen.loops[0].kind, seen.loops[0].edges, seen.loops[0].length, seen.loops[0].area),
        (LoopKind::Outer, 4, 8.0, 4.0)
    );
    // Each face rises 1 over 1: 45°, an area of √2 in space.
    assert_eq!(seen.slopes.plan_area, 4.0);
    assert!((seen.slopes.all.area - 4.0 * 2_f64.sqrt()).abs() < 1e-14);
    assert!((seen.slopes.mean - 45.0).abs() < 1e-12 && seen.slopes.common.len() == 1);
    assert_eq!(seen.slopes.bins.iter().position(|bin| bin.triangles == 4), Some(45));
    // Sides 2, √3, √3: the smallest angle is acos(1 / √3) = 54.7356°.
    assert!((seen.angles.smallest.unwrap().0 - 54.735_610_317_245_35).abs() < 1e-12);
}

#[test]
fn no_triangle() {
    assert_eq!(Own::default().found(), [("empty", 1)]);
    assert_eq!(Own::new(&[(1.0, 2.0, 3.0)], &[]).found(), [("empty", 1), ("unused", 1)]);
    assert!(!Own::default().look(None).sound());
}

#[test]
fn vertices_that_are_no_numbers() {
    let mut mesh = square();
    for bad in [f64::NAN, f64::INFINITY, 1e16] {
        let v = mesh.vertex(bad, 3.0, 0.0);
        mesh.triangles.push([3, 2, v]);
    }
    mesh.triangles.push([3, 2, 77]);
    assert_eq!(mesh.found(), [("not-finite", 3), ("not-usable", 4)]);
    let seen = mesh.look(None);
    assert_eq!(seen.findings[1].places[0].triangles, [5]);
    assert!(seen.findings.iter().flat_map(|f| &f.places).all(|place| place.at.is_finite()));
}

#[test]
fn triangles_without_area() {
    let mut mesh = square();
    mesh.triangles.push([0, 0, 1]);
    assert_eq!(mesh.found(), [("degenerate", 1)]);
    // Flat, but with three corners: it belongs to the surface and joins what lies beside it.
    let mut mesh = square();
    let [middle, far] = [mesh.vertex(1.0, 0.0, 0.0), mesh.vertex(1.0, -1.0, 0.0)];
    mesh.triangles.extend([[0, middle, 1], [0, far, middle], [middle, far, 1]]);
    assert_eq!(mesh.found(), [("degenerate", 1)]);
    assert_eq!(mesh.look(None).pieces.len(), 1);
}

#[test]
fn twice_the_same() {
    let mut mesh = square();
    mesh.triangles.extend([[4, 0, 1], [1, 0, 4]]);
    assert_eq!(mesh.found(), [("duplicate", 2)]);
    assert_eq!(mesh.look(None).findings[0].places[0].triangles, [1, 5]);
}

#[test]
fn turned_triangles() {
    let mut mesh = square();
    mesh.triangles[0].swap(0, 1);
    assert_eq!(mesh.found(), [("clockwise", 1), ("orientation", 2)]);
    // All of them: a surface seen from below, and sound.
    let mut mesh = square();
    mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let seen = mesh.look(None);
    assert_eq!(mesh.found(), [("clockwise", 4)]);
    assert!(seen.sound() && seen.loops[0].kind == LoopKind::Outer);
}

#[test]
fn a_wall() {
    let mut mesh = square();
    let [a, b] = [mesh.vertex(0.0, 0.0, -3.0), mesh.vertex(2.0, 0.0, -3.0)];
    mesh.triangles.extend([[a, b, 1], [a, 1, 0]]);
    assert_eq!(mesh.found(), [("upright", 2)]);
    assert_eq!(mesh.look(None).slopes.upright.area, 6.0);
}

#[test]
fn three_triangles_on_an_edge() {
    let mut mesh = square();
    let top = mesh.vertex(0.5, 0.5, 4.0);
    mesh.triangles.push([0, 4, top]);
    assert_eq!(mesh.errors(), [("upright", 1), ("non-manifold", 1)]);
    assert_eq!(mesh.look(None).findings[1].places[0].triangles, [1, 4, 5]);
}

#[test]
fn one_above_another() {
    let mut mesh = square();
    let corners = [(0.2, 0.2, 9.0), (0.4, 0.2, 9.0), (0.2, 0.4, 9.0)].map(|(x, y, z)| mesh.vertex(x, y, z));
    mesh.triangles.push(corners);
    // It lies over the triangles to the west and to the south.
    assert_eq!(mesh.found(), [("overlap", 2), ("pieces", 2)]);
    let seen = mesh.look(None);
    let place = &seen.findings[0].places[0];
    assert!(place.triangles == [1, 5] || place.triangles == [4, 5]);
    // The plane of either rises 1 over 1 from its edge of the square.
    let [_, (_, height)] = place.figures[..] else { panic!() };
    let inward = if place.triangles[0] == 1 { place.at.y } else { place.at.x };
    assert!((height - (9.0 - inward)).abs() < 1e-12 && place.at.x < 0.4 && place.at.y < 0.4, "{place:?}");
}

#[test]
fn a_t_junction_with_its_gaps() {
    // The lower half of a square as one triangle, against two: the vertex on the diagonal is 0.0003 off and 0.25 too high.
    let off = 0.0003 * 0.5_f64.sqrt();
    let corners = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 10.0, 0.0), (0.0, 10.0, 0.0), (5.0 - off, 5.0 + off, 0.25)];
    let mesh = Own::new(&corners, &[[0, 1, 2], [0, 4, 3], [4, 2, 3]]);
    // The two triangles hang together with the one by the ends of the diagonal only.
    assert_eq!(mesh.found(), [("t-junction", 1), ("pinched", 2), ("pieces", 2)]);
    let seen = mesh.look(None);
    let place = &seen.findings[0].places[0];
    assert_eq!((&place.triangles[..1], &place.vertices[..]), (&[1][..], &[5, 3, 1][..]));
    let [("distance", distance), ("height", height)] = place.figures[..] else { panic!("{place:?}") };
    assert!((distance - 0.0003).abs() < 1e-12 && (height - 0.25).abs() < 1e-12);
    // The other side of it: 0.0003 over the edge, which is an overlap too.
    let mut over = mesh.clone();
    over.vertices[4] = DVec3::new(5.0 + off, 5.0 - off, 0.25);
    assert_eq!(over.errors(), [("overlap", 2), ("t-junction", 1)]);
    // Fourteen millimetres are no seam any more, but a place without surface between two pieces that touch.
    let mut apart = mesh;
    apart.vertices[4] = DVec3::new(4.99, 5.01, 0.25);
    assert_eq!(apart.found(), [("pinched", 2), ("pieces", 2)]);
}

#[test]
fn cracks_with_their_gaps() {
    let mut mesh = square();
    let other = mesh.vertex(1.0004, 1.0003, 1.2);
    mesh.triangles[1][2] = other;
    mesh.triangles[2][2] = other;
    let found = mesh.found();
    assert_eq!(found[0], ("crack", 1), "{found:?}");
    let seen = mesh.look(None);
    let place = &seen.findings[0].places[0];
    let [("distance", distance), ("height", height)] = place.figures[..] else { panic!("{place:?}") };
    assert!((distance - 0.0005).abs() < 1e-9 && (height.abs() - 0.2).abs() < 1e-12);
    // Straight above each other there is no gap in plan.
    mesh.vertices[5] = DVec3::new(1.0, 1.0, 1.2);
    assert_eq!(mesh.found(), [("crack", 1), ("pinched", 2), ("pieces", 2)]);
    // At exactly the same place they are taken as one.
    mesh.vertices[5] = mesh.vertices[4];
    assert_eq!(mesh.found(), [("unshared", 1)]);
}

#[test]
fn sharp_corners_are_no_seams() {
    // At the corner of a needle, the far end of the short side lies 0.5 mm off the long one.
    let mesh = Own::new(&[(0.0, 0.0, 0.0), (100.0, 0.0, 0.0), (50.0, 0.0005, 0.0), (50.0, 9.0, 0.0)], &[[0, 1, 2], [0, 2, 3]]);
    let found = mesh.found();
    assert!(found.iter().all(|(code, _)| ["needle"].contains(code)), "{found:?}");
    // A fan of needles.
    let fan = Own::new(
        &[(0.0, 0.0, 0.0), (100.0, 0.0, 0.0), (90.0, 0.0004, 0.0), (80.0, 0.0007, 0.0), (70.0, 0.0009, 0.0)],
        &[[0, 1, 2], [0, 2, 3], [0, 3, 4]],
    );
    let found = fan.found();
    assert!(found.iter().all(|(code, _)| ["needle", "thin"].contains(code)), "{found:?}");
}

#[test]
fn edges_shorter_than_the_gap_are_no_cracks() {
    let mut mesh = square();
    mesh.vertices[1] = DVec3::new(1e-4, 0.0, 0.0);
    let found = mesh.found();
    assert!(found.iter().all(|(code, _)| ["needle", "thin"].contains(code)), "{found:?}");
}

#[test]
fn thin_triangles_and_needles() {
    // 0.05 mm high, on a side of 4: 0.05e-3 / 2 rad at either end.
    let mesh = Own::new(&[(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (2.0, 5e-5, 0.0)], &[[0, 1, 2]]);
    assert_eq!(mesh.found(), [("thin", 1), ("needle", 1)]);
    let seen = mesh.look(None);
    assert!((seen.findings[0].places[0].figures[0].1 - 5e-5).abs() < 1e-12);
    assert_eq!((seen.slopes.thin.triangles, seen.slopes.level.triangles, seen.angles.bins[0]), (1, 0, 1));
}

#[test]
fn pinched_pieces_and_holes() {
    // Two squares that touch at a corner.
    let mut mesh = square();
    let far = [(4.0, 2.0, 0.0), (4.0, 4.0, 0.0), (2.0, 4.0, 0.0)].map(|(x, y, z)| mesh.vertex(x, y, z));
    mesh.triangles.extend([[2, far[0], far[1]], [2, far[1], far[2]]]);
    assert_eq!(mesh.found(), [("pinched", 1), ("pieces", 2)]);
    assert!(mesh.look(None).loops.iter().all(|l| l.kind == LoopKind::Outer && l.edges == 4));
    // A square ring: the hole has sides of 1.
    let corner = |x: f64, y: f64| (x, y, 0.0);
    let outer = [corner(0.0, 0.0), corner(3.0, 0.0), corner(3.0, 3.0), corner(0.0, 3.0)];
    let inner = [corner(1.0, 1.0), corner(2.0, 1.0), corner(2.0, 2.0), corner(1.0, 2.0)];
    let triangles: Vec<[u32; 3]> =
        (0..4).flat_map(|i| [[i, (i + 1) % 4, 4 + i], [4 + i, (i + 1) % 4, 4 + (i + 1) % 4]]).collect();
    let mesh = Own::new(&[outer, inner].concat(), &triangles);
    assert_eq!(mesh.found(), [("hole", 1)]);
    let seen = mesh.look(None);
    assert_eq!((seen.loops[1].kind, seen.loops[1].length, seen.loops[1].area), (LoopKind::Hole, 4.0, 1.0));
    assert!(seen.sound());
}

#[test]
fn the_skin_of_a_solid_and_a_surface_on_end() {
    let mut mesh = square();
    let bottom = mesh.vertex(1.0, 1.0, -1.0);
    for t in 0..4 {
        let [a, b, _] = mesh.triangles[t];
        mesh.triangles.push([b, a, bottom]);
    }
    let found = mesh.found();
    assert!(found.contains(&("closed", 1)) && found.contains(&("clockwise", 4)) && found.contains(&("overlap", 4)), "{found:?}");
    let mut standing = square();
    standing.vertices.iter_mut().for_each(|v| *v = DVec3::new(v.x, 0.1 * v.z, -v.y));
    let found = standing.found();
    assert!(found.contains(&("standing", 1)), "{found:?}");
}

#[test]
fn a_stated_slope() {
    let bound = |ratio: f64, most_off: f64, groups: Option<Vec<u32>>| {
        Some(Bound { slope: Slope::from_ratio(ratio).unwrap(), tolerance_deg: 0.1, most_off, groups })
    };
    let mut mesh = square();
    let kept = mesh.look(bound(1.0, 0.0, None)).kept.unwrap();
    assert!(kept.passed && kept.within.triangles == 4 && kept.off == Share::default());
    // atan(0.99) = 44.712°, atan(0.999) = 44.971°.
    assert!(!mesh.look(bound(0.99, 0.0, None)).kept.unwrap().passed);
    assert!(mesh.look(bound(0.999, 0.0, None)).passed());
    // A level triangle beside it does not count unless its group is named.
    let far = mesh.vertex(1.0, -1.0, 0.0);
    mesh.triangles.push([0, far, 1]);
    (mesh.groups, mesh.names) = (vec![1, 1, 1, 1, 0], vec!["floor".into(), "side".into()]);
    let kept = mesh.look(bound(1.0, 0.0, None)).kept.unwrap();
    assert_eq!((kept.passed, kept.level.triangles, kept.within.triangles), (true, 1, 4));
    assert!(mesh.look(bound(1.0, 0.0, Some(vec![1]))).passed());
    let both = mesh.look(bound(1.0, 0.0, Some(vec![0, 1]))).kept.unwrap();
    // One of 1 beside four of √2.
    let share = 1.0 / (1.0 + 4.0 * 2_f64.sqrt());
    assert!(!both.passed && (both.off_share - share).abs() < 1e-12 && both.worst[0].triangles == [5]);
    assert!((both.worst[0].figures[1].1 - 45.0).abs() < 1e-12);
    assert!(mesh.look(bound(1.0, share + 1e-9, Some(vec![0, 1]))).passed());
    assert!(!mesh.look(bound(1.0, share - 1e-9, Some(vec![0, 1]))).passed());
    // Nothing on the slope: not kept, whatever may be off.
    assert!(!mesh.look(bound(3.0, 1.0, Some(vec![0]))).passed());
    assert_eq!(mesh.look(None).groups.iter().map(|g| g.all.triangles).collect::<Vec<_>>(), [1, 4]);
}

/// A Delaunay mesh over a grid whose inner nodes are moved about, so that there are no needles. Inner vertices come first.
fn delaunay(n: usize, moves: &[f64], shift: (f64, f64)) -> Own {
    let at = |k: usize| moves[k % moves.len()];
    let mut mesh = DelaunayTriangulation::<Point2<f64>>::new();
    let mut own = Own::default();
    let edge = |i: usize| i == 0 || i == n;
    let mut nodes: Vec<(usize, usize)> = (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))).collect();
    nodes.sort_by_key(|&(i, j)| edge(i) || edge(j));
    for (k, &(i, j)) in nodes.iter().enumerate() {
        let (dx, dy) = if edge(i) || edge(j) { (0.0, 0.0) } else { (0.3 * at(2 * k), 0.3 * at(2 * k + 1)) };
        let (x, y) = (i as f64 + dx, j as f64 + dy);
        mesh.insert(Point2::new(x, y)).unwrap();
        own.vertices.push(DVec3::new(x + shift.0, y + shift.1, at(3 * k)));
    }
    own.triangles = mesh.inner_faces().map(|face| face.vertices().map(|v| v.fix().index() as u32)).collect();
    own
}

/// A triangle all corners of which are inner vertices, from `pick` on.
fn inner_triangle(mesh: &Own, n: usize, pick: usize) -> usize {
    let inner = ((n - 1) * (n - 1)) as u32;
    let count = mesh.triangles.len();
    (0..count).map(|k| (k + pick) % count).find(|&t| mesh.triangles[t].iter().all(|&v| v < inner)).unwrap()
}

proptest! {
    #[test]
    fn a_seeded_defect_is_found_and_nothing_else(
        moves in prop::collection::vec(-1.0..1.0_f64, 20..60),
        n in 4..12_usize,
        pick in 0..1000_usize,
        far in any::<bool>(),
    ) {
        let shift = if far { (500_000.0, 5_400_000.0) } else { (0.0, 0.0) };
        let sound = delaunay(n, &moves, shift);
        prop_assert_eq!(sound.found(), []);
        let t = inner_triangle(&sound, n, pick);
        let [a, b, c] = sound.triangles[t];
        let corner = |v: u32| sound.vertices[v as usize];
        let seeded = |change: &dyn Fn(&mut Own)| {
            let mut mesh = sound.clone();
            change(&mut mesh);
            mesh.found()
        };
        prop_assert_eq!(seeded(&|m| m.triangles[t] = [b, a, c]), [("clockwise", 1), ("orientation", 3)]);
        prop_assert_eq!(seeded(&|m| m.triangles.push([b, c, a])), [("duplicate", 1)]);
        prop_assert_eq!(seeded(&|m| m.triangles.push([a, b, a])), [("degenerate", 1)]);
        prop_assert_eq!(seeded(&|m| {
            m.triangles.remove(t);
        }), [("hole", 1)]);
        prop_assert_eq!(seeded(&|m| m.vertices.push(corner(a) + DVec3::X)), [("unused", 1)]);
        prop_assert_eq!(seeded(&|m| {
            let v = m.vertex(f64::NAN, 0.0, 0.0);
            m.triangles.push([a, b, v]);
        }), [("not-finite", 1), ("not-usable", 1)]);
        prop_assert_eq!(seeded(&|m| {
            let v = m.vertex(corner(a).x, corner(a).y, corner(a).z + 7.0);
            m.triangles.push([a, b, v]);
        }), [("upright", 1), ("non-manifold", 1)]);
        // The triangle hangs on nothing: above itself.
        prop_assert_eq!(seeded(&|m| {
            let lifted = [a, b, c].map(|v| corner(v) + DVec3::Z).map(|p| m.vertex(p.x, p.y, p.z));
            m.triangles.push(lifted);
        }), [("overlap", 1), ("pieces", 2)]);
        // Only one of the two triangles on an edge gets its middle. Rounded, that is next to the edge or beyond it.
        let split = seeded(&|m| {
            let p = 0.5 * (corner(a) + corner(b));
            let middle = m.vertex(p.x, p.y, p.z);
            m.triangles[t] = [a, middle, c];
            m.triangles.push([middle, b, c]);
        });
        prop_assert_eq!(split[0], ("t-junction", 1));
        prop_assert!(split[1..].iter().all(|(code, _)| *code == "hairline"), "{:?}", split);
        // One triangle, a step too high at one corner.
        prop_assert_eq!(seeded(&|m| {
            let v = m.vertex(corner(a).x, corner(a).y, corner(a).z + 0.05);
            m.triangles[t] = [v, b, c];
        }), [("crack", 1)]);
        // Nothing shared.
        let soup = Own {
            vertices: sound.triangles.as_flattened().iter().map(|&v| corner(v)).collect(),
            triangles: (0..sound.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
            ..Own::default()
        };
        prop_assert_eq!(soup.found(), [("unshared", soup.vertices.len() - sound.vertices.len())]);
    }

    /// Against the comparison of all pairs, on a lattice so coarse that edges and corners touch all the time.
    #[test]
    fn overlaps_are_those_of_all_pairs(corners in prop::collection::vec((0..6_i32, 0..6_i32), 6..24), size in 2..9_usize) {
        let vertices: Vec<DVec3> = corners.iter().map(|&(x, y)| DVec3::new(x.into(), y.into(), 0.0)).collect();
        let count = vertices.len() as u32;
        let triangles: Vec<[u32; 3]> = (0..size as u32).map(|k| [k * 7 % count, (k * 5 + 1) % count, (k * 3 + 2) % count]).collect();
        let subject = Subject { frame: Frame::WORLD, vertices: &vertices, triangles: &triangles, faces: &[] };
        let faces = Faces::new(&subject, 0, &mut Vec::new());
        // Twice the area common to two triangles, exactly: they are cut at the edges of the other.
        let common = |f: usize, g: usize| -> f64 {
            let (p, q) = (faces.plan_up(f), faces.plan_up(g));
            let mut cut = p.to_vec();
            for i in 0..3 {
                let (a, d) = (q[i], q[(i + 1) % 3] - q[i]);
                let side = |r: DVec2| d.perp_dot(r - a);
                let mut next = Vec::new();
                for k in 0..cut.len() {
                    let (r, s) = (cut[k], cut[(k + 1) % cut.len()]);
                    if side(r) >= 0.0 {
                        next.push(r);
                    }
                    if side(r) * side(s) < 0.0 {
                        next.push(r + (s - r) * (side(r) / (side(r) - side(s))));
                    }
                }
                cut = next;
            }
            (1..cut.len().max(2) - 1).map(|k| (cut[k] - cut[0]).perp_dot(cut[k + 1] - cut[0])).sum()
        };
        let flat = |f: usize| matches!(faces.facing[f], faces::Facing::Up | faces::Facing::Down);
        let mut expected = 0;
        for f in (0..faces.len()).filter(|&f| flat(f)) {
            expected += (0..f).filter(|&g| flat(g) && common(f, g) > 1e-9).count();
        }
        let [deep, hair, _] = overlap::overlaps(&faces, 1e-6, 0);
        prop_assert_eq!(deep.count + hair.count, expected);
    }

    #[test]
    fn anything_gets_an_answer(
        numbers in prop::collection::vec(prop_oneof![Just(f64::NAN), Just(1e300), Just(5e-324), Just(0.0), -9.0..9.0_f64], 0..60),
        triangles in prop::collection::vec([0..25_u32, 0..25, 0..25], 0..40),
    ) {
        let vertices: Vec<DVec3> = numbers.chunks_exact(3).map(DVec3::from_slice).collect();
        let mesh = Own { vertices, triangles, ..Own::default() };
        let bound = Bound { slope: Slope::from_ratio(1.0).unwrap(), tolerance_deg: 0.1, most_off: 0.0, groups: None };
        let seen = mesh.look(Some(bound));
        for place in seen.findings.iter().flat_map(|finding| &finding.places) {
            prop_assert!(place.at.is_finite() && place.figures.iter().all(|(_, value)| value.is_finite()), "{:?}", place);
        }
    }
}
