//! Recovers the intended geometry from rounded coordinates: the scene with the most relations within the rounding of
//! every number.
//!
//! Directions come first. Parallel ones are merged, and each is refined by the points that lie along it or in planes
//! perpendicular to it. Then they are made exact in the scene's own frame.
//!
//! Points follow. Points in planes and on lines along those directions, coincident points and equal vectors are solved
//! together by least squares. Each relation is accepted only if all accepted ones still hold. At the end they are
//! solved exactly over the rationals.
//!
//! Whether relations hold exactly is tested modulo a prime. A relation that holds only by rounding fails this test.

mod consensus;
mod directions;
mod exact_directions;
mod frame;
pub mod mechanism;
pub(crate) mod number;
mod of_points;
mod projection;
pub(crate) mod relations;
pub mod resolve;
mod solve;
mod stage;
mod symmetry;
mod together;
pub mod written;

use crate::meant::number::Rational3;
use crate::meant::relations::RelationKind;
use crate::meant::solve::PointEquation;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// A recovered scene.
#[derive(Debug, Clone)]
pub struct MeantScene {
    /// Its points, exact, in the file's frame.
    pub points: Vec<Rational3>,
    /// The points in the scene's own frame.
    pub(crate) inside: Vec<Rational3>,
    /// Its directions, exact, of any length.
    pub rays: Vec<Rational3>,
    /// For each ray, the index of its direction; parallel rays share one.
    pub cluster: Vec<usize>,
    /// The independent relations accepted, with the points of each.
    pub relations: Vec<(RelationKind, Vec<usize>)>,
    /// The largest move of a coordinate, in halves of its last digit.
    pub moved: f64,
}

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
pub(crate) struct Images {
    points: Vec<[u128; 3]>,
    normals: Vec<[u128; 3]>,
}

impl Images {
    pub(crate) fn of(points: &[Rational3], normals: &[Rational3]) -> Images {
        let all = |v: &[Rational3]| v.iter().map(|x| x.each_ref().map(image)).collect();
        Images {
            points: all(points),
            normals: all(normals),
        }
    }

    /// Returns true if a row holds. A row that does not may appear to hold once in 10^18.
    pub(crate) fn holds(&self, row: &PointEquation) -> bool {
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
