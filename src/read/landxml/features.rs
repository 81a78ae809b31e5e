//! Everything in a file that is a line: alignments, plan features, parcels, breaklines of surfaces.

use super::coord_geom::{Order, Part, Point, Shape};
use super::numbers::{few, list};
use super::walk::{Open, Visitor, named};
use super::xml::{Tag, Xml};
use crate::read::ReadError;
use crate::read::error::clip;
use rustc_hash::FxHashMap;

/// What a line is in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Alignment,
    /// A plan feature, or anything else with a `<CoordGeom>`.
    Plan,
    Parcel,
    Breakline,
}

impl Kind {
    pub(super) const ALL: [Self; 4] = [Self::Alignment, Self::Plan, Self::Breakline, Self::Parcel];

    /// Name in messages.
    pub(super) fn name(self, count: usize) -> &'static str {
        match (self, count) {
            (Self::Alignment, 1) => "alignment",
            (Self::Alignment, _) => "alignments",
            (Self::Plan, 1) => "plan feature",
            (Self::Plan, _) => "plan features",
            (Self::Parcel, 1) => "parcel",
            (Self::Parcel, _) => "parcels",
            (Self::Breakline, 1) => "breakline",
            (Self::Breakline, _) => "breaklines",
        }
    }
}

/// A line of the file.
pub(super) struct Feature {
    pub(super) kind: Kind,
    pub(super) name: Option<String>,
    /// Counted from 1 among those of its kind.
    pub(super) number: u32,
    /// Counted from 1 among all lines of the file.
    pub(super) position: u32,
    pub(super) at: usize,
    pub(super) parts: Vec<Part>,
    pub(super) road: Road,
}

impl Feature {
    /// How it is listed.
    pub(super) fn text(&self) -> String {
        match &self.name {
            Some(name) => format!("{} `{}`", self.kind.name(1), clip(name.as_bytes())),
            None => format!("{} {}", self.kind.name(1), self.number),
        }
    }
}

/// What only alignments have.
#[derive(Default)]
pub(super) struct Road {
    pub(super) start: f64,
    pub(super) length: Option<f64>,
    /// Station equations, which do not matter: profiles count in the stations of the alignment itself.
    pub(super) equations: usize,
    /// Points of intersection in place of elements.
    pub(super) by_corners: bool,
    pub(super) profiles: Vec<Heights>,
}

/// A profile as it stands in the file.
pub(super) struct Heights {
    pub(super) name: Option<String>,
    /// A profile of the ground and not of the design.
    pub(super) ground: bool,
    pub(super) at: usize,
    pub(super) points: Vec<RawPvi>,
}

/// Station and height, with a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct RawPvi {
    pub(super) station: f64,
    pub(super) height: f64,
    pub(super) curve: RawCurve,
}

/// A vertical curve as it stands in the file.
#[derive(Clone, Copy, Debug)]
pub(super) enum RawCurve {
    None,
    Parabola(f64, f64),
    /// Radius and length.
    Circle(Option<f64>, Option<f64>),
}

/// What a file holds.
pub(super) struct Features {
    order: Order,
    pub(super) found: Vec<Feature>,
    /// Points by name; `None` where two at different places have the same.
    pub(super) points: FxHashMap<String, Option<Point>>,
    pub(super) surfaces: usize,
}

impl Features {
    pub(super) fn new(exchanged: bool) -> Self {
        Self { order: Order { exchanged }, found: Vec::new(), points: FxHashMap::default(), surfaces: 0 }
    }

    fn add(&mut self, kind: Kind, name: Option<String>, at: usize, parts: Vec<Part>, road: Road) {
        // The last of its kind is mostly the last of all.
        let before = self.found.iter().rev().find(|feature| feature.kind == kind).map_or(0, |feature| feature.number);
        let position = u32::try_from(self.found.len() + 1).unwrap_or(u32::MAX);
        self.found.push(Feature { kind, name, number: before.saturating_add(1), position, at, parts, road });
    }

