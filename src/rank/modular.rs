//! Rank over a prime field.

use crate::closure::matrix::Closure;
use crate::geom::exact::ExactField;
use crate::linalg::echelon;
use crate::linalg::modp::Residue;

/// Rank of J over the field, exact unless the prime divides a minor.
///
/// # Complexity
/// O(f · rank · 6k) field operations.
#[must_use]
pub fn rank(exact: &ExactField, closure: &Closure<Residue>) -> usize {
    let columns = closure.dense(exact);
    echelon::rank(exact.field(), columns.iter().map(Vec::as_slice))
}
