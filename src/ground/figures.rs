//! From the works to what is written: meshes, line work, figures and the certificate.

use super::cell::Label;
use super::certificate::certificate;
use super::finished::Left;
use super::found::Found;
use super::nodes::WELD;
use super::open_ends;
use super::patch::NONE;
use super::patchwork::Patchwork;
use super::stations::Stations;
use super::{Axis, GroundError, Pieces, SectionFigures, Tallied};
use crate::kernel::sum::Sum;
use crate::mesh::check::{self, HalfEdges};
use crate::mesh::{polygon, volume};
use crate::model::{CurveKind, LineFeature, Note, Part, Sheet, Terrain, Tin};
use crate::surface::curves::{self, chained};
use crate::surface::error_bound::{Moves, layers};
use crate::surface::{Areas, Certificate, Mark, flaw};
use glam::DVec3;
use rustc_hash::FxHashSet;

/// Share of the area of a ground that rounding of sums may add or take.
const AREA_ROUNDING: f64 = 1e-12;

/// Where the works meet the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Daylight {
    /// Closed loops.
    pub loops: usize,
    /// Length in plan.
    pub length: f64,
    /// Its part along fill slopes.
    pub fill_length: f64,
    /// Its part along cut slopes.
    pub cut_length: f64,
    /// Length in plan of ends further off the ground than the tolerance.
    pub open_length: f64,
}

/// A design on its ground.
#[derive(Clone, Debug)]
pub struct Ground {
    /// Platform and slopes, cut off at the ground.
    pub design: Tin,
    /// The whole ground with the works in it.
    pub finished: Option<Tin>,
    /// Level curves, creases, hinge, daylight, zero line, open ends.
    pub lines: Vec<LineFeature>,
    /// Elevations of the level curves, from the top down.
    pub levels: Vec<f64>,
    /// The daylight line.
    pub daylight: Daylight,
    /// Whether all slopes meet the ground, within the tolerance, and all of line and platform has ground below it.
    pub complete: bool,
    /// Cut and fill.
    pub tallied: Tallied,
    /// Cross-sections at the stations.
    pub sections: Option<SectionFigures>,
    /// What stations are counted along, with the ends of the intervals.
    pub stations: Stations,
    /// The pieces of the works, where they were to be kept.
    pub pieces: Option<Pieces>,
    /// The ground as given, where it was to be kept.
    pub terrain: Option<Terrain>,
    /// Areas of the design.
    pub areas: Areas,
    /// What was measured on the design written.
    pub certificate: Certificate,
    /// Bound for the error of cut or fill through simplification and chords.
    pub error_bound: f64,
    /// Given vertices moved onto a chord.
    pub simplified: usize,
    /// Largest displacement of one.
    pub simplified_max: f64,
    /// Triangles of the ground looked at.
    pub ground_used: usize,
    /// Things worth knowing about the ground near the works.
    pub notes: Vec<Note>,
}

/// Puts the results together and checks the meshes; the finished ground is left as what the works change.
///
/// # Errors
/// [`GroundError::Unsound`].
pub(crate) fn ground(found: &Found) -> Result<(Ground, Option<Patchwork>), GroundError> {
    let mut number = Numbering::default();
    let triangles: Vec<[u32; 3]> = found.trimmed.triangles.iter().map(|t| number.triangle(*t)).collect();
    let parts: Vec<Part> = found.trimmed.from.iter().map(|&a| found.shape.parts[a as usize]).collect();
    let vertices = number.ids.iter().map(|&id| found.nodes.places[id as usize]).collect();
    let design = Tin { frame: found.shape.frame, vertices, triangles, parts };
    let edges = HalfEdges::new(design.vertices.len(), &design.triangles);
    let soundness = check::check(&design.vertices, &design.triangles, &edges);
    let certificate = certificate(found, &design, &soundness)?;
    let lines = lines(found, &number, &design, &edges);
    let finished = found.left.map(|left| finished(found, left)).transpose()?;
    let areas = Areas::of(&design);
    let error_bound = error_bound(found, &number, &design, &edges);
    let ground = Ground {
        finished: None,
        levels: levels(found, &lines),
        lines,
        daylight: daylight(found),
        complete: found.covered && open_ends::met(found.works, found.designs),
        tallied: found.fed.tallied.clone(),
        sections: found.fed.sections.clone(),
        stations: found.stations.clone(),
        pieces: found.fed.pieces.clone(),
        terrain: None,
        areas,
        certificate,
        error_bound,
        simplified: found.surfaces.iter().map(|s| s.simplified).max().unwrap_or(0),
        simplified_max: found.surfaces.iter().map(|s| s.simplified_max).fold(0.0, f64::max),
        ground_used: found.patch.triangles.len(),
        notes: found.notes.to_vec(),
        design,
    };
    Ok((ground, finished))
}

