//! Heights along an alignment: grades between points of intersection, with vertical curves.

/// A point of vertical intersection: where two grades meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::read) struct Pvi {
    /// Station.
    pub(in crate::read) station: f64,
    /// Height.
    pub(in crate::read) height: f64,
    /// The curve between the grades.
    pub(in crate::read) curve: Curve,
}

/// A curve between two grades.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::read) enum Curve {
    /// None: a break.
    Break,
    /// Parabola: its lengths in plan before and behind the point. Where they differ it is two parabolas with a common tangent at
    /// the station of the point.
    Parabola(f64, f64),
    /// Circle, by its radius.
    Circle(f64),
}

/// A stretch of the profile.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch {
    from: f64,
    to: f64,
    shape: Shape,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// Height and grade at the beginning; half the change of grade for each unit of length.
    Parabola { height: f64, grade: f64, bend: f64 },
    /// Centre and radius; `sag` where it is the lower half of the circle.
    Circle { station: f64, height: f64, radius: f64, sag: bool },
}

/// Why points make no profile.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::read) enum ProfileError {
    /// There are fewer than two.
    TooFew,
    /// A point does not lie behind the one before: both stations.
    Order(f64, f64),
    /// A curve has no room: station of its point, the length it needs there, and what there is.
    NoRoom {
        /// Station of the point of intersection.
        station: f64,
        /// Length of the tangent.
        needs: f64,
        /// Length of the grade that is left.
        room: f64,
    },
    /// A curve at the first or the last point, or one of a size that is no positive number: its station.
    NoCurve(f64),
}

/// Heights along an alignment.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::read) struct Profile {
    /// One after the other, without gaps.
    stretches: Vec<Stretch>,
}

/// Tangents may overlap by this much, in the length unit: stations are rounded to the millimetre.
const OVERLAP: f64 = 2e-3;

impl Profile {
    /// The profile through points of intersection.
    ///
    /// # Errors
    /// [`ProfileError`] with the station.
    pub(in crate::read) fn new(points: &[Pvi]) -> Result<Self, ProfileError> {
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return Err(ProfileError::TooFew) };
        if points.len() < 2 {
            return Err(ProfileError::TooFew);
        }
        if let Some((a, b)) = points.iter().zip(&points[1..]).find(|(a, b)| b.station <= a.station) {
            return Err(ProfileError::Order(a.station, b.station));
        }
        if let Some(end) = [first, last].into_iter().find(|end| end.curve != Curve::Break) {
            return Err(ProfileError::NoCurve(end.station));
        }
        let grade = |a: &Pvi, b: &Pvi| (b.height - a.height) / (b.station - a.station);
        let mut stretches = Vec::new();
        // Where the last curve ended.
        let mut from = first.station;
        for three in points.windows(3) {
            let [before, at, after] = three else { continue };
            let (entry, exit) = (grade(before, at), grade(at, after));
            let curve = curve(at, entry, exit)?;
            let begin = curve.first().map_or(at.station, |stretch| stretch.from);
            let end = curve.last().map_or(at.station, |stretch| stretch.to);
            for (needs, room) in [(at.station - begin, at.station - from), (end - at.station, after.station - at.station)] {
                if needs > room + OVERLAP {
                    return Err(ProfileError::NoRoom { station: at.station, needs, room });
                }
            }
            if begin > from {
                stretches.push(straight(before, entry, from, begin));
            }
            stretches.extend(curve);
            from = from.max(end);
        }
        if let [.., before, last] = points
            && last.station > from
        {
            stretches.push(straight(before, grade(before, last), from, last.station));
        }
        Ok(Self { stretches })
    }

    /// Station of the first point.
    pub(in crate::read) fn begin(&self) -> f64 {
        self.stretches.first().map_or(0.0, |stretch| stretch.from)
    }

    /// Station of the last point.
    pub(in crate::read) fn end(&self) -> f64 {
        self.stretches.last().map_or(0.0, |stretch| stretch.to)
    }

    /// Where one stretch goes over into the next, between two stations.
    pub(in crate::read) fn breaks(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let first = self.stretches.partition_point(|stretch| stretch.from <= from).max(1);
        let stations = self.stretches.iter().skip(first).map(|stretch| stretch.from);
        stations.take_while(move |station| *station < to)
    }

    /// Height at a station; beyond both ends the grades go on.
    pub(in crate::read) fn height(&self, station: f64) -> f64 {
        let behind = self.stretches.partition_point(|stretch| stretch.from <= station);
        match self.stretches.get(behind.saturating_sub(1)) {
            Some(stretch) => stretch.shape.height(station - stretch.from, station),
            None => f64::NAN,
        }
    }

    /// Greatest second derivative of the height between two stations of one stretch.
    pub(in crate::read) fn bend(&self, from: f64, to: f64) -> f64 {
        let middle = 0.5 * (from + to);
        let behind = self.stretches.partition_point(|stretch| stretch.from <= middle);
        match self.stretches.get(behind.saturating_sub(1)).map(|stretch| stretch.shape) {
            Some(Shape::Parabola { bend, .. }) => 2.0 * bend.abs(),
            Some(Shape::Circle { station, radius, .. }) => {
                let off = (from - station).abs().max((to - station).abs()) / radius;
                // z'' of z = √(r² − x²).
                1.0 / (radius * (1.0 - off * off).max(f64::MIN_POSITIVE).powf(1.5))
            }
            None => 0.0,
        }
    }
}

