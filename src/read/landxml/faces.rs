//! Points and faces of one surface: points under names of any kind, in any order, before or after the faces that name them.

use crate::read::terrain::{Faces, RawFaces};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Ids that are whole numbers below this stand for themselves; all others are numbered from here.
const NAMED: u32 = 1 << 31;

/// Digits of whole numbers that are surely below [`NAMED`].
const PLAIN_DIGITS: usize = 9;

/// Ids are looked up in a plain table as long as it is no longer than this many times the number of points, and a start.
const SPARSE: usize = 4;
const START: usize = 65_536;

/// What is wrong with the ids of a surface.
#[derive(Debug, PartialEq)]
pub(super) enum IdError {
    /// Two points at different places have the same id.
    Twice {
        /// The id.
        id: String,
        /// The points, counted from 0 in the order of the file.
        points: [usize; 2],
    },
    /// A face has a corner that is no point.
    NoPoint {
        /// The id.
        id: String,
        /// The visible face, counted from 0.
        face: usize,
    },
}

/// Points and faces as they are gathered.
pub(super) struct Mesh {
    pub(super) points: Vec<DVec3>,
    /// Id of each point.
    ids: Vec<u32>,
    /// Corners are ids until [`Self::finish`].
    pub(super) faces: Faces,
    names: FxHashMap<Box<[u8]>, u32>,
}

impl Mesh {
    pub(super) fn new() -> Self {
        Self { points: Vec::new(), ids: Vec::new(), faces: Faces::with_capacity(0), names: FxHashMap::default() }
    }

    /// Adds a point.
    pub(super) fn point(&mut self, id: &[u8], point: DVec3) {
        let id = self.id(id);
        self.ids.push(id);
        self.points.push(point);
    }

    /// The number that stands for an id.
    #[inline]
    pub(super) fn id(&mut self, id: &[u8]) -> u32 {
        if id.len() <= PLAIN_DIGITS && id.iter().all(u8::is_ascii_digit) {
            return id.iter().fold(0, |n, &digit| 10 * n + u32::from(digit - b'0'));
        }
        if let Some(&number) = self.names.get(id) {
            return number;
        }
        let number = NAMED.saturating_add(self.names.len() as u32);
        self.names.insert(id.into(), number);
        number
    }

    fn name(&self, id: u32) -> String {
        let name = self.names.iter().find(|(_, number)| **number == id);
        name.map_or_else(|| id.to_string(), |(name, _)| String::from_utf8_lossy(name).into_owned())
    }

    /// The points, and the faces with their corners as numbers of points.
    ///
    /// # Errors
    /// [`IdError`]: the first one.
    pub(super) fn finish(mut self) -> Result<(Vec<DVec3>, RawFaces), IdError> {
        let mut table = Table::new(&self.ids);
        for (i, &id) in self.ids.iter().enumerate() {
            let first = table.insert(id, i as u32) as usize;
            if self.points[first] != self.points[i] {
                return Err(IdError::Twice { id: self.name(id), points: [first, i] });
            }
        }
        let mut faces = std::mem::replace(&mut self.faces, Faces::with_capacity(0)).finish();
        let corners: &mut [u32] = match &mut faces {
            RawFaces::Triangles(triangles) => triangles.as_flattened_mut(),
            RawFaces::Polygons { corners, .. } => corners,
        };
        let mut missing = None;
        for (at, corner) in corners.iter_mut().enumerate() {
            match table.get(*corner) {
                Some(point) => *corner = point,
                None => {
                    missing = Some((at, *corner));
                    break;
                }
            }
        }
        if let Some((at, id)) = missing {
            let face = match &faces {
                RawFaces::Triangles(_) => at / 3,
                RawFaces::Polygons { ends, .. } => ends.partition_point(|&end| end <= at),
            };
            return Err(IdError::NoPoint { id: self.name(id), face });
        }
        Ok((self.points, faces))
    }
}

/// From ids to points.
enum Table {
    /// By id; [`u32::MAX`] where there is none.
    Plain(Vec<u32>),
    Sparse(FxHashMap<u32, u32>),
}

impl Table {
    fn new(ids: &[u32]) -> Self {
        let most = ids.iter().copied().max().unwrap_or(0) as usize;
        if most < SPARSE * ids.len() + START { Self::Plain(vec![u32::MAX; most + 1]) } else { Self::Sparse(FxHashMap::default()) }
    }

    /// The first point of this id, which is `point` if there was none.
    fn insert(&mut self, id: u32, point: u32) -> u32 {
        let slot = match self {
            Self::Plain(table) => &mut table[id as usize],
            Self::Sparse(map) => map.entry(id).or_insert(u32::MAX),
        };
        if *slot == u32::MAX {
            *slot = point;
        }
        *slot
    }

    #[inline]
    fn get(&self, id: u32) -> Option<u32> {
        match self {
            Self::Plain(table) => table.get(id as usize).copied().filter(|&point| point != u32::MAX),
            Self::Sparse(map) => map.get(&id).copied(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(ids: &[&str], faces: &[&[&str]]) -> Result<RawFaces, IdError> {
        let mut mesh = Mesh::new();
        for face in faces {
            let corners: Vec<u32> = face.iter().map(|id| mesh.id(id.as_bytes())).collect();
            match corners[..] {
                [a, b, c] => mesh.faces.triangle([a, b, c]),
                _ => mesh.faces.polygon(&corners),
            }
        }
        for (i, id) in ids.iter().enumerate() {
            mesh.point(id.as_bytes(), DVec3::splat(i as f64));
        }
        mesh.finish().map(|(_, faces)| faces)
    }

    #[test]
    fn ids_of_all_kinds() {
        for ids in
            [["1", "2", "3"], ["7", "4000000000", "p 1"], ["999999999", "0", "5"], ["a", "b", "é"], ["1234567890123", "x", "12"]]
        {
            let [a, b, c] = ids;
            assert_eq!(mesh(&ids, &[&[c, a, b]]), Ok(RawFaces::Triangles(vec![[2, 0, 1]])), "{ids:?}");
        }
    }

    #[test]
    fn what_is_missing_or_double_is_told() {
        let no_point = |id: &str, face| Err(IdError::NoPoint { id: id.into(), face });
        assert_eq!(mesh(&["1", "2", "3"], &[&["1", "2", "3"], &["1", "2", "4"]]), no_point("4", 1));
        assert_eq!(mesh(&["1", "2", "3"], &[&["1", "2", "x"]]), no_point("x", 0));
        assert_eq!(mesh(&["1", "2", "900000000"], &[&["1", "2", "900000000"], &["1", "2", "3"]]), no_point("3", 1));
        assert_eq!(mesh(&["1", "2", "3", "4"], &[&["1", "2", "3", "4"], &["1", "9", "3"]]), no_point("9", 1));
        assert_eq!(mesh(&["1", "2", "2"], &[]), Err(IdError::Twice { id: "2".into(), points: [1, 2] }));
        assert_eq!(mesh(&["a", "b", "a"], &[]), Err(IdError::Twice { id: "a".into(), points: [0, 2] }));
    }
}
