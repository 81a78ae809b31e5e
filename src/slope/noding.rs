//! Noding: vertices that coincide become one node, and lines that meet at one height get a node there.

use super::network::WELD_DISTANCE;
use crate::kernel::frame::Frame;
use crate::kernel::segment_tree::SegmentTree;
use crate::model::Line;
use glam::{DVec2, DVec3};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;

/// Brings all vertices into the local frame of the falling sheet and makes one node of those that coincide.
///
/// Returns the nodes and the node of every vertex by chain.
pub(super) fn weld(line: &Line, frame: &Frame, sign: f64) -> (Vec<DVec3>, Vec<Vec<u32>>) {
    let local = |vertex: DVec3| {
        let p = frame.to_local(vertex);
        DVec3::new(p.x, p.y, sign * p.z)
    };
    let all: Vec<DVec3> = line.chains.iter().flat_map(|c| &c.vertices).map(|&v| local(v)).collect();
    // A simple ring does not meet itself.
    let first = if is_ring(line) { (0..all.len()).collect() } else { first_within(&all) };
    let mut points: Vec<DVec3> = Vec::with_capacity(all.len());
    let mut node_of: Vec<u32> = Vec::with_capacity(all.len());
    for (i, &p) in all.iter().enumerate() {
        let node = if first[i] < i {
            node_of[first[i]]
        } else {
            points.push(p);
            points.len() as u32 - 1
        };
        node_of.push(node);
    }
    let mut rest = node_of.as_slice();
    let of_vertex = line.chains.iter().map(|c| {
        let (nodes, tail) = rest.split_at(c.vertices.len());
        rest = tail;
        nodes.to_vec()
    });
    let of_vertex = of_vertex.collect();
    (points, of_vertex)
}

/// Whether the line is one ring.
fn is_ring(line: &Line) -> bool {
    line.chains.len() == 1 && line.chains[0].closed()
}

/// For each point the first one within the weld distance, itself at the latest.
fn first_within(points: &[DVec3]) -> Vec<usize> {
    let own: Vec<usize> = (0..points.len()).collect();
    let coordinates: Vec<[f64; 3]> = points.iter().map(|p| p.to_array()).collect();
    // Validated coordinates are finite, the only thing the tree could object to.
    let Ok(tree) = ImmutableKdTree::<f64, 3>::new_from_slice(&coordinates) else { return own };
    own.into_par_iter()
        .map(|i| {
            let near =
                tree.query(&coordinates[i]).within::<SquaredEuclidean<f64>>(WELD_DISTANCE * WELD_DISTANCE).unsorted().execute();
            near.into_iter().map(|n| n.item as usize).min().unwrap_or(i).min(i)
        })
        .collect()
}

/// The segments of the line with the nodes that lie on them: (place, node), from start to end.
pub(super) struct Segments {
    pub(super) by_chain: Vec<Vec<Vec<(f64, u32)>>>,
}

impl Segments {
    pub(super) fn new(line: &Line, of_vertex: &[Vec<u32>]) -> Self {
        let by_chain = line
            .chains
            .iter()
            .zip(of_vertex)
            .map(|(chain, nodes)| {
                (0..chain.segment_count()).map(|i| vec![(0.0, nodes[i]), (1.0, nodes[(i + 1) % nodes.len()])]).collect()
            })
            .collect();
        Self { by_chain }
    }

