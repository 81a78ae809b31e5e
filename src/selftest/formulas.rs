//! Closed forms: what figures must be. `n = 1/k` is the run per unit of rise.

use std::f64::consts::{FRAC_PI_2, PI};

/// Area of the points within `d` of a convex region of area `a` and perimeter `p` (Steiner): `a + p·d + π·d²`.
pub fn parallel_area(a: f64, p: f64, d: f64) -> f64 {
    a + p * d + PI * d * d
}

/// Volume under a slope that falls by `h` from a level convex region, `∫₀ʰ parallel_area(n·t) dt = a·h + p·n·h²/2 + π·n²·h³/3`.
pub fn parallel_volume(a: f64, p: f64, n: f64, h: f64) -> f64 {
    a * h + p * n * h * h / 2.0 + PI / 3.0 * n * n * h * h * h
}

/// Volume dug by slopes that fall by `d` inwards from a level rectangle, floor included:
/// `∫₀ᵈ (l − 2nt)(w − 2nt) dt = lwd − (l + w)nd² + 4n²d³/3`.
pub fn pit_volume(l: f64, w: f64, n: f64, d: f64) -> f64 {
    l * w * d - (l + w) * n * d * d + 4.0 / 3.0 * n * n * d * d * d
}

/// Volume between the slopes inside a level rectangle and its plane, where they meet over the middle line (hip roof, `l ≥ w`): `l
/// − w` of prism with section `w·height/2` and two half pyramids, `w·h/2·(l − w) + w²·h/3 = k·w²(3l − w)/12`.
pub fn roof_volume(l: f64, w: f64, k: f64) -> f64 {
    k * w * w * (3.0 * l - w) / 12.0
}

/// Length of the ridge and the four hips of that roof, each over half the width both ways.
pub fn roof_creases(l: f64, w: f64, k: f64) -> f64 {
    l - w + 4.0 * (w / 2.0 * (2.0 + k * k).sqrt())
}

/// Volume above level 0 of the slopes along a segment of plan length `l` from `z1` down to `z2`, both sides, `sin φ = γ/k`. The
/// region at least `c` high is the hull of two discs of radius `r = n(z − c)`: `A(c) = l·cos φ·(r1 + r2) + r1²(π/2 + φ) +
/// r2²(π/2 − φ)`; where `z2 < c < z1` the smaller disc is a point. `∫₀ A dc = n·l·cos φ·(z1² + z1·z2 + z2²)/3 +
/// n²/3·(z1³(π/2 + φ) + z2³(π/2 − φ))`.
pub fn segment_volume(l: f64, [z1, z2]: [f64; 2], k: f64) -> f64 {
    let (n, phi) = (1.0 / k, ((z1 - z2) / l / k).asin());
    let caps = z1.powi(3) * (FRAC_PI_2 + phi) + z2.powi(3) * (FRAC_PI_2 - phi);
    n * l * phi.cos() * (z1 * z1 + z1 * z2 + z2 * z2) / 3.0 + n * n / 3.0 * caps
}

/// Plan area of the same down to level 0: `A(0)`.
pub fn segment_area(l: f64, [z1, z2]: [f64; 2], k: f64) -> f64 {
    let (n, phi) = (1.0 / k, ((z1 - z2) / l / k).asin());
    n * (z1 + z2) * l * phi.cos() + n * n * (z1 * z1 * (FRAC_PI_2 + phi) + z2 * z2 * (FRAC_PI_2 - phi))
}

/// How steep a slope `k` shows in a section perpendicular to a line of gradient `g`: the plane has the gradient `g` along the
/// line, and `√(k² − g²)` across it.
pub fn section_slope(k: f64, g: f64) -> f64 {
    ((k - g) * (k + g)).sqrt()
}

/// Volume of a frustum of height `h` between similar parallel faces of areas `a` and `b`: `h/3·(a + b + √(a·b))`.
pub fn frustum_volume(h: f64, a: f64, b: f64) -> f64 {
    h / 3.0 * (a + b + (a * b).sqrt())
}
