//! Cut and fill between two meshes.

use super::boxes::ALL;
use super::fabric::{Fabric, Linked};
use super::layers;
use super::pieces::{self, Loose};
use super::tally;
use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::model::Terrain;
use glam::{DVec2, DVec3};

/// Heights within this of each other are the same, in the length unit: the area where no point of a cell differs by more is
/// unaffected. Its volume counts all the same.
pub const SAME_HEIGHT: f64 = 1e-6;

/// Share of the plan area that rounding may add or take: less does not count as uncovered, or as lying double.
pub const AREA_ROUNDING: f64 = 1e-9;

/// Share of a plan area that may lie double before a mesh is refused, of the mesh and of what is compared: slivers along a seam, from
/// rounded coordinates.
pub const MOST_DOUBLE: f64 = 1e-6;

/// One of the two surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// The surface after the works.
    Design,
    /// The surface before.
    Existing,
}

impl Surface {
    /// Its name in messages and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Design => "design",
            Self::Existing => "existing",
        }
    }
}

/// Plan areas, in the square of the length unit; not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Areas {
    /// Where the existing surface is higher.
    pub cut: f64,
    /// Where the design is higher.
    pub fill: f64,
    /// Where they are the same, within [`SAME_HEIGHT`].
    pub unaffected: f64,
    /// Design that does not lie over the existing surface: it has no volume.
    pub design_uncovered: f64,
    /// Existing surface that does not lie under the design.
    pub existing_uncovered: f64,
    /// The area asked for, where only a part was.
    pub within: Option<f64>,
}

/// A greatest depth and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Vertical distance of the surfaces; positive.
    pub depth: f64,
    /// Where, on the design, in world coordinates.
    pub place: DVec3,
}

/// Everything between two surfaces over the plan area they share. Units are those of the coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Between {
    /// `∫ max(existing − design, 0)`.
    pub cut: f64,
    /// `∫ max(design − existing, 0)`.
    pub fill: f64,
    /// Plan areas.
    pub areas: Areas,
    /// Deepest cut, if there is any.
    pub deepest_cut: Option<Depth>,
    /// Deepest fill, if there is any.
    pub deepest_fill: Option<Depth>,
    /// Cells of the common refinement; none where a plane is taken for one of the surfaces.
    pub cells: usize,
    /// Plan area that lies double in the design and in the existing mesh, of what is compared: no more than [`MOST_DOUBLE`] of it.
    pub double: [f64; 2],
}

impl Between {
    /// `cut − fill`.
    pub fn net(&self) -> f64 {
        self.cut - self.fill
    }

    /// Plan area the two surfaces share.
    pub fn common_area(&self) -> f64 {
        self.areas.cut + self.areas.fill + self.areas.unaffected
    }
}

/// Why there is nothing between two surfaces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OverlayError {
    /// A mesh without plan area.
    #[error("the {} mesh has no area in plan", .0.name())]
    Empty(Surface),
    /// The meshes share no plan area.
    #[error("the two meshes share no area in plan\n   = {}\n   = {}", boxed("design", .design), boxed("existing", .existing))]
    Apart {
        /// Box of the design in world coordinates.
        design: [DVec2; 2],
        /// Box of the existing surface.
        existing: [DVec2; 2],
    },
    /// A mesh has nothing inside the area asked for.
    #[error("the {} mesh has no area inside the rings\n   = {}\n   = {}", .surface.name(), boxed("mesh", .mesh), boxed("rings", .within))]
    Outside {
        /// Which mesh.
        surface: Surface,
        /// Its box in world coordinates.
        mesh: [DVec2; 2],
        /// Box of the area.
        within: [DVec2; 2],
    },
    /// A mesh lies on itself.
    #[error(
        "triangles of the {} mesh lie on each other in plan\n   = {} or more of {of:.3} square units lie double, as near {:.3}, {:.3}",
        .surface.name(), small(*.area), .at.x, .at.y
    )]
    Double {
        /// Which mesh.
        surface: Surface,
        /// Plan area seen to lie double.
        area: f64,
        /// Plan area of the triangles that were looked at, or that the two meshes share.
        of: f64,
        /// A place in world coordinates.
        at: DVec2,
    },
}

/// A figure with three decimals, or three digits where those would show none.
fn small(figure: f64) -> String {
    if figure >= 1e-3 { format!("{figure:.3}") } else { format!("{figure:.3e}") }
}