impl Shape {
    /// Height at the distance `along` from the beginning, which is at `station`.
    fn height(self, along: f64, at: f64) -> f64 {
        match self {
            Self::Parabola { height, grade, bend } => height + along * (grade + along * bend),
            Self::Circle { station, height, radius, sag } => {
                let off = at - station;
                let rise = (radius * radius - off * off).max(0.0).sqrt();
                if sag { height - rise } else { height + rise }
            }
        }
    }
}

fn straight(before: &Pvi, grade: f64, from: f64, to: f64) -> Stretch {
    let height = before.height + grade * (from - before.station);
    Stretch { from, to, shape: Shape::Parabola { height, grade, bend: 0.0 } }
}

/// The stretches of the curve at a point of intersection; none for a break, or where the grades are the same.
fn curve(at: &Pvi, entry: f64, exit: f64) -> Result<Vec<Stretch>, ProfileError> {
    let change = exit - entry;
    let positive = |size: f64| size > 0.0 && size.is_finite();
    match at.curve {
        Curve::Break => Ok(Vec::new()),
        Curve::Parabola(before, behind) if before >= 0.0 && behind >= 0.0 && positive(before + behind) => {
            // Both parabolas have the grade of the line between the middles of their tangents where they meet.
            let middle = (entry * before + exit * behind) / (before + behind);
            let begin = at.height - entry * before;
            let between = begin + 0.5 * (entry + middle) * before;
            let part = |from, length: f64, height, grade: f64, next: f64| Stretch {
                from,
                to: from + length,
                shape: Shape::Parabola { height, grade, bend: 0.5 * (next - grade) / length },
            };
            let mut stretches = Vec::new();
            if before == behind {
                stretches.push(part(at.station - before, before + behind, begin, entry, exit));
            } else {
                if before > 0.0 {
                    stretches.push(part(at.station - before, before, begin, entry, middle));
                }
                if behind > 0.0 {
                    stretches.push(part(at.station, behind, between, middle, exit));
                }
            }
            Ok(stretches)
        }
        // A length of nought is a break; so some programs write points without a curve.
        Curve::Parabola(before, behind) if before == 0.0 && behind == 0.0 => Ok(Vec::new()),
        Curve::Circle(radius) if positive(radius) => {
            if change == 0.0 {
                return Ok(Vec::new());
            }
            let (first, last) = (entry.atan(), exit.atan());
            let tangent = radius * (0.5 * (last - first)).tan().abs();
            let (from, to) = (at.station - tangent * first.cos(), at.station + tangent * last.cos());
            let sag = change > 0.0;
            let side = if sag { radius } else { -radius };
            let begin = at.height - tangent * first.sin();
            let shape = Shape::Circle { station: from - side * first.sin(), height: begin + side * first.cos(), radius, sag };
            Ok(vec![Stretch { from, to, shape }])
        }
        Curve::Parabola(..) | Curve::Circle(_) => Err(ProfileError::NoCurve(at.station)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pvi(station: f64, height: f64, curve: Curve) -> Pvi {
        Pvi { station, height, curve }
    }

    fn profile(curve: Curve) -> Profile {
        // +3 % up to station 500, −2 % from there.
        Profile::new(&[pvi(100.0, 50.0, Curve::Break), pvi(500.0, 62.0, curve), pvi(900.0, 54.0, Curve::Break)]).unwrap()
    }

    /// Slope by the difference of two heights: exact for parabolas but for rounding.
    fn grade(profile: &Profile, station: f64) -> f64 {
        const STEP: f64 = 1e-4;
        (profile.height(station + STEP) - profile.height(station - STEP)) / (2.0 * STEP)
    }

    /// Symmetric parabola of length L with a change of grade A: y = A x² / (2 L) off the tangent, A L / 8 off the point of
    /// intersection, K = L / |A in percent|, and the summit at the distance K · (grade in percent) from its beginning
    /// (AASHTO, "A Policy on Geometric Design of Highways and Streets", vertical curves).
    #[test]
    fn parabolas() {
        let profile = profile(Curve::Parabola(100.0, 100.0));
        let k = 200.0 / 5.0;
        assert!((profile.height(500.0) - (62.0 - 0.05 * 200.0 / 8.0)).abs() < 1e-12);
        assert!((profile.height(450.0) - (60.5 - 0.05 * 50.0 * 50.0 / 400.0)).abs() < 1e-12);
        let summit = 400.0 + k * 3.0;
        assert!(grade(&profile, summit).abs() < 1e-9);
        assert!((profile.bend(410.0, 420.0) - 0.01 / k).abs() < 1e-15);
        for (station, expected) in [(400.0, 0.03), (600.0, -0.02), (500.0, 0.005)] {
            assert!((grade(&profile, station) - expected).abs() < 1e-6, "{station}");
        }
        assert_eq!(profile.breaks(100.0, 900.0).collect::<Vec<_>>(), [400.0, 600.0]);
        assert_eq!(profile.breaks(400.0, 600.0).count(), 0);
        assert_eq!((profile.begin(), profile.end()), (100.0, 900.0));
        // Beyond the ends.
        assert!((profile.height(0.0) - 47.0).abs() < 1e-12 && (profile.height(1000.0) - 52.0).abs() < 1e-12);
    }

    /// Unsymmetric: l₁ l₂ A / (2 (l₁ + l₂)) off the point of intersection (T. F. Hickerson, "Route Location and Design").
    #[test]
    fn parabolas_of_two_lengths() {
        let profile = profile(Curve::Parabola(60.0, 140.0));
        assert!((profile.height(500.0) - (62.0 - 60.0 * 140.0 * 0.05 / 400.0)).abs() < 1e-12);
        assert!((profile.height(440.0) - 60.2).abs() < 1e-12 && (profile.height(640.0) - 59.2).abs() < 1e-12);
        for station in [440.0, 500.0, 640.0] {
            let (before, behind) = (grade(&profile, station - 2e-4), grade(&profile, station + 2e-4));
            assert!((before - behind).abs() < 1e-6, "{station}: {before} {behind}");
        }
        assert!((grade(&profile, 500.0) - (0.03 * 60.0 - 0.02 * 140.0) / 200.0).abs() < 1e-6);
    }

    #[test]
    fn circles() {
        let radius = 4000.0;
        let profile = profile(Curve::Circle(radius));
        let (first, last) = (0.03_f64.atan(), (-0.02_f64).atan());
        let tangent = radius * (0.5 * (first - last)).tan();
        let (from, to) = (500.0 - tangent * first.cos(), 500.0 + tangent * last.cos());
        let breaks: Vec<f64> = profile.breaks(0.0, 1000.0).collect();
        assert!((breaks[0] - from).abs() < 1e-9 && (breaks[1] - to).abs() < 1e-9);
        // All points lie on one circle, whose centre is a radius below the summit.
        let centre = (from + radius * first.sin(), 62.0 - tangent * first.sin() - radius * first.cos());
        for i in 0..=20 {
            let station = from + (to - from) * f64::from(i) / 20.0;
            let height = profile.height(station);
            assert!(((station - centre.0).hypot(height - centre.1) - radius).abs() < 1e-8, "{station}");
        }
        assert!((profile.height(from) - (62.0 - tangent * first.sin())).abs() < 1e-9);
        assert!((profile.height(to) - (62.0 + tangent * last.sin())).abs() < 1e-9);
        let tight = profile.bend(from, to);
        assert!(tight >= 1.0 / radius && tight < 1.002 / radius, "{tight}");
        // A sag, mirrored.
        let sag = Profile::new(&[
            pvi(100.0, -50.0, Curve::Break),
            pvi(500.0, -62.0, Curve::Circle(radius)),
            pvi(900.0, -54.0, Curve::Break),
        ]);
        let sag = sag.unwrap();
        for station in [120.0, 410.0, 480.0, 555.0, 800.0] {
            assert!((sag.height(station) + profile.height(station)).abs() < 1e-9, "{station}");
        }
    }

    #[test]
    fn curves_that_touch() {
        let points = [
            pvi(0.0, 0.0, Curve::Break),
            pvi(50.0, 1.0, Curve::Parabola(50.0, 50.0)),
            pvi(150.0, 0.0, Curve::Parabola(50.001, 50.001)),
            pvi(250.0, 4.0, Curve::Break),
        ];
        let profile = Profile::new(&points).unwrap();
        assert_eq!(profile.begin(), 0.0);
        assert!((profile.height(100.0) - 0.5).abs() < 1e-4);
    }

    #[test]
    fn what_is_no_profile() {
        let b = Curve::Break;
        assert_eq!(Profile::new(&[]), Err(ProfileError::TooFew));
        assert_eq!(Profile::new(&[pvi(0.0, 0.0, b)]), Err(ProfileError::TooFew));
        assert_eq!(Profile::new(&[pvi(0.0, 0.0, b), pvi(0.0, 1.0, b)]), Err(ProfileError::Order(0.0, 0.0)));
        let with = |curve| Profile::new(&[pvi(0.0, 0.0, b), pvi(10.0, 1.0, curve), pvi(20.0, 0.0, b)]);
        assert_eq!(with(Curve::Parabola(11.0, 11.0)), Err(ProfileError::NoRoom { station: 10.0, needs: 11.0, room: 10.0 }));
        assert!(matches!(with(Curve::Circle(1000.0)), Err(ProfileError::NoRoom { .. })));
        for size in [-1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(with(Curve::Circle(size)), Err(ProfileError::NoCurve(10.0)));
            assert_eq!(with(Curve::Parabola(size, size)), Err(ProfileError::NoCurve(10.0)));
        }
        assert!(with(Curve::Parabola(0.0, 0.0)).is_ok());
        assert_eq!(Profile::new(&[pvi(0.0, 0.0, Curve::Circle(5.0)), pvi(9.0, 1.0, b)]), Err(ProfileError::NoCurve(0.0)));
    }
}
