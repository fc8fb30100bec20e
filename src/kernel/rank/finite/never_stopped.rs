//! One motion expanded up to the highest order that can stop it.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::Residue;
use crate::model::mechanism::Mechanism;
use crate::motion::pose::Pose;
use crate::rank::finite::higher_order::{HigherOrder, Line, ORDER};
use crate::rank::finite::multiplicity;

/// Maximum order of the expansion of a motion.
const HIGHEST: usize = 600;

/// The power series of a pose, and one motion of it.
pub(super) struct Expanded {
    /// `None` if the mechanism is too large.
    pub(super) series: Option<HigherOrder>,
    /// A motion in a random direction.
    pub(super) line: Option<Line>,
    /// The highest order that can stop it.
    bound: Option<usize>,
}

impl Expanded {
    pub(super) fn new(
        exact: &ExactField,
        mechanism: &Mechanism,
        closure: &Closure<Residue>,
        pose: &Pose,
        rank: usize,
    ) -> Result<Expanded, ExactError> {
        let series = HigherOrder::new(exact, mechanism, closure, pose, rank)?;
        let instantaneous = closure.columns.len() - rank;
        let bound = multiplicity::bound(exact, mechanism, closure, instantaneous)?
            .filter(|&order| order <= HIGHEST);
        let order = bound.unwrap_or(0).max(ORDER);
        let line = series.as_ref().map(|s| s.line(order));
        Ok(Expanded {
            series,
            line,
            bound,
        })
    }

    /// Returns true if the motion continues beyond every possible obstruction, so that every instantaneous motion is
    /// finite.
    pub(super) fn is_never_stopped(&self) -> bool {
        matches!((self.line, self.bound), (Some(line), Some(bound)) if line.stopped.is_none() && line.order >= bound)
    }
}
