//! Cut and fill of a convex platform, or of a straight line, on a plane: closed forms, piece by piece.
//!
//! Let the ground be `T = c + G·x`, and `H = z − T` the height of the line above it. From a point with `H > 0` a ruling in plan
//! direction `d` falls by `k` per unit while the ground rises by `G·d`: it meets the ground at `r = H/q`, `q = k + G·d`, always
//! if `|G| < k`. In cut the same holds for `−H` and `q = k − G·d`. A segment of gradient `γ` has rulings that lean by
//! `sin φ = γ/k` from its normal, down-grade in fill and up-grade in cut. So
//!
//! * the strip of a segment from `H₀` to `H₁` of one sign is a quadrilateral in plan, with heights `H₀, H₁, 0, 0`: the difference
//!   of two planes, summed over two triangles. A segment that passes through the ground is split there;
//! * the sector about a corner has `∫∫ (H − q·r) r dr dθ = ∫ H³/(6q²) dθ` of volume and `∫ H²/(2q²) dθ` of area. `1/q²` is
//!   smooth;
//! * the platform is a polygon with linear heights, split where they change sign.
//!
//! Nothing overlaps as long as every corner opens: convex in plan, with gradients that do not turn the rulings back.

use crate::figures::Figures;
use std::f64::consts::TAU;

/// Ground as a plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tilt {
    /// Height at the origin.
    pub(crate) level: f64,
    pub(crate) gradient: [f64; 2],
}

impl Tilt {
    pub(crate) fn height(&self, x: f64, y: f64) -> f64 {
        self.level + self.gradient[0] * x + self.gradient[1] * y
    }
}

/// All works about a planar convex ring, counter-clockwise, given without repeating its first vertex.
pub(crate) fn pad(ring: &[[f64; 3]], ground: Tilt, cut: f64, fill: f64) -> Figures {
    platform(ring, ground) + slopes(ring, ground, cut, fill)
}

/// All works about a straight line without width: the ring that goes there and back.
pub(crate) fn line(from: [f64; 3], to: [f64; 3], ground: Tilt, cut: f64, fill: f64) -> Figures {
    slopes(&[from, to], ground, cut, fill)
}

/// Cut and fill between ring and ground.
pub(crate) fn platform(ring: &[[f64; 3]], ground: Tilt) -> Figures {
    let heights: Vec<[f64; 3]> = ring.iter().map(|&[x, y, z]| [x, y, z - ground.height(x, y)]).collect();
    let (fill_area, fill) = above(&heights);
    let (cut_area, cut) = above(&heights.iter().map(|&[x, y, h]| [x, y, -h]).collect::<Vec<_>>());
    Figures { cut, fill, cut_area, fill_area }
}

/// Area and volume of the part of a polygon with linear heights in which they are positive.
pub(crate) fn above(polygon: &[[f64; 3]]) -> (f64, f64) {
    let mut kept: Vec<[f64; 3]> = Vec::new();
    for (i, p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        if p[2] >= 0.0 {
            kept.push(*p);
        }
        if (p[2] > 0.0 && q[2] < 0.0) || (p[2] < 0.0 && q[2] > 0.0) {
            let w = p[2] / (p[2] - q[2]);
            kept.push([p[0] + w * (q[0] - p[0]), p[1] + w * (q[1] - p[1]), 0.0]);
        }
    }
    let mut sums = (0.0, 0.0);
    for i in 2..kept.len() {
        let area = 0.5 * crate::tin::twice_area(kept[0], kept[i - 1], kept[i]);
        sums.0 += area;
        sums.1 += area * (kept[0][2] + kept[i - 1][2] + kept[i][2]) / 3.0;
    }
    sums
}

/// Rulings of one sheet from one segment: sign of `H` it serves, slope, direction in plan.
#[derive(Clone, Copy)]
struct Strip {
    sign: f64,
    slope: f64,
    direction: [f64; 2],
}

impl Strip {
    /// The outside lies on the right.
    fn new(a: [f64; 3], b: [f64; 3], sign: f64, slope: f64) -> Self {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let lean = -sign * (b[2] - a[2]) / length / slope;
        let aside = ((1.0 + lean) * (1.0 - lean)).sqrt();
        Self { sign, slope, direction: [aside * along[1] + lean * along[0], -aside * along[0] + lean * along[1]] }
    }

    /// Height lost over the ground per unit of a ruling in a direction.
    fn loss(sign: f64, slope: f64, ground: Tilt, direction: [f64; 2]) -> f64 {
        slope + sign * (ground.gradient[0] * direction[0] + ground.gradient[1] * direction[1])
    }

    /// Area and volume between two points of the segment.
    fn between(&self, a: [f64; 3], b: [f64; 3], ground: Tilt) -> (f64, f64) {
        let above = |p: [f64; 3]| (self.sign * (p[2] - ground.height(p[0], p[1]))).max(0.0);
        let (ha, hb) = (above(a), above(b));
        let loss = Self::loss(self.sign, self.slope, ground, self.direction);
        let foot = |p: [f64; 3], h: f64| [p[0] + h / loss * self.direction[0], p[1] + h / loss * self.direction[1], 0.0];
        let (fa, fb) = (foot(a, ha), foot(b, hb));
        let area = |p, q, r| 0.5 * crate::tin::twice_area(p, q, r).abs();
        let (one, two) = (area(a, b, fb), area(a, fb, fa));
        (one + two, one * (ha + hb) / 3.0 + two * ha / 3.0)
    }

