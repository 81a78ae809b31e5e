//! What is to be told of a road.

use super::edge::{Centre, EdgePoint};
use super::steps::Levelled;
use crate::model::{Chain, Note};
use glam::DVec2;

/// Steps in height at tight bends below this (length units) are not worth a note.
const LEAST_STEP: f64 = 0.001;

/// So many places where an edge turns back may be bends, ...
const MOST_BENDS: usize = 20;

/// ... and so many vertices for each of them.
const VERTICES_OF_A_BEND: usize = 50;

/// Places where an edge is cut off: station, step in height.
pub(super) fn folds(edges: &[&[EdgePoint]; 2]) -> Vec<(f64, f64)> {
    let points = edges.iter().flat_map(|points| points.iter());
    points.filter_map(|p| p.fold.map(|[before, behind]| (p.station, (before - behind).abs()))).collect()
}

/// Whether they are kinks of a dense line: so many, and where a third of the vertices turn the other way than the one before. Bends turn one
/// way from beginning to end.
pub(super) fn are_kinks(folds: &[(f64, f64)], centre: &Centre) -> bool {
    let vertices = centre.plan.len();
    if folds.len() <= MOST_BENDS || folds.len() * VERTICES_OF_A_BEND <= vertices {
        return false;
    }
    let turns: Vec<f64> = centre.plan.windows(3).map(|w| (w[1] - w[0]).perp_dot(w[2] - w[1])).collect();
    3 * turns.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count() > vertices
}

/// Bends tighter than half the width.
pub(super) fn of_folds(name: &str, folds: &[(f64, f64)], width: f64) -> Option<Note> {
    let (station, step) = folds.iter().fold((0.0, -1.0), |best, &f| if f.1 > best.1 { f } else { best });
    if folds.is_empty() {
        return None;
    }
    let mut message = format!("bends of `{name}` tighter than half the width, where the inner edge is cut off: {}", folds.len());
    if step > LEAST_STEP {
        message.push_str(&format!(
            "; its two ends differ in height by up to {step:.3} (station {station:.3}), levelled over up to {width} of edge on both sides"
        ));
    }
    Some(Note::new("bend-cut-off", message))
}

/// Steps that kinks make.
pub(super) fn of_kinks(name: &str, Levelled { steps, most }: Levelled, width: f64) -> Option<Note> {
    let message = format!(
        "pieces of the edges of `{name}` that kinks of the centre line make much steeper than the line: {steps}; levelled over up to {width} \
         of edge on both sides, which moves heights by up to {most:.4}"
    );
    (most > LEAST_STEP).then(|| Note::new("edge-levelled", message))
}

/// A line that is too dense for its digits: its edges are those of its kinks.
pub(super) fn of_density(name: &str, folds: &[(f64, f64)], centre: &Centre, ring: &Chain, half: f64) -> Option<Note> {
    let vertices = centre.plan.len();
    if !are_kinks(folds, centre) {
        return None;
    }
    // Vertices off by ε turn a line of spacing c by about 4ε/c, which takes 4ε·half/c from a piece of edge. For that to be a quarter of it at
    // most, c ≥ 4√(ε·half).
    let spacing = centre.stations[vertices - 1] / (vertices - 1) as f64;
    let turns: f64 = centre.plan.windows(3).map(|w| (w[1] - w[0]).angle_to(w[2] - w[1]).abs()).sum();
    let off = 0.25 * spacing * turns / (vertices - 2) as f64;
    let wanted = 4.0 * (off * half).sqrt();
    // What corners add on the outside, in mitres, they take from the inside: without its kinks the road covers its width times its length.
    let share = area(ring) / (2.0 * half * thinned_length(&centre.plan, wanted)) - 1.0;
    let message = format!(
        "`{name}` is too dense for its digits: its {vertices} vertices are {spacing:.3} apart and turn it to and fro so much that its edges \
         turn back at {} places; the road is some {:.2} % larger than without. Leave out vertices, until they are some {wanted:.2} apart, \
         or smooth the line",
        folds.len(),
        100.0 * share.max(0.0),
    );
    Some(Note::new("line-too-dense", message))
}

/// Plan area of a ring.
fn area(ring: &Chain) -> f64 {
    let origin = ring.vertices[0].truncate();
    let corners = ring.vertices.iter().map(|v| v.truncate() - origin);
    let doubled: f64 = corners.clone().zip(corners.cycle().skip(1)).map(|(a, b)| a.perp_dot(b)).sum();
    0.5 * doubled.abs()
}

/// Length of a line of which only vertices that far apart are kept, and its last one.
fn thinned_length(plan: &[DVec2], apart: f64) -> f64 {
    let mut length = 0.0;
    let mut kept = plan[0];
    for &p in plan {
        if p.distance(kept) >= apart {
            length += p.distance(kept);
            kept = p;
        }
    }
    length + plan[plan.len() - 1].distance(kept)
}
