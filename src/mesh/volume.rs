//! Areas, and volumes between a mesh and a horizontal plane.

use crate::kernel::sum::Sum;
use glam::DVec3;

/// Cut and fill between a surface and a plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlaneVolume {
    /// Volume where the surface lies below the plane.
    pub cut: f64,
    /// Volume where the surface lies above the plane.
    pub fill: f64,
    /// Greatest depth below the plane.
    pub cut_max: f64,
    /// Greatest height above the plane.
    pub fill_max: f64,
}

/// Integral of the positive part of a linear function over a triangle of plan area `area`, given its corner values.
///
/// One sign: `area × mean`. One corner positive (`a > 0 ≥ b, c`): a similar triangle with sides in the ratios `a/(a − b)` and
/// `a/(a − c)`, of mean height `a/3`. Two corners positive: the whole plus the opposite of the third corner's share, which
/// rounding can make a hair less than nothing.
pub fn positive_part(area: f64, h: [f64; 3]) -> f64 {
    let corner = |a: f64, b: f64, c: f64| area * a / 3.0 * (a / (a - b)) * (a / (a - c));
    let whole = area * (h[0] + h[1] + h[2]) / 3.0;
    match (h[0] > 0.0, h[1] > 0.0, h[2] > 0.0) {
        (true, true, true) => whole,
        (false, false, false) => 0.0,
        (true, false, false) => corner(h[0], h[1], h[2]),
        (false, true, false) => corner(h[1], h[2], h[0]),
        (false, false, true) => corner(h[2], h[0], h[1]),
        (false, true, true) => (whole + corner(-h[0], -h[1], -h[2])).max(0.0),
        (true, false, true) => (whole + corner(-h[1], -h[2], -h[0])).max(0.0),
        (true, true, false) => (whole + corner(-h[2], -h[0], -h[1])).max(0.0),
    }
}

/// Share of the area of a triangle over which a linear function with the given corner values is positive; 0 to 1. Similar
/// triangles as in [`positive_part`]. Corners at nought belong to the side of the others; a function that is nought all over is
/// positive nowhere.
pub fn positive_share(h: [f64; 3]) -> f64 {
    let corner = |a: f64, b: f64, c: f64| (a / (a - b)) * (a / (a - c));
    let rest = |share: f64| (1.0 - share).max(0.0);
    match (h[0] > 0.0, h[1] > 0.0, h[2] > 0.0) {
        (true, true, true) => 1.0,
        (false, false, false) => 0.0,
        (true, false, false) => corner(h[0], h[1], h[2]),
        (false, true, false) => corner(h[1], h[2], h[0]),
        (false, false, true) => corner(h[2], h[0], h[1]),
        (false, true, true) => rest(corner(h[0], h[1], h[2])),
        (true, false, true) => rest(corner(h[1], h[2], h[0])),
        (true, true, false) => rest(corner(h[2], h[0], h[1])),
    }
}

/// Areas of triangles in plan, and as they lie.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshAreas {
    plan: Sum,
    surface: Sum,
}

impl MeshAreas {
    /// Of some triangles, facing either way.
    pub fn of(triangles: impl IntoIterator<Item = [DVec3; 3]>) -> Self {
        let mut areas = Self::default();
        for [a, b, c] in triangles {
            let normal = (b - a).cross(c - a);
            areas.plan.add(0.5 * normal.z.abs());
            areas.surface.add(0.5 * normal.length());
        }
        areas
    }

    /// Adds those of other triangles.
    pub fn join(&mut self, other: Self) {
        self.plan.join(other.plan);
        self.surface.join(other.surface);
    }

    /// Area in plan.
    pub fn plan(&self) -> f64 {
        self.plan.value()
    }

    /// Area as they lie.
    pub fn surface(&self) -> f64 {
        self.surface.value()
    }
}

/// Plan area of a triangle, positive counter-clockwise.
#[inline]
pub fn plan_area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).truncate().perp_dot((c - a).truncate())
}

/// Exact volumes between triangles and the plane at `elevation`: prisms, split where their sign changes.
///
/// # Accuracy
/// Rounding of one prism relative to itself; the sum is compensated.
pub fn above_plane(triangles: impl Iterator<Item = [DVec3; 3]>, elevation: f64) -> PlaneVolume {
    let (mut cut, mut fill) = (Sum::default(), Sum::default());
    let mut volume = PlaneVolume::default();
    for t in triangles {
        let area = plan_area(t);
        let h = t.map(|p| p.z - elevation);
        fill.add(positive_part(area, h));
        cut.add(positive_part(area, h.map(|v| -v)));
        for v in h {
            volume.fill_max = volume.fill_max.max(v);
            volume.cut_max = volume.cut_max.max(-v);
        }
    }
    PlaneVolume { cut: cut.value(), fill: fill.value(), ..volume }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two corners above by rounding, one below by more: nothing is filled.
    #[test]
    fn never_negative() {
        for tiny in [1e-16, 3e-17, 1e-300] {
            for low in [-1.0, -0.3, -7e-3] {
                for h in [[tiny, 2.0 * tiny, low], [low, tiny, tiny], [tiny, low, 3.0 * tiny]] {
                    assert!(positive_part(0.7, h) >= 0.0, "{h:?}");
                    assert!(positive_part(0.7, h.map(|v| -v)) >= 0.0, "{h:?}");
                }
            }
        }
    }

    /// Over the unit triangle, `a − x > 0` on the strip `x < a`: a share of `1 − (1 − a)²`, `(1 − a)²` for the other side.
    #[test]
    fn shares_of_the_area() {
        let a = 0.25;
        let h = [a, a - 1.0, a];
        assert!((positive_share(h) - (1.0 - (1.0 - a) * (1.0 - a))).abs() < 1e-15);
        assert!((positive_share(h.map(|v| -v)) - (1.0 - a) * (1.0 - a)).abs() < 1e-15);
        assert_eq!(positive_share([1.0, 0.0, 0.0]), 1.0);
        assert_eq!(positive_share([1.0, 2.0, 0.0]), 1.0);
        assert_eq!((positive_share([0.0; 3]), positive_share([0.0, -1.0, 0.0])), (0.0, 0.0));
    }

    /// Over the unit triangle, `h = a − x` has its positive part on `x < a`: ∫₀ᵃ (a − x)(1 − x) dx = a²/2 − a³/6.
    #[test]
    fn splits_where_the_sign_changes() {
        let a = 0.25;
        let triangle = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y): (f64, f64)| DVec3::new(x, y, a - x));
        let found = above_plane([triangle].into_iter(), 0.0);
        let fill = a * a / 2.0 - a * a * a / 6.0;
        let net = 0.5 * (a - 1.0 / 3.0);
        assert!((found.fill - fill).abs() < 1e-16, "{}", found.fill);
        assert!((found.fill - found.cut - net).abs() < 1e-16);
        assert_eq!((found.fill_max, found.cut_max), (0.25, 0.75));
    }
}
