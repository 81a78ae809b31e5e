//! The driver: line, ground and designs → the works, the design cut off at the ground, the finished ground, all figures.

use super::feeder::{Fed, Feeder};
use super::figures::{self, Ground};
use super::finished::Left;
use super::nodes::Nodes;
use super::patch::Patch;
use super::patchwork::Patchwork;
use super::reach::{Bounds, Reach};
use super::shape::Shape;
use super::stations::{Stations, axes};
use super::thinned::thinned;
use super::trimmed::{Cutting, Trimmed};
use super::works::{End, Flood, Sink, Works};
use super::{GroundError, cell};
use crate::kernel::frame::Frame;
use crate::kernel::sum::Sum;
use crate::mesh::volume;
use crate::model::{Design, Extent, Line, Note, Part, Sheet, Side, Slope, Terrain};
use crate::slope::levels;
use crate::surface::{self, Surface, SurfaceError, Watch};
use crate::terrain::inspect;
use glam::{DVec2, DVec3};
use std::sync::{Arc, OnceLock};

/// Slopes are built this part of their depth beyond the lowest (highest) ground they can reach, and at least
/// [`LEAST_BEYOND`] tolerances: they then meet the ground within the mesh.
const BEYOND: f64 = 0.01;

/// See [`BEYOND`].
const LEAST_BEYOND: f64 = 10.0;

/// How deep the works are is found with this many times the tolerance.
const COARSER: f64 = 8.0;

/// Platform area without ground up to this part of the whole is rounding.
const AREA_ROUNDING: f64 = 1e-9;

/// Length of line without ground up to this part of the whole is rounding.
const LENGTH_ROUNDING: f64 = 1e-9;

/// A line on its ground, before the slopes are known.
pub struct Site<'a> {
    line: &'a Line,
    terrain: Terrain,
    /// Name of the ground for messages.
    label: &'a str,
    bounds: Bounds,
    reaches: Vec<Reach>,
    /// The ends that were proposed.
    ends: Vec<(Sheet, f64)>,
    /// The first part of the ground that was asked for, with the cells of `bounds` it belongs to.
    first_patch: OnceLock<(Vec<bool>, Arc<Patch>)>,
}

/// What is wanted of the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Accept slopes that end without meeting the ground.
    pub allow_open: bool,
    /// Build the finished ground as well.
    pub finished: bool,
    /// Distance of stations.
    pub stations: Option<f64>,
    /// Keep the ground and the pieces of the works, for drawings and setting out.
    pub keep: bool,
    /// Refuse also slopes that end off the ground by less than the tolerance.
    pub exactly: bool,
}

/// Everything but the finished ground, and what the works change of the ground if that is wanted.
type Built = (Ground, Option<Patchwork>);

impl<'a> Site<'a> {
    /// Puts the ground into a frame that holds line and ground alike; `label` names the ground in messages.
    pub fn new(line: &'a Line, terrain: Terrain, label: &'a str) -> Self {
        let world = |p: DVec2| terrain.frame.to_world(p.extend(0.0)).truncate();
        let (lo, hi) = terrain.plan_box();
        let (mut lo, mut hi) = (world(lo), world(hi));
        for v in line.chains.iter().flat_map(|chain| &chain.vertices) {
            lo = lo.min(v.truncate());
            hi = hi.max(v.truncate());
        }
        let terrain = terrain.in_frame(Frame::around(lo, hi));
        let bounds = Bounds::new(&terrain);
        Self { line, terrain, label, bounds, reaches: Vec::new(), ends: Vec::new(), first_patch: OnceLock::new() }
    }

    /// The ground.
    pub fn terrain(&self) -> &Terrain {
        &self.terrain
    }

    /// Plan area of the ground.
    pub fn area(&self) -> f64 {
        self.bounds.area
    }

