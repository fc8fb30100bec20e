//! Rational numbers near doubles, and vectors of them.

use crate::geom::vector::Vector;
use crate::linalg::{common_denominator, whole_over};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

/// A vector of rational numbers.
pub(crate) type Rational3 = [BigRational; 3];

/// Returns the nearest decimal with `places` places to a finite number.
pub(super) fn nearest_decimal(x: f64, places: u32) -> BigRational {
    let Some(exact) = BigRational::from_float(x) else {
        return BigRational::zero();
    };
    let scale = BigInt::from(10).pow(places);
    // Halves round away from zero. Only whole numbers are used, because rational ones are reduced at every step.
    let (numer, denom) = (exact.numer() * &scale * 2, exact.denom());
    let half = if x < 0.0 { -denom } else { denom.clone() };
    BigRational::new((numer + half) / (denom * 2), scale)
}

/// Returns true if two numbers in lowest terms are equal. This compares their parts, without a division.
pub(super) fn is_same(a: &BigRational, b: &BigRational) -> bool {
    a.numer() == b.numer() && a.denom() == b.denom()
}

/// Vectors as whole numbers over one denominator.
#[derive(Debug, Clone)]
pub(super) struct Whole<const N: usize> {
    numer: [[BigInt; 3]; N],
    denom: BigInt,
}

impl<const N: usize> Whole<N> {
    pub(super) fn over_denominator(all: [&Rational3; N]) -> Whole<N> {
        let denom = common_denominator(all.iter().flat_map(|v| v.iter()));
        Whole {
            numer: all.map(|v| v.each_ref().map(|x| whole_over(x, &denom))),
            denom,
        }
    }
}

impl Whole<3> {
    /// Returns the rows as columns.
    pub(super) fn transpose(&self) -> Whole<3> {
        let entry = |i: usize, j: usize| self.numer[j][i].clone();
        Whole {
            numer: [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))),
            denom: self.denom.clone(),
        }
    }

    /// Returns the products of the rows with a vector, reduced once, not after every sum.
    pub(super) fn times(&self, v: &Rational3) -> Rational3 {
        let Whole { numer: [v], denom } = Whole::over_denominator([v]);
        let denom = denom * &self.denom;
        self.numer.each_ref().map(|row| {
            let sum = &row[0] * &v[0] + &row[1] * &v[1] + &row[2] * &v[2];
            BigRational::new(sum, denom.clone())
        })
    }
}

/// Returns the nearest doubles.
pub(super) fn to_f64(v: &Rational3) -> Vector {
    v.each_ref().map(|x| x.to_f64().unwrap_or(f64::NAN))
}

pub(super) fn cross(a: &Rational3, b: &Rational3) -> Rational3 {
    let Whole {
        numer: [a, b],
        denom,
    } = Whole::over_denominator([a, b]);
    let denom = &denom * &denom;
    let minor = |i: usize, j: usize| BigRational::new(&a[i] * &b[j] - &a[j] * &b[i], denom.clone());
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

pub(super) fn is_zero(v: &Rational3) -> bool {
    v.iter().all(Zero::is_zero)
}

pub(super) fn frame_axes() -> [Rational3; 3] {
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|v| v.map(|x| BigRational::from_integer(BigInt::from(x))))
}

/// Returns a direction scaled to a largest component of 1.
pub(super) fn scale_to_one(v: Rational3) -> Rational3 {
    use num_traits::Signed;
    let largest = v.iter().map(Signed::abs).max();
    match largest.filter(|m| !m.is_zero()) {
        Some(m) => v.map(|x| x / &m),
        None => v,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    #[test]
    fn decimals_are_the_nearest() {
        for (x, places, expected) in [
            (0.125, 2, ratio(13, 100)),
            (-0.125, 2, ratio(-13, 100)),
            (0.124, 2, ratio(12, 100)),
            (-7.5e-9, 4, ratio(0, 1)),
            (1.0 / 3.0, 6, ratio(333_333, 1_000_000)),
            (-123.456, 0, ratio(-123, 1)),
        ] {
            assert_eq!(nearest_decimal(x, places), expected, "{x}");
        }
    }

    #[test]
    fn products_are_those_of_rational_numbers() {
        let rows: [Rational3; 3] = [
            [ratio(1, 3), ratio(-2, 7), ratio(0, 1)],
            [ratio(5, 6), ratio(1, 14), ratio(-1, 3)],
            [ratio(2, 1), ratio(0, 1), ratio(9, 10)],
        ];
        let v = [ratio(3, 5), ratio(-7, 11), ratio(1, 2)];
        let whole = Whole::over_denominator(rows.each_ref());
        for (i, x) in whole.times(&v).iter().enumerate() {
            let sum = (0..3).fold(ratio(0, 1), |s, k| s + &rows[i][k] * &v[k]);
            assert!(is_same(x, &sum));
        }
        for (j, x) in whole.transpose().times(&v).iter().enumerate() {
            let sum = (0..3).fold(ratio(0, 1), |s, k| s + &rows[k][j] * &v[k]);
            assert!(is_same(x, &sum));
        }
    }
}
