//! Points of a cloud → those that are ground.

use super::super::geokeys::{GeoKeys, Model, Unit};
use super::super::{RawGround, Said};
use super::header::Header;
use super::{Asked, packed, wkt};
use crate::model::{Memory, Note};
use crate::read::error::refuse;
use crate::read::pick::GROUND_CLASS;
use crate::read::{ReadError, room};
use glam::{DVec3, IVec3};
use rayon::prelude::*;

/// Points of one task.
const POINTS: usize = 65_536;

/// Points of a stretch of the file, and what was left out of it.
#[derive(Default)]
pub(super) struct Part {
    points: Vec<DVec3>,
    /// Points by class, those withheld not among them.
    counts: Vec<u64>,
    /// Points that were deleted, in a class asked for or not.
    withheld: u64,
    /// Points of the classes asked for that lie where strips overlap, and were marked to be left out.
    overlap: u64,
    /// Points taken outside of the box of the header.
    outside: u64,
}

/// The class of a record.
#[inline]
fn class(header: &Header<'_>, record: &[u8]) -> usize {
    usize::from(if header.format >= 6 { record[16] } else { record[15] & 0x1F })
}

impl Part {
    /// Looks at one record, which is as long as the header says.
    #[inline]
    pub(super) fn take(&mut self, header: &Header<'_>, record: &[u8], classes: &[bool; 256]) {
        self.counts.resize(256, 0);
        let class = class(header, record);
        let (withheld, overlap) = match header.format {
            6.. => (record[15] & 4 != 0, record[15] & 8 != 0),
            _ => (record[15] & 0x80 != 0, false),
        };
        if withheld {
            self.withheld += 1;
            return;
        }
        self.counts[class] += 1;
        if !classes[class] {
            return;
        }
        if overlap {
            self.overlap += 1;
            return;
        }
        let whole = |at: usize| i32::from_le_bytes([record[at], record[at + 1], record[at + 2], record[at + 3]]);
        let point = IVec3::new(whole(0), whole(4), whole(8)).as_dvec3() * header.scale + header.offset;
        // Boxes are rounded by some writers: one step of the coordinates is allowed.
        let inside = point.cmpge(header.lo - header.scale) & point.cmple(header.hi + header.scale);
        self.outside += u64::from(!inside.all());
        self.points.push(point);
    }

    /// Number of points taken.
    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    pub(super) fn append(&mut self, mut other: Self) {
        if self.points.is_empty() {
            self.points = other.points;
        } else {
            self.points.append(&mut other.points);
        }
        self.counts.resize(256, 0);
        self.counts.iter_mut().zip(&other.counts).for_each(|(sum, count)| *sum += count);
        self.withheld += other.withheld;
        self.overlap += other.overlap;
        self.outside += other.outside;
    }
}

/// Reads ground.
pub(super) fn read(
    label: &str,
    bytes: &[u8],
    (pick, memory): Asked<'_>,
    notes: &mut Vec<Note>,
) -> Result<(RawGround, Said), ReadError> {
    let header = Header::read(label, bytes)?;
    let keys = system(&header);
    if keys.model == Model::Geocentric {
        let help = format!(
            "project it, e.g. `pdal translate {label} projected.laz reprojection --filters.reprojection.out_srs=EPSG:25832`, with the EPSG code of your grid"
        );
        return Err(refuse("the point cloud is in geocentric coordinates", label, "no plan coordinates", &help));
    }
    let asked: &[u8] = if pick.classes.is_empty() { &[GROUND_CLASS] } else { &pick.classes };
    let mut classes = [false; 256];
    asked.iter().for_each(|class| classes[usize::from(*class)] = true);
    let mut found = if header.packed { packed::read(&header, &classes, memory)? } else { plain(&header, &classes, memory)? };
    if found.points.is_empty() {
        return Err(no_ground(&header, asked, &found));
    }
    let all: u64 = found.counts.iter().sum();
    let message = format!("{} of {all} points are ground, {}", found.points.len(), listed("class", "classes", asked));
    notes.push(Note::new("cloud-classes", message));
    for (count, why) in [(found.withheld, "marked as withheld"), (found.overlap, "marked as overlap")] {
        if count > 0 {
            let message = format!("left out {count} {} {why}", if count == 1 { "point" } else { "points" });
            notes.push(Note::new("cloud-left-out", message));
        }
    }
    if found.outside > 0 {
        let message = format!(
            "{} of {} ground points lie outside of the box the header gives, {} to {}: the file may be damaged",
            found.outside,
            found.points.len(),
            header.lo,
            header.hi
        );
        notes.push(Note::new("cloud-outside-box", message));
    }
    let (said, factor) = keys.settle(notes);
    if factor != 1.0 {
        found.points.iter_mut().for_each(|point| point.z *= factor);
    }
    if let Some(odd) = found.points.iter().find(|point| !point.is_finite()) {
        let help = "export the file again";
        return Err(refuse("coordinates of the LAS file are beyond all numbers", label, odd.to_string(), help));
    }
    Ok((RawGround::Points(found.points), said))
}

