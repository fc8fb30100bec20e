//! Mechanisms of known mobility: those built in, state by state, and others from a seed.

use super::change::Noise;
use super::lattice::{Scene, make_ladder, make_lift, toggle_row};
use super::special::SpecialKind;
use super::{BuiltIn, Truth};
use crate::file::problem::ImportError;
use crate::file::text::mechanism_from_str;
use crate::model::mechanism::{Mechanism, StateId};

/// A state of a mechanism with its true figures.
#[derive(Debug, Clone)]
pub struct Case {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The state.
    pub state: StateId,
    /// The figures that the catalogue states.
    pub truth: Truth,
}

impl Case {
    /// Returns the mechanism's name, with the state's name unless that is the free one.
    pub fn name(&self) -> String {
        match self.state {
            StateId::FREE => self.mechanism.name.clone(),
            s => format!("{}, {}", self.mechanism.name, self.mechanism.states[s]),
        }
    }
}

/// Returns every state of a built-in mechanism whose mobilities the catalogue states, by name.
///
/// # Errors
/// Returns an error if a built-in file is not valid.
pub fn built_in_cases(built_in: BuiltIn<'_>) -> Result<Vec<Case>, ImportError> {
    let mut cases = Vec::new();
    for (name, text) in built_in {
        let mechanism = mechanism_from_str(&format!("{name}.toml"), text)?;
        for (state, named) in mechanism.states_with_ids() {
            let stated = mechanism.expected.iter().find(|e| e.state == *named);
            let Some((Some(instantaneous), Some(finite))) =
                stated.map(|e| (e.mobility, e.finite_mobility))
            else {
                continue;
            };
            cases.push(Case {
                mechanism: mechanism.clone(),
                state,
                truth: Truth::new(instantaneous, finite),
            });
        }
    }
    Ok(cases)
}

/// Returns mechanisms from a seed, for which no method was made. Special geometry is turned and written with six decimals, either
/// exact or with one joint displaced by a thousand units of the last decimal. The others are rows of toggles, planar ladders and
/// scissor lifts.
///
/// # Panics
/// Never: the texts are valid.
pub fn generated_cases(seed: u64) -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |mut mechanism: Mechanism, name: String, truth: Truth| {
        mechanism.edit().name = name;
        cases.push(Case {
            mechanism,
            state: StateId::FREE,
            truth,
        });
    };
    let read =
        |text: &str| mechanism_from_str("made.toml", text).expect("a generated file is valid");
    for (k, kind) in SpecialKind::ALL.into_iter().enumerate() {
        for (i, units) in [0.0, 1000.0].into_iter().cycle().take(6).enumerate() {
            let text = kind.text(units, 6, true, &mut Noise::new(seed, 100 * k + i));
            let name = format!("{} {}", kind.name(), i + 1);
            add(read(&text), name, kind.true_figures(units > 0.0));
        }
    }
    for levels in 1..=3 {
        let text = toggle_row(levels, &mut Noise::new(seed, levels));
        add(read(&text), format!("toggles {levels}"), Truth::new(1, 0));
        let ladder = make_ladder(Scene::Plane, levels, &mut Noise::new(seed, levels));
        add(ladder, format!("planar ladder {levels}"), Truth::new(1, 1));
        add(
            make_lift(levels),
            format!("scissor lift {levels}"),
            Truth::new(1, 1),
        );
    }
    cases
}
