//! Choices of a joint grown from one another: what allows more motion starts from what allows less.
//!
//! Most options contain others: a universal joint the hinge, a ball the universal joint. A node is carried over the joint
//! once for each, and the rows of the smaller choice are those of the larger but for a twist or two.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::stage::Stage;
use crate::search::diagram::state_copies::Lane;
use crate::search::question::space::Space;

/// A choice as an earlier one and some twists more.
#[derive(Debug, Clone)]
pub(in crate::search) struct Grown {
    /// The choice.
    pub(in crate::search) choice: usize,
    /// The choice it contains, which comes before it in the list; none for the bare node.
    pub(in crate::search) from: Option<usize>,
    /// The twists that it adds, as rows under the stage's step.
    pub(in crate::search) more: Vec<Vec<Residue>>,
}

/// The choices of a stage, smaller ones first, each with the largest one before it that it contains; nothing for a stage
/// with more than one joint, or of another lane than all choices have alike.
///
/// # Complexity
/// O(c²) eliminations of six by six numbers for c choices.
pub(in crate::search) fn grown(field: Field, space: &Space, stage: &Stage) -> Vec<Grown> {
    let [only] = &stage.moves[..] else {
        return Vec::new();
    };
    if matches!(only.lane, Lane::Friction(_)) {
        return Vec::new();
    }
    let choices = space.variables[stage.variable].choices.iter();
    let spans: Vec<_> = choices.map(|c| &c.spans[only.member][..]).collect();
    let image = |t: &Vec<Residue>| {
        let mut row = Vec::new();
        only.step.image(field, space.dim, t, &mut row);
        row
    };
    let mut out = one_from_another(field, &spans);
    let rows = out.iter_mut().flat_map(|g| &mut g.more);
    rows.for_each(|t| *t = image(t));
    out
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