/// The levels with a curve within the works, from the top down.
fn levels(found: &Found, lines: &[LineFeature]) -> Vec<f64> {
    let cut: Vec<f64> = lines.iter().filter_map(|line| line.elevation).collect();
    found.shape.levels.iter().copied().filter(|level| cut.contains(level)).collect()
}

/// Mesh numbers in the order of first use.
#[derive(Default)]
struct Numbering {
    ids: Vec<u32>,
    of: Vec<u32>,
}

impl Numbering {
    fn triangle(&mut self, t: [u32; 3]) -> [u32; 3] {
        t.map(|id| self.number(id))
    }

    fn number(&mut self, id: u32) -> u32 {
        if self.of.len() <= id as usize {
            self.of.resize(id as usize + 1, NONE);
        }
        let number = &mut self.of[id as usize];
        if *number == NONE {
            *number = self.ids.len() as u32;
            self.ids.push(id);
        }
        *number
    }

    fn get(&self, id: u32) -> Option<u32> {
        self.of.get(id as usize).copied().filter(|&n| n != NONE)
    }
}

/// Bound for the error of cut and of fill: a layer on all of the works, one more on cones, and a strip along the borders where the
/// works do not meet the ground (open ends, walls of one-sided works), as high as the works are deep anywhere. At the daylight line
/// they have no height.
fn error_bound(found: &Found, number: &Numbering, design: &Tin, edges: &HalfEdges) -> f64 {
    let moves: Vec<Moves> =
        found.surfaces.iter().zip(found.designs).map(|(s, d)| Moves::new(found.line, d, s.simplified_max)).collect();
    let most = |of: fn(&Moves) -> f64| moves.iter().map(of).fold(0.0, f64::max);
    let (line, cone) = (most(|m| m.line), most(|m| m.cone));
    let on_cone = |t: usize| {
        let foot = found.shape.foot_of[found.trimmed.from[t] as usize];
        foot != NONE && found.shape.feet[foot as usize].on_cone
    };
    let undirected = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let met = found.daylight().into_iter().filter_map(|([a, b], _)| Some(undirected([number.get(a)?, number.get(b)?])));
    let met: FxHashSet<[u32; 2]> = met.collect();
    let open: Vec<[u32; 2]> = edges.open().into_iter().filter(|edge| !met.contains(&undirected(*edge))).collect();
    let owners = check::owners(&open, design.vertices.len(), &design.triangles);
    let strips = open.iter().zip(owners).map(|(edge, owner)| {
        let sheet = if design.parts[owner as usize] == Part::CutSlope { Sheet::Rising } else { Sheet::Falling };
        let of_sheet =
            moves.iter().zip(found.designs).filter(|(_, d)| design.parts[owner as usize] == Part::Platform || d.sheet == sheet);
        let ends = edge.map(|v| design.vertices[v as usize]);
        of_sheet.map(|(m, _)| m.strip(ends, m.one_sided || on_cone(owner as usize))).fold(0.0, f64::max)
    });
    let tallied = &found.fed.tallied;
    let deepest = [&tallied.deepest_cut, &tallied.deepest_fill].into_iter().flatten().map(|d| d.depth).fold(0.0, f64::max);
    layers(design, on_cone, line, cone) + strips.collect::<Sum>().value() * (deepest + line + cone)
}

