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
    let mut text =
        "name = \"palette\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n".to_owned();
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

/// Every type with its class, its freedoms, what it is, and the scene that its symbol stands in.
pub(super) fn json() -> Value {
    let words = PairWords::builtin();
    let Some(m) = sampler() else {
        return Value::Null;
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
        })
    });
    let types: Vec<Value> = types.collect();
    json!({ "types": types, "scene": still_scene(&m, (None, StateId::FREE), &[]) })
}

#[cfg(test)]
mod tests {
    use super::json;
    use crate::model::joint_type::JointType;

    #[test]
    fn every_type_is_there_with_words_and_a_symbol() {
        let palette = json();
        let types = palette["types"].as_array().map_or(0, Vec::len);
        assert_eq!(types, JointType::words().count());
        for t in palette["types"].as_array().into_iter().flatten() {
            assert!(t["about"].is_string(), "{t}");
            let joints = palette["scene"]["joints"].as_array();
            assert!(joints.into_iter().flatten().any(|j| j["id"] == t["type"]), "{t}");
        }
    }
}
