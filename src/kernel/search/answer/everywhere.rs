//! Number of variants that keep the motion in poses near the drawn one, including variants that are singular in the drawn pose.
//!
//! A variant may have redundant constraints only in the drawn pose, which is singular for it. It is not among the determinate ones there,
//! but it works in every other pose. Its columns along the motion are series modulo t^m. Let T(m) be the span of their multiples by
//! 1, t, ..., t^(m-1). The rank next to the drawn pose is then dim T(m) - dim T(m-1) for a large m. The same difference of the parts
//! that close all contours is the dimension of the kept motion. Two lanes count both, one for each span.
//!
//! Over the power series, the vectors of some choices span a module. The two lanes miss as many more coordinates than each other as its
//! cokernel has elementary divisors t^e with e >= m. A larger module of more coordinates has a cokernel with the first one as an image,
//! which has at least as many. So choices that miss any have no completion.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::Diagram;
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::question::Question;
use crate::search::question::throughout::POWERS;
use crate::search::reduce::self_stress_space::SelfStressSpace;
use crate::search::solve::self_stress::space_along_motion;
use num_bigint::BigUint;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// Largest number of nodes of a layer.
const NODES: usize = 1_000;
/// Largest number of nodes of the lasting diagram with which the count is tried. Every built-in mechanism with more nodes exceeds
/// [`NODES`], so the attempt would be in vain.
const LASTING: usize = 128;

/// A span that grows by the vectors of choices, in the coordinates that later variables reach.
struct Lane<'a> {
    space: &'a SelfStressSpace,
    arithmetic: Arithmetic,
    /// The reduced rows before a choice.
    before: Rows,
    after: Rows,
    vector: Vec<Residue>,
}

impl<'a> Lane<'a> {
    fn new(field: Field, space: &'a SelfStressSpace) -> Lane<'a> {
        Lane {
            space,
            arithmetic: Arithmetic::new(field),
            before: Rows::default(),
            after: Rows::default(),
            vector: Vec::new(),
        }
    }

    /// Returns the number of coordinates of contours that no variable from number `at` on reaches.
    fn ended_before(&self, at: usize) -> usize {
        self.space.contours.partition_point(|c| c.to < at)
    }

    /// Reads the packed rows before variable number `at`.
    fn read_rows(&mut self, at: usize, packed: &[Residue]) {
        let all = self.space.contours.len() + self.space.kept.len();
        let width = all - self.ended_before(at);
        self.before.unpack_rows(&mut self.arithmetic, width, packed);
    }

    /// Returns the packed rows after a choice of variable number `at`, and how many of the coordinates that no later variable reaches are
    /// missed.
    fn take_choice(&mut self, at: usize, choice: usize) -> (Vec<Residue>, usize) {
        let done = self.ended_before(at);
        let gap = self.ended_before(at + 1) - done;
        self.after.clone_from(&self.before);
        for added in &self.space.added[at][choice] {
            self.vector.clear();
            self.vector.extend_from_slice(&added[done..]);
            self.after.insert(&mut self.arithmetic, &mut self.vector);
        }
        let missed = gap - self.after.rank_before(gap);
        self.after.drop_first(gap);
        (self.after.to_packed(), missed)
    }
}

/// Returns the number of variants that are determinate and keep the motion in poses next to the drawn one, by the first powers of the
/// motion. `lasting` is the diagram of those that do so in the drawn pose, too. Returns `None` if no motion is followed, W or changes are
/// limited, or the nodes are too many.
///
/// # Complexity
/// O(m³) field operations for each node and choice, for m rows of the closure equations and kept links at all powers.
#[must_use]
pub fn count_everywhere(question: &Question, lasting: &Diagram) -> Option<BigUint> {
    let along = question.throughout.as_ref().ok()?;
    let conditions = &question.conditions;
    let limited = conditions.max_mobility.is_some() || conditions.max_changes.is_some();
    if limited || lasting.nodes > LASTING {
        return None;
    }
    let order: Vec<usize> = lasting.layers.iter().map(|l| l.variable).collect();
    let spaces =
        [POWERS, POWERS - 1].map(|powers| space_along_motion(question, along, &order, powers));
    if spaces[0].lasting > spaces[1].lasting {
        return Some(BigUint::zero());
    }
    let field = question.exact.field();
    let mut lanes = spaces.each_ref().map(|space| Lane::new(field, space));
    let mut layer = BTreeMap::from([([Vec::new(), Vec::new()], BigUint::one())]);
    for (at, &variable) in order.iter().enumerate() {
        let mut next: BTreeMap<[Vec<Residue>; 2], BigUint> = BTreeMap::new();
        for (packed, count) in layer {
            for (lane, packed) in lanes.iter_mut().zip(&packed) {
                lane.read_rows(at, packed);
            }
            for choice in 0..question.space.variables[variable].choices.len() {
                let [(a, more), (b, less)] = lanes.each_mut().map(|l| l.take_choice(at, choice));
                if more == less {
                    *next.entry([a, b]).or_default() += &count;
                }
            }
            if next.len() > NODES {
                return None;
            }
        }
        layer = next;
    }
    let mut rank = |lane: usize, packed: &[Residue]| {
        lanes[lane].read_rows(order.len(), packed);
        lanes[lane].before.rank()
    };
    let working = layer.iter().filter(|([a, b], _)| rank(0, a) == rank(1, b));
    Some(working.map(|(_, count)| count).sum())
}
