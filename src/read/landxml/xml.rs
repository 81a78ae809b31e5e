//! The elements of an XML file, one after the other and by their local names.
//!
//! Nothing is kept but the names of the elements that are open. A document type is passed over if it declares no entities, and
//! refused if it does: an entity can stand for more text than any memory holds.

use crate::model::Note;
use crate::read::error::{clip, refuse};
use crate::read::{ReadError, decode};
use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use std::borrow::Cow;

/// Elements that may be open at a time. LandXML nests some twelve deep, features within features a few more.
const DEEPEST: usize = 100;

/// How far into a file its declaration is looked for.
const HEAD: usize = 256;

/// The text of an XML file: by its byte order mark, else by its declaration, else UTF-8, else ISO-8859-1 with a note.
///
/// # Errors
/// When the bytes are no text, see [`decode::text`].
pub(super) fn text<'a>(label: &str, bytes: &'a [u8], notes: &mut Vec<Note>) -> Result<Cow<'a, str>, ReadError> {
    // UTF-16 shows itself by the zero bytes beside `<`, with or without a mark.
    let marked = match bytes {
        [b'<', 0, ..] => Some([b"\xFF\xFE", bytes].concat()),
        [0, b'<', ..] => Some([b"\xFE\xFF", bytes].concat()),
        _ => None,
    };
    if let Some(marked) = marked {
        return decode::text(label, &marked, notes).map(|text| Cow::Owned(text.into_owned()));
    }
    let head = bytes[..bytes.len().min(HEAD)].to_ascii_lowercase();
    let says = |name: &[u8]| head.starts_with(b"<?xml") && head.windows(name.len()).any(|window| window == name);
    let latin =
        [&b"iso-8859-1"[..], b"iso8859-1", b"latin1", b"windows-1252", b"cp1252"].into_iter().any(says) && !says(b"iso-8859-15");
    if latin && !bytes.is_ascii() {
        return Ok(Cow::Owned(bytes.iter().copied().map(decode::windows_1252).collect()));
    }
    decode::text(label, bytes, notes)
}

/// A start tag.
#[derive(Clone)]
pub(super) struct Tag<'a> {
    start: BytesStart<'a>,
    /// Where in the text it ends.
    pub(super) at: usize,
}

impl Tag<'_> {
    /// The name without its prefix.
    pub(super) fn name(&self) -> &str {
        self.start.local_name().into_inner()
    }

    /// Whether there is anything but the name.
    pub(super) fn has_attributes(&self) -> bool {
        !self.start.attributes_raw().is_empty()
    }
}

/// Reads a text element by element.
pub(super) struct Xml<'a> {
    pub(super) label: &'a str,
    text: &'a str,
    reader: Reader<&'a [u8]>,
    /// Elements that are open.
    depth: usize,
    /// Whether an element has been seen.
    begun: bool,
}

impl<'a> Xml<'a> {
    /// A reader at the beginning of `text`; `label` names it in messages.
    pub(super) fn new(label: &'a str, text: &'a str) -> Self {
        let mut reader = Reader::from_str(text);
        reader.config_mut().expand_empty_elements = true;
        Self { label, text, reader, depth: 0, begun: false }
    }

