//! Single entities: their pairs → coordinates.

use super::pairs::{Pair, Pairs, Place};
use super::transform::{Insertion, sin_cos};
use crate::read::ReadError;
use crate::read::error::refuse;
use glam::{DVec2, DVec3};

/// What all entities have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Common<'a> {
    pub(super) layer: &'a [u8],
    /// Whether it lies in paper space: on a sheet, not in the drawing.
    pub(super) paper: bool,
    pub(super) invisible: bool,
    pub(super) extrusion: DVec3,
}

impl Default for Common<'_> {
    fn default() -> Self {
        Self { layer: b"0", paper: false, invisible: false, extrusion: DVec3::Z }
    }
}

impl<'a> Common<'a> {
    /// Takes a pair that is not the entity's own.
    fn take(&mut self, pairs: &Pairs<'a>, pair: &Pair<'a>) -> Result<(), ReadError> {
        match pair.code {
            8 => self.layer = pair.text(),
            60 => self.invisible = pairs.whole(pair)? != 0,
            67 => self.paper = pairs.whole(pair)? != 0,
            210 => self.extrusion.x = pairs.number(pair)?,
            220 => self.extrusion.y = pairs.number(pair)?,
            230 => self.extrusion.z = pairs.number(pair)?,
            _ => {}
        }
        Ok(())
    }
}

/// An entity that is passed over, whatever its values are.
pub(super) fn other<'a>(pairs: &mut Pairs<'a>) -> Result<Common<'a>, ReadError> {
    let mut common = Common::default();
    while let Some(pair) = pairs.field()? {
        match pair.code {
            8 => common.layer = pair.text(),
            60 => common.invisible = pairs.whole(&pair).is_ok_and(|n| n != 0),
            67 => common.paper = pairs.whole(&pair).is_ok_and(|n| n != 0),
            _ => {}
        }
    }
    Ok(common)
}

/// Coordinates that are not there yet; none that is read is NaN.
const NOWHERE: DVec3 = DVec3::NAN;

/// A point whose coordinates have been read. Without elevation it lies at 0, as all of a drawing in two dimensions.
///
/// # Errors
/// It has no `x` or no `y`.
#[inline]
fn located(point: DVec3, label: &str, place: Place) -> Result<DVec3, ReadError> {
    if point.x.is_nan() || point.y.is_nan() {
        let figures = match (point.x.is_nan(), point.y.is_nan()) {
            (true, true) => "neither x (group codes 10 to 13) nor y (20 to 23)",
            (true, false) => "no x (group codes 10 to 13)",
            _ => "no y (group codes 20 to 23)",
        };
        let help = "write the drawing again, or take the entity out";
        return Err(refuse("a point of the drawing lacks coordinates", place.of(label), figures, help));
    }
    Ok(if point.z.is_nan() { point.with_z(0.0) } else { point })
}

/// Up to four points: POINT (one), LINE (two), 3DFACE (four). A face without fourth corner is a triangle: its third is repeated
/// (Autodesk, "DXF Reference", 3DFACE).
#[inline]
pub(super) fn corners<'a, const N: usize>(pairs: &mut Pairs<'a>, place: Place) -> Result<(Common<'a>, [DVec3; N]), ReadError> {
    let mut common = Common::default();
    let mut points = [NOWHERE; N];
    while let Some(pair) = pairs.field()? {
        let (axis, i) = (pair.code / 10, (pair.code % 10) as usize);
        match points.get_mut(i) {
            Some(point) if axis == 1 => point.x = pairs.number(&pair)?,
            Some(point) if axis == 2 => point.y = pairs.number(&pair)?,
            Some(point) if axis == 3 => point.z = pairs.number(&pair)?,
            _ => common.take(pairs, &pair)?,
        }
    }
    if N == 4 && points[N - 1].to_array().iter().all(|c| c.is_nan()) {
        points[N - 1] = points[N - 2];
    }
    for point in &mut points {
        *point = located(*point, pairs.label, place)?;
    }
    Ok((common, points))
}

/// A vertex of a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vertex {
    pub(super) at: DVec3,
    /// Of the segment that begins here.
    pub(super) bulge: f64,
    pub(super) place: Place,
}

