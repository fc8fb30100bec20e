//! The drawings of each state, and every symbol that a variant may put into them.

use super::Page;
use crate::draw::swap::{Swap, kinematic_with, scheme_with};
use crate::draw::{Drawing, Subject};
use crate::model::mechanism::{JointId, StateId};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The drawings of a state, with the symbols of [`places`] in that order.
pub(super) struct Drawn<'a> {
    pub(super) scheme: Drawing,
    pub(super) kinematic: Drawing,
    places: Vec<(usize, usize, Swap<'a>)>,
    symbols: [Vec<String>; 2],
}

/// Each joint of a state with each choice but the present one: the variable, the choice, and what it puts there.
fn places<'a>(page: &'a Page<'_>, state: StateId) -> Vec<(usize, usize, Swap<'a>)> {
    let Ok(r) = &page.redesigns else {
        return Vec::new();
    };
    let search = r.found.search;
    let there: Vec<JointId> = page.mechanism.joints_in(state).collect();
    let mut out = Vec::new();
    for (v, variable) in search.space.variables.iter().enumerate() {
        for (c, choice) in variable.choices.iter().enumerate().skip(1) {
            for &joint in variable.joints.iter().filter(|j| there.contains(j)) {
                let Some(option) = page.mechanism.joints[joint].options.get(choice.option) else {
                    continue;
                };
                let unloading = choice.unloading.is_some();
                let swap = Swap {
                    joint,
                    option,
                    unloading,
                };
                out.push((v, c, swap));
            }
        }
    }
    out
}

impl<'a> Drawn<'a> {
    pub(super) fn new(page: &'a Page<'_>, state: StateId) -> Drawn<'a> {
        let subject = Subject {
            mechanism: page.mechanism,
            state,
            analysis: page.states.get(state.index()),
            marks: None,
        };
        let places = places(page, state);
        let swaps: Vec<Swap<'_>> = places.iter().map(|p| p.2).collect();
        let (scheme, in_scheme) = scheme_with(&subject, &swaps);
        let (kinematic, in_kinematic) = kinematic_with(&subject, &swaps);
        Drawn {
            scheme,
            kinematic,
            places,
            symbols: [in_scheme, in_kinematic],
        }
    }
}

/// The symbols as groups of an SVG that is not shown, each once, and where they belong: by state and kind of drawing,
/// rows of variable, choice, joint and number of the symbol.
pub(super) fn store(page: &Page<'_>, drawn: &[Drawn<'_>]) -> (String, Value) {
    let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
    let mut store = String::new();
    let mut states = Vec::new();
    for d in drawn {
        let mut kinds = Vec::new();
        for symbols in &d.symbols {
            let mut rows = Vec::new();
            for ((v, c, swap), symbol) in d.places.iter().zip(symbols) {
                let next = numbers.len();
                let number = *numbers.entry(symbol).or_insert_with(|| {
                    store += &format!("<g data-symbol=\"{next}\">\n{symbol}</g>\n");
                    next
                });
                rows.push(json!([v, c, swap.joint, number]));
            }
            kinds.push(rows);
        }
        states.push(json!({"scheme": kinds[0], "kinematic": kinds[1]}));
    }
    debug_assert_eq!(states.len(), page.mechanism.states.len());
    (store, json!(states))
}
