//! The finished surface: everything about one line and one design, from the network to the certificate.

mod body;
mod buried;
mod certificate;
pub mod curves;
mod feet;
mod flats;
mod formation;
mod room;
mod solve;
mod stations;
mod touching;

pub(crate) use body::Moves;
pub use buried::Buried;
pub use certificate::Certificate;
pub(crate) use certificate::{CONE_BOUND, Deviations, MEASURABLE_HEIGHT, STRIP_BOUND, flaw};
pub use curves::Mark;
pub use feet::Foot;
pub(crate) use touching::{in_spite_of_touching, note as joggle_note};

use crate::kernel::sum::Sum;
use crate::mesh::check::HalfEdges;
use crate::mesh::region::RegionError;
use crate::mesh::volume;
use crate::model::{Design, Extent, Line, LineFeature, Memory, Note, Part, Sheet as SheetKind, Tin, TooLarge};
use crate::slope::closure::{FINER_SNAP, SNAP};
use crate::slope::cover::Covers;
use crate::slope::emit::{self, Slopes};
use crate::slope::facet::Kind;
use crate::slope::fan::Fans;
use crate::slope::levels::{self, Levels};
use crate::slope::network::Network;
use crate::slope::refine::Cut;
use crate::slope::size;
use crate::slope::trim::{self, Sheet};
use body::Body;

use solve::{Ask, Solved};

/// Share of the tolerance that simplifying the line may use.
const SIMPLIFY_SHARE: f64 = 1.0 / 3.0;

/// Share of the tolerance that chords of cones may use. The rest is reserve.
const CHORD_SHARE: f64 = 1.0 / 3.0;

/// Share of the tolerance by which another sheet may be higher than what is built.
const CLEAR_SHARE: f64 = 1.0 / 8.0;

/// How far beyond the outer distance the sheet is followed, relative to its depth there and at least this many length units.
const BEYOND_REACH: f64 = 1e-3;

/// The end of the slope is taken this much lower (length units): a crease that runs exactly there is then the end on both of its
/// sides alike.
const END_TIE: f64 = 1e-11;

/// Why there is no surface. Places are plan coordinates in the world.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// The whole line lies beyond the end of the slope.
    #[error(
        "no part of the line lies {} elevation {end}\n   = the line lies between {low} and {high}\n   = help: choose an elevation {} {high_or_low}",
        if *.rising { "below" } else { "above" }, if *.rising { "above" } else { "below" }, high_or_low = if *.rising { low } else { high }
    )]
    NothingToBuild {
        /// Where the slope was to end.
        end: f64,
        /// Lowest elevation of the line.
        low: f64,
        /// Highest elevation of the line.
        high: f64,
        /// Whether the slope rises.
        rising: bool,
    },
    /// No side of any line is wanted.
    #[error(
        "there is no side to build on\n   = `inside` and `outside` need a ring\n   = help: close the line (`--closed`), or choose `--side left`, `right` or `both`"
    )]
    NoSide,
    /// The interval asks for too many levels.
    #[error("an interval of {interval} would give {count:.0} levels\n   = at most {limit} are cut\n   = help: use an interval of {least} or more", limit = levels::MAX_LEVELS)]
    TooManyLevels {
        /// The interval asked for.
        interval: f64,
        /// How many levels that would be.
        count: f64,
        /// The least interval that works.
        least: f64,
    },
    /// A platform lies below the slope of another part.
    #[error(
        "the slope of one part covers the platform of another near ({x:.3}, {y:.3})\n   = {what}\n   = help: build the parts one by one, move them apart, or use a steeper slope"
    )]
    PlatformCovered {
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// The covered stretch in words.
        what: String,
    },
    /// A line runs over the platform of a ring.
    #[error(
        "`{name}` runs over a platform near ({x:.3}, {y:.3})\n   = its slopes would pass over the platform\n   = help: shape the platform \
         with it (a breakline), or build the two one by one"
    )]
    LineOnPlatform {
        /// The line.
        name: String,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
    },
    /// Slopes inside a ring pass over another place of it, and would go on outside.
    #[error("the slopes inside a ring pass over its own edge near ({x:.3}, {y:.3})\n   = {what}\n   = help: {cure}")]
    RimCovered {
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// The covered stretch in words.
        what: String,
        /// What helps.
        cure: String,
    },
    /// The slopes inside a ring end at an elevation that the ring itself goes beyond.
    #[error(
        "the floor would pass over the edge of its ring near ({x:.3}, {y:.3})\n   = {what}\n   = help: end {beyond} {limit}, or at a \
         height or distance from the line"
    )]
    RimBeyondEnd {
        /// Place of the lowest vertex of the ring (highest, of rising slopes).
        x: f64,
        /// Place.
        y: f64,
        /// The stretch in words.
        what: String,
        /// Below or above.
        beyond: &'static str,
        /// Elevation of that vertex.
        limit: f64,
    },
    /// An outline could not be filled.
    #[error(
        "the {part} cannot be triangulated near ({x:.3}, {y:.3}): {cause}\n   = help: try another `--tolerance`; this is a limit of the \
         program, please report the line"
    )]
    Flat {
        /// Platform or floor.
        part: &'static str,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// What is wrong.
        cause: RegionError,
    },
    /// The facets do not glue to one surface.
    #[error(
        "the surface could not be closed near ({x:.3}, {y:.3})\n   = {unpaired} of {arcs} pieces of creases have no counterpart\n   = help: try another `--tolerance`; this is a limit of the program, please report the line"
    )]
    Unclosed {
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// Creases without a counterpart.
        unpaired: usize,
        /// All creases.
        arcs: usize,
    },
    /// The mesh failed its own check.
    #[error(
        "the mesh failed its check: {what}\n   = help: try another `--tolerance`; this is a limit of the program, please report the line"
    )]
    Unsound {
        /// Which figure is out of bounds.
        what: String,
    },
    /// The mesh would take more memory than it may.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The caller asked to stop.
    #[error("interrupted")]
    Cancelled,
}

