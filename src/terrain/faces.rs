//! Triangles one by one: turned up, dropped, refused.

use super::coordinates::Coordinates;
use super::place::counted;
use super::{at, upright};
use crate::kernel::orientation::{Turn, turn};
use crate::model::{Defects, Note, Terrain};
use glam::DVec3;

/// Turns clockwise triangles, drops those without area and repetitions; order is kept.
///
/// # Errors
/// Vertical faces, ground with `y` as its height.
pub(super) fn check(
    label: &str,
    coordinates: &Coordinates,
    terrain: &Terrain,
    mut triangles: Vec<[u32; 3]>,
    notes: &mut Vec<Note>,
) -> Result<Vec<[u32; 3]>, Defects> {
    let vertices = &terrain.vertices;
    let plan = |v: u32| at(vertices, v).truncate();
    let given = triangles.len();
    let mut turned = 0;
    let mut flat = Vec::new();
    for (i, t) in triangles.iter_mut().enumerate() {
        match turn(plan(t[0]), plan(t[1]), plan(t[2])) {
            Turn::Left => {}
            Turn::Right => {
                t.swap(1, 2);
                turned += 1;
            }
            Turn::Straight => flat.push(i),
        }
    }
    upright::y_up(label, coordinates, given, turned, flat.len())?;
    let mut dropped = 0;
    if !flat.is_empty() {
        upright::check(label, terrain, &triangles, &flat)?;
        dropped = flat.len();
        drop_at(&mut triangles, &flat);
    }
    let twice = repeated(vertices, &triangles);
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
/// cyclic order: their two edges from the least corner on are the same.
fn repeated(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Vec<usize> {
    // For the least corner of each triangle, the corner after it; those of one vertex beside each other (a counting sort).
    let least = |t: &[u32; 3]| {
        let [a, b, c] = *t;
        if a < b && a < c {
            [a, b, c]
        } else if b < c {
            [b, c, a]
        } else {
            [c, a, b]
        }
    };
    let mut start = vec![0_u32; vertices.len() + 1];
    for t in triangles {
        start[least(t)[0] as usize + 1] += 1;
    }
    for v in 0..vertices.len() {
        start[v + 1] += start[v];
    }
    let mut next = start.clone();
    let mut after = vec![0_u32; triangles.len()];
    let mut suspects = Vec::new();
    for (i, t) in triangles.iter().enumerate() {
        let [a, b, _] = least(t);
        let (from, to) = (start[a as usize] as usize, next[a as usize] as usize);
        // Few triangles have the same least corner; where many do, as around the hub of a wheel, they are sorted out below.
        if to - from >= MANY || after[from..to].contains(&b) {
            suspects.push(i);
        }
        after[to] = b;
        next[a as usize] += 1;
    }
    if suspects.is_empty() {
        return Vec::new();
    }
    // A suspect may only share an edge with an earlier one: whole triangles decide.
    let hubs: rustc_hash::FxHashSet<u32> = suspects.iter().map(|&i| least(&triangles[i])[0]).collect();
    let mut seen = rustc_hash::FxHashSet::default();
    (0..triangles.len())
        .filter(|&i| {
            let t = least(&triangles[i]);
            hubs.contains(&t[0]) && !seen.insert(t)
        })
        .collect()
}

/// Triangles with the same least corner up to which they are compared one by one.
const MANY: usize = 32;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repetitions_are_found_in_any_order_of_corners() {
        let vertices = vec![DVec3::ZERO; 200];
        let mut triangles = vec![[0, 1, 2], [0, 2, 3], [2, 0, 1], [1, 4, 2], [0, 1, 5], [3, 0, 2], [4, 2, 1]];
        assert_eq!(repeated(&vertices, &triangles), [2, 5, 6]);
        drop_at(&mut triangles, &[2, 5, 6]);
        assert_eq!(triangles, [[0, 1, 2], [0, 2, 3], [1, 4, 2], [0, 1, 5]]);
        // A wheel.
        let mut wheel: Vec<[u32; 3]> = (1..150).map(|i| [i, i + 1, 0]).collect();
        assert!(repeated(&vertices, &wheel).is_empty());
        wheel.push([0, 140, 141]);
        wheel.push([2, 0, 1]);
        assert_eq!(repeated(&vertices, &wheel), [149, 150]);
    }
}
