//! Packed points of LAZ files: chunks, each unpacked by itself.

use super::cloud::Part;
use super::guard::guarded;
use super::header::Header;
use crate::model::Memory;
use crate::read::error::refuse;
use crate::read::{ReadError, room};
use laz::laszip::ChunkTable;
use laz::record::{LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor};
use laz::{DecompressionSelection, LazItem, LazItemType, LazVlr};
use rayon::prelude::*;
use std::io::Cursor;

/// Longest point record of a packed file, in bytes: the unpacker keeps some kilobytes for each. Records without extra bytes
/// take 67 at most.
const LONGEST_RECORD: usize = 2048;

const AGAIN: &str = "copy or export the file again";

/// Ways points are packed (`compressor` of the LASzip record).
const ONE_CHUNK: u16 = 1;
const CHUNKS: u16 = 2;
const LAYERS: u16 = 3;

/// One chunk: its points, and its bytes.
struct Chunk<'a> {
    count: usize,
    bytes: &'a [u8],
}

/// How the points of a file are packed.
struct Packing<'a> {
    header: &'a Header<'a>,
    items: Vec<LazItem>,
    layered: bool,
}

fn damaged(header: &Header<'_>, figures: impl Into<String>) -> ReadError {
    refuse("the LAZ file is damaged", header.label, figures, AGAIN)
}

/// Chunks unpacked before it is asked again whether there is room: what is in them shows only then.
const AT_ONCE: usize = 32;

/// Unpacks all points, chunk by chunk, in the order of the file.
pub(super) fn read(header: &Header<'_>, classes: &[bool; 256], memory: &Memory) -> Result<Part, ReadError> {
    let Some(record) = header.content(LazVlr::USER_ID, LazVlr::RECORD_ID) else {
        return Err(damaged(header, "it does not say how its points are packed"));
    };
    let way = record.get(..2).map_or(0, |bytes| u16::from_le_bytes([bytes[0], bytes[1]]));
    let vlr = LazVlr::read_from(record).map_err(|error| damaged(header, error.to_string()))?;
    let layered = header.format >= 6;
    let known = if layered { way == LAYERS } else { way == ONE_CHUNK || way == CHUNKS };
    let first = vlr.items().first().map(LazItem::item_type);
    let right = if layered { LazItemType::Point14 } else { LazItemType::Point10 };
    let sizes: usize = vlr.items().iter().map(|item| usize::from(item.size())).sum();
    let versions = vlr.items().iter().all(|item| (item.version() >= 3) == layered);
    if !known || first != Some(right) || sizes != header.record || !versions || header.record > LONGEST_RECORD {
        let figures = format!(
            "packed in way {way} in {} parts of {sizes} bytes, for records of format {} and {} bytes",
            vlr.items().len(),
            header.format,
            header.record
        );
        return Err(refuse("the points of the LAZ file are packed in a way that is not read", header.label, figures, AGAIN));
    }
    let chunks = if way == ONE_CHUNK {
        vec![Chunk { count: header.count, bytes: &header.bytes[header.from..] }]
    } else {
        chunks(header, &vlr)?
    };
    let packing = Packing { header, items: vlr.items().clone(), layered };
    let mut all = Part::default();
    for (group, chunks) in chunks.chunks(AT_ONCE).enumerate() {
        let most = all.len() + chunks.iter().map(|chunk| chunk.count).sum::<usize>();
        room::for_points(header.label, header.bytes.len(), most as u64, memory)?;
        // All results are kept, so that the first error is told and not any.
        let unpack = |(number, chunk)| packing.unpack(group * AT_ONCE + number, chunk, classes);
        let parts: Vec<Result<Part, ReadError>> = chunks.par_iter().enumerate().map(unpack).collect();
        for part in parts {
            all.append(part?);
        }
    }
    Ok(all)
}

