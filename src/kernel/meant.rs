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

use crate::linalg::modp::{Field, Residue};
use crate::meant::number::Rational3;
use crate::meant::relations::RelationKind;
use crate::meant::solve::PointEquation;
use num_rational::BigRational;

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

/// Points and normals modulo a prime.
pub(crate) struct Images {
    field: Field,
    points: Vec<[Residue; 3]>,
    normals: Vec<[Residue; 3]>,
}

impl Images {
    pub(crate) fn from_scene(points: &[Rational3], normals: &[Rational3]) -> Images {
        let field = Field::new((1 << 61) - 1);
        let image = |x: &BigRational| field.from_rational(x).unwrap_or(0);
        let all = |v: &[Rational3]| v.iter().map(|x| x.each_ref().map(image)).collect();
        Images {
            field,
            points: all(points),
            normals: all(normals),
        }
    }

    /// Returns true if a row holds. A row that does not may appear to hold once in 10^18.
    pub(crate) fn row_holds(&self, row: &PointEquation) -> bool {
        let n = &self.normals[row.normal];
        let along = |&(p, c): &(usize, i32)| {
            let times = self.field.from_i64(c.into());
            (times, self.field.dot(n, &self.points[p]))
        };
        self.field.sum_of_products(row.terms.iter().map(along)) == 0
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
        let holds = |x| Images::from_scene(&[x, at(1, 1)], &[at(1, 1)]).row_holds(&row);
        assert!(holds(at(1, 3)) && !holds(at(333_333, 1_000_000)));
    }
}