    /// Adds nodes where segments meet at the same height: at a crossing, or where one ends on another. Crossings at different
    /// heights stay: there one line lies below the slope of the other.
    pub(super) fn noded(mut self, points: &mut Vec<DVec3>, line: &Line) -> Self {
        if is_ring(line) {
            return self;
        }
        let given = points.len();
        let flat: Vec<(usize, usize)> =
            self.by_chain.iter().enumerate().flat_map(|(c, list)| (0..list.len()).map(move |i| (c, i))).collect();
        let ends: Vec<[u32; 2]> = flat.iter().map(|&(c, i)| [self.by_chain[c][i][0].1, self.by_chain[c][i][1].1]).collect();
        let plan: Vec<(DVec2, DVec2)> =
            ends.iter().map(|e| (points[e[0] as usize].truncate(), points[e[1] as usize].truncate())).collect();
        let mut marks: Vec<(usize, f64, u32)> = Vec::new();
        SegmentTree::new(&plan).pairs(|i, j| {
            let mut touching = false;
            for (s, t) in [(i, j), (j, i)] {
                for node in ends[s].into_iter().filter(|node| !ends[t].contains(node)) {
                    if let Some(at) = on_segment(points[node as usize], ends[t].map(|v| points[v as usize])) {
                        marks.push((t, at, node));
                        touching = true;
                    }
                }
            }
            let joined = ends[i].iter().any(|v| ends[j].contains(v));
            if !touching
                && !joined
                && let Some((at, p)) = meeting(ends[i].map(|v| points[v as usize]), ends[j].map(|v| points[v as usize]))
            {
                let end_near = |s: usize| ends[s].into_iter().find(|&v| points[v as usize].distance(p) <= 2.0 * WELD_DISTANCE);
                match (end_near(i), end_near(j)) {
                    (None, None) => {
                        let node = points.len() as u32;
                        points.push(p);
                        marks.extend([(i, at[0], node), (j, at[1], node)]);
                    }
                    // No piece gets shorter than what is welded.
                    (Some(end), None) => marks.push((j, at[1], end)),
                    (None, Some(end)) => marks.push((i, at[0], end)),
                    (Some(_), Some(_)) => {}
                }
            }
            true
        });
        // Where more than two segments cross, each pair has found the place for itself.
        let first = if points.len() > given { first_within(points) } else { Vec::new() };
        let mut node_of: Vec<u32> = (0..points.len() as u32).collect();
        for (i, &first) in first.iter().enumerate().skip(given) {
            node_of[i] = node_of[first];
        }
        for (s, at, node) in marks {
            let (c, i) = flat[s];
            self.by_chain[c][i].push((at, node_of[node as usize]));
        }
        for list in self.by_chain.iter_mut().flatten().filter(|list| list.len() > 2) {
            list.sort_by(|a, b| a.0.total_cmp(&b.0));
            list.dedup_by_key(|m| m.1);
        }
        self
    }
}

/// Where point `p` lies on a segment between its ends, within the weld distance.
fn on_segment(p: DVec3, [a, b]: [DVec3; 2]) -> Option<f64> {
    let t = (p - a).dot(b - a) / (b - a).length_squared();
    let inside = t > 0.0 && t < 1.0 && p.distance(a).min(p.distance(b)) > WELD_DISTANCE;
    (inside && p.distance(a.lerp(b, t)) <= WELD_DISTANCE).then_some(t)
}

