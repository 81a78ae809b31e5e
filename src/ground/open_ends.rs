//! Ends of the works off the ground: slopes that stop short of it, and lines without a slope to it.

use super::GroundError;
use super::build::Options;
use super::shape::Shape;
use super::uncovered::Uncovered;
use super::works::{End, Works};
use crate::kernel::sum::Sum;
use crate::model::{Design, Extent, Note};
use crate::slope::levels;
use glam::DVec3;

/// Whether all slopes meet the ground, or end no further off it than the tolerance.
pub(super) fn met(works: &Works, designs: &[Design]) -> bool {
    let tolerance = Design::least_tolerance(designs);
    works.open.iter().all(|open| open.height <= tolerance)
}

/// Refuses slopes that end without meeting the ground.
pub(super) fn check(shape: &Shape, works: &Works, designs: &[Design], options: &Options) -> Result<(), GroundError> {
    let Some(worst) = works.open.iter().max_by(|p, q| p.height.total_cmp(&q.height)) else { return Ok(()) };
    if options.allow_open || !options.exactly && met(works, designs) {
        return Ok(());
    }
    let length = works.open.iter().map(|o| o.points[0].truncate().distance(o.points[1].truncate())).collect::<Sum>();
    let at = shape.frame.to_world(worst.points[0]);
    let at_end = |design: &Design| match design.extent {
        Extent::Elevation(end) => worst.points.iter().all(|p| (p.z - end).abs() <= levels::LEVEL_SNAP),
        Extent::Height(_) | Extent::Distance(_) => true,
    };
    let (place, cure) = match worst.end {
        End::Ground => ("at the edge of the ground", "use a ground that reaches further and has no holes"),
        End::Slope if designs.iter().any(at_end) => ("at the end asked for", "give a later end, or none"),
        End::Slope => ("beside the end of the line, where slopes of one side stop", "build both sides (`--side both`)"),
    };
    Err(GroundError::Open { x: at.x, y: at.y, length: length.value(), height: worst.height, at: place, cure })
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
        let highest = ends.iter().max_by(|p, q| p.1.total_cmp(&q.1))?;
        let length = ends.iter().map(|(p, _)| p[0].truncate().distance(p[1].truncate())).collect::<Sum>().value();
        let at = shape.frame.to_world(highest.0[0]);
        let height = highest.1;
        let text = format!("{what} on a length of {length:.3}: up to {height:.3}, near ({:.3}, {:.3})", at.x, at.y);
        Some(Note::new(code, text))
    };
    let open = works.open.iter().filter(|o| o.height > tolerance).map(|o| (o.points, o.height)).collect();
    let walls = works.borders.iter().filter(|b| b.height > tolerance).map(|b| (b.points, b.height)).collect();
    let open = note("open-ends", "slopes end above or below the ground", open);
    open.into_iter().chain(note("walls", "the line stands off the ground with no slope between the two", walls)).collect()
}
