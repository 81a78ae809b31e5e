//! Faces of more than three corners → triangles.

use super::at;
use super::place::{counted, defect, point};
use crate::kernel::orientation::{Turn, turn};
use crate::mesh::region;
use crate::model::{Defects, Note};
use glam::DVec3;

/// Splits all faces, in their order. Convex ones are fanned out from their first corner; others get their constrained Delaunay
/// triangulation in plan.
pub(super) fn split(
    label: &str,
    vertices: &[DVec3],
    corners: &[u32],
    ends: &[usize],
    notes: &mut Vec<Note>,
) -> Result<Vec<[u32; 3]>, Defects> {
    let mut triangles = Vec::with_capacity(corners.len().saturating_sub(2 * ends.len()));
    let mut begin = 0;
    let mut more = 0;
    let mut defects = Defects::default();
    for (number, &end) in ends.iter().enumerate() {
        let face = &corners[begin..end];
        begin = end;
        if let [a, b, c] = *face {
            triangles.push([a, b, c]);
            continue;
        }
        more += 1;
        if !one(vertices, face, &mut triangles) {
            let place = format!("{label}, face {} at {}", number + 1, point(at(vertices, face[0])));
            let figures = format!("{} corners, whose outline crosses or touches itself", face.len());
            let what = "a face of the ground is no simple polygon in plan";
            defects.extend(defect("ground-polygon", what, place, figures, "split the face into triangles"));
        }
    }
    defects.into_result()?;
    let message = format!("{} of more than three corners were split into triangles", counted(more, "face", "faces"));
    notes.push(Note::new("ground-faces-split", message));
    Ok(triangles)
}

/// Splits one face; `false`, and nothing is added, if it is not simple in plan.
pub fn one(vertices: &[DVec3], face: &[u32], out: &mut Vec<[u32; 3]>) -> bool {
    let n = face.len();
    let plan = |i: usize| at(vertices, face[i % n]).truncate();
    let (mut left, mut right, mut around) = (0, 0, 0);
    for i in 0..n {
        match turn(plan(i), plan(i + 1), plan(i + 2)) {
            Turn::Left => left += 1,
            Turn::Right => right += 1,
            Turn::Straight => {}
        }
        // A convex outline goes down once.
        around += usize::from(plan(i + 1).y < plan(i).y && plan(i + 2).y >= plan(i + 1).y);
    }
    let upright = left == 0 && right == 0;
    if upright || ((left == n || right == n) && around == 1) {
        // Without area, the triangles are looked at one by one later.
        out.extend((1..n - 1).map(|i| [face[0], face[i], face[i + 1]]));
        return true;
    }
    // Twice the signed area: which side is inside.
    let origin = plan(0);
    let area: f64 = (1..n).map(|i| (plan(i) - origin).perp_dot(plan(i + 1) - origin)).sum();
    let edge = |i: usize| if area > 0.0 { vec![face[i], face[(i + 1) % n]] } else { vec![face[(i + 1) % n], face[i]] };
    let mut seen = face.to_vec();
    seen.sort_unstable();
    if seen.windows(2).any(|pair| pair[0] == pair[1]) {
        return false;
    }
    let outline: Vec<Vec<u32>> = (0..n).map(edge).collect();
    match region::fill(vertices, &outline) {
        Ok(triangles) if triangles.len() == n - 2 => {
            let turned = |t: [u32; 3]| if area > 0.0 { t } else { [t[0], t[2], t[1]] };
            out.extend(triangles.into_iter().map(turned));
            true
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(points: &[(f64, f64)], area: f64) {
        let vertices: Vec<DVec3> = points.iter().map(|&(x, y)| DVec3::new(x, y, x * y)).collect();
        let n = vertices.len() as u32;
        let forward: Vec<u32> = (0..n).collect();
        let backward: Vec<u32> = (0..n).rev().collect();
        for (face, sign) in [(forward, 1.0), (backward, -1.0)] {
            for start in 0..n as usize {
                let mut face = face.clone();
                face.rotate_left(start);
                let mut out = Vec::new();
                assert!(one(&vertices, &face, &mut out), "{face:?}");
                assert_eq!(out.len(), face.len() - 2, "{face:?}");
                let areas =
                    out.iter().map(|t| t.map(|v| vertices[v as usize].truncate())).map(|[a, b, c]| (b - a).perp_dot(c - a));
                let areas: Vec<f64> = areas.collect();
                assert!(areas.iter().all(|a| a * sign > 0.0), "{face:?}: {areas:?}");
                assert!((0.5 * areas.iter().sum::<f64>() * sign - area).abs() < 1e-12, "{face:?}: {areas:?}");
            }
        }
    }

    #[test]
    fn convex_concave_and_straight_corners() {
        check(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)], 2.0);
        // An arrow head: only one diagonal lies inside.
        check(&[(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)], 4.0);
        // A U, and a square with a corner in the middle of a side.
        check(&[(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (2.0, 3.0), (2.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)], 7.0);
        check(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)], 4.0);
    }

    #[test]
    fn outlines_that_cross_themselves() {
        let vertices = [(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        assert!(!one(&vertices, &[0, 1, 2, 3], &mut Vec::new()));
        // A star of five points turns left everywhere, but twice around.
        let star: Vec<DVec3> =
            (0..5).map(|i| f64::from(i) * 0.8 * std::f64::consts::PI).map(|a| DVec3::new(a.cos(), a.sin(), 0.0)).collect();
        assert!(!one(&star, &[0, 1, 2, 3, 4], &mut Vec::new()));
        assert!(!one(&vertices, &[0, 2, 1, 2], &mut Vec::new()));
    }
}
