//! Lines whose parts touch exactly.
//!
//! A part of the line that just reaches the slope of another, with nothing of it buried, lies between two surfaces of different
//! make-up, and rounding cannot tell on which side. The checks refuse such a surface. Then the line is built again with its
//! heights moved by a small part of the tolerance, each by its own amount, so that nothing touches exactly any more. What comes
//! of it passes the same checks against the line as given. ("Joggled input", as the program Qhull calls it.)

use super::SurfaceError;
use crate::model::{Joggle, Note};

/// The shifts tried, one after the other, as shares of the tolerance.
const SHARES: [f64; 6] = [1e-3, 1e-3, 1e-2, 1e-2, 1e-1, 1e-1];

/// Smaller shifts (length units) drown in what counts as touching.
const LEAST_SHIFT: f64 = 5e-8;

impl SurfaceError {
    /// Whether moving the line a little may help.
    pub(crate) fn is_flaw(&self) -> bool {
        matches!(self, Self::Unclosed { .. } | Self::Crowded | Self::Unsound { .. })
    }
}

/// Builds on the line as given, and where that fails with a flaw, on joggled ones.
///
/// # Errors
/// Where no joggled line can be built either: what is wrong with the first of them whose error is no flaw, for it is as near to the
/// line as given as what would have been built; else the flaw.
pub(crate) fn in_spite_of_touching<T, E>(
    tolerance: f64,
    is_flaw: impl Fn(&E) -> bool,
    build: impl Fn(Option<Joggle>) -> Result<T, E>,
) -> Result<T, E> {
    let mut failed = match build(None) {
        Err(error) if is_flaw(&error) => error,
        done => return done,
    };
    for (share, set) in SHARES.iter().zip(1..) {
        let joggle = Joggle { most: share * tolerance, set };
        if joggle.most < LEAST_SHIFT {
            continue;
        }
        match build(Some(joggle)) {
            Err(error) if is_flaw(&failed) && !is_flaw(&error) => failed = error,
            Err(_) => {}
            done => return done,
        }
    }
    Err(failed)
}

/// What is to be told of a joggled line.
pub(crate) fn note(joggle: Joggle, one_sided: bool) -> Note {
    let mut message = format!(
        "parts of the line touch each other's slopes exactly: its vertices were moved by up to {:.1e} in height to tell them apart",
        joggle.most
    );
    if one_sided {
        message += "; a part that lies in the slope of another ends that slope or is covered by it, so this may decide what the \
                    slopes of one side cover: move the part up or down to choose";
    }
    Note::new("line-joggled", message)
}
