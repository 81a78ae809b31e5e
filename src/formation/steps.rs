//! Steps in height along an edge, levelled.
//!
//! On the inside of a bend the edge is shorter than the centre line. Where the bend is tighter than half the width its two legs meet at
//! different heights (folds). And where the digits of a dense line make kinks of their own, pieces of the edge shrink to a hair, or
//! grow, by chance: with the heights of the centre line they would be as steep as walls (kinks).

use super::edge::EdgePoint;
use crate::kernel::sum::Sum;

/// A piece of an edge is a step if a kink has made it shorter than this part of its way on the centre line, ...
const SHRUNK: f64 = 0.5;

/// ... it has this many times the gradient of its surroundings, ...
const KINK: f64 = 3.0;

/// ... and more than this gradient.
const STEEP: f64 = 0.15;

/// Gradient that a levelled step adds to its surroundings, unless it is so high that this would take more than one width.
const GENTLE: f64 = 0.003;

/// Changes of height below this (length units) are rounding.
const ROUNDING: f64 = 1e-12;

/// What was levelled beside folds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Levelled {
    /// Number of steps.
    pub(super) steps: usize,
    /// The greatest change of a height.
    pub(super) most: f64,
}

impl Levelled {
    /// Of two edges.
    pub(super) fn join(self, other: Self) -> Self {
        Self { steps: self.steps + other.steps, most: self.most.max(other.most) }
    }
}

/// A sudden rise along an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    /// Distance along the edge.
    at: f64,
    /// The last point before it.
    before: usize,
    /// The first point behind it; at folds the same, which has half of the rise.
    behind: usize,
    rise: f64,
}

/// Levels the steps at folds, over no more than `over` on both sides.
pub(super) fn level_folds(points: &mut [EdgePoint], over: f64) {
    let along = lengths(points);
    let folds = points.iter().enumerate().filter_map(|(i, p)| {
        let [before, behind] = p.fold?;
        Some(Step { at: along[i], before: i, behind: i, rise: before - behind })
    });
    let folds: Vec<Step> = folds.collect();
    level(points, &along, &folds, over);
}

/// Gives pieces of edge that are steeper than what lies a quarter of the width before and behind them on the centre line the gradient of
/// these, and levels the rest of their step over one width of edge at most on both sides, half on each. Bends as they are meant are as steep all
/// along, and stay.
pub(super) fn level_kinks(points: &mut [EdgePoint], half: f64) -> Levelled {
    let along = lengths(points);
    let steps = kinks(points, &along, 0.5 * half);
    Levelled { steps: steps.len(), most: level(points, &along, &steps, 2.0 * half) }
}

/// Spreads the rise of steps evenly over the edge before and behind them, as far as [`GENTLE`] takes, `most_over` at most; what would lie beyond
/// an end of the edge comes back from there as from a mirror. So the ends keep their heights, many steps in a row are levelled to one
/// slope, and small ones do not reach as far as the profile of the line bends. Returns the greatest change of a height.
fn level(points: &mut [EdgePoint], along: &[f64], steps: &[Step], most_over: f64) -> f64 {
    let end = along.last().copied().unwrap_or(0.0);
    if steps.is_empty() || end <= 0.0 {
        return 0.0;
    }
    // Where a rate of rise begins or ends.
    let mut rates: Vec<(f64, f64)> = Vec::with_capacity(4 * steps.len());
    for step in steps {
        let over = (0.5 * step.rise.abs() / GENTLE).min(most_over).min(end);
        if over <= 0.0 {
            // Legs of the same height.
            continue;
        }
        let rate = 0.5 * step.rise / over;
        let (from, to) = (step.at - over, step.at + over);
        rates.extend([(from.max(0.0), rate), (to.min(end), -rate)]);
        if from < 0.0 {
            rates.extend([(0.0, rate), (-from, -rate)]);
        }
        if to > end {
            rates.extend([(2.0 * end - to, rate), (end, -rate)]);
        }
    }
    rates.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut rates = rates.into_iter().peekable();
    let mut steps = steps.iter().peekable();
    // The rate at a place, what has risen there, and what was there of the steps.
    let (mut rate, mut place, mut risen, mut stepped) = (Sum::default(), 0.0, Sum::default(), Sum::default());
    let mut most = 0.0;
    for (i, point) in points.iter_mut().enumerate() {
        while let Some((at, change)) = rates.next_if(|(at, _)| *at <= along[i]) {
            risen.add(rate.value() * (at - place));
            place = at;
            rate.add(change);
        }
        risen.add(rate.value() * (along[i] - place));
        place = along[i];
        while let Some(step) = steps.next_if(|step| step.behind < i || step.before < i) {
            stepped.add(step.rise);
        }
        let half_way = steps.peek().filter(|step| step.before == i && step.behind == i).map_or(0.0, |step| 0.5 * step.rise);
        let change = risen.value() - stepped.value() - half_way;
        // Rounding of sums over thousands of steps is no change.
        if change.abs() > ROUNDING {
            point.z += change;
            most = f64::max(most, change.abs());
        }
    }
    most
}