/// Points that are not packed.
fn plain(header: &Header<'_>, classes: &[bool; 256], memory: &Memory) -> Result<Part, ReadError> {
    let bytes = &header.bytes[header.from..];
    let there = bytes.len() / header.record;
    if there < header.count {
        let figures = format!("{} points by its header, {there} are there", header.count);
        let help = "copy or export the file again";
        return Err(refuse("the LAS file has fewer points than its header says", header.label, figures, help));
    }
    let points = &bytes[..header.count * header.record];
    if memory.limit().is_some() {
        let meant = |record: &[u8]| classes[class(header, record)];
        let most = points.par_chunks_exact(header.record).filter(|record| meant(record)).count();
        room::for_points(header.label, header.bytes.len(), most as u64, memory)?;
    }
    let parts: Vec<Part> = points
        .par_chunks(POINTS * header.record)
        .map(|stretch| {
            let mut part = Part::default();
            stretch.chunks_exact(header.record).for_each(|record| part.take(header, record, classes));
            part
        })
        .collect();
    let mut all = Part::default();
    parts.into_iter().for_each(|part| all.append(part));
    Ok(all)
}

/// The reference system: as text where the header says so or where there are no keys, else by its keys.
fn system(header: &Header<'_>) -> GeoKeys {
    const OWNER: &str = "LASF_Projection";
    let text = header.content(OWNER, 2112).map(wkt::read);
    let keys = header.content(OWNER, 34735).map(|directory| {
        let words: Vec<u16> = directory.chunks_exact(2).map(|b| u16::from_le_bytes([b[0], b[1]])).collect();
        let numbers = header.content(OWNER, 34736).unwrap_or(b"").chunks_exact(8);
        let numbers: Vec<f64> = numbers.filter_map(|b| b.try_into().ok()).map(f64::from_le_bytes).collect();
        GeoKeys::new(&words, &numbers, header.content(OWNER, 34737).unwrap_or(b""))
    });
    let (first, second) = if header.wkt { (text, keys) } else { (keys, text) };
    let (first, second) = (first.unwrap_or_default(), second.unwrap_or_default());
    // One may know a unit or a code the other does not.
    if first.model == Model::Unsaid {
        return second;
    }
    let same = first.model == second.model;
    let unit = |a: Unit, b: Unit| if same && a == Unit::Unsaid { b } else { a };
    let coded = |crs: &Option<String>| crs.as_ref().is_some_and(|crs| crs.starts_with("EPSG:"));
    let better = same && !coded(&first.crs) && coded(&second.crs);
    GeoKeys {
        crs: if better || first.crs.is_none() { second.crs } else { first.crs },
        plan: unit(first.plan, second.plan),
        heights: unit(first.heights, second.heights),
        ..first
    }
}

/// `class 2`, `classes 2 and 8`.
fn listed(one: &str, many: &str, classes: &[u8]) -> String {
    let numbers: Vec<String> = classes.iter().map(u8::to_string).collect();
    match numbers.as_slice() {
        [number] => format!("{one} {number}"),
        [before @ .., last] => format!("{many} {} and {last}", before.join(", ")),
        [] => many.to_owned(),
    }
}

/// No point is in a class asked for: tells which there are.
fn no_ground(header: &Header<'_>, asked: &[u8], found: &Part) -> ReadError {
    let there: Vec<(usize, u64)> = found.counts.iter().copied().enumerate().filter(|(_, count)| *count > 0).collect();
    let what = format!("the point cloud has no points of {}", listed("class", "classes", asked));
    let mut figures = if there.is_empty() {
        format!("all {} points are withheld", header.count)
    } else {
        let list: Vec<String> = there.iter().map(|(class, count)| format!("{class}{} with {count}", named(*class))).collect();
        format!("classes there: {}", list.join(", "))
    };
    if found.overlap > 0 {
        figures += &format!("; {} points of {} are marked as overlap", found.overlap, listed("class", "classes", asked));
    }
    let unclassified = !there.is_empty() && there.iter().all(|(class, _)| *class <= 1);
    let help = if unclassified {
        format!(
            "classify the ground first, e.g. `pdal translate {} ground.laz smrf`; or take all points with `--class 0,1`, where \
             nothing stands on the ground",
            header.label
        )
    } else {
        "give the classes that are ground with `--class`, such as `--class 2,8`".to_owned()
    };
    refuse(&what, header.label, figures, &help)
}

/// Meaning of the usual classes (ASPRS LAS 1.4 R15, tables 9 and 17; 8 and 12 have one in point formats 0 to 5 only), behind the
/// number.
fn named(class: usize) -> &'static str {
    match class {
        0 => " (never classified)",
        1 => " (unclassified)",
        2 => " (ground)",
        3..=5 => " (vegetation)",
        6 => " (building)",
        7 | 18 => " (noise)",
        8 => " (key points)",
        9 => " (water)",
        12 => " (overlap)",
        17 => " (bridge)",
        _ => "",
    }
}
