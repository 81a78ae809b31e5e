//! The works piece by piece to all who count them.

use super::cell;
use super::clip::sense;
use super::patch::NONE;
use super::shape::Shape;
use super::tally::{Tally, split};
use super::works::Sink;
use super::{Corner, Piece, Pieces, SectionFigures, Sections, Stations};

/// What the feeder has gathered.
pub(crate) struct Fed {
    /// Cut and fill.
    pub(crate) tallied: super::Tallied,
    /// Cross-sections, where stations are wanted.
    pub(crate) sections: Option<SectionFigures>,
    /// The pieces themselves, where they are to be kept.
    pub(crate) pieces: Option<Pieces>,
    /// Plan area of each triangle of the design that has been fed.
    pub(crate) covered: Vec<f64>,
}

/// Passes the pieces of the works on, with their stations.
pub(super) struct Feeder<'a> {
    shape: &'a Shape,
    stations: &'a Stations,
    tally: Tally<'a>,
    sections: Option<Sections<'a>>,
    pieces: Option<Pieces>,
    covered: Vec<f64>,
    corners: Vec<Corner>,
    /// Whether the design counts above and below ground alike, whatever its part: pits and mounds.
    whole: bool,
}

/// A height without the sign its part cannot have, see [`sense`]: rounding.
fn signed(sense: Option<f64>, height: f64) -> f64 {
    match sense {
        Some(sense) if sense > 0.0 => height.max(0.0),
        Some(_) => height.min(0.0),
        None => height,
    }
}

impl<'a> Feeder<'a> {
    pub(super) fn new(shape: &'a Shape, stations: &'a Stations, keep: bool, whole: bool) -> Self {
        Self {
            whole,
            shape,
            stations,
            pieces: keep.then(Pieces::default),
            tally: Tally::new(stations),
            sections: stations.spacing().map(|_| Sections::new(stations)),
            covered: vec![0.0; shape.triangles.len()],
            corners: Vec::new(),
        }
    }

    /// Gives a piece to each of them.
    fn hand_on(&mut self, piece: &Piece<'_>) {
        self.tally.add(piece);
        if let Some(sections) = &mut self.sections {
            sections.add(piece);
        }
        if let Some(pieces) = &mut self.pieces {
            pieces.add(piece);
        }
    }

    pub(super) fn finish(self) -> Fed {
        Fed {
            tallied: self.tally.finish(),
            sections: self.sections.map(Sections::finish),
            pieces: self.pieces,
            covered: self.covered,
        }
    }
}

impl Sink for Feeder<'_> {
    fn take(&mut self, a: u32, corners: &[cell::Corner]) {
        let shape = self.shape;
        let part = shape.parts[a as usize];
        let sense = sense(part, self.whole);
        let height = |c: &cell::Corner| signed(sense, c.h);
        self.corners.clear();
        let axis = if shape.foot_of[a as usize] != NONE {
            let foot = shape.feet[shape.foot_of[a as usize] as usize];
            self.corners.extend(corners.iter().map(|c| Corner { at: c.at, height: height(c), station: foot.station(c.at) }));
            Some(foot.chain)
        } else if let Some((chain, stations)) = shape.road(a) {
            let [p, q, r] = shape.plan(a);
            let plane = [p.extend(stations[0]), q.extend(stations[1]), r.extend(stations[2])];
            let station = |at| cell::on_plane(&plane, at);
            self.corners.extend(corners.iter().map(|c| Corner { at: c.at, height: height(c), station: station(c.at) }));
            Some(chain)
        } else {
            self.corners.extend(corners.iter().map(|c| Corner { at: c.at, height: height(c), station: 0.0 }));
            None
        };
        // Over the first vertex of a ring stations begin again.
        let corners_of_piece = std::mem::take(&mut self.corners);
        let ring = axis.and_then(|axis| self.stations.axes().get(axis as usize)).filter(|axis| axis.closed);
        let length = ring.map_or(f64::INFINITY, |axis| axis.length);
        if corners_of_piece.iter().any(|corner| corner.station > length) {
            let (mut before, mut behind) = (Vec::new(), Vec::new());
            split(&corners_of_piece, length, &mut before, &mut behind);
            behind.iter_mut().for_each(|corner| corner.station = (corner.station - length).max(0.0));
            for corners in [&before, &behind].into_iter().filter(|corners| corners.len() > 2) {
                self.hand_on(&Piece { part, axis, corners });
            }
        } else {
            self.hand_on(&Piece { part, axis, corners: &corners_of_piece });
        }
        self.corners = corners_of_piece;
        let o = corners[0].at;
        let twice: f64 = corners[1..].windows(2).map(|w| (w[0].at - o).perp_dot(w[1].at - o)).sum();
        self.covered[a as usize] += 0.5 * twice;
    }
}