/// A polyline of either kind.
#[derive(Clone, Debug, Default)]
pub(super) struct Polyline {
    pub(super) vertices: Vec<Vertex>,
    pub(super) closed: bool,
    /// Whether it is level by its kind, with its vertices in a system of its own.
    pub(super) planar: bool,
    /// Whether it is planar by its kind, though its vertices have heights.
    pub(super) uneven: bool,
    /// Number of vertices the file promises, where it is another.
    pub(super) promised: Option<i64>,
}

/// An ARC, as a polyline of two arcs, for one bulge cannot tell a whole circle.
pub(super) fn arc<'a>(pairs: &mut Pairs<'a>, place: Place) -> Result<(Common<'a>, Polyline), ReadError> {
    let mut common = Common::default();
    let (mut centre, mut radius, mut start, mut end) = (DVec3::ZERO, 0.0, 0.0, 360.0);
    while let Some(pair) = pairs.field()? {
        match pair.code {
            10 => centre.x = pairs.number(&pair)?,
            20 => centre.y = pairs.number(&pair)?,
            30 => centre.z = pairs.number(&pair)?,
            40 => radius = pairs.number(&pair)?,
            50 => start = pairs.number(&pair)?,
            51 => end = pairs.number(&pair)?,
            _ => common.take(pairs, &pair)?,
        }
    }
    // Counter-clockwise from start to end, in degrees.
    let turn = (end - start).rem_euclid(360.0);
    let turn: f64 = if turn == 0.0 { 360.0 } else { turn };
    let bulge = (turn.to_radians() / 8.0).tan();
    let at = |degrees: f64| {
        let (sin, cos) = sin_cos(degrees);
        centre + radius * DVec3::new(cos, sin, 0.0)
    };
    let vertices = [start, start + 0.5 * turn, start + turn].map(|degrees| Vertex { at: at(degrees), bulge, place });
    Ok((common, Polyline { vertices: vertices.to_vec(), planar: true, ..Polyline::default() }))
}

pub(super) fn lwpolyline<'a>(pairs: &mut Pairs<'a>) -> Result<(Common<'a>, Polyline), ReadError> {
    let mut common = Common::default();
    let mut line = Polyline { planar: true, ..Polyline::default() };
    let (mut elevation, mut promised) = (0.0, None);
    while let Some(pair) = pairs.field()? {
        match (pair.code, line.vertices.last_mut()) {
            (10, _) => {
                let at = NOWHERE.with_x(pairs.number(&pair)?);
                line.vertices.push(Vertex { at, bulge: 0.0, place: pair.place });
            }
            (20, Some(vertex)) => vertex.at.y = pairs.number(&pair)?,
            (42, Some(vertex)) => vertex.bulge = pairs.number(&pair)?,
            (38, _) => elevation = pairs.number(&pair)?,
            (70, _) => line.closed = pairs.whole(&pair)? & 1 != 0,
            (90, _) => promised = Some(pairs.whole(&pair)?),
            _ => common.take(pairs, &pair)?,
        }
    }
    for vertex in &mut line.vertices {
        vertex.at = located(vertex.at.with_z(elevation), pairs.label, vertex.place)?;
    }
    line.promised = promised.filter(|&n| usize::try_from(n) != Ok(line.vertices.len()));
    Ok((common, line))
}

/// The head of a POLYLINE; its vertices follow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Head<'a> {
    pub(super) common: Common<'a>,
    place: Place,
    flags: i64,
    elevation: f64,
    /// Numbers of rows and columns of a mesh.
    size: [i64; 2],
    smooth: [i64; 2],
}

/// What a POLYLINE stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Line,
    /// Rows and columns of points.
    Net,
    /// Points, and faces by their numbers.
    Polyface,
}

impl<'a> Head<'a> {
    pub(super) fn read(pairs: &mut Pairs<'a>, place: Place) -> Result<Self, ReadError> {
        let common = Common::default();
        let mut head = Self { common, place, flags: 0, elevation: 0.0, size: [0; 2], smooth: [0; 2] };
        while let Some(pair) = pairs.field()? {
            match pair.code {
                30 => head.elevation = pairs.number(&pair)?,
                70 => head.flags = pairs.whole(&pair)?,
                71 => head.size[0] = pairs.whole(&pair)?,
                72 => head.size[1] = pairs.whole(&pair)?,
                73 => head.smooth[0] = pairs.whole(&pair)?,
                74 => head.smooth[1] = pairs.whole(&pair)?,
                _ => head.common.take(pairs, &pair)?,
            }
        }
        Ok(head)
    }

