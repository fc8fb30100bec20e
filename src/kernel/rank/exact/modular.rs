//! Rank over a prime field, contour by contour.
//!
//! A column of J touches only the contours that its joint is part of, with a block of 6 rows (3 in a plane) in each.
//! The contours are eliminated one at a time, fewest neighbours first. The *front* of a contour is the dense matrix of
//! the columns that touch it, on its own rows and those of its neighbours.
//!
//! Columns of joints that no other contour passes come first. They have entries in the contour's own rows only, a
//! problem of 6 rows. At most 6 columns become pivots and leave. The remainder of the other columns lies in the
//! neighbours' rows and goes to the neighbour that is next in order. It is made independent first if it has more
//! columns than rows, so that nothing piles up along a chain.
//!
//! No residue is inverted, because an inverse modulo a prime of 61 bits takes as long as a hundred products. Columns are
//! combined crosswise, `v ← u_p·v - v_p·u`. This scales them by a nonzero factor and preserves the rank.
//!
//! # Sources
//! Duff & Reid, "The multifrontal solution of indefinite sparse symmetric linear equations", ACM TOMS 9 (1983), applied
//! to rank; Tinney & Walker's minimum-degree order, Proc. IEEE 55 (1967).

use crate::closure::Closure;
use crate::geom::exact::ExactField;
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::elimination_order::EliminationPlan;
use crate::rank::exact::field::closure_of;
use crate::rank::method::{About, Answer, Certainty, MobilityMethod, NoAnswer, RankOfJ};

/// Returns the rank of J over the field. It is exact unless the prime divides a minor.
///
/// # Complexity
/// O(f·d³w³) field operations for f columns, d = 6 rows per contour and fronts of at most w contours. This is linear in
/// the number of contours k for chains, trees and grids of bounded width, for which w is bounded. The order of the
/// contours costs another O(k·w·k/64) operations on words. The total is never more than O(w) times the dense
/// elimination.
#[must_use]
pub fn rank_modulo(exact: &ExactField, closure: &Closure<Residue>) -> usize {
    let plan = EliminationPlan::new(closure);
    let mut work = Work {
        field: exact.field(),
        plan: &plan,
        rest: vec![Rest::default(); plan.order.len()],
        left: Vec::with_capacity(16 * closure.dim),
        front: Vec::with_capacity(closure.columns.len().min(64) * 4 * closure.dim),
        rank: 0,
    };
    for &c in &plan.order {
        work.eliminate_contour(closure, c);
    }
    work.rank
}

/// Remainder of a front: columns on the rows of the contour's neighbours, ascending.
#[derive(Clone, Copy, Default)]
struct Rest {
    /// The first row of this contour in the current front, while it is part of it.
    slot: usize,
    /// Start and end of the columns in `Work::left`.
    columns: (usize, usize),
    /// Another remainder that goes to the front of the same contour.
    sibling: Option<usize>,
    /// The first remainder that the front of this contour takes in.
    child: Option<usize>,
}

struct Work<'a> {
    field: Field,
    plan: &'a EliminationPlan,
    rest: Vec<Rest>,
    /// The columns of all remainders.
    left: Vec<Residue>,
    /// The columns of the current front, one after the other.
    front: Vec<Residue>,
    rank: usize,
}

