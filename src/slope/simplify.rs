//! Fewer vertices within a proven height error.
//!
//! Dense smooth lines are ill-conditioned: where neighbouring strips differ by `δ` radians, ridge positions carry an error of
//! about `ε·extent/δ²`. So the engine drops vertices that the sheet cannot tell apart within a bound.

use super::network::COLLINEAR;
use glam::DVec3;

/// A vertex that was dropped: it stays on the hinge, moved onto the chord that replaced its neighbourhood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dropped {
    /// Index in the run that was simplified.
    pub index: usize,
    /// Position along the chord, strictly between 0 and 1 and rising within a chord.
    pub along: f64,
    /// `|Δz| + k·distance in plan` between the vertex and its place on the chord.
    pub error: f64,
}

/// One chord of the simplified run.
#[derive(Clone, Debug, PartialEq)]
pub struct Chord {
    /// First vertex, index in the run.
    pub from: usize,
    /// Last vertex, index in the run.
    pub to: usize,
    /// What the chord replaces.
    pub dropped: Vec<Dropped>,
}

/// Douglas–Peucker in the metric of the sheet: a vertex may go when `|Δz| + k·|Δplan| ≤ bound` against its foot on the chord.
///
/// With that criterion every point of the run has a point of the chord within the bound and the other way round (the map
/// along a segment is linear and covers the chord), hence `|f − f'| ≤ bound` everywhere: a cone standing `Δz` lower and `Δplan`
/// aside covers at most `Δz + k·Δplan` less. A chord is refused when it would be as steep as the slope, or when feet on it
/// would not follow one another in order.
///
/// `kept` tells whether the first and the last edge of the run stay as they are; `steepest` is the bound for the gradient of chords, `spacing` the least distance between vertices along a chord, both in the
/// units of the run.
pub fn simplify(run: &[DVec3], kept: [bool; 2], slope: f64, bound: f64, steepest: f64, spacing: f64) -> Vec<Chord> {
    let mut chords = Vec::new();
    let last = run.len() - 1;
    let straight = |run: &[DVec3]| straight(run, slope, steepest, spacing);
    let first = if kept[0] { straight(run) } else { 0 };
    let behind = if kept[1] { last - straight(&run.iter().rev().copied().collect::<Vec<_>>()) } else { last };
    let behind = behind.max(first);
    let mut pending = vec![(behind, last), (first, behind), (0, first)];
    pending.retain(|(from, to)| from < to);
    while let Some((from, to)) = pending.pop() {
        match split_at(run, from, to, slope, bound, steepest, spacing) {
            Ok(dropped) => chords.push(Chord { from, to, dropped }),
            Err(at) => pending.extend([(at, to), (from, at)]),
        }
    }
    chords
}

/// The vertex up to which a run is straight from its beginning.
fn straight(run: &[DVec3], slope: f64, steepest: f64, spacing: f64) -> usize {
    let is_straight = |to: usize| to < run.len() && split_at(run, 0, to, slope, COLLINEAR, steepest, spacing).is_ok();
    let (mut to, mut step) = (1, 1);
    while is_straight(to + step) {
        to += step;
        step *= 2;
    }
    while step > 0 {
        if is_straight(to + step) {
            to += step;
        }
        step /= 2;
    }
    to
}

/// The vertices between `from` and `to` moved onto the chord, whatever their error.
pub fn foot_points(run: &[DVec3], from: usize, to: usize, slope: f64) -> Vec<Dropped> {
    let (a, b) = (run[from], run[to]);
    let chord = (b - a).truncate();
    (from + 1..to)
        .map(|index| {
            let along = (run[index] - a).truncate().dot(chord) / chord.length_squared();
            Dropped { index, along, error: error(run[index] - a.lerp(b, along), slope) }
        })
        .collect()
}

/// What a displacement may change of heights.
fn error(off: DVec3, slope: f64) -> f64 {
    off.z.abs() + slope * off.truncate().length()
}

