//! Commands to suggest after an analysis.

use super::State;
use crate::search::answer::single_changes::USUAL_UNLOADING;
use crate::view::analysis::suggestions::{Advice, concerned_count};
use crate::view::prelude::*;
use crate::view::terminal::next_commands::{NextCommand, file_name, shell_word};

/// Returns the commands to suggest after an analysis of `file`.
pub fn next(m: &Mechanism, states: &[State<'_>], file: &str) -> Vec<NextCommand> {
    let mut steps: Vec<NextCommand> = states.iter().filter_map(|s| to_remove(s, file)).collect();
    if !steps.is_empty() {
        return steps;
    }
    let loaded = m.loads.acts_from_outside(StateId::FREE) || m.loads.gravity.is_some();
    if loaded {
        steps.push(NextCommand::new(
            "statics",
            file,
            "",
            "the joints' reactions to its loads",
        ));
    }
    let svg = file_name(&m.name, "svg");
    steps.push(NextCommand::new(
        "draw",
        file,
        &format!("-o {svg}"),
        "a drawing of it",
    ));
    steps
}

/// Returns the step towards redesigns without the redundant constraints of a state. Returns `None` if no change is known that
/// removes any.
fn to_remove(s: &State<'_>, file: &str) -> Option<NextCommand> {
    let Some(Advice::Changes(found)) = s.advice else {
        return None;
    };
    let of = concerned_count(s.found);
    match (found.usual, found.state) {
        (_, StateId::FREE) => Some(NextCommand::new(
            "search",
            file,
            "",
            &format!("list the redesigns that remove all {of}, cheapest first"),
        )),
        (false, n) => {
            let best = found.list.first();
            let left = best.map_or(of, |x| of.saturating_sub(x.removes));
            let state = if n == StateId::new(1) {
                String::new()
            } else {
                format!(" {}", typed_option("state", shell_word(&s.found.state)))
            };
            Some(NextCommand::new(
                "search",
                file,
                &(typed_option("max-external", left) + &state),
                &format!(
                    "also limit the redundant constraints added by clamping to {left} of {of}"
                ),
            ))
        }
        (true, _) if !found.list.is_empty() => Some(NextCommand {
            command: format!(
                "Write at a contact of state {}: unloading = [\"{}\"]",
                s.found.state,
                USUAL_UNLOADING.name()
            ),
            gives: format!(
                "so that `ozols search` may insert it; {} asks for it",
                typed_option("max-external", "N")
            ),
        }),
        (true, _) => None,
    }
}
