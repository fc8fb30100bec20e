//! Exact geometry: expressions with roots and rational-degree cosines, their images in a prime field, the number field they lie in, and
//! the number systems a mechanism is evaluated in: residues modulo a prime (exact), `f64` (measured).

pub mod exact;
pub(crate) mod exact_vector;
pub mod expr;
pub mod extent;
pub mod number_field;
pub mod rigid;
pub mod vector;

use crate::geom::exact::{ExactError, ExactField};
use crate::geom::expr::Expr;
use crate::geom::extent::Extent;
use crate::linalg::modp::Residue;
use std::fmt::Debug;

/// A commutative ring that expressions can be evaluated in. Division is left out on purpose: joint frames need none.
pub trait Scalars: Sync {
    /// A number.
    type Number: Clone + PartialEq + Debug + Default + Send + Sync;

    /// The value of an expression.
    ///
    /// # Errors
    /// Where the number system has no such value.
    fn eval(&self, expr: &Expr) -> Result<Self::Number, ExactError>;
    /// Sum.
    fn add(&self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// Difference.
    fn sub(&self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// Product.
    fn mul(&self, a: Self::Number, b: Self::Number) -> Self::Number;

    /// Whether `x` is zero as far as this number system can tell, where `square` is the square of what it would be
    /// measured against.
    fn vanishes(&self, x: Self::Number, square: Self::Number) -> bool {
        let _ = square;
        x == Self::Number::default()
    }

    /// Where some points are and how large the set is; none where numbers have no size.
    fn extent(&self, _points: &[&[Expr; 3]]) -> Option<Extent> {
        None
    }

    /// The value of a vector of expressions.
    ///
    /// # Errors
    /// As [`Scalars::eval`].
    fn eval3(&self, v: &[Expr; 3]) -> Result<[Self::Number; 3], ExactError> {
        Ok([self.eval(&v[0])?, self.eval(&v[1])?, self.eval(&v[2])?])
    }

    /// Scalar product.
    fn dot(&self, a: [Self::Number; 3], b: [Self::Number; 3]) -> Self::Number {
        let [a0, a1, a2] = a;
        let [b0, b1, b2] = b;
        let s = self.add(self.mul(a0, b0), self.mul(a1, b1));
        self.add(s, self.mul(a2, b2))
    }

    /// Vector product.
    fn cross(&self, a: [Self::Number; 3], b: [Self::Number; 3]) -> [Self::Number; 3] {
        let product = |i: usize, j: usize| self.mul(a[i].clone(), b[j].clone());
        let minor = |i: usize, j: usize| self.sub(product(i, j), product(j, i));
        [minor(1, 2), minor(2, 0), minor(0, 1)]
    }

    /// `s·a + b`.
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

impl Scalars for ExactField {
    type Number = Residue;

    fn eval(&self, expr: &Expr) -> Result<Residue, ExactError> {
        ExactField::eval(self, expr)
    }
    #[inline]
    fn add(&self, a: Residue, b: Residue) -> Residue {
        self.field().add(a, b)
    }
    #[inline]
    fn sub(&self, a: Residue, b: Residue) -> Residue {
        self.field().sub(a, b)
    }
    #[inline]
    fn mul(&self, a: Residue, b: Residue) -> Residue {
        self.field().mul(a, b)
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
        Some(Extent::of(&values))
    }

    fn vanishes(&self, x: f64, square: f64) -> bool {
        x * x <= 1e-20 * square
    }
}
