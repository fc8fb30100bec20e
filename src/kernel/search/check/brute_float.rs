//! Brute force in floating point: every variant's ranks within a tolerance, to be compared with exact ones.

use crate::closure::Closure;
use crate::closure::twist::MotionSpace;
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::numeric::scaling::Scaling;
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

/// The closure matrices of all variants in double precision.
#[derive(Debug)]
pub struct Approximate(WrittenOut<f64>);

impl Approximate {
    /// Writes out the columns of a search's space, with the places of a mechanism that has the same links, joints and options, such as the
    /// rounded coordinates of a file. For singular values they are `scaled`, so that units do not matter.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    pub fn new(
        question: &Question,
        mechanism: &Mechanism,
        scaled: bool,
    ) -> Result<Approximate, ExactError> {
        let motion = MotionSpace::new(&Reals, &mechanism.mode)?;
        let state = question.space.state.unwrap_or(StateId::FREE);
        let present = Closure::new(&Reals, mechanism, state)?;
        let scaling = scaled.then(|| Scaling::of_closure(&present));
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
        let layout = RowLayout::new(question);
        let all = WrittenOut::new(&Reals, question, &layout, &spans);
        Ok(Approximate(all))
    }

    /// Returns the numbers of rows: closure equations of the free state, those of the kept links' motion, and closure equations of the
    /// searched state.
    #[must_use]
    pub fn row_counts(&self) -> [usize; 3] {
        self.0.rows
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

    /// Returns the matrix of some rows of a variant.
    #[must_use]
    pub fn variant_matrix(&self, choices: &[usize], rows: RankedRows) -> Matrix {
        let [free, kept, state] = self.0.rows;
        let (from, to) = match rows {
            RankedRows::Free => (0, free),
            RankedRows::WithKept => (0, free + kept),
            RankedRows::State => (free + kept, free + kept + state),
        };
        let chosen: Vec<&Vec<f64>> = self.0.variant_columns(choices).collect();
        Matrix::from_fn(to - from, chosen.len(), |r, c| chosen[c][from + r])
    }
}
