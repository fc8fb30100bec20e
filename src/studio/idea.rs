//! The ideas of a search on the drawing, and taken into the file.

use super::desk::Refused;
use super::reading::DeskReading;
use crate::file::edit::{Edit, find_differences};
use crate::file::write::mechanism_file;
use crate::model::mechanism::Mechanism;
use crate::page::scenes::still_scene;
use crate::page::state_swaps;
use crate::redundancy::analysis::StateAnalysis;
use crate::redundancy::release::Release;
use crate::robots;
use crate::score::outcome::Outcome;
use crate::search::question::space::choice_name;
use crate::view::lint::describe_release;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Returns for each state the joints that the ideas of a list change. Each has its joint and choice, as the changes of a
/// variant name them, and its symbols.
pub(super) fn idea_marks(
    m: &Mechanism,
    states: &[StateAnalysis],
    found: &Outcome,
    list: &Value,
) -> Vec<Value> {
    let variants = list.as_array().into_iter().flatten();
    let changes = variants.filter_map(|v| v["changes"].as_array()).flatten();
    let wanted: BTreeSet<(&str, &str)> = changes
        .filter_map(|c| Some((c["joint"].as_str()?, c["to"].as_str()?)))
        .collect();
    let one = |(analysis, state): (&StateAnalysis, _)| {
        let all = state_swaps(m, found, state).into_iter();
        let named = all.filter_map(|([v, c], swap)| {
            let choice = &found.search.space.variables[v].choices[c];
            let to = choice_name(&found.search.mechanism, swap.joint, choice);
            let joint = m.joints[swap.joint].id.as_str();
            wanted
                .contains(&(joint, &*to))
                .then_some(([joint.to_owned(), to], swap))
        });
        let (rows, swaps): (Vec<[String; 2]>, Vec<_>) = named.unzip();
        let of = analysis.meant.as_deref().unwrap_or(m);
        let scene = still_scene(of, (Some(analysis), state), &swaps)?;
        let scene = serde_json::to_value(scene).ok()?;
        Some(json!({ "rows": rows, "symbols": scene["symbols"], "swaps": scene["swaps"] }))
    };
    let all = states.iter().zip(m.state_ids()).map(one);
    all.map(|v| v.unwrap_or(Value::Null)).collect()
}

/// The effect of an idea on the open file.
pub(super) enum Taken {
    /// Changes to a mechanism file.
    Edits(Vec<Edit>),
    /// A description with what `ozols fix` does to it.
    Fixed(Vec<u8>),
}

/// Takes an idea, counted from 1.
pub(super) fn take_idea(
    reading: &DeskReading,
    found: &Outcome,
    k: usize,
) -> Result<Taken, Refused> {
    let gone = || Refused::Words(format!("idea {k} is no longer in the list"));
    let variant = found.variants().nth(k.checked_sub(1).ok_or_else(gone)?);
    let variant = variant.ok_or_else(gone)?;
    let (before, after) = (&found.search.mechanism, variant.as_mechanism());
    if let Some(imported) = &reading.imported {
        let name = |why| Refused::Words(format!("idea {k} {why}"));
        let all = robots::find_releases(before, &after).map_err(name)?;
        let told: Vec<(Release, String)> = all
            .into_iter()
            .map(|r| (r, describe_release(before, &r)))
            .collect();
        let fixed =
            robots::apply_releases(imported, &told).map_err(|e| Refused::Words(e.to_string()))?;
        return Ok(Taken::Fixed(fixed));
    }
    let own = reading.file.as_ref().ok_or_else(gone)?;
    let edits = find_differences(&mechanism_file(before), &mechanism_file(&after), own);
    Ok(Taken::Edits(edits))
}
