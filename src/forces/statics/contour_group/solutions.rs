//! The group solved by all three methods, and their differences.

use crate::statics::contour_group::delta_point::{self, DeltaSteps};
use crate::statics::contour_group::equilibrium;
use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::contour_group::projective;
use crate::statics::kinetostatics::Worth;
use itertools::Itertools;

/// A method for the four-link group with a closed contour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GroupMethod {
    /// The δ-point method.
    Delta,
    /// Its projective form.
    Projective,
    /// The equilibrium equations.
    Equilibrium,
}

impl GroupMethod {
    /// All three methods, in the order of the documentation.
    pub const ALL: [GroupMethod; 3] = [
        GroupMethod::Delta,
        GroupMethod::Projective,
        GroupMethod::Equilibrium,
    ];

    /// Returns the word for the method.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            GroupMethod::Delta => "delta",
            GroupMethod::Projective => "projective",
            GroupMethod::Equilibrium => "equilibrium",
        }
    }
}

/// Reactions of a four-link group with a closed contour by three methods.
#[derive(Debug, Clone)]
pub struct GroupSolutions {
    /// Index of the group in [`crate::statics::assur::Decomposition::groups`].
    pub group: usize,
    /// Its points and loads.
    pub pose: GroupPose,
    /// By the δ-point method.
    pub delta: GroupReactions,
    /// Intermediate results of the δ-point method.
    pub steps: DeltaSteps,
    /// By its projective form.
    pub projective: GroupReactions,
    /// By the twelve equilibrium equations, with their reliability.
    pub equilibrium: Option<(GroupReactions, Worth)>,
}

impl GroupSolutions {
    /// Solves a group by every method.
    #[must_use]
    pub fn new(group: usize, pose: GroupPose) -> GroupSolutions {
        let (delta, steps) = delta_point::solve_delta(&pose);
        GroupSolutions {
            group,
            delta,
            steps,
            projective: projective::solve_projective(&pose),
            equilibrium: equilibrium::solve_equilibrium(&pose),
            pose,
        }
    }

    /// Returns the reactions by a method, with 0 for rounding errors. Returns `None` if its equations are singular.
    #[must_use]
    pub fn reactions_by(&self, method: GroupMethod) -> Option<GroupReactions> {
        let found = match method {
            GroupMethod::Delta => self.delta,
            GroupMethod::Projective => self.projective,
            GroupMethod::Equilibrium => self.equilibrium?.0,
        };
        Some(found.without_rounding(&self.pose))
    }

    /// Returns the largest difference of any two methods' forces, over the largest force, or `None` with fewer than two
    /// methods.
    #[must_use]
    pub fn max_disagreement(&self, methods: &[GroupMethod]) -> Option<f64> {
        let found = methods
            .iter()
            .filter_map(|m| self.reactions_by(*m))
            .collect_vec();
        let pairs = found.iter().tuple_combinations();
        pairs
            .map(|(a, b)| a.distance_to(b, &self.pose))
            .max_by(f64::total_cmp)
    }
}
