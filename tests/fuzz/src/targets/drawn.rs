//! Small lines drawn from choices.

use super::choices::Choices;
use slopegen::formation::{self, Crossfall, Formation};
use slopegen::model::Line;
use slopegen::read::{CoordinateKind, InputFormat, RawInput, RawLine, RawShape, RawVertex, Source};
use slopegen::validate;

/// Slopes that are typed, and some in between.
pub(crate) fn slope(choices: &mut Choices<'_>) -> f64 {
    const USUAL: [f64; 9] = [0.5, 1.0, 2.0 / 3.0, 0.25, 0.1, 1.0 / 3.0, 2.0, 5.0, 10.0];
    match choices.below(12) {
        i if i < USUAL.len() => USUAL[i],
        _ => 10_f64.powf(choices.between(-1.0, 1.0)),
    }
}

/// How coordinates are drawn.
struct Hand {
    /// Step of the grid; none: anywhere.
    grid: Option<f64>,
    /// Gradients are whole multiples of a fifth of this.
    k: f64,
    /// Middle of everything.
    far: [f64; 2],
}

impl Hand {
    fn plan(&self, choices: &mut Choices<'_>, from: [f64; 2]) -> [f64; 2] {
        match self.grid {
            // Right angles and equal legs are frequent.
            Some(step) => {
                let length = step * (1 + choices.below(8)) as f64;
                let [x, y] =
                    [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
                        [choices.below(8)];
                [from[0] + x * length, from[1] + y * length]
            }
            None => [from[0] + choices.between(-20.0, 20.0), from[1] + choices.between(-20.0, 20.0)],
        }
    }

    /// The height at the other end of a leg.
    fn height(&self, choices: &mut Choices<'_>, from: [f64; 3], to: [f64; 2]) -> f64 {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let gradient = match self.grid {
            Some(_) => [0.0, 0.2, -0.2, 0.4, -0.4, 0.8, -0.8][choices.below(7)],
            None => choices.between(-0.98, 0.98),
        };
        from[2] + gradient * self.k * length
    }
}

/// Up to three lines of up to nine vertices, as a reader would give them.
pub(crate) fn raw(choices: &mut Choices<'_>, k: f64) -> RawInput {
    let style = choices.byte();
    let grid = (style & 1 == 0).then_some(if style & 2 == 0 { 2.0 } else { 5.0 });
    let far = if style & 12 == 12 { [500_000.0, 5_400_000.0] } else { [0.0; 2] };
    let hand = Hand { grid, k, far };
    let mut lines: Vec<RawLine> = Vec::new();
    let mut known: Vec<[f64; 3]> = vec![[0.0; 3]];
    let count = 1 + [0, 0, 0, 1, 1, 2][choices.below(6)];
    for i in 0..count {
        let n = 1 + choices.below(8);
        let ring = choices.below(3) == 0;
        // Another line begins at a vertex of one before, or somewhere.
        let mut at = known[choices.below(known.len().min(256))];
        if i > 0 && choices.below(2) == 0 {
            let plan = hand.plan(choices, [at[0], at[1]]);
            at = [plan[0], plan[1], hand.height(choices, at, plan)];
        }
        let mut points = vec![at];
        for _ in 0..n {
            let back = choices.below(16) == 15;
            let next = if back {
                known[choices.below(known.len().min(256))]
            } else {
                let plan = hand.plan(choices, [at[0], at[1]]);
                [plan[0], plan[1], hand.height(choices, at, plan)]
            };
            points.push(next);
            known.push(next);
            at = next;
        }
        let z = at[2];
        if ring {
            // Level rings do not depend on the way round.
            if choices.below(2) == 0 {
                points.iter_mut().for_each(|p| p[2] = z);
            }
            points.push(points[0]);
        }
        let vertex = |p: &[f64; 3]| RawVertex { x: p[0] + hand.far[0], y: p[1] + hand.far[1], z: Some(p[2]), row: None };
        let shape = if ring { RawShape::Ring { polygon: i as u32, hole: false } } else { RawShape::Line };
        let feature = Some(i as u32 + 1);
        lines.push(RawLine { name: None, feature, shape, vertices: points.iter().map(vertex).collect() });
    }
    let source = Source {
        label: "a".to_owned(),
        format: InputFormat::GeoJson,
        bytes: 0,
        sha256: String::new(),
        crs: None,
        kind: CoordinateKind::Unknown,
        unit: None,
    };
    RawInput { source, lines, notes: Vec::new() }
}

/// A line as the program takes it, roads widened, and what to type for it; or what the program says against it.
pub(crate) fn line(choices: &mut Choices<'_>, k: f64, width: Option<f64>) -> Result<(Line, String), String> {
    let raw = raw(choices, k);
    let mut line = validate::check(&raw, &validate::Options::default()).map_err(|e| e.to_string())?.line;
    let mut typed = geojson(&line);
    if let Some(width) = width {
        let fall = [0.0, 0.025, -0.025][choices.below(3)];
        let crossfall = Crossfall { left: fall, right: if choices.below(2) == 0 { fall } else { -fall } };
        typed += &format!("width {width}, {crossfall:?}\n");
        let formation = Formation { width, crossfall, chord: 0.01 / 3.0 };
        line = formation::widen(&line, "a", &formation).map_err(|e| e.to_string())?.line;
    }
    Ok((formation::place(line, "a", 0.01).map_err(|e| e.to_string())?, typed))
}

/// The line as GeoJSON with all its digits, to show what was found with the program itself.
fn geojson(line: &Line) -> String {
    let feature = |chain: &slopegen::model::Chain| {
        let mut positions: Vec<String> = chain.vertices.iter().map(|p| format!("[{},{},{}]", p.x, p.y, p.z)).collect();
        let (kind, open, close) = if chain.closed() { ("Polygon", "[[", "]]") } else { ("LineString", "[", "]") };
        if chain.closed() {
            positions.push(positions[0].clone());
        }
        let coordinates = positions.join(",");
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"{kind}","coordinates":{open}{coordinates}{close}}}}}"#
        )
    };
    let features: Vec<String> = line.chains.iter().map(feature).collect();
    format!("{{\"type\":\"FeatureCollection\",\"features\":[\n{}\n]}}\n", features.join(",\n"))
}