/// What a long run tells its caller.
pub trait Watch: Sync {
    /// A stage begins.
    fn stage(&self, _name: &'static str) {}

    /// Whether to stop.
    fn cancelled(&self) -> bool {
        false
    }

    /// How much memory the run may take.
    fn memory(&self) -> Memory {
        Memory::default()
    }
}

/// Nobody watches.
impl Watch for () {}

/// Plan and true areas.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Areas {
    /// Plan area of everything.
    pub plan: f64,
    /// True area of everything.
    pub slope: f64,
    /// True area of falling slopes.
    pub fill_slope: f64,
    /// True area of rising slopes.
    pub cut_slope: f64,
    /// True area of platforms and floors.
    pub platform: f64,
}

impl Areas {
    /// The areas of a mesh, by its parts.
    pub fn of(tin: &Tin) -> Self {
        let mut plan = Sum::default();
        let mut parts = [Sum::default(); 4];
        for (t, &part) in tin.parts.iter().enumerate() {
            let [a, b, c] = tin.corners(t);
            plan.add(volume::plan_area([a, b, c]));
            parts[part as usize].add(0.5 * (b - a).cross(c - a).length());
        }
        let of = |part: Part| parts[part as usize].value();
        let (platform, fill_slope, cut_slope) = (of(Part::Platform), of(Part::FillSlope), of(Part::CutSlope));
        Self { plan: plan.value(), slope: platform + fill_slope + cut_slope, fill_slope, cut_slope, platform }
    }
}

/// Volumes against a horizontal plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Volumes {
    /// Volume where the surface lies below the plane.
    pub cut: f64,
    /// Volume where it lies above.
    pub fill: f64,
    /// Bound for the error of either through simplification and chords.
    pub error_bound: f64,
    /// Elevation of the plane.
    pub reference: f64,
    /// Greatest depth below the plane.
    pub cut_max: f64,
    /// Greatest height above it.
    pub fill_max: f64,
}

/// Where a platform vertex of a road stands on the centre line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlatformStation {
    /// The mesh vertex.
    pub vertex: u32,
    /// The chain: a road.
    pub chain: u32,
    /// Station on its centre line.
    pub station: f64,
}

/// A surface of constant slope with its platform, and what was measured on it.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The mesh.
    pub tin: Tin,
    /// Level curves, creases, hinge and boundary.
    pub lines: Vec<LineFeature>,
    /// Mesh edges that are more than diagonals, lower vertex first, in order. Levels are numbered as in `levels`.
    pub marks: Vec<(Mark, [u32; 2])>,
    /// The facets that slope triangles lie in.
    pub feet: Vec<Foot>,
    /// The facet of each slope triangle, an index into `feet`; slope triangles come first in the mesh.
    pub foot_of: Vec<u32>,
    /// Platform vertices of roads (chains with an axis) with their stations on the centre line, by vertex and chain. The stations
    /// of a point of a platform triangle are those of its corners, linear between them.
    pub platform_stations: Vec<PlatformStation>,
    /// Elevations of the level curves, from the top down.
    pub levels: Vec<f64>,
    /// Given vertices moved onto a chord.
    pub simplified: usize,
    /// Given vertices that lie on the straight line between their neighbours.
    pub collinear: usize,
    /// Largest displacement of a simplified vertex, `|Δz| + k·|Δplan|`.
    pub simplified_max: f64,
    /// Stretches of the line below the slope of another part.
    pub buried: Vec<Buried>,
    /// What was measured on the mesh.
    pub certificate: Certificate,
    /// Areas.
    pub areas: Areas,
    /// Volumes against the reference plane.
    pub volumes: Volumes,
    /// Things worth knowing.
    pub notes: Vec<Note>,
}

