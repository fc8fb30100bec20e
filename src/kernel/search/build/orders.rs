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
pub fn orders(question: &Question) -> Orders {
    let order = |blocks: &[Block]| {
        variable_order(
            &question.exact,
            &question.mechanism,
            &question.least.whole.space,
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

/// Whether nothing is asked of variants but what makes them determinate.
pub(in crate::search) fn one_diagram(question: &Question) -> bool {
    !question.conditions.keep_output && question.conditions.state.is_none()
}
