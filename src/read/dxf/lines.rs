//! Polylines and LINEs of a drawing → raw lines.

use super::bulge;
use super::chain::{self, Piece};
use super::entity::{Polyline, Vertex};
use super::layers::{LayerId, Layers};
use super::names::{counted, key, listed};
use super::pairs::Place;
use super::transform::stretch;
use super::walk::{Placed, Shape};
use crate::model::Note;
use crate::read::error::refuse;
use crate::read::{RawLine, RawShape, RawVertex, ReadError};
use glam::{DAffine3, DVec3};
use std::collections::BTreeMap;

/// Points on the arcs of one drawing, in all.
const MOST_ON_ARCS: u64 = 1_000_000;

/// Least distance of chords from their arcs, in the length unit of the drawing.
const LEAST_CHORD: f64 = 1e-6;

/// Collects lines.
pub(super) struct Lines<'l> {
    label: &'l str,
    chord: f64,
    drawn: Vec<Piece>,
    /// Single LINEs and ARCs.
    pieces: Vec<Piece>,
    order: usize,
    on_arcs: u64,
    uneven: usize,
    empty: usize,
    /// Polylines of which the file promises another number of vertices, with the first: promised, found, where.
    promised: Option<(usize, i64, usize, Place)>,
}

impl<'l> Lines<'l> {
    pub(super) fn new(label: &'l str, chord: f64) -> Self {
        Self {
            label,
            chord: chord.max(LEAST_CHORD),
            drawn: Vec::new(),
            pieces: Vec::new(),
            order: 0,
            on_arcs: 0,
            uneven: 0,
            empty: 0,
            promised: None,
        }
    }

    pub(super) fn take(&mut self, placed: Placed) -> Result<(), ReadError> {
        let Placed { shape, system, layer, place } = placed;
        self.order += 1;
        let order = self.order;
        match shape {
            Shape::Segment(ends) => {
                let vertices = ends.map(|end| vertex(system.map_or(end, |system| system.transform_point3(end)), place)).to_vec();
                self.pieces.push(Piece { vertices, layer, order });
                Ok(())
            }
            Shape::Arc(arc) => {
                let vertices = self.polyline(&arc, system)?;
                self.pieces.push(Piece { vertices, layer, order });
                Ok(())
            }
            Shape::Polyline(line) => {
                if let Some(promised) = line.promised {
                    self.promised.get_or_insert((0, promised, line.vertices.len(), place)).0 += 1;
                }
                self.uneven += usize::from(line.uneven);
                if line.vertices.is_empty() {
                    self.empty += 1;
                    return Ok(());
                }
                let mut vertices = self.polyline(&line, system)?;
                // At 0 by its kind is where a polyline lies that nobody gave an elevation.
                if line.planar && !line.uneven && vertices.iter().all(|v| v.z == Some(0.0)) {
                    vertices.iter_mut().for_each(|v| v.z = None);
                }
                self.drawn.push(Piece { vertices, layer, order });
                Ok(())
            }
            Shape::Face(_) | Shape::Mesh(..) | Shape::Point(_) => Ok(()),
        }
    }

    /// The vertices in the world, with those on arcs.
    fn polyline(&mut self, line: &Polyline, system: Option<DAffine3>) -> Result<Vec<RawVertex>, ReadError> {
        let chord = self.chord / system.as_ref().map_or(1.0, |system| stretch(system).max(f64::MIN_POSITIVE));
        let mut vertices = Vec::with_capacity(line.vertices.len() + 1);
        let mut push = |at: DVec3, place: Place| {
            vertices.push(vertex(system.map_or(at, |system| system.transform_point3(at)), place));
        };
        let mut arc = |a: &Vertex, b: &Vertex, push: &mut dyn FnMut(DVec3, Place)| {
            let (p, q) = (a.at.truncate(), b.at.truncate());
            let count = bulge::chords(p, q, a.bulge, chord);
            self.on_arcs += u64::from(count - 1);
            if self.on_arcs > MOST_ON_ARCS {
                let figures = format!("more than {MOST_ON_ARCS} points within {} of the arcs", self.chord);
                let help = "give a greater `--tolerance`, or make the arc shorter";
                return Err(refuse("an arc of the drawing needs too many points", a.place.of(self.label), figures, help));
            }
            for i in 1..count {
                let z = a.at.z + (b.at.z - a.at.z) * (f64::from(i) / f64::from(count));
                push(bulge::point(p, q, a.bulge, i, count).extend(z), a.place);
            }
            Ok(())
        };
        for (i, vertex) in line.vertices.iter().enumerate() {
            push(vertex.at, vertex.place);
            if let Some(next) = line.vertices.get(i + 1) {
                arc(vertex, next, &mut push)?;
            }
        }
        if let (true, [first, .., last]) = (line.closed, line.vertices.as_slice()) {
            arc(last, first, &mut push)?;
            push(first.at, first.place);
        }
        Ok(vertices)
    }

