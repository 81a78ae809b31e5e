//! What one section crosses, and how far it goes.

use super::fan::Plane;
use crate::ground::{CutFill, Piece};
use crate::kernel::sum::Sum;

/// Corners this near a section, in the length unit, lie on it. So an edge along the section is seen from the pieces on both
/// sides, whatever rounding did to it; what is seen twice is counted once.
pub(super) const ON_PLANE: f64 = 1e-7;

/// Gaps between pieces up to this, in the length unit, are rounding.
const GAP: f64 = 1e-6;

/// Where the line is a simplified one, stations of its feet are off by more than the line itself: in proportion to its chords, not
/// to what was given. Jumps up to so many times the distance by which the line may be off are no jumps.
const STATION_SLACK: f64 = 30.0;

/// Two ends of a chord: offset from the axis, design minus ground height, station.
#[derive(Clone, Copy, Debug, PartialEq)]
struct End {
    offset: f64,
    height: f64,
    station: f64,
}

impl End {
    fn between(self, other: Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        Self {
            offset: mix(self.offset, other.offset),
            height: mix(self.height, other.height),
            station: mix(self.station, other.station),
        }
    }
}

/// Where a section crosses a piece, by ascending offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chord {
    from: End,
    to: End,
}

impl Chord {
    /// The chord seen against the direction of the axis.
    pub(super) fn mirror(&mut self) {
        let turned = |end: End| End { offset: -end.offset, ..end };
        *self = Self { from: turned(self.to), to: turned(self.from) };
    }

    /// The part from an offset on; `None` if there is nothing.
    fn beyond(self, offset: f64) -> Option<Self> {
        let width = self.to.offset - self.from.offset;
        if self.to.offset <= offset {
            None
        } else if self.from.offset >= offset {
            Some(self)
        } else {
            Some(Self { from: self.from.between(self.to, (offset - self.from.offset) / width), to: self.to })
        }
    }
}

/// The chord of a section through a piece. The plane may also run along an edge.
pub(super) fn chord(plane: &Plane, piece: &Piece<'_>) -> Option<Chord> {
    let mut found: Option<Chord> = None;
    let mut meet = |end: End| match &mut found {
        None => found = Some(Chord { from: end, to: end }),
        Some(chord) if end.offset < chord.from.offset => chord.from = end,
        Some(chord) if end.offset > chord.to.offset => chord.to = end,
        Some(_) => {}
    };
    let place = |corner: &crate::ground::Corner| {
        let (offset, ahead) = plane.split(corner.at);
        (End { offset, height: corner.height, station: corner.station }, ahead)
    };
    let mut before = place(piece.corners.last()?);
    for corner in piece.corners {
        let here = place(corner);
        if here.1.abs() <= ON_PLANE {
            meet(here.0);
        } else if before.1.abs() > ON_PLANE && (before.1 < 0.0) != (here.1 < 0.0) {
            // From behind to ahead, whichever way the edge runs: neighbours get the same bits.
            let (a, b) = if before.1 < 0.0 { (before, here) } else { (here, before) };
            meet(a.0.between(b.0, a.1 / (a.1 - b.1)));
        }
        before = here;
    }
    found.filter(|chord| chord.to.offset > chord.from.offset)
}

/// Where a section begins on the side of positive offsets, if there are works.
///
/// Works that lie on both sides of the axis are parted there. Those on one side begin at the line they were built from, which may
/// stand off the axis by `slack` and is counted from, so that nothing is lost or left over between the two.
fn beginning(chords: &[Chord], slack: f64) -> Option<f64> {
    let mut runs: Vec<(f64, f64)> = Vec::new();
    for chord in chords {
        match runs.last_mut() {
            Some((_, end)) if chord.from.offset <= *end + GAP => *end = end.max(chord.to.offset),
            _ => runs.push((chord.from.offset, chord.to.offset)),
        }
    }
    // Works that are no wider than the slack lie on both sides.
    let narrow = |(from, end): (f64, f64)| from >= -slack && from <= GAP && end > 0.0;
    let (from, end) = runs.into_iter().find(|&run| run.0 <= slack && (run.1 > slack || narrow(run)))?;
    Some(if from < -slack || end <= slack { 0.0 } else { from })
}

/// Reach and areas of a section on the side of positive offsets. Chords are put in order. `slack` is the distance by which the
/// line may stand off the axis, `ring` the length of a closed axis.
///
/// The section ends at the first gap, and where the foot jumps along the axis by more than the offset there: at a crease between
/// two parts of the line that bends by more than 53°, as seen from one level part. That depends on the works alone. Across lesser
/// bends the slope goes on much as it came.
pub(super) fn outward(chords: &mut [Chord], station: f64, slack: f64, ring: Option<f64>) -> (f64, CutFill) {
    chords.sort_by(|a, b| a.from.offset.total_cmp(&b.from.offset).then(a.to.offset.total_cmp(&b.to.offset)));
    let slack = slack.max(GAP);
    let apart = |a: f64, b: f64| {
        let d = (a - b).abs();
        ring.map_or(d, |length| d.min((length - d).abs()))
    };
    let Some(begin) = beginning(chords, slack) else { return Default::default() };
    let (mut reach, mut station) = (begin, station);
    let (mut cut, mut fill) = (Sum::default(), Sum::default());
    let mut rest = &*chords;
    loop {
        while let Some((_, later)) = rest.split_first().filter(|(chord, _)| chord.to.offset <= reach) {
            rest = later;
        }
        // Along an edge a section is seen from the pieces on both sides: it stays with those of its own foot.
        let here = rest.iter().take_while(|chord| chord.from.offset <= reach + GAP);
        let next = here.filter_map(|chord| chord.beyond(reach)).map(|chord| (apart(chord.from.station, station), chord));
        let Some((jump, chord)) = next.min_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        if jump > reach.max(STATION_SLACK * slack) {
            break;
        }
        let (a, b) = (chord.from.height, chord.to.height);
        let width = chord.to.offset - chord.from.offset;
        cut.add(positive_area(width, -a, -b));
        fill.add(positive_area(width, a, b));
        (reach, station) = (chord.to.offset, chord.to.station);
    }
    (reach.max(0.0), CutFill { cut: cut.value(), fill: fill.value() })
}

/// Area between a linear function and nought where it is positive.
fn positive_area(width: f64, a: f64, b: f64) -> f64 {
    match (a > 0.0, b > 0.0) {
        (false, false) => 0.0,
        (true, false) => 0.5 * width * a * (a / (a - b)),
        (false, true) => 0.5 * width * b * (b / (b - a)),
        (true, true) => 0.5 * width * (a + b),
    }
}
