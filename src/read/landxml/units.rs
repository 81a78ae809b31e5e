//! What a LandXML file says about its units and its reference system.

use super::xml::{Tag, Xml};
use crate::model::{LengthUnit, Note};
use crate::read::error::refuse;
use crate::read::geojson::kind_of;
use crate::read::{CoordinateKind, ReadError};

/// Square feet in an acre, and square metres in a hectare.
const ACRE: f64 = 43_560.0;
const HECTARE: f64 = 10_000.0;

/// A unit as declared: one of ours, times a factor.
type Declared = (LengthUnit, f64);

/// The declarations of a file.
#[derive(Debug, Default)]
pub(super) struct Header {
    linear: Option<Declared>,
    elevation: Option<Declared>,
    area: Option<String>,
    /// Name of the reference system.
    pub(super) crs: Option<String>,
}

/// What brings the numbers of a file to one of our units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// The unit.
    pub(super) unit: LengthUnit,
    /// Factor for lengths in plan.
    pub(super) plan: f64,
    /// Factor for heights.
    pub(super) height: f64,
}

impl Header {
    /// Reads `<Units>`, up to its end.
    ///
    /// # Errors
    /// For units that are not known.
    pub(super) fn units<'a>(&mut self, xml: &mut Xml<'a>) -> Result<(), ReadError> {
        while let Some(tag) = xml.child()? {
            let system = tag.name().to_owned();
            if matches!(system.as_str(), "Metric" | "Imperial") {
                self.linear = declared(xml, &tag, "linearUnit")?;
                self.elevation = declared(xml, &tag, "elevationUnit")?;
                self.area = xml.attribute(&tag, "areaUnit")?.map(|unit| unit.to_ascii_lowercase());
            }
            xml.skip()?;
        }
        Ok(())
    }

    /// Reads `<CoordinateSystem>`, its start tag only.
    ///
    /// # Errors
    /// If the tag is damaged.
    pub(super) fn system<'a>(&mut self, xml: &Xml<'a>, tag: &Tag<'a>) -> Result<(), ReadError> {
        const NAMES: [&str; 6] =
            ["ogcWktCode", "name", "horizontalCoordinateSystemName", "projectedCoordinateSystemName", "horizontalDatum", "desc"];
        let code = xml.attribute(tag, "epsgCode")?.filter(|code| code.bytes().any(|b| (b'1'..=b'9').contains(&b)));
        let mut name = code.map(|code| if code.bytes().all(|b| b.is_ascii_digit()) { format!("EPSG:{code}") } else { code });
        for attribute in NAMES {
            if name.is_none() {
                name = xml.attribute(tag, attribute)?;
            }
        }
        self.crs = name.or(self.crs.take());
        Ok(())
    }

    /// The scale, with `assumed` where the file declares no unit.
    ///
    /// # Errors
    /// Without either.
    pub(super) fn scale(&self, label: &str, assumed: Option<LengthUnit>, notes: &mut Vec<Note>) -> Result<Scale, ReadError> {
        let Some((unit, factor)) = self.linear.or(assumed.map(|unit| (unit, 1.0))) else {
            return Err(refuse(
                "the file does not say its unit of length",
                label,
                "there is no <Units> with a linearUnit: the numbers may be metres or feet",
                "give `--units m`, `--units ft` or `--units us-ft`",
            ));
        };
        let (mut plan, mut height) = (factor, factor);
        if let Some((other, of_other)) = self.elevation {
            // `feet` of heights does not say which; beside feet in plan it means the same.
            let feet = unit != LengthUnit::Metre && other != LengthUnit::Metre;
            height = of_other * if feet { 1.0 } else { other.per(unit) };
        }
        if height != plan {
            let factors = match (plan, height) {
                (1.0, height) => format!("the heights were multiplied by {height}"),
                (plan, 1.0) => format!("the plan was multiplied by {plan}"),
                (plan, height) => format!("the plan was multiplied by {plan}, the heights by {height}"),
            };
            let message = format!("heights are in another unit than the plan; to bring both to {}, {factors}", unit.plural());
            notes.push(Note::new("landxml-units", message));
        } else if plan != 1.0 {
            notes.push(Note::new(
                "landxml-units",
                format!("the numbers of the file were brought to {} by the factor {plan}", unit.plural()),
            ));
        }
        if self.linear.is_none() {
            plan = 1.0;
            notes.push(Note::new("landxml-units", format!("the file declares no unit and is taken to be in {}", unit.plural())));
        }
        Ok(Scale { unit, plan, height })
    }

    /// Square units of `scale` in one unit of declared areas; `None` if that is not known.
    pub(super) fn area(&self, scale: &Scale) -> Option<f64> {
        let metric = scale.unit == LengthUnit::Metre;
        match self.area.as_deref() {
            None => Some(scale.plan * scale.plan),
            Some("squaremeter") if metric => Some(1.0),
            Some("hectare") if metric => Some(HECTARE),
            Some("squarefoot") if !metric => Some(1.0),
            Some("acre") if !metric => Some(ACRE),
            Some(_) => None,
        }
    }

    /// Whether the reference system counts in degrees.
    pub(super) fn kind(&self) -> CoordinateKind {
        let Some(name) = &self.crs else { return CoordinateKind::Unknown };
        match kind_of(name) {
            // A name may be any text here.
            CoordinateKind::Lengths if !name.starts_with("EPSG:") => CoordinateKind::Unknown,
            kind => kind,
        }
    }
}

fn declared<'a>(xml: &Xml<'a>, tag: &Tag<'a>, attribute: &str) -> Result<Option<Declared>, ReadError> {
    let Some(word) = xml.attribute(tag, attribute)? else { return Ok(None) };
    match known(&word) {
        Some(declared) => Ok(Some(declared)),
        None => Err(xml.refuse(
            "the unit of length of the file is not known",
            tag.at,
            format!("{attribute}=\"{}\"", crate::read::error::clip(word.as_bytes())),
            "export the file in metres (meter), feet (foot) or US survey feet (USSurveyFoot)",
        )),
    }
}

/// Units of LandXML 1.2 (`metLinear`, `impLinear`, `elevationType`). The mile is left out: it does not say which foot it is of.
fn known(word: &str) -> Option<Declared> {
    let plain: String = word.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect();
    Some(match plain.as_str() {
        "meter" | "metre" | "meters" | "metres" | "m" => (LengthUnit::Metre, 1.0),
        "millimeter" | "millimetre" => (LengthUnit::Metre, 0.001),
        "centimeter" | "centimetre" => (LengthUnit::Metre, 0.01),
        "kilometer" | "kilometre" => (LengthUnit::Metre, 1000.0),
        "foot" | "feet" | "ft" | "internationalfoot" => (LengthUnit::Foot, 1.0),
        "inch" => (LengthUnit::Foot, 1.0 / 12.0),
        "ussurveyfoot" | "ussurveyfeet" => (LengthUnit::UsSurveyFoot, 1.0),
        _ => return None,
    })
}
