//! Raw records → the model, or the full list of what is wrong with them.

mod degrees;
mod place;
mod rings;
mod steep;
mod vertices;

pub use degrees::{Verdict, degrees};
pub use place::Locator;
pub use steep::check_steepness;
pub use vertices::no_data_markers;

use crate::model::{Chain, Defects, Line, Note, Role};
use crate::read::RawInput;
use std::collections::BTreeMap;

/// Vertices closer than this in plan and in height are one vertex, in the input's length unit. Surveyed coordinates are given
/// to 1e-3 or 1e-4; a tenth of a micrometre is what is left of sums and conversions at coordinates of 1e7.
pub const MERGE_DISTANCE: f64 = 1e-6;

/// Largest magnitude of a coordinate, in the input's length unit: beyond it a double resolves less than 1e-7, and no
/// projected coordinate on Earth comes near it.
pub const INPUT_LIMIT: f64 = 1e9;

/// What the caller asks of the line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Make rings of lines that do not end where they begin.
    pub closed: bool,
}

/// A line that meets the invariants of [`Line`], and what was done to it on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The line.
    pub line: Line,
    /// What was merged, closed or noticed.
    pub notes: Vec<Note>,
}

/// Checks a raw line and makes a line of it.
///
/// Repeated vertices are merged ([`MERGE_DISTANCE`]); a line that ends where it begins is a ring, if three vertices are left.
/// Collinear vertices stay. Open lines may cross and cover themselves and each other; rings may not, except that rings of
/// different polygons may touch and share stretches. Rings inside each other bound by the even-odd rule.
///
/// # Errors
/// All defects found, not only the first. The shape of rings is checked for those whose vertices are sound.
pub fn check(raw: &RawInput, options: &Options) -> Result<Checked, Defects> {
    let mut defects = Defects::default();
    let mut notes = Vec::new();
    degrees::check(raw, &mut defects, &mut notes);
    let mut line = vertices::lines(raw, *options, &mut defects, &mut notes);
    let nested = rings::check(&raw.source.label, &line.chains, &mut defects);
    defects.into_result()?;
    even_odd(&mut line.chains, &nested, &mut notes);
    // Without defects every raw line has become a chain or a breakline.
    Ok(Checked { line, notes })
}

/// Makes holes of rings that lie inside an odd number of others, and the other way round: `nested` as told by [`rings::check`].
fn even_odd(chains: &mut [Chain], nested: &[(usize, usize)], notes: &mut Vec<Note>) {
    let polygon = |role: Role| match role {
        Role::Outer { polygon } | Role::Hole { polygon } => polygon,
        Role::Open => 0,
    };
    let around: BTreeMap<usize, usize> = nested.iter().copied().collect();
    let free = chains.iter().map(|chain| polygon(chain.role)).max().unwrap_or(0) + 1;
    // A hole of a ring that is a hole itself bounds an island.
    for (i, chain) in chains.iter_mut().enumerate() {
        if matches!(chain.role, Role::Hole { .. }) && !around.contains_key(&i) {
            chain.role = Role::Outer { polygon: free + i as u32 };
        }
    }
    // All rings that are no holes have their numbers now: those around holes are among them.
    let mut holes = 0;
    for (&inner, &outer) in &around {
        let hole = Role::Hole { polygon: polygon(chains[outer].role) };
        if matches!(std::mem::replace(&mut chains[inner].role, hole), Role::Hole { .. }) {
            holes += 1;
            continue;
        }
        let (inner, outer) = (&chains[inner].name, &chains[outer].name);
        let message = format!("ring `{inner}` lies inside ring `{outer}`: it bounds a hole in it");
        notes.push(Note::new("ring-inside-ring", message));
    }
    if holes > 0 {
        notes.push(Note::new("polygon-holes", format!("polygons have holes, into which slopes run too: {holes}")));
    }
}

/// Checks the rings of a line that was changed after [`check`]. The result names, by number of chain, rings that lie inside an
/// odd number of others, each with the innermost ring around it.
///
/// # Errors
/// All places where rings touch or cross themselves or cross each other, and holes outside of their polygons.
pub fn check_rings(line: &Line, label: &str) -> Result<Vec<(usize, usize)>, Defects> {
    let mut defects = Defects::default();
    let nested = rings::check(label, &line.chains, &mut defects);
    defects.into_result()?;
    Ok(nested)
}

#[cfg(test)]
mod tests;
