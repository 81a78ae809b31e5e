//! Surfaces: points and faces as triangles.

use super::faces::{IdError, Mesh};
use super::numbers::{few, fields};
use super::units::{Header, Scale};
use super::walk::{Open, Visitor, named};
use super::xml::{Tag, Xml, place};
use crate::kernel::sum::Sum;
use crate::model::Note;
use crate::read::ReadError;
use crate::read::error::{clip, refuse};
use crate::read::terrain::RawFaces;
use glam::DVec3;

/// How many things a message lists.
pub(super) const LISTED: usize = 20;

/// Half a unit of the last digit, and a little for the rounding of that half itself.
const HALF: f64 = 0.501;

/// What a surface says about itself, in the units of the file: the number and half a unit of its last digit.
#[derive(Clone, Copy, Debug, Default)]
struct Declared {
    area: Option<(f64, f64)>,
    lowest: Option<(f64, f64)>,
    highest: Option<(f64, f64)>,
}

/// One surface of a file.
pub(super) struct Surface {
    pub(super) name: String,
    /// Where it begins.
    pub(super) at: usize,
    pub(super) vertices: usize,
    pub(super) faces: usize,
    /// Faces that are not to be seen.
    hidden: usize,
    /// Breaklines and boundaries, which its faces follow.
    pub(super) edges: usize,
    declared: Declared,
    /// Points and faces, if it is the one wanted.
    mesh: Option<Mesh>,
}

impl Surface {
    /// How it is listed.
    pub(super) fn text(&self) -> String {
        format!("`{}` ({} vertices, {} faces)", clip(self.name.as_bytes()), self.vertices, self.faces)
    }
}

/// Which surface is wanted, and what was found.
pub(super) struct Surfaces<'p> {
    /// Name of the one wanted; `None`: the only one.
    wanted: Option<&'p str>,
    /// Easting before northing.
    exchanged: bool,
    pub(super) found: Vec<Surface>,
}

impl<'p> Surfaces<'p> {
    pub(super) fn new(wanted: Option<&'p str>, exchanged: bool) -> Self {
        Self { wanted: wanted.map(str::trim), exchanged, found: Vec::new() }
    }

    /// The one wanted, of all that were found.
    ///
    /// # Errors
    /// If there is none, or several; the message lists them.
    pub(super) fn choose(self, label: &str) -> Result<Surface, ReadError> {
        let list = |found: &[Surface]| {
            let named: Vec<String> = found.iter().take(LISTED).map(Surface::text).collect();
            let more = if found.len() > LISTED { format!(" and {} more", found.len() - LISTED) } else { String::new() };
            format!("{} surfaces: {}{more}", found.len(), named.join(", "))
        };
        if self.found.is_empty() {
            let help = "give a file with a surface, exported with its faces";
            return Err(refuse("the file holds no surface", label, "there is no <Surface>", help));
        }
        let figures = list(&self.found);
        let fits = |surface: &Surface| match self.wanted {
            Some(name) => surface.name == name,
            None => surface.vertices + surface.faces > 0,
        };
        let count = self.found.iter().filter(|surface| fits(surface)).count();
        let chosen = self.found.into_iter().find(|surface| match self.wanted {
            Some(name) => surface.name == name,
            None => surface.vertices + surface.faces > 0,
        });
        match (chosen, self.wanted, count) {
            (Some(surface), _, 1) => Ok(surface),
            (None, Some(name), _) => {
                let what = format!("there is no surface `{}`", clip(name.as_bytes()));
                Err(refuse(&what, label, figures, "give one of these with `--surface`"))
            }
            (None, None, _) => Err(refuse("the surfaces of the file are empty", label, figures, "export them with their faces")),
            (Some(_), Some(name), _) => {
                let what = format!("{count} surfaces have the name `{}`", clip(name.as_bytes()));
                Err(refuse(&what, label, figures, "give them different names"))
            }
            (Some(_), None, _) => {
                Err(refuse("the file holds several surfaces", label, figures, "say which one with `--surface NAME`"))
            }
        }
    }

