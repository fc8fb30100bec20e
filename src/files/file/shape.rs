//! Checks a document against the schema: lists that are too long or too short, and unknown keys.
//!
//! The TOML deserializer ignores the extra values of a list, and the JSON one calls them "trailing characters". Both stop at the
//! first unknown key.

use crate::file::schema::json_schema;
use crate::file::{Finding, Findings, Place, unknown_word};
use crate::format::count_noun;
use serde_json::{Map, Value};
use std::sync::LazyLock;

static SCHEMA: LazyLock<Value> = LazyLock::new(json_schema);

/// Returns a problem for each list of a document whose length its schema excludes and for each key that it does not have.
pub(crate) fn wrong_shapes(document: &Value) -> Vec<Finding> {
    let out = Findings::default();
    check_value(&SCHEMA, document, "", &out.root_place());
    out.into_findings()
}

/// Checks a value against its schema; `owner` names the innermost item with an id around it.
fn check_value(schema: &Value, value: &Value, owner: &str, at: &Place<'_>) {
    let all = schema_alternatives(schema);
    match value {
        Value::Array(items) => {
            let lists = all.into_iter().filter(|s| is_list(s));
            let (fit, not): (Vec<_>, Vec<_>) = lists.partition(|s| {
                let [least, most] = length_limits(s);
                (least..=most).contains(&items.len())
            });
            if let Some(schema) = fit.first().and_then(|s| s.get("items")) {
                at.each_entry(items)
                    .for_each(|(at, item)| check_value(schema, item, owner, &at));
            } else if let (true, Some(schema)) = (fit.is_empty(), not.first()) {
                let wanted = match length_limits(schema) {
                    [least, most] if least == most => {
                        format!("{}, no more and no fewer", count_noun(least, "value"))
                    }
                    [least, most] => format!("{least} to {}", count_noun(most, "value")),
                };
                at.add_problem(format!(
                    "{} has {}; write {wanted}",
                    list_name(at, owner),
                    count_noun(items.len(), "value")
                ));
            }
        }
        Value::Object(entries) => {
            let id = entries.get("id").and_then(Value::as_str);
            let own =
                id.map(|id| format!(" of {} \"{id}\"", at.path.last_key().unwrap_or_default()));
            let owner = own.as_deref().unwrap_or(owner);
            for (k, entry) in entries {
                match all.iter().find_map(|s| of_key(s, k)) {
                    Some(Value::Bool(false)) => {
                        let known = all.iter().filter_map(|s| s.get("properties")?.as_object());
                        at.key_name(k).add_problem(unknown_word(
                            "key",
                            k,
                            known.flat_map(Map::keys),
                        ));
                    }
                    Some(schema) => check_value(schema, entry, owner, &at.key(k)),
                    None => {}
                }
            }
        }
        _ => {}
    }
}

/// Returns what a schema may be: what it refers to, or each that it offers, or itself.
fn schema_alternatives(schema: &Value) -> Vec<&Map<String, Value>> {
    let Some(own) = schema.as_object() else {
        return Vec::new();
    };
    if let Some(place) = own.get("$ref").and_then(Value::as_str) {
        let referred = SCHEMA.pointer(place.trim_start_matches('#'));
        return referred.map(schema_alternatives).unwrap_or_default();
    }
    match own.get("anyOf").and_then(Value::as_array) {
        Some(offered) => offered.iter().flat_map(schema_alternatives).collect(),
        None => vec![own],
    }
}

/// Returns whether a schema is that of a list.
fn is_list(schema: &Map<String, Value>) -> bool {
    match schema.get("type") {
        Some(Value::String(word)) => word == "array",
        Some(Value::Array(words)) => words.iter().any(|w| w == "array"),
        _ => false,
    }
}

/// Returns the least and the greatest length of a list.
fn length_limits(schema: &Map<String, Value>) -> [usize; 2] {
    let limit = |name: &str| {
        let stated = schema.get(name).and_then(Value::as_u64);
        stated.and_then(|n| usize::try_from(n).ok())
    };
    [
        limit("minItems").unwrap_or(0),
        limit("maxItems").unwrap_or(usize::MAX),
    ]
}

/// Returns the schema of an entry of a table.
fn of_key<'s>(schema: &'s Map<String, Value>, key: &str) -> Option<&'s Value> {
    let known = schema.get("properties").and_then(|all| all.get(key));
    known.or_else(|| schema.get("additionalProperties"))
}

/// Returns the name of a list in a message: its key, with its index if it is a list in a list, and its owner.
fn list_name(at: &Place<'_>, owner: &str) -> String {
    let place = at.path.last_index();
    let place = place.map_or(String::new(), |i| format!("entry {} of ", i + 1));
    format!("{place}{}{owner}", at.path.last_key().unwrap_or_default())
}