fn daylight(found: &Found) -> Daylight {
    let met = found.daylight();
    let length = |e: &[u32; 2]| {
        let [p, q] = e.map(|v| found.nodes.places[v as usize].truncate());
        p.distance(q)
    };
    let of = |part: Part| met.iter().filter(|(_, p)| *p == part).map(|(e, _)| length(e)).collect::<Sum>().value();
    let edges: Vec<[u32; 2]> = met.iter().map(|(e, _)| *e).collect();
    Daylight {
        loops: polygon::loops(&edges).0.len(),
        length: met.iter().map(|(e, _)| length(e)).collect::<Sum>().value(),
        fill_length: of(Part::FillSlope),
        cut_length: of(Part::CutSlope),
        open_length: open_ends::length(open_ends::beyond_tolerance(found.works, found.designs)),
    }
}

fn lines(found: &Found, number: &Numbering, design: &Tin, edges: &HalfEdges) -> Vec<LineFeature> {
    let mut marks: Vec<(Mark, [u32; 2])> = Vec::new();
    for &(mark, ends) in &found.shape.marks {
        let whole = [ends.map(|v| found.nodes.design(v))];
        let pieces = found.trimmed.pieces.get(&ends).map_or(&whole[..], |list| list);
        for piece in pieces {
            let [Some(a), Some(b)] = piece.map(|id| number.get(id)) else { continue };
            if edges.has(a, b) || edges.has(b, a) {
                marks.push((mark, [a.min(b), a.max(b)]));
            }
        }
    }
    marks.sort_unstable();
    marks.dedup();
    let met = found.daylight();
    let numbered = |e: &[u32; 2]| Some([number.get(e[0])?, number.get(e[1])?]);
    let on_ground: FxHashSet<[u32; 2]> = met.iter().filter_map(|(e, _)| numbered(e)).collect();
    let open: Vec<[u32; 2]> = edges.open().into_iter().filter(|e| !on_ground.contains(e)).collect();
    let mut features = curves::lines(found.line, &found.shape.levels, design, &marks, &open);
    for part in [Part::FillSlope, Part::CutSlope, Part::Platform] {
        let segments: Vec<[u32; 2]> = met.iter().filter(|(_, p)| *p == part).map(|(e, _)| *e).collect();
        push(&mut features, found, &segments, CurveKind::Daylight, Some(part));
    }
    let mut zero: Vec<[Label; 2]> = found.works.zero.keys().map(|&(p, q)| [p, q]).collect();
    zero.sort_unstable();
    let zero: Vec<[u32; 2]> = zero
        .into_iter()
        .filter_map(|[p, q]| Some([found.nodes.meeting(p)?, found.nodes.meeting(q)?]))
        .filter(|e| e[0] != e[1])
        .collect();
    push(&mut features, found, &zero, CurveKind::Zero, None);
    features
}

fn push(features: &mut Vec<LineFeature>, found: &Found, segments: &[[u32; 2]], kind: CurveKind, part: Option<Part>) {
    for path in chained(segments) {
        let points = path.into_iter().map(|v| found.shape.frame.to_world(found.nodes.places[v as usize])).collect();
        features.push(LineFeature { kind, points, elevation: None, chain: None, part });
    }
}