    fn surface<'a>(&mut self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<(), ReadError> {
        let name = named(xml, tag)?.unwrap_or_default();
        let keep = match self.wanted {
            Some(wanted) => wanted == name,
            // The second one is an error: only its figures are wanted.
            None => !self.found.iter().any(|surface| surface.vertices + surface.faces > 0),
        };
        let mesh = keep.then(Mesh::new);
        let mut surface =
            Surface { name, at: tag.at, vertices: 0, faces: 0, hidden: 0, edges: 0, declared: Declared::default(), mesh };
        while let Some(part) = xml.child()? {
            match part.name() {
                "SourceData" => surface.source_data(xml)?,
                "Definition" => self.definition(xml, &part, &mut surface)?,
                _ => xml.skip()?,
            }
        }
        self.found.push(surface);
        Ok(())
    }

    fn definition<'a>(&self, xml: &mut Xml<'a>, tag: &Tag<'a>, surface: &mut Surface) -> Result<(), ReadError> {
        let figure = |name| -> Result<Option<(f64, f64)>, ReadError> {
            let Some(value) = xml.number(tag, name)? else { return Ok(None) };
            let text = xml.attribute(tag, name)?.unwrap_or_default();
            let decimals = text.split_once('.').map_or(0, |(_, digits)| digits.len().min(15));
            Ok(Some((value, HALF / 10_f64.powi(decimals as i32))))
        };
        surface.declared = Declared { area: figure("area2DSurf")?, lowest: figure("elevMin")?, highest: figure("elevMax")? };
        while let Some(part) = xml.child()? {
            match part.name() {
                "Pnts" => self.points(xml, surface)?,
                "Faces" => faces(xml, surface)?,
                _ => xml.skip()?,
            }
        }
        Ok(())
    }

    fn points<'a>(&self, xml: &mut Xml<'a>, surface: &mut Surface) -> Result<(), ReadError> {
        while let Some(tag) = xml.child()? {
            if tag.name() != "P" {
                xml.skip()?;
                continue;
            }
            surface.vertices += 1;
            let Some(mesh) = &mut surface.mesh else {
                xml.skip()?;
                continue;
            };
            let Some(id) = xml.value(&tag, "id")? else {
                return Err(xml.refuse("a point of the surface has no id", tag.at, "<P> without id", "export the file again"));
            };
            let text = xml.content()?;
            let ([north, east, height], count) = few(xml, "P", &text, tag.at)?;
            if count != 3 {
                let figures = format!("`{}`: {count} numbers", clip(text.trim().as_bytes()));
                let what = "a point of the surface does not have three numbers";
                return Err(xml.refuse(what, tag.at, figures, "write northing, easting and elevation"));
            }
            let (x, y) = if self.exchanged { (north, east) } else { (east, north) };
            mesh.point(id.as_bytes(), DVec3::new(x, y, height));
        }
        Ok(())
    }
}

impl<'a> Visitor<'a> for Surfaces<'_> {
    fn element(&mut self, xml: &mut Xml<'a>, tag: &Tag<'a>, _around: &[Open<'a>]) -> Result<bool, ReadError> {
        let ours = tag.name() == "Surface";
        if ours {
            self.surface(xml, tag)?;
        }
        Ok(ours)
    }
}

impl Surface {
    fn source_data(&mut self, xml: &mut Xml<'_>) -> Result<(), ReadError> {
        while let Some(tag) = xml.child()? {
            if matches!(tag.name(), "Breaklines" | "Boundaries") {
                while xml.child()?.is_some() {
                    self.edges += 1;
                    xml.skip()?;
                }
            } else {
                xml.skip()?;
            }
        }
        Ok(())
    }

