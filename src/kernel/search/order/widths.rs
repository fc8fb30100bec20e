//! How many coordinates are open behind each variable of an order, which says how large its layers are.
//!
//! What the variables so far add and what those to come add have a space in common: a node tells which part of it the choices fill.
//! Its dimension is r(S) + r(T) - r for the ranks of the vectors S of the variables so far, T of those to come, and of all. In the dual
//! matroid, whose vectors are the relations of all, r(T) = r - |S| + r*(S), so both ranks grow with S vector by vector.
//!
//! # Sources
//! Oxley, "Matroid Theory" (2011), section 2.1, for the rank of the dual; connectivity of a set and its complement: Oum & Seymour,
//! "Approximating clique-width and branch-width", J. Combin. Theory B 96 (2006).

use crate::closure::contour::contour_basis;
use crate::linalg::echelon::{Echelon, relations};
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::StateId;
use crate::search::question::Question;
use crate::search::reduce::self_stress_space::ClosingRows;
use std::collections::BTreeMap;

/// What each variable of a block adds to the present joints, and its part in the relations of all that is added.
pub(in crate::search) struct Widths {
    field: Field,
    vectors: BTreeMap<usize, Vec<[Vec<Residue>; 2]>>,
}

/// An order, as far as it has come.
#[derive(Clone)]
pub(in crate::search) struct Trial {
    /// The variables so far.
    pub(in crate::search) order: Vec<usize>,
    /// The work so far: 4 for each open coordinate, multiplied, for each variable.
    pub(in crate::search) work: u64,
    /// The span of the vectors so far, and of their parts in the relations.
    spans: [Echelon; 2],
    vectors: usize,
}

impl Widths {
    /// Returns the widths of orders of a block's variables in a state; what the state adds comes after them.
    ///
    /// # Complexity
    /// One elimination of all vectors that the choices add.
    pub(in crate::search) fn new(
        question: &Question,
        variables: &[usize],
        state: StateId,
    ) -> Widths {
        let (field, space) = (question.exact.field(), &question.model.space);
        let contours = contour_basis(&question.mechanism, state);
        let none = Vec::new();
        let rows = ClosingRows::in_state(&question.mechanism, space.dim, state, &contours, none);
        let columns = |v: usize, c: usize| rows.columns(field, &space.variables[v], c);
        let added = (0..space.variables.len())
            .filter(|&v| state != StateId::FREE && space.variables[v].external);
        let variables: Vec<usize> = variables.iter().copied().chain(added).collect();
        let present = Echelon::of(field, variables.iter().flat_map(|&v| columns(v, 0)));
        let mut all: Vec<Vec<Residue>> = Vec::new();
        let mut of_variable = Vec::new();
        for &v in &variables {
            let mut own = Echelon::new(field);
            for c in 1..space.variables[v].choices.len() {
                for mut column in columns(v, c) {
                    present.reduce(&mut column);
                    if own.insert(&column) {
                        of_variable.push(v);
                        all.push(column);
                    }
                }
            }
        }
        let relations = relations(field, &all);
        let mut vectors: BTreeMap<usize, Vec<[Vec<Residue>; 2]>> = BTreeMap::new();
        for (i, (v, vector)) in of_variable.into_iter().zip(all).enumerate() {
            let dual = relations.iter().map(|r| r[i]).collect();
            vectors.entry(v).or_default().push([vector, dual]);
        }
        Widths { field, vectors }
    }

    /// Returns the order of no variable yet.
    pub(in crate::search) fn start(&self) -> Trial {
        Trial {
            order: Vec::new(),
            work: 0,
            spans: [Echelon::new(self.field), Echelon::new(self.field)],
            vectors: 0,
        }
    }

    /// Adds a variable to an order.
    pub(in crate::search) fn add(&self, trial: &mut Trial, variable: usize) {
        for pair in self.vectors.get(&variable).into_iter().flatten() {
            for (span, vector) in trial.spans.iter_mut().zip(pair) {
                span.insert(vector);
            }
            trial.vectors += 1;
        }
        let open = trial.spans[0].rank() + trial.spans[1].rank() - trial.vectors;
        let width = 1u64.checked_shl(2 * u32::try_from(open).unwrap_or(u32::MAX).min(31));
        trial.work = trial.work.saturating_add(width.unwrap_or(u64::MAX));
        trial.order.push(variable);
    }
}
