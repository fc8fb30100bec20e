//! What there is to choose from: the built-in mechanisms as pictures, some that are to be drawn on, and the joint types, each with its
//! symbol as drawings have it.

use super::disk::{BLANK, Opening};
use crate::builtin;
use crate::draw::joint_symbol;
use crate::model::joint_type::{Freedom, JointType};
use crate::page::scenes::still_picture;
use crate::terms::PairWords;
use serde_json::{Value, json};
use std::path::PathBuf;

/// The picture of the window's tab.
pub(super) const ICON: &str = include_str!("icon.svg");

/// Mechanisms that are to be drawn on: the name, what it is, and its text.
const OWN: [(&str, &str, &str); 3] = [
    ("mechanism", "An empty sheet", BLANK),
    (
        "my-four-bar",
        "A new four-bar",
        include_str!("shelf/four-bar.toml"),
    ),
    (
        "my-gripper",
        "A new gripper of two jaws",
        include_str!("shelf/gripper.toml"),
    ),
];

/// Returns all the mechanisms to start from, by family.
pub(super) fn shelf_list() -> Value {
    let own: Vec<Value> = OWN
        .iter()
        .map(|(name, what, _)| json!({ "name": name, "what": what }))
        .collect();
    let built_in = builtin::families().into_iter().map(|(family, names)| {
        let all = names.into_iter().map(|name| {
            let m = crate::built_in(name).ok();
            json!({ "name": name, "what": m.map(|m| m.description.clone()) })
        });
        json!({ "family": family, "all": all.collect::<Vec<_>>() })
    });
    let first = json!({ "family": "to draw on", "all": own });
    Value::Array(std::iter::once(first).chain(built_in).collect())
}

/// Returns the opening of a name of the list.
pub(super) fn opening_of(name: &str, folder: PathBuf) -> Option<Opening> {
    let own = OWN.iter().find(|(n, ..)| *n == name);
    if let Some((name, _, text)) = own {
        return Some(Opening::Text(
            (*name).to_owned(),
            (*text).to_owned(),
            folder,
        ));
    }
    builtin::text(name)?;
    Some(Opening::Builtin(name.to_owned(), folder))
}

/// Returns the picture of a mechanism in the list.
pub(super) fn picture_of(name: &str) -> Option<String> {
    let own = OWN.iter().find(|(n, ..)| *n == name);
    let m = match own {
        Some((_, _, text)) => crate::from_toml(text),
        None => crate::built_in(name),
    };
    let Ok(m) = m else {
        // An empty sheet has no picture of its own.
        return own.map(|_| ICON.to_owned());
    };
    still_picture(&m)
}

/// Returns every type with its class, its freedoms, its description, and the pieces of its symbol.
pub(super) fn joint_types() -> Value {
    let words = PairWords::builtin();
    let custom = JointType::Custom(vec![Freedom::Rz, Freedom::Tx, Freedom::Ty, Freedom::Tz]);
    let types = JointType::NAMED.iter().chain([&custom]).map(|of| {
        let word = of.name();
        let free: Vec<_> = of.freedoms().iter().map(|f| f.name()).collect();
        json!({
            "type": word,
            "class": of.class_numeral(),
            "free": free,
            "trade": of.trade_names().collect::<Vec<_>>(),
            "about": words.get(word).map(|w| &w.about),
            "axis": words.get(word).map(|w| &w.axis),
            "symbol": joint_symbol(of),
        })
    });
    Value::Array(types.collect())
}

#[cfg(test)]
mod tests {
    use super::joint_types;
    use crate::model::joint_type::JointType;

    #[test]
    fn every_type_is_there_with_words_and_a_symbol() {
        let palette = joint_types();
        let types = palette.as_array().map_or(0, Vec::len);
        assert_eq!(types, JointType::all_words().count());
        for t in palette.as_array().into_iter().flatten() {
            assert!(t["about"].is_string(), "{t}");
            assert!(t["symbol"].as_array().is_some_and(|s| !s.is_empty()), "{t}");
        }
    }
}