    /// Area and volume of the sector about `p` from these rulings on to those of the next strip, counter-clockwise.
    fn sector(&self, next: &Self, p: [f64; 3], ground: Tilt) -> (f64, f64) {
        let h = self.sign * (p[2] - ground.height(p[0], p[1]));
        if h <= 0.0 {
            return (0.0, 0.0);
        }
        let angle = |d: [f64; 2]| d[1].atan2(d[0]);
        let from = angle(self.direction);
        let opening = (angle(next.direction) - from).rem_euclid(TAU);
        let opening = if opening > TAU - 1e-9 { 0.0 } else { opening };
        assert!(opening < 0.9 * TAU, "the corner at {p:?} does not open");
        // Simpson's rule; 1/q² is analytic, and 4000 steps leave nothing but rounding.
        let steps = 4000;
        let mean = (0..=steps)
            .map(|i| {
                let theta = from + opening * f64::from(i) / f64::from(steps);
                let loss = Self::loss(self.sign, self.slope, ground, [theta.cos(), theta.sin()]);
                let weight = if i == 0 || i == steps { 1.0 } else { [2.0, 4.0][i as usize % 2] };
                weight / (3.0 * f64::from(steps)) / (loss * loss)
            })
            .sum::<f64>();
        (opening * mean * h * h / 2.0, opening * mean * h * h * h / 6.0)
    }
}

fn slopes(ring: &[[f64; 3]], ground: Tilt, cut: f64, fill: f64) -> Figures {
    let n = ring.len();
    let mut sums = Figures::default();
    for i in 0..n {
        let (a, b, c) = (ring[i], ring[(i + 1) % n], ring[(i + 2) % n]);
        let [ha, hb] = [a, b].map(|p| p[2] - ground.height(p[0], p[1]));
        let w = ha / (ha - hb);
        let middle = if ha * hb < 0.0 { std::array::from_fn(|c| a[c] + w * (b[c] - a[c])) } else { b };
        for (sign, slope) in [(1.0, fill), (-1.0, cut)] {
            let strip = Strip::new(a, b, sign, slope);
            let parts = [
                strip.between(a, middle, ground),
                strip.between(middle, b, ground),
                strip.sector(&Strip::new(b, c, sign, slope), b, ground),
            ];
            for (area, volume) in parts {
                if sign > 0.0 {
                    sums.fill_area += area;
                    sums.fill += volume;
                } else {
                    sums.cut_area += area;
                    sums.cut += volume;
                }
            }
        }
    }
    sums
}

/// On level ground, by Steiner's formula: `A·h + P·n·h²/2 + π·n²·h³/3`, where the area at depth `t` is `A + P·n·t + π·n²·t²`.
#[test]
fn level_ground() {
    let (l, w, h, k) = (30.0, 20.0, 4.0, 0.5);
    let (n, a, p, pi) = (1.0 / k, l * w, 2.0 * (l + w), std::f64::consts::PI);
    let ring = [[0.0, 0.0, h], [l, 0.0, h], [l, w, h], [0.0, w, h]];
    let found = pad(&ring, Tilt { level: 0.0, gradient: [0.0; 2] }, 1.0, k);
    let fill = a * h + p * n * h * h / 2.0 + pi * n * n * h * h * h / 3.0;
    let fill_area = a + p * n * h + pi * n * n * h * h;
    found.near(&Figures { cut: 0.0, fill, cut_area: 0.0, fill_area }, 1e-13, "pad on level ground");
}

/// A line without width along a cross-fall `c`, `h` above the ground: in section a triangle with its apex `h` above a sloping
/// base, `k·h²/(k² − c²)`. The two ends together make one cone of apex height `h` over an ellipse in plan with eccentricity `e =
/// c/k` and parameter `p = h/k` (a conic with its focus at the end of the line): area `π·p²/(1 − e²)^(3/2)`, volume a third of
/// that times `h`, whatever plane cuts the cone.
#[test]
fn cross_fall() {
    let (l, h, k, c) = (40.0, 3.0, 0.5, 0.2_f64);
    let found = line([0.0, 0.0, 7.0], [l, 0.0, 7.0], Tilt { level: 4.0, gradient: [0.0, c] }, 1.0, k);
    let section = k * h * h / (k * k - c * c);
    let conic = std::f64::consts::PI * (h / k).powi(2) / (1.0 - (c / k).powi(2)).powf(1.5);
    let fill_area = l * h * (1.0 / (k + c) + 1.0 / (k - c)) + conic;
    let expected = Figures { cut: 0.0, fill: l * section + conic * h / 3.0, cut_area: 0.0, fill_area };
    found.near(&expected, 1e-13, "line along a cross-fall");
}
