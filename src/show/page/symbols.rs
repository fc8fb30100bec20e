//! Every joint that a variant may put into the drawings of a state.

use crate::draw::Swap;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::score::outcome::Outcome;
use crate::search::question::space::choice_name;

/// Returns each joint of a state with each choice except the original one: the variable, the choice, and the new joint.
pub(super) fn swap_places<'a>(
    m: &'a Mechanism,
    found: &Outcome,
    state: StateId,
) -> Vec<(usize, usize, Swap<'a>)> {
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

/// Returns what the variants of a search put at the joints of a state, for
/// [`kinematic_scene`](crate::draw::kinematic_scene).
#[must_use]
pub fn state_swaps<'a>(m: &'a Mechanism, found: &Outcome, state: StateId) -> Vec<Swap<'a>> {
    let all = swap_places(m, found, state).into_iter();
    all.map(|(_, _, swap)| swap).collect()
}

/// Returns the same with the names of joint and choice, as the changes of a variant have them.
#[must_use]
pub fn named_swaps<'a>(
    m: &'a Mechanism,
    found: &Outcome,
    state: StateId,
) -> Vec<(String, String, Swap<'a>)> {
    let all = swap_places(m, found, state).into_iter();
    let named = all.filter_map(|(v, c, swap)| {
        let choice = found.search.space.variables.get(v)?.choices.get(c)?;
        let name = choice_name(&found.search.mechanism, swap.joint, choice);
        Some((m.joints[swap.joint].id.clone(), name, swap))
    });
    named.collect()
}
