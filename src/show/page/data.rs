//! What the script of a page knows, as JSON inside the page.

use super::contents::Page;
use super::symbols::Swaps;
use super::variants::FoundColumns;
use crate::draw::Scene;
use crate::format::plain::turns;
use crate::model::mechanism::{Joint, Mechanism};
use crate::view::analysis::{Analysis, State};
use serde::Serialize;

/// All of it.
#[derive(Serialize)]
pub(super) struct Data<'a> {
    format: u8,
    mechanism: &'a str,
    length_unit: &'a str,
    states: Vec<StateData<'a>>,
    joints: Vec<JointData<'a>>,
    search: Option<FoundColumns>,
    ideas: Option<FoundColumns>,
    swaps: Vec<Swaps>,
    variant_commands: &'a [(String, String)],
    idea_commands: &'a [(String, String)],
    longer: &'a str,
    scenes: Vec<Option<&'a Scene>>,
}

#[derive(Serialize)]
struct StateData<'a> {
    name: &'a str,
    links: usize,
    joints: usize,
    rows: usize,
    freedoms: usize,
    mobility: usize,
    redundant: usize,
    external: Option<i64>,
    contours: Vec<ContourData<'a>>,
}

#[derive(Serialize)]
struct ContourData<'a> {
    name: &'a str,
    redundant: usize,
}

#[derive(Serialize)]
struct JointData<'a> {
    id: &'a str,
    links: [&'a str; 2],
    r#type: &'static str,
    class: &'static str,
}

impl<'a> Data<'a> {
    pub(super) fn new(
        page: &'a Page<'_>,
        analysis: &'a Analysis<'_>,
        [search, ideas]: [Option<FoundColumns>; 2],
        swaps: Vec<Swaps>,
    ) -> Data<'a> {
        let m = page.mechanism;
        Data {
            format: 1,
            mechanism: &m.name,
            length_unit: m.length_unit.symbol,
            states: analysis.states.iter().map(StateData::new).collect(),
            joints: m.joints.iter().map(|j| JointData::new(m, j)).collect(),
            search,
            ideas,
            swaps,
            variant_commands: &page.commands.variant,
            idea_commands: &page.commands.idea,
            longer: &page.commands.longer,
            scenes: page
                .scenes
                .iter()
                .map(|s| s.as_ref().map(|s| &s.1))
                .collect(),
        }
    }

    /// As text inside a script element: no `<`, so that nothing can end the element or begin a comment, and none of the
    /// line ends that JSON allows and scripts do not.
    pub(super) fn script(&self) -> String {
        escaped(&serde_json::to_string(self).expect("keys are text and numbers finite"))
    }
}

pub(super) fn escaped(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    // These characters stand in strings only, where an escape means the same.
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                out.push_str(&format!("\\u{:04x}", u32::from(c)));
            }
            // Spelt out, as all else of the page has it.
            _ if turns(c) => out.push_str(&format!("\\\\u{{{:x}}}", u32::from(c))),
            _ => out.push(c),
        }
    }
    out
}

impl<'a> StateData<'a> {
    fn new(s: &'a State<'_>) -> StateData<'a> {
        let contours = s.per_contour.iter().map(|c| ContourData {
            name: &c.contour,
            redundant: c.redundant,
        });
        StateData {
            name: s.state,
            links: s.links,
            joints: s.joints,
            rows: s.rows,
            freedoms: s.freedoms,
            mobility: s.mobility,
            redundant: s.redundant,
            external: s.external.as_ref().map(|e| e.counted.redundant),
            contours: contours.collect(),
        }
    }
}

impl<'a> JointData<'a> {
    fn new(m: &'a Mechanism, j: &'a Joint) -> JointData<'a> {
        JointData {
            id: &j.id,
            links: j.links.map(|l| m.links[l].id.as_str()),
            r#type: j.joint_type.name(),
            class: j.joint_type.class(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    #[test]
    fn nothing_in_a_string_ends_the_script() {
        let hostile = json!({"name": "</script><!--\u{2028}&amp;", "n": 1});
        let written = escaped(&hostile.to_string());
        assert!(!written.contains(['<', '>', '&', '\u{2028}']), "{written}");
        assert_eq!(serde_json::from_str::<Value>(&written).unwrap(), hostile);
    }
}
