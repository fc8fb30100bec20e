//! The orders in which both diagrams take the variables.

use crate::search::order::variable_order;
use crate::search::question::Question;
use crate::search::reduce::biconnected::Block;

/// The orders in which diagrams take the variables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Orders {
    /// Those of the free state, for the determinate variants.
    pub determinate: Vec<usize>,
    /// Those that the free state and the searched one have in common, for the admissible variants.
    pub common: Vec<usize>,
}

/// Finds the orders of both diagrams; they do not depend on the prime, and a twin over another may be given them.
#[must_use]
pub(crate) fn orders(question: &Question) -> Orders {
    let nothing_is_built = is_none_possible(question);
    let order = |blocks: &[Block]| {
        if nothing_is_built {
            return blocks.iter().flat_map(|b| b.variables.clone()).collect();
        }
        variable_order(
            &question.exact,
            &question.mechanism,
            &question.model.space,
            blocks,
            question.conditions.max_redundant,
        )
    };
    let [determinate, common] = &question.blocks;
    let determinate = order(determinate);
    let common = if one_diagram(question) {
        determinate.clone()
    } else {
        order(common)
    };
    Orders {
        determinate,
        common,
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
