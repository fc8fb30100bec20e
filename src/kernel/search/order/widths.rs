//! How many coordinates are open behind each variable of an order, which says how large its layers are.
//!
//! The variables so far and those to come add vectors that span a common space, and a node says which part of it the choices fill. Its
//! dimension is r(S) + r(T) - r for the ranks of the vectors S of the variables so far, T of those to come, and of all. In the dual
//! matroid, whose vectors are the relations of all, r(T) = r - |S| + r*(S). So both ranks grow with S vector by vector.
//!
//! Coordinates of contours decide. Those of kept links break ties.
//!
//! # Sources
//! Oxley, "Matroid Theory" (2011), section 2.1, for the rank of the dual; connectivity of a set and its complement: Oum & Seymour,
//! "Approximating clique-width and branch-width", J. Combin. Theory B 96 (2006).

use crate::linalg::echelon::{Echelon, linear_relations};
use crate::linalg::modp::{Field, Residue};
use crate::search::question::space::Space;
use crate::search::reduce::self_stress_space::ClosingRows;
use std::collections::BTreeMap;

/// A vector that a variable adds to the original joints, and its part in the relations of all that is added.
type Pair = [Vec<Residue>; 2];

/// The vectors that each variable of a block adds: in the rows of contours, and in these and the rows of kept links if there are any.
pub(in crate::search) struct Widths {
    field: Field,
    vectors: Vec<BTreeMap<usize, Vec<Pair>>>,
}

/// The dimension that the variables so far and those to come have in common.
#[derive(Clone)]
struct Width {
    /// The span of the vectors so far, and of their parts in the relations.
    spans: [Echelon; 2],
    vectors: usize,
}

/// An order, as far as it has come.
#[derive(Clone)]
pub(in crate::search) struct Trial {
    /// The variables so far.
    pub(in crate::search) order: Vec<usize>,
    /// The work so far, summed over the variables: 4 to the power of the open coordinates of contours, then the open coordinates of both
    /// kinds.
    pub(in crate::search) work: [u64; 2],
    widths: Vec<Width>,
}

impl Widths {
    /// Returns the widths of orders of a block's variables. Variables in `later` come after them.
    ///
    /// # Complexity
    /// Two eliminations of all vectors that the choices add.
    pub(in crate::search) fn new(
        field: Field,
        space: &Space,
        rows: &ClosingRows<'_>,
        variables: &[usize],
        later: &[usize],
    ) -> Widths {
        let all = [variables, later].concat();
        let of_rows = |rows_in_use: usize| added_vectors(field, space, rows, &all, rows_in_use);
        let closing = rows.count_closing();
        let mut rows_in_use = vec![closing, closing + rows.count_kept()];
        rows_in_use.dedup();
        Widths {
            field,
            vectors: rows_in_use.into_iter().map(of_rows).collect(),
        }
    }

    /// Returns the order of no variable yet.
    pub(in crate::search) fn empty_trial(&self) -> Trial {
        let width = |_| Width {
            spans: [Echelon::new(self.field), Echelon::new(self.field)],
            vectors: 0,
        };
        Trial {
            order: Vec::new(),
            work: [0; 2],
            widths: self.vectors.iter().map(width).collect(),
        }
    }

    /// Adds a variable to an order.
    pub(in crate::search) fn add_variable(&self, trial: &mut Trial, variable: usize) {
        for (width, vectors) in trial.widths.iter_mut().zip(&self.vectors) {
            for pair in vectors.get(&variable).into_iter().flatten() {
                for (span, vector) in width.spans.iter_mut().zip(pair) {
                    span.insert(vector);
                }
                width.vectors += 1;
            }
        }
        let open = |w: &Width| w.spans[0].rank() + w.spans[1].rank() - w.vectors;
        let [of_contours, all] =
            [trial.widths.first(), trial.widths.last()].map(|w| w.map_or(0, open));
        let nodes = 1u64 << (2 * of_contours.min(31));
        trial.work[0] = trial.work[0].saturating_add(nodes);
        trial.work[1] += all as u64;
        trial.order.push(variable);
    }
}

/// Returns the independent vectors that each variable adds to the original joints in the first rows.
fn added_vectors(
    field: Field,
    space: &Space,
    rows: &ClosingRows<'_>,
    variables: &[usize],
    rows_in_use: usize,
) -> BTreeMap<usize, Vec<Pair>> {
    let columns = |v: usize, c: usize| {
        let mut columns = rows.choice_columns(field, &space.variables[v], c);
        columns.iter_mut().for_each(|c| c.truncate(rows_in_use));
        columns
    };
    let original = Echelon::from_vectors(field, variables.iter().flat_map(|&v| columns(v, 0)));
    let (mut of_variable, mut all) = (Vec::new(), Vec::new());
    for &v in variables {
        let mut own = Echelon::new(field);
        for mut column in (1..space.variables[v].choices.len()).flat_map(|c| columns(v, c)) {
            original.reduce_vector(&mut column);
            if own.insert(&column) {
                of_variable.push(v);
                all.push(column);
            }
        }
    }
    let relations = linear_relations(field, &all);
    let mut vectors: BTreeMap<usize, Vec<Pair>> = BTreeMap::new();
    for (i, (v, vector)) in of_variable.into_iter().zip(all).enumerate() {
        let dual = relations.iter().map(|r| r[i]).collect();
        vectors.entry(v).or_default().push([vector, dual]);
    }
    vectors
}
