//! The orders in which both diagrams take the variables.

use crate::model::mechanism::StateId;
use crate::search::order::variable_order;
use crate::search::question::Question;
use crate::search::question::space::Variable;
use crate::search::reduce::biconnected::Block;

/// The orders in which diagrams take the variables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Orders {
    /// That of the diagram of determinate variants.
    pub determinate: Vec<usize>,
    /// That of the diagram of admissible variants: variables that the free state and the searched one have in common come first.
    pub admissible: Vec<usize>,
}

/// Finds the orders of both diagrams; they do not depend on the prime, and a twin over another may be given them.
#[must_use]
pub(crate) fn orders(question: &Question) -> Orders {
    let nothing_is_built = is_none_possible(question);
    let order = |blocks: &[Block], state: StateId| -> Vec<usize> {
        if nothing_is_built {
            return blocks.iter().flat_map(|b| b.variables.clone()).collect();
        }
        variable_order(question, blocks, state)
    };
    let variables = &question.space.variables;
    let those = |wanted: fn(&Variable) -> bool| {
        let all = 0..variables.len();
        all.filter(move |&v| wanted(&variables[v]))
    };
    let [determinate, common] = &question.blocks;
    let mut determinate = order(determinate, StateId::FREE);
    determinate.extend(those(|v| v.external));
    if one_diagram(question) {
        let admissible = determinate.clone();
        return Orders {
            determinate,
            admissible,
        };
    }
    let state = question.conditions.state.map_or(StateId::FREE, |s| s.state);
    let mut admissible = order(common, state);
    admissible.extend(those(|v| v.alone).chain(those(|v| v.external)));
    Orders {
        determinate,
        admissible,
    }
}

/// Whether every variant has more redundant constraints than are allowed, in rows that no choice changes.
pub(in crate::search) fn is_none_possible(question: &Question) -> bool {
    question.model.already > question.conditions.max_redundant
}

/// Whether nothing is asked of variants but what makes them determinate.
pub(in crate::search) fn one_diagram(question: &Question) -> bool {
    !question.conditions.keep_output && question.conditions.state.is_none()
}
