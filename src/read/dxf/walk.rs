//! All entities of a drawing, those of inserted blocks in their places.

use super::entity::{self, Common, Head, Insert, Kind, Polyline};
use super::index::Index;
use super::layers::{LayerId, Layers};
use super::pairs::{Pairs, Place};
use super::transform::axes;
use crate::read::ReadError;
use crate::read::error::refuse;
use glam::{DAffine3, DVec3};
use std::collections::BTreeMap;

/// Blocks inside blocks may be this deep: drawings in use have three or four.
const DEEPEST: usize = 32;

/// How many pairs may be read from blocks, repetitions counted, where the drawing has so many: symbols of a hundred pairs are
/// inserted by six. So small files stay small, and large ones need at most a few times their own room.
fn most_pairs(pairs: u64) -> u64 {
    /// In any drawing: those of half a million vertices.
    const FREE: u64 = 2_000_000;
    /// Beyond this, four times those of the drawing.
    const MANY: u64 = 20_000_000;
    FREE.saturating_add(pairs.saturating_mul(16)).min(MANY.max(pairs.saturating_mul(4)))
}

/// Which entities are wanted; the others are only counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Want {
    /// Polylines, LINEs and ARCs.
    Lines,
    /// Faces, meshes and points.
    Ground,
}

/// The coordinates of an entity.
pub(super) enum Shape {
    Polyline(Polyline),
    Arc(Polyline),
    Segment([DVec3; 2]),
    /// The last corner of triangles is repeated.
    Face([DVec3; 4]),
    Mesh(Vec<DVec3>, Vec<[u32; 4]>),
    Point(DVec3),
}

/// An entity in its place.
pub(super) struct Placed {
    pub(super) shape: Shape,
    /// From its coordinates to the world; `None`: they are the world's.
    pub(super) system: Option<DAffine3>,
    pub(super) layer: LayerId,
    pub(super) place: Place,
}

/// What was passed over.
#[derive(Clone, Debug, Default)]
pub(super) struct Passed {
    /// Wanted, but on layers that are off or frozen, or invisible.
    pub(super) hidden: usize,
    /// Kinds that are not read, on layers that are meant, with their numbers.
    pub(super) kinds: BTreeMap<String, usize>,
    /// Inserts of blocks that are not in the file, with the first of them.
    pub(super) missing: Option<(usize, String)>,
}

/// What surrounds the entities of a block.
#[derive(Clone, Copy, Default)]
struct Around {
    system: Option<DAffine3>,
    /// Layer of the insert, which entities on layer 0 take.
    layer: Option<LayerId>,
    /// Whether an insert around is frozen or invisible.
    hidden: bool,
}

/// Reads through the drawing and hands every wanted entity to `take`, in the order of the file.
///
/// # Errors
/// Damaged entities; blocks that contain themselves, or expand to too much; what `take` returns.
pub(super) fn walk<'a>(
    index: &Index<'a>,
    layers: &mut Layers<'a>,
    want: Want,
    take: &mut dyn FnMut(Placed) -> Result<(), ReadError>,
) -> Result<Passed, ReadError> {
    let most = most_pairs(index.pairs);
    let mut walk = Walk { index, layers, want, take, passed: Passed::default(), stack: Vec::new(), pairs: 0, most };
    for section in &index.entities {
        walk.span(*section, Around::default())?;
    }
    Ok(walk.passed)
}

struct Walk<'i, 'a> {
    index: &'i Index<'a>,
    layers: &'i mut Layers<'a>,
    want: Want,
    take: &'i mut dyn FnMut(Placed) -> Result<(), ReadError>,
    passed: Passed,
    /// The blocks one is in.
    stack: Vec<usize>,
    /// Read from blocks.
    pairs: u64,
    /// May be read from blocks.
    most: u64,
}