fn boxed(name: &str, [lo, hi]: &[DVec2; 2]) -> String {
    format!("{name}: x {:.3} to {:.3}, y {:.3} to {:.3}", lo.x, hi.x, lo.y, hi.y)
}

/// Cut, fill and what goes with them between `design` and `existing`, over the plan area they share; with `within`, only over
/// that area (a mesh whose heights do not matter, such as [`crate::mesh::inside::inside`] makes).
///
/// Exact for the two meshes: every cell of their common refinement is a prism, split where its height changes sign. Arithmetic is
/// relative to the corners of each triangle, sums are compensated. The figures are the same to the last bit on any number of
/// threads.
///
/// # Errors
/// [`OverlayError`]; a mesh that lies on itself is refused, because its volume would count twice.
///
/// # Accuracy
/// A cell is right to a few units in the last place times the ratio of the sizes of its two triangles; see `docs/theory.md`,
/// "Between two meshes", and `tests/volume`.
pub fn between(design: &Terrain, existing: &Terrain, within: Option<&Terrain>) -> Result<Between, OverlayError> {
    let frame = if design.frame == existing.frame { existing.frame } else { common_frame(design, existing) };
    let boxes = [design, existing].map(|mesh| shifted_box(mesh, frame));
    let area = within.map(|area| Fabric::new(area, frame, &ALL));
    // Where only a part is asked for, what lies beside the other mesh inside that part must be measured.
    let part = within.map(|area| shifted_box(area, frame));
    let (d, e) = rayon::join(
        || Fabric::new(design, frame, part.as_ref().unwrap_or(&boxes[1])),
        || Fabric::new(existing, frame, part.as_ref().unwrap_or(&boxes[0])),
    );
    not_empty(&d, Surface::Design)?;
    not_empty(&e, Surface::Existing)?;
    let (linked_design, linked_existing) = rayon::join(|| Linked::new(&d), || Linked::new(&e));
    let layers = rayon::join(
        || Layers::of(&linked_design, Surface::Design, frame),
        || Layers::of(&linked_existing, Surface::Existing, frame),
    );
    let (design_layers, existing_layers) = (layers.0?, layers.1?);
    let linked_area = area.as_ref().map(Linked::new);
    let (tally, design_area, existing_area) = if let Some(area) = &linked_area {
        let [cut_design, cut_existing] = [pieces::within(&d, area), pieces::within(&e, area)];
        (tally::sweep(&cut_design, &linked_existing), cut_design.area(), cut_existing.area())
    } else if d.triangles.len() >= e.triangles.len() {
        // The finer mesh is laid over the coarser one: its triangles have few cells each, which lie near each other.
        (tally::sweep(&d, &linked_existing), d.area, e.area)
    } else {
        (tally::sweep(&e, &linked_design).mirrored(), d.area, e.area)
    };
    // Where meshes only touch, rounding may leave slivers.
    let smaller = design_area.min(existing_area);
    if tally.cells == 0 || tally.common() <= AREA_ROUNDING * smaller {
        let world = |b: &PlanBox| [b.lo, b.hi].map(|p| frame.to_world(p.extend(0.0)).truncate());
        return Err(match &area {
            Some(area) if design_area == 0.0 || existing_area == 0.0 => {
                let missed = if design_area == 0.0 { (Surface::Design, &boxes[0]) } else { (Surface::Existing, &boxes[1]) };
                OverlayError::Outside { surface: missed.0, mesh: world(missed.1), within: world(&area.whole()) }
            }
            _ => OverlayError::Apart { design: world(&boxes[0]), existing: world(&boxes[1]) },
        });
    }
    let common = tally.common();
    let double = [
        design_layers.in_common(Some(&linked_existing), linked_area.as_ref(), common)?,
        existing_layers.in_common(Some(&linked_design), linked_area.as_ref(), common)?,
    ];
    let mut between = tally.into_between(frame, design_area, existing_area);
    (between.double, between.areas.within) = (double, area.as_ref().map(|area| area.area));
    Ok(between)
}

