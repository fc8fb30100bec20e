//! What makes one mechanism of another, as changes to the file of the first: a redesign with all comments kept.

use super::change::{Edit, Thing};
use crate::file::schema::{JointEntry, MechanismFile};
use serde_json::{Map, Value};

/// The keys of a joint that a redesign may change.
const KEYS: [&str; 9] = [
    "links",
    "type",
    "freedoms",
    "point",
    "axis",
    "reference",
    "lead",
    "pitch",
    "drive",
];

/// The changes that lead from a mechanism to a redesign of it: joints in their order, and what is added behind them. `own` is the
/// file that is changed, whose joints may list options that the new ones have outgrown.
#[must_use]
pub fn differences(
    before: &MechanismFile,
    after: &MechanismFile,
    own: &MechanismFile,
) -> Vec<Edit> {
    let mut out = Vec::new();
    for link in after.link.iter().skip(before.link.len()) {
        let mut entry = Map::new();
        entry.insert("id".to_owned(), Value::from(link.id.as_str()));
        out.push(Edit::Add {
            what: Thing::Link,
            entry,
        });
    }
    for (old, new) in before.joint.iter().zip(&after.joint) {
        let [was, is] = [old, new].map(keys);
        for key in KEYS {
            let [was, is] = [&was, &is].map(|k| k.get(key).cloned().unwrap_or_default());
            if was != is {
                out.push(Edit::Set {
                    what: Thing::Joint,
                    id: old.id.clone(),
                    key: key.to_owned(),
                    value: is,
                });
            }
        }
        let listed = own
            .joint
            .iter()
            .find(|j| j.id == old.id)
            .and_then(|j| j.options.as_ref());
        if let (Some(_), Some(kept)) = (listed, &new.options)
            && old.kind != new.kind
        {
            let value = serde_json::to_value(kept).unwrap_or_default();
            out.push(Edit::Set {
                what: Thing::Joint,
                id: old.id.clone(),
                key: "options".to_owned(),
                value: without_nothing(value),
            });
        }
    }
    for joint in after.joint.iter().skip(before.joint.len()) {
        out.push(Edit::Add {
            what: Thing::Joint,
            entry: keys(joint),
        });
    }
    let put = |path: &[&str], value: Value| Edit::Put {
        path: path.iter().map(|&k| k.to_owned()).collect(),
        value,
    };
    let listed = |list: &Vec<[String; 2]>| serde_json::to_value(list).unwrap_or_default();
    if before.search.mirror != after.search.mirror {
        out.push(put(&["search", "mirror"], listed(&after.search.mirror)));
    }
    if before.search.turn != after.search.turn {
        let turn = serde_json::to_value(&after.search.turn).unwrap_or_default();
        out.push(put(&["search", "turn"], turn));
    }
    // A basis that is left out is found anew.
    let count = |f: &MechanismFile| f.contour.iter().map(|c| c.joints.len()).sum::<usize>();
    if count(before) != count(after) {
        out.push(put(&["contour"], Value::Null));
    }
    out
}

/// An entry without what is left at its default.
fn keys(joint: &JointEntry) -> Map<String, Value> {
    let value = without_nothing(serde_json::to_value(joint).unwrap_or_default());
    let map = match value {
        Value::Object(map) => map,
        _ => Map::new(),
    };
    // Options of a joint are as many as the program could write; those of the file stand elsewhere.
    let told = |k: &str| !matches!(k, "options" | "unloading" | "forbid" | "tolerance");
    map.into_iter().filter(|(k, _)| told(k)).collect()
}

fn without_nothing(value: Value) -> Value {
    match value {
        Value::Object(map) => {
            let kept = map.into_iter().filter(|(_, v)| {
                !v.is_null()
                    && *v != Value::Bool(false)
                    && v.as_array().is_none_or(|a| !a.is_empty())
            });
            Value::Object(kept.map(|(k, v)| (k, without_nothing(v))).collect())
        }
        Value::Array(list) => Value::Array(list.into_iter().map(without_nothing).collect()),
        other => other,
    }
}
