//! Every list of fixed length in the schema of mechanism files, one shorter and one longer, in TOML and in JSON.

use crate::common::*;
use ozols::file::schema::json_schema;

/// A step from a value to a list in it.
#[derive(Clone)]
enum Step {
    Key(String),
    Entry,
}

/// A list of the schema, where it stands and its least and greatest length.
struct List {
    place: Vec<Step>,
    item: Value,
    least: usize,
    most: usize,
}

/// Every list with a limit below a schema. A definition that is being visited is not visited again.
fn lists(
    all: &Value,
    schema: &Value,
    place: &[Step],
    visited: &mut Vec<String>,
    out: &mut Vec<List>,
) {
    if let Some(name) = schema["$ref"].as_str() {
        let name = name.trim_start_matches("#/$defs/").to_owned();
        if !visited.contains(&name) {
            visited.push(name.clone());
            lists(all, &all["$defs"][&name], place, visited, out);
            visited.pop();
        }
    }
    for other in schema["anyOf"].as_array().into_iter().flatten() {
        lists(all, other, place, visited, out);
    }
    let mut with = |step: Step, schema: &Value, out: &mut Vec<List>| {
        let place = [place, &[step]].concat();
        lists(all, schema, &place, visited, out);
    };
    for (key, schema) in schema["properties"].as_object().into_iter().flatten() {
        with(Step::Key(key.clone()), schema, out);
    }
    if schema["additionalProperties"].is_object() {
        with(
            Step::Key("any".to_owned()),
            &schema["additionalProperties"],
            out,
        );
    }
    if schema["items"].is_object() {
        let limit = |key: &str| schema[key].as_u64().map(|n| usize::try_from(n).unwrap());
        if let (Some(least), Some(most)) = (limit("minItems"), limit("maxItems")) {
            let item = match schema["items"]["type"].as_str() {
                Some("string") => json!("x"),
                _ => json!(1),
            };
            out.push(List {
                place: place.to_vec(),
                item,
                least,
                most,
            });
        }
        with(Step::Entry, &schema["items"], out);
    }
}

impl List {
    /// Its key, or that of the list that it is an entry of.
    fn key(&self) -> &str {
        let keys = self.place.iter().rev().find_map(|s| match s {
            Step::Key(k) => Some(k.as_str()),
            Step::Entry => None,
        });
        keys.unwrap()
    }

    /// A document that has nothing else, with so many values in the list.
    fn document(&self, values: usize) -> Value {
        let list = Value::Array(vec![self.item.clone(); values]);
        self.place
            .iter()
            .rev()
            .fold(list, |inner, step| match step {
                Step::Key(k) => json!({ k: inner }),
                Step::Entry => json!([inner]),
            })
    }
}

#[test]
fn lists_one_shorter_or_longer_are_refused() {
    let schema = json_schema();
    let mut all = Vec::new();
    lists(&schema, &schema, &[], &mut Vec::new(), &mut all);
    // What the structs of the schema have: lengths of points, axes, pairs and quadruples.
    let keys: BTreeSet<&str> = all.iter().map(List::key).collect();
    for part in split_words(
"links joints point axis reference centre plane_normal gravity force moment mirror accelerations lever_joints
            contacts centre_of_mass inertia",
) {
        assert!(keys.contains(part), "{part}");
    }
    for list in &all {
        for values in (list.least - 1..=list.most + 1).filter(|n| *n > 0) {
            let document = list.document(values);
            let texts = [
                ("x.toml", toml::to_string(&document).unwrap()),
                ("x.json", serde_json::to_string_pretty(&document).unwrap()),
            ];
            let fits = (list.least..=list.most).contains(&values);
            for (name, text) in texts {
                let why = mechanism_from_str(name, &text).unwrap_err().to_string();
                let said = why.contains(&format!("{} has {values} value", list.key()));
                assert_eq!(said, !fits, "{why}\n{text}");
                let of_length = why.contains(&format!("write {}", list.least));
                assert_eq!(of_length, !fits, "{why}\n{text}");
                let line = why
                    .split(':')
                    .nth(1)
                    .and_then(|n| n.trim().parse::<usize>().ok());
                assert!(fits || why.starts_with(name) && line.is_some(), "{why}");
            }
        }
    }
}
