//! Mirror images: whether the joints paired in a file are images of each other in one plane, and their deviations.

use crate::closure::symmetry_image::{Carrier, Map, Miss, Spot};
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::exact_vector::{ExactVector, cross, sub};
use crate::geom::vector::{Vector, dot, length, real};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{Frame, JointId, Mechanism};

/// A plane, given by two points that are images of each other.
#[derive(Debug, Clone)]
pub struct Plane {
    one: ExactVector,
    other: ExactVector,
    /// Its normal, in numbers, and a point in the plane.
    normal: Vector,
    middle: Vector,
}

impl Plane {
    fn new(one: ExactVector, other: ExactVector) -> Plane {
        let (a, b) = (real(&one), real(&other));
        Plane {
            normal: [0, 1, 2].map(|i| b[i] - a[i]),
            middle: [0, 1, 2].map(|i| f64::midpoint(a[i], b[i])),
            one,
            other,
        }
    }

    /// Returns the planes in which a pair of joints may be images. The plane lies midway between their points. If the
    /// points coincide, it is perpendicular to a direction of the first joint or lies between the two axes. It may also
    /// pass through a third point that is its own image.
    fn candidates(one: &Frame, other: &Frame, own: &[&ExactVector]) -> Vec<Plane> {
        let [p, q] = [&one.point, &other.point];
        if real(p) != real(q) {
            return vec![Plane::new(p.clone(), q.clone())];
        }
        let [z, x, w] = [&one.axis, &one.reference, &other.axis];
        let sum = |u: &ExactVector, v: &ExactVector| [0, 1, 2].map(|i| &u[i] + &v[i]);
        let mut normals = vec![z.clone(), x.clone(), cross(z, x), sub(z, w), sum(z, w)];
        normals.extend(own.iter().map(|o| cross(z, &sub(o, p))));
        normals.retain(|n| length(real(n)) > 0.0);
        let plane = |n: &ExactVector| Plane::new(sub(p, n), sum(p, n));
        normals.iter().map(plane).collect()
    }

    /// Returns the planes in which the pairs may be images, the most likely first, with the deviation of every pair.
    /// The pairs themselves suggest the planes, which are ranked by most of the pairs, and then by all joints if these
    /// agree.
    #[must_use]
    pub fn of_pairs(
        mechanism: &Mechanism,
        pairs: &[(JointId, JointId)],
    ) -> Vec<(Plane, Vec<Miss>)> {
        Plane::among(mechanism, &Spot::of_joints(mechanism), pairs)
    }

    /// Returns the planes for joints with known positions, as `of_pairs` does for a mechanism.
    pub(crate) fn among(
        mechanism: &Mechanism,
        spots: &[Spot],
        pairs: &[(JointId, JointId)],
    ) -> Vec<(Plane, Vec<Miss>)> {
        let frame = |j: JointId| &mechanism.joints[j].frame;
        let point = |j: JointId| &frame(j).point;
        let at_one_point = |&&(a, b): &&_| real(point(a)) == real(point(b));
        let own = pairs.iter().filter(at_one_point);
        let own: Vec<_> = own.map(|p| point(p.0)).collect();
        let planes = pairs
            .iter()
            .flat_map(|&(a, b)| Plane::candidates(frame(a), frame(b), &own));
        let paired = |j: JointId| pairs.iter().any(|&(a, b)| j == a || j == b);
        let alone: Vec<JointId> = mechanism.joint_ids().filter(|&j| !paired(j)).collect();
        let spot = |j: JointId| spots[j.index()];
        let judged = planes.map(|plane| {
            let miss =
                |a: JointId, b| plane.miss(spot(a), &mechanism.joints[a].joint_type, spot(b));
            let misses: Vec<Miss> = pairs.iter().map(|&(a, b)| miss(a, b)).collect();
            let mut off: Vec<f64> = misses.iter().map(Miss::size).collect();
            off.sort_by(f64::total_cmp);
            // The median comes first, because one wrong pair must not choose the plane.
            let all =
                off.iter().sum::<f64>() + alone.iter().map(|&j| miss(j, j).size()).sum::<f64>();
            let key = (off[off.len() / 2], all);
            (key, (plane, misses))
        });
        let mut judged: Vec<_> = judged.collect();
        judged.sort_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        judged.into_iter().map(|(_, plane)| plane).collect()
    }
}

impl Carrier for Plane {
    fn image(&self, spot: Spot) -> Spot {
        let (n, middle) = (self.normal, self.middle);
        let nn = dot(n, n);
        let reflect = |v: Vector| {
            let by = 2.0 * dot(v, n) / nn;
            [0, 1, 2].map(|i| v[i] - by * n[i])
        };
        let image = reflect([0, 1, 2].map(|i| spot.point[i] - middle[i]));
        Spot {
            point: [0, 1, 2].map(|i| image[i] + middle[i]),
            axis: reflect(spot.axis),
        }
    }

    fn map(&self, exact: &ExactField) -> Result<Option<Map>, ExactError> {
        let f = exact.field();
        let (a, b) = (exact.eval3(&self.one)?, exact.eval3(&self.other)?);
        let n = [0, 1, 2].map(|i| f.sub(b[i], a[i]));
        let scale = f.inv(exact.dot(n, n));
        let linear = |v: [Residue; 3]| {
            let by = f.mul(scale, exact.dot(v, n));
            let by = f.add(by, by);
            [0, 1, 2].map(|i| f.sub(v[i], f.mul(by, n[i])))
        };
        let sum = [0, 1, 2].map(|i| f.add(a[i], b[i]));
        let far = f.mul(scale, exact.dot(sum, n));
        Ok(Some(Map::new(f, linear, n.map(|x| f.mul(far, x)), true)))
    }
}
