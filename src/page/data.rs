//! What the script of a page knows, as JSON inside the page.

use super::Page;
use super::symbols::Swaps;
use super::variants::Found;
use crate::model::mechanism::{Joint, Mechanism};
use crate::view::analysis::{Analysis, State};
use serde::{Serialize, Serializer};

/// All of it.
#[derive(Serialize)]
pub(super) struct Data<'a> {
    format: u8,
    mechanism: &'a str,
    length_unit: &'a str,
    states: Vec<StateData<'a>>,
    joints: Vec<JointData<'a>>,
    search: Option<Found>,
    swaps: Vec<Swaps>,
    variant_commands: &'a [(String, String)],
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
        search: Option<Found>,
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
            swaps,
            variant_commands: &page.commands.variant,
        }
    }

    /// As text inside a script element: no `<`, so that nothing can end the element or begin a comment, and none of the
    /// line ends that JSON allows and scripts do not.
    pub(super) fn script(&self) -> String {
        escaped(&serde_json::to_string(self).expect("keys are text and numbers finite"))
    }
}

fn escaped(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    // These characters stand in strings only, where an escape means the same.
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                out.push_str(&format!("\\u{:04x}", u32::from(c)));
            }
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
            external: s.external.as_ref().map(|e| e.redundant),
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

/// A number; whole ones without a `.0`, and null where it is none.
#[derive(Clone, Copy)]
pub(super) struct Number(f64);

impl Number {
    /// To five significant digits.
    pub(super) fn measured(x: f64) -> Number {
        Number(format!("{x:.4e}").parse().unwrap_or(f64::NAN))
    }

    /// A cost in thousandths.
    #[allow(clippy::cast_precision_loss, reason = "costs are small")]
    pub(super) fn cost(milli: i64) -> Number {
        Number(milli as f64 / 1000.0)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[allow(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
        if self.0.fract() == 0.0 && self.0.abs() < 1e15 {
            to.serialize_i64(self.0 as i64)
        } else {
            to.serialize_f64(self.0)
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

    #[test]
    fn numbers_are_short() {
        let of = |x| serde_json::to_string(&Number::measured(x)).unwrap();
        assert_eq!(of(2.0), "2");
        assert_eq!(of(0.022_345_678), "0.022346");
        assert_eq!(of(f64::NAN), "null");
        assert_eq!(
            serde_json::to_string(&Number::cost(12_500)).unwrap(),
            "12.5"
        );
    }
}