/// Distances of the points from the first, along the edge.
fn lengths(points: &[EdgePoint]) -> Vec<f64> {
    let mut length = 0.0;
    let pieces = points.windows(2).map(|w| w[0].plan.distance(w[1].plan));
    std::iter::once(0.0)
        .chain(pieces.map(|piece| {
            length += piece;
            length
        }))
        .collect()
}

/// Pieces that are steps, with what they rise more than their surroundings would.
fn kinks(points: &[EdgePoint], along: &[f64], around: f64) -> Vec<Step> {
    let mut steps = Vec::new();
    let (mut from, mut to) = (0, 0);
    for i in 0..points.len().saturating_sub(1) {
        let middle = 0.5 * (points[i].station + points[i + 1].station);
        while from < i && points[from + 1].station <= middle - around {
            from += 1;
        }
        to = to.max(i + 1);
        while to + 1 < points.len() && points[to].station < middle + around {
            to += 1;
        }
        let (length, rise) = (along[i + 1] - along[i], points[i + 1].z - points[i].z);
        if rise.abs() <= STEEP * length || length >= SHRUNK * (points[i + 1].station - points[i].station).abs() {
            continue;
        }
        let mean = (points[to].z - points[from].z) / (along[to] - along[from]);
        if rise.abs() > KINK * mean.abs() * length {
            let at = 0.5 * (along[i] + along[i + 1]);
            steps.push(Step { at, before: i, behind: i + 1, rise: rise - mean * length });
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn edge(points: &[(f64, f64, f64)]) -> Vec<EdgePoint> {
        let point =
            |&(x, z, station): &(f64, f64, f64)| EdgePoint { plan: DVec2::new(x, 0.0), z, station, vertex: 0, fold: None };
        points.iter().map(point).collect()
    }

    /// A rise of 4 % with pieces of 1, of which one has shrunk to 0.05: it gets the gradient of those around it (5 pieces of line on 4.05
    /// of edge), and half of what is left goes to either side, less and less, at a gradient of 0.3 %.
    #[test]
    fn a_kink_is_levelled() {
        let shrunk = |i: i32| (f64::from(i) - if i > 20 { 0.95 } else { 0.0 }, 0.04 * f64::from(i), f64::from(i));
        let mut points = edge(&(0..=40).map(shrunk).collect::<Vec<_>>());
        let given: Vec<f64> = points.iter().map(|p| p.z).collect();
        let Levelled { steps, most } = level_kinks(&mut points, 4.0);
        let mean = 0.04 * 5.0 / 4.05;
        let step = 0.04 - mean * 0.05;
        assert_eq!(steps, 1);
        let over = 0.5 * step / GENTLE;
        let moved = |x: f64| {
            let rest = 0.5 * step * (1.0 - (x - 20.025).abs() / over).max(0.0);
            if x < 20.025 { rest } else { -rest }
        };
        assert!((most - moved(20.0)).abs() < 1e-12);
        for (p, z) in points.iter().zip(&given) {
            assert!((p.z - z - moved(p.plan.x)).abs() < 1e-12, "{}: {} for {}", p.plan.x, p.z - z, moved(p.plan.x));
        }
        // To the bit, where nothing was levelled.
        assert_eq!((points[0].z, points[40].z), (given[0], given[40]));
    }

    /// Kinks everywhere, at random, on a straight slope: what comes of it is that slope again, nowhere further off than a few kinks, also at
    /// its ends, which stay.
    #[test]
    fn many_kinks_are_one_slope() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        let (mut x, count) = (0.0, 4000);
        let points: Vec<(f64, f64, f64)> = (0..count)
            .map(|i| {
                let point = (x, 0.01 * f64::from(i), 0.2 * f64::from(i));
                x += random().powi(4);
                point
            })
            .collect();
        let mut found = edge(&points);
        let (first, last) = (found[0].z, found[found.len() - 1].z);
        let Levelled { steps, .. } = level_kinks(&mut found, 3.0);
        assert!(steps > 1000, "{steps}");
        assert!((found[0].z - first).abs() < 1e-9 && (found[found.len() - 1].z - last).abs() < 1e-9);
        let slope = |p: &EdgePoint| last * p.plan.x / found[found.len() - 1].plan.x;
        let off = found.iter().map(|p| p.z - slope(p)).fold(0.0, |worst: f64, d| worst.max(d.abs()));
        let before =
            points.iter().map(|p| p.1 - last * p.0 / points[points.len() - 1].0).fold(0.0, |worst: f64, d| worst.max(d.abs()));
        assert!(off <= before, "{off}, {before} before");
        let mean: f64 = found.iter().zip(&points).map(|(p, q)| p.z - q.1).sum::<f64>() / f64::from(count);
        assert!(mean.abs() < 0.002, "{mean}");
    }

    /// The mirror at the ends: a step at `d` from the beginning, `d` less than what it is levelled over, rises twice as fast up to
    /// `over − d`.
    #[test]
    fn ends_keep_their_heights() {
        let mut points = edge(&(0..=30).map(|i| (f64::from(i), if i > 3 { 1.0 } else { 0.0 }, f64::from(i))).collect::<Vec<_>>());
        let along = lengths(&points);
        level(&mut points, &along, &[Step { at: 3.5, before: 3, behind: 4, rise: 1.0 }], 8.0);
        for (i, p) in points.iter().enumerate() {
            let x = i as f64;
            let risen = (x.min(11.5) + x.min(4.5)) / 16.0;
            assert!((p.z - risen).abs() < 1e-12, "{i}: {} for {risen}", p.z);
        }
    }

    /// A ramp of 40 % on a straight line is meant.
    #[test]
    fn steep_lines_stay() {
        let points = [(0.0, 0.0, 0.0), (10.0, 0.0, 10.0), (10.5, 0.2, 10.5), (20.0, 0.2, 20.0)];
        let mut found = edge(&points);
        assert_eq!(level_kinks(&mut found, 4.0), Levelled::default());
        assert_eq!(found, edge(&points));
    }

    /// An arc of which the edge has a tenth of the length is a bend, not a kink: all of its pieces are alike.
    #[test]
    fn bends_stay() {
        let pieces = [(0..20, 0.5), (20..60, 0.05), (60..80, 0.5)];
        let mut x = 0.0;
        let mut points = vec![(0.0, 0.0, 0.0)];
        for (range, piece) in pieces {
            for i in range {
                x += piece;
                points.push((x, 0.02 * f64::from(i + 1) * 0.5, 0.5 * f64::from(i + 1)));
            }
        }
        let mut found = edge(&points);
        // But for where it begins and ends: there a piece has more than three times the gradient of what lies 2 before and behind, as long as
        // more than two of the nine pieces in that are straight ones.
        assert_eq!(level_kinks(&mut found, 4.0).steps, 4);
        let flat = |i: usize| (found[i + 1].z - found[i].z) / 0.05;
        for i in 24..56 {
            assert!((flat(i) - 0.2).abs() < 0.02, "{i}: {}", flat(i));
        }
    }
}
