//! Vectors of exact numbers.

use crate::geom::expr::Expr;

/// An exact vector in space.
pub(crate) type ExactVector = [Expr; 3];

/// Returns the scalar product.
#[must_use]
pub(crate) fn dot(a: &ExactVector, b: &ExactVector) -> Expr {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

/// Returns the vector product.
#[must_use]
pub(crate) fn cross(a: &ExactVector, b: &ExactVector) -> ExactVector {
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// Returns `a - b`.
#[must_use]
pub(crate) fn sub(a: &ExactVector, b: &ExactVector) -> ExactVector {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

/// Returns `a + s·b`.
#[must_use]
pub(crate) fn add_scaled(a: &ExactVector, s: &Expr, b: &ExactVector) -> ExactVector {
    [0, 1, 2].map(|i| &a[i] + &(s * &b[i]))
}

/// Returns `v` without its part along `along`, times `along²`, so that no division is needed.
#[must_use]
pub(crate) fn across(v: &ExactVector, along: &ExactVector) -> ExactVector {
    let (square, part) = (dot(along, along), -&dot(v, along));
    add_scaled(&v.each_ref().map(|x| x * &square), &part, along)
}

/// Returns true if a vector is zero. Irrational vectors are compared to within 256 bits.
#[must_use]
pub(crate) fn is_zero(v: &ExactVector) -> bool {
    v.iter()
        .all(|x| x.is_zero_rational() || (x.rational_ref().is_none() && x.to_f64() == 0.0))
}

/// Returns the point of a line through `on` along `along` that is nearest to `point`, or `None` if `along` cannot be
/// distinguished from zero.
#[must_use]
pub(crate) fn foot(
    point: &ExactVector,
    on: &ExactVector,
    along: &ExactVector,
) -> Option<ExactVector> {
    let t = dot(&sub(point, on), along).div(&dot(along, along))?;
    Some(add_scaled(on, &t, along))
}