    /// Finds how far slopes of a sheet can reach before they meet the ground, and the elevation at which that is.
    pub fn end(&mut self, slope: Slope, sheet: Sheet, tolerance: f64) -> f64 {
        let reach = self.bounds.reach(&self.terrain.frame, self.line, slope, sheet, tolerance);
        let (low, high) = self.line.elevation_range();
        let end = match sheet {
            Sheet::Falling => {
                let end = reach.lowest.min(low);
                end - beyond(high - end, tolerance)
            }
            Sheet::Rising => {
                let end = reach.highest.max(high);
                end + beyond(end - low, tolerance)
            }
        };
        self.reaches.push(reach);
        self.ends.push((sheet, end));
        end
    }

    /// Builds designs of one line, one for each sheet at most, on the ground.
    ///
    /// # Errors
    /// [`GroundError`]; meshes that fail their check are errors, never a result.
    pub fn build(self, designs: &[Design], options: &Options, watch: &dyn Watch) -> Result<Ground, GroundError> {
        let (mut ground, patchwork) = self.built(designs, options, watch)?;
        match patchwork {
            Some(patchwork) => {
                ground.terrain = options.keep.then(|| self.terrain.clone());
                ground.finished = Some(patchwork.apply(self.terrain));
            }
            None => ground.terrain = options.keep.then_some(self.terrain),
        }
        Ok(ground)
    }

    fn built(&self, designs: &[Design], options: &Options, watch: &dyn Watch) -> Result<Built, GroundError> {
        let whole = designs.iter().any(|d| d.side_of_rings == Side::Inside) && self.line.chains.iter().all(|c| c.closed());
        if !whole {
            let needed = self.as_deep_as_needed(designs, watch)?;
            match self.attempt(&needed, whole, &Options { exactly: true, ..*options }, watch) {
                // On ground that lies in the slopes, the coarse pass may have met it too early.
                Err(GroundError::Open { .. }) if needed != designs => {}
                built => return built,
            }
        }
        self.attempt(designs, whole, options, watch)
    }

    fn attempt(&self, designs: &[Design], whole: bool, options: &Options, watch: &dyn Watch) -> Result<Built, GroundError> {
        let designs = self.in_common(designs);
        let tolerance = designs.iter().map(|design| design.tolerance).fold(f64::INFINITY, f64::min);
        surface::in_spite_of_touching(tolerance, GroundError::is_flaw, |joggle| {
            let designs: Vec<Design> = designs.iter().map(|design| Design { joggle, ..design.clone() }).collect();
            let mut built = self.once(&designs, whole, options, watch)?;
            built.0.notes.extend(joggle.map(surface::joggle_note));
            Ok(built)
        })
    }

