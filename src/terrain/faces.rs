//! Triangles one by one: turned up, dropped, refused.

use super::corners::{BLOCK, Corners, from_middle};
use super::place::counted;
use super::{at, upright};
use crate::kernel::orientation::{Turn, turn};
use crate::model::{Defects, Note, Terrain};
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashSet;

/// What turning triangles up found.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Turned {
    /// Clockwise triangles, which are counter-clockwise now.
    turned: usize,
    /// Triangles without area in plan, ascending.
    flat: Vec<usize>,
}

/// Turns clockwise triangles.
pub(super) fn turn_up(vertices: &[DVec3], triangles: &mut [[u32; 3]]) -> Turned {
    let plan = |v: u32| at(vertices, v).truncate();
    let of_block = |(block, triangles): (usize, &mut [[u32; 3]])| {
        let mut found = Turned::default();
        for (i, t) in triangles.iter_mut().enumerate() {
            match turn(plan(t[0]), plan(t[1]), plan(t[2])) {
                Turn::Left => {}
                Turn::Right => {
                    t.swap(1, 2);
                    found.turned += 1;
                }
                Turn::Straight => found.flat.push(BLOCK * block + i),
            }
        }
        found
    };
    let blocks: Vec<Turned> = triangles.par_chunks_mut(BLOCK).enumerate().map(of_block).collect();
    blocks.into_iter().fold(Turned::default(), |mut all, block| {
        all.turned += block.turned;
        all.flat.extend(block.flat);
        all
    })
}

/// Drops triangles without area and repetitions; order is kept. `corners` are those of `triangles`.
///
/// # Errors
/// Vertical faces, ground with `y` as its height.
pub(super) fn check(
    label: &str,
    corners: &Corners,
    terrain: &Terrain,
    mut triangles: Vec<[u32; 3]>,
    Turned { turned, flat }: &Turned,
    notes: &mut Vec<Note>,
) -> Result<Vec<[u32; 3]>, Defects> {
    let (given, turned) = (triangles.len(), *turned);
    upright::y_up(label, &corners.coordinates, given, turned, flat.len())?;
    let mut dropped = 0;
    if !flat.is_empty() {
        upright::check(label, terrain, &triangles, flat)?;
        dropped = flat.len();
        drop_at(&mut triangles, flat);
    }
    let twice = repeated(&corners.suspects, &triangles);
    drop_at(&mut triangles, &twice);
    if turned > 0 {
        let message = format!("{turned} of {given} triangles of the ground were clockwise seen from above, and were turned");
        notes.push(Note::new("ground-faces-turned", message));
    }
    if dropped > 0 {
        let message = format!("dropped {} of the ground without area in plan", counted(dropped, "triangle", "triangles"));
        notes.push(Note::new("ground-faces-degenerate", message));
    }
    if !twice.is_empty() {
        let message =
            format!("dropped {} of the ground that had been given before", counted(twice.len(), "triangle", "triangles"));
        notes.push(Note::new("ground-faces-repeated", message));
    }
    Ok(triangles)
}

/// Takes out the triangles at `places`, which ascend.
fn drop_at(triangles: &mut Vec<[u32; 3]>, places: &[usize]) {
    let mut places = places.iter().copied().peekable();
    let mut i = 0;
    triangles.retain(|_| {
        i += 1;
        places.next_if_eq(&(i - 1)).is_none()
    });
}

/// Places of triangles with the corners of an earlier one. All are counter-clockwise, so that the same corners are in the same
/// cyclic order. `suspects` are the vertices that may be the middle corner of such triangles, ascending.
fn repeated(suspects: &[u32], triangles: &[[u32; 3]]) -> Vec<usize> {
    if suspects.is_empty() {
        return Vec::new();
    }
    let suspects: FxHashSet<u32> = suspects.iter().copied().collect();
    let mut seen = FxHashSet::default();
    let mut again = |t: &[u32; 3]| {
        let t = from_middle(t);
        suspects.contains(&t[0]) && !seen.insert(t)
    };
    (0..triangles.len()).filter(|&i| again(&triangles[i])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places of repetitions, by way of the suspects.
    fn found(triangles: &[[u32; 3]]) -> Vec<usize> {
        repeated(&Corners::new(&vec![DVec3::ZERO; 200], triangles).suspects, triangles)
    }

    #[test]
    fn repetitions_are_found_in_any_order_of_corners() {
        let mut triangles = vec![[0, 1, 2], [0, 2, 3], [2, 0, 1], [1, 4, 2], [0, 1, 5], [3, 0, 2], [4, 2, 1]];
        assert_eq!(found(&triangles), [2, 5, 6]);
        drop_at(&mut triangles, &[2, 5, 6]);
        assert_eq!(triangles, [[0, 1, 2], [0, 2, 3], [1, 4, 2], [0, 1, 5]]);
        // Wheels: with the hub before, after and between all others.
        for hub in [0, 199, 100] {
            let rim = |i: u32| if i < hub { i } else { i + 1 };
            let mut wheel: Vec<[u32; 3]> = (1..150).map(|i| [rim(i), rim(i + 1), hub]).collect();
            assert!(found(&wheel).is_empty());
            wheel.push([hub, rim(140), rim(141)]);
            wheel.push([rim(2), hub, rim(1)]);
            wheel.push([rim(2), hub, rim(1)]);
            assert_eq!(found(&wheel), [149, 150, 151]);
        }
    }
}
