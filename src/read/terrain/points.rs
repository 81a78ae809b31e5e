//! Points as rows of text: the reader of line files, with a fast way through plain numbers.

use super::{RawGround, Said};
use crate::model::Note;
use crate::read::{ColumnOrder, CoordinateKind, InputFormat, ReadError, Source, csv, decode};

/// Reads points; `by_name` are the columns of a file without header whose name says them.
pub(super) fn read(
    label: &str,
    bytes: &[u8],
    order: Option<&ColumnOrder>,
    by_name: Option<&ColumnOrder>,
    notes: &mut Vec<Note>,
) -> Result<(RawGround, Said), ReadError> {
    let text = decode::text(label, bytes, notes)?;
    let mut source = Source {
        label: label.to_owned(),
        format: InputFormat::Csv,
        bytes: bytes.len() as u64,
        sha256: String::new(),
        crs: None,
        kind: CoordinateKind::Unknown,
        unit: None,
    };
    let points = csv::ground(&text, &mut source, (order, by_name), notes)?;
    Ok((RawGround::Points(points), Said { kind: source.kind, crs: source.crs, unit: None }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn points(text: &str, order: Option<&str>) -> Result<Vec<DVec3>, String> {
        let order = order.map(|o| o.parse().unwrap());
        match read("a.csv", text.as_bytes(), order.as_ref(), None, &mut Vec::new()) {
            Ok((RawGround::Points(points), _)) => Ok(points),
            Ok(_) => panic!("no points"),
            Err(error) => Err(error.to_string()),
        }
    }

    #[test]
    fn plain_rows_and_others_give_the_same() {
        let expected = vec![DVec3::new(1.5, 2.0, 3.0), DVec3::new(4.0, -5.25, 6.0)];
        for (text, order) in [
            ("x,y,z\n1.5,2,3\n4,-5.25,6\n", None),
            ("x,y,z\n1.5,2,3\r\n\r\n# c\n 4 , -5.25,6 ", None),
            ("x,y,z\r1.5,2,3\r4,-5.25,6\r", None),
            ("x;y;z\n1,5;2;3\n4;-5,25;6\n", None),
            ("x,y,z\n1.5,2,\"3\"\n4,-5.25,6\n", None),
            ("1.5 2  3\n4\t-5.25 6\n", Some("xyz")),
            ("1 2 1.5 3 oak\n2 -5.25 4 6 fence post\n", Some("pnezd")),
            ("2,1.5,3,9\n-5.25,4,6,9\n", Some("nez_")),
            ("id,x,y,z\n1,1.5,2,3\n2,4,-5.25,6\n", None),
            ("//x y z\n1.5 2 3\n4 -5.25 6 # end\n", None),
        ] {
            assert_eq!(points(text, order), Ok(expected.clone()), "{text}");
        }
    }

    #[test]
    fn rows_that_are_wrong_are_named() {
        for (text, words) in [
            ("x,y,z\n1,2,3\n1,2,nan\n", "row 3"),
            ("x,y,z\n1,2,3\n1,2,\n", "no elevation"),
            ("x,y,z\n1,2,3\n1,2,inf\n", "not finite"),
            ("x,y,z\n1,2,3\n1,2,3,4\n", "more fields"),
            ("x,y,z\n1,2,3\n1,2\n", "too short"),
            ("x,y,z\n1,2,3\n1,b,3\n", "not a number"),
            ("1 2 3\n4 5 6\n", "`--csv-order xyz`"),
        ] {
            let message = points(text, None).unwrap_err();
            assert!(message.contains(words), "{text}\n{message}");
        }
    }
}
