//! Which column of a text file holds what: from its header, or from the order the caller gives.

use super::CoordinateKind;
use std::fmt;
use std::str::FromStr;

/// Where the wanted fields stand in a row, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Columns {
    pub(super) x: usize,
    pub(super) y: usize,
    /// `None` only where elevations are not wanted.
    pub(super) z: Option<usize>,
    pub(super) id: Option<usize>,
    /// Number of columns named.
    pub(super) named: usize,
    /// Whether rows may have more fields than columns were named (the last one is free text).
    pub(super) open_ended: bool,
    /// What the headings say about the coordinates.
    pub(super) kind: CoordinateKind,
}

/// The columns of a text file without header, e.g. `xyz`, `pnezd`, `lenz_`.
///
/// Letters: `x` or `e` easting, `y` or `n` northing, `z` or `h` elevation, `l` line id, `p` point number, `d` description,
/// `_` a column to skip. A row may have more fields than letters only if the last letter is `d` or `_`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnOrder {
    text: String,
    x: usize,
    y: usize,
    z: Option<usize>,
    id: Option<usize>,
}

impl ColumnOrder {
    /// The columns; `None` if elevations are wanted and the order names none.
    pub(super) fn columns(&self, want_z: bool) -> Option<Columns> {
        if want_z && self.z.is_none() {
            return None;
        }
        Some(Columns {
            x: self.x,
            y: self.y,
            z: self.z.filter(|_| want_z),
            id: self.id,
            named: self.text.len(),
            open_ended: self.text.ends_with(['d', '_']),
            kind: CoordinateKind::Unknown,
        })
    }
}

impl fmt::Display for ColumnOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl FromStr for ColumnOrder {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const LETTERS: &str = "letters: x or e easting, y or n northing, z or h elevation, l line id, p point number, \
                               d description, _ skip; e.g. xyz, enz, pnezd";
        let text = text.trim().to_ascii_lowercase();
        let (mut x, mut y, mut z, mut id) = (None, None, None, None);
        for (i, letter) in text.chars().enumerate() {
            let place = match letter {
                'x' | 'e' => &mut x,
                'y' | 'n' => &mut y,
                'z' | 'h' => &mut z,
                'l' => &mut id,
                'p' | 'd' | '_' => continue,
                _ => return Err(format!("`{letter}` is no column; {LETTERS}")),
            };
            if let Some(before) = place.replace(i).and_then(|before| text.chars().nth(before)) {
                let what = match letter {
                    _ if before == letter => format!("the column `{letter}` is given twice"),
                    _ => format!("the columns `{before}` and `{letter}` are the same"),
                };
                return Err(format!("{what} in `{text}`; {LETTERS}"));
            }
        }
        match (x, y) {
            (Some(x), Some(y)) => Ok(Self { text, x, y, z, id }),
            _ => Err(format!("`{text}` must name easting and northing; {LETTERS}")),
        }
    }
}

/// The order in which a header would be meant where `Y` is the easting, as in lists of Gauss-Krüger coordinates; `None` unless a
/// column `Y` stands before a column `X`, taken as northing and easting by their names.
pub(super) fn y_as_easting(headings: &[&str], columns: &Columns) -> Option<String> {
    let unsaid = |at: usize| headings.get(at).and_then(|heading| meaning(heading));
    let named = matches!(unsaid(columns.x), Some(Meaning::X(CoordinateKind::Unknown)))
        && matches!(unsaid(columns.y), Some(Meaning::Y(CoordinateKind::Unknown)));
    let letter = |at: usize| match at {
        _ if at == columns.y => 'e',
        _ if at == columns.x => 'n',
        _ if Some(at) == columns.z => 'z',
        _ if Some(at) == columns.id => 'l',
        _ => '_',
    };
    (named && columns.y < columns.x).then(|| (0..columns.named).map(letter).collect())
}