/// Cut and fill when `existing` is brought to the level of `elevation`, over all of it or within an area: cut is what lies above
/// the plane, fill what is missing below. Places of depths are on the plane. Within an area, what of it has no ground is design that
/// is not covered.
///
/// # Errors
/// [`OverlayError`], as [`between`].
pub fn to_elevation(existing: &Terrain, elevation: f64, within: Option<&Terrain>) -> Result<Between, OverlayError> {
    let frame = existing.frame;
    let area = within.map(|area| Fabric::new(area, frame, &ALL));
    let e = Fabric::new(existing, frame, &area.as_ref().map_or(ALL, Fabric::whole));
    not_empty(&e, Surface::Existing)?;
    let linked = Linked::new(&e);
    let layers = Layers::of(&linked, Surface::Existing, frame)?;
    let linked_area = area.as_ref().map(Linked::new);
    let tally = match area.as_ref().zip(linked_area.as_ref()) {
        None => tally::level(&e, elevation),
        Some((area, linked_area)) => {
            let part = pieces::within(&e, linked_area);
            if part.area() == 0.0 {
                let world = |b: &PlanBox| [b.lo, b.hi].map(|p| frame.to_world(p.extend(0.0)).truncate());
                let mesh = world(&shifted_box(existing, frame));
                return Err(OverlayError::Outside { surface: Surface::Existing, mesh, within: world(&area.whole()) });
            }
            tally::level(&part, elevation)
        }
    };
    let common = tally.common();
    let double = [0.0, layers.in_common(None, linked_area.as_ref(), common)?];
    let within = area.as_ref().map(|area| area.area);
    // The plane is the design: it goes as far as it was asked for.
    let mut between = tally.into_between(frame, within.unwrap_or(common), common);
    (between.double, between.areas.within) = (double, within);
    Ok(between)
}

/// Refuses a mesh without area.
fn not_empty(mesh: &Fabric, surface: Surface) -> Result<(), OverlayError> {
    // An area that is no number is refused as well.
    if mesh.area > 0.0 { Ok(()) } else { Err(OverlayError::Empty(surface)) }
}

/// What of a mesh lies on itself.
struct Layers {
    surface: Surface,
    frame: Frame,
    /// If anything does: a place of it, and all of it.
    double: Option<(DVec2, Loose)>,
}

impl Layers {
    /// Refuses a mesh of which more than [`MOST_DOUBLE`] lies on itself.
    fn of(mesh: &Linked<'_>, surface: Surface, frame: Frame) -> Result<Self, OverlayError> {
        let most = MOST_DOUBLE * mesh.fabric.kept;
        let layers = |double| Self { surface, frame, double };
        let Some(seen) = layers::at_rim(mesh, most) else { return Ok(layers(None)) };
        let (cells, all) = if seen.area > most { (Loose::default(), false) } else { layers::cells(mesh) };
        let (area, found) = (cells.area().max(seen.area), layers(Some((seen.at, cells))));
        if all && area <= most { Ok(found) } else { Err(found.refused(seen.at, area, mesh.fabric.kept)) }
    }

    fn refused(&self, at: DVec2, area: f64, of: f64) -> OverlayError {
        OverlayError::Double { surface: self.surface, area, of, at: self.frame.to_world(at.extend(0.0)).truncate() }
    }

    /// How much lies double over `other` and within `area`, where the two meshes share `common`; refused if that is too much of it.
    /// Less than rounding is none.
    fn in_common(&self, other: Option<&Linked<'_>>, area: Option<&Linked<'_>>, common: f64) -> Result<f64, OverlayError> {
        let Some((at, cells)) = &self.double else { return Ok(0.0) };
        let inside = area.map(|area| pieces::within(cells, area));
        let cells = inside.as_ref().unwrap_or(cells);
        let double = other.map_or_else(|| cells.area(), |other| tally::sweep(cells, other).common());
        if double > MOST_DOUBLE * common {
            return Err(self.refused(cells.place().unwrap_or(*at), double, common));
        }
        Ok(if double > AREA_ROUNDING * common { double } else { 0.0 })
    }
}

/// A frame for both meshes.
fn common_frame(design: &Terrain, existing: &Terrain) -> Frame {
    let b = shifted_box(design, Frame::WORLD).join(shifted_box(existing, Frame::WORLD));
    Frame::around(b.lo, b.hi)
}

/// The box of the vertices in use, in `frame`.
fn shifted_box(mesh: &Terrain, frame: Frame) -> PlanBox {
    let mut used = vec![false; mesh.vertices.len()];
    mesh.triangles.as_flattened().iter().for_each(|&v| used[v as usize] = true);
    let b = PlanBox::of(mesh.vertices.iter().zip(used).filter(|(_, used)| *used).map(|(v, _)| v.truncate()));
    let shift = mesh.frame.origin() - frame.origin();
    PlanBox { lo: b.lo + shift, hi: b.hi + shift }
}
