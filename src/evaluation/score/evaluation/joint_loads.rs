//! Loads of each joint of a variant.

use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::{Evaluator, PoseLoad, ScoreError};
use crate::score::evaluation::load_cases::is_loaded;
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::Outcome;
use crate::score::outcome::variant::Variant;
use crate::search::answer::k_best::Assignment;
use crate::statics::reactions::Unsolved;
use rayon::prelude::*;

/// The largest loads of a joint over the examined poses.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Bearing {
    /// Force `[N]`.
    pub force: f64,
    /// Moment `[N·m]`.
    pub moment: f64,
    /// Force over capacity.
    pub force_share: f64,
    /// Moment over capacity; `None` if the joint bears none and need not.
    pub moment_share: Option<f64>,
}

impl Bearing {
    fn raise_to(&mut self, load: &PoseLoad) {
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
    /// Returns the scores of a variant and the largest loads of each joint of the mechanism, in file order. An unloading joint counts as
    /// the one it is in series with. The entry of a joint that the free state does not have is `None`.
    ///
    /// # Errors
    /// Returns [`Unsolved`] if the loads have no equilibrium.
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
            out[load.joint].get_or_insert_default().raise_to(&load);
        })?;
        Ok((scores, out))
    }
}

/// Loads of the joints of some variants.
#[derive(Debug, Clone)]
pub struct Bearings {
    /// Number of examined poses.
    pub poses: usize,
    /// The position at which following the stroke ended early, in the drive's unit.
    pub stopped: Option<f64>,
    /// The scores and the loads of each joint for each variant; `None` if its loads have no equilibrium.
    pub of: Vec<Option<(Scores, Vec<Option<Bearing>>)>>,
}

impl Outcome {
    /// Returns the loads of the joints of some variants, in the states of the ranking or else in those with loads. Returns `None` if the
    /// file states no loads and there is no ranking. A ranking scores its whole pool, but computes no loads of joints. This does so
    /// for the few variants that are shown.
    ///
    /// # Errors
    /// As [`Evaluator::in_states`].
    ///
    /// # Complexity
    /// [`Evaluator::scores`] for each variant, in parallel.
    ///
    /// # Examples
    /// ```
    /// let loaded = ozols::built_in("gripper-10-loaded")?;
    /// let outcome = ozols::search(&loaded, &ozols::Request { pool: Some(20), ..Default::default() })?;
    /// let best: Vec<_> = outcome.variants().take(1).collect();
    /// let loads = outcome.bearings(&best)?.expect("the file states loads");
    /// assert!(loads.poses >= 1 && loads.of.len() == 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn bearings(&self, variants: &[Variant<'_>]) -> Result<Option<Bearings>, ScoreError> {
        let ranking = self.ranking.as_ref();
        if !is_loaded(&self.search.mechanism) && ranking.is_none() {
            return Ok(None);
        }
        let clearance = ranking.map_or_else(Default::default, |p| p.ranking.clearance);
        let states = ranking.map_or(&[][..], |p| &p.ranking.states);
        let evaluator = Evaluator::in_states(&self.search, clearance, states)?;
        let of = variants
            .par_iter()
            .map_init(Scratch::default, |scratch, v| {
                evaluator.bearings(v.assignment(), scratch).ok()
            })
            .collect();
        Ok(Some(Bearings {
            poses: evaluator.cases.list.len(),
            stopped: evaluator.cases.stopped,
            of,
        }))
    }
}
