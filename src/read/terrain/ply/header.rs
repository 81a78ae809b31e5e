//! The header of a PLY file.

use crate::read::ReadError;
use crate::read::error::{clip, refuse};

/// How the data are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Little,
    Big,
}

/// Type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    Single,
    Double,
}

impl Scalar {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::Single,
            b"double" | b"float64" => Self::Double,
            _ => return None,
        })
    }

    /// Bytes of a binary number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::Single => 4,
            Self::Double => 8,
        }
    }

    pub(super) fn is_whole(self) -> bool {
        !matches!(self, Self::Single | Self::Double)
    }
}

/// What a property holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    One(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    /// As declared; nothing is allocated by it alone.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Index of a property of one of these names.
    pub(super) fn find(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|p| names.contains(&p.name.as_str()))
    }

    /// Bytes of one binary record; `None` if it has a list.
    pub(super) fn stride(&self) -> Option<usize> {
        self.properties.iter().map(|p| if let Kind::One(scalar) = p.kind { Some(scalar.size()) } else { None }).sum()
    }
}

pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the data begin.
    pub(super) body: usize,
}

/// Longest header looked at.
const LONGEST: usize = 1 << 20;

pub(super) fn read(label: &str, bytes: &[u8]) -> Result<Header, ReadError> {
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut begin = 0;
    for number in 1.. {
        let rest = &bytes[begin..bytes.len().min(LONGEST)];
        let Some(end) = rest.iter().position(|&b| b == b'\n' || b == b'\r') else {
            let help = "the file was cut off, or is no PLY file";
            return Err(refuse("the header of the PLY file has no end", label, "there is no line `end_header`", help));
        };
        let line = &rest[..end];
        begin += end + if rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
        let wrong = |what: &str| {
            let at = format!("{label}, line {number}");
            Err(refuse(what, at, format!("`{}`", clip(line)), "correct the header, or export the mesh again"))
        };
        let fields: Vec<&[u8]> = line.split(u8::is_ascii_whitespace).filter(|field| !field.is_empty()).collect();
        match fields.as_slice() {
            [b"ply"] if number == 1 => {}
            [] | [b"comment" | b"obj_info", ..] => {}
            [b"format", name, _version] => {
                encoding = Some(match *name {
                    b"ascii" => Encoding::Ascii,
                    b"binary_little_endian" => Encoding::Little,
                    b"binary_big_endian" => Encoding::Big,
                    _ => return wrong("the PLY file has an unknown format"),
                });
            }
            [b"element", name, count] => {
                let Some(count) = std::str::from_utf8(count).ok().and_then(|text| text.parse().ok()) else {
                    return wrong("the number of an element is not a whole number");
                };
                let name = String::from_utf8_lossy(name).into_owned();
                if elements.iter().any(|element| element.name == name) {
                    return wrong("an element is declared twice");
                }
                elements.push(Element { name, count, properties: Vec::new() });
            }
            [b"property", kind @ .., name] => {
                let Some(element) = elements.last_mut() else { return wrong("a property stands before the first element") };
                let kind = match kind {
                    [scalar] => Scalar::named(scalar).map(Kind::One),
                    [b"list", count, item] => match (Scalar::named(count), Scalar::named(item)) {
                        (Some(count), Some(item)) if count.is_whole() => Some(Kind::List { count, item }),
                        _ => None,
                    },
                    _ => None,
                };
                let Some(kind) = kind else { return wrong("a property has an unknown type") };
                let name = String::from_utf8_lossy(name).into_owned();
                if element.properties.iter().any(|property| property.name == name) {
                    return wrong("a property is declared twice");
                }
                element.properties.push(Property { name, kind });
            }
            [b"end_header"] => break,
            _ => return wrong("a line of the PLY header cannot be understood"),
        }
    }
    match encoding {
        Some(encoding) => Ok(Header { encoding, elements, body: begin }),
        None => Err(refuse("the PLY header does not name a format", label, "there is no line `format`", "export the mesh again")),
    }
}