/// The chunks of a file, by the table behind them.
fn chunks<'a>(header: &'a Header<'_>, vlr: &LazVlr) -> Result<Vec<Chunk<'a>>, ReadError> {
    let bytes = header.bytes;
    let place = |at: usize| bytes.get(at..at.checked_add(8)?).and_then(|b| b.try_into().ok()).map(i64::from_le_bytes);
    let begin = header.from + 8;
    let fits = |table: i64| usize::try_from(table).ok().filter(|table| *table >= begin && *table < bytes.len());
    // Where the points were written to a pipe, the place of the table stands at the end.
    let table = place(header.from).and_then(fits);
    let table = table.or_else(|| bytes.len().checked_sub(8).and_then(place).and_then(fits));
    let Some(table) = table else {
        return Err(damaged(header, "its table of chunks is not there: it was cut off, or never finished"));
    };
    let listed = bytes.get(table + 4..table + 8).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes) as usize;
    // Each chunk begins with a point that is not packed.
    let most = (table - begin) / header.record;
    if listed > most {
        return Err(damaged(header, format!("{listed} chunks in {} bytes", table - begin)));
    }
    let variable = vlr.uses_variable_size_chunks();
    let read = guarded(|| ChunkTable::read(&mut Cursor::new(&bytes[table..]), variable)).and_then(Result::ok);
    let Some(entries) = read else { return Err(damaged(header, "its table of chunks cannot be read")) };
    let entries: &[laz::laszip::ChunkTableEntry] = entries.as_ref();
    let (mut from, mut left) = (begin, header.count);
    let mut chunks = Vec::with_capacity(entries.len());
    for entry in entries {
        let end = usize::try_from(entry.byte_count).ok().and_then(|size| from.checked_add(size)).filter(|end| *end <= table);
        let Some(end) = end else {
            return Err(damaged(header, format!("chunk {} goes on behind the points", chunks.len() + 1)));
        };
        let holds = if variable { entry.point_count } else { u64::from(vlr.chunk_size()) };
        let count = usize::try_from(holds).unwrap_or(usize::MAX).min(left);
        if count > 0 {
            chunks.push(Chunk { count, bytes: &bytes[from..end] });
        }
        left -= count;
        from = end;
    }
    if left > 0 {
        let figures = format!("{} points by its header, {} in its chunks", header.count, header.count - left);
        return Err(refuse("the LAZ file has fewer points than its header says", header.label, figures, AGAIN));
    }
    Ok(chunks)
}

impl Packing<'_> {
    fn unpack(&self, number: usize, chunk: &Chunk<'_>, classes: &[bool; 256]) -> Result<Part, ReadError> {
        let failed = || damaged(self.header, format!("chunk {} cannot be unpacked", number + 1));
        if self.layered && !self.layers_fit(chunk) {
            return Err(failed());
        }
        let part = guarded(|| if self.layered { self.layers(chunk, classes) } else { self.sequence(chunk, classes) });
        part.flatten().ok_or_else(failed)
    }

    /// Whether the layers of a chunk lie in it: the unpacker makes room for them as they say.
    fn layers_fit(&self, chunk: &Chunk<'_>) -> bool {
        let layers: usize = self
            .items
            .iter()
            .map(|item| match item.item_type() {
                LazItemType::Point14 => 9,
                LazItemType::RGBNIR14 => 2,
                LazItemType::Byte14(count) => usize::from(count),
                _ => 1,
            })
            .sum();
        let word = |i: usize| {
            let from = self.header.record + 4 * i;
            chunk.bytes.get(from..from + 4).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes)
        };
        let sizes: Option<u64> = (1..=layers).map(|i| word(i).map(u64::from)).sum();
        let room = chunk.bytes.len() as u64;
        let count = word(0).is_some_and(|count| count as usize == chunk.count);
        count && sizes.is_some_and(|sizes| sizes + (self.header.record + 4 * (layers + 1)) as u64 <= room)
    }

    fn layers(&self, chunk: &Chunk<'_>, classes: &[bool; 256]) -> Option<Part> {
        let mut unpacker = LayeredPointRecordDecompressor::new(Cursor::new(chunk.bytes));
        unpacker.set_fields_from(&self.items).ok()?;
        let wanted = DecompressionSelection::xy_returns_channel().decompress_z().decompress_classification().decompress_flags();
        unpacker.set_selection(wanted);
        self.points(unpacker, chunk.count, classes)
    }

    fn sequence(&self, chunk: &Chunk<'_>, classes: &[bool; 256]) -> Option<Part> {
        let mut unpacker = SequentialPointRecordDecompressor::new(Cursor::new(chunk.bytes));
        unpacker.set_fields_from(&self.items).ok()?;
        self.points(unpacker, chunk.count, classes)
    }

    fn points<'a>(
        &self,
        mut unpacker: impl RecordDecompressor<Cursor<&'a [u8]>>,
        count: usize,
        classes: &[bool; 256],
    ) -> Option<Part> {
        if unpacker.record_size() != self.header.record {
            return None;
        }
        let mut record = vec![0; self.header.record];
        let mut part = Part::default();
        for _ in 0..count {
            unpacker.decompress_next(&mut record).ok()?;
            part.take(self.header, &record, classes);
        }
        Some(part)
    }
}