    pub(super) fn kind(&self) -> Kind {
        match self.flags {
            flags if flags & 64 != 0 => Kind::Polyface,
            flags if flags & 16 != 0 => Kind::Net,
            _ => Kind::Line,
        }
    }

    /// Calls `take` for every VERTEX up to the SEQEND.
    fn vertices(&self, pairs: &mut Pairs<'a>, mut take: impl FnMut(Part) -> Result<(), ReadError>) -> Result<(), ReadError> {
        loop {
            let pair = pairs.required()?;
            match (pair.code, pair.text()) {
                (0, b"VERTEX") => take(Part::read(pairs, pair.place)?)?,
                (0, b"SEQEND") => return other(pairs).map(drop),
                _ => {
                    let figures = "its vertices do not end with SEQEND";
                    let help = "write or copy the file again";
                    return Err(refuse("a POLYLINE of the drawing is damaged", self.place.of(pairs.label), figures, help));
                }
            }
        }
    }

    /// Passes over the vertices.
    pub(super) fn skip(&self, pairs: &mut Pairs<'a>) -> Result<(), ReadError> {
        loop {
            let before = *pairs;
            let pair = pairs.required()?;
            match (pair.code, pair.text()) {
                (0, b"SEQEND") => return other(pairs).map(drop),
                (0, b"VERTEX") => {}
                (0, _) => {
                    // Says what is wrong.
                    *pairs = before;
                    return self.vertices(pairs, |_| Ok(()));
                }
                _ => {}
            }
        }
    }

    pub(super) fn line(&self, pairs: &mut Pairs<'a>) -> Result<Polyline, ReadError> {
        let (planar, label) = (self.flags & 8 == 0, pairs.label);
        let mut line = Polyline { planar, closed: self.flags & 1 != 0, ..Polyline::default() };
        self.vertices(pairs, |part| {
            // Control points of splines are not on the line.
            if part.flags & 16 == 0 {
                let bulge = if planar { part.bulge } else { 0.0 };
                line.vertices.push(Vertex { at: part.point(label)?, bulge, place: part.place });
            }
            Ok(())
        })?;
        if planar {
            let uneven = line.vertices.iter().find(|v| v.at.z != 0.0 && v.at.z != self.elevation);
            match uneven {
                Some(vertex) if self.elevation != 0.0 => {
                    let figures = format!("elevation of the polyline {}, of this vertex {}", self.elevation, vertex.at.z);
                    let help = "make it a 3D polyline, with the heights that hold at its vertices";
                    let what = "a polyline of the drawing has two elevations at one place";
                    return Err(refuse(what, vertex.place.of(pairs.label), figures, help));
                }
                Some(_) => line.uneven = true,
                None => line.vertices.iter_mut().for_each(|vertex| vertex.at.z = self.elevation),
            }
        }
        Ok(line)
    }

    /// Points of a polyface mesh, and faces as their numbers, counted from 0; the last corner of triangles is repeated, faces of
    /// two corners are lines and left out.
    pub(super) fn polyface(&self, pairs: &mut Pairs<'a>) -> Result<(Vec<DVec3>, Vec<[u32; 4]>), ReadError> {
        let label = pairs.label;
        let (mut points, mut faces) = (Vec::new(), Vec::new());
        self.vertices(pairs, |part| {
            if part.flags & 64 != 0 {
                points.push(part.point(label)?);
                return Ok(());
            }
            // A negative number hides the edge that begins there; 0 is no corner.
            let mut corners = part.corners.iter().filter(|&&c| c != 0).map(|c| c.unsigned_abs() - 1);
            let (Some(a), Some(b), Some(c)) = (corners.next(), corners.next(), corners.next()) else { return Ok(()) };
            let face = [a, b, c, corners.next().unwrap_or(c)];
            match face.into_iter().find(|&corner| corner >= points.len() as u64) {
                Some(corner) => {
                    let figures = format!("corner {}, {} points before it", corner.saturating_add(1), points.len());
                    let what = "a face of a polyface mesh has a corner that is not there";
                    Err(refuse(what, part.place.of(label), figures, "write the drawing again"))
                }
                None => {
                    faces.push(face.map(|corner| corner as u32));
                    Ok(())
                }
            }
        })?;
        Ok((points, faces))
    }

