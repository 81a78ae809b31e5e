//! The driver: line, ground and designs → the works, the design cut off at the ground, the finished ground, all figures.

mod depth;

use super::feeder::Feeder;
use super::figures::{self, Ground};
use super::finished::Left;
use super::found::Found;
use super::nodes::{Meeting, Nodes};
use super::patch::Patch;
use super::patchwork::Patchwork;
use super::reach::{Bounds, Reach};
use super::shape::Shape;
use super::stations::{Stations, axes};
use super::trimmed::{Cutting, Trimmed};
use super::uncovered::{Bare, Uncovered};
use super::works::{Flood, Works};
use super::{GroundError, open_ends};
use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::model::{Design, Extent, Line, Part, Sheet, Terrain};
use crate::slope::levels;
use crate::surface::{self, Surface, SurfaceError, Watch};
use glam::DVec2;
use std::sync::{Arc, OnceLock};

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
}

/// Everything but the finished ground, and what the works change of the ground if that is wanted.
type Built = (Ground, Option<Patchwork>);

impl<'a> Site<'a> {
    /// Puts the ground into a frame that holds line and ground alike; `label` names the ground in messages.
    pub fn new(line: &'a Line, terrain: Terrain, label: &'a str) -> Self {
        let world = |p: DVec2| terrain.frame.to_world(p.extend(0.0)).truncate();
        let PlanBox { lo, hi } = terrain.plan_box();
        let all = PlanBox { lo: world(lo), hi: world(hi) }.join(line.plan_box());
        let terrain = terrain.in_frame(Frame::around(all.lo, all.hi));
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
        let whole = designs.iter().any(|design| design.only_inside(self.line));
        if !whole {
            let needed = self.as_deep_as_needed(designs, watch);
            let found = |(needed, given): (&Design, &Design)| match needed.extent {
                Extent::Elevation(end) if needed != given => Some(end),
                _ => None,
            };
            let found: Vec<f64> = needed.iter().zip(designs).filter_map(found).collect();
            if !found.is_empty() {
                match self.attempt(&needed, whole, &found, options, watch) {
                    // On ground that lies in the slopes, the coarse pass may have met it too early.
                    Err(GroundError::Open { .. }) => {}
                    built => return built,
                }
            }
        }
        self.attempt(designs, whole, &[], options, watch)
    }

    /// `found`: elevations at which no slope may end, whatever the options.
    fn attempt(
        &self,
        designs: &[Design],
        whole: bool,
        found: &[f64],
        options: &Options,
        watch: &dyn Watch,
    ) -> Result<Built, GroundError> {
        let designs = self.in_common(designs);
        surface::in_spite_of_touching(Design::least_tolerance(&designs), GroundError::is_flaw, |joggle| {
            let designs: Vec<Design> = designs.iter().map(|design| Design { joggle, ..design.clone() }).collect();
            let mut built = self.once(&designs, whole, found, options, watch)?;
            let one_sided = designs.iter().any(|design| design.one_sided(self.line));
            built.0.notes.extend(joggle.map(|joggle| surface::joggle_note(joggle, one_sided)));
            Ok(built)
        })
    }

    fn once(
        &self,
        designs: &[Design],
        whole: bool,
        found: &[f64],
        options: &Options,
        watch: &dyn Watch,
    ) -> Result<Built, GroundError> {
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
        let mut notes = patch.inspect(&self.terrain, self.label)?;
        // A third of it is for the line, in height as the slopes see it.
        let slack = designs.iter().map(|design| design.tolerance / design.slope.ratio()).fold(0.0, f64::max);
        let stations = Stations::new(axes(self.line, &self.terrain.frame), options.stations)?.standing_off(slack);
        let mut feeder = Feeder::new(&shape, &stations, options.keep, whole);
        let mut works = Flood::run(&shape, &patch, whole, &mut feeder);
        let fed = feeder.finish();
        let uncovered = Uncovered::find(&shape, &fed);
        if let Some(uncovered) = uncovered.as_ref().filter(|_| !options.allow_open) {
            return Err(uncovered.error());
        }
        open_ends::check(&shape, &works, designs, found, options.allow_open)?;
        let bare = Bare::find(&shape, &works);
        if let Some(bare) = bare.as_ref().filter(|_| !options.allow_open) {
            return Err(bare.error());
        }
        if options.finished {
            open_ends::check_walls(&shape, &works, designs)?;
        }
        go_on("daylight")?;
        let mut nodes = Nodes::new(&shape, &patch, &works);
        notes.extend(open_ends::notes(&shape, &works, designs));
        notes.extend(uncovered.as_ref().map(Uncovered::note));
        notes.extend(bare.as_ref().filter(|_| uncovered.is_none()).map(Bare::note));
        let assemble = |works: &Works, nodes: &Nodes| {
            let cut = |what| move |cause| GroundError::Cut { what, cause };
            let cutting = Cutting { whole, at_rim: false };
            let meeting = Meeting { shape: &shape, patch: &patch, works, nodes };
            let trimmed = Trimmed::new(meeting, cutting).map_err(cut("the design"))?;
            let (mut left, mut within) = (None, None);
            if options.finished {
                left = Some(Left::new(meeting, whole).map_err(cut("the ground"))?);
                if cutting.leaves_over(&shape, works) {
                    let cutting = Cutting { at_rim: true, ..cutting };
                    within = Some(Trimmed::new(meeting, cutting).map_err(cut("the design"))?);
                }
            }
            go_on("finished ground")?;
            figures::ground(&Found {
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
                assemble(&works, &nodes).map_err(|error| open_ends::reason(error, &shape, &works, uncovered.as_ref()))
            }
            built => built,
        }
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
        let tolerance = Design::least_tolerance(designs);
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
