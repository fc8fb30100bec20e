//! The redundant constraints that a partly chosen mechanism has, and how many it may have.

use crate::search::diagram::state_copies::Lane;

/// When a partly built mechanism is given up, and when building stops; no number, no limit.
#[derive(Debug, Clone)]
pub(crate) struct Limits {
    /// Redundant constraints within the mechanism that every variant has.
    pub already: u32,
    /// Redundant constraints allowed within the mechanism.
    pub internal: u32,
    /// Redundant constraints that the state may add.
    pub external: Option<u32>,
    /// Harmful ones among them.
    pub harmful: Option<u32>,
    /// Nodes in all.
    pub nodes: usize,
    /// Nodes of one layer; what has more is wanted whole or not at all.
    pub layer: usize,
    /// Bytes held at a time, nodes and edges.
    pub bytes: usize,
}

/// Redundant constraints so far.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(in crate::search) struct Spent {
    internal: u32,
    external: i32,
    /// Those of the state's lane, and of each lane of friction; at the end only the harmful ones.
    lanes: Vec<i32>,
}

/// Redundant constraints of a whole variant.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct Redundancy {
    /// Within the mechanism.
    pub internal: u32,
    /// Of the state less those within; fewer than none where the state leaves joints out.
    pub external: i32,
    /// Self-stresses that load the joints the state adds with more than friction.
    pub harmful: u32,
}

/// The count of a lane that does not apply.
const RULED_OUT: i32 = i32::MIN;

impl Spent {
    /// So many redundant constraints within the mechanism.
    pub(in crate::search) fn within_mechanism(internal: u32) -> Spent {
        Spent {
            internal,
            ..Spent::default()
        }
    }

    /// Counts what a joint makes redundant in a lane.
    pub(in crate::search) fn add(&mut self, lane: Lane, redundant: u32) {
        let more = i32::try_from(redundant).unwrap_or(i32::MAX);
        match lane {
            Lane::Common => self.internal += redundant,
            Lane::Free => {
                self.internal += redundant;
                self.external -= more;
            }
            Lane::State => {
                self.external += more;
                *self.lane(0) += more;
            }
            Lane::Friction(face) => {
                let count = self.lane(1 + face);
                if *count != RULED_OUT {
                    *count += more;
                }
            }
        }
    }

    /// Says that a lane does not apply: its face is none.
    pub(in crate::search) fn rule_out(&mut self, face: usize) {
        *self.lane(1 + face) = RULED_OUT;
    }

    fn lane(&mut self, i: usize) -> &mut i32 {
        if self.lanes.len() <= i {
            self.lanes.resize(i + 1, 0);
        }
        &mut self.lanes[i]
    }

    /// Ends the lanes: what is harmful is what friction alone does not explain, with moments taken up at the face that
    /// explains most.
    pub(in crate::search) fn settle(&mut self) {
        let all = self.lanes.first().copied().unwrap_or(0);
        let harmless = self.lanes.iter().skip(1).copied().max();
        self.lanes = vec![all - harmless.unwrap_or(0).max(0)];
    }

    /// Redundant constraints within the mechanism so far.
    pub(in crate::search) fn internal(&self) -> u32 {
        self.internal
    }

    /// Whether it is within limits; harm counts once the lanes are settled.
    pub(in crate::search) fn within(&self, limits: &Limits) -> bool {
        let at_most =
            |x: i32, limit: Option<u32>| limit.is_none_or(|l| i64::from(x) <= i64::from(l));
        self.internal <= limits.internal && at_most(self.external, limits.external)
    }

    /// Whether it does no more harm than it may, its lanes being settled.
    pub(in crate::search) fn harms_within(&self, limits: &Limits) -> bool {
        limits
            .harmful
            .is_none_or(|l| self.redundancy().harmful <= l)
    }

    /// The counts of a whole variant.
    pub(in crate::search) fn redundancy(&self) -> Redundancy {
        let harmful = self.lanes.first().copied().unwrap_or(0);
        Redundancy {
            internal: self.internal,
            external: self.external,
            harmful: u32::try_from(harmful).unwrap_or(0),
        }
    }

    /// Numbers that tell it from others.
    pub(in crate::search) fn words(&self) -> impl Iterator<Item = u64> {
        let two = u64::from(self.internal) << 32 | u64::from(self.external.cast_unsigned());
        let lanes = self.lanes.iter().map(|&x| u64::from(x.cast_unsigned()));
        std::iter::once(two).chain(lanes)
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
            spent.rule_out(0);
            spent.add(Lane::Friction(0), redundant);
            spent.words().collect::<Vec<_>>()
        };
        assert_eq!(after(0), after(3));
        // One that applies does count.
        let mut spent = Spent::default();
        spent.add(Lane::Friction(0), 3);
        assert_ne!(spent.lanes, Spent::default().lanes);
    }
}
