//! The joint types to choose from, each with its symbol as drawings have it.

use crate::file::text::mechanism_from_str;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Mechanism, StateId};
use crate::page::scenes::still_scene;
use crate::terms::PairWords;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// A mechanism with a joint of each type, side by side.
fn sampler() -> Option<Mechanism> {
    let mut text = "name = \"palette\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n".to_owned();
    for (n, word) in JointType::words().enumerate() {
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

/// Every type with its class, its freedoms, what it is, and the pieces of its symbol.
pub(super) fn json() -> Value {
    let words = PairWords::builtin();
    let Some(m) = sampler() else {
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
            "class": j.joint_type.class(),
            "free": free,
            "about": words.get(word).map(|w| &w.about),
            "axis": words.get(word).map(|w| &w.axis),
            "symbol": symbol(word),
        })
    });
    Value::Array(types.collect())
}

#[cfg(test)]
mod tests {
    use super::json;
    use crate::model::joint_type::JointType;

    #[test]
    fn every_type_is_there_with_words_and_a_symbol() {
        let palette = json();
        let types = palette.as_array().map_or(0, Vec::len);
        assert_eq!(types, JointType::words().count());
        for t in palette.as_array().into_iter().flatten() {
            assert!(t["about"].is_string(), "{t}");
            assert!(t["symbol"].as_array().is_some_and(|s| !s.is_empty()), "{t}");
        }
    }
}