    fn once(&self, designs: &[Design], whole: bool, options: &Options, watch: &dyn Watch) -> Result<Built, GroundError> {
        let surfaces = self.surfaces(self.line, designs, watch)?;
        let go_on = |stage| {
            watch.stage(stage);
            if watch.cancelled() { Err(SurfaceError::Cancelled) } else { Ok(()) }
        };
        go_on("works")?;
        let shape = Shape::new(&surfaces.iter().collect::<Vec<_>>(), whole).ok_or_else(|| GroundError::Unsound {
            mesh: "design",
            what: "its slopes do not have the points of the line in common".to_owned(),
        })?;
        let patch = self.patch(&shape, whole);
        let mut notes = inspected(&patch, &self.terrain, self.label)?;
        let stations = Stations::new(axes(self.line, &self.terrain.frame), options.stations)?;
        let mut feeder = Feeder::new(&shape, &stations, options.keep, whole);
        let mut works = Flood::run(&shape, &patch, whole, &mut feeder);
        let fed = feeder.finish();
        let uncovered = Uncovered::find(&shape, &fed);
        if let Some(uncovered) = uncovered.as_ref().filter(|_| !options.allow_open) {
            return Err(uncovered.error());
        }
        check_open(&shape, &works, designs, options)?;
        let bare = Bare::find(&shape, &works);
        if let Some(bare) = bare.as_ref().filter(|_| !options.allow_open) {
            return Err(bare.error());
        }
        if options.finished {
            figures::check_walls(&shape, &works)?;
        }
        go_on("daylight")?;
        let mut nodes = Nodes::new(&shape, &patch, &works);
        notes.extend(standing(&shape, &works, designs));
        notes.extend(uncovered.as_ref().map(Uncovered::note));
        notes.extend(bare.as_ref().filter(|_| uncovered.is_none()).map(Bare::note));
        let assemble = |works: &Works, nodes: &Nodes| {
            let cut = |what| move |cause| GroundError::Cut { what, cause };
            let cutting = Cutting { whole, at_rim: false };
            let trimmed = Trimmed::new(&shape, &patch, works, nodes, cutting).map_err(cut("the design"))?;
            let (mut left, mut within) = (None, None);
            if options.finished {
                left = Some(Left::new(&shape, &patch, works, nodes, whole).map_err(cut("the ground"))?);
                if cutting.leaves_over(&shape, works) {
                    let cutting = Cutting { at_rim: true, ..cutting };
                    within = Some(Trimmed::new(&shape, &patch, works, nodes, cutting).map_err(cut("the design"))?);
                }
            }
            go_on("finished ground")?;
            figures::ground(&figures::Found {
                line: self.line,
                designs,
                terrain: &self.terrain,
                surfaces: &surfaces,
                shape: &shape,
                patch: &patch,
                works,
                nodes,
                trimmed: &trimmed,
                within: within.as_ref().unwrap_or(&trimmed),
                left: left.as_ref(),
                fed: &fed,
                covered: uncovered.is_none() && bare.is_none(),
                stations: &stations,
                notes: &notes,
            })
        };
        match assemble(&works, &nodes) {
            Err(GroundError::Cut { .. } | GroundError::Unsound { .. }) => {
                nodes.snap(&shape, &patch, &mut works);
                assemble(&works, &nodes).map_err(|error| open_mesh(error, &shape, &works, uncovered.as_ref()))
            }
            built => built,
        }
    }

    /// The designs with ends just beyond the ground that they really meet, where the end was one of [`Self::end`].
    ///
    /// A first, coarse build tells how deep the works are. So the meshes do not depend on how tightly the ground could be bounded
    /// beforehand: not on its triangles, nor on where the grid of the bounds lies.
    fn as_deep_as_needed(&self, designs: &[Design], watch: &dyn Watch) -> Result<Vec<Design>, GroundError> {
        let free = |design: &Design| {
            self.ends.iter().any(|&(sheet, end)| sheet == design.sheet && design.extent == Extent::Elevation(end))
        };
        if !designs.iter().any(free) {
            return Ok(designs.to_vec());
        }
        let coarse = |design: &Design| Design {
            tolerance: COARSER * design.tolerance,
            interval: None,
            levels: Vec::new(),
            ..design.clone()
        };
        let coarse = self.in_common(&designs.iter().map(coarse).collect::<Vec<_>>());
        // Sheets of the thinned line move by half of the slack below at most.
        let steepest = coarse.iter().map(|design| design.slope.ratio() / design.tolerance).fold(0.0, f64::max);
        let thin = thinned(self.line, 0.25 / steepest);
        let line = thin.as_ref().unwrap_or(self.line);
        // Whatever is wrong is found again, and told, in the build proper.
        let Ok(surfaces) = self.surfaces(line, &coarse, watch) else { return Ok(designs.to_vec()) };
        let Some(shape) = Shape::new(&surfaces.iter().collect::<Vec<_>>(), false) else { return Ok(designs.to_vec()) };
        let mut depth = Depth { shape: &shape, lowest: f64::INFINITY, highest: f64::NEG_INFINITY };
        Flood::run(&shape, &self.patch(&shape, false), false, &mut depth);
        let (low, high) = self.line.elevation_range();
        let deepened = |design: &Design| {
            let Extent::Elevation(given) = design.extent else { return design.clone() };
            let slack = COARSER * design.tolerance;
            let end = match design.sheet {
                Sheet::Falling => {
                    let end = depth.lowest.min(low) - slack;
                    given.max(rounded(end - beyond(high - end, slack), high - end, f64::floor))
                }
                Sheet::Rising => {
                    let end = depth.highest.max(high) + slack;
                    given.min(rounded(end + beyond(end - low, slack), end - low, f64::ceil))
                }
            };
            if free(design) { Design { extent: Extent::Elevation(end), ..design.clone() } } else { design.clone() }
        };
        Ok(designs.iter().map(deepened).collect())
    }

