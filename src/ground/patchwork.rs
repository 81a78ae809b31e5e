//! The whole ground with the works in it, made of the ground itself: nearly all of it stays as it is, so nothing is built anew.

use crate::model::{Part, Terrain, Tin};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Triangles a thread looks at in one go.
const CHUNK: usize = 1 << 16;

/// What the works change of a ground.
#[derive(Debug)]
pub(crate) struct Patchwork {
    /// Triangles of the ground that go, ascending.
    pub(crate) gone: Vec<u32>,
    /// Triangles that come. Numbers from that of the vertices of the ground on are those of `places`.
    pub(crate) new: Vec<([u32; 3], Part)>,
    /// Vertices that come.
    pub(crate) places: Vec<DVec3>,
}

impl Patchwork {
    /// The ground with the works in it: vertices and triangles of the ground first, in the order given, without those no longer
    /// used.
    pub(crate) fn apply(self, terrain: Terrain) -> Tin {
        let Terrain { frame, mut vertices, mut triangles } = terrain;
        let unused = self.unused(vertices.len(), &triangles);
        if !unused.is_empty() {
            let number = numbers(vertices.len() + self.places.len(), &unused);
            triangles.par_iter_mut().for_each(|t| *t = [number[t[0] as usize], number[t[1] as usize], number[t[2] as usize]]);
            drop_at(&mut vertices, &unused);
            drop_at(&mut triangles, &self.gone);
            triangles.extend(self.new.iter().map(|(t, _)| t.map(|v| number[v as usize])));
        } else {
            drop_at(&mut triangles, &self.gone);
            triangles.extend(self.new.iter().map(|(t, _)| *t));
        }
        vertices.extend(self.places);
        let mut parts = vec![Part::Ground; triangles.len() - self.new.len()];
        parts.extend(self.new.iter().map(|(_, part)| *part));
        Tin { frame, vertices, triangles, parts }
    }

    /// The first `count` vertices without a triangle, ascending.
    fn unused(&self, count: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
        let used: Vec<AtomicBool> = (0..count).map(|_| AtomicBool::new(false)).collect();
        // Whichever thread comes last says the same.
        let mark = |t: &[u32; 3]| {
            for &v in t {
                if let Some(used) = used.get(v as usize) {
                    used.store(true, Ordering::Relaxed);
                }
            }
        };
        triangles.par_chunks(CHUNK).enumerate().for_each(|(chunk, some)| {
            let first = chunk * CHUNK;
            let mut from = 0;
            let begin = self.gone.partition_point(|&t| (t as usize) < first);
            for gone in self.gone[begin..].iter().map(|&t| t as usize - first).take_while(|&t| t < some.len()) {
                some[from..gone].iter().for_each(mark);
                from = gone + 1;
            }
            some[from..].iter().for_each(mark);
        });
        self.new.iter().for_each(|(t, _)| mark(t));
        (0..count as u32).filter(|&v| !used[v as usize].load(Ordering::Relaxed)).collect()
    }
}

/// New numbers of vertices when those of `unused`, ascending, go.
fn numbers(count: usize, unused: &[u32]) -> Vec<u32> {
    let mut number = Vec::with_capacity(count);
    for (n, &gone) in unused.iter().enumerate() {
        // The one that goes gets a number, too, which nobody asks for.
        number.extend((number.len() as u32..=gone).map(|v| v - n as u32));
    }
    number.extend((number.len() as u32..count as u32).map(|v| v - unused.len() as u32));
    number
}

/// Takes out what stands at `places`, which ascend.
fn drop_at<T: Copy>(list: &mut Vec<T>, places: &[u32]) {
    let mut to = places.first().map_or(list.len(), |&first| first as usize);
    for (n, &gone) in places.iter().enumerate() {
        let kept = gone as usize + 1..places.get(n + 1).map_or(list.len(), |&next| next as usize);
        let length = kept.len();
        list.copy_within(kept, to);
        to += length;
    }
    list.truncate(to);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;

    #[test]
    fn lists_without_some() {
        for places in [&[][..], &[0], &[9], &[0, 1, 2], &[3, 4, 8, 9], &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]] {
            let mut list: Vec<u32> = (0..10).collect();
            let expected: Vec<u32> = list.iter().copied().filter(|v| !places.contains(v)).collect();
            let number = numbers(12, places);
            assert_eq!(number.len(), 12);
            for (n, &v) in expected.iter().chain(&[10, 11]).enumerate() {
                assert_eq!(number[v as usize], n as u32, "{places:?}");
            }
            drop_at(&mut list, places);
            assert_eq!(list, expected);
        }
    }

    /// A square of four triangles around vertex 2, with vertex 0 unused: two triangles go, or all around the middle.
    #[test]
    fn vertices_go_with_their_last_triangle() {
        let places = [(9.0, 9.0), (0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let terrain = Terrain {
            frame: Frame::WORLD,
            vertices: places.map(|(x, y)| DVec3::new(x, y, x + y)).to_vec(),
            triangles: vec![[1, 3, 2], [3, 4, 2], [4, 5, 2], [5, 1, 2]],
        };
        let new = DVec3::new(1.0, 0.5, 7.0);
        let patchwork = Patchwork { gone: vec![0, 3], new: vec![([1, 3, 6], Part::CutSlope)], places: vec![new] };
        let tin = patchwork.apply(terrain.clone());
        let expected: Vec<DVec3> = terrain.vertices[1..].iter().copied().chain([new]).collect();
        assert_eq!(tin.vertices, expected);
        assert_eq!(tin.triangles, [[2, 3, 1], [3, 4, 1], [0, 2, 5]]);
        assert_eq!(tin.parts, [Part::Ground, Part::Ground, Part::CutSlope]);
        let patchwork = Patchwork {
            gone: vec![0, 1, 2, 3],
            new: vec![([1, 3, 4], Part::Platform), ([1, 4, 5], Part::Platform)],
            places: Vec::new(),
        };
        let tin = patchwork.apply(terrain);
        assert_eq!((tin.vertices.len(), tin.triangles), (4, vec![[0, 1, 2], [0, 2, 3]]));
    }
}
