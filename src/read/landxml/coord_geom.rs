//! `<CoordGeom>`: the elements of a line in plan, as they stand in the file.

use super::numbers::{few, fields, list};
use super::xml::{Tag, Xml};
use crate::read::ReadError;
use crate::read::error::clip;
use glam::DVec2;

/// A point as given: easting and northing, and its height if it has one; or the name of a point.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Point {
    Here(DVec2, Option<f64>),
    Named(String),
}

/// One element.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Where it stands.
    pub(super) at: usize,
    pub(super) shape: Shape,
    /// Its length, as declared.
    pub(super) length: Option<f64>,
}

/// What an element is.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// Points in a row.
    Points(Vec<Point>),
    Curve {
        from: Point,
        to: Point,
        centre: Option<Point>,
        radius: Option<f64>,
        left: bool,
    },
    Spiral {
        from: Point,
        to: Point,
        corner: Option<Point>,
        radii: [f64; 2],
        left: bool,
    },
}

/// How coordinates are written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Order {
    /// Easting before northing.
    pub(super) exchanged: bool,
}

impl Order {
    fn plan(self, first: f64, second: f64) -> DVec2 {
        if self.exchanged { DVec2::new(first, second) } else { DVec2::new(second, first) }
    }

    /// A point of two coordinates as they stand in the file, and its height.
    pub(super) fn here(self, first: f64, second: f64, height: Option<f64>) -> Point {
        Point::Here(self.plan(first, second), height)
    }

    /// The point in an element, by its content or by the point it names; the element is read up to its end.
    pub(super) fn point<'a>(self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<Point, ReadError> {
        let named = xml.attribute(tag, "pntRef")?;
        let text = xml.content()?;
        let (numbers, count) = few(xml, tag.name(), &text, tag.at)?;
        match (count, named, numbers) {
            (0, Some(name), _) => Ok(Point::Named(name)),
            (2, _, [a, b, _]) => Ok(self.here(a, b, None)),
            (3, _, [a, b, z]) => Ok(self.here(a, b, Some(z))),
            _ => {
                let what = format!("<{}> is no point", tag.name());
                let figures = format!("`{}`: {count} numbers", clip(text.trim().as_bytes()));
                Err(xml.refuse(&what, tag.at, figures, "write northing, easting and elevation, or name a point by its pntRef"))
            }
        }
    }

    /// The points of a `PntList2D` or `PntList3D`; the element is read up to its end.
    pub(super) fn points<'a>(self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<Vec<Point>, ReadError> {
        let size = if tag.name() == "PntList3D" { 3 } else { 2 };
        let text = xml.content()?;
        let numbers = list(xml, tag.name(), &text, tag.at)?;
        if numbers.len() % size != 0 {
            let figures = format!("{} numbers, which {size} do not divide", numbers.len());
            return Err(xml.refuse("a list of points is not complete", tag.at, figures, "export the file again"));
        }
        Ok(numbers.chunks_exact(size).map(|p| self.here(p[0], p[1], p.get(2).copied())).collect())
    }

    /// Reads `<CoordGeom>`, up to its end.
    ///
    /// # Errors
    /// For elements that are not complete, and spirals other than clothoids.
    pub(super) fn elements(self, xml: &mut Xml<'_>) -> Result<Vec<Part>, ReadError> {
        let mut parts = Vec::new();
        while let Some(tag) = xml.child()? {
            let length = xml.number(&tag, "length")?;
            let shape = match tag.name() {
                "Line" => self.ends(xml, &tag)?.line(),
                "IrregularLine" => self.ends(xml, &tag)?.irregular(),
                "Curve" => self.curve(xml, &tag)?,
                "Spiral" => self.spiral(xml, &tag)?,
                "Chain" => {
                    let text = xml.content()?;
                    let name = |field: &[u8]| Point::Named(String::from_utf8_lossy(field).into_owned());
                    Shape::Points(fields(&text).map(name).collect())
                }
                _ => {
                    xml.skip()?;
                    continue;
                }
            };
            parts.push(Part { at: tag.at, shape, length });
        }
        Ok(parts)
    }

    fn ends<'a>(self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<Ends, ReadError> {
        let (mut from, mut to) = (None, None);
        let mut ends = Ends {
            from: Point::Named(String::new()),
            to: Point::Named(String::new()),
            centre: None,
            corner: None,
            list: Vec::new(),
        };
        while let Some(part) = xml.child()? {
            match part.name() {
                "Start" => from = Some(self.point(xml, &part)?),
                "End" => to = Some(self.point(xml, &part)?),
                "Center" => ends.centre = Some(self.point(xml, &part)?),
                "PI" => ends.corner = Some(self.point(xml, &part)?),
                "PntList2D" | "PntList3D" => ends.list.extend(self.points(xml, &part)?),
                _ => xml.skip()?,
            }
        }
        if tag.name() == "IrregularLine" {
            from = from.or_else(|| ends.list.first().cloned());
            to = to.or_else(|| ends.list.last().cloned());
        }
        let (Some(from), Some(to)) = (from, to) else {
            let what = format!("<{}> is not complete", tag.name());
            return Err(xml.refuse(&what, tag.at, "it lacks <Start> or <End>", "export the file again"));
        };
        Ok(Ends { from, to, ..ends })
    }

    fn curve<'a>(self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<Shape, ReadError> {
        let left = left(xml, tag)?;
        let radius = xml.number(tag, "radius")?;
        let Ends { from, to, centre, .. } = self.ends(xml, tag)?;
        if centre.is_none() && radius.is_none() {
            return Err(xml.refuse(
                "<Curve> is not complete",
                tag.at,
                "it has neither <Center> nor a radius",
                "export the file again",
            ));
        }
        Ok(Shape::Curve { from, to, centre, radius, left })
    }

    fn spiral<'a>(self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<Shape, ReadError> {
        let left = left(xml, tag)?;
        let kind = xml.attribute(tag, "spiType")?;
        if let Some(kind) = kind.filter(|kind| !kind.eq_ignore_ascii_case("clothoid")) {
            let figures = format!("spiType=\"{}\"", clip(kind.as_bytes()));
            let help = "export the line as a polyline, with its points close enough for the tolerance";
            return Err(xml.refuse("a spiral is no clothoid", tag.at, figures, help));
        }
        let mut radii = [0.0; 2];
        for (slot, name) in radii.iter_mut().zip(["radiusStart", "radiusEnd"]) {
            let radius = xml.number(tag, name)?.map(f64::abs).filter(|radius| *radius > 0.0);
            let Some(radius) = radius else {
                let figures = format!("{name} is missing or nought");
                return Err(xml.refuse(
                    "a spiral has no radius at one end",
                    tag.at,
                    figures,
                    "write INF where it joins a straight",
                ));
            };
            *slot = radius;
        }
        let Ends { from, to, corner, .. } = self.ends(xml, tag)?;
        Ok(Shape::Spiral { from, to, corner, radii, left })
    }
}