/// What the works change of the ground.
fn finished(found: &Found, left: &Left) -> Result<Patchwork, GroundError> {
    let (terrain, patch, nodes) = (found.terrain, found.patch, found.nodes);
    let mut kept = left.kept.iter().copied().peekable();
    let gone = (0..patch.triangle_of.len() as u32).filter(|&b| kept.next_if_eq(&b).is_none());
    let gone = gone.map(|b| patch.triangle_of[b as usize]).collect();
    let design = found.within.triangles.iter().zip(&found.within.from);
    let design = design.map(|(&t, &a)| (t, found.shape.parts[a as usize]));
    let mut new: Vec<([u32; 3], Part)> = left.pieces.iter().map(|&t| (t, Part::Ground)).chain(design).collect();
    check_finished(found, left, &new)?;
    let mut others = Numbering::default();
    for v in new.iter_mut().flat_map(|(t, _)| t) {
        *v = nodes.as_ground(*v, patch).unwrap_or_else(|| terrain.vertices.len() as u32 + others.number(*v));
    }
    let places = others.ids.iter().map(|&id| nodes.places[id as usize]).collect();
    Ok(Patchwork { gone, new, places })
}

/// The patch with the works in it must be sound, and end where the patch ended.
fn check_finished(found: &Found, left: &Left, new: &[([u32; 3], Part)]) -> Result<(), GroundError> {
    let (patch, nodes) = (found.patch, found.nodes);
    let mut number = Numbering::default();
    let kept = left.kept.iter().map(|&b| patch.triangles[b as usize].map(|v| nodes.ground(v)));
    let triangles: Vec<[u32; 3]> = kept.chain(new.iter().map(|(t, _)| *t)).map(|t| number.triangle(t)).collect();
    let vertices: Vec<DVec3> = number.ids.iter().map(|&id| nodes.places[id as usize]).collect();
    let edges = HalfEdges::new(vertices.len(), &triangles);
    let soundness = check::check(&vertices, &triangles, &edges);
    let tin = Tin { frame: found.shape.frame, vertices, triangles, parts: Vec::new() };
    let unsound = |what: String| Err(GroundError::Unsound { mesh: "finished ground", what });
    if let Some(what) = flaw(&soundness, &tin) {
        return unsound(what);
    }
    let mut rim: FxHashSet<[u32; 2]> = FxHashSet::default();
    for b in 0..patch.triangles.len() {
        for j in (0..3).filter(|&j| patch.neighbours[b][j] == NONE) {
            let ends = [patch.triangles[b][j], patch.triangles[b][(j + 1) % 3]].map(|v| nodes.ground(v));
            let labels = found.works.on_ground.get(&patch.edge(b as u32, j as u8)).map_or(&[][..], |list| list);
            let path = nodes.along(ends, labels.iter().filter_map(|&label| nodes.meeting(label)));
            rim.extend(path.windows(2).map(|w| [w[0], w[1]]));
        }
    }
    // Works that go on beyond the edge of the ground end above or below it.
    for border in &found.works.rims {
        if let (Some(from), Some(to)) = (nodes.meeting(border.from), nodes.meeting(border.to)) {
            rim.extend(nodes.pieces([from, to]));
        }
    }
    if let Some(e) = soundness.boundary.iter().find(|e| !rim.contains(&e.map(|v| number.ids[v as usize]))) {
        let at = tin.world(e[0] as usize);
        return unsound(format!("it has a crack near ({:.3}, {:.3})", at.x, at.y));
    }
    // Single as it is, it covers all that the ground covered if it has its area.
    let area = |corners: &mut dyn Iterator<Item = [DVec3; 3]>| corners.map(volume::plan_area).collect::<Sum>().value();
    let before = area(&mut patch.triangles.iter().map(|t| t.map(|v| patch.vertices[v as usize])));
    let after = area(&mut (0..tin.triangles.len()).map(|t| tin.corners(t)));
    // Places along its edge are rounded, by no more than what makes two points one.
    let length = rim.iter().map(|e| e.map(|v| nodes.places[v as usize].truncate())).map(|[p, q]| p.distance(q)).sum::<f64>();
    if (after - before).abs() > AREA_ROUNDING * before + WELD * length {
        return unsound(format!("it covers {after} square units, the ground there {before}"));
    }
    Ok(())
}

impl Ground {
    /// What stations are counted along.
    pub fn axes(&self) -> &[Axis] {
        self.stations.axes()
    }
}
