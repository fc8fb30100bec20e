//! The contents of a page.

use crate::draw::{Drawing, Scene};
use crate::format::plain::changes_direction;
use crate::model::mechanism::{Joint, Mechanism};
use crate::page::scenes::state_swaps;
use crate::redundancy::analysis::{ContourShare, StateAnalysis};
use crate::score::outcome::Outcome;
use crate::score::outcome::remarks::Remarks;
use crate::score::outcome::variant::Variant;
use crate::search::check::singular_values::Summary;
use crate::view::analysis::Analysis;
use crate::view::terminal::next_commands::NextCommand;
use maud::{Markup, html};
use serde_json::{Value, json};

/// Everything a page tells.
#[derive(Debug)]
pub struct Page<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its figures in every state, in order.
    pub states: &'a [StateAnalysis],
    /// Its redesigns, or why none were searched.
    pub redesigns: Result<Redesigns<'a>, String>,
    /// The same search as a list of ideas, each by its first variant, where the redesigns are not one already.
    pub ideas: Option<Redesigns<'a>>,
    /// The mechanism in space in each state, if there is more to see than in a drawing; with at most `SHOWN` idle
    /// freedoms and self-stresses.
    pub scenes: Vec<Option<(Drawing, Scene)>>,
    /// How to get the same from the command line.
    pub commands: Commands,
}

/// The result of a search.
#[derive(Debug)]
pub struct Redesigns<'a> {
    /// Counts and conditions.
    pub found: &'a Outcome,
    /// The variants of the page, in their order.
    pub variants: Vec<Variant<'a>>,
    /// What second opinions and other poses say of them.
    pub summary: Summary,
    /// Whether the giving was interrupted.
    pub interrupted: bool,
    /// Why there are none, and which redesigns are symmetric.
    pub remarks: Remarks,
}

/// How to get what a page shows from the command line: commands quoted for a shell.
#[derive(Debug, Clone)]
pub struct Commands {
    /// The commands that are about the mechanism.
    pub rows: Vec<NextCommand>,
    /// The same about one variant, with `{}` for its number; empty if there is no such command.
    pub variant: Vec<(String, String)>,
    /// The same about one idea.
    pub idea: Vec<(String, String)>,
    /// A longer list with other options at some joints: a command with `{}` for them.
    pub longer: String,
    /// The commands that find something where this page has nothing.
    pub wider: Vec<NextCommand>,
}

pub(super) fn commands_html(commands: &[NextCommand]) -> Markup {
    html! {
        dl.commands {
            @for NextCommand { command, gives } in commands {
                dt { (gives) }
                dd { code { (command) } }
            }
        }
    }
}

/// Returns all of it, ready to stand in a script element.
pub(super) fn script_data(
    page: &Page<'_>,
    analysis: &Analysis<'_>,
    [search, ideas]: [Option<Value>; 2],
) -> String {
    let m = page.mechanism;
    // Variable, choice and joint of each swap of the scene of a state, in its order.
    let swaps = |s| -> Vec<[usize; 3]> {
        let all = page.redesigns.iter();
        let all = all.flat_map(|r| state_swaps(m, r.found, s));
        all.map(|([v, c], swap)| [v, c, swap.joint.index()])
            .collect()
    };
    let contour = |c: &ContourShare| json!({ "name": c.contour.name(m), "redundant": c.redundant });
    let state = |s: &StateAnalysis| {
        json!({
            "name": s.state,
            "links": s.links,
            "joints": s.joints,
            "rows": s.rows,
            "freedoms": s.freedoms,
            "mobility": s.mobility,
            "redundant": s.redundant,
            "external": s.external.as_ref().map(|e| e.redundant),
            "contours": s.per_contour.iter().map(contour).collect::<Value>(),
        })
    };
    let joint = |j: &Joint| {
        json!({
            "id": j.id,
            "links": j.links.map(|l| m.links[l].id.as_str()),
            "type": j.joint_type.name(),
            "class": j.joint_type.class_numeral(),
        })
    };
    let scenes = page.scenes.iter().map(|s| s.as_ref().map(|s| &s.1));
    let data = json!({
        "format": 1,
        "mechanism": m.name,
        "length_unit": m.length_unit.symbol,
        "states": analysis.states.iter().map(|s| state(s.found)).collect::<Value>(),
        "joints": m.joints.iter().map(joint).collect::<Value>(),
        "search": search,
        "ideas": ideas,
        "swaps": m.state_ids().map(swaps).collect::<Vec<_>>(),
        "variant_commands": page.commands.variant,
        "idea_commands": page.commands.idea,
        "longer": page.commands.longer,
        "scenes": scenes.collect::<Vec<_>>(),
    });
    escape_json(&data.to_string())
}

pub(super) fn escape_json(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    // These characters stand in strings only, where an escape means the same.
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                out.push_str(&format!("\\u{:04x}", u32::from(c)));
            }
            // Spelt out, as all else of the page has it.
            _ if changes_direction(c) => out.push_str(&format!("\\\\u{{{:x}}}", u32::from(c))),
            _ => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_string_ends_the_script() {
        let hostile = json!({"name": "</script><!--\u{2028}&amp;", "n": 1});
        let written = escape_json(&hostile.to_string());
        assert!(!written.contains(['<', '>', '&', '\u{2028}']), "{written}");
        assert_eq!(serde_json::from_str::<Value>(&written).unwrap(), hostile);
    }
}
