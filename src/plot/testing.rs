//! For tests: whole scenes from a line and a formula of the ground.

use super::{OnGround, Scene};
use crate::formation::{self, Crossfall, Formation};
use crate::ground::{Ground, Options, Site};
use crate::kernel::frame::Frame;
use crate::model::{Bulking, Chain, Design, Extent, LengthUnit, Line, Place, Role, Sheet, Side, Slope, Terrain};
use glam::DVec3;

/// A built site that can be drawn.
pub(super) struct Kit {
    pub(super) line: Line,
    pub(super) built: Ground,
    pub(super) bulking: Option<Bulking>,
    pub(super) title: String,
}

impl Kit {
    pub(super) fn scene(&self) -> Scene<'_> {
        let built = &self.built;
        Scene {
            title: &self.title,
            unit: LengthUnit::Metre,
            crs: Some("EPSG:25832"),
            line: &self.line,
            design: &built.design,
            lines: &built.lines,
            bulking: self.bulking,
            ground: built.terrain.as_ref().zip(built.pieces.as_ref()).map(|(terrain, pieces)| OnGround {
                terrain,
                pieces,
                stations: &built.stations,
                tallied: &built.tallied,
            }),
        }
    }
}

/// Ground over a square of half-width 80 about (`x`, `y`), in cells of 5.
fn terrain(x: f64, y: f64, z: impl Fn(f64, f64) -> f64) -> Terrain {
    let n = 32_u32;
    let at = |i: u32, j: u32| {
        let (u, v) = (5.0 * f64::from(i) - 80.0, 5.0 * f64::from(j) - 80.0);
        DVec3::new(x + u, y + v, z(u, v))
    };
    let vertices = (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j))).map(|(i, j)| at(i, j)).collect();
    let index = |i: u32, j: u32| j * (n + 1) + i;
    let cell = |i, j| {
        let q = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
    };
    let triangles = (0..n).flat_map(|j| (0..n).flat_map(move |i| cell(i, j))).collect();
    Terrain { frame: Frame::WORLD, vertices, triangles }
}

/// A line on ground `z` about a place far from the origin, as a road if a width is given.
pub(super) fn kit(name: &str, points: &[[f64; 3]], closed: bool, width: Option<f64>, z: impl Fn(f64, f64) -> f64) -> Kit {
    let road = width.map(|width| Formation { width, crossfall: Crossfall::default(), chord: 1e-3 });
    formed(name, points, closed, road, z)
}

/// A road over [`hills`] with a crossfall.
pub(super) fn road_with(points: &[[f64; 3]], width: f64, crossfall: Crossfall) -> Kit {
    formed("road", points, false, Some(Formation { width, crossfall, chord: 1e-3 }), hills)
}

fn formed(name: &str, points: &[[f64; 3]], closed: bool, road: Option<Formation>, z: impl Fn(f64, f64) -> f64) -> Kit {
    let (x, y) = (500_000.0, 5_400_000.0);
    let role = if closed { Role::Outer { polygon: 0 } } else { Role::Open };
    let vertices: Vec<DVec3> = points.iter().map(|p| DVec3::new(x + p[0], y + p[1], p[2])).collect();
    let places = vec![Place::default(); vertices.len()];
    let mut line = Line { chains: vec![Chain { name: name.into(), role, vertices, places, axis: None }], ..Line::default() };
    if let Some(road) = road {
        line = formation::widen(&line, name, &road).unwrap().line;
        line = formation::place(line, name, 0.01).unwrap();
    }
    let mut site = Site::new(&line, terrain(x, y, z), "ground");
    let slope = Slope::from_ratio(1.0 / 1.5).unwrap();
    let design = |sheet, end| Design {
        slope,
        sheet,
        side_of_lines: Side::Both,
        side_of_rings: Side::Outside,
        extent: Extent::Elevation(end),
        interval: Some(0.5),
        levels: Vec::new(),
        tolerance: 0.01,
        companion: None,
        frame: None,
        joggle: None,
    };
    let (down, up) = (site.end(slope, Sheet::Falling, 0.01), site.end(slope, Sheet::Rising, 0.01));
    let designs = [design(Sheet::Falling, down), design(Sheet::Rising, up)];
    let options = Options { allow_open: false, finished: false, stations: Some(20.0), keep: true };
    let built = site.build(&designs, &options, &()).unwrap();
    Kit { line, built, bulking: None, title: name.into() }
}

/// Waves over a slope.
pub(super) fn hills(x: f64, y: f64) -> f64 {
    100.0 + 4.0 * (x / 17.0).sin() + 3.0 * (y / 23.0).cos() + 0.05 * y
}

/// A road over hills, with bends.
pub(super) fn road() -> Kit {
    let points = [[-60.0, -20.0, 101.0], [-20.0, -5.0, 102.0], [10.0, -10.0, 102.5], [55.0, 15.0, 103.5]];
    kit("road", &points, false, Some(6.0), hills)
}

/// A yard on a hillside, cut and fill.
pub(super) fn yard() -> Kit {
    let points = [[-20.0, -15.0, 103.0], [25.0, -15.0, 103.0], [25.0, 20.0, 103.0], [-20.0, 20.0, 103.0]];
    kit("yard", &points, true, None, hills)
}
