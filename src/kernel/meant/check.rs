//! Whether relations hold exactly, looked at modulo a prime: what only rounding makes hold does not.

use super::number::Rational3;
use super::row::PointEquation;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// 2^61 - 1.
const PRIME: u128 = (1 << 61) - 1;

fn power(mut x: u128, mut n: u128) -> u128 {
    let mut out = 1;
    while n > 0 {
        if n & 1 == 1 {
            out = out * x % PRIME;
        }
        x = x * x % PRIME;
        n >>= 1;
    }
    out
}

fn image(x: &BigRational) -> u128 {
    let of = |n: &BigInt| n.mod_floor(&BigInt::from(PRIME)).to_u128().unwrap_or(0);
    of(x.numer()) * power(of(x.denom()), PRIME - 2) % PRIME
}

/// Points and normals modulo a prime.
pub(super) struct Images {
    points: Vec<[u128; 3]>,
    normals: Vec<[u128; 3]>,
}

impl Images {
    pub(super) fn of(points: &[Rational3], normals: &[Rational3]) -> Images {
        let all = |v: &[Rational3]| v.iter().map(|x| x.each_ref().map(image)).collect();
        Images {
            points: all(points),
            normals: all(normals),
        }
    }

    /// Whether a row holds; one that does not may seem to once in 10^18.
    pub(super) fn holds(&self, row: &PointEquation) -> bool {
        let n = &self.normals[row.normal];
        let sum = row.terms.iter().fold(0, |sum: u128, &(p, c)| {
            let by = (0..3).fold(0, |s, k| (s + n[k] * self.points[p][k]) % PRIME);
            let times = u128::from(c.unsigned_abs()) * by % PRIME;
            (sum + if c < 0 { PRIME - times } else { times }) % PRIME
        });
        sum == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirds_that_add_up_hold_and_decimals_of_them_do_not() {
        let at = |n: i64, d: i64| {
            let x = BigRational::new(n.into(), d.into());
            let zero = BigRational::from_integer(0.into());
            [x, zero.clone(), zero]
        };
        let row = PointEquation {
            terms: vec![(0, 3), (1, -1)],
            normal: 0,
        };
        let holds = |x| Images::of(&[x, at(1, 1)], &[at(1, 1)]).holds(&row);
        assert!(holds(at(1, 3)) && !holds(at(333_333, 1_000_000)));
    }
}
