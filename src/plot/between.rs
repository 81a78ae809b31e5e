//! What lies between two lines: cut where the design is below the ground, fill where it is above.

use crate::kernel::sum::Sum;
use glam::DVec2;

/// Areas between a design line and a ground line, and their outlines.
#[derive(Clone, Debug, Default)]
pub(super) struct Between {
    /// Outlines of cut.
    pub(super) cut: Vec<Vec<DVec2>>,
    /// Outlines of fill.
    pub(super) fill: Vec<Vec<DVec2>>,
    /// Area of cut.
    pub(super) cut_area: f64,
    /// Area of fill.
    pub(super) fill_area: f64,
}

/// Height of a line at `x`, if it is there; `x` ascends along it.
pub(super) fn height(line: &[DVec2], x: f64) -> Option<f64> {
    let next = line.partition_point(|p| p.x < x).clamp(1, line.len().max(1));
    let (a, b) = (line.get(next - 1)?, line.get(next)?);
    (a.x <= x && x <= b.x).then(|| if b.x > a.x { a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x) } else { a.y })
}

/// Where neighbouring values of `x` are taken as one: a vertical step has no area.
fn stations(design: &[DVec2], ground: &[DVec2], from: f64, to: f64) -> Vec<f64> {
    let mut all: Vec<f64> = design.iter().chain(ground).map(|p| p.x).filter(|x| (from..=to).contains(x)).collect();
    all.extend([from, to]);
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

impl Between {
    /// Adds what lies between two lines where both are, from `from` to `to`.
    pub(super) fn add(&mut self, design: &[DVec2], ground: &[DVec2], from: f64, to: f64) {
        let ends = |line: &[DVec2]| line.first().zip(line.last()).map(|(a, b)| (a.x, b.x));
        let Some((d, g)) = ends(design).zip(ends(ground)) else { return };
        let (from, to) = (from.max(d.0).max(g.0), to.min(d.1).min(g.1));
        if to <= from || to.is_nan() || from.is_nan() {
            return;
        }
        let (mut cut, mut fill) = (Sum::default(), Sum::default());
        let (mut upper, mut lower): (Vec<DVec2>, Vec<DVec2>) = (Vec::new(), Vec::new());
        let mut sign = 0.0_f64;
        let at = |x: f64| height(design, x).zip(height(ground, x));
        let mut before: Option<(f64, f64, f64)> = None;
        for x in stations(design, ground, from, to) {
            let Some((d, g)) = at(x) else { continue };
            if let Some((x0, d0, g0)) = before {
                let (a, b) = (d0 - g0, d - g);
                let mut step = |x0: f64, d0: f64, g0: f64, x1: f64, d1: f64, g1: f64| {
                    let double = (d0 - g0) + (d1 - g1);
                    let area = 0.5 * (x1 - x0) * double.abs();
                    let now = if double == 0.0 { 0.0 } else { double.signum() };
                    if now != sign {
                        self.close(&mut upper, &mut lower, sign);
                        sign = now;
                    }
                    if now == 0.0 {
                        return;
                    }
                    if now < 0.0 {
                        cut.add(area)
                    } else {
                        fill.add(area)
                    }
                    if upper.is_empty() {
                        upper.push(DVec2::new(x0, d0));
                        lower.push(DVec2::new(x0, g0));
                    }
                    upper.push(DVec2::new(x1, d1));
                    lower.push(DVec2::new(x1, g1));
                };
                if a * b < 0.0 {
                    let share = a / (a - b);
                    let (xm, m) = (x0 + (x - x0) * share, d0 + (d - d0) * share);
                    step(x0, d0, g0, xm, m, m);
                    step(xm, m, m, x, d, g);
                } else {
                    step(x0, d0, g0, x, d, g);
                }
            }
            before = Some((x, d, g));
        }
        self.close(&mut upper, &mut lower, sign);
        self.cut_area += cut.value();
        self.fill_area += fill.value();
    }

    /// Takes up the outline between two lines, and empties them.
    fn close(&mut self, upper: &mut Vec<DVec2>, lower: &mut Vec<DVec2>, sign: f64) {
        let mut outline = std::mem::take(upper);
        outline.extend(std::mem::take(lower).into_iter().rev());
        if outline.len() > 2 {
            if sign < 0.0 { self.cut.push(outline) } else { self.fill.push(outline) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().copied().map(DVec2::from).collect()
    }

    /// The ground is level at 0, the design goes from −3 at 0 to 4 at 7: cut 9/2, fill 16/2.
    #[test]
    fn areas_of_cut_and_fill() {
        let mut between = Between::default();
        between.add(&points(&[(0.0, -3.0), (7.0, 4.0)]), &points(&[(-5.0, 0.0), (2.0, 0.0), (9.0, 0.0)]), -100.0, 100.0);
        assert!((between.cut_area - 4.5).abs() < 1e-12 && (between.fill_area - 8.0).abs() < 1e-12);
        assert_eq!((between.cut.len(), between.fill.len()), (1, 1));
        let shoelace = |outline: &Vec<DVec2>| {
            (0..outline.len()).map(|i| 0.5 * outline[i].perp_dot(outline[(i + 1) % outline.len()])).sum::<f64>().abs()
        };
        assert!((shoelace(&between.cut[0]) - 4.5).abs() < 1e-12);
        assert!((shoelace(&between.fill[0]) - 8.0).abs() < 1e-12);
    }

    #[test]
    fn where_only_one_line_is_there_is_nothing() {
        let mut between = Between::default();
        between.add(&points(&[(0.0, 1.0), (1.0, 1.0)]), &points(&[(2.0, 0.0), (3.0, 0.0)]), -10.0, 10.0);
        between.add(&[], &points(&[(2.0, 0.0), (3.0, 0.0)]), -10.0, 10.0);
        between.add(&points(&[(0.0, 1.0), (1.0, 1.0)]), &points(&[(0.0, 1.0), (1.0, 1.0)]), -10.0, 10.0);
        assert!(between.cut.is_empty() && between.fill.is_empty() && between.cut_area + between.fill_area == 0.0);
        assert_eq!(height(&points(&[(0.0, 1.0), (2.0, 3.0)]), 1.0), Some(2.0));
        assert_eq!((height(&[], 1.0), height(&points(&[(0.0, 1.0)]), 0.0)), (None, None));
    }
}
