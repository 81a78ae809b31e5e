//! What differs between two reports, whatever keys they have.

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// One figure or word that differs.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Change {
    /// Its place, such as `volumes.cut` or `stations[road 0 to 20].fill`.
    pub key: String,
    /// What the first report has; nothing if the key is not in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first: Option<Value>,
    /// What the second has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second: Option<Value>,
    /// The second less the first, of numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub difference: Option<f64>,
    /// The difference as a share of the greater of the two without their signs, −2 to 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// Whether it counts: times, paths, options, hashes and the version of the program do not.
    pub counts: bool,
}

/// Everything that differs between two reports: keys in alphabetical order, rows of lists in their own, those of the second alone
/// last.
///
/// Rows of lists are matched by what they are about (role, line and stations, code, name), others by their position.
pub fn compare(first: &Value, second: &Value) -> Vec<Change> {
    let mut changes = Vec::new();
    walk("", Some(first), Some(second), &mut changes);
    changes
}

/// Keys at the end of a place that say how a file was called, not what it held.
const NAMES: [&str; 2] = [".path", ".message"];

fn counts(key: &str) -> bool {
    let top = key.split(['.', '[']).next().unwrap_or(key);
    let name = NAMES.iter().any(|end| key.ends_with(end));
    !["timing", "tool", "seconds", "run", "result"].contains(&top) && !name
}

fn walk(key: &str, first: Option<&Value>, second: Option<&Value>, changes: &mut Vec<Change>) {
    let is_object = |value: Option<&Value>| value.is_none_or(Value::is_object);
    let is_array = |value: Option<&Value>| value.is_none_or(Value::is_array);
    if is_object(first) && is_object(second) {
        let empty = Map::new();
        let a = first.and_then(Value::as_object).unwrap_or(&empty);
        let b = second.and_then(Value::as_object).unwrap_or(&empty);
        let dot = if key.is_empty() { "" } else { "." };
        for name in a.keys().chain(b.keys().filter(|name| !a.contains_key(*name))) {
            walk(&format!("{key}{dot}{name}"), a.get(name), b.get(name), changes);
        }
        return;
    }
    if is_array(first) && is_array(second) {
        let (a, b) = (rows(first), rows(second));
        let others: BTreeMap<&str, &Value> = b.iter().map(|(name, row)| (name.as_str(), *row)).collect();
        let own: BTreeMap<&str, &Value> = a.iter().map(|(name, row)| (name.as_str(), *row)).collect();
        for (name, row) in &a {
            walk(&format!("{key}[{name}]"), Some(row), others.get(name.as_str()).copied(), changes);
        }
        for (name, row) in b.iter().filter(|(name, _)| !own.contains_key(name.as_str())) {
            walk(&format!("{key}[{name}]"), None, Some(row), changes);
        }
        return;
    }
    if first == second {
        return;
    }
    let numbers = first.and_then(Value::as_f64).zip(second.and_then(Value::as_f64));
    if numbers.is_some_and(|(a, b)| a == b) {
        return;
    }
    let greater = numbers.map_or(0.0, |(a, b)| a.abs().max(b.abs()));
    let difference = numbers.map(|(a, b)| b - a).filter(|difference| difference.is_finite());
    let relative = difference.filter(|_| greater > 0.0).map(|difference| difference / greater);
    let kept = |value: Option<&Value>| value.filter(|value| !value.is_null()).cloned();
    let change =
        Change { key: key.to_owned(), first: kept(first), second: kept(second), difference, relative, counts: counts(key) };
    changes.push(change);
}

/// The rows of a list with names that tell them apart.
fn rows(list: Option<&Value>) -> Vec<(String, &Value)> {
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let list = list.and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let named = |(position, row): (usize, _)| {
        let name = name(row).unwrap_or_else(|| (position + 1).to_string());
        let times = seen.entry(name.clone()).or_default();
        *times += 1;
        (if *times > 1 { format!("{name} #{times}") } else { name }, row)
    };
    list.iter().enumerate().map(named).collect()
}

