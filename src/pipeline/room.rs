//! How much memory the stages of a job take, told before they begin.
//!
//! Each figure is the peak of the whole process in a stage, from numbers known at its beginning. The factors were measured and
//! rounded up: see "Memory" in `docs/performance.md`.

use super::{BuildJob, Error};
use crate::model::{Memory, Need, Terrain, Tin};
use crate::read::terrain::{RawFaces, RawGround};
use crate::write::{MeshFormat, RasterFormat, Target};

/// A vertex: three doubles.
const VERTEX: u64 = 24;
/// A triangle: three numbers of 32 bits.
const TRIANGLE: u64 = 12;

/// Making a TIN of ground as read.
pub(super) fn for_preparing(ground: &RawGround, label: &str, memory: &Memory) -> Result<(), Error> {
    /// Of a point that is triangulated.
    const PER_POINT: u64 = 200;
    /// Of a cell of a grid: vertex and two triangles, and what numbers and checks them.
    const PER_CELL: u64 = 88;
    /// Of a vertex and of a triangle while faces are checked.
    const PER_VERTEX: u64 = 32;
    const PER_TRIANGLE: u64 = 20;
    let (bytes, figures) = match ground {
        RawGround::Points(points) => (PER_POINT * points.len() as u64, format!("{} points", points.len())),
        RawGround::Grid(grid) => (PER_CELL * grid.heights.len() as u64, format!("{} cells", grid.heights.len())),
        RawGround::Mesh { vertices, faces } => {
            let corners = match faces {
                RawFaces::Triangles(triangles) => 3 * triangles.len(),
                RawFaces::Polygons { corners, .. } => 2 * corners.len(),
            };
            let bytes = PER_VERTEX * vertices.len() as u64 + PER_TRIANGLE * corners as u64 / 3;
            (bytes, format!("{} vertices and {} faces", vertices.len(), faces.len()))
        }
    };
    room(memory, bytes, "prepare the ground", label, figures, SMALLER)
}

/// Looking at how the triangles of ground as read lie together; `points`: vertices held as those of a line, too.
pub(super) fn for_inspecting(ground: &RawGround, points: usize, label: &str, memory: &Memory) -> Result<(), Error> {
    /// Of a triangle, its share of the vertices included.
    const PER_TRIANGLE: u64 = 84;
    /// Of a vertex of a line.
    const PER_POINT: u64 = 48;
    let triangles = match ground {
        RawGround::Points(points) => 2 * points.len(),
        RawGround::Grid(grid) => 2 * grid.heights.len(),
        RawGround::Mesh { faces, .. } => faces.len(),
    };
    // Points are triangulated first.
    let first = for_preparing(ground, label, &memory.holding(PER_POINT * points as u64));
    let bytes = PER_TRIANGLE * triangles as u64 + PER_POINT * points as u64;
    let figures = format!("its {triangles} triangles");
    first.and_then(|()| room(memory, bytes, "look at the ground", label, figures, SMALLER))
}

/// Cutting a design off at ground that is held, with what is made of the ground then.
pub(super) fn for_works(job: &BuildJob, ground: &Terrain, label: &str, memory: &Memory) -> Result<(), Error> {
    /// Of a triangle of the ground: near the works, in the finished ground, and as arrays of a GLB file with a colour for each
    /// vertex.
    const PER_TRIANGLE: u64 = 40;
    const FINISHED: u64 = 30;
    const AS_GLB: u64 = 58;
    /// Where heights of the ground are looked up: for drawings, for stakes and colours, for a page with a 3D view.
    const DRAWN: u64 = 40;
    const LOOKED_UP: u64 = 62;
    const PAGE: u64 = 135;
    let is_glb = |(_, format): &(Target, MeshFormat)| *format == MeshFormat::Glb;
    let (wanted, glb) = (job.wants_finished(), job.finished.iter().any(is_glb));
    let page = job.reports.iter().any(|(_, format)| format.draws());
    let drawn = match job.plots.is_empty() {
        _ if page => PAGE,
        _ if !job.stakes.is_empty() || job.meshes.iter().any(is_glb) => LOOKED_UP,
        false => DRAWN,
        true => 0,
    };
    let per = PER_TRIANGLE + if wanted { FINISHED } else { 0 } + if glb { AS_GLB } else { 0 } + drawn;
    let triangles = ground.triangles.len();
    let help = match (glb, wanted, page) {
        (true, ..) => "write the finished ground as `.ply`",
        (_, _, true) => "write the report as `.md` or `.json`, and drawings with `--plot`",
        (_, true, _) => "leave out `--finished`, or cut out the part around the works",
        _ => SMALLER,
    };
    room(memory, per * triangles as u64, "cut the ground", label, format!("its {triangles} triangles"), help)
}

