//! Reference systems as well-known text, both of its versions (OGC 01-009; ISO 19162): kind, name, code and units.

use super::super::geokeys::{GeoKeys, Model, Unit};

/// Longest text that is looked at, in bytes.
const LONGEST: usize = 1 << 18;

/// Deepest nesting; texts of reference systems have about ten.
const DEEPEST: usize = 40;

/// `KEYWORD[values, …]`.
#[derive(Debug, Default)]
struct Node {
    key: String,
    /// Texts and numbers, as written.
    values: Vec<String>,
    inside: Vec<Node>,
}

impl Node {
    /// The first node directly inside with one of these keys.
    fn child(&self, keys: &[&str]) -> Option<&Self> {
        self.inside.iter().find(|node| keys.contains(&node.key.as_str()))
    }

    /// This node, or the first one below it, with one of these keys.
    fn find(&self, keys: &[&str]) -> Option<&Self> {
        if keys.contains(&self.key.as_str()) { Some(self) } else { self.inside.iter().find_map(|node| node.find(keys)) }
    }

    /// The unit that stands in this node, or in its first axis.
    fn unit(&self) -> Unit {
        const UNITS: [&str; 2] = ["UNIT", "LENGTHUNIT"];
        let node = self.child(&UNITS).or_else(|| self.child(&["AXIS"]).and_then(|axis| axis.child(&UNITS)));
        let size = node.and_then(|node| node.values.get(1)).and_then(|size| size.parse().ok());
        size.map_or(Unit::Unsaid, Unit::sized)
    }

    /// EPSG code, else name.
    fn name(&self) -> Option<String> {
        let code =
            self.child(&["AUTHORITY", "ID"]).filter(|id| id.values.first().is_some_and(|by| by.eq_ignore_ascii_case("EPSG")));
        let code = code.and_then(|id| id.values.get(1)).map(|code| format!("EPSG:{code}"));
        code.or_else(|| self.values.first().cloned())
    }
}

/// What a text says; nothing, as far as it cannot be understood.
pub(super) fn read(text: &[u8]) -> GeoKeys {
    let text = text.split(|b| *b == 0).next().unwrap_or(text);
    let text = String::from_utf8_lossy(&text[..text.len().min(LONGEST)]);
    let root = parse(&text);
    let vertical = root.find(&["VERT_CS", "VERTCRS", "VERTICALCRS"]);
    let heights = vertical.map_or(Unit::Unsaid, Node::unit);
    if let Some(projected) = root.find(&["PROJCS", "PROJCRS", "PROJECTEDCRS"]) {
        let (crs, plan) = (projected.name(), projected.unit());
        return GeoKeys { model: Model::Projected, crs, plan, heights, ..GeoKeys::default() };
    }
    if let Some(degrees) = root.find(&["GEOGCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS", "GEODETICCRS"]) {
        return GeoKeys { model: Model::Geographic, crs: degrees.name(), heights, ..GeoKeys::default() };
    }
    if let Some(local) = root.find(&["LOCAL_CS", "ENGCRS", "ENGINEERINGCRS"]) {
        return GeoKeys { crs: local.name(), plan: local.unit(), heights, ..GeoKeys::default() };
    }
    GeoKeys::default()
}

/// The tree of a text, below a node without a key. What does not fit ends a node, never the reading.
fn parse(text: &str) -> Node {
    let mut open = vec![Node::default()];
    let mut word = String::new();
    let mut quoted = false;
    let mut letters = text.chars().peekable();
    let flush = |open: &mut Vec<Node>, word: &mut String| {
        let value = std::mem::take(word);
        if let (Some(node), false) = (open.last_mut(), value.trim().is_empty()) {
            node.values.push(value.trim().to_owned());
        }
    };
    let close = |open: &mut Vec<Node>| {
        if open.len() > 1
            && let Some(done) = open.pop()
            && let Some(parent) = open.last_mut()
        {
            parent.inside.push(done);
        }
    };
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                word.push('"');
            }
            '"' => quoted = !quoted,
            other if quoted => word.push(other),
            '[' | '(' if open.len() < DEEPEST => {
                let key = std::mem::take(&mut word).trim().to_ascii_uppercase();
                open.push(Node { key, ..Node::default() });
            }
            ']' | ')' => {
                flush(&mut open, &mut word);
                close(&mut open);
            }
            ',' => flush(&mut open, &mut word),
            other => word.push(other),
        }
    }
    flush(&mut open, &mut word);
    while open.len() > 1 {
        close(&mut open);
    }
    open.pop().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::LengthUnit;

    #[test]
    fn both_versions_are_read() {
        let one = r#"COMPD_CS["NAD83 / Oregon + height",PROJCS["NAD83 / Oregon LCC (ft)",GEOGCS["NAD83",DATUM["D",SPHEROID["GRS 1980",6378137,298.257]],
            UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4269"]],PROJECTION["Lambert"],PARAMETER["false_easting",1312335.958],
            UNIT["foot",0.3048,AUTHORITY["EPSG","9002"]],AUTHORITY["EPSG","2992"]],VERT_CS["NAVD88",VERT_DATUM["N",2005],UNIT["metre",1],AXIS["Up",UP]]]"#;
        let keys = read(one.as_bytes());
        assert_eq!((keys.model, keys.crs.as_deref()), (Model::Projected, Some("EPSG:2992")));
        assert_eq!((keys.plan.known(), keys.heights.known()), (Some(LengthUnit::Foot), Some(LengthUnit::Metre)));
        let two = r#"PROJCRS["ETRS89 / UTM zone 32N",BASEGEOGCRS["ETRS89",ID["EPSG",4258]],CS[Cartesian,2],AXIS["(E)",east,LENGTHUNIT["metre",1]],ID["EPSG",25832]]"#;
        let keys = read(two.as_bytes());
        assert_eq!((keys.crs.as_deref(), keys.plan.known()), (Some("EPSG:25832"), Some(LengthUnit::Metre)));
        let named = read(br#"PROJCS["My ""grid""",UNIT["Foot_US",0.304800609601219]]"#);
        assert_eq!((named.crs.as_deref(), named.plan.known()), (Some("My \"grid\""), Some(LengthUnit::UsSurveyFoot)));
        assert_eq!(read(br#"GEOGCS["WGS 84",AUTHORITY["EPSG","4326"]]"#).model, Model::Geographic);
    }

    #[test]
    fn odd_texts_say_nothing() {
        for text in ["", "]]]]", "PROJCS", "\"", "[[[[", "AXIS[1"] {
            assert_eq!(read(text.as_bytes()), GeoKeys::default(), "{text}");
        }
        assert_eq!(read("A[".repeat(100_000).as_bytes()), GeoKeys::default());
        assert_eq!(read(&[0xFF; 100]), GeoKeys::default());
    }
}