    /// Faces of a net.
    pub(super) fn net(&self, pairs: &mut Pairs<'a>) -> Result<(Vec<DVec3>, Vec<[u32; 4]>), ReadError> {
        let (mut points, label) = (Vec::new(), pairs.label);
        self.vertices(pairs, |part| {
            if part.flags & 16 == 0 {
                points.push(part.point(label)?);
            }
            Ok(())
        })?;
        let size = if self.flags & 4 != 0 { self.smooth } else { self.size };
        let [rows, columns] = size.map(|n| usize::try_from(n).unwrap_or(0));
        if rows < 2 || columns < 2 || rows.checked_mul(columns) != Some(points.len()) || u32::try_from(points.len()).is_err() {
            let figures = format!("{} by {} vertices are promised, {} are there", size[0], size[1], points.len());
            let what = "a polygon mesh of the drawing is damaged";
            return Err(refuse(what, self.place.of(pairs.label), figures, "write the drawing again"));
        }
        let at = |row: usize, column: usize| (row % rows * columns + column % columns) as u32;
        let down = if self.flags & 1 != 0 { rows } else { rows - 1 };
        let across = if self.flags & 32 != 0 { columns } else { columns - 1 };
        let faces = (0..down)
            .flat_map(|m| (0..across).map(move |n| (m, n)))
            .map(|(m, n)| [at(m, n), at(m + 1, n), at(m + 1, n + 1), at(m, n + 1)])
            .collect();
        Ok((points, faces))
    }
}

/// A VERTEX.
struct Part {
    place: Place,
    /// Faces of polyface meshes need none.
    at: DVec3,
    bulge: f64,
    flags: i64,
    corners: [i64; 4],
}

impl Part {
    /// Where it is.
    #[inline]
    fn point(&self, label: &str) -> Result<DVec3, ReadError> {
        located(self.at, label, self.place)
    }

    #[inline]
    fn read(pairs: &mut Pairs<'_>, place: Place) -> Result<Self, ReadError> {
        let mut part = Self { place, at: NOWHERE, bulge: 0.0, flags: 0, corners: [0; 4] };
        while let Some(pair) = pairs.field()? {
            match pair.code {
                10 => {
                    part.at.x = pairs.number(&pair)?;
                    part.place = pair.place;
                }
                20 => part.at.y = pairs.number(&pair)?,
                30 => part.at.z = pairs.number(&pair)?,
                42 => part.bulge = pairs.number(&pair)?,
                70 => part.flags = pairs.whole(&pair)?,
                code @ 71..=74 => part.corners[(code - 71) as usize] = pairs.whole(&pair)?,
                _ => {}
            }
        }
        Ok(part)
    }
}

/// An INSERT.
#[derive(Clone, Copy, Debug)]
pub(super) struct Insert<'a> {
    pub(super) common: Common<'a>,
    pub(super) block: &'a [u8],
    pub(super) insertion: Insertion,
    /// At least 1 each.
    pub(super) columns: u64,
    pub(super) rows: u64,
}

impl<'a> Insert<'a> {
    pub(super) fn read(pairs: &mut Pairs<'a>) -> Result<Self, ReadError> {
        let mut common = Common::default();
        let mut block: &[u8] = b"";
        let (mut columns, mut rows) = (1, 1);
        let mut insertion =
            Insertion { at: DVec3::ZERO, scale: DVec3::ONE, rotation: 0.0, step: DVec2::ZERO, extrusion: DVec3::Z };
        while let Some(pair) = pairs.field()? {
            match pair.code {
                2 => block = pair.text(),
                10 => insertion.at.x = pairs.number(&pair)?,
                20 => insertion.at.y = pairs.number(&pair)?,
                30 => insertion.at.z = pairs.number(&pair)?,
                41 => insertion.scale.x = pairs.number(&pair)?,
                42 => insertion.scale.y = pairs.number(&pair)?,
                43 => insertion.scale.z = pairs.number(&pair)?,
                44 => insertion.step.x = pairs.number(&pair)?,
                45 => insertion.step.y = pairs.number(&pair)?,
                50 => insertion.rotation = pairs.number(&pair)?,
                // None, and fewer, count as one, as in CAD programs.
                70 => columns = u64::try_from(pairs.whole(&pair)?).unwrap_or(1).max(1),
                71 => rows = u64::try_from(pairs.whole(&pair)?).unwrap_or(1).max(1),
                _ => common.take(pairs, &pair)?,
            }
        }
        insertion.extrusion = common.extrusion;
        Ok(Self { common, block, insertion, columns, rows })
    }
}
