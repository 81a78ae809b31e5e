//! What may be found on a mesh, and where.

use glam::DVec3;

/// What a finding means for the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The mesh is not a sound surface.
    Error,
    /// Worth knowing; the surface is sound all the same.
    Remark,
}

/// Kinds of findings, in the order they are reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// There is no triangle at all.
    Empty,
    /// Vertices with a coordinate that is no number, infinite, or beyond [`super::LIMIT`].
    NotFinite,
    /// Triangles with a corner that is no such vertex.
    NotUsable,
    /// Triangles without area: a corner used twice, or all corners on one straight line.
    Degenerate,
    /// Triangles with the same corners as another.
    Duplicate,
    /// Triangles that stand upright: they have an area, but none in plan.
    Upright,
    /// Triangles that are clockwise in plan.
    Clockwise,
    /// Edges of more than two triangles.
    NonManifold,
    /// Edges along which two triangles run in the same direction.
    Orientation,
    /// Pairs of triangles whose insides overlap in plan.
    Overlap,
    /// Vertices on the inside of a boundary edge that does not end there.
    TJunction,
    /// Pairs of boundary vertices almost or quite above each other that are not one.
    Crack,
    /// A search was given up because there were too many pairs to look at.
    Unfinished,
    /// Pairs of triangles that overlap by no more than rounding, see [`super::HAIRLINE`].
    Hairline,
    /// Triangles lower than [`super::THIN`].
    Thin,
    /// Triangles with an angle below [`super::NEEDLE_DEG`].
    Needle,
    /// Vertices where more than one stretch of boundary passes.
    Pinched,
    /// Holes in the surface.
    Hole,
    /// The surface is in several pieces.
    Pieces,
    /// The surface has no boundary: it is the skin of a solid.
    Closed,
    /// The surface stands upright as a whole.
    Standing,
    /// Vertices that no triangle uses.
    Unused,
    /// Vertices at exactly the place of another, taken as one with it.
    Unshared,
}

impl Kind {
    /// All kinds, in order.
    pub const ALL: [Self; 23] = [
        Self::Empty,
        Self::NotFinite,
        Self::NotUsable,
        Self::Degenerate,
        Self::Duplicate,
        Self::Upright,
        Self::Clockwise,
        Self::NonManifold,
        Self::Orientation,
        Self::Overlap,
        Self::TJunction,
        Self::Crack,
        Self::Unfinished,
        Self::Hairline,
        Self::Thin,
        Self::Needle,
        Self::Pinched,
        Self::Hole,
        Self::Pieces,
        Self::Closed,
        Self::Standing,
        Self::Unused,
        Self::Unshared,
    ];

    /// Stable short name.
    pub fn code(self) -> &'static str {
        match self {
            Self::Empty => "empty",
            Self::NotFinite => "not-finite",
            Self::NotUsable => "not-usable",
            Self::Degenerate => "degenerate",
            Self::Duplicate => "duplicate",
            Self::Upright => "upright",
            Self::Clockwise => "clockwise",
            Self::NonManifold => "non-manifold",
            Self::Orientation => "orientation",
            Self::Overlap => "overlap",
            Self::TJunction => "t-junction",
            Self::Crack => "crack",
            Self::Unfinished => "unfinished",
            Self::Hairline => "hairline",
            Self::Thin => "thin",
            Self::Needle => "needle",
            Self::Pinched => "pinched",
            Self::Hole => "hole",
            Self::Pieces => "pieces",
            Self::Closed => "closed",
            Self::Standing => "standing",
            Self::Unused => "unused",
            Self::Unshared => "unshared",
        }
    }

    /// What is counted, in words that follow the number.
    pub fn what(self, count: usize) -> &'static str {
        let (one, several) = match self {
            Self::Empty => ("mesh without a triangle", "meshes without a triangle"),
            Self::NotFinite => ("vertex that is not finite, or too large", "vertices that are not finite, or too large"),
            Self::NotUsable => ("triangle with such a corner, left out below", "triangles with such a corner, left out below"),
            Self::Degenerate => ("triangle without area", "triangles without area"),
            Self::Duplicate => {
                ("triangle with the corners of another, left out below", "triangles with the corners of another, left out below")
            }
            Self::Upright => ("triangle that stands upright", "triangles that stand upright"),
            Self::Clockwise => ("triangle that is clockwise in plan", "triangles that are clockwise in plan"),
            Self::NonManifold => ("edge of more than two triangles", "edges of more than two triangles"),
            Self::Orientation => ("edge whose two triangles face opposite ways", "edges whose two triangles face opposite ways"),
            Self::Overlap => ("pair of triangles that overlap in plan", "pairs of triangles that overlap in plan"),
            Self::TJunction => ("T-junction: a vertex inside a boundary edge", "T-junctions: vertices inside a boundary edge"),
            Self::Crack => {
                ("crack: a pair of boundary vertices that should be one", "cracks: pairs of boundary vertices that should be one")
            }
            Self::Unfinished => ("search given up: too many pairs lie close", "searches given up: too many pairs lie close"),
            Self::Hairline => {
                ("pair of triangles that overlap by rounding only", "pairs of triangles that overlap by rounding only")
            }
            Self::Thin => ("triangle too low for an angle to be told", "triangles too low for an angle to be told"),
            Self::Needle => ("needle: a triangle with an angle below 1°", "needles: triangles with an angle below 1°"),
            Self::Pinched => ("vertex where the surface hangs by a point", "vertices where the surface hangs by a point"),
            Self::Hole => ("hole", "holes"),
            Self::Pieces => ("piece", "pieces that share no edge"),
            Self::Closed => ("closed surface: the skin of a solid, not a ground", "closed surfaces"),
            Self::Standing => ("surface that stands on edge as a whole: is y up in this file?", "surfaces that stand on edge"),
            Self::Unused => ("vertex that no triangle uses", "vertices that no triangle uses"),
            Self::Unshared => {
                ("vertex exactly at the place of another, taken as one", "vertices exactly at the place of another, taken as one")
            }
        };
        if count == 1 { one } else { several }
    }

    /// What it means for the surface, where nothing else is known: only [`Kind::Clockwise`] may be either.
    pub fn severity(self) -> Severity {
        if self <= Self::Unfinished { Severity::Error } else { Severity::Remark }
    }
}