/// Where two segments meet between their ends, in plan and height: the places on both, and the point.
fn meeting([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> Option<([f64; 2], DVec3)> {
    let (u, v, w) = ((b - a).truncate(), (d - c).truncate(), (c - a).truncate());
    let aside = |p: DVec3| u.perp_dot((p - a).truncate()).abs() / u.length();
    let at = if aside(c).max(aside(d)) <= WELD_DISTANCE {
        // They run over each other, and meet where the one comes up through the other.
        let along = |p: DVec3| u.dot((p - a).truncate()) / u.length_squared();
        let [from, to] = [along(c), along(d)];
        let above = |p: DVec3, t: f64| p.z - (a.z + (b.z - a.z) * t);
        let (first, last) = (above(c, from), above(d, to));
        let part = first / (first - last);
        [from + (to - from) * part, part]
    } else {
        let det = u.perp_dot(v);
        [w.perp_dot(v) / det, w.perp_dot(u) / det]
    };
    // Parallel segments give no number here.
    let meets = at.iter().all(|t| *t > 0.0 && *t < 1.0);
    let (p, q) = (a.lerp(b, at[0]), c.lerp(d, at[1]));
    (meets && (p.z - q.z).abs() <= WELD_DISTANCE).then_some((at, p))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Chain, Place, Role};

    fn line(chains: &[&[[f64; 3]]]) -> Line {
        let chain = |points: &&[[f64; 3]]| Chain {
            name: "a".into(),
            role: Role::Open,
            vertices: points.iter().map(|&p| DVec3::from(p)).collect(),
            places: vec![Place::default(); points.len()],
            axis: None,
        };
        Line { chains: chains.iter().map(chain).collect(), ..Line::default() }
    }

    /// Nodes in use, and pieces between them.
    fn count(line: &Line) -> (usize, usize) {
        let (mut points, of_vertex) = weld(line, &Frame::WORLD, 1.0);
        let segments = Segments::new(line, &of_vertex).noded(&mut points, line);
        let pieces: Vec<[u32; 2]> =
            segments.by_chain.iter().flatten().flat_map(|s| s.windows(2).map(|w| [w[0].1, w[1].1])).collect();
        for [a, b] in &pieces {
            assert!(points[*a as usize].distance(points[*b as usize]) > WELD_DISTANCE, "a piece without length");
        }
        let mut used: Vec<u32> = pieces.as_flattened().to_vec();
        used.sort_unstable();
        used.dedup();
        (used.len(), pieces.len())
    }

    /// Each pair of lines finds its own crossing; they are one node all the same, with 2·n pieces around it.
    #[test]
    fn lines_through_one_place_share_a_node() {
        let star: Vec<[[f64; 3]; 2]> = (0..7)
            .map(|i| (0.3 + 0.4 * f64::from(i)).sin_cos())
            .map(|(s, c)| [[3.1 - 9.0 * c, 4.7 - 9.0 * s, 2.0], [3.1 + 5.0 * c, 4.7 + 5.0 * s, 2.0]])
            .collect();
        let chains: Vec<&[[f64; 3]]> = star.iter().map(|s| &s[..]).collect();
        assert_eq!(count(&line(&chains)), (15, 14));
    }

    /// Lines that run over each other in plan and cross in height; and two that cross within what is welded of an end.
    #[test]
    fn lines_over_each_other_meet_where_they_cross() {
        for turn in [0.0_f64, 0.3, 1.1] {
            let (sin, cos) = turn.sin_cos();
            let at = |x: f64, z: f64| [x * cos, x * sin, z];
            assert_eq!(count(&line(&[&[at(0.0, 0.0), at(10.0, 0.0)], &[at(2.0, -1.0), at(8.0, 1.0)]])), (5, 4));
            // Above each other all the way, and apart.
            assert_eq!(count(&line(&[&[at(0.0, 0.0), at(10.0, 0.0)], &[at(2.0, 0.5), at(8.0, 1.0)]])), (4, 2));
            assert_eq!(count(&line(&[&[at(0.0, 0.0), at(3.0, 0.0)], &[at(4.0, -1.0), at(8.0, 1.0)]])), (4, 2));
        }
        let near = [[1.2e-6, -10.0, 0.0], [1.2e-6, 10.0, 1.9e-6]];
        assert_eq!(count(&line(&[&[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0]], &near])), (4, 3));
    }

    /// A line that runs back over itself, crossed where rounding gives the two ways different heights.
    #[test]
    fn a_line_over_itself_is_crossed_once() {
        let there_and_back = [[0.0, 0.0, 0.0], [14.0, 0.0, 0.28], [0.0, 0.0, 0.0]];
        let across = [[12.0, 2.0, 0.4000000000000001], [12.0, -6.0, -0.24000000000000005]];
        assert_eq!(count(&line(&[&there_and_back, &across])), (5, 6));
    }
}
