//! The steps from a line and a design to the mesh with its figures, in their order.

use super::body::Body;
use super::ends::{END_TIE, Ends};
use super::error_bound::Moves;
use super::solve::{self, Ask, Solved};
use super::{Areas, Surface, SurfaceError, Watch, buried, certificate, curves, feet, flats, room};
use crate::mesh::check::HalfEdges;
use crate::model::{Design, Line, Memory};
use crate::slope::closure::{FINER_SNAP, SNAP};
use crate::slope::cover::Covers;
use crate::slope::emit;
use crate::slope::fan::Fans;
use crate::slope::levels::Levels;
use crate::slope::network::Network;
use crate::slope::refine::Cut;
use crate::slope::size;
use crate::slope::trim::{self, Sheet};

/// Share of the tolerance that simplifying the line may use.
const SIMPLIFY_SHARE: f64 = 1.0 / 3.0;

/// Share of the tolerance that chords of cones may use. The rest is reserve.
pub(super) const CHORD_SHARE: f64 = 1.0 / 3.0;

/// Share of the tolerance by which another sheet may be higher than what is built.
const CLEAR_SHARE: f64 = 0.125;

/// The plane for volumes, where one was given.
pub(super) struct Plane {
    pub(super) reference: Option<f64>,
}

/// Builds the surface; line work and figures of the whole only with a plane.
pub(super) fn made(line: &Line, design: &Design, plane: Option<&Plane>, watch: &dyn Watch) -> Result<Surface, SurfaceError> {
    let k = design.slope.ratio();
    let go_on = |stage| {
        watch.stage(stage);
        if watch.cancelled() { Err(SurfaceError::Cancelled) } else { Ok(()) }
    };
    go_on("line")?;
    room::for_line(line, &watch.memory())?;
    let network = Network::new(line, design, SIMPLIFY_SHARE * design.tolerance);
    if !network.edges.iter().any(|e| e.wanted[0] || e.wanted[1]) {
        return Err(SurfaceError::NoSide);
    }
    let ends = Ends::new(&network, line, design)?;
    let levels = ends.levels(design, network.sign)?;
    go_on("index")?;
    let fans = Fans::new(&network, k);
    let index = trim::index_of(&network, k);
    let sheet = Sheet::new(&network, &fans, &index, k, ends.closure);
    let covers = Covers::find(&sheet);
    let buried = buried::stretches(line, &sheet, &covers);
    flats::refuse_covered(line, design, &network, &buried)?;
    let task = Task {
        line,
        design,
        plane,
        network: &network,
        ends: &ends,
        levels: &levels,
        sheet: &sheet,
        covers: &covers,
        buried: &buried,
        memory: watch.memory(),
    };
    let made = |snap: f64| {
        go_on("creases")?;
        let ask = Ask { sheet: &sheet, covers: &covers, snap, slack: CLEAR_SHARE * design.tolerance };
        task.meshed(&solve::solve(ask, watch)?, &go_on)
    };
    match made(SNAP) {
        Err(SurfaceError::Crowded) => Err(SurfaceError::Crowded),
        // Vertices taken for one may turn over the tips of very narrow strips.
        Err(flaw) if flaw.is_flaw() => match made(FINER_SNAP) {
            Err(finer) if finer.is_flaw() => Err(flaw),
            finer => finer,
        },
        made => made,
    }
}

/// What a mesh is made for.
struct Task<'a> {
    line: &'a Line,
    design: &'a Design,
    plane: Option<&'a Plane>,
    network: &'a Network,
    ends: &'a Ends,
    levels: &'a Levels,
    sheet: &'a Sheet<'a>,
    covers: &'a Covers,
    buried: &'a buried::Found,
    memory: Memory,
}

impl Task<'_> {
    /// The mesh of a closed sheet, with its figures.
    fn meshed(
        &self,
        solved: &Solved,
        go_on: &impl Fn(&'static str) -> Result<(), SurfaceError>,
    ) -> Result<Surface, SurfaceError> {
        let Self { line, design, plane, network, ends, levels, sheet, covers, buried, memory } = *self;
        go_on("mesh")?;
        let cut = Cut { levels, chord: CHORD_SHARE * design.tolerance, reach: ends.reach };
        room::for_mesh(line, size::least_triangles(sheet, &solved.closure, &solved.arcs, &cut), &memory)?;
        let mut slopes = emit::emit(sheet, &solved.closure, &solved.arcs, &cut);
        for p in slopes.points.iter_mut().filter(|p| (p.z - ends.closure).abs() <= END_TIE) {
            // Undoes [`END_TIE`]: the slope ends where it was asked to. (Ends at a distance lie well above the closure.)
            p.z = ends.lowest;
        }
        if let Some(&f) = slopes.failed.first() {
            let p = network.world(sheet.facet(f).foot(0.0));
            return Err(SurfaceError::Unsound { what: format!("a strip at ({:.3}, {:.3}) could not be triangulated", p.x, p.y) });
        }
        room::for_mesh(line, slopes.triangles.len() as u64, &memory)?;
        let flats = flats::fill(line, design, network, &mut slopes)?;
        go_on("certificate")?;
        let body = Body::new(network, design, &slopes, &flats);
        let ((feet, foot_of), (marks, edges)) = rayon::join(
            || feet::of_triangles(line, sheet, &slopes),
            || rayon::join(|| body.marks(network, design), || HalfEdges::new(body.tin.vertices.len(), &body.tin.triangles)),
        );
        drop(slopes);
        let heights: Vec<f64> = levels.heights.iter().map(|c| network.sign * c).collect();
        let open = edges.open();
        let (certificate, lines) = rayon::join(
            || certificate::measure(line, design, sheet, &body, &edges, &open, covers),
            || plane.map_or_else(Vec::new, |_| curves::lines(line, &heights, &body.tin, &marks, &open)),
        );
        let certificate = certificate?;
        drop(edges);
        let (areas, volumes) = if let Some(&Plane { reference }) = plane {
            go_on("volumes")?;
            rayon::join(
                || Areas::of(&body.tin),
                || {
                    let moves = Moves::new(line, design, network.simplified_max);
                    body.volumes(reference.unwrap_or_else(|| ends.reference(line, design)), &moves, &open)
                },
            )
        } else {
            Default::default()
        };
        let mut notes = flats.notes;
        notes.extend(buried.below_note(design));
        Ok(Surface {
            lines,
            marks,
            feet,
            foot_of,
            platform_stations: body.stations,
            levels: heights,
            simplified: network.simplified,
            collinear: network.collinear,
            simplified_max: network.simplified_max,
            buried: buried.stretches.clone(),
            certificate,
            areas,
            volumes,
            notes,
            tin: body.tin,
        })
    }
}
