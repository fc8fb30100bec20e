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

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::build::self_stress::space_along_motion;
use crate::search::diagram::Diagram;
use crate::search::question::Question;
use crate::search::question::throughout::POWERS;
use crate::search::reduce::self_stress_space::SelfStressSpace;
use num_bigint::BigUint;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// Largest number of nodes of a layer.
const NODES: usize = 1_000;
/// Largest number of nodes of the diagram of those that keep the motion in the drawn pose, too. After a larger one, no built-in mechanism
/// has layers of fewer nodes than that.
const LASTING: usize = 128;

/// The reduced rows of a span, in the coordinates that later variables reach.
type Rows = Vec<Vec<Residue>>;

/// A span that grows by the vectors of choices.
struct Lane<'a> {
    field: Field,
    space: &'a SelfStressSpace,
}

impl Lane<'_> {
    /// Returns the rows after a choice of a variable, and how many of the coordinates that no later variable reaches are missed.
    fn take_choice(&self, at: usize, choice: usize, rows: &Rows) -> (Rows, usize) {
        let ends = |before: usize| self.space.contours.partition_point(|c| c.to < before);
        let (done, gap) = (ends(at), ends(at + 1) - ends(at));
        let added = self.space.added[at][choice].iter().map(|v| &v[done..]);
        let all = rows.iter().map(Vec::as_slice).chain(added);
        let span = Echelon::from_vectors(self.field, all);
        let mut pivots = span.pivots();
        pivots.sort_unstable();
        let met = pivots.partition_point(|p| *p < gap);
        let left = span.reduced_rows().split_off(met);
        (
            left.into_iter().map(|mut r| r.split_off(gap)).collect(),
            gap - met,
        )
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
    let lanes = spaces.each_ref().map(|space| Lane {
        field: question.exact.field(),
        space,
    });
    if spaces[0].lasting > spaces[1].lasting {
        return Some(BigUint::zero());
    }
    let mut layer = BTreeMap::from([([Rows::new(), Rows::new()], BigUint::one())]);
    for (at, &variable) in order.iter().enumerate() {
        let mut next: BTreeMap<[Rows; 2], BigUint> = BTreeMap::new();
        for (rows, count) in layer {
            for choice in 0..question.space.variables[variable].choices.len() {
                let [(a, more), (b, less)] =
                    [0, 1].map(|i| lanes[i].take_choice(at, choice, &rows[i]));
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
    let working = layer.iter().filter(|([a, b], _)| a.len() == b.len());
    Some(working.map(|(_, count)| count).sum())
}
