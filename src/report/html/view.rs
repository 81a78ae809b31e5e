//! What the 3D view shows, as a block of data for `viewer.js`.

use super::bytes;
use super::soup::Soup;
use crate::kernel::plan_box::PlanBox;
use crate::mesh::drape::Drape;
use crate::model::{CurveKind, LineFeature, Part, Tin};
use crate::plot::{OnGround, Scene};
use crate::write::EncodeError;
use glam::DVec3;
use rustc_hash::FxHashMap;
use serde_json::{Map, Value, json};

/// Triangles of the works and of the ground around them that a page carries; more are thinned. Some 30 bytes each, so that a page
/// can still be sent by mail.
pub(super) const MOST_TRIANGLES: [usize; 2] = [200_000, 100_000];

/// Segments of line work that a page carries; whole kinds are left out beyond. Some 32 bytes each.
const MOST_SEGMENTS: usize = 150_000;

/// How far the ground is shown around the works, as a share of the longer side of their plan box.
const AROUND: f64 = 0.3;

/// Share of the plan area of the works that may lie over no ground before they are shown apart.
const COVERED: f64 = 1e-6;

/// Line work from what matters most to what is left out first.
const KINDS: [CurveKind; 8] = [
    CurveKind::Hinge,
    CurveKind::Daylight,
    CurveKind::Boundary,
    CurveKind::Zero,
    CurveKind::Breakline,
    CurveKind::LevelCurve,
    CurveKind::Valley,
    CurveKind::Ridge,
];

/// The data, and what is to be said of it.
pub(super) struct View {
    /// JSON without `<`, so that it can stand in a page.
    pub(super) data: String,
    /// What was left out.
    pub(super) notes: Vec<String>,
}

/// The view of a scene; none if there is nothing to see. `most` bounds the triangles of works and ground.
///
/// # Errors
/// [`EncodeError::BeyondSingle`].
pub(super) fn view(
    scene: &Scene<'_>,
    deepest: [f64; 2],
    [most_works, most_ground]: [usize; 2],
) -> Result<Option<View>, EncodeError> {
    let design = scene.design;
    if design.vertices.is_empty() {
        return Ok(None);
    }
    let around = design.plan_box();
    let lowest = design.vertices.iter().map(|v| v.z).fold(f64::INFINITY, f64::min);
    // On whole numbers, so that the readout of the view adds nothing odd.
    let origin = around.middle().extend(lowest).round();
    let unit = scene.unit.label();
    let mut notes = Vec::new();
    let mut thin = |soup: &mut Soup, what: &str, most: usize| {
        let count = soup.triangles.len();
        if let Some(cell) = soup.thin(most) {
            notes.push(format!(
                "The {what} in this view is thinned to cells of {cell:.2} {unit}: it has {count} triangles here, and a page carries \
                 {most}. All figures are those of the full meshes."
            ));
        }
    };
    let mut data = Map::new();
    let mut put = |name: &str, soup: &Soup| -> Result<(), EncodeError> {
        if !soup.triangles.is_empty() {
            data.insert(name.to_owned(), mesh(soup, origin)?);
        }
        Ok(())
    };
    match &scene.ground {
        Some(ground) => {
            let (mut works, missing) = pieces(design, ground, around);
            thin(&mut works, "mesh of the works", most_works);
            put("works", &works)?;
            if missing {
                let mut bare =
                    Soup { vertices: design.vertices.clone(), values: Vec::new(), triangles: design.triangles.clone() };
                thin(&mut bare, "design", most_works);
                put("bare", &bare)?;
            }
            let margin = AROUND * around.size().max_element();
            let shown = PlanBox { lo: around.lo - margin, hi: around.hi + margin };
            let mut before = Soup::clipped(&ground.terrain.vertices, &ground.terrain.triangles, shown);
            thin(&mut before, "existing ground", most_ground);
            put("ground", &before)?;
        }
        None => {
            let mut works = by_part(design);
            thin(&mut works, "mesh of the works", most_works);
            put("works", &works)?;
        }
    }
    let (lines, dropped) = lines(scene, origin)?;
    if !dropped.is_empty() {
        notes.push(format!(
            "Line work left out of this view, because there is too much of it: {}. The file of `--lines` has all.",
            dropped.join(", ")
        ));
    }
    let world = design.frame.to_world(origin);
    data.insert("unit".to_owned(), unit.into());
    data.insert("origin".to_owned(), json!(world.to_array()));
    data.insert("onGround".to_owned(), scene.ground.is_some().into());
    data.insert("most".to_owned(), json!(deepest));
    data.insert("lines".to_owned(), lines);
    Ok(Some(View { data: Value::Object(data).to_string().replace('<', "\\u003c"), notes }))
}