/// The volumes between meshes that are held, or one of them and a level.
pub(super) fn for_overlay(triangles: usize, label: &str, memory: &Memory) -> Result<(), Error> {
    /// Of a triangle: neighbours, order and boxes.
    const PER_TRIANGLE: u64 = 66;
    let bytes = PER_TRIANGLE * triangles as u64;
    room(memory, bytes, "compare the surfaces", label, format!("{triangles} triangles"), "compare a smaller part of them")
}

/// Looking at how the triangles of a mesh lie together, its own included.
pub(super) fn for_checking(vertices: usize, corners: usize, label: &str, memory: &Memory) -> Result<(), Error> {
    /// Of a triangle.
    const PER_TRIANGLE: u64 = 74;
    let triangles = corners / 3;
    let bytes = VERTEX * vertices as u64 + (TRIANGLE + PER_TRIANGLE) * triangles as u64;
    room(memory, bytes, "check the mesh", label, format!("its {triangles} triangles"), "check a smaller part of it")
}

/// A raster.
pub(super) fn for_raster(cells: u64, formats: &[RasterFormat], label: &str, memory: &Memory) -> Result<(), Error> {
    // The heights; packed once more as bytes.
    let packed = formats.iter().any(|format| *format != RasterFormat::Asc);
    let per = if packed { 17 } else { 9 };
    let help = if packed { "give a larger `--cell`, or write `.asc`" } else { "give a larger `--cell`" };
    room(memory, per * cells, "make the raster", label, format!("its {cells} cells"), help)
}

/// Heights at points of a file of so many bytes.
pub(super) fn for_points(points: usize, bytes: u64, label: &str, memory: &Memory) -> Result<(), Error> {
    /// Of a point: as read, in plan, its height.
    const PER_POINT: u64 = 88;
    let help = "ask for fewer points at a time";
    room(memory, bytes + PER_POINT * points as u64, "find the heights", label, format!("its {points} points"), help)
}

/// Drawings of a design that is held.
pub(super) fn for_drawings(design: &Tin, label: &str, memory: &Memory) -> Result<(), Error> {
    /// Of a triangle of the design.
    const PER_TRIANGLE: u64 = 125;
    let triangles = design.triangles.len();
    let help = "leave out drawings and pages (`--plot`, `.html`), or raise `--interval` or `--tolerance`";
    room(memory, PER_TRIANGLE * triangles as u64, "draw the surface", label, format!("its {triangles} triangles"), help)
}

/// Bytes of a mesh with its line work.
pub(super) fn of_tin(tin: &Tin) -> u64 {
    /// Beside its corners, of a triangle: part, marks, line work.
    const MORE: u64 = 130;
    VERTEX * tin.vertices.len() as u64 + (TRIANGLE + MORE) * tin.triangles.len() as u64
}

/// Bytes of ground.
pub(super) fn of_ground(ground: &Terrain) -> u64 {
    VERTEX * ground.vertices.len() as u64 + TRIANGLE * ground.triangles.len() as u64
}

/// What a smaller ground is.
const SMALLER: &str = "cut out the part around the works";

fn room(memory: &Memory, bytes: u64, what: &'static str, at: &str, figures: String, help: &'static str) -> Result<(), Error> {
    Ok(memory.room(bytes, || Need { what, at: at.to_owned(), figures, help })?)
}
