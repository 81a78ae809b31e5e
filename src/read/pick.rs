//! What is meant of a file that holds several things.

use super::error::{clip, refuse};
use super::{ColumnOrder, InputFormat, RawLine, RawShape, ReadError};

/// Classification of ground points in LAS files (ASPRS LAS 1.4, table 9).
#[allow(dead_code, reason = "used with the feature `las`")]
pub(super) const GROUND_CLASS: u8 = 2;

/// What is meant of a file that holds several things.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pick {
    /// Names of lines (features, alignments, breaklines); empty: all.
    pub features: Vec<String>,
    /// Names of layers of drawings; empty: all that are on.
    pub layers: Vec<String>,
    /// Name of the surface; needed where there are several.
    pub surface: Option<String>,
    /// Classes of points of a cloud; empty: that of ground, 2.
    pub classes: Vec<u8>,
}

/// Refuses an order of columns for a file that has none: it would be taken to have been followed.
///
/// # Errors
/// As it says; LandXML files have an order of coordinates.
pub(super) fn order_fits(order: Option<&ColumnOrder>, label: &str, format: InputFormat) -> Result<(), ReadError> {
    if order.is_none() || matches!(format, InputFormat::Csv | InputFormat::LandXml) {
        return Ok(());
    }
    let figures = format!("its format is `{format}`");
    Err(refuse(
        "only text and LandXML files have an order of columns to be told",
        label,
        figures,
        "leave out the order of columns",
    ))
}

impl Pick {
    /// Refuses what a format does not have: an option that changes nothing would be taken to have chosen something.
    ///
    /// # Errors
    /// Layers of something that is no drawing, a surface of something that is no LandXML, classes of something that is no cloud.
    pub(super) fn fits(&self, label: &str, format: InputFormat) -> Result<(), ReadError> {
        let wrong = [
            (!self.layers.is_empty() && format != InputFormat::Dxf, "only drawings (DXF) have layers to choose from"),
            (self.surface.is_some() && format != InputFormat::LandXml, "only LandXML files have surfaces to choose from"),
            (!self.classes.is_empty() && format != InputFormat::Las, "only point clouds (LAS, LAZ) have classes to choose from"),
        ];
        let help = "leave out the option that chooses";
        let figures = format!("its format is `{format}`");
        wrong.iter().find(|(wrong, _)| *wrong).map_or(Ok(()), |(_, what)| Err(refuse(what, label, figures, help)))
    }

    /// The lines of the names asked for, of a file whose features have names; all if none was asked for. Blanks around names do not
    /// matter, case does: names may differ in nothing else. (In drawings it does not, see `read::dxf`: names of layers there
    /// never differ in case alone.)
    ///
    /// # Errors
    /// If there is no line of one of the names, or none but breaklines.
    pub(super) fn named(&self, label: &str, mut lines: Vec<RawLine>) -> Result<Vec<RawLine>, ReadError> {
        const LISTED: usize = 20;
        if self.features.is_empty() {
            return Ok(lines);
        }
        let has = |line: &RawLine, name: &str| line.name.as_deref().map(str::trim) == Some(name.trim());
        let names = |lines: &[RawLine]| {
            let mut names: Vec<String> = Vec::new();
            for line in lines {
                let name = format!("`{}`", clip(line.name.as_deref().unwrap_or("").as_bytes()));
                if names.len() < LISTED && !names.contains(&name) {
                    names.push(name);
                }
            }
            format!("{} lines, among them {}", lines.len(), names.join(", "))
        };
        let help = "give names from the file, or leave `--feature` out";
        if let Some(name) = self.features.iter().find(|name| !lines.iter().any(|line| has(line, name))) {
            let what = format!("there is no line `{}`", clip(name.as_bytes()));
            return Err(refuse(&what, label, names(&lines), help));
        }
        if lines.iter().all(|line| line.shape == RawShape::Breakline || !self.features.iter().any(|name| has(line, name))) {
            return Err(refuse("the lines asked for are breaklines, which carry no slopes", label, names(&lines), help));
        }
        lines.retain(|line| self.features.iter().any(|name| has(line, name)));
        Ok(lines)
    }
}

#[cfg(test)]
mod tests {
    use super::{Pick, order_fits};
    use crate::read::{InputFormat, ReadOptions, parse_line};

    #[test]
    fn nothing_is_chosen_where_there_is_no_choice() {
        let layers = Pick { layers: vec!["a".into()], ..Pick::default() };
        let surface = Pick { surface: Some("a".into()), ..Pick::default() };
        let classes = Pick { classes: vec![2], ..Pick::default() };
        for (pick, own) in [(layers, InputFormat::Dxf), (surface, InputFormat::LandXml), (classes, InputFormat::Las)] {
            assert!(pick.fits("a", own).is_ok());
            for other in [InputFormat::GeoJson, InputFormat::Obj, InputFormat::Asc] {
                let message = pick.fits("a.x", other).unwrap_err().to_string();
                assert!(message.contains("to choose from\n  --> a.x\n   = its format is"), "{message}");
            }
            assert!(Pick::default().fits("a", own).is_ok());
        }
        let options =
            ReadOptions { pick: Pick { layers: vec!["a".into()], ..Pick::default() }, ..ReadOptions::of(InputFormat::Csv) };
        assert!(parse_line("a", b"x,y,z\n0,0,1\n9,0,1\n", &options).is_err());
    }

    #[test]
    fn an_order_needs_columns() {
        let order = "xyz".parse().unwrap();
        for (format, fits) in [
            (InputFormat::Csv, true),
            (InputFormat::LandXml, true),
            (InputFormat::GeoJson, false),
            (InputFormat::Obj, false),
            (InputFormat::Dxf, false),
        ] {
            assert_eq!(order_fits(Some(&order), "a", format).is_ok(), fits, "{format}");
            assert!(order_fits(None, "a", format).is_ok());
        }
    }

    #[test]
    fn lines_by_name() {
        let feature = |name: &str, role: &str| {
            format!(
                r#"{{"type": "Feature", "properties": {{"name": "{name}"{role}}}, "geometry": {{"type": "LineString", "coordinates":
                [[0, 0, 1], [9, 0, 1]]}}}}"#
            )
        };
        let text = format!(
            r#"{{"type": "FeatureCollection", "features": [{}, {}, {}]}}"#,
            feature("a", ""),
            feature("b", ""),
            feature("c", r#", "role": "breakline""#)
        );
        let read = |names: &[&str]| {
            let mut options = ReadOptions::of(InputFormat::GeoJson);
            options.pick.features = names.iter().map(|&name| name.to_owned()).collect();
            let raw = parse_line("a", text.as_bytes(), &options).map_err(|e| e.to_string())?;
            Ok::<_, String>(raw.lines.into_iter().filter_map(|line| line.name).collect::<Vec<_>>())
        };
        assert_eq!(read(&[]), Ok(vec!["a".into(), "b".into(), "c".into()]));
        assert_eq!(read(&["b"]), Ok(vec!["b".into()]));
        assert_eq!(read(&["c", "a"]), Ok(vec!["a".into(), "c".into()]));
        assert!(read(&["c"]).unwrap_err().contains("are breaklines"));
        let message = read(&["a", "x"]).unwrap_err();
        assert!(message.contains("no line `x`") && message.contains("3 lines, among them `a`, `b`, `c`"), "{message}");
    }
}