fn mesh(soup: &Soup, origin: DVec3) -> Result<Value, EncodeError> {
    let mut mesh = Map::new();
    mesh.insert("position".to_owned(), bytes::points(&soup.vertices, origin)?.into());
    if !soup.values.is_empty() {
        mesh.insert("value".to_owned(), bytes::numbers(soup.values.iter().copied())?.into());
    }
    mesh.insert("index".to_owned(), bytes::indices(&soup.triangles).into());
    Ok(Value::Object(mesh))
}

/// The works with design minus ground at each corner, linear over each triangle; and whether some of the design is beside them,
/// because it lies over no ground.
fn pieces(design: &Tin, on: &OnGround<'_>, around: PlanBox) -> (Soup, bool) {
    let ground = Drape::new(&on.terrain.vertices, &on.terrain.triangles, Some(around));
    let mut soup = Soup::default();
    let mut numbers: FxHashMap<[u64; 2], u32> = FxHashMap::default();
    let mut outline = Vec::new();
    let mut area = 0.0;
    for piece in on.pieces.iter() {
        outline.clear();
        for corner in piece.corners {
            let key = [corner.at.x.to_bits(), corner.at.y.to_bits()];
            let number = numbers.get(&key).copied().or_else(|| {
                let (z, _) = ground.at(corner.at)?;
                let number = soup.vertices.len() as u32;
                soup.vertices.push(corner.at.extend(z + corner.height));
                soup.values.push(corner.height);
                numbers.insert(key, number);
                Some(number)
            });
            outline.extend(number);
        }
        for i in 2..outline.len() {
            let triangle = [outline[0], outline[i - 1], outline[i]];
            let [a, b, c] = triangle.map(|v| soup.vertices[v as usize].truncate());
            area += 0.5 * (b - a).perp_dot(c - a);
            soup.triangles.push(triangle);
        }
    }
    let plan = |t| {
        let [a, b, c] = design.corners(t).map(|v| v.truncate());
        0.5 * (b - a).perp_dot(c - a)
    };
    let whole: f64 = (0..design.triangles.len()).map(plan).sum();
    let missing = area < (1.0 - COVERED) * whole;
    (soup, missing)
}

/// The mesh with the number of its part at each vertex: vertices between parts are there once for each.
fn by_part(design: &Tin) -> Soup {
    let mut soup = Soup::default();
    let mut numbers: FxHashMap<(u32, Part), u32> = FxHashMap::default();
    for (triangle, &part) in design.triangles.iter().zip(&design.parts) {
        soup.triangles.push(triangle.map(|v| {
            *numbers.entry((v, part)).or_insert_with(|| {
                soup.vertices.push(design.vertices[v as usize]);
                soup.values.push(f64::from(part as u8));
                (soup.vertices.len() - 1) as u32
            })
        }));
    }
    soup
}

/// Line work as pairs of ends, and the names of the kinds that were left out.
fn lines(scene: &Scene<'_>, origin: DVec3) -> Result<(Value, Vec<&'static str>), EncodeError> {
    let (mut shown, mut dropped) = (Vec::new(), Vec::new());
    let mut room = MOST_SEGMENTS;
    for kind in KINDS {
        let features = || scene.lines.iter().filter(|line: &&LineFeature| line.kind == kind);
        let count: usize = features().map(|line| line.points.len().saturating_sub(1)).sum();
        if count == 0 {
            continue;
        }
        if count > room {
            dropped.push(title(kind));
            continue;
        }
        room -= count;
        let local = |p: &DVec3| scene.design.frame.to_local(*p);
        let ends: Vec<DVec3> = features().flat_map(|line| line.points.windows(2)).flatten().map(local).collect();
        shown.push(json!({ "kind": kind.name(), "ends": bytes::points(&ends, origin)? }));
    }
    Ok((shown.into(), dropped))
}

/// A kind in the words of the page, plural where there are many.
fn title(kind: CurveKind) -> &'static str {
    match kind {
        CurveKind::LevelCurve => "level curves",
        CurveKind::Ridge => "ridges",
        CurveKind::Valley => "valleys",
        CurveKind::Hinge => "hinge",
        CurveKind::Breakline => "breaklines",
        CurveKind::Boundary => "boundary",
        CurveKind::Daylight => "daylight line",
        CurveKind::Zero => "zero line",
    }
}
