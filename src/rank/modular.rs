//! Rank over a prime field, contour by contour.
//!
//! A column of J touches only the contours that its joint is part of, with a block of 6 rows (3 in a plane) in each. The
//! contours are eliminated one at a time, fewest neighbours first. The *front* of a contour is the dense matrix of the
//! columns that touch it, on its own rows and those of its neighbours. Columns of joints that no other contour passes
//! come first: they have entries in the contour's own rows only, a problem of 6 rows. At most 6 columns become pivots
//! and leave; what the others have left lies in the neighbours' rows and goes to the neighbour that is next in order,
//! made independent first where there are more columns than rows, so that nothing piles up along a chain.
//!
//! No residue is inverted (an inverse modulo a prime of 61 bits takes as long as a hundred products): columns are
//! combined crosswise, `v ← u_p·v - v_p·u`, which scales them by something nonzero and leaves the rank alone.
//!
//! # Sources
//! Duff & Reid, "The multifrontal solution of indefinite sparse symmetric linear equations", ACM TOMS 9 (1983), applied
//! to rank; Tinney & Walker's minimum-degree order, Proc. IEEE 55 (1967).

use super::method::{Answer, Certainty, MobilityMethod, NoAnswer, Quantity};
use crate::closure::matrix::{Closure, Column};
use crate::geom::exact::ExactField;
use crate::linalg::echelon;
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Up to so many contours, looking at all is faster than a heap.
const FEW: usize = 12;

/// Rank of J over the field, exact unless the prime divides a minor.
///
/// # Complexity
/// O(f·d³w³) field operations for f columns, d = 6 rows per contour and fronts of at most w contours: linear in the
/// number of contours k for chains, trees and grids of bounded width, where w is bounded. The order of the contours
/// costs O(k·w·k/64) operations on words besides. Never more than O(w) times the dense elimination,
/// [`rank_dense`].
#[must_use]
pub fn rank(exact: &ExactField, closure: &Closure<Residue>) -> usize {
    let plan = Plan::new(closure);
    let mut work = Work {
        field: exact.field(),
        plan: &plan,
        rest: vec![Rest::default(); plan.order.len()],
        left: Vec::with_capacity(16 * closure.dim),
        front: Vec::with_capacity(closure.columns.len().min(64) * 4 * closure.dim),
        rank: 0,
    };
    for &c in &plan.order {
        work.eliminate(closure, c);
    }
    work.rank
}

/// Rank of J over the field by writing it out: the slow twin of [`rank`].
///
/// # Complexity
/// O(f · rank · 6k) field operations.
#[must_use]
pub fn rank_dense(exact: &ExactField, closure: &Closure<Residue>) -> usize {
    let columns = closure.dense(exact);
    echelon::rank(exact.field(), columns.iter().map(Vec::as_slice))
}

/// A set of contours for each contour, as rows of bits.
struct Sets {
    words: usize,
    bits: Vec<u64>,
}

impl Sets {
    fn new(k: usize) -> Sets {
        let words = k.div_ceil(64);
        Sets {
            words,
            bits: vec![0; k * words],
        }
    }

    fn insert(&mut self, of: usize, x: usize) {
        self.bits[of * self.words + x / 64] |= 1 << (x % 64);
    }

    fn remove(&mut self, of: usize, x: usize) {
        self.bits[of * self.words + x / 64] &= !(1 << (x % 64));
    }

    fn row(&self, of: usize) -> &[u64] {
        &self.bits[of * self.words..(of + 1) * self.words]
    }

    fn len(&self, of: usize) -> usize {
        self.row(of).iter().map(|w| w.count_ones() as usize).sum()
    }

    fn join(&mut self, of: usize, with: usize) {
        for w in 0..self.words {
            self.bits[of * self.words + w] |= self.bits[with * self.words + w];
        }
    }

    /// Calls `visit` with each member, ascending.
    fn each(&self, of: usize, mut visit: impl FnMut(usize)) {
        for (w, &word) in self.row(of).iter().enumerate() {
            let mut left = word;
            while left != 0 {
                visit(w * 64 + left.trailing_zeros() as usize);
                left &= left - 1;
            }
        }
    }
}

/// What is known before any arithmetic. A coupling takes part as one more contour, of whose rows all but the first are
/// zeros.
struct Plan {
    /// Per joint, where its columns begin and end.
    columns_of: Vec<(usize, usize)>,
    /// Per joint, where its contours begin in `passes`; one more at the end.
    passes_from: Vec<usize>,
    /// The contours of each joint, with the direction it is passed in.
    passes: Vec<(usize, bool)>,
    /// The contours in the order they are eliminated in.
    order: Vec<usize>,
    /// Per contour, a number that is greater the later it comes in the order.
    place: Vec<usize>,
    /// Per contour, those that its front has rows of besides its own.
    neighbours: Sets,
}