    /// The part of the ground that the works can touch. Nearly always that is the same for the coarse build and the build proper.
    fn patch(&self, shape: &Shape, whole: bool) -> Arc<Patch> {
        let flats = (0..shape.triangles.len() as u32).filter(|&a| whole || shape.parts[a as usize] == Part::Platform);
        let inside = self.bounds.inside(&self.reaches, flats.map(|a| shape.plan(a)));
        if let Some((_, patch)) = self.first_patch.get().filter(|(cells, _)| *cells == inside) {
            return Arc::clone(patch);
        }
        let patch = Arc::new(Patch::new(&self.terrain, self.bounds.touched(&self.terrain, &inside)));
        self.first_patch.get_or_init(|| (inside, Arc::clone(&patch)));
        patch
    }

    /// The designs in one frame, with one interval, each simplifying the line as the other needs it.
    fn in_common(&self, designs: &[Design]) -> Vec<Design> {
        let (low, high) = self.line.elevation_range();
        let range = |design: &Design| match (design.extent, design.sheet) {
            (Extent::Elevation(end), Sheet::Falling) => high - end,
            (Extent::Elevation(end), Sheet::Rising) => end - low,
            (Extent::Height(height), _) => high - low + height,
            (Extent::Distance(distance), _) => high - low + distance * design.slope.ratio(),
        };
        let interval = levels::round_interval(designs.iter().map(range).fold(0.0, f64::max));
        let tolerance = designs.iter().map(|d| d.tolerance).fold(f64::INFINITY, f64::min);
        let common = |design: &Design| Design {
            companion: designs.iter().find(|d| d.sheet != design.sheet).map(|d| d.slope),
            frame: Some(self.terrain.frame),
            interval: design.interval.or_else(|| design.levels.is_empty().then_some(interval)),
            tolerance,
            ..design.clone()
        };
        designs.iter().map(common).collect()
    }

    fn surfaces(&self, line: &Line, designs: &[Design], watch: &dyn Watch) -> Result<Vec<Surface>, GroundError> {
        let build = |design: &Design| surface::build_uncut(line, design, watch);
        let surfaces = match designs {
            [first, second] => {
                let (first, second) = rayon::join(|| build(first), || build(second));
                vec![first?, second?]
            }
            _ => designs.iter().map(build).collect::<Result<Vec<_>, _>>()?,
        };
        for (surface, design) in surfaces.iter().zip(designs) {
            if let Some(b) = surface.buried.first() {
                let name = |chain: usize| line.chains[chain].name.clone();
                let cure = match b.free_slope {
                    Some(free) => format!(
                        "a slope of 1:{:.3} or steeper instead of 1:{:.3}, or move the two apart",
                        1.0 / free,
                        design.slope.one_in()
                    ),
                    None => "build them one by one, or move the two apart".to_owned(),
                };
                return Err(GroundError::Buried {
                    chain: name(b.chain),
                    from: b.from,
                    to: b.to,
                    depth: b.depth,
                    by_chain: name(b.by_chain),
                    x: b.at.x,
                    y: b.at.y,
                    cure,
                });
            }
        }
        Ok(surfaces)
    }
}

/// Platform that has no ground below it.
struct Uncovered {
    /// Its plan area.
    area: f64,
    /// Plan area of all platforms.
    all: f64,
    /// A place of it in the world.
    at: DVec2,
}

