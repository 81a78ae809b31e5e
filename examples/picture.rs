//! Draws a mesh written by slopegen, with its line work, as a PNG: an oblique view in parallel projection.
//!
//! ```sh
//! cargo run --release --example picture -- finished.obj road.png --lines road_lines.geojson --crop 12 --contours 1
//! ```
//! Options: `--azimuth A` compass bearing of the view in degrees (45 looks to the north-east), `--tilt T` angle of the view
//! below the horizontal, `--width W` pixels, `--crop M` show the works and M length units of ground around them, `--contours DZ`
//! contours of the ground, and of the level curves those that fit between them.
//!
//! Platforms are grey, cut slopes brown, fill slopes yellow, ground green; the line where slopes meet the ground is drawn thick.

use glam::{DVec2, DVec3};
use std::error::Error;
use std::io::BufWriter;

/// The picture is drawn this many times finer each way, then averaged.
const FINE: usize = 4;
/// White margin, as part of the width.
const MARGIN: f64 = 0.03;
/// Towards the light: over the viewer's left shoulder (to the right, ahead, up).
const LIGHT: DVec3 = DVec3::new(-0.58, -0.42, 0.70);
/// Least brightness of a face turned away from the light.
const SHADE: f64 = 0.58;
/// Tints from the lowest to the highest point: few enough to keep the file small, too many to be seen.
const TINTS: f64 = 96.0;
/// Level curves this near to a contour, in length units, are it.
const ON_CONTOUR: f64 = 1e-6;

type Result<T> = std::result::Result<T, Box<dyn Error>>;
type Colour = [f64; 3];

/// A triangle mesh with a colour table number per triangle.
#[derive(Default)]
struct Mesh {
    points: Vec<DVec3>,
    triangles: Vec<([usize; 3], usize)>,
}

/// Kind of the contours of the ground.
const CONTOUR: &str = "contour";

/// Parts in the order of [`palette`].
const PARTS: [&str; 4] = ["platform", "fill_slope", "cut_slope", "ground"];
/// Number of the ground among them.
const GROUND: usize = 3;

/// Colours at the foot and at the top of a part.
fn palette(part: usize) -> [Colour; 2] {
    [
        [[0.80, 0.81, 0.84], [0.84, 0.85, 0.87]],
        [[0.84, 0.68, 0.36], [0.96, 0.84, 0.56]],
        [[0.66, 0.38, 0.27], [0.82, 0.54, 0.41]],
        [[0.70, 0.76, 0.62], [0.87, 0.90, 0.80]],
    ][part]
}

/// Colour, half width in pixels and depth rank of a kind of line; `None`: not drawn.
fn pen(kind: &str) -> Option<(Colour, f64, f64)> {
    match kind {
        CONTOUR => Some(([0.45, 0.52, 0.38], 0.30, 1.0)),
        "level_curve" => Some(([0.24, 0.22, 0.16], 0.34, 1.0)),
        "breakline" => Some(([0.45, 0.46, 0.50], 0.5, 2.0)),
        "ridge" | "valley" => Some(([0.16, 0.16, 0.14], 0.55, 2.0)),
        "boundary" => Some(([0.30, 0.31, 0.24], 0.55, 2.0)),
        "hinge" => Some(([0.10, 0.11, 0.13], 1.1, 3.0)),
        "daylight" => Some(([0.05, 0.20, 0.10], 1.0, 3.0)),
        "zero" => Some(([0.05, 0.20, 0.10], 0.6, 3.0)),
        _ => None,
    }
}

/// What is to be seen.
struct Wish {
    width: f64,
    azimuth: f64,
    tilt: f64,
    crop: Option<f64>,
}