/// Why a header does not say where the columns are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum HeaderProblem {
    /// No column for this.
    Lacks(&'static str),
    /// Several columns for this: their headings.
    Ambiguous(&'static str, Vec<String>),
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Meaning {
    X(CoordinateKind),
    Y(CoordinateKind),
    Z,
    /// Column that can only be a line id.
    Line,
    /// Column that is a line id unless there is a better one.
    Name,
}

/// Spellings after [`plain`].
const X: &[&str] = &["x", "xcoord", "xcoordinate", "xkoordinate", "coordx", "xwert", "posx", "pointx"];
const EASTING: &[&str] =
    &["e", "easting", "eastings", "east", "rechtswert", "rechts", "rw", "ostwert", "ost", "rwert", "ecoord", "easting1"];
const LONGITUDE: &[&str] = &["lon", "long", "lng", "longitude", "laenge", "laengengrad"];
const Y: &[&str] = &["y", "ycoord", "ycoordinate", "ykoordinate", "coordy", "ywert", "posy", "pointy"];
const NORTHING: &[&str] =
    &["n", "northing", "northings", "north", "hochwert", "hoch", "hw", "nordwert", "nord", "hwert", "ncoord"];
const LATITUDE: &[&str] = &["lat", "latitude", "breite", "breitengrad"];
const Z: &[&str] = &[
    "z",
    "zcoord",
    "zcoordinate",
    "zkoordinate",
    "coordz",
    "zwert",
    "posz",
    "pointz",
    "zvalue",
    "elevation",
    "elev",
    "el",
    "ele",
    "height",
    "hgt",
    "h",
    "hoehe",
    "hoehen",
    "hoehenwert",
    "hoehenkote",
    "kote",
    "level",
    "rl",
    "reducedlevel",
    "alt",
    "altitude",
    "hoehenn",
    "hoehenhn",
    "hoehenormalnull",
    "hnn",
    "nhn",
    "hnhn",
    "gelaendehoehe",
    "groundlevel",
    "hoehe1",
];
const LINE: &[&str] = &[
    "line",
    "lineid",
    "linename",
    "lineno",
    "linenumber",
    "linie",
    "linienid",
    "linienname",
    "liniennr",
    "liniennummer",
    "string",
    "stringid",
    "stringname",
    "polyline",
    "polylineid",
    "chain",
    "chainid",
    "strang",
    "kette",
    "ring",
    "ringid",
];
const NAME: &[&str] = &["id", "name", "fid", "feature", "featureid"];

/// A heading in lower case without unit, blanks and punctuation; umlauts spelt out.
fn plain(heading: &str) -> String {
    let heading = heading.trim().trim_start_matches(['#', '/', '%']).to_lowercase();
    let without_unit = heading.split(['[', '(', '{']).next().unwrap_or("");
    let mut plain = String::new();
    for c in without_unit.chars() {
        match c {
            'ä' => plain.push_str("ae"),
            'ö' => plain.push_str("oe"),
            'ü' => plain.push_str("ue"),
            'ß' => plain.push_str("ss"),
            c if c.is_alphanumeric() => plain.push(c),
            _ => {}
        }
    }
    plain
}

fn meaning(heading: &str) -> Option<Meaning> {
    use CoordinateKind::{Degrees, Lengths, Unknown};
    let full = plain(heading);
    // `x_m`, `Easting m`: a unit after the name, seen only where it stands apart.
    let parts: Vec<&str> = heading.trim().split([' ', '_']).collect();
    let bare = match parts.as_slice() {
        [name @ .., unit] if !name.is_empty() && matches!(unit.to_lowercase().as_str(), "m" | "ft" | "mm" | "deg") => {
            plain(&name.concat())
        }
        _ => full.clone(),
    };
    let is = |list: &[&str]| list.contains(&full.as_str()) || list.contains(&bare.as_str());
    let table: [(&[&str], Meaning); 9] = [
        (X, Meaning::X(Unknown)),
        (EASTING, Meaning::X(Lengths)),
        (LONGITUDE, Meaning::X(Degrees)),
        (Y, Meaning::Y(Unknown)),
        (NORTHING, Meaning::Y(Lengths)),
        (LATITUDE, Meaning::Y(Degrees)),
        (Z, Meaning::Z),
        (LINE, Meaning::Line),
        (NAME, Meaning::Name),
    ];
    table.into_iter().find(|(list, _)| is(list)).map(|(_, meaning)| meaning)
}

/// The columns a header names. Headings nobody asked for are passed over; two headings for one thing are an error, because
/// taking one of them would be a guess.
pub(super) fn from_header(headings: &[&str], want_z: bool) -> Result<Columns, HeaderProblem> {
    let meanings: Vec<_> = headings.iter().map(|heading| meaning(heading)).collect();
    let find = |what: &'static str, wanted: fn(Meaning) -> bool| {
        let found: Vec<usize> = (0..meanings.len()).filter(|&i| meanings[i].is_some_and(wanted)).collect();
        match found.as_slice() {
            [] => Ok(None),
            [one] => Ok(Some(*one)),
            several => {
                let names = several.iter().map(|&i| headings[i].trim().to_owned()).collect();
                Err(HeaderProblem::Ambiguous(what, names))
            }
        }
    };
    let x = find("easting", |m| matches!(m, Meaning::X(_)))?.ok_or(HeaderProblem::Lacks("easting"))?;
    let y = find("northing", |m| matches!(m, Meaning::Y(_)))?.ok_or(HeaderProblem::Lacks("northing"))?;
    let z = if want_z { Some(find("elevation", |m| m == Meaning::Z)?.ok_or(HeaderProblem::Lacks("elevation"))?) } else { None };
    let id = match find("line id", |m| m == Meaning::Line)? {
        Some(id) => Some(id),
        None => find("line id", |m| m == Meaning::Name)?,
    };
    let kind = match (meanings[x], meanings[y]) {
        (Some(Meaning::X(a)), Some(Meaning::Y(b))) if a == b => a,
        _ => CoordinateKind::Unknown,
    };
    Ok(Columns { x, y, z, id, named: headings.len(), open_ended: false, kind })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(header: &str) -> Result<(usize, usize, usize, Option<usize>), HeaderProblem> {
        let headings: Vec<&str> = header.split(',').collect();
        from_header(&headings, true).map(|c| (c.x, c.y, c.z.unwrap_or(usize::MAX), c.id))
    }

    #[test]
    fn usual_headers_in_english_and_german() {
        for (header, expected) in [
            ("x,y,z", (0, 1, 2, None)),
            ("X [m],Y [m],Z [m]", (0, 1, 2, None)),
            ("x_m,y_m,z_m", (0, 1, 2, None)),
            ("easting,northing,elevation", (0, 1, 2, None)),
            ("E,N,Z", (0, 1, 2, None)),
            ("P,N,E,Z,D", (2, 1, 3, None)),
            ("Point,Northing,Easting,Elevation,Code", (2, 1, 3, None)),
            ("Punkt,Rechtswert,Hochwert,Höhe,Bemerkung", (1, 2, 3, None)),
            ("Nr.,Hochwert (m),Rechtswert (m),Hoehe (m)", (2, 1, 3, None)),
            ("Ostwert,Nordwert,H", (0, 1, 2, None)),
            ("x-coord,y-coord,RL", (0, 1, 2, None)),
            ("Linie,Ost,Nord,Höhe NHN", (1, 2, 3, Some(0))),
            ("id,x,y,z", (1, 2, 3, Some(0))),
            ("name,line_id,x,y,alt", (2, 3, 4, Some(1))),
            ("lat,lon,ele", (1, 0, 2, None)),
        ] {
            assert_eq!(places(header), Ok(expected), "{header}");
        }
    }

    #[test]
    fn y_before_x() {
        let order = |header: &str| {
            let headings: Vec<&str> = header.split(';').collect();
            y_as_easting(&headings, &from_header(&headings, true).unwrap())
        };
        assert_eq!(order("Punkt;Y;X;Z;Code").as_deref(), Some("_enz_"));
        assert_eq!(order("Linie;y [m];x [m];H").as_deref(), Some("lenz"));
        for plain in ["Punkt;X;Y;Z", "Hochwert;Rechtswert;Z", "N;E;Z", "lat;lon;z", "north;x;z"] {
            assert_eq!(order(plain), None, "{plain}");
        }
    }

    #[test]
    fn two_candidates_are_an_error() {
        let both = |what, a: &str, b: &str| Err(HeaderProblem::Ambiguous(what, vec![a.to_owned(), b.to_owned()]));
        assert_eq!(places("x,y,northing,z"), both("northing", "y", "northing"));
        assert_eq!(places("x,y,z,level"), both("elevation", "z", "level"));
        assert_eq!(places("line,string,x,y,z"), both("line id", "line", "string"));
        assert_eq!(places("x,y,code"), Err(HeaderProblem::Lacks("elevation")));
    }

    #[test]
    fn orders() {
        let order: ColumnOrder = "PNEZD".parse().unwrap();
        let columns = order.columns(true).unwrap();
        assert_eq!((columns.x, columns.y, columns.z, columns.id, columns.open_ended), (2, 1, Some(3), None, true));
        let order: ColumnOrder = "lxyz".parse().unwrap();
        assert_eq!(order.columns(true).unwrap().id, Some(0));
        assert!("xy".parse::<ColumnOrder>().unwrap().columns(true).is_none());
        assert!("xy".parse::<ColumnOrder>().unwrap().columns(false).is_some());
        let message = |order: &str| order.parse::<ColumnOrder>().unwrap_err();
        assert!(message("xeyz").starts_with("the columns `x` and `e` are the same in `xeyz`; letters: "));
        assert!(message("xxyz").starts_with("the column `x` is given twice in `xxyz`; letters: "));
        for bad in ["", "xz", "xxyz", "xeyz", "xyq", "äöü"] {
            assert!(bad.parse::<ColumnOrder>().is_err(), "{bad}");
        }
    }
}
