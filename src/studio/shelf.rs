//! What to start from: the built-in mechanisms as pictures, and some that are to be drawn on.

use super::disk::{BLANK, Opening};
use crate::builtin;
use crate::page::scenes::still_picture;
use serde_json::{Value, json};
use std::path::PathBuf;

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

/// All that there is to start from, by family.
pub(super) fn list() -> Value {
    let own: Vec<Value> = OWN
        .iter()
        .map(|(name, what, _)| json!({ "name": name, "what": what }))
        .collect();
    let built_in = builtin::families().into_iter().map(|(family, names)| {
        let all = names.into_iter().map(|name| {
            let m = crate::built_in(name).ok();
            json!({ "name": name, "what": m.map(|m| m.description) })
        });
        json!({ "family": family, "all": all.collect::<Vec<_>>() })
    });
    let first = json!({ "family": "to draw on", "all": own });
    Value::Array(std::iter::once(first).chain(built_in).collect())
}

/// What is opened under a name of the list.
pub(super) fn opening(name: &str, folder: PathBuf) -> Option<Opening> {
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

/// The picture of one of the list.
pub(super) fn picture(name: &str) -> Option<String> {
    let own = OWN.iter().find(|(n, ..)| *n == name);
    let m = match own {
        Some((_, _, text)) => crate::from_toml(text),
        None => crate::built_in(name),
    };
    let Ok(m) = m else {
        // An empty sheet has no picture of its own.
        return own.map(|_| super::paper::ICON.to_owned());
    };
    still_picture(&m)
}
