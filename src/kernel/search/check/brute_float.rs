//! Brute force in floating point: every variant's ranks within a tolerance, to be compared with exact ones.

use crate::closure::Closure;
use crate::closure::twist::MotionSpace;
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::numeric::Elimination;
use crate::rank::numeric::scaling::Scaling;
use crate::search::check::brute::Seen;
use crate::search::check::full_matrices::{RowLayout, Spans, WrittenOut};
use crate::search::question::Question;
use crate::search::question::rounded_rank::{Digits, RankRange};
use crate::search::question::space::{Choice, option_columns};
use ozols_dense::{Matrix, singular_values};

/// The rows of a variant's matrix of which a rank is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RankedRows {
    /// The closure equations of the free state.
    Free,
    /// These, and the motion of the kept links.
    WithKept,
    /// The closure equations of the searched state; no rows if none is searched.
    State,
}

/// The closure matrices of all variants in double precision. For singular values they are scaled, so that units do not matter.
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
    /// Returns no error if the search has an exact image.
    pub fn new(
        question: &Question,
        elimination: Elimination,
        tolerance: f64,
    ) -> Result<Approximate, ExactError> {
        Approximate::of_mechanism(question, &question.mechanism, elimination, tolerance)
    }

    /// Creates the same matrices for another mechanism with the same links, joints and options in other places, such as the
    /// rounded coordinates of a file.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    pub fn of_mechanism(
        question: &Question,
        mechanism: &Mechanism,
        elimination: Elimination,
        tolerance: f64,
    ) -> Result<Approximate, ExactError> {
        let motion = MotionSpace::new(&Reals, &mechanism.mode)?;
        let state = question.space.state.unwrap_or(StateId::FREE);
        let present = Closure::new(&Reals, mechanism, state)?;
        let scaling = (elimination == Elimination::Svd).then(|| Scaling::of_closure(&present));
        let of_joint = |choice: &Choice, j: JointId| {
            let joint = &mechanism.joints[j];
            let option = &joint.options[choice.option];
            let inserted = choice.unloading.map(|u| &joint.unloading[u]);
            let mut columns =
                option_columns(&Reals, &motion, mechanism, j, option, inserted)?.concat();
            if let Some(scaling) = &scaling {
                columns.iter_mut().for_each(|c| scaling.scale_to_unit(c));
            }
            Ok(columns)
        };
        let mut spans: Vec<Vec<Spans<f64>>> = Vec::new();
        for v in &question.space.variables {
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
            all: WrittenOut::new(&Reals, question, &RowLayout::new(question), &spans),
        })
    }

    /// Looks at one variant; `None` where the arithmetic fails.
    ///
    /// # Complexity
    /// Two or three decompositions.
    #[must_use]
    pub fn look_at(&self, choices: &[usize]) -> Option<Seen> {
        let [_, kept, state] = self.all.rows;
        let rank = |rows: RankedRows| {
            let matrix = self.variant_matrix(choices, rows);
            let rank = self.elimination.rank_of(&matrix, self.tolerance);
            rank.ok().map(|r| r.rank)
        };
        let inside = rank(RankedRows::Free)?;
        let with_kept = match kept {
            0 => inside,
            _ => rank(RankedRows::WithKept)?,
        };
        let of_state = match state {
            0 => None,
            _ => Some(rank(RankedRows::State)?),
        };
        Some(Seen::of_ranks(self.all.rows, [inside, with_kept], of_state))
    }

    /// Returns the number of closure equations of the free state, and of the searched one.
    #[must_use]
    pub fn count_equations(&self) -> [usize; 2] {
        let [free, _, state] = self.all.rows;
        [free, state]
    }

    /// Returns the rank of some rows of a variant, as far as the digits decide it. `None` if the singular values do not
    /// converge.
    ///
    /// # Complexity
    /// One decomposition.
    #[must_use]
    pub fn rank_range(
        &self,
        choices: &[usize],
        rows: RankedRows,
        digits: Digits,
    ) -> Option<RankRange> {
        let values = singular_values(&self.variant_matrix(choices, rows))?;
        Some(RankRange::from_values(&values, digits))
    }

    fn variant_matrix(&self, choices: &[usize], rows: RankedRows) -> Matrix {
        let [free, kept, state] = self.all.rows;
        let (from, to) = match rows {
            RankedRows::Free => (0, free),
            RankedRows::WithKept => (0, free + kept),
            RankedRows::State => (free + kept, free + kept + state),
        };
        let chosen: Vec<&Vec<f64>> = self.all.variant_columns(choices).collect();
        Matrix::from_fn(to - from, chosen.len(), |r, c| chosen[c][from + r])
    }
}
