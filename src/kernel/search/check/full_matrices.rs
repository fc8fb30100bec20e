//! The closure matrices of all variants at once: every choice's columns, written out in full, in any number system.

use crate::closure::contour::contour_basis;
use crate::geom::Scalars;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, StateId};
use crate::motion::displacement_series::shifted_multiples;
use crate::search::question::Question;
use crate::search::question::space::Variable;
use crate::search::question::throughout::ColumnSeries;
use crate::search::reduce::self_stress_space::{ClosingRows, Part};
use std::ops::Range;

/// The twists of a choice at each joint of its variable, each followed by the joint's entries in the rows of its couplings.
pub(crate) type Spans<N> = Vec<Vec<Vec<N>>>;

/// The rows of the matrices: contours and couplings of the free state, motions of the kept links, and all contours and couplings of the
/// searched state.
pub(in crate::search) struct RowLayout<'a> {
    dim: usize,
    free: ClosingRows<'a>,
    state: Option<ClosingRows<'a>>,
}

impl RowLayout<'_> {
    pub(in crate::search) fn new(question: &Question) -> RowLayout<'_> {
        let (mechanism, dim) = (&*question.mechanism, question.space.dim);
        let of_state = |s: StateId| {
            let contours = contour_basis(mechanism, s);
            ClosingRows::in_state(mechanism, dim, s, contours, Vec::new())
        };
        RowLayout {
            dim,
            free: ClosingRows::for_free_state(
                mechanism,
                dim,
                &question.contours,
                Some(&question.kept),
            ),
            state: question.space.state.map(of_state),
        }
    }

    /// Returns the number of rows of each kind.
    fn row_counts(&self) -> [usize; 3] {
        let state = self.state.as_ref();
        let state = state.map_or(0, ClosingRows::count_closing);
        [self.free.count_closing(), self.free.count_kept(), state]
    }

    /// Returns the columns of each choice along the motion times each power of t. The rows are those of the free state at
    /// each power, then those of the kept links' motion at each power, for so many powers. Also returns the number of rows of
    /// each kind. `None` if no motion is followed.
    pub(in crate::search) fn along_motion(
        &self,
        question: &Question,
        powers: usize,
    ) -> Option<WrittenOut<Residue>> {
        let along = question.throughout.as_ref().ok()?;
        let [free, kept, _] = self.row_counts();
        let multiples = |(joint, series): &(JointId, ColumnSeries)| -> Vec<Vec<Residue>> {
            let terms = series
                .iter()
                .take(powers)
                .map(|t| self.joint_column(question.field(), *joint, t));
            let terms: Vec<Vec<Residue>> = terms.collect();
            let part = |rows: Range<usize>| -> Vec<Vec<Residue>> {
                shifted_multiples(&terms.iter().map(|t| &t[rows.clone()]).collect::<Vec<_>>())
            };
            let both = part(0..free).into_iter().zip(part(free..free + kept));
            both.map(|(a, b)| [a, b].concat()).collect()
        };
        let of_choice = |v: usize, c: usize| -> Vec<Vec<Residue>> {
            along.of_choice(v, c).flat_map(multiples).collect()
        };
        let of_variable = |(v, variable): (usize, &Variable)| {
            let choices = 0..variable.choices.len();
            choices.map(|c| of_choice(v, c)).collect()
        };
        let variables = question.space.variables.iter().enumerate();
        Some(WrittenOut {
            rows: [powers * free, powers * kept, 0],
            columns: variables.map(of_variable).collect(),
        })
    }

    /// Returns the column of a twist at a joint, which is followed by the joint's rates.
    pub(in crate::search) fn joint_column<S: Scalars>(
        &self,
        s: &S,
        j: JointId,
        twist: &[S::Number],
    ) -> Vec<S::Number> {
        let (twist, rates) = twist.split_at(self.dim);
        let mut out = vec![S::Number::default(); self.row_counts().iter().sum()];
        let [closing, kept, _] = self.row_counts();
        for (first, rows) in [(0, Some(&self.free)), (closing + kept, self.state.as_ref())] {
            for (at, part) in rows.into_iter().flat_map(|rows| rows.row_parts(j)) {
                let out = &mut out[first + at..];
                match part {
                    Part::Twist { forward: true } => out[..twist.len()].clone_from_slice(twist),
                    Part::Twist { forward: false } => {
                        let signed = out.iter_mut().zip(twist);
                        signed.for_each(|(x, t)| *x = s.sub(S::Number::default(), t.clone()));
                    }
                    Part::Rate(rate) => out[0] = rates[rate].clone(),
                }
            }
        }
        out
    }
}

/// Columns of every choice. Those of a variant, side by side, are its matrix: first the rows of the free state (contours,
/// then couplings), then those of the kept links' motion, then those of the searched state.
#[derive(Debug)]
pub(crate) struct WrittenOut<N> {
    /// How many rows there are of each kind.
    pub rows: [usize; 3],
    /// `columns[variable][choice]`.
    columns: Vec<Vec<Vec<Vec<N>>>>,
}

impl<N: Clone + Default> WrittenOut<N> {
    /// Creates the columns of a search's space from the span of each choice of each variable.
    #[must_use]
    pub(in crate::search) fn new<S: Scalars<Number = N>>(
        s: &S,
        question: &Question,
        layout: &RowLayout<'_>,
        spans: &[Vec<Spans<N>>],
    ) -> WrittenOut<N> {
        let of_choice = |joints: &[JointId], spans: &Spans<N>| {
            let each = spans.iter().zip(joints);
            each.flat_map(|(span, &j)| span.iter().map(move |t| layout.joint_column(s, j, t)))
                .collect()
        };
        let of_variable = |(v, choices): (&Variable, &Vec<Spans<N>>)| {
            let columns = choices.iter().map(|spans| of_choice(&v.joints, spans));
            columns.collect()
        };
        let variables = question.space.variables.iter();
        WrittenOut {
            rows: layout.row_counts(),
            columns: variables.zip(spans).map(of_variable).collect(),
        }
    }

    /// Returns the columns of each choice of a variable.
    pub(in crate::search) fn choices_of(&self, variable: usize) -> &[Vec<Vec<N>>] {
        &self.columns[variable]
    }

    /// Returns the columns of every choice, one after another.
    pub(in crate::search) fn all_columns(&self) -> impl Iterator<Item = &Vec<N>> {
        self.columns.iter().flatten().flatten()
    }

    /// Returns the columns of a variant.
    pub(crate) fn variant_columns<'a>(
        &'a self,
        choices: &'a [usize],
    ) -> impl Iterator<Item = &'a Vec<N>> {
        let chosen = choices.iter().enumerate();
        chosen.flat_map(|(v, &c)| &self.columns[v][c])
    }
}