impl Uncovered {
    fn find(shape: &Shape, fed: &Fed) -> Option<Self> {
        let corners = |a: u32| shape.triangles[a as usize].map(|v| shape.vertices[v as usize]);
        let missing = |a: u32| volume::plan_area(corners(a)) - fed.covered[a as usize];
        let flats: Vec<u32> = (0..shape.triangles.len() as u32).filter(|&a| shape.parts[a as usize] == Part::Platform).collect();
        let area = flats.iter().map(|&a| missing(a)).collect::<Sum>().value();
        let all = flats.iter().map(|&a| volume::plan_area(corners(a))).collect::<Sum>().value();
        if area <= AREA_ROUNDING * all {
            return None;
        }
        let worst = flats.into_iter().max_by(|&a, &b| missing(a).total_cmp(&missing(b)))?;
        let [p, q, r] = corners(worst);
        Some(Self { area, all, at: shape.frame.to_world((p + q + r) / 3.0).truncate() })
    }

    fn error(&self) -> GroundError {
        GroundError::Uncovered { area: self.area, all: self.all, x: self.at.x, y: self.at.y }
    }

    fn note(&self) -> Note {
        let Self { area, all, at } = self;
        let message = format!(
            "there is no ground under {area:.3} of {all:.3} square units of the platform, first near ({:.3}, {:.3})",
            at.x, at.y
        );
        Note::new("platform-uncovered", message)
    }
}

/// Line that has no ground below it.
struct Bare {
    /// Its length in plan.
    length: f64,
    /// Length in plan of all of the line.
    all: f64,
    /// A place of it in the world.
    at: DVec2,
}

impl Bare {
    fn find(shape: &Shape, works: &Works) -> Option<Self> {
        let mut edges: Vec<([u32; 2], [f64; 2])> = works.over_ground.iter().map(|(&edge, &lengths)| (edge, lengths)).collect();
        edges.sort_unstable_by_key(|(edge, _)| *edge);
        let missing = |(_, [all, over]): &([u32; 2], [f64; 2])| all - over;
        let length = edges.iter().map(missing).collect::<Sum>().value();
        let all = edges.iter().map(|(_, [all, _])| *all).collect::<Sum>().value();
        if length <= LENGTH_ROUNDING * all {
            return None;
        }
        let (worst, _) = edges.into_iter().max_by(|p, q| missing(p).total_cmp(&missing(q)))?;
        let [p, q] = worst.map(|v| shape.vertices[v as usize]);
        Some(Self { length, all, at: shape.frame.to_world(0.5 * (p + q)).truncate() })
    }

    fn error(&self) -> GroundError {
        GroundError::LineUncovered { length: self.length, all: self.all, x: self.at.x, y: self.at.y }
    }

    fn note(&self) -> Note {
        let Self { length, all, at } = self;
        let message =
            format!("there is no ground under {length:.3} of {all:.3} of the line, first near ({:.3}, {:.3})", at.x, at.y);
        Note::new("line-uncovered", message)
    }
}

/// Looks at how the triangles of the ground near the works lie together.
fn inspected(patch: &Patch, terrain: &Terrain, label: &str) -> Result<Vec<Note>, GroundError> {
    let near = Terrain { frame: terrain.frame, vertices: patch.vertices.clone(), triangles: patch.triangles.clone() };
    let findings = inspect(label, &near);
    if findings.defects.list.is_empty() { Ok(findings.notes) } else { Err(GroundError::Terrain(findings.defects)) }
}

/// Whether all slopes meet the ground, or end no further off it than the tolerance.
pub(crate) fn met(works: &Works, designs: &[Design]) -> bool {
    let tolerance = designs.iter().map(|design| design.tolerance).fold(f64::INFINITY, f64::min);
    works.open.iter().all(|open| open.height <= tolerance)
}

