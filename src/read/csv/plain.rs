//! The fast way through rows of plain numbers.

use super::Layout;
use super::rows::{is_blank, is_comment};
use crate::read::decimal;
use crate::read::sniff::Delimiter;
use glam::DVec3;
use memchr::{memchr, memchr2};

/// The points, if every row has finite numbers with decimal points in the columns wanted, and no fields nobody knows of. Blank
/// rows and comments are passed over. `None` wherever a row asks for more care: all that is read here, the other way reads
/// the same.
pub(super) fn points(text: &str, layout: &Layout) -> Option<Vec<DVec3>> {
    let mut rest = text;
    for _ in 0..layout.header {
        row(&mut rest)?;
    }
    let wanted = [layout.columns.x, layout.columns.y, layout.columns.z?];
    let last = wanted[0].max(wanted[1]).max(wanted[2]);
    if layout.columns.id.is_some() || last >= MOST_COLUMNS {
        return None;
    }
    let mut points = Vec::new();
    while !rest.is_empty() {
        let row = row(&mut rest)?;
        if is_comment(row, Some(layout.delimiter)) {
            continue;
        }
        // Fields in quotes may hold delimiters, and ends of rows.
        let bytes = row.as_bytes();
        if memchr(b'"', bytes).is_some() {
            return None;
        }
        let mut fields: [&[u8]; MOST_COLUMNS] = [&[]; MOST_COLUMNS];
        let count = match layout.delimiter {
            Delimiter::Blanks => split_blanks(bytes, &mut fields),
            other => split(bytes, other.byte(), &mut fields),
        };
        let values = wanted.map(|column| decimal::number(fields[column].trim_ascii()));
        let known = count <= layout.columns.named || layout.columns.open_ended;
        match values {
            [Some(x), Some(y), Some(z)] if count > last && known => {
                let point = DVec3::new(x, y, z);
                if !point.is_finite() {
                    return None;
                }
                if points.is_empty() {
                    // One row tells how many there will be, nearly.
                    points.reserve(text.len() / (row.len() + 1) + 1);
                }
                points.push(point);
            }
            _ if is_blank(row, layout.delimiter) => {}
            _ => return None,
        }
    }
    if points.is_empty() { None } else { Some(points) }
}

/// Columns looked at; files with more are read the other way.
const MOST_COLUMNS: usize = 16;

/// Takes the next row off the text, without its end, which is LF or CR LF. `None` if rows end otherwise: at a CR alone.
#[inline]
fn row<'a>(rest: &mut &'a str) -> Option<&'a str> {
    let text = *rest;
    let Some(at) = memchr2(b'\n', b'\r', text.as_bytes()) else {
        *rest = "";
        return Some(text);
    };
    let end = if text.as_bytes()[at] == b'\n' { at } else { at + 1 };
    if text.as_bytes().get(end) != Some(&b'\n') {
        return None;
    }
    *rest = &text[end + 1..];
    Some(&text[..at])
}

/// Fields of a row; returns their number, which may be larger than there is room for.
fn split<'a>(row: &'a [u8], delimiter: u8, fields: &mut [&'a [u8]; MOST_COLUMNS]) -> usize {
    let mut count = 0;
    let mut begin = 0;
    for (i, &byte) in row.iter().enumerate() {
        if byte == delimiter {
            if count < MOST_COLUMNS {
                fields[count] = &row[begin..i];
            }
            count += 1;
            begin = i + 1;
        }
    }
    if count < MOST_COLUMNS {
        fields[count] = &row[begin..];
    }
    count + 1
}

