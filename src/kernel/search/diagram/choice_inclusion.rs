//! Choices of a joint grown from one another: what allows more motion starts from what allows less.
//!
//! Most options contain others: a universal joint the hinge, a ball the universal joint. A node is carried over the joint
//! once for each, and the rows of the smaller choice are those of the larger but for a twist or two.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};

/// A choice as an earlier one and some twists more.
#[derive(Debug, Clone)]
pub(in crate::search) struct Grown {
    /// The choice.
    pub(in crate::search) choice: usize,
    /// The choice it contains, which comes before it in the list; none for the bare node.
    pub(in crate::search) from: Option<usize>,
    /// The vectors that it adds.
    pub(in crate::search) more: Vec<Vec<Residue>>,
}

/// Spans, smaller ones first, each with the largest one before it that it contains, and its own vectors that this has not.
pub(in crate::search) fn one_from_another(field: Field, spans: &[&[Vec<Residue>]]) -> Vec<Grown> {
    let mut order: Vec<usize> = (0..spans.len()).collect();
    order.sort_by_key(|&c| spans[c].len());
    let mut out: Vec<Grown> = Vec::with_capacity(spans.len());
    for (i, &choice) in order.iter().enumerate() {
        let whole = Echelon::of(field, spans[choice]);
        let contained = |c: &&usize| spans[**c].iter().all(|t| whole.contains(t));
        let from = order[..i].iter().rev().find(contained).copied();
        let mut known = Echelon::of(field, from.into_iter().flat_map(|c| spans[c]));
        let new = spans[choice].iter().filter(|t| known.insert(t));
        out.push(Grown {
            choice,
            from,
            more: new.cloned().collect(),
        });
    }
    out
}
