//! Line work: mesh edges with a meaning, chained to polylines.

use crate::kernel::buckets::Buckets;
use crate::model::{CurveKind, Line, LineFeature, Tin};

/// Vertices are numbered anew where the numbers of a group run over so many times more than its segments.
const SPARSE: usize = 8;

/// What a mesh edge stands for that is more than a diagonal. In the order in which line work is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// Part of the level curve with this number.
    Level(u32),
    /// Part of a crease that is lower than its surroundings.
    Valley,
    /// Part of a crease that is higher than its surroundings.
    Ridge,
    /// Part of the line: of the chain with this number.
    Hinge(u32),
    /// Part of the breakline with this number.
    Breakline(u32),
}

/// All line work of a surface, in a fixed order: `marks` are mesh edges (lower vertex first, sorted), `heights` the elevations of
/// the levels, `open` the directed edges without a counterpart. What of these is not the line itself is the boundary.
pub fn lines(line: &Line, heights: &[f64], tin: &Tin, marks: &[(Mark, [u32; 2])], open: &[[u32; 2]]) -> Vec<LineFeature> {
    let mut features = Vec::new();
    for group in marks.chunk_by(|a, b| a.0 == b.0) {
        let (kind, elevation, chain) = match group[0].0 {
            Mark::Level(u) => (CurveKind::LevelCurve, Some(heights[u as usize]), None),
            Mark::Valley => (CurveKind::Valley, None, None),
            Mark::Ridge => (CurveKind::Ridge, None, None),
            Mark::Breakline(b) => (CurveKind::Breakline, None, Some(line.breaklines[b as usize].name.clone())),
            Mark::Hinge(chain) => (CurveKind::Hinge, None, Some(line.chains[chain as usize].name.clone())),
        };
        let segments: Vec<[u32; 2]> = group.iter().map(|(_, ends)| *ends).collect();
        push(&mut features, tin, &segments, kind, elevation, chain);
    }
    let mut hinge: Vec<[u32; 2]> =
        marks.iter().filter(|(mark, _)| matches!(mark, Mark::Hinge(_))).map(|(_, ends)| *ends).collect();
    hinge.sort_unstable();
    let boundary: Vec<[u32; 2]> =
        open.iter().map(|&[a, b]| [a.min(b), a.max(b)]).filter(|e| hinge.binary_search(e).is_err()).collect();
    push(&mut features, tin, &boundary, CurveKind::Boundary, None, None);
    features
}

fn push(
    features: &mut Vec<LineFeature>,
    tin: &Tin,
    segments: &[[u32; 2]],
    kind: CurveKind,
    elevation: Option<f64>,
    chain: Option<String>,
) {
    for path in chained(segments) {
        let points = path.into_iter().map(|v| tin.world(v as usize)).collect();
        features.push(LineFeature { kind, points, elevation, chain: chain.clone(), part: None });
    }
}

/// Chains segments to paths that end where not exactly two segments meet; closed paths repeat their first vertex.
pub fn chained(segments: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let (low, high) = segments.as_flattened().iter().fold((u32::MAX, 0), |(low, high), &v| (low.min(v), high.max(v)));
    if (high.saturating_sub(low)) as usize > SPARSE * segments.len() {
        // Few of many vertices: by their order among those that occur.
        let mut ids = segments.as_flattened().to_vec();
        ids.sort_unstable();
        ids.dedup();
        let number = |v: u32| ids.partition_point(|&id| id < v) as u32;
        let numbered: Vec<[u32; 2]> = segments.iter().map(|s| s.map(number)).collect();
        let named = |path: Vec<u32>| path.into_iter().map(|v| ids[v as usize]).collect();
        return chained(&numbered).into_iter().map(named).collect();
    }
    let of_ends = |(i, &[a, b]): (u32, &[u32; 2])| [(a - low, i), (b - low, i)];
    let by_vertex = Buckets::new(high.saturating_sub(low) as usize + 1, (0..).zip(segments).flat_map(of_ends));
    let at = |v: u32| by_vertex.of(v - low);
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
            next = if here.len() == 2 { here.iter().map(|&i| i as usize).find(|&j| !used[j]) } else { None };
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
        // The same with numbers far apart.
        let far = |v: u32| 1000 * v + 5;
        let mut paths = chained(&[[0, 1], [1, 2], [2, 3], [1, 4], [7, 8], [8, 9], [7, 9]].map(|s| s.map(far)));
        paths.sort();
        assert_eq!(
            paths,
            [vec![0, 1], vec![1, 2, 3], vec![1, 4], vec![7, 8, 9, 7]].map(|p| p.into_iter().map(far).collect::<Vec<_>>())
        );
        assert!(chained(&[]).is_empty());
    }
}
