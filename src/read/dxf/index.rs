//! What a drawing holds, and where: sections, units, layers, blocks. Reads the file once through to its end mark, so that what
//! follows can rely on a whole drawing.

use super::layers::Layers;
use super::names::{decode, key};
use super::pairs::{Pair, Pairs};
use crate::read::ReadError;
use crate::read::error::{clip, refuse};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// A block: its entities stand from `body` to its end mark.
pub(super) struct Block<'a> {
    pub(super) name: String,
    pub(super) base: DVec3,
    /// Whether it stands for another drawing.
    pub(super) external: bool,
    pub(super) body: Pairs<'a>,
    /// Number of pairs in it.
    pub(super) pairs: u64,
}

/// What a drawing holds.
pub(super) struct Index<'a> {
    /// `$INSUNITS`.
    pub(super) units: Option<i64>,
    pub(super) blocks: Vec<Block<'a>>,
    by_key: FxHashMap<String, usize>,
    /// Beginnings of the sections of entities.
    pub(super) entities: Vec<Pairs<'a>>,
    /// Number of pairs in blocks and in sections of entities.
    pub(super) pairs: u64,
}

impl<'a> Index<'a> {
    /// # Errors
    /// The file is no drawing, damaged or cut off.
    pub(super) fn read(label: &'a str, bytes: &'a [u8], layers: &mut Layers<'a>) -> Result<Self, ReadError> {
        let (blocks, by_key) = (Vec::new(), FxHashMap::default());
        let mut index = Self { units: None, blocks, by_key, entities: Vec::new(), pairs: 0 };
        let mut pairs = Pairs::new(label, bytes);
        loop {
            let pair = pairs.required()?;
            match (pair.code, pair.text()) {
                // A comment.
                (999, _) => {}
                (0, b"EOF") => return Ok(index),
                (0, b"SECTION") => index.section(&mut pairs, layers)?,
                _ => return Err(unexpected(label, &pair, "a section or the end of the drawing")),
            }
        }
    }

    /// The block of a name as it stands in the file.
    pub(super) fn block(&self, raw: &[u8]) -> Option<usize> {
        self.by_key.get(&key(&decode(raw))).copied()
    }

    fn section(&mut self, pairs: &mut Pairs<'a>, layers: &mut Layers<'a>) -> Result<(), ReadError> {
        let name = pairs.required()?;
        if name.code != 2 {
            return Err(unexpected(pairs.label, &name, "the name of a section, group code 2,"));
        }
        match name.text() {
            b"HEADER" => self.header(pairs),
            b"TABLES" => tables(pairs, layers),
            b"BLOCKS" => self.blocks(pairs),
            b"ENTITIES" => {
                self.entities.push(*pairs);
                self.pairs += skip_section(pairs)?;
                Ok(())
            }
            _ => skip_section(pairs).map(drop),
        }
    }

    fn header(&mut self, pairs: &mut Pairs<'a>) -> Result<(), ReadError> {
        let mut variable: &[u8] = b"";
        loop {
            let pair = pairs.required()?;
            match pair.code {
                0 => return section_end(pairs.label, &pair),
                9 => variable = pair.text(),
                70 if variable == b"$INSUNITS" => self.units = Some(pairs.whole(&pair)?),
                _ => {}
            }
        }
    }

    fn blocks(&mut self, pairs: &mut Pairs<'a>) -> Result<(), ReadError> {
        loop {
            let pair = pairs.required()?;
            match (pair.code, pair.text()) {
                (0, b"BLOCK") => self.one_block(pairs)?,
                (0, _) => return section_end(pairs.label, &pair),
                _ => {}
            }
        }
    }

    fn one_block(&mut self, pairs: &mut Pairs<'a>) -> Result<(), ReadError> {
        let (mut name, mut base, mut external): (&[u8], _, _) = (b"", DVec3::ZERO, false);
        while let Some(pair) = pairs.field()? {
            match pair.code {
                2 => name = pair.text(),
                10 => base.x = pairs.number(&pair)?,
                20 => base.y = pairs.number(&pair)?,
                30 => base.z = pairs.number(&pair)?,
                // 4: a reference, 8: one that is laid under.
                70 => external = pairs.whole(&pair)? & 12 != 0,
                _ => {}
            }
        }
        let body = *pairs;
        let mut count = 0;
        loop {
            let pair = pairs.required()?;
            match (pair.code, pair.text()) {
                (0, b"ENDBLK") => break,
                (0, kind @ (b"BLOCK" | b"ENDSEC" | b"SECTION" | b"EOF")) => {
                    let wanted = format!("the end of block `{}` before `{}`", decode(name), clip(kind));
                    return Err(unexpected(pairs.label, &pair, &wanted));
                }
                _ => count += 1,
            }
        }
        self.pairs += count;
        let name = decode(name);
        // Of two blocks of one name the first counts, as programs keep it.
        self.by_key.entry(key(&name)).or_insert(self.blocks.len());
        self.blocks.push(Block { name, base, external, body, pairs: count });
        Ok(())
    }
}

fn tables<'a>(pairs: &mut Pairs<'a>, layers: &mut Layers<'a>) -> Result<(), ReadError> {
    loop {
        let pair = pairs.required()?;
        match (pair.code, pair.text()) {
            (0, b"LAYER") => {
                let (mut name, mut off, mut frozen): (&[u8], _, _) = (b"", false, false);
                while let Some(pair) = pairs.field()? {
                    match pair.code {
                        2 => name = pair.text(),
                        62 => off = pairs.whole(&pair)? < 0,
                        70 => frozen = pairs.whole(&pair)? & 1 != 0,
                        _ => {}
                    }
                }
                layers.declare(name, off, frozen);
            }
            (0, b"TABLE" | b"ENDTAB") => {}
            (0, b"ENDSEC" | b"SECTION" | b"EOF") => return section_end(pairs.label, &pair),
            _ => {}
        }
    }
}

/// How many pairs were skipped.
fn skip_section(pairs: &mut Pairs<'_>) -> Result<u64, ReadError> {
    let mut count = 0;
    loop {
        let pair = pairs.required()?;
        if pair.code == 0 && matches!(pair.text(), b"ENDSEC" | b"SECTION" | b"EOF") {
            return section_end(pairs.label, &pair).map(|()| count);
        }
        count += 1;
    }
}

fn section_end(label: &str, pair: &Pair<'_>) -> Result<(), ReadError> {
    if pair.text() == b"ENDSEC" { Ok(()) } else { Err(unexpected(label, pair, "the end of the section")) }
}

fn unexpected(label: &str, pair: &Pair<'_>, wanted: &str) -> ReadError {
    let figures = format!("group code {} with `{}`, where {wanted} should stand", pair.code, clip(pair.text()));
    refuse("the drawing is damaged", pair.place.of(label), figures, "write or copy the file again")
}