/// Refuses slopes that end without meeting the ground.
fn check_open(shape: &Shape, works: &Works, designs: &[Design], options: &Options) -> Result<(), GroundError> {
    let Some(worst) = works.open.iter().max_by(|p, q| p.height.total_cmp(&q.height)) else { return Ok(()) };
    if options.allow_open || !options.exactly && met(works, designs) {
        return Ok(());
    }
    let length = works.open.iter().map(|o| o.points[0].truncate().distance(o.points[1].truncate())).collect::<Sum>();
    let at = shape.frame.to_world(worst.points[0]);
    let at_end = |design: &Design| match design.extent {
        Extent::Elevation(end) => worst.points.iter().all(|p| (p.z - end).abs() <= levels::LEVEL_SNAP),
        Extent::Height(_) | Extent::Distance(_) => true,
    };
    let (place, cure) = match worst.end {
        End::Ground => ("at the edge of the ground", "use a ground that reaches further and has no holes"),
        End::Slope if designs.iter().any(at_end) => ("at the end asked for", "give a later end, or none"),
        End::Slope => ("beside the end of the line, where slopes of one side stop", "build both sides (`--side both`)"),
    };
    Err(GroundError::Open { x: at.x, y: at.y, length: length.value(), height: worst.height, at: place, cure })
}

/// Where works go on beyond the ground, the meshes cannot always be put together: that is then the reason.
fn open_mesh(error: GroundError, shape: &Shape, works: &Works, uncovered: Option<&Uncovered>) -> GroundError {
    let open = works.open.first().map(|open| shape.frame.to_world(open.points[0]).truncate());
    match (&error, open.or(uncovered.map(|uncovered| uncovered.at))) {
        (GroundError::Cut { .. } | GroundError::Unsound { .. }, Some(at)) => GroundError::OpenMesh { x: at.x, y: at.y },
        _ => error,
    }
}

/// Notes on ends further off the ground than the tolerance: slopes that stop short of it, and lines without a slope to it.
fn standing(shape: &Shape, works: &Works, designs: &[Design]) -> Vec<Note> {
    let tolerance = designs.iter().map(|design| design.tolerance).fold(f64::INFINITY, f64::min);
    let note = |code, what: &str, ends: Vec<([DVec3; 2], f64)>| {
        let highest = ends.iter().max_by(|p, q| p.1.total_cmp(&q.1))?;
        let length = ends.iter().map(|(p, _)| p[0].truncate().distance(p[1].truncate())).collect::<Sum>().value();
        let at = shape.frame.to_world(highest.0[0]);
        let height = highest.1;
        let text = format!("{what} on a length of {length:.3}: up to {height:.3}, near ({:.3}, {:.3})", at.x, at.y);
        Some(Note::new(code, text))
    };
    let open = works.open.iter().filter(|o| o.height > tolerance).map(|o| (o.points, o.height)).collect();
    let walls = works.borders.iter().filter(|b| b.height > tolerance).map(|b| (b.points, b.height)).collect();
    let open = note("open-ends", "slopes end above or below the ground", open);
    open.into_iter().chain(note("walls", "the line stands off the ground with no slope between the two", walls)).collect()
}

/// Finds how deep the works reach.
struct Depth<'a> {
    shape: &'a Shape,
    lowest: f64,
    highest: f64,
}

impl Sink for Depth<'_> {
    fn take(&mut self, a: u32, corners: &[cell::Corner]) {
        match self.shape.parts[a as usize] {
            Part::FillSlope => self.lowest = corners.iter().fold(self.lowest, |z, c| z.min(c.z)),
            Part::CutSlope => self.highest = corners.iter().fold(self.highest, |z, c| z.max(c.z)),
            _ => {}
        }
    }
}

/// See [`BEYOND`].
fn beyond(depth: f64, tolerance: f64) -> f64 {
    (BEYOND * depth).max(LEAST_BEYOND * tolerance)
}

/// An end on a coarse scale, so that it does not move with every digit of the ground.
fn rounded(end: f64, depth: f64, round: fn(f64) -> f64) -> f64 {
    let step = levels::round_interval(depth.max(f64::MIN_POSITIVE)) / 4.0;
    round(end / step) * step
}
