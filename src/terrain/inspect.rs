//! How the triangles of ground lie together.

use super::place::{counted, point, short};
use super::{at, spikes};
use crate::kernel::union::Union;
use crate::mesh::check::{self, HalfEdges, Soundness};
use crate::model::{Defect, Defects, Note, Terrain};
use glam::{DVec2, DVec3};

/// What was found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// What forbids to use the ground: it has no single height somewhere.
    pub defects: Defects,
    /// What is worth knowing: pieces, holes, spikes.
    pub notes: Vec<Note>,
}

/// Looks at how triangles lie together: on each other, in several pieces, with holes, with single points far above or below
/// their neighbours. `label` names the file in messages.
///
/// Time and memory grow with the triangles (n log n along their border); meant for the part of the ground near the works.
pub fn inspect(label: &str, terrain: &Terrain) -> Findings {
    let edges = HalfEdges::new(terrain.vertices.len(), &terrain.triangles);
    let soundness = check::check(&terrain.vertices, &terrain.triangles, &edges);
    let mut findings = Findings::default();
    overlaps(label, terrain, &edges, &soundness, &mut findings.defects);
    pieces(terrain, &mut findings.notes);
    // Without a sound border its loops mean nothing.
    if findings.defects.is_empty() {
        holes(terrain, &soundness.boundary, &mut findings.notes);
    }
    spikes::find(terrain, &mut findings.notes);
    findings
}

const OVERLAP: &str = "ground-overlap";

/// Triangles that lie on each other: an edge that two of them have on the same side, or a border that crosses itself.
fn overlaps(label: &str, terrain: &Terrain, edges: &HalfEdges, soundness: &Soundness, defects: &mut Defects) {
    let mut push = |place: DVec3, figures: &str| {
        defects.push(OVERLAP, || Defect {
            code: OVERLAP,
            what: "triangles of the ground lie on each other: it has no single height there".into(),
            at: format!("{label}, at {}", point(terrain.frame.to_world(place))),
            figures: Some(figures.to_owned()),
            help: "give the surface of the ground only, without overhangs, undersides, and surfaces on top of each other".into(),
        });
    };
    if soundness.repeated_edges > 0 {
        for v in 0..terrain.vertices.len() as u32 {
            let ends = edges.from(v);
            for pair in ends.windows(2).filter(|pair| pair[0] == pair[1]) {
                let place = 0.5 * (at(&terrain.vertices, v) + at(&terrain.vertices, pair[0]));
                push(place, "an edge with two triangles on the same side");
            }
        }
    }
    if let Some(place) = soundness.overlap_at {
        let place = place.extend(at(&terrain.vertices, nearest(terrain, &soundness.boundary, place)).z);
        push(place, "the border of one piece runs over another, or over itself");
    }
}

/// Border vertex nearest to a place.
fn nearest(terrain: &Terrain, boundary: &[[u32; 2]], place: DVec2) -> u32 {
    let distance = |v: u32| at(&terrain.vertices, v).truncate().distance_squared(place);
    boundary.iter().map(|e| e[0]).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

/// Pieces that share no vertex.
fn pieces(terrain: &Terrain, notes: &mut Vec<Note>) {
    let mut sets = Union::new(terrain.vertices.len());
    for &[a, b, c] in &terrain.triangles {
        sets.join(a, b);
        sets.join(a, c);
    }
    let mut count = vec![0_usize; terrain.vertices.len()];
    for t in &terrain.triangles {
        count[sets.root(t[0]) as usize] += 1;
    }
    let mut pieces: Vec<(usize, u32)> = count.iter().enumerate().filter(|(_, n)| **n > 0).map(|(v, n)| (*n, v as u32)).collect();
    if pieces.len() > 1 {
        pieces.sort_unstable_by(|a, b| b.cmp(a));
        let (n, v) = pieces[1];
        let message = format!(
            "the ground is in {} pieces, of {} triangles and fewer; the second, of {n}, is at {}",
            pieces.len(),
            pieces[0].0,
            point(terrain.frame.to_world(at(&terrain.vertices, v)))
        );
        notes.push(Note::new("ground-pieces", message));
    }
}

/// Loops of the border around which the ground lies.
fn holes(terrain: &Terrain, boundary: &[[u32; 2]], notes: &mut Vec<Note>) {
    let plan = |v: u32| at(&terrain.vertices, v).truncate();
    let mut found: Vec<(f64, DVec3)> = Vec::new();
    let mut begin = 0;
    while begin < boundary.len() {
        let origin = plan(boundary[begin][0]);
        let mut end = begin + 1;
        while end < boundary.len() && boundary[end - 1][1] == boundary[end][0] && boundary[end - 1][1] != boundary[begin][0] {
            end += 1;
        }
        let run = &boundary[begin..end];
        // The ground is on the left, so holes are run around clockwise.
        let area = 0.5 * run.iter().map(|e| (plan(e[0]) - origin).perp_dot(plan(e[1]) - origin)).sum::<f64>();
        if area < 0.0 {
            let sum: DVec3 = run.iter().map(|e| at(&terrain.vertices, e[0])).sum();
            found.push((-area, sum / run.len() as f64));
        }
        begin = end;
    }
    let Some(&(area, place)) = found.iter().max_by(|a, b| a.0.total_cmp(&b.0)) else { return };
    let largest = if found.len() > 1 { "the largest has" } else { "it has" };
    let message = format!(
        "the ground has {}; {largest} an area of {} and lies about {}",
        counted(found.len(), "hole", "holes"),
        short(area),
        point(terrain.frame.to_world(place))
    );
    notes.push(Note::new("ground-holes", message));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;

    fn findings(points: &[(f64, f64, f64)], triangles: &[[u32; 3]]) -> (usize, Vec<&'static str>) {
        let vertices = points.iter().copied().map(DVec3::from).collect();
        let found = inspect("a", &Terrain { frame: Frame::WORLD, vertices, triangles: triangles.to_vec() });
        (found.defects.count(), found.notes.iter().map(|note| note.code).collect())
    }

    #[test]
    fn sound_ground_has_no_findings() {
        let points = [(0.0, 0.0, 0.0), (4.0, 0.0, 1.0), (4.0, 4.0, 2.0), (0.0, 4.0, 1.0)];
        assert_eq!(findings(&points, &[[0, 1, 2], [0, 2, 3]]), (0, vec![]));
    }

    #[test]
    fn triangles_on_each_other() {
        // A second triangle on the same side of an edge; one hovering above; an overhang at the end of a strip.
        let points = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0), (1.0, 1.0, 5.0), (2.0, 1.0, 5.0), (1.0, 2.0, 5.0)];
        assert_eq!(findings(&points, &[[0, 1, 2], [0, 1, 3]]).0, 1);
        assert_eq!(findings(&points, &[[0, 1, 2], [3, 4, 5]]), (1, vec!["ground-pieces"]));
    }

    #[test]
    fn a_ring_has_a_hole() {
        let points = [(0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (0.0, 9.0, 0.0), (1.0, 1.0, 0.0), (2.0, 1.0, 0.0), (1.0, 2.0, 0.0)];
        let triangles = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
        assert_eq!(findings(&points, &triangles), (0, vec!["ground-holes"]));
    }
}