fn main() -> Result<()> {
    let mut args = std::env::args().skip(1);
    let (mut files, mut lines, mut contours) = (Vec::new(), None, None);
    let mut wish = Wish { width: 1200.0, azimuth: 325.0, tilt: 48.0, crop: None };
    while let Some(arg) = args.next() {
        let mut value = || args.next().ok_or_else(|| format!("{arg} needs a value"));
        match arg.as_str() {
            "--lines" => lines = Some(value()?),
            "--width" => wish.width = value()?.parse()?,
            "--azimuth" => wish.azimuth = value()?.parse()?,
            "--tilt" => wish.tilt = value()?.parse()?,
            "--crop" => wish.crop = Some(value()?.parse()?),
            "--contours" => contours = Some(value()?.parse::<f64>()?).filter(|dz| *dz > 0.0),
            _ => files.push(arg),
        }
    }
    let [mesh, png] = &files[..] else { return Err("usage: picture MESH.obj OUT.png [--lines LINES.geojson]".into()) };
    let mesh = read_obj(&std::fs::read_to_string(mesh)?)?;
    let mut lines = lines.map(|path| read_lines(&std::fs::read_to_string(path)?)).transpose()?.unwrap_or_default();
    if let Some(dz) = contours {
        let fits = |points: &[DVec3]| points.iter().all(|p| (p.z / dz - (p.z / dz).round()).abs() * dz < ON_CONTOUR);
        lines.retain(|(kind, points)| kind != "level_curve" || fits(points));
        lines.extend(contours_of_ground(&mesh, dz));
    }
    let view = View::new(&mesh, &wish)?;
    let mut canvas = Canvas::new(view.size);
    draw_mesh(&mut canvas, &view, &mesh);
    // What is thick goes over what is thin.
    let mut pens: Vec<_> = lines.iter().filter_map(|(kind, points)| Some((pen(kind)?, points))).collect();
    pens.sort_by(|(p, _), (q, _)| p.1.total_cmp(&q.1));
    for ((colour, half, rank), points) in pens {
        let seen: Vec<DVec3> = points.iter().map(|&p| view.place(p)).collect();
        seen.windows(2)
            .for_each(|w| canvas.stroke(w[0], w[1], half * FINE as f64 * wish.width / 1200.0, rank * view.lift, colour));
    }
    canvas.save(png)
}

/// Where the triangles of the ground pass the multiples of `dz`, triangle by triangle.
fn contours_of_ground(mesh: &Mesh, dz: f64) -> Vec<(String, Vec<DVec3>)> {
    let mut found = Vec::new();
    for (t, _) in mesh.triangles.iter().filter(|(_, part)| *part == GROUND) {
        let p = t.map(|i| mesh.points[i]);
        let (low, high) = (p[0].z.min(p[1].z).min(p[2].z), p[0].z.max(p[1].z).max(p[2].z));
        for n in (low / dz).ceil() as i64..=(high / dz).floor() as i64 {
            let z = n as f64 * dz;
            let passes = (0..3).map(|i| (p[i], p[(i + 1) % 3])).filter(|(a, b)| (a.z < z) != (b.z < z));
            found.push((CONTOUR.to_owned(), passes.map(|(a, b)| a.lerp(b, (z - a.z) / (b.z - a.z))).collect()));
        }
    }
    found
}

/// Reads vertices, groups and triangles of an OBJ file; other lines are passed over.
fn read_obj(text: &str) -> Result<Mesh> {
    let mut mesh = Mesh::default();
    let mut part = PARTS.len() - 1;
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_ascii_whitespace();
        let bad = || format!("line {}: `{line}` is not understood", i + 1);
        match words.next() {
            Some("v") => {
                let p: Vec<f64> = words.map(str::parse).collect::<std::result::Result<_, _>>()?;
                mesh.points.push(DVec3::from_slice(p.get(..3).ok_or_else(bad)?));
            }
            Some("g") => part = words.next().and_then(|name| PARTS.iter().position(|p| *p == name)).unwrap_or(part),
            Some("f") => {
                let corner = |w: &str| w.split('/').next().unwrap_or(w).parse::<usize>().ok().and_then(|c| c.checked_sub(1));
                let ids: Vec<usize> = words
                    .map(|w| corner(w).filter(|&c| c < mesh.points.len()).ok_or_else(bad))
                    .collect::<std::result::Result<_, _>>()?;
                mesh.triangles.push((ids.try_into().map_err(|_| bad())?, part));
            }
            _ => {}
        }
    }
    Ok(mesh)
}

