//! Line work: mesh edges with a meaning, chained to polylines.

use super::Body;
use crate::mesh::check::HalfEdges;
use crate::model::{CurveKind, Design, Line, LineFeature, Sheet as SheetKind};
use crate::slope::emit::Trace;
use crate::slope::levels::Levels;
use crate::slope::network::Network;
use std::collections::BTreeMap;

/// All line work of the surface, in a fixed order.
pub(crate) fn lines(
    line: &Line,
    design: &Design,
    network: &Network,
    levels: &Levels,
    body: &Body,
    edges: &HalfEdges,
) -> Vec<LineFeature> {
    let mut features = Vec::new();
    let mut push = |kind, elevation: Option<f64>, chain: Option<String>, segments: &[[u32; 2]]| {
        for path in chained(segments) {
            let points = path.into_iter().map(|v| body.tin.world(v as usize)).collect();
            features.push(LineFeature { kind, points, elevation, chain: chain.clone() });
        }
    };
    let mut by_level: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
    let mut creases = Vec::new();
    let mut hinge: Vec<[u32; 2]> = Vec::new();
    let mut by_chain: Vec<Vec<[u32; 2]>> = vec![Vec::new(); line.chains.len()];
    for &(kind, ends) in &body.traces {
        match kind {
            Trace::Level(u) => by_level.entry(u).or_default().push(ends),
            Trace::Crease => creases.push(ends),
            Trace::Hinge(e) => {
                hinge.push(ends);
                by_chain[network.edges[e as usize].given[0].chain as usize].push(ends);
            }
        }
    }
    for (u, segments) in &by_level {
        push(CurveKind::LevelCurve, Some(network.sign * levels.heights[*u as usize]), None, segments);
    }
    // The falling sheet is the greatest of its facets: where two meet it is lower than around.
    let crease = if design.sheet == SheetKind::Falling { CurveKind::Valley } else { CurveKind::Ridge };
    push(crease, None, None, &creases);
    hinge.sort_unstable();
    for (chain, segments) in line.chains.iter().zip(&by_chain) {
        push(CurveKind::Hinge, None, Some(chain.name.clone()), segments);
    }
    let boundary: Vec<[u32; 2]> =
        edges.open().into_iter().map(|[a, b]| [a.min(b), a.max(b)]).filter(|e| hinge.binary_search(e).is_err()).collect();
    push(CurveKind::Boundary, None, None, &boundary);
    features
}

/// Chains segments to paths that end where not exactly two segments meet; closed paths repeat their first vertex.
fn chained(segments: &[[u32; 2]]) -> Vec<Vec<u32>> {
    // Segments by vertex: (vertex, segment), sorted.
    let mut by_vertex: Vec<(u32, u32)> = segments.iter().enumerate().flat_map(|(i, s)| s.map(|v| (v, i as u32))).collect();
    by_vertex.sort_unstable();
    let at = |v: u32| {
        let from = by_vertex.partition_point(|e| e.0 < v);
        let count = by_vertex[from..].iter().take_while(|e| e.0 == v).count();
        &by_vertex[from..from + count]
    };
    let mut used = vec![false; segments.len()];
    let walk = |from: u32, first: usize, used: &mut Vec<bool>| {
        let mut path = vec![from];
        let mut last = from;
        let mut next = Some(first);
        while let Some(i) = next {
            used[i] = true;
            let [a, b] = segments[i];
            last = if last == a { b } else { a };
            path.push(last);
            let here = at(last);
            next = if here.len() == 2 { here.iter().map(|e| e.1 as usize).find(|&j| !used[j]) } else { None };
        }
        path
    };
    let mut paths = Vec::new();
    for i in 0..segments.len() {
        for v in segments[i] {
            if !used[i] && at(v).len() != 2 {
                paths.push(walk(v, i, &mut used));
            }
        }
    }
    for i in 0..segments.len() {
        if !used[i] {
            paths.push(walk(segments[i][0], i, &mut used));
        }
    }
    paths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_paths_and_loops() {
        let mut paths = chained(&[[0, 1], [1, 2], [2, 3], [1, 4], [7, 8], [8, 9], [7, 9]]);
        paths.sort();
        assert_eq!(paths, [vec![0, 1], vec![1, 2, 3], vec![1, 4], vec![7, 8, 9, 7]]);
    }
}