impl Work<'_> {
    /// Forms the front of a contour, eliminates the pivots of its rows, and passes on the remainder.
    fn eliminate_contour(&mut self, closure: &Closure<Residue>, c: usize) {
        let (plan, dim) = (self.plan, closure.dim);
        self.rest[c].slot = 0;
        let mut height = dim;
        let mut next: Option<usize> = None;
        for n in plan.neighbours[c].ones() {
            self.rest[n].slot = height;
            height += dim;
            if next.is_none_or(|x| plan.place[n] < plan.place[x]) {
                next = Some(n);
            }
        }
        self.front.clear();
        let joints = || {
            let contour = closure.contours.get(c).into_iter();
            let coupling = c.checked_sub(closure.contours.len());
            let coupling = coupling.map(|q| &closure.couplings[q].entries);
            contour
                .flat_map(|contour| contour.joints.iter().map(|&(j, _)| j))
                .chain(
                    coupling
                        .into_iter()
                        .flatten()
                        .map(|(at, _)| closure.columns[*at].joint),
                )
        };
        // Columns with entries in this contour only, then those shared with others.
        for own in [true, false] {
            for j in joints().filter(|&j| (plan.contours_through(j).len() == 1) == own) {
                // A joint enters the front of the first of its contours in the order.
                let first = |&(i, _): &(usize, bool)| plan.place[i] >= plan.place[c];
                if plan.contours_through(j).is_empty()
                    || !plan.contours_through(j).iter().all(first)
                {
                    continue;
                }
                for (index, column) in plan.columns_of_joint(closure, j) {
                    let at = self.front.len();
                    self.front.resize(at + height, 0);
                    for &(i, forward) in plan.contours_through(j) {
                        let block = &mut self.front[at + self.rest[i].slot..][..dim];
                        if let Some(q) = i.checked_sub(closure.contours.len()) {
                            let entries = &closure.couplings[q].entries;
                            let own = entries.iter().find(|(c, _)| *c == index);
                            block[0] = own.map_or(0, |(_, x)| *x);
                            continue;
                        }
                        for (o, &t) in block.iter_mut().zip(&column.twist) {
                            *o = if forward { t } else { self.field.neg(t) };
                        }
                    }
                }
            }
        }
        let mut child = self.rest[c].child;
        while let Some(x) = child {
            let (from, to) = self.rest[x].columns;
            let width = plan.neighbours[x].count_ones(..) * dim;
            for column in self.left[from..to].chunks_exact(width) {
                let at = self.front.len();
                self.front.resize(at + height, 0);
                for (block, n) in column.chunks_exact(dim).zip(plan.neighbours[x].ones()) {
                    self.front[at + self.rest[n].slot..][..dim].copy_from_slice(block);
                }
            }
            child = self.rest[x].sibling;
        }
        self.rank += eliminate_rows(self.field, &mut self.front, height, dim);
        let Some(parent) = next else { return };
        let from = self.left.len();
        for column in self.front.chunks_exact(height) {
            if column[dim..].iter().any(|&x| x != 0) {
                self.left.extend_from_slice(&column[dim..]);
            }
        }
        let width = height - dim;
        if self.left.len() - from > width * width {
            let basis = independent_columns(self.field, &mut self.left[from..], width);
            self.left.truncate(from);
            self.left.extend_from_slice(&basis);
        }
        if self.left.len() > from {
            self.rest[c].columns = (from, self.left.len());
            self.rest[c].sibling = self.rest[parent].child.replace(c);
        }
    }
}

/// Eliminates the first `rows` rows of a list of columns of equal height. Columns that become pivots are set to zero;
/// the others end with zeros in those rows. Returns the number of pivots.
fn eliminate_rows(field: Field, columns: &mut [Residue], height: usize, rows: usize) -> usize {
    let one = field.one();
    let mut found = 0;
    let mut rest = columns;
    while found < rows && rest.len() >= height {
        let (u, later) = rest.split_at_mut(height);
        let ones = u[..rows].iter().position(|&x| x == one);
        if let Some(p) = ones.or_else(|| u[..rows].iter().position(|&x| x != 0)) {
            found += 1;
            // Columns of this contour only are the most common, and end with its rows.
            let end = u.iter().rposition(|&x| x != 0).map_or(0, |e| e + 1);
            for v in later.chunks_exact_mut(height) {
                clear_entry(field, v, &u[..end], p);
            }
            u.fill(0);
        }
        rest = later;
    }
    found
}

/// Clears entry `p` of `v` with the column `u`, which is zero beyond its length.
#[inline]
fn clear_entry(field: Field, v: &mut [Residue], u: &[Residue], p: usize) {
    let (a, b) = (v[p], u[p]);
    if a == 0 {
        return;
    }
    if b == field.one() {
        for (x, &y) in v.iter_mut().zip(u) {
            if y != 0 {
                *x = field.sub(*x, field.mul(a, y));
            }
        }
        return;
    }
    let (near, far) = v.split_at_mut(u.len());
    for (x, &y) in near.iter_mut().zip(u) {
        if *x != 0 || y != 0 {
            *x = field.difference_of_products(b, *x, a, y);
        }
    }
    for x in far.iter_mut().filter(|x| **x != 0) {
        *x = field.mul(b, *x);
    }
}

/// Returns a basis of the span of columns of equal height.
fn independent_columns(field: Field, columns: &mut [Residue], height: usize) -> Vec<Residue> {
    let mut basis = Vec::with_capacity(height * height);
    let mut rest = columns;
    while rest.len() >= height {
        let (u, later) = rest.split_at_mut(height);
        if let Some(p) = u.iter().position(|&x| x != 0) {
            for v in later.chunks_exact_mut(height) {
                clear_entry(field, v, u, p);
            }
            basis.extend_from_slice(u);
        }
        rest = later;
    }
    basis
}

/// [`rank_modulo`] as a method.
#[derive(Debug, Clone, Copy)]
pub struct Modular;

impl MobilityMethod for Modular {
    fn about(&self) -> &'static About {
        &About {
            name: "modular",
            title: "rank modulo a prime",
            help: "Modulo two primes near 2^61; every digit is used exactly as written",
            guarantee: "exact at this pose except for primes that divide a minor; a rank modulo a prime is never too large",
            complexity: "O(k) for chains, trees and grids of bounded width",
            source: "Schwartz 1980 (identities by evaluation); Duff & Reid 1983 (fronts)",
            rank: RankOfJ::Exact,
        }
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let (exact, closure) = closure_of(mechanism, state, 0)?;
        let (freedoms, rank) = (closure.columns.len(), rank_modulo(&exact, &closure));
        Ok(Answer::at_pose(freedoms, rank, Certainty::Exact))
    }
}
