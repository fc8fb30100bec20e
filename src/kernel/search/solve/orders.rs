//! The orders in which both diagrams take the variables.

use crate::closure::contour::contour_basis;
use crate::linalg::echelon::Echelon;
use crate::search::order::variable_order;
use crate::search::question::Question;
use crate::search::question::space::Variable;
use crate::search::reduce::biconnected::Block;
use crate::search::reduce::self_stress_space::ClosingRows;

/// The orders in which diagrams take the variables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Orders {
    /// That of the diagram of determinate variants.
    pub determinate: Vec<usize>,
    /// That of the diagram of admissible variants: variables that the free state and the searched one have in common come first.
    pub admissible: Vec<usize>,
}

/// Returns the orders of both diagrams. They do not depend on the prime, and a twin over another prime may be given them.
#[must_use]
pub(crate) fn variable_orders(question: &Question) -> Orders {
    let (mechanism, dim) = (&question.mechanism, question.space.dim);
    let free = |kept| ClosingRows::for_free_state(mechanism, dim, &question.contours, kept);
    let nothing_is_built = is_none_possible(question, &free(None));
    let order = |blocks: &[Block], rows: &ClosingRows<'_>, later: &[usize]| -> Vec<usize> {
        if nothing_is_built {
            return blocks.iter().flat_map(|b| b.variables.clone()).collect();
        }
        variable_order(question, blocks, rows, later)
    };
    let variables = &question.space.variables;
    let those = |wanted: fn(&Variable) -> bool| -> Vec<usize> {
        let all = 0..variables.len();
        all.filter(|&v| wanted(&variables[v])).collect()
    };
    let [blocks, common] = &question.blocks;
    let external = those(|v| v.external);
    let mut determinate = order(blocks, &free(None), &[]);
    determinate.extend(&external);
    if one_diagram(question) {
        return Orders {
            admissible: determinate.clone(),
            determinate,
        };
    }
    let kept = question.conditions.keep_output.then_some(&question.kept);
    let mut admissible = match question.conditions.state {
        Some(searched) if !question.state_joins_kept_links() => {
            let contours = contour_basis(mechanism, searched.state);
            let none = Vec::new();
            let rows = ClosingRows::in_state(mechanism, dim, searched.state, &contours, none);
            order(common, &rows, &external)
        }
        _ => order(common, &free(kept), &[]),
    };
    admissible.extend(those(|v| v.alone));
    admissible.extend(external);
    Orders {
        determinate,
        admissible,
    }
}

/// Returns whether every variant has more redundant constraints than are allowed, since all choices together leave as many.
fn is_none_possible(question: &Question, rows: &ClosingRows<'_>) -> bool {
    let free = question.space.variables.iter().filter(|v| !v.external);
    let columns = free.flat_map(|v| {
        let choices = 0..v.choices.len();
        choices.flat_map(|c| rows.choice_columns(question.exact.field(), v, c))
    });
    let rank = Echelon::from_vectors(question.exact.field(), columns).rank();
    rows.count_closing() - rank > question.conditions.max_redundant as usize
}

/// Returns true if the question sets no conditions except determinacy.
pub(in crate::search) fn one_diagram(question: &Question) -> bool {
    !question.conditions.keep_output && question.conditions.state.is_none()
}