/// The same for fields between runs of blanks.
fn split_blanks<'a>(row: &'a [u8], fields: &mut [&'a [u8]; MOST_COLUMNS]) -> usize {
    let mut count = 0;
    let mut begin = None;
    for (i, &byte) in row.iter().enumerate() {
        match (byte == b' ' || byte == b'\t', begin) {
            (false, None) => begin = Some(i),
            (true, Some(from)) => {
                if count < MOST_COLUMNS {
                    fields[count] = &row[from..i];
                }
                count += 1;
                begin = None;
            }
            _ => {}
        }
    }
    if let Some(from) = begin {
        if count < MOST_COLUMNS {
            fields[count] = &row[from..];
        }
        count += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::{CoordinateKind, InputFormat, Source};
    use proptest::prelude::*;

    /// What both ways make of a text: the fast one, then the careful one; both `None` where the layout cannot be told.
    fn both(text: &str, order: Option<&str>) -> (Option<Vec<DVec3>>, Option<Vec<DVec3>>) {
        let label = "a.csv".to_owned();
        let (kind, format) = (CoordinateKind::Unknown, InputFormat::Csv);
        let mut source = Source { label, format, bytes: 0, sha256: String::new(), crs: None, kind, unit: None };
        let order = order.map(|order| order.parse().unwrap());
        let Ok(layout) = super::super::layout(text, &mut source, (order.as_ref(), None), true, &mut Vec::new()) else {
            return (None, None);
        };
        let careful = super::super::read_table(text, "a.csv", &layout, &mut Vec::new()).ok();
        let careful = careful.map(|table| table.records.iter().map(|r| DVec3::new(r.x, r.y, r.z.unwrap_or(f64::NAN))).collect());
        (points(text, &layout), careful)
    }

    const FOUR: [DVec3; 4] = [DVec3::new(0., 0., 10.), DVec3::new(9., 0., 11.), DVec3::new(9., 9., 12.), DVec3::new(0., 9., 10.)];

    #[test]
    fn rows_commented_out_are_no_points_whatever_their_fields() {
        let commas = "Point,x,y,z\n1,0,0,10\n2,9,0,11\n#3,5,5,999\n4,9,9,12\n5,0,9,10\n";
        let blanks = "1 0 0 10\n2 9 0 11\n # 3 5 5 999\n4 9 9 12\n5 0 9 10";
        let semicolons = "Nr;x;y;z\r\n1;0;0;10\r\n2;9;0;11\r\n%3;5;5;999\r\n4;9;9;12\r\n5;0;9;10\r\n";
        for (text, order) in
            [(commas, None), (blanks, Some("pxyz_")), (&blanks.replace('#', "//"), Some("_xyz_")), (semicolons, None)]
        {
            let (fast, careful) = both(text, order);
            assert_eq!(fast.as_deref(), Some(&FOUR[..]), "{text}");
            assert_eq!(careful.as_deref(), Some(&FOUR[..]), "{text}");
        }
    }

    #[test]
    fn rows_that_end_at_a_cr_alone_are_read_the_other_way() {
        let mixed = "1,0,0,10,a\n2,0,9,11,b\n3,9,9,12,c\r4,9,0,10,d";
        for text in [mixed.to_owned(), mixed.replace('\n', "\r"), format!("{mixed}\r"), mixed.replacen("a\n", "a\r\r\n", 1)] {
            let (fast, careful) = both(&text, Some("pnezd"));
            assert_eq!((fast, careful.as_deref()), (None, Some(&FOUR[..])), "{text:?}");
        }
    }

    #[test]
    fn quotes_are_read_the_other_way() {
        // Column by column these are the numbers 1, 2, 3 and 2, 3.
        assert_eq!(both("\"a,b\",1,2,3\n", Some("p_xyz")), (None, None));
        assert_eq!(both("1,2,3,\"\n4,5,6,\"\n", Some("xyzd")), (None, None));
    }

    /// Parts of rows: numbers, texts, comments, ends, quotes.
    const PIECES: [&str; 30] = [
        "1", "2.5", "-3e2", "+4", "0.1", "7", "inf", "nan", "1,5", "#N/A", "#REF!", "#3", "#", "//", "%", ";", " ", "\t",
        "\u{a0}", "\u{c}", "\"", "\"a b\"", "a", "Höhe", "\n", "\n", "\r\n", "\r", "\r\r\n", "\n\n",
    ];

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// Rows mostly sound, with a few strange pieces in them.
        #[test]
        fn what_is_read_fast_is_what_is_read_with_care(
            rows in prop::collection::vec((-9..9_i32, -9..9_i32, 0..99_i32), 1..6),
            strange in prop::collection::vec((0..30_usize, 0..200_usize), 0..4),
            delimiter in prop::sample::select(vec![",", ";", "\t", " ", "  "]),
            order in prop::sample::select(vec![None, Some("xyz"), Some("pxyz"), Some("xyzd"), Some("pxyz_"), Some("_yxz")]),
            header in any::<bool>(),
        ) {
            let width = order.map_or(3, str::len);
            let mut text = if header { ["x", "y", "z"].join(delimiter) + "\n" } else { String::new() };
            for (number, &(x, y, z)) in rows.iter().enumerate() {
                let fields = [number.to_string(), x.to_string(), (f64::from(y) / 4.0).to_string(), z.to_string(), "a".to_owned()];
                let from = usize::from(width == 3);
                text += &fields[from..(from + width).min(5)].join(delimiter);
                text += "\n";
            }
            for (piece, at) in strange {
                let places: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
                text.insert_str(places[at % places.len()], PIECES[piece]);
            }
            if let (Some(fast), careful) = both(&text, order) {
                prop_assert_eq!(Some(fast), careful, "{:?}", text);
            }
        }
    }
}