/// The dropped vertices of chord `from`–`to`, or the vertex at which to split it.
fn split_at(
    run: &[DVec3],
    from: usize,
    to: usize,
    slope: f64,
    bound: f64,
    steepest: f64,
    spacing: f64,
) -> Result<Vec<Dropped>, usize> {
    if to - from == 1 {
        return Ok(Vec::new());
    }
    let (a, b) = (run[from], run[to]);
    let chord = (b - a).truncate();
    let length_squared = chord.length_squared();
    let mut worst = (bound, None);
    for (i, p) in run.iter().enumerate().take(to).skip(from + 1) {
        let along = if length_squared > 0.0 { ((p - a).truncate().dot(chord) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
        let off = *p - a.lerp(b, along);
        let error = error(off, slope);
        if error > worst.0 {
            worst = (error, Some(i));
        }
    }
    if let Some(at) = worst.1 {
        return Err(at);
    }
    let middle = usize::midpoint(from, to);
    let length = length_squared.sqrt();
    if length <= spacing || (b.z - a.z).abs() >= steepest * length {
        return Err(middle);
    }
    let mut dropped = Vec::with_capacity(to - from - 1);
    let mut last = 0.0;
    for (index, p) in run.iter().enumerate().take(to).skip(from + 1) {
        let along = (p - a).truncate().dot(chord) / length_squared;
        if (along - last) * length < spacing || (1.0 - along) * length < spacing {
            return Err(index);
        }
        let off = *p - a.lerp(b, along);
        dropped.push(Dropped { index, along, error: error(off, slope) });
        last = along;
    }
    Ok(dropped)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(points: &[(f64, f64, f64)]) -> Vec<DVec3> {
        points.iter().map(|&p| DVec3::from(p)).collect()
    }

    #[test]
    fn collinear_vertices_go_and_keep_their_place() {
        let run = run(&[(0.0, 0.0, 0.0), (1.0, 0.0, 0.1), (3.0, 0.0, 0.3), (4.0, 0.0, 0.4)]);
        let chords = simplify(&run, [false; 2], 0.5, 1e-9, 0.499, 1e-6);
        assert_eq!(chords.len(), 1);
        let along: Vec<f64> = chords[0].dropped.iter().map(|d| d.along).collect();
        assert_eq!(along, [0.25, 0.75]);
    }

    #[test]
    fn edges_at_the_ends_are_kept_where_they_must() {
        // No three on one line, all within the bound of the chord.
        let points: Vec<(f64, f64, f64)> = (0..6).map(|i| (f64::from(i), 0.01 * f64::from(i * i % 4), 0.0)).collect();
        for (count, kept, expected) in [
            (6, [false, false], vec![(0, 5)]),
            (6, [true, false], vec![(0, 1), (1, 5)]),
            (6, [false, true], vec![(0, 4), (4, 5)]),
            (6, [true, true], vec![(0, 1), (1, 4), (4, 5)]),
            (3, [true, true], vec![(0, 1), (1, 2)]),
            (2, [true, true], vec![(0, 1)]),
            (2, [true, false], vec![(0, 1)]),
        ] {
            let chords = simplify(&run(&points[..count]), kept, 0.5, 0.1, 0.499, 1e-6);
            assert_eq!(chords.iter().map(|c| (c.from, c.to)).collect::<Vec<_>>(), expected, "{count} {kept:?}");
        }
        // An edge with vertices on it stays one edge.
        let split =
            run(&[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (3.0, 0.01, 0.0), (4.0, 0.03, 0.0), (5.0, 0.05, 0.0)]);
        let chords = simplify(&split, [true, true], 0.5, 0.1, 0.499, 1e-6);
        assert_eq!(chords.iter().map(|c| (c.from, c.to)).collect::<Vec<_>>(), [(0, 2), (2, 3), (3, 5)]);
    }

    #[test]
    fn a_step_back_is_kept() {
        let run = run(&[(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (1.9, 0.0, 0.0), (4.0, 0.0, 0.0)]);
        let chords = simplify(&run, [false; 2], 0.5, 0.1, 0.499, 1e-6);
        assert!(chords.len() > 1, "the vertex that steps back must stay");
    }

    #[test]
    fn a_circle_keeps_the_bound() {
        let (radius, slope, bound) = (500.0, 0.5, 1e-3);
        let run: Vec<DVec3> =
            (0..=4000).map(|i| f64::from(i) / 4000.0).map(|t| DVec3::new(radius * t.cos(), radius * t.sin(), 3.0 * t)).collect();
        let chords = simplify(&run, [false; 2], slope, bound, 0.499, 1e-6);
        // Sagitta c²/8R ≤ bound/slope gives the longest chord; halving may leave chords up to twice as short.
        let longest = (8.0 * radius * bound / slope).sqrt();
        let least = (radius / longest).floor() as usize;
        assert!((least..=4 * least).contains(&chords.len()), "{} chords, at least {least}", chords.len());
        assert!(chords.iter().flat_map(|c| &c.dropped).all(|d| d.error <= bound));
    }
}