    fn named_point<'a>(&mut self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<(), ReadError> {
        let Some(name) = xml.attribute(tag, "name")? else { return xml.skip() };
        let alias = xml.attribute(tag, "pntRef")?;
        let text = xml.content()?;
        // Points of which nothing but the name is known are of no use to any line.
        let point = match (alias, text.trim().is_empty()) {
            (Some(alias), true) => Point::Named(alias),
            (None, true) => return Ok(()),
            _ => {
                let ([a, b, z], count) = few(xml, "CgPoint", &text, tag.at)?;
                match count {
                    2 => self.order.here(a, b, None),
                    3 => self.order.here(a, b, Some(z)),
                    _ => {
                        let figures = format!("`{}`: {count} numbers", clip(text.trim().as_bytes()));
                        let help = "write northing, easting and elevation";
                        return Err(xml.refuse("a point does not have three numbers", tag.at, figures, help));
                    }
                }
            }
        };
        let known = self.points.entry(name).or_insert_with(|| Some(point.clone()));
        if known.as_ref().is_some_and(|known| *known != point) {
            *known = None;
        }
        Ok(())
    }

    fn breakline<'a>(&mut self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<(), ReadError> {
        let name = named(xml, tag)?;
        let mut points = Vec::new();
        while let Some(part) = xml.child()? {
            match part.name() {
                "PntList2D" | "PntList3D" => points.extend(self.order.points(xml, &part)?),
                _ => xml.skip()?,
            }
        }
        if !points.is_empty() {
            let part = Part { at: tag.at, shape: Shape::Points(points), length: None };
            self.add(Kind::Breakline, name, tag.at, vec![part], Road::default());
        }
        Ok(())
    }

    fn alignment<'a>(&mut self, xml: &mut Xml<'a>, tag: &Tag<'a>) -> Result<(), ReadError> {
        let name = named(xml, tag)?;
        let start = xml.number(tag, "staStart")?.unwrap_or(0.0);
        let mut road = Road { start, length: xml.number(tag, "length")?, ..Road::default() };
        let mut parts = Vec::new();
        while let Some(part) = xml.child()? {
            match part.name() {
                "CoordGeom" => parts.extend(self.order.elements(xml)?),
                "AlignPIs" => {
                    road.by_corners = true;
                    xml.skip()?;
                }
                "StaEquation" => {
                    road.equations += 1;
                    xml.skip()?;
                }
                "Profile" => profiles(xml, &mut road.profiles)?,
                _ => xml.skip()?,
            }
        }
        self.add(Kind::Alignment, name, tag.at, parts, road);
        Ok(())
    }
}

impl<'a> Visitor<'a> for Features {
    fn element(&mut self, xml: &mut Xml<'a>, tag: &Tag<'a>, around: &[Open<'a>]) -> Result<bool, ReadError> {
        match tag.name() {
            "Alignment" => self.alignment(xml, tag)?,
            "CgPoint" => self.named_point(xml, tag)?,
            "Breakline" => self.breakline(xml, tag)?,
            "CoordGeom" => {
                let parent = around.last();
                let kind = if parent.is_some_and(|parent| parent.tag.name() == "Parcel") { Kind::Parcel } else { Kind::Plan };
                let name = match parent {
                    Some(parent) => parent.name(xml)?,
                    None => None,
                };
                let name = name.or(named(xml, tag)?);
                let parts = self.order.elements(xml)?;
                if !parts.is_empty() {
                    self.add(kind, name, tag.at, parts, Road::default());
                }
            }
            "Surface" => {
                self.surfaces += 1;
                return Ok(false);
            }
            // Points and faces: long, and none of them a line.
            "Definition" => xml.skip()?,
            _ => return Ok(false),
        }
        Ok(true)
    }
}

/// Reads `<Profile>`, up to its end.
fn profiles(xml: &mut Xml<'_>, out: &mut Vec<Heights>) -> Result<(), ReadError> {
    while let Some(tag) = xml.child()? {
        let ground = match tag.name() {
            "ProfAlign" => false,
            "ProfSurf" => true,
            _ => {
                xml.skip()?;
                continue;
            }
        };
        let name = named(xml, &tag)?;
        let mut points = Vec::new();
        while let Some(part) = xml.child()? {
            let curve = match part.name() {
                "PVI" => RawCurve::None,
                "ParaCurve" => {
                    let length = xml.number(&part, "length")?.unwrap_or(0.0);
                    RawCurve::Parabola(0.5 * length, 0.5 * length)
                }
                "UnsymParaCurve" => {
                    let length = |name| xml.number(&part, name).map(|length| length.unwrap_or(0.0));
                    RawCurve::Parabola(length("lengthIn")?, length("lengthOut")?)
                }
                "CircCurve" => RawCurve::Circle(xml.number(&part, "radius")?.map(f64::abs), xml.number(&part, "length")?),
                "PntList2D" => {
                    let text = xml.content()?;
                    let numbers = list(xml, "PntList2D", &text, part.at)?;
                    let (pairs, rest) = numbers.as_chunks::<2>();
                    if !rest.is_empty() {
                        let figures = format!("{} numbers, which 2 do not divide", numbers.len());
                        return Err(xml.refuse("a list of points is not complete", part.at, figures, "export the file again"));
                    }
                    points.extend(pairs.iter().map(|&[station, height]| RawPvi { station, height, curve: RawCurve::None }));
                    continue;
                }
                _ => {
                    xml.skip()?;
                    continue;
                }
            };
            let text = xml.content()?;
            let ([station, height, _], count) = few(xml, part.name(), &text, part.at)?;
            if count != 2 {
                let what = format!("<{}> does not have two numbers", part.name());
                let figures = format!("`{}`: {count} numbers", clip(text.trim().as_bytes()));
                return Err(xml.refuse(&what, part.at, figures, "write station and elevation"));
            }
            points.push(RawPvi { station, height, curve });
        }
        if !points.is_empty() {
            out.push(Heights { name, ground, at: tag.at, points });
        }
    }
    Ok(())
}