impl Plan {
    fn new(closure: &Closure<Residue>) -> Plan {
        let (k, joints) = (
            closure.contours.len() + closure.couplings.len(),
            closure.columns.last().map_or(0, |c| c.joint.index() + 1),
        );
        // Joints without columns (rigid ones) link no contours.
        let mut columns_of = vec![(0, 0); joints];
        for (i, c) in closure.columns.iter().enumerate() {
            let range = &mut columns_of[c.joint];
            if range.1 == 0 {
                range.0 = i;
            }
            range.1 = i + 1;
        }
        let with_columns = |j: JointId| columns_of.get(j.index()).is_some_and(|r| r.1 > 0);
        let incidences = || {
            let contours = closure.contours.iter().enumerate();
            let couplings = (closure.contours.len()..).zip(&closure.couplings);
            contours
                .flat_map(|(i, c)| c.joints.iter().map(move |&(j, forward)| (i, j, forward)))
                .filter(|&(_, j, _)| with_columns(j))
                .chain(couplings.flat_map(|(i, c)| {
                    c.entries
                        .each_ref()
                        .map(|(at, _)| (i, closure.columns[*at].joint, true))
                }))
        };
        let mut passes_from = vec![0; joints + 1];
        for (_, j, _) in incidences() {
            passes_from[j.index() + 1] += 1;
        }
        for j in 0..joints {
            passes_from[j + 1] += passes_from[j];
        }
        let mut passes = vec![(0, true); passes_from[joints]];
        for (i, j, forward) in incidences() {
            // The starts move to the ends, and back below.
            passes[passes_from[j]] = (i, forward);
            passes_from[j] += 1;
        }
        passes_from.rotate_right(1);
        passes_from[0] = 0;
        let mut neighbours = Sets::new(k);
        for j in 0..joints {
            let of = &passes[passes_from[j]..passes_from[j + 1]];
            for &(a, _) in of {
                for &(b, _) in of.iter().filter(|(b, _)| *b != a) {
                    neighbours.insert(a, b);
                }
            }
        }
        let (order, place) = fewest_neighbours_first(k, &mut neighbours);
        Plan {
            columns_of,
            passes_from,
            passes,
            order,
            place,
            neighbours,
        }
    }

    fn passes(&self, joint: JointId) -> &[(usize, bool)] {
        match self.passes_from.get(joint.index()..joint.index() + 2) {
            Some(range) => &self.passes[range[0]..range[1]],
            None => &[],
        }
    }

    fn columns<'a>(
        &self,
        closure: &'a Closure<Residue>,
        joint: JointId,
    ) -> impl Iterator<Item = (usize, &'a Column<Residue>)> {
        let (from, to) = self.columns_of[joint];
        (from..).zip(&closure.columns[from..to])
    }
}

/// The order of elimination, and for each contour a number that grows along it; leaves in each set the neighbours that
/// the contour has when its turn comes.
fn fewest_neighbours_first(k: usize, neighbours: &mut Sets) -> (Vec<usize>, Vec<usize>) {
    // Above all degrees.
    const DONE: usize = usize::MAX / 2;
    let mut degree: Vec<usize> = (0..k).map(|c| neighbours.len(c)).collect();
    let mut order = Vec::with_capacity(k);
    let mut near = Vec::with_capacity(k.min(64));
    let mut heap = BinaryHeap::new();
    if k > FEW {
        heap.extend(degree.iter().enumerate().map(|(c, &d)| Reverse((d, c))));
    }
    while order.len() < k {
        let c = if k > FEW {
            match heap.pop() {
                Some(Reverse((d, c))) if degree[c] == d => c,
                _ => continue,
            }
        } else {
            (0..k).min_by_key(|&c| degree[c]).unwrap_or(0)
        };
        degree[c] = DONE + order.len();
        order.push(c);
        near.clear();
        neighbours.each(c, |n| near.push(n));
        for &n in &near {
            neighbours.join(n, c);
            neighbours.remove(n, n);
            neighbours.remove(n, c);
            let now = neighbours.len(n);
            if now != degree[n] {
                degree[n] = now;
                if k > FEW {
                    heap.push(Reverse((now, n)));
                }
            }
        }
    }
    (order, degree)
}

/// What a front leaves: columns on the rows of the contour's neighbours, ascending.
#[derive(Clone, Copy, Default)]
struct Rest {
    /// The first row of this contour in the present front, while it is part of it.
    slot: usize,
    /// Where they begin and end in `Work::left`.
    columns: (usize, usize),
    /// Another rest that goes to the same contour's front.
    sibling: Option<usize>,
    /// The first rest that this contour's front takes in.
    child: Option<usize>,
}

struct Work<'a> {
    field: Field,
    plan: &'a Plan,
    rest: Vec<Rest>,
    /// The columns of all rests.
    left: Vec<Residue>,
    /// The columns of the present front, one after the other.
    front: Vec<Residue>,
    rank: usize,
}