/// What a row is about.
fn name(row: &Value) -> Option<String> {
    let row = row.as_object()?;
    let text = |key: &str| match row.get(key)? {
        Value::String(text) => Some(text.clone()),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
    };
    let chain = text("chain").map_or_else(String::new, |chain| format!("{chain} "));
    if let (Some(from), Some(to)) = (text("from"), text("to")) {
        return Some(format!("{chain}{from} to {to}"));
    }
    if let Some(station) = text("station") {
        return Some(format!("{chain}{station}"));
    }
    ["role", "code", "name", "job", "chain"].into_iter().find_map(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn keys(a: Value, b: Value) -> Vec<String> {
        compare(&a, &b).into_iter().map(|change| change.key).collect()
    }

    #[test]
    fn figures_words_and_missing_keys() {
        let a = json!({"volumes": {"cut": 100.0, "fill": 50, "balance": "surplus"}, "areas": {"cut": 1.0}, "x": true});
        let b = json!({"volumes": {"cut": 99.0, "fill": 50.0, "balance": "deficit"}, "x": false, "depths": {"cut_max": 2.0}});
        let changes = compare(&a, &b);
        let of = |key: &str| changes.iter().find(|change| change.key == key).unwrap();
        assert_eq!(changes.len(), 5);
        let cut = of("volumes.cut");
        assert_eq!((cut.difference, cut.relative, cut.counts), (Some(-1.0), Some(-0.01), true));
        assert_eq!((of("volumes.balance").difference, of("x").difference), (None, None));
        assert_eq!((&of("areas.cut").first, &of("areas.cut").second), (&Some(json!(1.0)), &None));
        assert_eq!((&of("depths.cut_max").first, &of("depths.cut_max").second), (&None, &Some(json!(2.0))));
        assert!(compare(&a, &a).is_empty());
    }

    #[test]
    fn rows_are_matched_by_what_they_are_about() {
        let row = |chain: &str, from: f64, cut: f64| json!({"chain": chain, "from": from, "to": from + 20.0, "cut": cut});
        let a = json!({"stations": [row("a", 0.0, 1.0), row("a", 20.0, 2.0), row("b", 0.0, 3.0)]});
        let b = json!({"stations": [row("b", 0.0, 3.0), row("a", 20.0, 2.5), row("a", 40.0, 9.0)]});
        let expected = [
            "stations[a 0.0 to 20.0].chain",
            "stations[a 0.0 to 20.0].cut",
            "stations[a 0.0 to 20.0].from",
            "stations[a 0.0 to 20.0].to",
            "stations[a 20.0 to 40.0].cut",
        ];
        let found = keys(a, b);
        for key in expected {
            assert!(found.contains(&key.to_owned()), "{key} in {found:?}");
        }
        assert!(found.iter().all(|key| !key.contains("[b ")) && found.len() == 9, "{found:?}");
        // The same name twice, and rows without names.
        assert_eq!(
            keys(json!({"w": [{"code": "a"}, {"code": "a", "n": 1}]}), json!({"w": [{"code": "a"}, {"code": "a", "n": 2}]})),
            ["w[a #2].n"]
        );
        assert_eq!(keys(json!({"levels": [1.0, 2.0]}), json!({"levels": [1.0, 3.0, 4.0]})), ["levels[2]", "levels[3]"]);
    }

    #[test]
    fn times_and_names_do_not_count() {
        let a =
            json!({"timing": {"total": 1.0}, "tool": {"version": "1"}, "inputs": [{"role": "line", "path": "a", "sha256": "x"}]});
        let b =
            json!({"timing": {"total": 2.0}, "tool": {"version": "2"}, "inputs": [{"role": "line", "path": "b", "sha256": "y"}]});
        let changes = compare(&a, &b);
        let counted: Vec<&str> = changes.iter().filter(|change| change.counts).map(|change| change.key.as_str()).collect();
        assert_eq!((changes.len(), counted), (4, vec!["inputs[line].sha256"]));
    }

    #[test]
    fn what_is_no_report_is_compared_all_the_same() {
        for value in [json!(null), json!([]), json!({"volumes": [1, {"cut": null}]}), json!(1e308)] {
            for other in [json!(null), json!({"volumes": {"cut": "x"}}), json!(-1e308), json!([[[1]]])] {
                compare(&value, &other);
            }
        }
    }
}
