//! Lines on paper: fewer points where nobody sees the difference, and never more than there is room for.

use crate::kernel::plan_box::PlanBox;
use crate::kernel::segment::distance;
use glam::DVec2;

/// A polyline or outline in px. An outline does not repeat its first point.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Stroke {
    pub(super) points: Vec<DVec2>,
    pub(super) closed: bool,
}

/// Lines may be off by this much, in px; half of it is what a line of 0.3 px on a common screen shows.
pub(super) const FINE: f64 = 0.12;

/// Steps by which the tolerance grows until lines fit.
const COARSER: f64 = 1.6;

/// Points of a line that are looked at together: the work on a scribble is bounded by so many times its points.
const STRETCH: usize = 4096;

/// For each stroke one within [`FINE`] of it, or as coarse as it takes to have `most` points in all. Strokes smaller than the
/// tolerance are left out, so that the bound holds whatever is drawn.
pub(super) fn simplified(strokes: &[Stroke], most: usize) -> Vec<Option<Stroke>> {
    let mut tolerance = FINE;
    loop {
        let kept: Vec<Option<Stroke>> = strokes.iter().map(|stroke| simpler(stroke, tolerance)).collect();
        if kept.iter().flatten().map(|stroke| stroke.points.len()).sum::<usize>() <= most || !tolerance.is_finite() {
            return kept;
        }
        tolerance *= COARSER;
    }
}

/// A stroke with fewer points; `None` if it is smaller than the tolerance.
fn simpler(stroke: &Stroke, tolerance: f64) -> Option<Stroke> {
    let points = &stroke.points;
    let size = PlanBox::of(points.iter().copied()).size().max_element();
    if size <= tolerance || size.is_nan() {
        return None;
    }
    if !stroke.closed {
        return Some(Stroke { points: thinned(points, tolerance), closed: false });
    }
    // An outline in two halves, between its first point and the one farthest from it.
    let far = (1..points.len()).max_by(|a, b| {
        let d = |i: &usize| points[*i].distance_squared(points[0]);
        d(a).total_cmp(&d(b)).then(b.cmp(a))
    })?;
    let back: Vec<DVec2> = points[far..].iter().chain(&points[..1]).copied().collect();
    let mut kept = thinned(&points[..=far], tolerance);
    kept.pop();
    kept.extend(thinned(&back, tolerance));
    kept.pop();
    (kept.len() > 2).then_some(Stroke { points: kept, closed: true })
}

/// Reference: D. Douglas, T. Peucker, "Algorithms for the reduction of the number of points required to represent a digitized
/// line or its caricature", Cartographica 10 (1973).
fn thinned(points: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let Some(last) = points.len().checked_sub(1).filter(|last| *last > 0) else { return points.to_vec() };
    let mut keep = vec![false; points.len()];
    keep[last] = true;
    let mut stack = Vec::new();
    for from in (0..last).step_by(STRETCH) {
        keep[from] = true;
        stack.push((from, (from + STRETCH).min(last)));
    }
    while let Some((from, to)) = stack.pop() {
        let (a, b) = (points[from], points[to]);
        let mut worst = (tolerance, None);
        for (i, p) in points.iter().enumerate().take(to).skip(from + 1) {
            let off = distance(*p, [a, b]);
            if off > worst.0 {
                worst = (off, Some(i));
            }
        }
        if let Some(i) = worst.1 {
            keep[i] = true;
            stack.push((from, i));
            stack.push((i, to));
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(p, _)| *p).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(n: usize) -> Stroke {
        let points = (0..n).map(|i| f64::from(i as u32) / 10.0).map(|x| DVec2::new(x, 20.0 * (x / 30.0).sin())).collect();
        Stroke { points, closed: false }
    }

    #[test]
    fn few_points_within_the_tolerance() {
        let given = wave(5000);
        let kept = simplified(std::slice::from_ref(&given), usize::MAX).remove(0).unwrap();
        assert!(kept.points.len() < 200, "{}", kept.points.len());
        for p in &given.points {
            let off = kept.points.windows(2).map(|ends| distance(*p, [ends[0], ends[1]])).fold(f64::INFINITY, f64::min);
            assert!(off <= FINE + 1e-12);
        }
    }

    #[test]
    fn the_bound_holds() {
        let random = |i: usize| DVec2::new((i * 7919 % 1000) as f64, (i * 104_729 % 997) as f64);
        let scribble = Stroke { points: (0..3000).map(random).collect(), closed: true };
        let dots: Vec<Stroke> = (0..2000)
            .map(|i| Stroke { points: vec![random(i), random(i) + DVec2::X, random(i) + DVec2::ONE], closed: true })
            .collect();
        for most in [0, 10, 500] {
            let kept = simplified(&[vec![scribble.clone()], dots.clone()].concat(), most);
            assert!(kept.iter().flatten().map(|s| s.points.len()).sum::<usize>() <= most);
        }
    }

    #[test]
    fn a_square_stays_a_square() {
        let corner = |x, y| DVec2::new(x, y);
        let points = vec![corner(5.0, 0.0), corner(10.0, 0.0), corner(10.0, 10.0), corner(0.0, 10.0), corner(0.0, 0.0)];
        let kept = simplified(&[Stroke { points, closed: true }], 100).remove(0).unwrap();
        let area: f64 =
            (0..kept.points.len()).map(|i| 0.5 * kept.points[i].perp_dot(kept.points[(i + 1) % kept.points.len()])).sum();
        assert!((area - 100.0).abs() < 1e-9);
    }
}
