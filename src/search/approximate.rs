//! Brute force in floating point: every variant's ranks within a tolerance, to be compared with exact ones.

use crate::closure::matrix::Closure;
use crate::closure::twist::MotionSpace;
use crate::geom::exact::ExactError;
use crate::geom::scalars::Reals;
use crate::model::mechanism::{JointId, StateId};
use crate::rank::numeric::Elimination;
use crate::rank::scaled::Scaling;
use crate::search::brute::Seen;
use crate::search::conditions::Search;
use crate::search::space::{Choice, columns};
use crate::search::written_out::{Layout, Spans, WrittenOut};
use ozols_dense::Matrix;

/// The closure matrices of all variants at once, in double precision, as an elimination wants them: as they stand, or for
/// singular values scaled, so that units do not matter.
#[derive(Debug)]
pub struct Approximate {
    elimination: Elimination,
    tolerance: f64,
    all: WrittenOut<f64>,
}

impl Approximate {
    /// Writes the columns of a search's space out, for ranks within a tolerance.
    ///
    /// # Errors
    /// None where the search has an exact image already.
    pub fn new(
        search: &Search,
        elimination: Elimination,
        tolerance: f64,
    ) -> Result<Approximate, ExactError> {
        let mechanism = &*search.mechanism;
        let motion = MotionSpace::new(&Reals, &mechanism.mode)?;
        let state = search.space.state.unwrap_or(StateId::FREE);
        let present = Closure::new(&Reals, mechanism, state)?;
        let scaling = (elimination == Elimination::Svd).then(|| Scaling::of(&present));
        let of_joint = |choice: &Choice, j: JointId| {
            let joint = &mechanism.joints[j];
            let option = &joint.options[choice.option];
            let inserted = choice.unloading.map(|u| &joint.unloading[u]);
            let mut columns = columns(&Reals, &motion, mechanism, j, (option, inserted))?.concat();
            if let Some(scaling) = &scaling {
                columns.iter_mut().for_each(|c| scaling.unit(c));
            }
            Ok(columns)
        };
        let mut spans: Vec<Vec<Spans<f64>>> = Vec::new();
        for v in &search.space.variables {
            let of_choice = |c| v.joints.iter().map(|&j| of_joint(c, j)).collect();
            spans.push(
                v.choices
                    .iter()
                    .map(of_choice)
                    .collect::<Result<_, ExactError>>()?,
            );
        }
        Ok(Approximate {
            elimination,
            tolerance,
            all: WrittenOut::new(&Reals, search, &Layout::new(search), &spans),
        })
    }

    /// Looks at one variant; `None` where the arithmetic fails.
    ///
    /// # Complexity
    /// Two or three decompositions.
    #[must_use]
    pub fn look(&self, choices: &[usize]) -> Option<Seen> {
        let [free, kept, state] = self.all.rows;
        let chosen: Vec<&Vec<f64>> = self.all.chosen(choices).collect();
        let rank = |from: usize, to: usize| {
            let matrix = Matrix::from_fn(to - from, chosen.len(), |r, c| chosen[c][from + r]);
            let rank = self.elimination.rank_of(&matrix, self.tolerance);
            rank.ok().map(|r| r.rank)
        };
        let inside = rank(0, free)?;
        let with_kept = match kept {
            0 => inside,
            _ => rank(0, free + kept)?,
        };
        let of_state = match state {
            0 => None,
            _ => Some(rank(free + kept, free + kept + state)?),
        };
        Some(Seen::of_ranks(self.all.rows, [inside, with_kept], of_state))
    }
}