    /// The next tag or piece of content; comments and instructions among them.
    fn next(&mut self) -> Result<Event<'a>, ReadError> {
        let event = self.reader.read_event().map_err(|cause| {
            let at = self.reader.error_position().min(self.reader.buffer_position()) as usize;
            self.damaged(at, &cause.to_string())
        })?;
        match &event {
            Event::Start(_) => {
                self.depth += 1;
                self.begun = true;
                if self.depth > DEEPEST {
                    let figures = format!("more than {DEEPEST} elements are open");
                    return Err(self.refuse(
                        "elements are nested too deep",
                        self.here(),
                        figures,
                        "check the file; LandXML nests some twelve deep",
                    ));
                }
            }
            Event::End(_) => self.depth -= 1,
            Event::DocType(kind) if kind.contains("<!ENTITY") => {
                return Err(self.refuse(
                    "the file declares entities of its own",
                    self.here(),
                    "<!DOCTYPE … <!ENTITY …",
                    "take the document type out: LandXML has none, and entities are not expanded",
                ));
            }
            Event::Text(text) if self.depth == 0 && !text.trim().is_empty() => {
                let figures = format!("there is text outside of all elements: `{}`", clip(text.trim().as_bytes()));
                return Err(self.refuse("the file is no XML", self.here(), figures, "check the file"));
            }
            Event::Eof if self.depth > 0 || !self.begun => {
                let figures =
                    if self.begun { format!("{} elements are still open", self.depth) } else { "there are no elements".into() };
                return Err(self.refuse(
                    "the file ends before it is complete",
                    self.here(),
                    figures,
                    "export or copy the file again",
                ));
            }
            _ => {}
        }
        Ok(event)
    }

    /// What comes next: the beginning or the end of an element, at any depth, or the end of the file.
    pub(super) fn step(&mut self) -> Result<Step<'a>, ReadError> {
        loop {
            match self.next()? {
                Event::Start(start) => return Ok(Step::Start(self.tag(start))),
                Event::End(_) => return Ok(Step::End),
                Event::Eof => return Ok(Step::Done),
                _ => {}
            }
        }
    }

    /// The next child of the element that is open; `None` when it ends.
    pub(super) fn child(&mut self) -> Result<Option<Tag<'a>>, ReadError> {
        match self.step()? {
            Step::Start(tag) => Ok(Some(tag)),
            Step::End | Step::Done => Ok(None),
        }
    }

    /// Passes over the rest of the element that is open.
    pub(super) fn skip(&mut self) -> Result<(), ReadError> {
        let outside = self.depth.saturating_sub(1);
        while self.depth > outside {
            self.next()?;
        }
        Ok(())
    }

    /// The text of the element that is open, up to its end; that of its children is passed over.
    pub(super) fn content(&mut self) -> Result<Cow<'a, str>, ReadError> {
        let mut content: Cow<'a, str> = Cow::Borrowed("");
        loop {
            match self.next()? {
                Event::Text(piece) => join(&mut content, piece.into_inner()),
                Event::CData(piece) => join(&mut content, piece.into_inner()),
                Event::GeneralRef(reference) => {
                    let known = match reference.resolve_char_ref() {
                        Ok(Some(letter)) => Some(Cow::Owned(letter.to_string())),
                        _ => resolve_predefined_entity(&reference).map(Cow::Borrowed),
                    };
                    let Some(known) = known else {
                        let figures = format!("`&{};`", clip(reference.as_bytes()));
                        return Err(self.refuse("an entity is not known", self.here(), figures, "write the character itself"));
                    };
                    join(&mut content, known);
                }
                Event::Start(_) => self.skip()?,
                Event::End(_) | Event::Eof => return Ok(content),
                Event::Comment(_) | Event::PI(_) | Event::Decl(_) | Event::DocType(_) | Event::Empty(_) => {}
            }
        }
    }

    /// The value of an attribute of a tag, trimmed; `None` if it has none of that name or nothing but blanks.
    ///
    /// # Errors
    /// If the tag is damaged, or an entity in the value is not known.
    pub(super) fn attribute(&self, tag: &Tag<'a>, name: &str) -> Result<Option<String>, ReadError> {
        self.value(tag, name).map(|value| value.map(Cow::into_owned))
    }

    /// As [`Self::attribute`], without a copy.
    ///
    /// # Errors
    /// As [`Self::attribute`].
    #[inline]
    pub(super) fn value<'t>(&self, tag: &'t Tag<'a>, name: &str) -> Result<Option<Cow<'t, str>>, ReadError> {
        // Without checks: those for repeated names take the square of their number.
        for attribute in tag.start.attributes().with_checks(false) {
            let attribute = attribute.map_err(|cause| self.damaged(tag.at, &cause.to_string()))?;
            if attribute.key.into_inner() == name {
                let value = attribute
                    .normalized_value(XmlVersion::Implicit1_0)
                    .map_err(|cause| self.damaged(tag.at, &cause.to_string()))?;
                let value = match value {
                    Cow::Borrowed(value) => Cow::Borrowed(value.trim()),
                    Cow::Owned(value) => Cow::Owned(value.trim().to_owned()),
                };
                return Ok((!value.is_empty()).then_some(value));
            }
        }
        Ok(None)
    }

    /// An attribute that is a number.
    pub(super) fn number(&self, tag: &Tag<'a>, name: &str) -> Result<Option<f64>, ReadError> {
        let Some(text) = self.attribute(tag, name)? else { return Ok(None) };
        match crate::read::decimal::number(text.as_bytes()) {
            Some(value) if !value.is_nan() => Ok(Some(value)),
            _ => {
                let what = format!("an attribute of <{}> is no number", tag.name());
                let figures = format!("{name}=\"{}\"", clip(text.as_bytes()));
                Err(self.refuse(&what, tag.at, figures, "write it with a decimal point, as in 12.5"))
            }
        }
    }

    fn tag(&self, start: BytesStart<'a>) -> Tag<'a> {
        Tag { start, at: self.here() }
    }

    /// Where the reader stands in the text.
    pub(super) fn here(&self) -> usize {
        self.reader.buffer_position() as usize
    }

    /// File and line of a place in the text.
    pub(super) fn place(&self, at: usize) -> String {
        place(self.label, self.text, at)
    }

    /// An error at a place in the text.
    pub(super) fn refuse(&self, what: &str, at: usize, figures: impl Into<String>, help: &str) -> ReadError {
        refuse(what, self.place(at), figures, help)
    }

    fn damaged(&self, at: usize, cause: &str) -> ReadError {
        self.refuse("the file is damaged or cut off", at, cause, "export or copy the file again")
    }
}

/// What comes next.
pub(super) enum Step<'a> {
    /// An element begins.
    Start(Tag<'a>),
    /// An element ends.
    End,
    /// The file ends.
    Done,
}

/// File and line of a place in a text.
pub(super) fn place(label: &str, text: &str, at: usize) -> String {
    let before = &text.as_bytes()[..at.min(text.len())];
    format!("{label}, line {}", memchr::memchr_iter(b'\n', before).count() + 1)
}

fn join<'a>(content: &mut Cow<'a, str>, piece: Cow<'a, str>) {
    if content.is_empty() { *content = piece } else { content.to_mut().push_str(&piece) }
}