    /// Points and faces in the unit of `scale`; no faces if the surface has none. Tells what does not agree with what the
    /// surface says about itself.
    ///
    /// # Errors
    /// For ids that are missing or given twice, and for points alone where edges have been lost with the faces.
    pub(super) fn finish(
        mut self,
        text: &str,
        label: &str,
        header: &Header,
        scale: &Scale,
        notes: &mut Vec<Note>,
    ) -> Result<(Vec<DVec3>, RawFaces), ReadError> {
        let at = place(label, text, self.at);
        let name = clip(self.name.as_bytes());
        // The one that was chosen has been kept.
        let mesh = self.mesh.take().unwrap_or_else(Mesh::new);
        let (mut points, faces) = mesh.finish().map_err(|error| match error {
            IdError::Twice { id, points: [first, second] } => {
                let what = format!("two points of the surface `{name}` have the same id");
                let figures = format!("id `{}`: points {} and {} of the surface", clip(id.as_bytes()), first + 1, second + 1);
                refuse(&what, at.clone(), figures, "export the file again")
            }
            IdError::NoPoint { id, face } => {
                let what = format!("a face of the surface `{name}` has a corner that is not there");
                let at = face_at(text, self.at, face).map_or_else(|| at.clone(), |at| place(label, text, at));
                let figures = format!("no point has the id `{}`; there are {} points", clip(id.as_bytes()), self.vertices);
                refuse(&what, at, figures, "export the file again")
            }
        })?;
        if self.hidden > 0 {
            let message =
                format!("{} faces of the surface `{name}` are marked as hidden (i=\"1\") and were left out", self.hidden);
            notes.push(Note::new("landxml-hidden-faces", message));
        }
        if faces.is_empty() && self.hidden > 0 {
            return Err(refuse(
                "all faces of the surface are hidden",
                at,
                format!("{} faces with i=\"1\"", self.hidden),
                "export the file again",
            ));
        }
        if faces.is_empty() && self.edges > 0 {
            return Err(refuse(
                &format!("the surface `{name}` has no faces"),
                at,
                format!(
                    "{} points, and {} breaklines and boundaries that triangles of the points alone would not follow",
                    points.len(),
                    self.edges
                ),
                "export the surface with points and faces",
            ));
        }
        self.compare(&points, &faces, header, scale, notes);
        if (scale.plan, scale.height) != (1.0, 1.0) {
            let factor = DVec3::new(scale.plan, scale.plan, scale.height);
            points.iter_mut().for_each(|point| *point *= factor);
        }
        Ok((points, faces))
    }

    /// Tells what does not agree with the declared area and heights. `points` are in the units of the file.
    fn compare(&self, points: &[DVec3], faces: &RawFaces, header: &Header, scale: &Scale, notes: &mut Vec<Note>) {
        /// Rounding of coordinates that is to be reckoned with, in units of the file: where the third decimal is the last.
        const ROUNDING: f64 = 0.001;
        /// Areas that programs have summed in single precision.
        const SINGLE: f64 = 1e-6;
        let Declared { area, lowest, highest } = self.declared;
        if faces.is_empty() || (area.is_none() && lowest.is_none() && highest.is_none()) {
            return;
        }
        let found = Figures::of(points, faces);
        let name = clip(self.name.as_bytes());
        let unit = header.area(scale).map(|unit| unit / (scale.plan * scale.plan));
        if let (Some((declared, half)), Some(unit)) = (area, unit) {
            let around = 2.0 * (found.hi - found.lo).truncate().element_sum();
            let bound = (half * unit).max(ROUNDING * around).max(SINGLE * found.area);
            if (declared * unit - found.area).abs() > bound {
                let message = format!(
                    "the faces of the surface `{name}` have a plan area of {:.3}, but it declares {:.3}: some may be missing",
                    found.area,
                    declared * unit
                );
                notes.push(Note::new("landxml-area", message));
            }
        }
        for (declared, found, which) in [(lowest, found.lo.z, "lowest"), (highest, found.hi.z, "highest")] {
            if let Some((declared, half)) = declared
                && (declared - found).abs() > half.max(ROUNDING)
            {
                let message = format!(
                    "the {which} corner of the faces of the surface `{name}` lies at {found}, but it declares {declared}"
                );
                notes.push(Note::new("landxml-elevation", message));
            }
        }
    }
}

