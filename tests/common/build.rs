//! Lines and designs in few words, and surfaces seen from either sheet.

use glam::DVec3;
use slopegen::model::{Chain, CurveKind, Design, Extent, Line, Part, Place, Role, Sheet, Side, Slope};
use slopegen::surface::{self, Surface};

use super::oracle::Polyline;

/// An open line.
pub(crate) fn open(points: &[[f64; 3]]) -> Polyline {
    Polyline { points: points.to_vec(), closed: false }
}

/// A ring.
pub(crate) fn ring(points: &[[f64; 3]]) -> Polyline {
    Polyline { points: points.to_vec(), closed: true }
}

/// A level rectangle, counter-clockwise, its lower left corner at `at`.
pub(crate) fn rectangle(at: [f64; 3], length: f64, width: f64) -> Polyline {
    let [x, y, z] = at;
    ring(&[[x, y, z], [x + length, y, z], [x + length, y + width, z], [x, y + width, z]])
}

/// A level regular polygon of `n` corners about the origin.
pub(crate) fn regular(n: usize, radius: f64, z: f64) -> Polyline {
    let corner = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
        [radius * cos, radius * sin, z]
    };
    Polyline { points: (0..n).map(corner).collect(), closed: true }
}

/// The library's line: every ring the outline of a polygon of its own.
pub(crate) fn line(lines: &[Polyline]) -> Line {
    let role = |i: usize, l: &Polyline| if l.closed { Role::Outer { polygon: i as u32 } } else { Role::Open };
    Line { chains: lines.iter().enumerate().map(|(i, l)| chain(i, l, role(i, l))).collect(), ..Line::default() }
}

/// The library's line: one polygon, the first ring its outline, the others its holes.
pub(crate) fn polygon(rings: &[Polyline]) -> Line {
    let role = |i: usize| if i == 0 { Role::Outer { polygon: 0 } } else { Role::Hole { polygon: 0 } };
    Line { chains: rings.iter().enumerate().map(|(i, l)| chain(i, l, role(i))).collect(), ..Line::default() }
}

fn chain(i: usize, line: &Polyline, role: Role) -> Chain {
    Chain {
        name: format!("line {}", i + 1),
        role,
        vertices: line.points.iter().map(|&p| DVec3::from(p)).collect(),
        places: vec![Place::default(); line.points.len()],
        axis: None,
    }
}

/// A falling slope `k` on both sides of lines and outside of rings, to `extent`, tolerance 1 mm.
pub(crate) fn design(k: f64, extent: Extent) -> Design {
    Design {
        slope: Slope::from_ratio(k).expect("a positive slope"),
        sheet: Sheet::Falling,
        side_of_lines: Side::Both,
        side_of_rings: Side::Outside,
        extent,
        interval: None,
        tolerance: 1e-3,
        levels: Vec::new(),
        companion: None,
        frame: None,
        joggle: None,
    }
}

/// Builds; the message of a failure names the design.
#[track_caller]
pub(crate) fn build(line: &Line, design: &Design) -> Surface {
    surface::build(line, design, None, &()).unwrap_or_else(|e| panic!("{design:?}: {e}"))
}

/// Runs `check` on the falling surface of the line, and on the rising one of the line mirrored in z, seen in the mirror.
#[track_caller]
pub(crate) fn on_both_sheets(line: &Line, design: &Design, check: impl Fn(&Surface)) {
    check(&build(line, design));
    check(&mirrored(build(&upside_down(line), &mirrored_design(design))));
}

/// The line mirrored in z.
pub(crate) fn upside_down(line: &Line) -> Line {
    let mut line = line.clone();
    line.chains.iter_mut().flat_map(|c| &mut c.vertices).for_each(|v| v.z = -v.z);
    line
}

/// The design for the line mirrored in z.
pub(crate) fn mirrored_design(design: &Design) -> Design {
    let sheet = if design.sheet == Sheet::Falling { Sheet::Rising } else { Sheet::Falling };
    let extent = if let Extent::Elevation(z) = design.extent { Extent::Elevation(-z) } else { design.extent };
    Design { sheet, extent, ..design.clone() }
}

/// The surface mirrored in z: cut becomes fill, ridges valleys. Plan and orientation stay.
pub(crate) fn mirrored(mut surface: Surface) -> Surface {
    surface.tin.vertices.iter_mut().for_each(|v| v.z = -v.z);
    for part in &mut surface.tin.parts {
        *part = match *part {
            Part::FillSlope => Part::CutSlope,
            Part::CutSlope => Part::FillSlope,
            other => other,
        };
    }
    for feature in &mut surface.lines {
        feature.points.iter_mut().for_each(|p| p.z = -p.z);
        feature.elevation = feature.elevation.map(|z| -z);
        feature.kind = match feature.kind {
            CurveKind::Ridge => CurveKind::Valley,
            CurveKind::Valley => CurveKind::Ridge,
            other => other,
        };
    }
    surface.levels.iter_mut().for_each(|z| *z = -*z);
    let areas = &mut surface.areas;
    std::mem::swap(&mut areas.cut_slope, &mut areas.fill_slope);
    let volumes = &mut surface.volumes;
    std::mem::swap(&mut volumes.cut, &mut volumes.fill);
    std::mem::swap(&mut volumes.cut_max, &mut volumes.fill_max);
    volumes.reference = -volumes.reference;
    surface
}
