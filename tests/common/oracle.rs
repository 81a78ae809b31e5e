//! Brute force: plain loops over all segments, own formulas, nothing from the library.
//!
//! Every formula is written about the query point, so that coordinates of any size cost no digits.

/// A polyline, or a ring that does not repeat its first vertex.
#[derive(Clone, Debug)]
pub(crate) struct Polyline {
    /// x, y, z.
    pub(crate) points: Vec<[f64; 3]>,
    /// Whether the last vertex is joined to the first.
    pub(crate) closed: bool,
}

impl Polyline {
    /// The pairs of points that segments join.
    pub(crate) fn segments(&self) -> impl Iterator<Item = ([f64; 3], [f64; 3])> + '_ {
        let n = self.points.len();
        (0..if self.closed { n } else { n - 1 }).map(move |i| (self.points[i], self.points[(i + 1) % n]))
    }

    /// The steepest gradient of a segment.
    pub(crate) fn steepest(&self) -> f64 {
        self.segments().fold(0.0, |m, (a, b)| m.max((b[2] - a[2]).abs() / (b[0] - a[0]).hypot(b[1] - a[1])))
    }
}

/// A segment seen from a point: `along` and `across` of the point from the first end, `length`, heights of both ends. Heights
/// change sign for a rising sheet, which makes it a falling one.
struct Seen {
    along: f64,
    across: f64,
    length: f64,
    z: [f64; 2],
}

fn seen(a: [f64; 3], b: [f64; 3], rising: bool, x: f64, y: f64) -> Seen {
    let (ux, uy) = (b[0] - a[0], b[1] - a[1]);
    let length = (ux * ux + uy * uy).sqrt();
    let (px, py) = (x - a[0], y - a[1]);
    let sign = if rising { -1.0 } else { 1.0 };
    Seen {
        along: (px * ux + py * uy) / length,
        across: (px * uy - py * ux).abs() / length,
        length,
        z: [sign * a[2], sign * b[2]],
    }
}

impl Seen {
    /// Height at the point of the cone that stands at `s` on the segment.
    fn cone(&self, s: f64, k: f64) -> f64 {
        let w = s / self.length;
        self.z[0] * (1.0 - w) + self.z[1] * w - k * (s - self.along).hypot(self.across)
    }

    /// Height of the envelope of all cones on the segment: that of the best cone, at an end or where the rise along the
    /// segment is lost again by the way to the point, `γ = k·(s − along)/√((s − along)² + across²)`.
    fn envelope(&self, k: f64) -> f64 {
        let ends = self.cone(0.0, k).max(self.cone(self.length, k));
        let gamma = (self.z[1] - self.z[0]) / self.length;
        if gamma.abs() >= k {
            return ends;
        }
        let s = self.along + self.across * gamma / ((k + gamma) * (k - gamma)).sqrt();
        if s > 0.0 && s < self.length { ends.max(self.cone(s, k)) } else { ends }
    }

    /// Signed distance from the point to the tapered capsule in which the segment's sheet is at least `c` high: the convex
    /// hull of the discs of radius `(z − c)/k` about its ends. Negative inside. Infinite if the segment is below `c`.
    fn capsule(&self, k: f64, c: f64) -> f64 {
        let radius = self.z.map(|z| (z - c) / k);
        // A segment that dips below `c` counts from where it comes out.
        let (mut from, mut to, mut r) = (0.0, self.length, radius);
        match (radius[0] < 0.0, radius[1] < 0.0) {
            (true, true) => return f64::INFINITY,
            (true, false) => (from, r[0]) = (self.length * radius[0] / (radius[0] - radius[1]), 0.0),
            (false, true) => (to, r[1]) = (self.length * radius[0] / (radius[0] - radius[1]), 0.0),
            (false, false) => {}
        }
        let (length, along) = (to - from, self.along - from);
        let discs = (along.hypot(self.across) - r[0]).min((along - length).hypot(self.across) - r[1]);
        // The common tangent touches where the radius through the point leans by `sin β = (r₀ − r₁)/length`.
        let sine = (r[0] - r[1]) / length;
        if length <= 0.0 || sine.abs() >= 1.0 {
            return discs;
        }
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let on_axis = along * cosine - self.across * sine; // times cos β: where the normal of the tangent meets the axis
        if on_axis < 0.0 || on_axis > length * cosine { discs } else { self.across * cosine + along * sine - r[0] }
    }
}

/// Height at (x, y) of the sheet through the lines: highest of the falling cones, or lowest of the rising ones.
pub(crate) fn height(lines: &[Polyline], k: f64, rising: bool, x: f64, y: f64) -> f64 {
    let all = lines.iter().flat_map(Polyline::segments);
    let best = all.map(|(a, b)| seen(a, b, rising, x, y).envelope(k)).fold(f64::NEG_INFINITY, f64::max);
    if rising { -best } else { best }
}

/// Signed plan distance from (x, y) to the union of the tapered capsules of all segments at height `c`, negative inside. The
/// union is the region where the falling sheet is at least `c` (the rising one at most); its rim is the level curve. Outside
/// the distance is the true one; inside it is that to the rim of the capsule the point is deepest in.
pub(crate) fn capsule_distance(lines: &[Polyline], k: f64, rising: bool, c: f64, x: f64, y: f64) -> f64 {
    let c = if rising { -c } else { c };
    let all = lines.iter().flat_map(Polyline::segments);
    all.map(|(a, b)| seen(a, b, rising, x, y).capsule(k, c)).fold(f64::INFINITY, f64::min)
}

/// The greatest depth at which a vertex or one of `parts` points of each segment lies buried under the sheet; nought where
/// the line is everywhere on its own sheet. Takes the square of the number of segments.
pub(crate) fn burial(lines: &[Polyline], k: f64, rising: bool, parts: usize) -> f64 {
    let mut depth = 0f64;
    for (a, b) in lines.iter().flat_map(Polyline::segments) {
        for i in 0..=parts {
            let w = i as f64 / parts as f64;
            let p: [f64; 3] = std::array::from_fn(|j| a[j] * (1.0 - w) + b[j] * w);
            depth = depth.max((height(lines, k, rising, p[0], p[1]) - p[2]).abs());
        }
    }
    depth
}
