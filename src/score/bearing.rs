//! What each joint of a variant bears.

use crate::model::mechanism::JointId;
use crate::score::elimination::Scratch;
use crate::score::evaluate::Evaluator;
use crate::score::terms::Scores;
use crate::search::best::Assignment;
use crate::statics::reactions::Unsolved;

/// What a joint bears in one pose, without what its drive does.
#[derive(Debug, Clone, Copy)]
pub(super) struct Load {
    pub(super) joint: JointId,
    /// `[N]`
    pub(super) force: f64,
    /// `[N·m]`
    pub(super) moment: f64,
    /// The greatest of both that its type bears; `None` for moments where it bears none and need not.
    pub(super) capacity: (f64, Option<f64>),
}

/// The most that a joint bears over the poses looked at.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Bearing {
    /// Force `[N]`.
    pub force: f64,
    /// Moment `[N·m]`.
    pub moment: f64,
    /// Force over capacity.
    pub force_share: f64,
    /// Moment over capacity; `None` where the joint bears none and need not.
    pub moment_share: Option<f64>,
}

impl Bearing {
    fn raise(&mut self, load: &Load) {
        let (force, moment) = load.capacity;
        self.force = self.force.max(load.force);
        self.moment = self.moment.max(load.moment);
        self.force_share = self.force_share.max(load.force / force);
        if let Some(capacity) = moment {
            let share = load.moment / capacity;
            self.moment_share = Some(self.moment_share.map_or(share, |s| s.max(share)));
        }
    }
}

impl Evaluator<'_> {
    /// The scores of a variant and, for each joint of the mechanism in file order, the most it bears; an unloading joint
    /// counts as the one it is in series with. `None` stands for joints that are not there in the free state.
    ///
    /// # Errors
    /// [`Unsolved`] where the loads have no equilibrium.
    ///
    /// # Complexity
    /// That of [`Evaluator::scores`].
    pub fn bearings(
        &self,
        variant: &Assignment,
        scratch: &mut Scratch,
    ) -> Result<(Scores, Vec<Option<Bearing>>), Unsolved> {
        let mut out: Vec<Option<Bearing>> = vec![None; self.search.mechanism.joints.len()];
        let scores = self.scores_and_loads(variant, scratch, &mut |load| {
            out[load.joint].get_or_insert_default().raise(&load);
        })?;
        Ok((scores, out))
    }
}