    /// The lines in the order of the drawing, named after their layers; only those of the `wanted` names, if there are any.
    pub(super) fn finish(
        mut self,
        layers: &Layers<'_>,
        wanted: &[String],
        notes: &mut Vec<Note>,
    ) -> Result<Vec<RawLine>, ReadError> {
        self.join(notes);
        self.tell(notes);
        self.drawn.sort_by_key(|drawn| drawn.order);
        let mut of_layer: BTreeMap<LayerId, (usize, usize)> = BTreeMap::new();
        for drawn in &self.drawn {
            of_layer.entry(drawn.layer).or_default().0 += 1;
        }
        if of_layer.len() > 1 && !layers.chosen() {
            let list = listed(of_layer.iter().map(|(&id, &(n, _))| format!("`{}`: {n}", layers.name(id))));
            let message = format!("lines of {} layers are taken ({list}); `--layer` picks some", of_layer.len());
            notes.push(Note::new("dxf-layers", message));
        }
        let mut lines = Vec::with_capacity(self.drawn.len());
        for drawn in self.drawn {
            let layer = layers.name(drawn.layer);
            let name = match of_layer.get_mut(&drawn.layer) {
                Some((count, number)) if *count > 1 => {
                    *number += 1;
                    format!("{layer} {number}")
                }
                _ => layer.to_owned(),
            };
            let feature = u32::try_from(lines.len() + 1).ok();
            lines.push(RawLine { name: Some(name), feature, shape: RawShape::Line, vertices: drawn.vertices });
        }
        pick(self.label, lines, wanted)
    }

    fn join(&mut self, notes: &mut Vec<Note>) {
        let given = self.pieces.len();
        let (chains, dropped) = chain::join(std::mem::take(&mut self.pieces));
        if chains.len() < given - dropped {
            let lines = counted(chains.len(), "line", "lines");
            notes.push(Note::new("dxf-lines-joined", format!("{given} single LINEs and ARCs were joined end to end to {lines}")));
        }
        if dropped > 0 {
            let message =
                format!("left out {} without length or drawn before", counted(dropped, "LINE or ARC", "LINEs and ARCs"));
            notes.push(Note::new("dxf-lines-dropped", message));
        }
        self.drawn.extend(chains);
    }

    fn tell(&self, notes: &mut Vec<Note>) {
        if self.uneven > 0 {
            let polylines = counted(self.uneven, "polyline is", "polylines are");
            let message =
                format!("{polylines} two-dimensional by the flags, but have heights at their vertices, which are taken");
            notes.push(Note::new("dxf-heights", message));
        }
        if self.empty > 0 {
            let message = format!("passed over {} without vertices", counted(self.empty, "polyline", "polylines"));
            notes.push(Note::new("dxf-empty", message));
        }
        if let Some((count, promised, found, place)) = self.promised {
            let message = format!(
                "{} another number of vertices than the file says; the first at {} has {found} instead of {promised}",
                counted(count, "polyline has", "polylines have"),
                place.of(self.label)
            );
            notes.push(Note::new("dxf-count", message));
        }
        let at_zero = |drawn: &&Piece| drawn.vertices.iter().all(|v| v.z == Some(0.0));
        let zero = self.drawn.iter().filter(at_zero).count();
        if zero > 0 {
            let message = format!("{zero} of {} lie at the elevation 0 all along", counted(self.drawn.len(), "line", "lines"));
            notes.push(Note::new("dxf-zero", message));
        }
    }
}

fn vertex(DVec3 { x, y, z }: DVec3, place: Place) -> RawVertex {
    RawVertex { x, y, z: Some(z), row: place.row() }
}

/// The lines of these names.
fn pick(label: &str, lines: Vec<RawLine>, wanted: &[String]) -> Result<Vec<RawLine>, ReadError> {
    if wanted.is_empty() {
        return Ok(lines);
    }
    let keys: Vec<String> = wanted.iter().map(|name| key(name)).collect();
    let key_of = |line: &RawLine| line.name.as_deref().map(key).unwrap_or_default();
    let there: std::collections::BTreeSet<String> = lines.iter().map(key_of).collect();
    if let Some(at) = keys.iter().position(|key| !there.contains(key)) {
        let figures = listed(lines.iter().filter_map(|line| line.name.as_ref()).map(|name| format!("`{name}`")));
        let what = format!("the drawing has no line `{}`", wanted[at]);
        return Err(refuse(&what, label, figures, "give the name of one of these lines, or pick a layer with `--layer`"));
    }
    let mut number = 0;
    Ok(lines
        .into_iter()
        .filter(|line| keys.contains(&key_of(line)))
        .map(|line| {
            number += 1;
            RawLine { feature: Some(number), ..line }
        })
        .collect())
}
