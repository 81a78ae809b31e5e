//! Ends of the works off the ground: slopes that stop short of it, and lines without a slope to it.

use super::GroundError;
use super::cell::TOUCH;
use super::shape::Shape;
use super::uncovered::Uncovered;
use super::works::{Border, End, Open, Works};
use crate::kernel::sum::Sum;
use crate::model::{Design, Extent, Note};
use crate::slope::levels;
use glam::DVec3;

/// Ends further off the ground than the tolerance.
pub(super) fn beyond_tolerance<'a>(works: &'a Works, designs: &[Design]) -> impl Iterator<Item = &'a Open> {
    let tolerance = Design::least_tolerance(designs);
    works.open.iter().filter(move |open| open.height > tolerance)
}

/// Whether all slopes meet the ground, or end no further off it than the tolerance.
pub(super) fn met(works: &Works, designs: &[Design]) -> bool {
    beyond_tolerance(works, designs).next().is_none()
}

/// Length of ends in plan.
pub(super) fn length<'a>(ends: impl IntoIterator<Item = &'a Open>) -> f64 {
    ends.into_iter().map(|open| length_of(open.points)).collect::<Sum>().value()
}

fn length_of([p, q]: [DVec3; 2]) -> f64 {
    p.truncate().distance(q.truncate())
}

/// Whether an end lies at an elevation.
fn lies_at(open: &Open, elevation: f64) -> bool {
    open.end == End::Slope && open.points.iter().all(|p| (p.z - elevation).abs() <= levels::LEVEL_SNAP)
}

/// Refuses slopes that end without meeting the ground, further off it than the tolerance, unless `allow_open`; and any that end at
/// one of the elevations `found`, which were to lie beyond the ground.
///
/// # Errors
/// [`GroundError::Open`].
pub(super) fn check(
    shape: &Shape,
    works: &Works,
    designs: &[Design],
    found: &[f64],
    allow_open: bool,
) -> Result<(), GroundError> {
    let stops_short = works.open.iter().any(|open| found.iter().any(|&end| lies_at(open, end)));
    if !stops_short && (allow_open || met(works, designs)) {
        return Ok(());
    }
    let Some(worst) = highest(works.open.iter()) else { return Ok(()) };
    let at = shape.frame.to_world(worst.points[0]);
    let (place, cure) = place_and_cure(worst, designs);
    Err(GroundError::Open { x: at.x, y: at.y, length: length(&works.open), height: worst.height, at: place, cure })
}

/// The end that is furthest off the ground.
fn highest<'a>(ends: impl Iterator<Item = &'a Open>) -> Option<&'a Open> {
    ends.max_by(|p, q| p.height.total_cmp(&q.height))
}

/// Where an end lies, and what helps.
fn place_and_cure(open: &Open, designs: &[Design]) -> (&'static str, &'static str) {
    let at_end = |design: &Design| match design.extent {
        Extent::Elevation(end) => lies_at(open, end),
        Extent::Height(_) | Extent::Distance(_) => true,
    };
    match open.end {
        End::Ground => ("at the edge of the ground", "use a ground that reaches further and has no holes"),
        End::Slope if designs.iter().any(at_end) => ("at the end asked for", "give a later end, or none"),
        End::Slope => ("beside the end of the line, where slopes of one side stop", "build both sides (`--side both`)"),
    }
}

/// Refuses upright walls in the finished ground: along the line where that is not on the ground, and where slopes end off it.
///
/// # Errors
/// [`GroundError::Walls`], [`GroundError::WallsAtEnds`].
pub(super) fn check_walls(shape: &Shape, works: &Works, designs: &[Design]) -> Result<(), GroundError> {
    let walls = || works.borders.iter().filter(|border| border.height > TOUCH);
    if let Some(highest) = walls().max_by(|p, q| p.height.total_cmp(&q.height)) {
        let length = walls().map(|border| length_of(border.points)).collect::<Sum>().value();
        let at = shape.frame.to_world(middle(highest));
        return Err(GroundError::Walls { length, height: highest.height, x: at.x, y: at.y });
    }
    let ends = || works.open.iter().filter(|open| open.end == End::Slope);
    match highest(ends()) {
        Some(highest) if highest.height > TOUCH => {
            let at = shape.frame.to_world(highest.points[0]);
            let (place, cure) = place_and_cure(highest, designs);
            Err(GroundError::WallsAtEnds { length: length(ends()), height: highest.height, x: at.x, y: at.y, at: place, cure })
        }
        _ => Ok(()),
    }
}

fn middle(border: &Border) -> DVec3 {
    let [p, q] = border.points;
    0.5 * (p + q)
}

/// Where works go on beyond the ground, the meshes cannot always be put together: that is then the reason.
pub(super) fn reason(error: GroundError, shape: &Shape, works: &Works, uncovered: Option<&Uncovered>) -> GroundError {
    let open = works.open.first().map(|open| shape.frame.to_world(open.points[0]).truncate());
    match (&error, open.or(uncovered.map(|uncovered| uncovered.at))) {
        (GroundError::Cut { .. } | GroundError::Unsound { .. }, Some(at)) => GroundError::OpenMesh { x: at.x, y: at.y },
        _ => error,
    }
}

/// Notes on ends further off the ground than the tolerance: slopes that stop short of it, and lines without a slope to it.
pub(super) fn notes(shape: &Shape, works: &Works, designs: &[Design]) -> Vec<Note> {
    let tolerance = Design::least_tolerance(designs);
    let note = |code, what: &str, ends: Vec<([DVec3; 2], f64)>| {
        let (points, height) = ends.iter().max_by(|p, q| p.1.total_cmp(&q.1))?;
        let length = ends.iter().map(|(points, _)| length_of(*points)).collect::<Sum>().value();
        let at = shape.frame.to_world(points[0]);
        let text = format!("{what} on a length of {length:.3}: up to {height:.3}, near ({:.3}, {:.3})", at.x, at.y);
        Some(Note::new(code, text))
    };
    let open = beyond_tolerance(works, designs).map(|open| (open.points, open.height)).collect();
    let walls = works.borders.iter().filter(|b| b.height > tolerance).map(|b| (b.points, b.height)).collect();
    let open = note("open-ends", "slopes end above or below the ground", open);
    open.into_iter().chain(note("walls", "the line stands off the ground with no slope between the two", walls)).collect()
}
