//! Jobs and files of cases in few words.

use super::Task;
use crate::formation::{Crossfall, Formation};
use crate::model::{Extent, Sheet, Side, Slope};
use crate::pipeline::{Against, BuildJob, GroundInput, LineInput, Rasters, SampleJob, VolumeJob, Where, Wishes};
use crate::read::terrain::TerrainOptions;
use crate::read::{Pick, ReadOptions};
use crate::report::ReportFormat;
use crate::write::{LineFormat, MeshFormat, Target};
use std::path::PathBuf;

pub(super) const LINE: &str = "line.geojson";
pub(super) const GROUND: &str = "ground.obj";
pub(super) const POINTS: &str = "points.csv";
pub(super) const REPORT: &str = "report.json";
pub(super) const LINES: &str = "lines.geojson";
pub(super) const HEIGHTS: &str = "heights.csv";
pub(super) const RASTER: &str = "raster.asc";
pub(super) const FINISHED: &str = "finished.obj";

/// Tolerance of all cases, in the length unit.
pub(super) const TOLERANCE: f64 = 1e-3;

/// A line or ring of a case.
#[derive(Clone)]
pub(super) struct Shape {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) closed: bool,
}

pub(super) fn open(points: &[[f64; 3]]) -> Shape {
    Shape { points: points.to_vec(), closed: false }
}

pub(super) fn ring(points: &[[f64; 3]]) -> Shape {
    Shape { points: points.to_vec(), closed: true }
}

/// A level rectangle, counter-clockwise, its south-west corner at `at`.
pub(super) fn rectangle([x, y, z]: [f64; 3], length: f64, width: f64) -> Shape {
    ring(&[[x, y, z], [x + length, y, z], [x + length, y + width, z], [x, y + width, z]])
}

impl Shape {
    pub(super) fn map(&self, rule: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        Self { points: self.points.iter().map(|&p| rule(p)).collect(), closed: self.closed }
    }

    fn positions(&self) -> String {
        let closing = self.points.first().filter(|_| self.closed);
        let position = |[x, y, z]: &[f64; 3]| format!("[{x},{y},{z}]");
        self.points.iter().chain(closing).map(position).collect::<Vec<_>>().join(",")
    }
}

/// Lines as GeoJSON, every ring a polygon of its own.
pub(super) fn features(shapes: &[Shape]) -> String {
    let feature = |shape: &Shape| {
        let (kind, before, after) = if shape.closed { ("Polygon", "[[", "]]") } else { ("LineString", "[", "]") };
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"{kind}","coordinates":{before}{}{after}}}}}"#,
            shape.positions()
        )
    };
    collection(&shapes.iter().map(feature).collect::<Vec<_>>())
}

/// A polygon with holes as GeoJSON.
pub(super) fn polygon(rings: &[Shape]) -> String {
    let rings: Vec<String> = rings.iter().map(|ring| format!("[{}]", ring.positions())).collect();
    collection(&[format!(
        r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"Polygon","coordinates":[{}]}}}}"#,
        rings.join(",")
    )])
}

fn collection(features: &[String]) -> String {
    format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","))
}

/// Points without heights as text.
pub(super) fn points(points: &[[f64; 2]]) -> String {
    let rows: String = points.iter().map(|[x, y]| format!("{x},{y}\n")).collect();
    format!("x,y\n{rows}")
}

/// A mesh as OBJ; faces count from 0.
pub(super) fn obj(vertices: &[[f64; 3]], faces: &[&[usize]]) -> String {
    let vertices: String = vertices.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    let face = |face: &&[usize]| format!("f{}\n", face.iter().map(|v| format!(" {}", v + 1)).collect::<String>());
    vertices + &faces.iter().map(face).collect::<String>()
}

/// The square of the points within `reach` of `centre` along both axes, as one plane.
pub(super) fn plane([x, y]: [f64; 2], reach: f64, height: impl Fn(f64, f64) -> f64) -> String {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[u, v]| [x + u * reach, y + v * reach]);
    obj(&corners.map(|[x, y]| [x, y, height(x, y)]), &[&[0, 1, 2], &[0, 2, 3]])
}

/// What is to be built, with a falling slope outside of rings and on both sides of lines.
pub(super) struct Build {
    job: BuildJob,
}

pub(super) fn slope(ratio: f64) -> Slope {
    Slope::from_ratio(ratio).unwrap_or(Slope::EVEN)
}

fn file(name: &str) -> Target {
    Target::File(PathBuf::from(name))
}

