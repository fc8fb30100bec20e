//! Half and third turns: whether joints grouped in a file map to each other when space turns about one axis.

use crate::closure::symmetry_image::{Carrier, Map, Spot};
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::exact_vector::{ExactVector, cross, sub};
use crate::geom::vector::{self, Vector, dot, length, real};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism};

/// A fraction of a full turn about an axis.
#[derive(Debug, Clone)]
pub(crate) struct Turn {
    /// Two or three points that it maps to each other; their middle is on the axis.
    round: Vec<ExactVector>,
    axis: ExactVector,
    /// The middle and the direction of the axis, in numbers.
    centre: Vector,
    along: Vector,
}

/// A direction, exact and in numbers.
type Direction = (ExactVector, Vector);

fn numbered(direction: ExactVector) -> Direction {
    let numbers = real(&direction);
    (direction, numbers)
}

/// The directions of each joint's frame in a mechanism, along which axes of turns may lie.
pub(crate) struct FrameDirections(Vec<[Direction; 3]>);

impl FrameDirections {
    #[must_use]
    pub(crate) fn of(mechanism: &Mechanism) -> FrameDirections {
        let of = |j: JointId| {
            let frame = &mechanism.joints[j].frame;
            let [z, x] = [&frame.axis, &frame.reference];
            [z.clone(), x.clone(), cross(z, x)].map(numbered)
        };
        FrameDirections(mechanism.joint_ids().map(of).collect())
    }
}

impl Turn {
    /// Returns the turns that groups of joints suggest. Three points determine the turn. Two points determine only the
    /// middle. The axis is then along a direction of their joints, between or across these, or along a direction of a
    /// joint that is its own image.
    #[must_use]
    pub(crate) fn of_groups(
        mechanism: &Mechanism,
        FrameDirections(directions): &FrameDirections,
        groups: &[Vec<JointId>],
    ) -> Vec<Turn> {
        let frame = |j: &JointId| &mechanism.joints[*j].frame;
        let directions = |j: JointId| directions[j.index()].iter().cloned();
        let alone = mechanism.joint_ids();
        let alone = alone.filter(|j| !groups.iter().any(|g| g.contains(j)));
        let mut out = Vec::new();
        for group in groups {
            let round: Vec<ExactVector> = group.iter().map(|j| frame(j).point.clone()).collect();
            let axes: Vec<Direction> = match &round[..] {
                [a, b, c] => vec![numbered(cross(&sub(b, a), &sub(c, a)))],
                _ => {
                    let [z, w] = [0, 1].map(|i| &frame(&group[i]).axis);
                    let between = [[0, 1, 2].map(|i| &z[i] + &w[i]), sub(z, w)].map(numbered);
                    let own = directions(group[0]).chain(between);
                    own.chain(alone.clone().flat_map(directions)).collect()
                }
            };
            #[allow(clippy::cast_precision_loss, reason = "two or three")]
            let count = round.len() as f64;
            let points: Vec<Vector> = round.iter().map(real).collect();
            let centre = [0, 1, 2].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / count);
            // Joints of a plane share their directions.
            let mut known: Vec<Vector> = Vec::new();
            for (axis, along) in axes {
                if length(along) == 0.0 || known.contains(&along) {
                    continue;
                }
                known.push(along);
                out.push(Turn {
                    round: round.clone(),
                    axis,
                    centre,
                    along: vector::unit(along),
                });
            }
        }
        out
    }
}

impl Carrier for Turn {
    fn image(&self, spot: Spot) -> Spot {
        let (centre, n) = (self.centre, self.along);
        #[allow(clippy::cast_precision_loss, reason = "two or three")]
        let count = self.round.len() as f64;
        let (sine, cosine) = (std::f64::consts::TAU / count).sin_cos();
        let turn = |v: Vector| {
            let (across, along) = (vector::cross(n, v), dot(n, v));
            [0, 1, 2].map(|i| cosine * v[i] + sine * across[i] + (1.0 - cosine) * along * n[i])
        };
        let arm = turn([0, 1, 2].map(|i| spot.point[i] - centre[i]));
        Spot {
            point: [0, 1, 2].map(|i| centre[i] + arm[i]),
            axis: turn(spot.axis),
        }
    }

    fn map(&self, exact: &ExactField) -> Result<Option<Map>, ExactError> {
        let f = exact.field();
        let n = exact.eval3(&self.axis)?;
        let square = exact.dot(n, n);
        let mut centre = [f.zero(); 3];
        let mut points = Vec::new();
        for p in &self.round {
            let p = exact.eval3(p)?;
            centre = [0, 1, 2].map(|i| f.add(centre[i], p[i]));
            points.push(p);
        }
        let number = |x: i64| f.from_i64(x);
        let third = points.len() == 3;
        let part = f.inv(number(if third { 3 } else { 2 }));
        let centre = centre.map(|x| f.mul(part, x));
        let half = f.inv(number(2));
        // v cos + n × v sin / |n| + n (n·v) (1 - cos) / |n|²; for an equilateral triangle, sin / |n| is 1 / side².
        let (cosine, sine, rest) = if third {
            let side = [0, 1, 2].map(|i| f.sub(points[1][i], points[0][i]));
            let side = exact.dot(side, side);
            let quarters = f.mul(number(3), f.mul(side, side));
            if f.mul(number(4), square) != quarters {
                return Ok(None);
            }
            (f.neg(half), f.inv(side), f.mul(number(3), half))
        } else {
            (number(-1), f.zero(), number(2))
        };
        let rest = f.mul(rest, f.inv(square));
        let linear = |v: [Residue; 3]| {
            let (across, along) = (exact.cross(n, v), f.mul(rest, exact.dot(n, v)));
            [0, 1, 2].map(|i| {
                let turned = f.add(f.mul(cosine, v[i]), f.mul(sine, across[i]));
                f.add(turned, f.mul(along, n[i]))
            })
        };
        let moved = linear(centre);
        let shift = [0, 1, 2].map(|i| f.sub(centre[i], moved[i]));
        Ok(Some(Map::new(f, linear, shift, false)))
    }
}
