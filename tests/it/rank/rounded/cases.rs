//! Mechanisms of known mobility: those built in, and those of `tests/data/mobility.jsonl`.

use crate::common::*;
use ozols::model::mechanism::Expected;

/// A state of a mechanism with its figures.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) mechanism: Mechanism,
    pub(crate) state: StateId,
    /// W in the pose of the file.
    pub(crate) mobility: i64,
    /// W of the motion that is there.
    pub(crate) finite: i64,
}

/// Returns a case for each state of which a mechanism file says the figures.
fn cases_of(file: &str, text: &str, name: impl Fn(&Mechanism, &str) -> String) -> Vec<Case> {
    let mechanism = mechanism_from_str(file, text).unwrap();
    let case = |e: &Expected| Case {
        name: name(&mechanism, &e.state),
        state: mechanism.state_named(&e.state).unwrap(),
        mechanism: mechanism.clone(),
        mobility: e.mobility.unwrap(),
        finite: e.finite_mobility.unwrap(),
    };
    mechanism.expected.iter().map(case).collect()
}

pub(crate) fn cases() -> Vec<Case> {
    let built_in = builtin::names().into_iter().flat_map(|name| {
        let text = builtin::text(name).unwrap();
        cases_of("x.toml", text, |_, state| format!("{name}, {state}"))
    });
    let known = read_data("mobility.jsonl");
    let further = known
        .lines()
        .flat_map(|line| cases_of("x.json", line, |m, _| m.name.clone()));
    built_in.chain(further).collect()
}
