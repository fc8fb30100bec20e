//! The differences between two mechanisms, as changes to the file of the first: a redesign that keeps all comments.

use super::change::{Edit, Thing};
use crate::file::prelude::*;
use serde_json::{Map, Value};

/// The keys of a joint that a redesign may change.
const KEYS: &str = "links type freedoms point axis reference lead pitch drive";

/// Returns the changes that lead from a mechanism to a redesign of it: joints in their order, then additions. `own` is the file
/// to change, whose joints may list options that the new ones exceed.
///
/// # Examples
/// ```
/// use ozols::file::{edit::{apply_edits, find_differences}, write::mechanism_file};
/// let four_bar = ozols::built_in("four-bar")?;
/// let outcome = ozols::search(&four_bar, &ozols::Request::default())?;
/// let best = outcome.variants().next().expect("there are 14").as_mechanism();
/// let [before, after] = [&four_bar, &best].map(mechanism_file);
/// let text = ozols::builtin::text("four-bar").unwrap_or_default();
/// let redesign = apply_edits(text, &find_differences(&before, &after, &before))?;
/// assert_eq!(ozols::analyze(&ozols::from_toml(&redesign)?)?[0].redundant, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn find_differences(
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
        let in_file = own.joint.iter().find(|j| j.id == old.id);
        out.extend(joint_changes(old, new, in_file));
    }
    for joint in after.joint.iter().skip(before.joint.len()) {
        out.push(Edit::Add {
            what: Thing::Joint,
            entry: changed_keys(joint),
        });
    }
    out.extend(put_changes(before, after));
    out
}

/// Returns the changes that turn one joint into another, including its options if the file lists some that the new type exceeds, and
/// its axis if the file has none, as of a ball.
fn joint_changes(old: &JointEntry, new: &JointEntry, in_file: Option<&JointEntry>) -> Vec<Edit> {
    let listed = in_file.is_some_and(|j| j.options.is_some());
    let lacks_axis = old.kind != new.kind && in_file.is_some_and(|j| j.axis.is_none());
    let set = |key: &str, value: Value| Edit::Set {
        what: Thing::Joint,
        id: old.id.clone(),
        key: key.to_owned(),
        value,
    };
    let mut out = Vec::new();
    let [was, is] = [old, new].map(changed_keys);
    for key in KEYS.split(' ') {
        let [was, is] = [&was, &is].map(|k| k.get(key).cloned().unwrap_or_default());
        if was != is || (key == "axis" && lacks_axis && !is.is_null()) {
            out.push(set(key, is));
        }
    }
    if let Some(kept) = new.options.as_ref().filter(|_| listed)
        && old.kind != new.kind
    {
        out.push(set("options", stripped_json(kept)));
    }
    out
}

/// Returns the changes of the symmetries that searches keep, and of the basis of contours.
fn put_changes(before: &MechanismFile, after: &MechanismFile) -> Vec<Edit> {
    let put = |path: &[&str], value: Value| Edit::Put {
        path: path.iter().map(|&k| k.to_owned()).collect(),
        value,
    };
    let mut out = Vec::new();
    let searches = [before, after].map(|f| stripped_json(&f.search));
    for key in ["mirror", "turn"] {
        let [was, is] = searches.each_ref().map(|s| &s[key]);
        if was != is {
            let none = || Value::Array(Vec::new());
            let value = Some(is.clone()).filter(|v| !v.is_null());
            out.push(put(&["search", key], value.unwrap_or_else(none)));
        }
    }
    // A basis that is omitted is computed again.
    let count = |f: &MechanismFile| f.contour.iter().map(|c| c.joints.len()).sum::<usize>();
    if count(before) != count(after) {
        out.push(put(&["contour"], Value::Null));
    }
    out
}

/// Returns an entry without values that equal their default.
fn changed_keys(joint: &JointEntry) -> Map<String, Value> {
    let map = match stripped_json(joint) {
        Value::Object(map) => map,
        _ => Map::new(),
    };
    // A written joint lists all options; those of the file are listed elsewhere.
    let told = |k: &str| !matches!(k, "options" | "unloading" | "forbid" | "tolerance");
    map.into_iter().filter(|(k, _)| told(k)).collect()
}
