//! What is to be built, and where.

use crate::common::oracle::Polyline;
use crate::tin::Ground;

/// A line, its slopes, and the ground.
#[derive(Clone, Debug)]
pub(crate) struct Site {
    /// Rings are platforms, open lines have no width.
    pub(crate) lines: Vec<Polyline>,
    pub(crate) cut_slope: f64,
    pub(crate) fill_slope: f64,
    pub(crate) ground: Ground,
    /// `--tolerance`
    pub(crate) tolerance: f64,
}

impl Site {
    /// Both slopes alike, tolerance 0.1 mm.
    pub(crate) fn new(lines: Vec<Polyline>, slope: f64, ground: Ground) -> Self {
        Self { lines, cut_slope: slope, fill_slope: slope, ground, tolerance: 1e-4 }
    }

    pub(crate) fn cut_slope(self, cut_slope: f64) -> Self {
        Self { cut_slope, ..self }
    }

    pub(crate) fn tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// Line and ground moved by a rule. Rings turn round where the rule mirrors, which changes nothing.
    pub(crate) fn map(&self, rule: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let moved = |l: &Polyline| Polyline { points: l.points.iter().map(|&p| rule(p)).collect(), closed: l.closed };
        Self { lines: self.lines.iter().map(moved).collect(), ground: self.ground.map(&rule), ..self.clone() }
    }

    /// Mirrored in z: cut is fill.
    pub(crate) fn upside_down(&self) -> Self {
        let (cut_slope, fill_slope) = (self.fill_slope, self.cut_slope);
        Self { cut_slope, fill_slope, ..self.map(|[x, y, z]| [x, y, -z]) }
    }

    /// The lines as GeoJSON, every ring a polygon of its own.
    pub(crate) fn geojson(&self) -> String {
        geojson(&self.lines)
    }
}

/// Lines as GeoJSON, numbers with all their digits.
pub(crate) fn geojson(lines: &[Polyline]) -> String {
    let position = |p: &[f64; 3]| format!("[{},{},{}]", p[0], p[1], p[2]);
    let feature = |line: &Polyline| {
        let mut positions: Vec<String> = line.points.iter().map(position).collect();
        let (kind, open, close) = if line.closed { ("Polygon", "[[", "]]") } else { ("LineString", "[", "]") };
        if line.closed {
            positions.push(positions[0].clone());
        }
        let coordinates = positions.join(",");
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"{kind}","coordinates":{open}{coordinates}{close}}}}}"#
        )
    };
    let features: Vec<String> = lines.iter().map(feature).collect();
    format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(",\n"))
}
