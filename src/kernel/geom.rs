//! Exact geometry: expressions with roots and rational-degree cosines, their images in a prime field, and their number
//! field. A mechanism is evaluated in one of two number systems: residues modulo a prime (exact) or `f64` (measured).

pub mod exact;
pub mod expr;
pub mod extent;
pub mod number_field;
pub mod rigid;
pub mod vector;

use crate::geom::exact::radical::ExactError;
use crate::geom::expr::Expr;
use crate::geom::extent::Extent;
use std::fmt::Debug;

/// A commutative ring in which expressions can be evaluated. Division is deliberately missing, because joint frames do
/// not need it.
pub trait Scalars: Sync {
    /// A number.
    type Number: Clone + PartialEq + Debug + Default + Send + Sync;

    /// Returns the value of an expression.
    ///
    /// # Errors
    /// Returns an error if the number system has no such value.
    fn eval(&self, expr: &Expr) -> Result<Self::Number, ExactError>;
    /// Returns the sum.
    fn add(&self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// Returns the difference.
    fn sub(&self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// Returns the product.
    fn mul(&self, a: Self::Number, b: Self::Number) -> Self::Number;

    /// Returns true if `x` is zero within this number system; `square` is the square of the reference size.
    fn vanishes(&self, x: Self::Number, square: Self::Number) -> bool {
        let _ = square;
        x == Self::Number::default()
    }

    /// Returns the position and size of a set of points, or `None` if numbers have no size.
    fn extent(&self, _points: &[&[Expr; 3]]) -> Option<Extent> {
        None
    }

    /// Returns the value of a vector of expressions.
    ///
    /// # Errors
    /// Returns an error in the same cases as [`Scalars::eval`].
    fn eval3(&self, v: &[Expr; 3]) -> Result<[Self::Number; 3], ExactError> {
        Ok([self.eval(&v[0])?, self.eval(&v[1])?, self.eval(&v[2])?])
    }

    /// Returns the scalar product.
    fn dot(&self, a: [Self::Number; 3], b: [Self::Number; 3]) -> Self::Number {
        let [a0, a1, a2] = a;
        let [b0, b1, b2] = b;
        let s = self.add(self.mul(a0, b0), self.mul(a1, b1));
        self.add(s, self.mul(a2, b2))
    }

    /// Returns the vector product.
    fn cross(&self, a: [Self::Number; 3], b: [Self::Number; 3]) -> [Self::Number; 3] {
        let product = |i: usize, j: usize| self.mul(a[i].clone(), b[j].clone());
        let minor = |i: usize, j: usize| self.sub(product(i, j), product(j, i));
        [minor(1, 2), minor(2, 0), minor(0, 1)]
    }

    /// Returns `s·a + b`.
    fn scaled_sum(
        &self,
        s: Self::Number,
        a: [Self::Number; 3],
        b: [Self::Number; 3],
    ) -> [Self::Number; 3] {
        let [b0, b1, b2] = b;
        let [a0, a1, a2] = a.map(|x| self.mul(s.clone(), x));
        [self.add(a0, b0), self.add(a1, b1), self.add(a2, b2)]
    }
}

/// Real numbers in double precision.
#[derive(Debug, Clone, Copy, Default)]
pub struct Reals;

impl Scalars for Reals {
    type Number = f64;

    fn eval(&self, expr: &Expr) -> Result<f64, ExactError> {
        Ok(expr.to_f64())
    }
    fn add(&self, a: f64, b: f64) -> f64 {
        a + b
    }
    fn sub(&self, a: f64, b: f64) -> f64 {
        a - b
    }
    fn mul(&self, a: f64, b: f64) -> f64 {
        a * b
    }
    fn extent(&self, points: &[&[Expr; 3]]) -> Option<Extent> {
        let values: Vec<[f64; 3]> = points
            .iter()
            .map(|p| [p[0].to_f64(), p[1].to_f64(), p[2].to_f64()])
            .collect();
        Some(Extent::from_points(&values))
    }

    fn vanishes(&self, x: f64, square: f64) -> bool {
        x * x <= 1e-20 * square
    }
}
