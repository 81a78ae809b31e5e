//! Through a whole file, element by element.

use super::units::Header;
use super::xml::{Step, Tag, Xml};
use crate::read::ReadError;
use crate::read::error::clip;
use std::cell::OnceCell;

/// Letters of a name that are kept. Names come with every line, and a file can have many lines of one element.
const LONGEST_NAME: usize = 256;

/// An element that is open.
pub(super) struct Open<'a> {
    pub(super) tag: Tag<'a>,
    name: OnceCell<Option<String>>,
}

impl<'a> Open<'a> {
    /// Its attribute `name`. Looked for only once, however many children ask for it.
    pub(super) fn name(&self, xml: &Xml<'a>) -> Result<Option<String>, ReadError> {
        match self.name.get() {
            Some(name) => Ok(name.clone()),
            None => {
                let name = named(xml, &self.tag)?;
                Ok(self.name.get_or_init(|| name).clone())
            }
        }
    }
}

/// The attribute `name` of an element, as far as it is kept.
///
/// # Errors
/// If the tag is damaged.
pub(super) fn named<'a>(xml: &Xml<'a>, tag: &Tag<'a>) -> Result<Option<String>, ReadError> {
    let name = xml.attribute(tag, "name")?;
    Ok(name.map(|name| if name.len() > LONGEST_NAME { name.chars().take(LONGEST_NAME).collect() } else { name }))
}

/// What is looked for in a file.
pub(super) trait Visitor<'a> {
    /// Called for every element that is not inside one already taken, with those that are open around it. Either reads the
    /// element up to its end and says so, or leaves it as it is.
    ///
    /// # Errors
    /// When the element cannot be understood.
    fn element(&mut self, xml: &mut Xml<'a>, tag: &Tag<'a>, around: &[Open<'a>]) -> Result<bool, ReadError>;
}

/// Leads a visitor through a file. Elements that are not known are looked into, wherever they stand and whatever their namespace.
///
/// # Errors
/// Those of the visitor; a root that is not `LandXML`; files that are damaged.
pub(super) fn walk<'a>(xml: &mut Xml<'a>, visitor: &mut impl Visitor<'a>) -> Result<Header, ReadError> {
    let mut header = Header::default();
    let mut around: Vec<Open<'a>> = Vec::new();
    loop {
        match xml.step()? {
            Step::Done => return Ok(header),
            Step::End => drop(around.pop()),
            Step::Start(tag) => {
                if around.is_empty() && !tag.name().eq_ignore_ascii_case("LandXML") {
                    let figures = format!("its root element is <{}>, not <LandXML>", clip(tag.name().as_bytes()));
                    return Err(xml.refuse("the XML file is not LandXML", tag.at, figures, "export as LandXML"));
                }
                match tag.name() {
                    "Units" => header.units(xml)?,
                    "CoordinateSystem" => {
                        header.system(xml, &tag)?;
                        xml.skip()?;
                    }
                    _ if visitor.element(xml, &tag, &around)? => {}
                    _ => around.push(Open { tag, name: OnceCell::new() }),
                }
            }
        }
    }
}