fn line_input() -> LineInput {
    let options = ReadOptions { chord: TOLERANCE / 3.0, ..ReadOptions::default() };
    LineInput { path: PathBuf::from(LINE), options, closed: false, formation: None, unit: None, tolerance: TOLERANCE }
}

impl Build {
    /// Without ground, down to `end`.
    pub(super) fn new(ratio: f64, end: Extent) -> Self {
        let wishes = Wishes {
            slope: slope(ratio),
            sheet: Sheet::Falling,
            side: None,
            extent: Some(end),
            interval: None,
            levels: Vec::new(),
            tolerance: TOLERANCE,
        };
        Self {
            job: BuildJob {
                input: line_input(),
                wishes: vec![wishes],
                ground: None,
                reference: None,
                stations: None,
                bulking: None,
                strict: false,
                meshes: vec![(file("works.obj"), MeshFormat::Obj)],
                finished: Vec::new(),
                rasters: Rasters::default(),
                lines: vec![(file(LINES), LineFormat::GeoJson)],
                stakes: Vec::new(),
                plots: Vec::new(),
                sections: Vec::new(),
                station_tables: Vec::new(),
                local_origin: None,
                reports: vec![(file(REPORT), ReportFormat::Json)],
                run: None,
            },
        }
    }

    /// On existing ground, cut and fill.
    pub(super) fn on_ground(ratio: f64) -> Self {
        let mut build = Self::new(ratio, Extent::Height(1.0));
        let falling = Wishes { extent: None, ..build.job.wishes.remove(0) };
        build.job.wishes = vec![falling.clone(), Wishes { sheet: Sheet::Rising, ..falling }];
        build.job.ground =
            Some(GroundInput { path: PathBuf::from(GROUND), options: TerrainOptions::default(), allow_open: false });
        build
    }

    pub(super) fn side(mut self, side: Side) -> Self {
        self.job.wishes.iter_mut().for_each(|wishes| wishes.side = Some(side));
        self
    }

    pub(super) fn rising(mut self) -> Self {
        self.job.wishes.iter_mut().for_each(|wishes| wishes.sheet = Sheet::Rising);
        self
    }

    /// The falling sheet only, to an elevation.
    pub(super) fn down_to(mut self, elevation: f64) -> Self {
        self.job.wishes.truncate(1);
        self.job.wishes.iter_mut().for_each(|wishes| wishes.extent = Some(Extent::Elevation(elevation)));
        self
    }

    pub(super) fn width(mut self, width: f64) -> Self {
        let chord = TOLERANCE / 3.0;
        self.job.input.formation = Some(Formation { width, crossfall: Crossfall::default(), chord });
        self
    }

    pub(super) fn stations(mut self, spacing: f64) -> Self {
        self.job.stations = Some(spacing);
        self
    }

    pub(super) fn finished(mut self) -> Self {
        self.job.finished = vec![(file(FINISHED), MeshFormat::Obj)];
        self
    }

    pub(super) fn line(mut self, name: &str) -> Self {
        self.job.input.path = PathBuf::from(name);
        self
    }

    pub(super) fn ground(mut self, name: &str) -> Self {
        self.job.ground.iter_mut().for_each(|ground| ground.path = PathBuf::from(name));
        self
    }

    pub(super) fn task(self) -> Task {
        Task::Build(Box::new(self.job))
    }
}

/// Heights at the points of [`POINTS`], or anywhere else.
pub(super) fn sample(ratio: f64, sheet: Sheet) -> Task {
    let at = Where::Points { path: PathBuf::from(POINTS), options: ReadOptions::default() };
    Task::Sample(Box::new(SampleJob { input: line_input(), slope: slope(ratio), sheet, at, output: file(HEIGHTS) }))
}

pub(super) fn sample_raster(ratio: f64, at: Where) -> Task {
    Task::Sample(Box::new(SampleJob {
        input: line_input(),
        slope: slope(ratio),
        sheet: Sheet::Falling,
        at,
        output: file(RASTER),
    }))
}

/// Volumes between two files, or above a level.
pub(super) fn volume(against: Against, within: Option<&str>) -> Task {
    Task::Volume(Box::new(VolumeJob {
        against,
        csv_order: None,
        picks: [Pick::default(), Pick::default()],
        unit: None,
        within_order: None,
        within: within.map(PathBuf::from),
        reports: vec![(file(REPORT), ReportFormat::Json)],
        run: None,
    }))
}

pub(super) fn between(design: &str, existing: &str) -> Against {
    Against::Existing { design: PathBuf::from(design), existing: PathBuf::from(existing) }
}