/// The points of an element.
struct Ends {
    from: Point,
    to: Point,
    centre: Option<Point>,
    corner: Option<Point>,
    list: Vec<Point>,
}

impl Ends {
    fn line(self) -> Shape {
        Shape::Points(vec![self.from, self.to])
    }

    /// The list, with the ends before and behind it unless they are in it.
    fn irregular(self) -> Shape {
        let Self { from, to, mut list, .. } = self;
        let same = |a: Option<&Point>, b: &Point| match (a, b) {
            (Some(Point::Here(a, _)), Point::Here(b, _)) => a.distance(*b) <= super::lines::JOIN,
            (a, b) => a == Some(b),
        };
        if !same(list.first(), &from) {
            list.insert(0, from);
        }
        if !same(list.last(), &to) {
            list.push(to);
        }
        Shape::Points(list)
    }
}

/// Whether a curve turns to the left.
fn left<'a>(xml: &Xml<'a>, tag: &Tag<'a>) -> Result<bool, ReadError> {
    match xml.attribute(tag, "rot")?.map(|rot| rot.to_ascii_lowercase()).as_deref() {
        Some("ccw") => Ok(true),
        Some("cw") => Ok(false),
        other => {
            let what = format!("<{}> does not say which way it turns", tag.name());
            let figures = format!("rot=\"{}\"", clip(other.unwrap_or("").as_bytes()));
            Err(xml.refuse(&what, tag.at, figures, "write cw (to the right) or ccw (to the left)"))
        }
    }
}
