//! Which halves together span the space dual to self-stresses.
//!
//! What the variables of the front half add, within what those of the back half reach, and the other way round, are in the space
//! that both reach. Variants have no redundant constraint where the two together span its coordinates of contours, and keep the motion
//! of kept links where they have nothing in common with the coordinates of these alone.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::build::completing_sets::{Bases, Quotient, Set, completed, none, put};
use crate::search::build::self_stress::{Added, space};
use crate::search::diagram::adding::{Adding, adding};
use crate::search::diagram::layer::Nodes;
use crate::search::diagram::reduced_rows::Rows;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::question::Question;
use crate::search::reduce::plane_split::Model;
use crate::search::reduce::self_stress_space::SelfStressSpace;

/// A question in the space dual to self-stresses, from both ends.
pub(in crate::search) struct Halves<'a> {
    field: Field,
    pub(in crate::search) limits: &'a Limits,
    /// Redundant constraints that every variant has.
    pub(in crate::search) already: u32,
    /// The space for the order of the variables, and for the reverse.
    spaces: [SelfStressSpace; 2],
    /// Where each part starts, and the number of variables at the end.
    starts: Vec<usize>,
    /// The stages of each part, between which nothing is carried on, from the front and from the back.
    pub(in crate::search) parts: Vec<[Vec<Added<'a>>; 2]>,
}

/// The nodes that are reached from one end.
#[derive(Clone, Copy)]
pub(in crate::search) struct Half<'a> {
    pub(in crate::search) nodes: &'a Nodes,
    /// Variables of the part that are behind it.
    pub(in crate::search) taken: usize,
}

impl<'a> Halves<'a> {
    /// Of the variables in an order; none where a choice lacks a motion of its present joint, or where it is not the case that
    /// just the redundant constraints are allowed which all variants have.
    pub(in crate::search) fn new(
        question: &Question,
        model: &Model,
        order: &[usize],
        limits: &'a Limits,
        keep_output: bool,
    ) -> Option<Self> {
        let field = question.exact.field();
        let front = space(question, model, order, keep_output)?;
        let already = limits.already.saturating_add(front.lasting);
        if already != limits.internal {
            return None;
        }
        let reversed: Vec<usize> = order.iter().rev().copied().collect();
        let orders = [order, &reversed];
        let spaces = [front, space(question, model, &reversed, keep_output)?];
        let all = order.len();
        let shared = |t: &usize| shared(&spaces, *t, all - t);
        let mut starts: Vec<usize> = (0..all).filter(|t| shared(t) == 0).collect();
        starts.push(all);
        let stages = [0, 1].map(|end| adding(field, orders[end], &spaces[end]));
        let parts = starts.windows(2).map(|at| {
            let ranges = [at[0]..at[1], all - at[1]..all - at[0]];
            [0, 1].map(|end| {
                let part = stages[end][ranges[end].clone()].iter().cloned();
                // Halves meet in what the kept links do, however wrong.
                let added = part.map(|stage| {
                    let collapse = None;
                    Added::new(field, Adding { collapse, ..stage }, limits)
                });
                added.collect()
            })
        });
        let parts = parts.collect();
        Some(Halves {
            field,
            limits,
            already,
            spaces,
            starts,
            parts,
        })
    }

    /// For each node of the front half of a part, which nodes of the back half complete it; none where it is cancelled. `told` hears of
    /// how many that is known.
    ///
    /// # Complexity
    /// O(n·m·s³) field operations for n and m nodes and s self-stresses that both reach.
    pub(in crate::search) fn join(
        &self,
        part: usize,
        [one, two]: [Half<'_>; 2],
        cancelled: &(dyn Fn() -> bool + Sync),
        told: &mut dyn FnMut(usize),
    ) -> Option<Vec<Set>> {
        let [front, back] = &self.spaces;
        let all = *self.starts.last()?;
        let at = self.starts[part] + one.taken;
        let of_back = all - self.starts[part + 1] + two.taken;
        let contours = front.contours[at];
        let own = |half: Half<'_>, node: usize, space: &SelfStressSpace, at: usize| {
            let mut rows = Rows::default();
            let width = space.contours[at] + space.kept;
            rows.unpack(self.field, width, half.nodes.matrix(node));
            rows
        };
        let ones = |node: usize| -> Vec<Vec<Residue>> {
            let rows = own(one, node, front, at);
            rows.rows().map(<[Residue]>::to_vec).collect()
        };
        let twos = |node: usize| -> Vec<Vec<Residue>> {
            let rows = own(two, node, back, of_back);
            let same = |row| front.own(at, &back.shared(of_back, row));
            rows.rows().map(same).collect()
        };
        // The coordinates of contours that tell apart what is in the space that both reach.
        let dimension = shared(&self.spaces, at, of_back);
        let of_one = (0..one.nodes.len()).flat_map(ones);
        let of_two = (0..two.nodes.len()).flat_map(twos);
        let both = spanned(self.field, of_one.chain(of_two), contours, dimension);
        if both.rank() < dimension {
            return Some(vec![none(two.nodes.len()); one.nodes.len()]);
        }
        let mut columns = both.pivots();
        columns.sort_unstable();
        columns.extend(contours..contours + front.kept);
        let within = |rows: Vec<Vec<Residue>>| -> Vec<Vec<Residue>> {
            let of = |row: Vec<Residue>| columns.iter().map(|&i| row[i]).collect();
            rows.into_iter().map(of).collect()
        };
        let second = (0..two.nodes.len()).map(|node| within(twos(node)));
        let second = Bases::new(self.field, second);
        let completing = |node: usize| {
            let whole = Quotient::new(self.field, within(ones(node)), columns.len());
            let missing = dimension - whole.rows.len();
            let mut out = none(two.nodes.len());
            second.ranks(&whole.images(&second), missing, missing, |other, rank| {
                if rank == Some(missing) {
                    put(&mut out, other);
                }
            });
            out
        };
        completed(one.nodes.len(), completing, cancelled, told)
    }
}

/// What the coordinates of contours of some rows span, as far as a dimension that they cannot exceed.
fn spanned(
    field: Field,
    rows: impl Iterator<Item = Vec<Residue>>,
    contours: usize,
    dimension: usize,
) -> Echelon {
    let mut span = Echelon::new(field);
    for row in rows {
        if span.rank() == dimension {
            break;
        }
        span.insert(&row[..contours]);
    }
    span
}

/// Dimension of the space of contours that both the first variables and the others reach, after so many of the front and of the back.
fn shared([front, back]: &[SelfStressSpace; 2], taken: usize, of_back: usize) -> usize {
    front.contours[taken] + back.contours[of_back] - front.contours[0]
}