impl<'a> Walk<'_, 'a> {
    /// The entities from here to the end of section or block.
    fn span(&mut self, mut pairs: Pairs<'a>, around: Around) -> Result<(), ReadError> {
        loop {
            let head = pairs.required()?;
            match (head.code, head.text()) {
                (0, b"ENDSEC" | b"ENDBLK") => return Ok(()),
                (0, kind) => self.entity(kind, head.place, &mut pairs, around)?,
                // Comments.
                _ => {}
            }
        }
    }

    fn entity(&mut self, kind: &'a [u8], place: Place, pairs: &mut Pairs<'a>, around: Around) -> Result<(), ReadError> {
        match (kind, self.want) {
            (b"3DFACE", Want::Ground) => {
                let (common, corners) = entity::corners(pairs, place)?;
                self.shape(&common, place, around, || Shape::Face(corners))
            }
            (b"POINT", Want::Ground) => {
                let (common, [point]) = entity::corners(pairs, place)?;
                self.shape(&common, place, around, || Shape::Point(point))
            }
            (b"LINE", Want::Lines) => {
                let (common, ends) = entity::corners(pairs, place)?;
                self.shape(&common, place, around, || Shape::Segment(ends))
            }
            (b"ARC", Want::Lines) => {
                let (common, arc) = entity::arc(pairs, place)?;
                self.shape(&common, place, around, || Shape::Arc(arc))
            }
            (b"LWPOLYLINE", Want::Lines) => {
                let (common, line) = entity::lwpolyline(pairs)?;
                self.shape(&common, place, around, || Shape::Polyline(line))
            }
            (b"POLYLINE", want) => {
                let head = Head::read(pairs, place)?;
                match (head.kind(), want) {
                    (Kind::Line, Want::Lines) => {
                        let line = head.line(pairs)?;
                        self.shape(&head.common, place, around, || Shape::Polyline(line))
                    }
                    (Kind::Polyface, Want::Ground) => {
                        let (points, faces) = head.polyface(pairs)?;
                        self.shape(&head.common, place, around, || Shape::Mesh(points, faces))
                    }
                    (Kind::Net, Want::Ground) => {
                        let (points, faces) = head.net(pairs)?;
                        self.shape(&head.common, place, around, || Shape::Mesh(points, faces))
                    }
                    (kind, _) => {
                        head.skip(pairs)?;
                        self.count(&head.common, around, |census| match kind {
                            Kind::Line => census.lines += 1,
                            Kind::Net | Kind::Polyface => census.faces += 1,
                        });
                        Ok(())
                    }
                }
            }
            (b"LINE" | b"ARC" | b"LWPOLYLINE", Want::Ground) => {
                let common = entity::other(pairs)?;
                self.count(&common, around, |census| census.lines += 1);
                Ok(())
            }
            (b"3DFACE", Want::Lines) => {
                let common = entity::other(pairs)?;
                self.count(&common, around, |census| census.faces += 1);
                Ok(())
            }
            (b"POINT", Want::Lines) => {
                let common = entity::other(pairs)?;
                self.count(&common, around, |census| census.points += 1);
                Ok(())
            }
            (b"INSERT", _) => {
                let insert = Insert::read(pairs)?;
                self.insert(&insert, pairs.label, place, around)
            }
            // Text of inserts and their end; windows of sheets.
            (b"ATTRIB" | b"ATTDEF" | b"SEQEND" | b"VIEWPORT", _) => entity::other(pairs).map(drop),
            _ => {
                let common = entity::other(pairs)?;
                let layer = self.layer(&common, around);
                self.count(&common, around, |census| census.others += 1);
                if !common.paper && self.shown(layer, common.invisible, around) {
                    let kind = super::names::decode(&kind[..kind.len().min(40)]);
                    *self.passed.kinds.entry(kind).or_default() += 1;
                }
                Ok(())
            }
        }
    }

    /// The layer an entity is on, that of the insert for those on layer 0.
    fn layer(&mut self, common: &Common<'a>, around: Around) -> LayerId {
        match around.layer {
            Some(layer) if common.layer == b"0" => layer,
            _ => self.layers.id(common.layer),
        }
    }

    /// Whether an entity on this layer is meant. Layers asked for by name are, in whatever state.
    fn shown(&self, layer: LayerId, invisible: bool, around: Around) -> bool {
        self.layers.meant(layer) && (self.layers.chosen() || !(invisible || around.hidden))
    }

    fn count(&mut self, common: &Common<'a>, around: Around, add: impl FnOnce(&mut super::layers::Census)) {
        if !common.paper {
            let layer = self.layer(common, around);
            if let Some(census) = self.layers.census(layer) {
                add(census);
            }
        }
    }

    fn shape(
        &mut self,
        common: &Common<'a>,
        place: Place,
        around: Around,
        shape: impl FnOnce() -> Shape,
    ) -> Result<(), ReadError> {
        if common.paper {
            return Ok(());
        }
        let layer = self.layer(common, around);
        let shape = shape();
        if let Some(census) = self.layers.census(layer) {
            match &shape {
                Shape::Polyline(_) | Shape::Arc(_) | Shape::Segment(_) => census.lines += 1,
                Shape::Face(_) => census.faces += 1,
                Shape::Mesh(_, faces) => census.faces += faces.len(),
                Shape::Point(_) => census.points += 1,
            }
        }
        if !self.shown(layer, common.invisible, around) {
            // What was not asked for by name needs no mention.
            self.passed.hidden += usize::from(!self.layers.chosen());
            return Ok(());
        }
        let planar = matches!(&shape, Shape::Polyline(line) | Shape::Arc(line) if line.planar) && common.extrusion != DVec3::Z;
        let system = match (around.system, planar) {
            (outer, false) => outer,
            (outer, true) => Some(outer.unwrap_or(DAffine3::IDENTITY) * DAffine3::from_mat3(axes(common.extrusion))),
        };
        (self.take)(Placed { shape, system, layer, place })
    }

    fn insert(&mut self, insert: &Insert<'a>, label: &str, place: Place, around: Around) -> Result<(), ReadError> {
        let common = &insert.common;
        if common.paper {
            return Ok(());
        }
        let layer = self.layer(common, around);
        let index = self.index;
        let Some((at, block)) =
            index.block(insert.block).and_then(|at| Some((at, index.blocks.get(at)?))).filter(|b| !b.1.external)
        else {
            let (count, _) = self.passed.missing.get_or_insert_with(|| (0, super::names::decode(insert.block)));
            *count += 1;
            return Ok(());
        };
        if self.stack.contains(&at) || self.stack.len() >= DEEPEST {
            let own = self.stack.contains(&at);
            let what =
                if own { "a block of the drawing contains itself" } else { "blocks of the drawing are too deep in each other" };
            let figures = match own {
                true => format!("block `{}`, through {}", block.name, super::names::counted(self.stack.len(), "block", "blocks")),
                false => format!("block `{}` is inside {DEEPEST} others", block.name),
            };
            return Err(refuse(what, place.of(label), figures, "explode the blocks the lines or the ground are in"));
        }
        let copies = insert.columns.saturating_mul(insert.rows);
        self.pairs = self.pairs.saturating_add(copies.saturating_mul(block.pairs.saturating_add(1)));
        if self.pairs > self.most {
            let figures = format!(
                "block `{}`, {} by {} times; more than {} pairs of code and value in all",
                block.name, insert.columns, insert.rows, self.most
            );
            let what = "the blocks of the drawing expand to too much";
            return Err(refuse(what, place.of(label), figures, "leave out the inserts that are not needed"));
        }
        let hidden = around.hidden || common.invisible || self.layers.frozen(layer);
        self.stack.push(at);
        for row in 0..insert.rows {
            for column in 0..insert.columns {
                let own = insert.insertion.place(block.base, column as f64, row as f64);
                let system = Some(around.system.map_or(own, |outer| outer * own));
                self.span(block.body, Around { system, layer: Some(layer), hidden })?;
            }
        }
        self.stack.pop();
        Ok(())
    }
}
