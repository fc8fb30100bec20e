//! Names of directions in exact geometry.

use crate::geom::Scalars;
use crate::geom::exact::ExactField;
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, Mechanism};
use crate::rank::exact::reconstruct::reconstruct_rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

/// A direction with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// Whole numbers without a common divisor, the first nonzero one positive.
    Numbers([i64; 3]),
    /// The direction of a joint's axis.
    AxisOf(JointId),
}

impl Direction {
    /// Returns the name of a direction, in either sense: in small whole numbers, or otherwise by the first joint with
    /// such an axis.
    #[must_use]
    pub fn name_direction(
        exact: &ExactField,
        mechanism: &Mechanism,
        v: [Residue; 3],
    ) -> Option<Direction> {
        let along = |j: &JointId| {
            let axis = exact.eval3(&mechanism.joints[*j].frame.axis);
            axis.is_ok_and(|axis| exact.cross(v, axis) == [0; 3])
        };
        small_numbers(exact.field(), v)
            .map(Direction::Numbers)
            .or_else(|| mechanism.joint_ids().find(along).map(Direction::AxisOf))
    }

    /// Describes the direction, such as "z", "[1, 2, 0]" or "the axis of 1-2".
    #[must_use]
    pub fn describe_direction(self, mechanism: &Mechanism) -> String {
        match self {
            Direction::Numbers([1, 0, 0]) => "x".to_owned(),
            Direction::Numbers([0, 1, 0]) => "y".to_owned(),
            Direction::Numbers([0, 0, 1]) => "z".to_owned(),
            Direction::Numbers([x, y, z]) => format!("[{x}, {y}, {z}]"),
            Direction::AxisOf(joint) => format!("the axis of {}", mechanism.joints[joint].id),
        }
    }
}

/// The largest whole number in a direction's name.
const SIMPLE: i64 = 100;

/// Returns a direction in small whole numbers.
fn small_numbers(f: Field, of: [Residue; 3]) -> Option<[i64; 3]> {
    let first = f.inv(of.into_iter().find(|&x| x != 0)?);
    let modulus = BigInt::from(f.modulus());
    let ratio = |x: Residue| {
        let x = BigInt::from(f.to_u64(f.mul(x, first)));
        let r = reconstruct_rational(&x, &modulus)?;
        let small = |n: &BigInt| n.to_i64().filter(|n| n.abs() <= SIMPLE);
        Some((small(r.numer())?, small(r.denom())?))
    };
    let [a, b, c] = of.map(ratio);
    let parts = [a?, b?, c?];
    let all = parts.iter().fold(1, |l: i64, (_, d)| l.lcm(d));
    let whole = parts.map(|(n, d)| n * (all / d));
    let common = whole.iter().fold(0, |g: i64, n| g.gcd(n));
    Some(whole.map(|n| n / common.max(1)))
}
