//! Setting out: what a crew needs to build the design.

mod hinge;
mod stake;

pub use stake::{Along, Ends, Hand, Lie, Slopes, Stake, Staked, stakes};

/// A planar strip falls along its ruling by the slope, up to this share. Creases where rulings turn by less than 0.81°, of which the
/// cosine is less by so much, pass for none.
const STRIP_RATE: f64 = 1e-4;

/// Share of the whole distance that is looked at first.
const FIRST_STEP: f64 = 1.0 / 512.0;

/// By how much a step is longer than the one before.
const STEP: f64 = 8.0;

/// Looks ever farther, at last as far as `far`, until something is found.
fn in_steps<T>(far: f64, look: impl Fn(f64) -> Option<T>) -> Option<T> {
    let mut reach = far * FIRST_STEP;
    while reach < far {
        if let Some(found) = look(reach) {
            return Some(found);
        }
        reach *= STEP;
    }
    look(far)
}
