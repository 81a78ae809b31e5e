//! The published schemas of the JSON reports, made from the structures that are written: their doc comments are the descriptions.
//! The files under `docs/` are written by `cargo run --example schema`; a test compares them.

use super::{
    BATCH_SCHEMA, BatchReport, BetweenReport, CHECK_SCHEMA, CheckReport, DIFF_SCHEMA, DiffReport, INFO_SCHEMA, InfoReport,
    Report, SCHEMA, SELFTEST_SCHEMA, SelftestReport,
};
use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

/// A published schema.
#[derive(Clone, Copy, Debug)]
pub struct Published {
    /// Its name, as in the key `schema` of a report: `slopegen-report/1`.
    pub name: &'static str,
    /// What it is of.
    title: &'static str,
    /// The structures written under this name.
    reports: &'static [fn(&mut SchemaGenerator) -> Schema],
}

/// All schemas. A new report is one line here.
pub const PUBLISHED: [Published; 6] = [
    Published { name: SCHEMA, title: "Report of slopegen build or volume", reports: &[of::<Report>, of::<BetweenReport>] },
    Published { name: CHECK_SCHEMA, title: "Report of slopegen check", reports: &[of::<CheckReport>] },
    Published { name: BATCH_SCHEMA, title: "Summary of slopegen batch", reports: &[of::<BatchReport>] },
    Published { name: DIFF_SCHEMA, title: "Report of slopegen diff", reports: &[of::<DiffReport>] },
    Published { name: INFO_SCHEMA, title: "Report of slopegen info", reports: &[of::<InfoReport>] },
    Published { name: SELFTEST_SCHEMA, title: "Report of slopegen selftest", reports: &[of::<SelftestReport>] },
];

fn of<T: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
    generator.subschema_for::<T>()
}

impl Published {
    /// Name of the file under `docs/`: `slopegen-report-1.schema.json`.
    pub fn file(&self) -> String {
        format!("{}.schema.json", self.name.replace('/', "-"))
    }

    /// The schema, JSON Schema 2020-12.
    ///
    /// It is exact for the reports this version writes: keys it does not name are refused (warnings and places have figures
    /// under names of their own), and keys that are always written are required.
    pub fn schema(&self) -> Value {
        let mut generator = SchemaSettings::draft2020_12().for_serialize().with_transform(Exact).into_generator();
        let reports: Vec<Schema> = self.reports.iter().map(|report| report(&mut generator)).collect();
        let mut root = Map::new();
        root.insert("$schema".to_owned(), json!("https://json-schema.org/draft/2020-12/schema"));
        root.insert("title".to_owned(), json!(self.title));
        let words = format!(
            "Schema {}. Lengths are in the unit the report names, areas in its square, volumes in its cube. Slopes and gradients \
             are rise per run, angles in degrees. A key that does not apply is left out.",
            self.name
        );
        root.insert("description".to_owned(), json!(words));
        match reports.as_slice() {
            [one] => root.extend(one.as_object().cloned().unwrap_or_default()),
            several => drop(root.insert("oneOf".to_owned(), json!(several))),
        }
        root.insert("$defs".to_owned(), Value::Object(generator.take_definitions(true)));
        Value::Object(root)
    }

    /// The schema as it stands in its file.
    pub fn text(&self) -> String {
        format!("{:#}\n", self.schema())
    }
}

/// Makes a generated schema as exact as reports are: no key that is not named, no null, no formats of machine numbers.
#[derive(Clone, Debug)]
struct Exact;

impl Transform for Exact {
    fn transform(&mut self, schema: &mut Schema) {
        if let Some(object) = schema.as_object_mut() {
            // A key that does not apply is left out.
            if let Some(Value::Array(kinds)) = object.get_mut("type") {
                kinds.retain(|kind| kind != "null");
                if let [one] = kinds.as_slice() {
                    let one = one.clone();
                    object.insert("type".to_owned(), one);
                }
            }
            if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
                choices.retain(|choice| choice != &json!({"type": "null"}));
                if let [Value::Object(one)] = choices.as_slice() {
                    let one = one.clone();
                    object.remove("anyOf");
                    object.extend(one);
                }
            }
            // Line breaks of doc comments mean nothing.
            if let Some(Value::String(words)) = object.get_mut("description") {
                *words = words.replace('\n', " ");
            }
            // `double` and `uint64` say nothing that the type and the bounds do not.
            object.remove("format");
            if object.contains_key("properties") && !object.contains_key("additionalProperties") {
                object.insert("additionalProperties".to_owned(), json!(false));
            }
        }
        transform_subschemas(self, schema);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Calls `visit` with every schema object and where it is.
    fn walk(value: &Value, path: &str, visit: &mut dyn FnMut(&str, &Map<String, Value>)) {
        match value {
            Value::Object(object) => {
                visit(path, object);
                object.iter().for_each(|(key, value)| walk(value, &format!("{path}/{key}"), visit));
            }
            Value::Array(items) => items.iter().for_each(|item| walk(item, path, visit)),
            _ => {}
        }
    }

    #[test]
    fn every_key_is_described_in_words_that_need_no_source() {
        for published in PUBLISHED {
            let mut keys = 0;
            walk(&published.schema(), "", &mut |path, object| {
                let Some(Value::Object(properties)) = object.get("properties") else { return };
                assert!(object.contains_key("additionalProperties"), "{}: {path} takes any key", published.name);
                for (key, schema) in properties {
                    keys += 1;
                    let words = schema.get("description").and_then(Value::as_str);
                    // What an enum of objects says by its tag is described where the tag is one of several.
                    let tag = schema.get("const").is_some();
                    assert!(words.is_some() || tag, "{}: {path}/{key} has no description", published.name);
                    let words = words.unwrap_or_default();
                    assert!(!words.contains("[`") && !words.contains("::"), "{}: {path}/{key}: {words}", published.name);
                }
            });
            assert!(keys > 20, "only {keys} keys: the search is broken");
        }
    }

    #[test]
    fn nothing_may_be_null() {
        for published in PUBLISHED {
            assert!(!published.text().contains("\"null\""), "{}", published.name);
        }
    }
}
