//! The symmetry stated in a file: joints that are mirror images of each other, or map to each other by half a turn.
//!
//! A stated symmetry is not a guess, so its relations come before all others. They are also accepted only if the digits
//! allow them.

use super::directions::{Direction, Directions};
use super::number::Rational3;
use super::relations::{Normals, Relation, RelationKind};
use super::solve::PointEquation;
use super::written::{SPREAD, WrittenSymmetry};
use crate::geom::vector::{Vector, add, add_scaled, cross, dot, length, sub, unit};
use num_bigint::BigInt;
use num_rational::BigRational;

/// Distance of images, in errors, below which they do not determine a direction.
const FAR: f64 = 30.0;
/// Accuracy limit of a direction in doubles `[rad]`.
const LEAST: f64 = 1e-15;

impl WrittenSymmetry {
    /// Returns the normal of the plane, or the axis of the half turn, with its error `[rad]`. Returns `None` if images
    /// are too close to each other.
    fn own_direction(&self, points: &[Vector], errors: &[f64]) -> Option<(Vector, f64)> {
        let apart = self.points.iter().filter_map(|&[a, b]| {
            let (w, error) = (sub(points[b], points[a]), errors[a] + errors[b]);
            (length(w) > FAR * error).then_some((w, SPREAD * error))
        });
        let mut apart: Vec<(Vector, f64)> = apart.collect();
        apart.sort_by(|a, b| length(b.0).total_cmp(&length(a.0)));
        let &(first, error) = apart.first()?;
        if self.turned {
            // Images by half a turn differ by a vector perpendicular to its axis.
            let other = |w: &Vector| length(cross(first, *w)) / length(first);
            let second = apart
                .iter()
                .max_by(|a, b| other(&a.0).total_cmp(&other(&b.0)))?;
            let width = other(&second.0);
            let off = error / length(first) + second.1 / width;
            return (width > FAR * second.1).then(|| (unit(cross(first, second.0)), off));
        }
        // Long differences are the most accurate.
        let sum = apart.iter().fold([0.0; 3], |sum, (w, e)| {
            add_scaled(sum, dot(first, *w).signum() / (e * e), *w)
        });
        Some((unit(sum), error / length(first)))
    }

    /// Returns the image of a direction.
    fn image_of_direction(&self, n: Vector, v: Vector) -> Vector {
        let along = n.map(|x| 2.0 * dot(n, v) * x);
        if self.turned {
            sub(along, v)
        } else {
            sub(v, along)
        }
    }

    /// Adds its own direction if no ray has it, and makes directions exact images if they are within their errors.
    /// Returns the index of the added direction.
    pub(super) fn apply_to(
        &self,
        of: &mut Directions,
        points: &[Vector],
        errors: &[f64],
    ) -> Option<usize> {
        let (n, error) = self.own_direction(points, errors)?;
        let near = |d: &Direction| length(cross(d.unit, n)) <= 1.05 * (d.error + error);
        let at = of.all.iter().position(near).unwrap_or_else(|| {
            of.all.push(Direction::of_points(n, error));
            of.all.len() - 1
        });
        let n = of.all[at].unit;
        for (a, b) in self.image_pairs(of) {
            let (v, w) = (of.all[a].unit, self.image_of_direction(n, of.all[b].unit));
            let [x, y] = [a, b].map(|k| of.all[k].error.max(LEAST).powi(-2));
            let exact = of.all[a].exact.is_some() || of.all[b].exact.is_some();
            if !exact && length(cross(v, w)) <= of.all[a].error + of.all[b].error + error {
                let sign = dot(v, w).signum();
                let middle = unit(add(v.map(|c| x * c), w.map(|c| sign * y * c)));
                of.all[a].unit = middle;
                of.all[b].unit = self.image_of_direction(n, middle);
            }
        }
        Some(at)
    }

    /// Returns directions that are images of each other and distinct.
    pub(super) fn image_pairs(&self, of: &Directions) -> Vec<(usize, usize)> {
        let each = |&[r, s]: &[usize; 2]| (of.of_ray[r].0, of.of_ray[s].0);
        let mut out: Vec<(usize, usize)> = self.rays.iter().map(each).collect();
        out.retain(|(a, b)| a != b);
        out.sort_unstable();
        out.dedup();
        out
    }

    /// Returns the exact image of an exact direction.
    pub(super) fn image_exactly(&self, n: &Rational3, v: &Rational3) -> Rational3 {
        let dot = |a: &Rational3, b: &Rational3| &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2];
        let two = BigRational::from_integer(BigInt::from(2));
        let by = two * dot(n, v) / dot(n, n);
        let sign = BigRational::from_integer(BigInt::from(if self.turned { -1 } else { 1 }));
        [0, 1, 2].map(|k| (&v[k] - &by * &n[k]) * &sign)
    }

    /// Returns its relations for its own exact direction.
    pub(super) fn image_relations(
        &self,
        own: &Rational3,
        points: &[Vector],
        normals: &mut Normals,
    ) -> Vec<Relation> {
        let (along, across) = (normals.index(own.clone()), normals.square_to(own));
        let apart = |p: &[usize; 2]| length(sub(points[p[0]], points[p[1]]));
        let longest = self
            .points
            .iter()
            .max_by(|a, b| apart(a).total_cmp(&apart(b)));
        let Some(&first) = longest else {
            return Vec::new();
        };
        // Images differ along the normal of a mirror, or perpendicular to an axis. Their middles are in the plane, or
        // on the axis.
        let (difference, middle) = if self.turned {
            (vec![along], across.to_vec())
        } else {
            (across.to_vec(), vec![along])
        };
        let mut out = Vec::new();
        for &[a, b] in &self.points {
            let [p, q] = first;
            let differences = difference.iter();
            let differences = differences.map(|&n| PointEquation::sum(&[(a, 1), (b, -1)], n));
            let middles = middle.iter();
            let middles =
                middles.map(|&n| PointEquation::sum(&[(a, 1), (b, 1), (p, -1), (q, -1)], n));
            for row in differences.chain(middles).filter(|r| !r.terms.is_empty()) {
                out.push(Relation::new(RelationKind::Mirrored, vec![row], 0.0));
            }
        }
        out
    }
}
