//! Rank by elimination in rational arithmetic: slow, simple, and independent of every prime.

use num_rational::BigRational;
use num_traits::Zero;
use std::collections::BTreeMap;

use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::certificate::{closure_matrix, number_field};
use crate::rank::method::{Answer, Certainty, MobilityMethod, NoAnswer, RankOfJ};
use crate::verify::matrix::MatrixOverRing;

/// Returns the rank of a matrix of rational numbers, or `None` if an entry is not rational.
///
/// Rows are sparse. Each pivot is the shortest number in the row with the fewest entries.
///
/// # Complexity
/// O(rank · rows · columns) operations on fractions whose length may grow in proportion to the rank.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::exact::{certificate, rational::rational_rank}};
/// let bennett = ozols::built_in("bennett")?;
/// let field = certificate::number_field(&bennett, StateId::FREE)?;
/// let j = certificate::closure_matrix(&field, &bennett, StateId::FREE)?;
/// assert_eq!(rational_rank(&j), Some(3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn rational_rank(matrix: &MatrixOverRing) -> Option<usize> {
    let mut rows: Vec<BTreeMap<usize, BigRational>> = vec![BTreeMap::new(); matrix.rows()];
    for (row, column, entry) in matrix.entries() {
        rows[row].insert(column, entry.as_rational()?);
    }
    let mut rank = 0;
    loop {
        rows.retain(|row| !row.is_empty());
        let Some(shortest) = (0..rows.len()).min_by_key(|&r| rows[r].len()) else {
            return Some(rank);
        };
        let pivot_row = rows.swap_remove(shortest);
        let size = |q: &BigRational| q.numer().bits() + q.denom().bits();
        let Some((&column, pivot)) = pivot_row.iter().min_by_key(|(_, q)| size(q)) else {
            continue;
        };
        rank += 1;
        for row in &mut rows {
            let Some(factor) = row.get(&column).map(|x| x / pivot) else {
                continue;
            };
            for (&c, y) in &pivot_row {
                let x = row.entry(c).or_default();
                *x -= &factor * y;
                if x.is_zero() {
                    row.remove(&c);
                }
            }
        }
    }
}

/// [`rank`] as a method.
pub(crate) const RATIONAL: MobilityMethod = MobilityMethod {
    name: "rational",
    title: "exact rational elimination",
    help: "Exact elimination in fractions (rational coordinates only)",
    guarantee: "exact at this pose; rational coordinates only",
    complexity: "O(rank · 6k · f) operations on growing fractions",
    source: "Gauss; von zur Gathen & Gerhard, Modern Computer Algebra, 2013, ch. 5",
    rank: RankOfJ::NotFound,
    answer: answer_rational,
};

fn answer_rational(mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
    let field = number_field(mechanism, state)
        .map_err(|_| NoAnswer::DoesNotApply("coordinates are not rational"))?;
    let matrix = closure_matrix(&field, mechanism, state)?;
    let rank =
        rational_rank(&matrix).ok_or(NoAnswer::DoesNotApply("coordinates are not rational"))?;
    Ok(Answer::at_pose(matrix.columns(), rank, Certainty::Exact))
}
