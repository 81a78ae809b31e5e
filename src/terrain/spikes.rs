//! Single points far above or below all their neighbours.

use super::at;
use super::place::{counted, point, short};
use crate::model::{Note, Terrain};

/// A spike differs from each of its neighbours by more than this multiple of [`TYPICAL`]…
const MULTIPLE: f64 = 6.0;

/// …the share of edges whose ends differ less in height than the scale taken for typical…
const TYPICAL: f64 = 0.9;

/// …and all edges to them are steeper than this, in height per length: else it may be a hill of a coarse survey.
const STEEP: f64 = 1.0;

/// Edges the typical difference is taken from, evenly spread.
const SAMPLE: usize = 100_000;

/// Spikes named one by one.
const NAMED: usize = 5;

/// Warns of spikes. Their neighbours and the scale are those of the surface itself, so that ground of any roughness is measured
/// by its own; ground on which every tenth edge belongs to a spike hides them.
pub(super) fn find(terrain: &Terrain, notes: &mut Vec<Note>) {
    let vertices = &terrain.vertices;
    // Least height above, and below, all neighbours.
    let mut above = vec![f64::INFINITY; vertices.len()];
    let mut below = vec![f64::INFINITY; vertices.len()];
    let mut sample = Vec::with_capacity(SAMPLE + 1);
    let step = (3 * terrain.triangles.len()).div_ceil(SAMPLE).max(1);
    let mut count = 0_usize;
    for t in &terrain.triangles {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            let (i, j) = (a as usize, b as usize);
            let rise = vertices[j].z - vertices[i].z;
            above[i] = above[i].min(-rise);
            below[i] = below[i].min(rise);
            above[j] = above[j].min(rise);
            below[j] = below[j].min(-rise);
            if count.is_multiple_of(step) {
                sample.push(rise.abs());
            }
            count += 1;
        }
    }
    if sample.is_empty() {
        return;
    }
    let place = ((sample.len() - 1) as f64 * TYPICAL) as usize;
    let (_, &mut typical, _) = sample.select_nth_unstable_by(place, f64::total_cmp);
    let height = |v: usize| above[v].max(below[v]);
    let mut steep: Vec<(usize, bool)> = (0..vertices.len())
        .filter(|&v| height(v) > MULTIPLE * typical && height(v) > 0.0 && height(v).is_finite())
        .map(|v| (v, true))
        .collect();
    if steep.is_empty() {
        return;
    }
    for t in &terrain.triangles {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            for (v, w) in [(a, b), (b, a)] {
                if let Ok(found) = steep.binary_search_by_key(&(v as usize), |(v, _)| *v) {
                    let d = at(vertices, w) - at(vertices, v);
                    steep[found].1 &= d.z.abs() > STEEP * d.truncate().length();
                }
            }
        }
    }
    let mut spikes: Vec<usize> = steep.into_iter().filter(|(_, steep)| *steep).map(|(v, _)| v).collect();
    if spikes.is_empty() {
        return;
    }
    spikes.sort_by(|&a, &b| height(b).total_cmp(&height(a)));
    let named: Vec<String> = spikes
        .iter()
        .take(NAMED)
        .map(|&v| {
            let side = if above[v] > below[v] { "above" } else { "below" };
            format!("{} {side} at {}", short(height(v)), point(terrain.frame.to_world(vertices[v])))
        })
        .collect();
    let message = format!(
        "{} of the ground far from all neighbours, where heights differ by {} mostly: {}{}",
        counted(spikes.len(), "point stands out", "points stand out"),
        short(typical),
        named.join("; "),
        if spikes.len() > NAMED { "; …" } else { "" }
    );
    notes.push(Note::new("ground-spikes", message));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;
    use glam::DVec3;

    /// A grid of `n` by `n` squares with heights of its own, in notes.
    fn notes(n: u32, height: impl Fn(u32, u32) -> f64) -> Vec<String> {
        let node = |i: u32, j: u32| j * (n + 1) + i;
        let vertices =
            (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j))).map(|(i, j)| DVec3::new(f64::from(i), f64::from(j), height(i, j)));
        let triangles = (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).flat_map(|(i, j)| {
            let (a, b, c, d) = (node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
            [[a, b, c], [a, c, d]]
        });
        let terrain = Terrain { frame: Frame::WORLD, vertices: vertices.collect(), triangles: triangles.collect() };
        let mut notes = Vec::new();
        find(&terrain, &mut notes);
        notes.into_iter().map(|note| note.message).collect()
    }

    #[test]
    fn a_spike_is_named_and_a_cliff_is_not() {
        let rolling = |i: u32, j: u32| (f64::from(i) * 0.3).sin() + (f64::from(j) * 0.4).cos();
        assert!(notes(20, rolling).is_empty());
        let message = &notes(20, |i, j| rolling(i, j) + if (i, j) == (7, 9) { -40.0 } else { 0.0 })[0];
        assert!(message.starts_with("1 point stands out"), "{message}");
        assert!(message.contains(" below at (7, 9, -"), "{message}");
        assert!(notes(20, |i, j| rolling(i, j) + if i > 9 { 40.0 } else { 0.0 }).is_empty());
        // Level ground with a molehill.
        assert!(notes(20, |i, j| if (i, j) == (7, 9) { 0.3 } else { 0.0 }).is_empty());
    }
}