/// Builds the surface of `design` on `line`; `reference` is the elevation of the plane for volumes, by default the one where
/// the slopes end (the highest rim vertex of a falling slope inside a ring, the lowest of a rising one).
///
/// Expects a validated line, every segment flatter than the slope.
///
/// # Errors
/// See [`SurfaceError`]; a surface whose certificate fails is an error, never a result.
pub fn build(line: &Line, design: &Design, reference: Option<f64>, watch: &dyn Watch) -> Result<Surface, SurfaceError> {
    in_spite_of_touching(design.tolerance, SurfaceError::is_flaw, |joggle| {
        let mut surface = made(line, &Design { joggle, ..design.clone() }, Some(&Plane { reference }), watch)?;
        surface.notes.extend(joggle.map(joggle_note));
        Ok(surface)
    })
    .map_err(|error| if watch.cancelled() { SurfaceError::Cancelled } else { error })
}

/// The same surface with its certificate, but without line work, areas and volumes: for those who cut it first.
///
/// # Errors
/// As [`build`].
pub fn build_uncut(line: &Line, design: &Design, watch: &dyn Watch) -> Result<Surface, SurfaceError> {
    made(line, design, None, watch)
}

/// The plane for volumes, where one was given.
struct Plane {
    reference: Option<f64>,
}

/// Builds the surface; line work and figures of the whole only with a plane.
fn made(line: &Line, design: &Design, plane: Option<&Plane>, watch: &dyn Watch) -> Result<Surface, SurfaceError> {
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
            || feet_of(line, sheet, &slopes),
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
                    let moves = body::Moves::new(line, design, network.simplified_max);
                    body.volumes(reference.unwrap_or_else(|| body::reference(line, design, ends)), &moves, &open)
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

/// The facets that have triangles, and the one of each triangle.
fn feet_of(line: &Line, sheet: &Sheet, slopes: &Slopes) -> (Vec<Foot>, Vec<u32>) {
    let stations = stations::Stations::on_axes(line);
    let mut feet = Vec::new();
    let mut last = None;
    let mut foot_of = Vec::with_capacity(slopes.facets.len());
    for &f in &slopes.facets {
        if last != Some(f) {
            let facet = sheet.facet(f);
            let leaving = match facet.kind {
                Kind::Strip(_) => None,
                Kind::Sector(node) => sheet.fans.leaving(node).first().copied(),
            };
            feet.push(feet::foot(facet, sheet.network, &stations, leaving));
            last = Some(f);
        }
        foot_of.push(feet.len() as u32 - 1);
    }
    (feet, foot_of)
}

/// Where the sheet stops, heights of the falling sheet.
struct Ends {
    /// Plane down to which facets are closed.
    closure: f64,
    /// Lowest height of the surface.
    lowest: f64,
    /// Highest height of the line.
    top: f64,
    /// Length of rulings, where that is limited.
    reach: Option<f64>,
}

impl Ends {
    fn new(network: &Network, line: &Line, design: &Design) -> Result<Self, SurfaceError> {
        let k = design.slope.ratio();
        let (low, high) = line.elevation_range();
        let (bottom, top) = if network.sign > 0.0 { (low, high) } else { (-high, -low) };
        let at_reach = |reach: f64| {
            let lowest = bottom - k * reach;
            let closure = lowest - BEYOND_REACH * (k * reach).max(1.0);
            Self { closure, lowest, top, reach: Some(reach) }
        };
        Ok(match design.extent {
            Extent::Elevation(z) => {
                let end = network.sign * z;
                if end >= top {
                    return Err(SurfaceError::NothingToBuild { end: z, low, high, rising: design.sheet == SheetKind::Rising });
                }
                // Where the line itself ends on that elevation, the elevation must stay what it is.
                let touches = network.nodes.iter().any(|p| (p.z - end).abs() <= levels::LEVEL_SNAP);
                Self { closure: if touches { end } else { end - END_TIE }, lowest: end, top, reach: None }
            }
            Extent::Height(h) => at_reach(h / k),
            Extent::Distance(d) => at_reach(d),
        })
    }

    /// `sign`: what heights of the falling sheet are multiplied with to get elevations.
    fn levels(&self, design: &Design, sign: f64) -> Result<Levels, SurfaceError> {
        let chosen: Vec<f64> = design.levels.iter().map(|z| sign * z).collect();
        if design.interval.is_none() && !chosen.is_empty() {
            return Ok(Levels { heights: Vec::new() }.with(&chosen, self.lowest, self.top));
        }
        let range = self.top - self.lowest;
        let interval = design.interval.unwrap_or_else(|| levels::round_interval(range));
        let count = (range / interval).floor();
        if count > levels::MAX_LEVELS as f64 {
            let least = range / levels::MAX_LEVELS as f64;
            // Two digits, rounded up.
            let unit = 10_f64.powf(least.log10().floor() - 1.0);
            return Err(SurfaceError::TooManyLevels { interval, count, least: (least / unit).ceil() * unit });
        }
        Ok(Levels::between(self.lowest, self.top, interval).with(&chosen, self.lowest, self.top))
    }
}