/// Reads the line strings of a GeoJSON file with their `kind`.
fn read_lines(text: &str) -> Result<Vec<(String, Vec<DVec3>)>> {
    let json: serde_json::Value = serde_json::from_str(text)?;
    let features = json["features"].as_array().ok_or("the line work has no features")?;
    let number = |v: &serde_json::Value| v.as_f64().ok_or("a coordinate is not a number");
    let mut lines = Vec::new();
    for feature in features {
        let mut points = Vec::new();
        for p in feature["geometry"]["coordinates"].as_array().into_iter().flatten() {
            points.push(DVec3::new(number(&p[0])?, number(&p[1])?, number(&p[2])?));
        }
        lines.push((feature["properties"]["kind"].as_str().unwrap_or("").to_owned(), points));
    }
    Ok(lines)
}

/// From the world to the fine raster: x to the right, y down, z away from the viewer, all in fine pixels.
struct View {
    right: DVec3,
    into: DVec3,
    up: DVec3,
    scale: f64,
    shift: DVec3,
    size: [usize; 2],
    heights: [f64; 2],
    /// Lines are drawn this much nearer than the faces they lie on.
    lift: f64,
}

impl View {
    fn new(mesh: &Mesh, wish: &Wish) -> Result<Self> {
        let (sin, cos) = wish.azimuth.to_radians().sin_cos();
        let (dip, level) = wish.tilt.to_radians().sin_cos();
        let ahead = DVec3::new(sin, cos, 0.0);
        let (right, into, up) = (DVec3::new(cos, -sin, 0.0), level * ahead - dip * DVec3::Z, dip * ahead + level * DVec3::Z);
        let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut heights = [f64::INFINITY, f64::NEG_INFINITY];
        for &(t, _) in mesh.triangles.iter().filter(|(_, part)| wish.crop.is_none() || *part != GROUND) {
            for p in t.map(|i| mesh.points[i]) {
                let q = DVec3::new(right.dot(p), -up.dot(p), into.dot(p));
                (lo, hi) = (lo.min(q), hi.max(q));
                heights = [heights[0].min(p.z), heights[1].max(p.z)];
            }
        }
        let fine = wish.width * FINE as f64;
        // Cropped, the picture is filled to its edges; a length on the ground is seen shortened up the picture.
        let (margin, around) = if let Some(m) = wish.crop { (0.0, m) } else { (MARGIN * fine, 0.0) };
        let around = around * DVec3::new(1.0, dip, 0.0);
        (lo, hi) = (lo - around, hi + around);
        let scale = (fine - 2.0 * margin) / (hi.x - lo.x);
        let height = (hi.y - lo.y) * scale + 2.0 * margin;
        let fits = |v: f64| v.is_finite() && v >= FINE as f64 && v < 1e5;
        if !(fits(fine) && fits(height)) {
            return Err("the mesh has no triangles, or the picture no size".into());
        }
        let whole = |v: f64| (v / FINE as f64).ceil() as usize * FINE;
        let shift = DVec3::new(margin - lo.x * scale, margin - lo.y * scale, 0.0);
        Ok(Self { right, into, up, scale, shift, size: [whole(fine), whole(height)], heights, lift: 0.6 * FINE as f64 })
    }

    fn place(&self, p: DVec3) -> DVec3 {
        DVec3::new(self.right.dot(p), -self.up.dot(p), self.into.dot(p)) * self.scale + self.shift
    }
}

/// Colour and depth of every fine pixel.
struct Canvas {
    size: [usize; 2],
    colours: Vec<[f32; 3]>,
    depths: Vec<f64>,
}

impl Canvas {
    fn new(size: [usize; 2]) -> Self {
        let count = size[0] * size[1];
        Self { size, colours: vec![[1.0; 3]; count], depths: vec![f64::INFINITY; count] }
    }

