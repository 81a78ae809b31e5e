//! What the heads of files tell: names of surfaces, and the point that coordinates are counted from.

use super::BuildJob;
use crate::ground::depths;
use crate::model::{Note, Part, Terrain, Tin};
use crate::write::{MeshFormat, ROUNDING, Target, origin};
use glam::DVec3;
use std::path::Path;

/// Which point the coordinates of meshes for viewers are counted from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LocalOrigin {
    /// [`origin::around`] all meshes of the run that are written about one.
    Auto,
    /// This one, in world coordinates.
    At(DVec3),
}

/// The origin of all meshes of a run that are about one: of those alone, so that none is coarser for what is written beside it.
pub(super) fn local_origin(job: &BuildJob, design: &Tin, finished: Option<&Tin>) -> DVec3 {
    let is_about = |meshes: &[(Target, MeshFormat)]| meshes.iter().any(|(_, format)| is_local(job, *format));
    match job.local_origin {
        Some(LocalOrigin::At(point)) => point,
        _ => {
            let design = Some(design).filter(|_| is_about(&job.meshes));
            origin::around(design.into_iter().chain(finished.filter(|_| is_about(&job.finished))))
        }
    }
}

/// Whether a mesh of this format is about a local origin.
pub(super) fn is_local(job: &BuildJob, format: MeshFormat) -> bool {
    format.is_single() || job.local_origin.is_some() && format.takes_origin()
}

/// Meshes in world coordinates beside which there is a file that tells an origin, left by another run: it does not hold for them.
pub(super) fn stale_origins(job: &BuildJob) -> impl Iterator<Item = Note> {
    let world = job.meshes.iter().chain(&job.finished).filter(|(_, format)| format.takes_origin() && !is_local(job, *format));
    let beside = world.filter_map(|(target, _)| match target {
        Target::File(path) => Some(origin::sidecar(path)).filter(|sidecar| sidecar.is_file()),
        Target::Stdout => None,
    });
    beside.map(|sidecar| {
        let message =
            format!("`{}` is of an earlier run: the mesh beside it is in world coordinates now; delete it", sidecar.display());
        Note::new("origin-stale", message)
    })
}

/// Whether a mesh is coloured by its height over ground.
pub(super) fn has_colours(job: &BuildJob) -> bool {
    job.ground.is_some() && job.meshes.iter().chain(&job.finished).any(|(_, format)| *format == MeshFormat::Glb)
}

/// Height over ground of the vertices of the works; NaN at those of ground alone. `None` if the two are in different frames.
pub(super) fn heights_over(tin: &Tin, ground: &Terrain) -> Option<Vec<f64>> {
    if tin.frame != ground.frame {
        return None;
    }
    let mut of_works = vec![false; tin.vertices.len()];
    for (triangle, _) in tin.triangles.iter().zip(&tin.parts).filter(|(_, part)| **part != Part::Ground) {
        triangle.iter().for_each(|&v| of_works[v as usize] = true);
    }
    let numbers: Vec<usize> = (0..of_works.len()).filter(|&v| of_works[v]).collect();
    let vertices = numbers.iter().map(|&v| tin.vertices[v]).collect();
    let works = Tin { frame: tin.frame, vertices, triangles: Vec::new(), parts: Vec::new() };
    let mut heights = vec![f64::NAN; tin.vertices.len()];
    for (v, height) in numbers.into_iter().zip(depths(&works, ground)) {
        heights[v] = height;
    }
    Some(heights)
}

/// Names of the surfaces in the files that hold names.
pub(super) struct Names {
    pub(super) design: String,
    pub(super) finished: String,
    pub(super) ground: String,
}

impl Names {
    /// From the names of the input files; `design` for standard input.
    pub(super) fn of(job: &BuildJob) -> Self {
        let stem = |path: &Path| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let line = Some(job.input.path.as_path()).filter(|path| *path != Path::new("-"));
        let design = line.and_then(stem).unwrap_or_else(|| "design".to_owned());
        let ground = job.ground.as_ref().and_then(|ground| stem(&ground.path)).unwrap_or_else(|| "ground".to_owned());
        Self { finished: format!("{design} finished ground"), design, ground }
    }
}

/// Errors of coordinates that are told, in the length unit: a millimetre, if that is the metre.
const TOLD: f64 = 0.001;

/// What single precision does to the coordinates of meshes, where it does too much: of the one it does most to.
pub(super) fn coarse<'a>(job: &'a BuildJob, design: &Tin, finished: Option<&Tin>, local: DVec3) -> Option<Note> {
    let single =
        |meshes: &'a [(Target, MeshFormat)]| meshes.iter().find(|(_, format)| format.is_single()).map(|(target, _)| target);
    let furthest = |tin: &Tin| (0..tin.vertices.len()).map(|i| (tin.world(i) - local).abs().max_element()).fold(0.0, f64::max);
    let design = single(&job.meshes).map(|target| (target, furthest(design)));
    let finished = single(&job.finished).zip(finished.map(furthest));
    let (target, furthest) = design.into_iter().chain(finished).max_by(|a, b| a.1.total_cmp(&b.1))?;
    // The step between neighbouring numbers is the same from one power of two to the next.
    let error = furthest.log2().floor().exp2() * ROUNDING;
    (error > TOLD).then(|| {
        let message = format!(
            "coordinates in `{target}` are off by up to {error:.4}: it holds single-precision numbers, up to {furthest:.0} from its \
             origin; write `.obj` or `.ply` for all digits"
        );
        Note::new("single-precision", message)
    })
}