/// Box of the corners of faces, and their area in plan.
struct Figures {
    lo: DVec3,
    hi: DVec3,
    area: f64,
}

impl Figures {
    fn of(points: &[DVec3], faces: &RawFaces) -> Self {
        let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut sum = Sum::default();
        let mut add = |corners: &[u32]| {
            let at = |corner: &u32| points[*corner as usize];
            let Some(origin) = corners.first().map(at) else { return };
            let mut twice = 0.0;
            for (i, corner) in corners.iter().enumerate() {
                let (a, b) = (at(corner), at(&corners[(i + 1) % corners.len()]));
                lo = lo.min(a);
                hi = hi.max(a);
                twice += (a - origin).truncate().perp_dot((b - origin).truncate());
            }
            sum.add(0.5 * twice.abs());
        };
        match faces {
            RawFaces::Triangles(triangles) => triangles.iter().for_each(|t| add(t)),
            RawFaces::Polygons { corners, ends } => {
                let mut begin = 0;
                for &end in ends {
                    add(&corners[begin..end]);
                    begin = end;
                }
            }
        }
        Self { lo, hi, area: sum.value() }
    }
}

/// Reads `<Faces>`, up to its end.
fn faces<'a>(xml: &mut Xml<'a>, surface: &mut Surface) -> Result<(), ReadError> {
    while let Some(tag) = xml.child()? {
        if tag.name() != "F" {
            xml.skip()?;
            continue;
        }
        if hidden(xml, &tag)? {
            surface.hidden += 1;
            xml.skip()?;
            continue;
        }
        surface.faces += 1;
        let Some(mesh) = &mut surface.mesh else {
            xml.skip()?;
            continue;
        };
        let text = xml.content()?;
        let mut corners = [0_u32; 4];
        let mut count = 0;
        for field in fields(&text) {
            let id = mesh.id(field);
            if let Some(slot) = corners.get_mut(count) {
                *slot = id;
            }
            count += 1;
        }
        match (count, corners) {
            // Cells of grids have four corners; some writers name the last one twice.
            (3, [a, b, c, _]) => mesh.faces.triangle([a, b, c]),
            (4, [a, b, c, d]) if d == c || d == a => mesh.faces.triangle([a, b, c]),
            (4, _) => mesh.faces.polygon(&corners),
            _ => {
                let figures = format!("`{}`: {count} corners", clip(text.trim().as_bytes()));
                return Err(xml.refuse("a face does not have three or four corners", tag.at, figures, "export the file again"));
            }
        }
    }
    Ok(())
}

/// Whether a face is marked as not to be seen.
fn hidden<'a>(xml: &Xml<'a>, tag: &Tag<'a>) -> Result<bool, ReadError> {
    if !tag.has_attributes() {
        return Ok(false);
    }
    Ok(matches!(xml.value(tag, "i")?.as_deref(), Some("1" | "true")))
}

/// Where the visible face of this number stands, of the surface that begins at `surface`.
fn face_at(text: &str, surface: usize, face: usize) -> Option<usize> {
    let mut xml = Xml::new("", text);
    let (mut within, mut count) = (false, 0);
    loop {
        let tag = match xml.step().ok()? {
            super::xml::Step::Start(tag) => tag,
            super::xml::Step::End => continue,
            super::xml::Step::Done => return None,
        };
        within |= tag.at == surface;
        if within && tag.name() == "F" && !hidden(&xml, &tag).ok()? {
            if count == face {
                return Some(tag.at);
            }
            count += 1;
        }
    }
}