    /// Calls `paint` with the index of each pixel of a box whose centre it is.
    fn over(&self, lo: DVec2, hi: DVec2) -> impl Iterator<Item = (usize, DVec2)> + use<> {
        let [w, h] = self.size;
        let clamp = |v: f64, most: usize| v.clamp(0.0, most as f64) as usize;
        let (x0, x1) = (clamp(lo.x.floor(), w), clamp(hi.x.ceil(), w));
        let (y0, y1) = (clamp(lo.y.floor(), h), clamp(hi.y.ceil(), h));
        (y0..y1).flat_map(move |y| (x0..x1).map(move |x| (y * w + x, DVec2::new(x as f64 + 0.5, y as f64 + 0.5))))
    }

    fn triangle(&mut self, p: [DVec3; 3], colour: impl Fn(DVec3) -> Colour) {
        let [a, b, c] = p.map(|v| v.truncate());
        let area = (b - a).perp_dot(c - a);
        if area == 0.0 {
            return;
        }
        for (i, x) in self.over(a.min(b).min(c), a.max(b).max(c)) {
            let w = DVec3::new((c - b).perp_dot(x - b), (a - c).perp_dot(x - c), (b - a).perp_dot(x - a)) / area;
            let depth = w.dot(DVec3::new(p[0].z, p[1].z, p[2].z));
            if w.min_element() >= 0.0 && depth < self.depths[i] {
                self.depths[i] = depth;
                self.colours[i] = colour(w).map(|v| v as f32);
            }
        }
    }

    /// A line that hides behind faces nearer than itself by more than `lift`.
    fn stroke(&mut self, a: DVec3, b: DVec3, half: f64, lift: f64, colour: Colour) {
        let (p, q) = (a.truncate(), b.truncate());
        for (i, x) in self.over(p.min(q) - half, p.max(q) + half) {
            let along = if p == q { 0.0 } else { ((x - p).dot(q - p) / p.distance_squared(q)).clamp(0.0, 1.0) };
            let depth = a.z + (b.z - a.z) * along - lift;
            // The pixel may show a face that slopes towards the viewer across the width of the line.
            if x.distance(p.lerp(q, along)) <= half && depth <= self.depths[i] + half {
                self.colours[i] = colour.map(|v| v as f32);
            }
        }
    }

    /// Averages the fine pixels and writes the file.
    fn save(&self, path: &str) -> Result<()> {
        let [w, h] = self.size.map(|n| n / FINE);
        let mut bytes = Vec::with_capacity(w * h * 3);
        for (y, x) in (0..h).flat_map(|y| (0..w).map(move |x| (y, x))) {
            for channel in 0..3 {
                let block =
                    (0..FINE * FINE).map(|i| self.colours[(y * FINE + i / FINE) * self.size[0] + x * FINE + i % FINE][channel]);
                bytes.push((block.sum::<f32>() / (FINE * FINE) as f32 * 255.0).round() as u8);
            }
        }
        let mut encoder = png::Encoder::new(BufWriter::new(std::fs::File::create(path)?), w as u32, h as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(&bytes)?;
        Ok(())
    }
}

/// Flat faces in their own colour, lighter with height, darker away from the light.
fn draw_mesh(canvas: &mut Canvas, view: &View, mesh: &Mesh) {
    let [low, high] = view.heights;
    let flat = DVec3::new(view.right.x, view.right.y, 0.0);
    let ahead = DVec3::new(-flat.y, flat.x, 0.0);
    let light = (LIGHT.x * flat + LIGHT.y * ahead + LIGHT.z * DVec3::Z).normalize();
    for &(t, part) in &mesh.triangles {
        let p = t.map(|i| mesh.points[i]);
        let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or(DVec3::Z);
        let bright = SHADE + (1.10 - SHADE) * normal.dot(light).max(0.0);
        let [foot, top] = palette(part);
        canvas.triangle(p.map(|q| view.place(q)), |w| {
            let z = w.dot(DVec3::new(p[0].z, p[1].z, p[2].z));
            let rise = ((z - low) / (high - low).max(f64::MIN_POSITIVE) * TINTS).round().clamp(0.0, TINTS) / TINTS;
            std::array::from_fn(|c| ((foot[c] + (top[c] - foot[c]) * rise) * bright).min(1.0))
        });
    }
}
