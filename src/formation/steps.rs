//! Steps in height along an edge, levelled.
//!
//! On the inside of a bend the edge is shorter than the centre line. Where the bend is tighter than half the width its two legs meet at
//! different heights (folds). And where the digits of a dense line make kinks of their own, pieces of the edge shrink to a hair, or
//! grow, by chance: with the heights of the centre line they would be as steep as walls (kinks).

use super::edge::EdgePoint;

/// A piece of an edge is a step if it has this many times the gradient of its surroundings, ...
const KINK: f64 = 3.0;

/// ... and more than this gradient.
const STEEP: f64 = 0.15;

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

/// Levels the steps at folds over a length of edge on both sides.
pub(super) fn level_folds(points: &mut [EdgePoint], over: f64) {
    for at in 0..points.len() {
        let Some([before, behind]) = points[at].fold else { continue };
        ramp(points, at, (0..at).rev(), before, over);
        ramp(points, at, at + 1..points.len(), behind, over);
    }
}

fn ramp(points: &mut [EdgePoint], from: usize, indices: impl Iterator<Item = usize>, step: f64, over: f64) {
    let mut length = 0.0;
    let mut last = points[from].plan;
    for i in indices {
        length += points[i].plan.distance(last);
        last = points[i].plan;
        if length >= over {
            break;
        }
        points[i].z += step * (1.0 - length / over);
    }
}

/// Gives pieces of edge that are steeper than what lies a quarter of the width before and behind them on the centre line the gradient of
/// these, and levels the rest of their step over one width of edge on both sides, half on each. Bends as they are meant are as steep all
/// along, and stay.
pub(super) fn level_kinks(points: &mut [EdgePoint], half: f64) -> Levelled {
    let along = lengths(points);
    let steps = kinks(points, &along, 0.5 * half);
    if steps.is_empty() {
        return Levelled::default();
    }
    let over = 2.0 * half;
    let mut most = 0.0;
    // Sums over the steps that lie ahead (behind) and no further than `over`, of half their heights and of these times their places.
    let (mut ahead, mut behind) = (Window::default(), Window::default());
    let (mut next_ahead, mut last_ahead, mut next_behind, mut last_behind) = (0, 0, 0, 0);
    for (i, point) in points.iter_mut().enumerate() {
        let here = along[i];
        // Those from `last_ahead` on begin here or ahead; those up to `next_behind` end here or behind.
        while let Some(&(at, step)) = steps.get(next_ahead).filter(|(at, _)| along[*at] < here + over) {
            ahead.add(0.5 * step, along[at]);
            next_ahead += 1;
        }
        while let Some(&(at, step)) = steps.get(last_ahead).filter(|(at, _)| *at < i && last_ahead < next_ahead) {
            ahead.add(-0.5 * step, along[at]);
            last_ahead += 1;
        }
        while let Some(&(at, step)) = steps.get(next_behind).filter(|(at, _)| *at < i) {
            behind.add(0.5 * step, along[at + 1]);
            next_behind += 1;
        }
        while let Some(&(at, step)) =
            steps.get(last_behind).filter(|(at, _)| last_behind < next_behind && along[*at + 1] <= here - over)
        {
            behind.add(-0.5 * step, along[at + 1]);
            last_behind += 1;
        }
        // Nothing is left of sums over nothing, not even rounding.
        if last_ahead == next_ahead {
            ahead = Window::default();
        }
        if last_behind == next_behind {
            behind = Window::default();
        }
        // Σ h (1 − (place − here)/over) ahead, Σ h (1 − (here − place)/over) behind.
        let up = ahead.sum - (ahead.moment - here * ahead.sum) / over;
        let down = behind.sum - (here * behind.sum - behind.moment) / over;
        point.z += up - down;
        most = f64::max(most, (up - down).abs());
    }
    Levelled { steps: steps.len(), most }
}

/// Running sums of steps.
#[derive(Default)]
struct Window {
    sum: f64,
    moment: f64,
}

impl Window {
    fn add(&mut self, height: f64, place: f64) {
        self.sum += height;
        self.moment += height * place;
    }
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

/// Pieces that are steps, by their first points, and by how much they rise more than their surroundings.
fn kinks(points: &[EdgePoint], along: &[f64], around: f64) -> Vec<(usize, f64)> {
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
        if rise.abs() <= STEEP * length {
            continue;
        }
        let mean = (points[to].z - points[from].z) / (along[to] - along[from]);
        if rise.abs() > KINK * mean.abs() * length {
            steps.push((i, rise - mean * length));
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

    /// A rise of 4 % with pieces of 1, of which one has shrunk to 0.05: it gets the gradient of those around it (8 pieces of line on 7.05
    /// of edge), and half of what is left goes to either side, less and less over 8.
    #[test]
    fn a_kink_is_levelled_over_a_width() {
        let mut points = edge(
            &(0..=40)
                .map(|i| (f64::from(i) - if i > 20 { 0.95 } else { 0.0 }, 0.04 * f64::from(i), f64::from(i)))
                .collect::<Vec<_>>(),
        );
        let given: Vec<f64> = points.iter().map(|p| p.z).collect();
        let Levelled { steps, most } = level_kinks(&mut points, 4.0);
        let mean = 0.04 * 5.0 / 4.05;
        let step = 0.04 - mean * 0.05;
        assert_eq!(steps, 1);
        assert!((most - 0.5 * step).abs() < 1e-12);
        for (i, (p, z)) in points.iter().zip(&given).enumerate() {
            let away = if i <= 20 { 20.0 - p.plan.x } else { p.plan.x - 20.05 };
            let moved = 0.5 * step * (1.0 - away / 8.0).max(0.0) * if i <= 20 { 1.0 } else { -1.0 };
            assert!((p.z - z - moved).abs() < 1e-12, "{i}: {} for {moved}", p.z - z);
        }
        // To the bit, where nothing was levelled.
        assert_eq!((points[0].z, points[40].z), (given[0], given[40]));
    }

    /// Sums as they run along are those over all pairs.
    #[test]
    fn many_kinks() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        let mut x = 0.0;
        let points: Vec<(f64, f64, f64)> = (0..500)
            .map(|i| {
                x += 0.2 * random().powi(4);
                (x, 0.01 * f64::from(i), 0.2 * f64::from(i))
            })
            .collect();
        let given = edge(&points);
        let mut found = given.clone();
        let (along, half) = (lengths(&given), 3.0);
        let steps = kinks(&given, &along, 0.5 * half);
        assert!(steps.len() > 100);
        level_kinks(&mut found, half);
        for (i, p) in found.iter().enumerate() {
            let moved = |&(at, step): &(usize, f64)| {
                let (away, sign) = if i <= at { (along[at] - along[i], 0.5) } else { (along[i] - along[at + 1], -0.5) };
                sign * step * (1.0 - away / (2.0 * half)).max(0.0)
            };
            let expected = given[i].z + steps.iter().map(moved).sum::<f64>();
            assert!((p.z - expected).abs() < 1e-12, "{i}: {} for {expected}", p.z);
        }
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
