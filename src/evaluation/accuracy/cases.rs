//! The built-in mechanisms of known mobility, state by state.

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
    /// The mechanism's name, with the state's where it is not the free one.
    #[must_use]
    pub fn name(&self) -> String {
        match self.state {
            StateId::FREE => self.mechanism.name.clone(),
            s => format!("{}, {}", self.mechanism.name, self.mechanism.states[s]),
        }
    }
}

/// Every state of a built-in mechanism whose mobilities the catalogue states, by name.
///
/// # Errors
/// Where a built-in file is not valid.
pub fn cases(built_in: BuiltIn<'_>) -> Result<Vec<Case>, ImportError> {
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
                truth: Truth {
                    instantaneous,
                    finite,
                },
            });
        }
    }
    Ok(cases)
}
