//! What there is to choose from: the built-in mechanisms as pictures, some that are to be drawn on, and the joint types, each with its
//! symbol as drawings have it.

use super::disk::{BLANK, Opening};
use crate::builtin;
use crate::file::text::mechanism_from_str;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Mechanism, StateId};
use crate::page::scenes::{still_picture, still_scene};
use crate::terms::PairWords;
use serde_json::{Value, json};
use std::fmt::Write as _;
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

/// Returns a mechanism with a joint of each type, side by side.
fn sampler_mechanism() -> Option<Mechanism> {
    let mut text = "name = \"palette\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n".to_owned();
    for (n, word) in JointType::all_words().enumerate() {
        let more = match word {
            "helical" => "lead = 1\n",
            "custom" => "freedoms = [\"rz\", \"tx\", \"ty\", \"tz\"]\n",
            _ => "",
        };
        let _ = write!(
            text,
            "[[link]]\nid = \"{word}\"\n[[joint]]\nid = \"{word}\"\nlinks = [\"0\", \"{word}\"]\ntype = \"{word}\"\n\
             point = [{}, 0, 0]\naxis = [0, 0, 1]\n{more}",
            10 * n
        );
    }
    mechanism_from_str("palette.toml", &text).ok()
}

/// Returns every type with its class, its freedoms, its description, and the pieces of its symbol.
pub(super) fn joint_types() -> Value {
    let words = PairWords::builtin();
    let Some(m) = sampler_mechanism() else {
        return Value::Null;
    };
    let scene = still_scene(&m, (None, StateId::FREE), &[]);
    let scene = serde_json::to_value(scene).unwrap_or_default();
    let symbol = |word: &str| {
        let all = scene["joints"].as_array().into_iter().flatten();
        let number = all
            .filter(|j| j["id"] == word)
            .find_map(|j| j["symbol"].as_u64());
        let number = number.and_then(|n| usize::try_from(n).ok());
        number.map_or(Value::Null, |n| scene["symbols"][n].clone())
    };
    let types = m.joints.iter().map(|j| {
        let word = j.joint_type.name();
        let free: Vec<_> = j.joint_type.freedoms().iter().map(|f| f.name()).collect();
        json!({
            "type": word,
            "class": j.joint_type.class_numeral(),
            "free": free,
            "trade": j.joint_type.trade_names().collect::<Vec<_>>(),
            "about": words.get(word).map(|w| &w.about),
            "axis": words.get(word).map(|w| &w.axis),
            "symbol": symbol(word),
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
