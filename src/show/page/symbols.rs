//! The drawings of each state, and every symbol that a variant may put into them.

use super::contents::Page;
use crate::draw::{Drawing, Subject, Swap, kinematic_with, scheme_with};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::score::outcome::Outcome;
use crate::search::question::space::choice_name;
use maud::{Markup, PreEscaped, html};
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
fn places<'a>(m: &'a Mechanism, found: &Outcome, state: StateId) -> Vec<(usize, usize, Swap<'a>)> {
    let there: Vec<JointId> = m.joints_in(state).collect();
    let mut out = Vec::new();
    for (v, variable) in found.search.space.variables.iter().enumerate() {
        for (c, choice) in variable.choices.iter().enumerate().skip(1) {
            for &joint in variable.joints.iter().filter(|j| there.contains(j)) {
                let Some(option) = m.joints[joint].options.get(choice.option) else {
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

/// What the variants of a search put at the joints of a state, for [`kinematic_scene`](crate::draw::kinematic_scene).
#[must_use]
pub fn swaps<'a>(m: &'a Mechanism, found: &Outcome, state: StateId) -> Vec<Swap<'a>> {
    let all = places(m, found, state).into_iter();
    all.map(|(_, _, swap)| swap).collect()
}

/// The same with the names of joint and choice, as the changes of a variant have them.
#[must_use]
pub fn named_swaps<'a>(
    m: &'a Mechanism,
    found: &Outcome,
    state: StateId,
) -> Vec<(String, String, Swap<'a>)> {
    let all = places(m, found, state).into_iter();
    let named = all.filter_map(|(v, c, swap)| {
        let choice = found.search.space.variables.get(v)?.choices.get(c)?;
        let name = choice_name(&found.search.mechanism, swap.joint, choice);
        Some((m.joints[swap.joint].id.clone(), name, swap))
    });
    named.collect()
}

impl<'a> Drawn<'a> {
    pub(super) fn new(page: &'a Page<'_>, state: StateId) -> Drawn<'a> {
        let subject = Subject {
            mechanism: page.mechanism,
            state,
            analysis: page.states.get(state.index()),
            marks: None,
        };
        let places = match &page.redesigns {
            Ok(r) => places(page.mechanism, r.found, state),
            Err(_) => Vec::new(),
        };
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

/// The symbols as groups of an SVG that is not shown, each once, and where they belong, state by state.
pub(super) fn store(drawn: &[Drawn<'_>]) -> (Markup, Value) {
    let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
    let mut store: Vec<&str> = Vec::new();
    let mut states = Vec::new();
    for d in drawn {
        let [scheme, kinematic] = d.symbols.each_ref().map(|symbols| {
            let rows = d.places.iter().zip(symbols).map(|((v, c, swap), symbol)| {
                let number = *numbers.entry(symbol).or_insert_with(|| {
                    store.push(symbol);
                    store.len() - 1
                });
                [*v, *c, swap.joint.index(), number]
            });
            rows.collect::<Vec<_>>()
        });
        let space = d.places.iter().enumerate();
        let space = space.map(|(n, (v, c, swap))| [*v, *c, swap.joint.index(), n]);
        let space = space.collect::<Vec<_>>();
        states.push(json!({ "scheme": scheme, "kinematic": kinematic, "space": space }));
    }
    let store = html! {
        @for (number, symbol) in store.iter().enumerate() {
            g data-symbol=(number) { (PreEscaped(symbol)) }
        }
    };
    (store, Value::from(states))
}