impl Work<'_> {
    /// Forms the front of a contour, takes out the pivots of its rows, and passes on what is left.
    fn eliminate(&mut self, closure: &Closure<Residue>, c: usize) {
        let (plan, dim) = (self.plan, closure.dim);
        self.rest[c].slot = 0;
        let mut height = dim;
        let mut next: Option<usize> = None;
        plan.neighbours.each(c, |n| {
            self.rest[n].slot = height;
            height += dim;
            if next.is_none_or(|x| plan.place[n] < plan.place[x]) {
                next = Some(n);
            }
        });
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
            for j in joints().filter(|&j| (plan.passes(j).len() == 1) == own) {
                // The front of the first of its contours in the order takes a joint.
                let first = |&(i, _): &(usize, bool)| plan.place[i] >= plan.place[c];
                if plan.passes(j).is_empty() || !plan.passes(j).iter().all(first) {
                    continue;
                }
                for (index, column) in plan.columns(closure, j) {
                    let at = self.front.len();
                    self.front.resize(at + height, 0);
                    for &(i, forward) in plan.passes(j) {
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
            let width = plan.neighbours.len(x) * dim;
            for column in self.left[from..to].chunks_exact(width) {
                let at = self.front.len();
                self.front.resize(at + height, 0);
                let mut from = column.chunks_exact(dim);
                plan.neighbours.each(x, |n| {
                    if let Some(block) = from.next() {
                        self.front[at + self.rest[n].slot..][..dim].copy_from_slice(block);
                    }
                });
            }
            child = self.rest[x].sibling;
        }
        self.rank += pivots(self.field, &mut self.front, height, dim);
        let Some(parent) = next else { return };
        let from = self.left.len();
        for column in self.front.chunks_exact(height) {
            if column[dim..].iter().any(|&x| x != 0) {
                self.left.extend_from_slice(&column[dim..]);
            }
        }
        let width = height - dim;
        if self.left.len() - from > width * width {
            let basis = independent(self.field, &mut self.left[from..], width);
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
fn pivots(field: Field, columns: &mut [Residue], height: usize, rows: usize) -> usize {
    let one = field.one();
    let mut found = 0;
    let mut rest = columns;
    while found < rows && rest.len() >= height {
        let (u, later) = rest.split_at_mut(height);
        let ones = u[..rows].iter().position(|&x| x == one);
        if let Some(p) = ones.or_else(|| u[..rows].iter().position(|&x| x != 0)) {
            found += 1;
            // Columns of this contour alone are the commonest, and end with its rows.
            let end = u.iter().rposition(|&x| x != 0).map_or(0, |e| e + 1);
            for v in later.chunks_exact_mut(height) {
                combine(field, v, &u[..end], p);
            }
            u.fill(0);
        }
        rest = later;
    }
    found
}

/// Clears entry `p` of `v` by the column `u`, which has zeros from its length on.
#[inline]
fn combine(field: Field, v: &mut [Residue], u: &[Residue], p: usize) {
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
            *x = field.cross(b, *x, a, y);
        }
    }
    for x in far.iter_mut().filter(|x| **x != 0) {
        *x = field.mul(b, *x);
    }
}

/// A basis of the span of columns of equal height.
fn independent(field: Field, columns: &mut [Residue], height: usize) -> Vec<Residue> {
    let mut basis = Vec::with_capacity(height * height);
    let mut rest = columns;
    while rest.len() >= height {
        let (u, later) = rest.split_at_mut(height);
        if let Some(p) = u.iter().position(|&x| x != 0) {
            for v in later.chunks_exact_mut(height) {
                combine(field, v, u, p);
            }
            basis.extend_from_slice(u);
        }
        rest = later;
    }
    basis
}

/// [`rank`] as a method.
#[derive(Debug, Clone, Copy)]
pub struct Modular;

impl MobilityMethod for Modular {
    fn name(&self) -> &'static str {
        "modular"
    }
    fn title(&self) -> &'static str {
        "rank modulo a prime"
    }
    fn guarantee(&self) -> &'static str {
        "exact at this pose but for primes that divide a minor; a rank modulo a prime is never too large"
    }
    fn complexity(&self) -> &'static str {
        "O(k) for chains, trees and grids of bounded width"
    }
    fn source(&self) -> &'static str {
        "Schwartz 1980 (identities by evaluation); Duff & Reid 1983 (fronts)"
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let exact = super::field_of(mechanism, state, 0)?;
        let closure = Closure::new(&exact, mechanism, state)?;
        let int = |x: usize| i64::try_from(x).unwrap_or(i64::MAX);
        Ok(Answer {
            mobility: int(closure.columns.len()) - int(rank(&exact, &closure)),
            quantity: Quantity::Instantaneous,
            certainty: Certainty::Exact,
        })
    }
}