/// Where something was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The place in world coordinates.
    pub at: DVec3,
    /// Numbers of the triangles (faces of the file) concerned, counted from 1 in its order.
    pub triangles: Vec<usize>,
    /// Numbers of the vertices concerned, counted from 1 in the order of the mesh.
    pub vertices: Vec<usize>,
    /// Figures with their names, lengths in the unit of the mesh.
    pub figures: Vec<(&'static str, f64)>,
}

/// Everything found of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The kind.
    pub kind: Kind,
    /// What it means.
    pub severity: Severity,
    /// How many there are.
    pub count: usize,
    /// Whether there may be more, because counting was given up.
    pub at_least: bool,
    /// Some of the places: the worst, where there is a measure, else the first.
    pub places: Vec<Place>,
}

/// Counts findings of one kind and keeps the places of the worst; of equally bad ones the first.
#[derive(Debug)]
pub(super) struct Collector {
    kind: Kind,
    pub(super) count: usize,
    pub(super) at_least: bool,
    keep: usize,
    places: Vec<(f64, Place)>,
}

impl Collector {
    pub(super) fn new(kind: Kind, keep: usize) -> Self {
        Self { kind, count: 0, at_least: false, keep, places: Vec::new() }
    }

    /// Takes down one more; `place` is called only if it is among the worst so far.
    pub(super) fn add(&mut self, badness: f64, place: impl FnOnce() -> Place) {
        self.count += 1;
        let after = self.places.partition_point(|(b, _)| b.total_cmp(&badness).is_ge());
        if after < self.keep {
            self.places.truncate(self.keep - 1);
            self.places.insert(after, (badness, place()));
        }
    }

    pub(super) fn places(self) -> Vec<Place> {
        self.places.into_iter().map(|(_, place)| place).collect()
    }

    /// The finding; `None` if there is nothing.
    pub(super) fn finish(self) -> Option<Finding> {
        let (kind, count, at_least) = (self.kind, self.count, self.at_least);
        (count > 0).then(|| Finding { kind, severity: kind.severity(), count, at_least, places: self.places() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_are_kept_in_order() {
        let mut collector = Collector::new(Kind::Overlap, 3);
        for (n, badness) in [2.0, 5.0, 2.0, 1.0, 5.0, 3.0].into_iter().enumerate() {
            let place = || Place { at: DVec3::ZERO, triangles: vec![n], vertices: vec![], figures: vec![] };
            collector.add(badness, place);
        }
        let finding = collector.finish().unwrap();
        assert_eq!((finding.count, finding.severity), (6, Severity::Error));
        assert_eq!(finding.places.iter().map(|p| p.triangles[0]).collect::<Vec<_>>(), [1, 4, 5]);
        assert_eq!(Collector::new(Kind::Overlap, 3).finish(), None);
        let mut none = Collector::new(Kind::Overlap, 0);
        none.add(1.0, || Place { at: DVec3::ZERO, triangles: vec![], vertices: vec![], figures: vec![] });
        assert_eq!(none.finish().unwrap().places, []);
    }

    #[test]
    fn codes_differ() {
        let mut codes: Vec<&str> = Kind::ALL.iter().map(|k| k.code()).collect();
        codes.sort_unstable();
        codes.dedup();
        assert_eq!(codes.len(), Kind::ALL.len());
        assert!(Kind::ALL.is_sorted());
    }
}
