//! The redundant constraints that a partly chosen mechanism has, and how many it may have.

use crate::model::mechanism::JointId;
use itertools::Itertools;

/// Limits of the search: redundancy allowed in a variant, and the node and memory budgets. `None` means unlimited.
#[derive(Debug, Clone)]
pub(crate) struct Limits {
    /// Redundant constraints allowed within the mechanism.
    pub internal: u32,
    /// Redundant constraints that the state may add.
    pub external: Option<u32>,
    /// Harmful ones among them.
    pub harmful: Option<u32>,
    /// Whether the lanes of the searched state count what it adds to the free state, not all that it has.
    pub beside_free: bool,
    /// Nodes in all.
    pub nodes: usize,
    /// Nodes of one layer; a diagram with a larger layer is not wanted in part.
    pub layer: usize,
    /// Bytes held at a time, nodes and edges.
    pub bytes: usize,
}

/// The count of a lane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::search) enum Role {
    /// Redundant constraints of the free state.
    Free,
    /// Those of the searched state.
    State,
    /// Those of the searched state without the joints that it adds.
    Common,
    /// Those of the searched state under friction, where this face shows moments too.
    Friction(JointId),
    /// None: whether the body of this grasp moves against one of its jaws.
    Held(usize),
}

/// Redundant constraints so far.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(in crate::search) struct Spent {
    internal: u32,
    /// Those of the lanes of a searched state, lane 1 first; at the end the external and the harmful ones.
    lanes: Vec<i32>,
}

/// Redundant constraints of a whole variant.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct Redundancy {
    /// Within the mechanism.
    pub internal: u32,
    /// Redundant constraints of the state less those within the mechanism; negative if the state removes joints.
    pub external: i32,
    /// Self-stresses that load the joints the state adds with more than friction.
    pub harmful: u32,
}

/// The count of a lane that does not apply.
const RULED_OUT: i32 = i32::MIN;

impl Spent {
    /// Creates the record of `internal` redundant constraints within the mechanism.
    pub(in crate::search) fn within_mechanism(internal: u32) -> Spent {
        Spent {
            internal,
            ..Spent::default()
        }
    }

    /// Adds the constraints that a variable makes redundant in a lane; lane 0 is the free state's.
    pub(in crate::search) fn add_redundant(&mut self, lane: usize, redundant: u32) {
        match lane.checked_sub(1) {
            None => self.internal += redundant,
            Some(lane) => {
                let count = self.lane_count(lane);
                if *count != RULED_OUT {
                    *count += i32::try_from(redundant).unwrap_or(i32::MAX);
                }
            }
        }
    }

    /// Says that a lane of a searched state does not apply to these choices.
    pub(in crate::search) fn rule_out(&mut self, lane: usize) {
        *self.lane_count(lane - 1) = RULED_OUT;
    }

    /// Returns whether a lane does not apply.
    pub(in crate::search) fn is_ruled_out(&self, lane: usize) -> bool {
        lane > 0 && self.lanes.get(lane - 1) == Some(&RULED_OUT)
    }

    fn lane_count(&mut self, i: usize) -> &mut i32 {
        if self.lanes.len() <= i {
            self.lanes.resize(i + 1, 0);
        }
        &mut self.lanes[i]
    }

    /// Returns whether no grasp has lost all the jaws that may hold it; `roles` are those of the lanes from 1 on.
    pub(in crate::search) fn holds_all(&self, roles: &[Role]) -> bool {
        let grasps = roles.iter().filter_map(|role| match role {
            Role::Held(grasp) => Some(*grasp),
            _ => None,
        });
        grasps.dedup().all(|grasp| {
            let mut lanes = roles.iter().enumerate();
            lanes.any(|(i, role)| *role == Role::Held(grasp) && !self.is_ruled_out(1 + i))
        })
    }

    /// Replaces the counts of the lanes by those of the variant. External redundant constraints are those that the searched state has
    /// beyond the free one. Harmful ones are those that friction does not explain if the face that explains most takes moments.
    pub(in crate::search) fn settle_counts(&mut self, roles: &[Role], limits: &Limits) {
        let free = self.counted_of_free(limits);
        let (mut state, mut common, mut harmless) = (0, free, None::<i32>);
        for (i, role) in roles
            .iter()
            .enumerate()
            .filter(|(i, _)| !self.is_ruled_out(1 + i))
        {
            let count = self.lanes.get(i).copied().unwrap_or(0);
            match role {
                Role::State => state = count,
                Role::Common => common = count,
                Role::Friction(_) => harmless = harmless.max(Some(count)),
                Role::Free | Role::Held(_) => {}
            }
        }
        let harmful = state - harmless.unwrap_or(common).max(common);
        self.lanes = vec![state - free, harmful];
    }

    /// Returns the number of redundant constraints within the mechanism so far.
    pub(in crate::search) fn internal(&self) -> u32 {
        self.internal
    }

    /// Returns whether the mechanism has no more redundant constraints than it may have, nor the searched state, whose lane is the first,
    /// more than it may add to these.
    pub(in crate::search) fn is_within(&self, limits: &Limits) -> bool {
        let state = self.lanes.first().map_or(0, |&n| i64::from(n));
        let of_free = if limits.beside_free {
            0
        } else {
            i64::from(limits.internal)
        };
        let most = limits.external.map(|n| i64::from(n) + of_free);
        self.internal <= limits.internal && most.is_none_or(|most| state <= most)
    }

    /// Returns how many redundant constraints of the free state the lanes of the searched one count too.
    fn counted_of_free(&self, limits: &Limits) -> i32 {
        if limits.beside_free {
            0
        } else {
            i32::try_from(self.internal).unwrap_or(i32::MAX)
        }
    }

    /// Returns whether the state adds no more than it may, its lanes being settled.
    pub(in crate::search) fn state_within(&self, limits: &Limits) -> bool {
        let Redundancy {
            external, harmful, ..
        } = self.redundancy();
        let at_most = |x: i64, limit: Option<u32>| limit.is_none_or(|l| x <= i64::from(l));
        at_most(external.into(), limits.external) && at_most(harmful.into(), limits.harmful)
    }

    /// Returns the counts of a whole variant, its lanes being settled.
    pub(in crate::search) fn redundancy(&self) -> Redundancy {
        let [external, harmful] = [0, 1].map(|i| self.lanes.get(i).copied().unwrap_or(0));
        Redundancy {
            internal: self.internal,
            external,
            harmful: u32::try_from(harmful).unwrap_or(0),
        }
    }

    /// Returns numbers that tell it from others.
    pub(in crate::search) fn hash_words(&self) -> impl Iterator<Item = u64> {
        let lanes = self.lanes.iter().map(|&x| u64::from(x.cast_unsigned()));
        std::iter::once(u64::from(self.internal)).chain(lanes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a lane would count that does not apply tells no two parts of a mechanism apart: they are one node.
    #[test]
    fn a_lane_that_does_not_apply_counts_no_more() {
        let after = |redundant: u32| {
            let mut spent = Spent::default();
            spent.rule_out(1);
            spent.add_redundant(1, redundant);
            spent.hash_words().collect::<Vec<_>>()
        };
        assert_eq!(after(0), after(3));
        // One that applies does count.
        let mut spent = Spent::default();
        spent.add_redundant(1, 3);
        assert_ne!(spent.lanes, Spent::default().lanes);
    }
}
