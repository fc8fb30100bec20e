//! Masses and inertias of shapes filled evenly.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, dot, sub};
use crate::robots::convert::payload::{Solid, Weight};
use std::f64::consts::PI;

/// Volume in m³, and moments of inertia about x, y and z of a solid of 1 kg; none where a file would have to be read, or where
/// there is no end.
pub(crate) fn filled(solid: &Solid) -> Option<(f64, Vector)> {
    let round = |r: f64, l: f64| {
        let (across, along) = ((3.0 * r * r + l * l) / 12.0, r * r / 2.0);
        [across, across, along]
    };
    Some(match *solid {
        Solid::Box([x, y, z]) => {
            let pair = |a: f64, b: f64| (a * a + b * b) / 12.0;
            (x * y * z, [pair(y, z), pair(x, z), pair(x, y)])
        }
        Solid::Sphere(r) => (4.0 / 3.0 * PI * r.powi(3), [0.4 * r * r; 3]),
        Solid::Cylinder(r, l) => (PI * r * r * l, round(r, l)),
        Solid::Capsule(r, l) => {
            let (ends, middle) = (4.0 / 3.0 * PI * r.powi(3), PI * r * r * l);
            let whole = ends + middle;
            let (e, m) = (ends / whole, middle / whole);
            let [across, _, along] = round(r, l);
            // Half balls, each about the end of the cylinder.
            let far = 0.4 * r * r + l * l / 4.0 + 3.0 * l * r / 8.0;
            let across = m * across + e * far;
            (whole, [across, across, m * along + e * 0.4 * r * r])
        }
        Solid::Ellipsoid([a, b, c]) => {
            let pair = |a: f64, b: f64| (a * a + b * b) / 5.0;
            (
                4.0 / 3.0 * PI * a * b * c,
                [pair(b, c), pair(a, c), pair(a, b)],
            )
        }
        Solid::Plane(_) | Solid::Mesh(..) => return None,
    })
}

/// A tensor as a matrix, by rows.
fn matrix([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [Vector; 3] {
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// A tensor in the axes that a place has, seen from outside.
pub(crate) fn turned(tensor: [f64; 6], place: &RigidMotion) -> [f64; 6] {
    let r = &place.rotation;
    let half = r.map(|row| {
        let m = matrix(tensor);
        [0, 1, 2].map(|j| dot(row, m.map(|line| line[j])))
    });
    let at = |i: usize, j: usize| dot(half[i], r[j]);
    [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)]
}

/// Several weights as one, in the axes of the frame that they are given in; none of nothing.
pub(crate) fn together(all: &[Weight]) -> Option<Weight> {
    let mass: f64 = all.iter().map(|w| w.mass).sum();
    if mass <= 0.0 {
        return None;
    }
    let mean = |i: usize| {
        all.iter()
            .map(|w| w.mass * w.place.translation[i])
            .sum::<f64>()
            / mass
    };
    let centre = [mean(0), mean(1), mean(2)];
    let mut tensor = [0.0; 6];
    for w in all {
        let [x, y, z] = sub(w.place.translation, centre);
        let own = turned(w.tensor, &w.place);
        let far = [
            y * y + z * z,
            x * x + z * z,
            x * x + y * y,
            -x * y,
            -x * z,
            -y * z,
        ];
        for (t, (o, f)) in tensor.iter_mut().zip(own.iter().zip(far)) {
            *t += o + w.mass * f;
        }
    }
    let place = RigidMotion::shift(centre);
    Some(Weight {
        mass,
        place,
        tensor,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::vector::{X, Z};

    /// Moments by adding up small cubes, all that the formulas are not.
    fn added_up(inside: impl Fn(Vector) -> bool) -> (f64, Vector) {
        const N: i32 = 120;
        let step = 2.0 / f64::from(N);
        let (mut volume, mut moments) = (0.0, [0.0; 3]);
        for i in 0..N * N * N {
            let at = [i % N, i / N % N, i / N / N];
            let [x, y, z] = at.map(|k| -1.0 + step * (f64::from(k) + 0.5));
            if inside([x, y, z]) {
                volume += step.powi(3);
                for (m, d) in moments
                    .iter_mut()
                    .zip([y * y + z * z, x * x + z * z, x * x + y * y])
                {
                    *m += step.powi(3) * d;
                }
            }
        }
        (volume, moments.map(|m| m / volume))
    }

    #[test]
    fn solids_weigh_what_small_cubes_do() {
        let (r, l) = (0.4, 0.9);
        for (solid, inside) in [
            (
                Solid::Box([0.8, 1.2, 1.6]),
                Box::new(|[x, y, z]: Vector| x.abs() < 0.4 && y.abs() < 0.6 && z.abs() < 0.8)
                    as Box<dyn Fn(Vector) -> bool>,
            ),
            (Solid::Sphere(0.7), Box::new(|p| dot(p, p) < 0.49)),
            (
                Solid::Cylinder(r, l),
                Box::new(move |[x, y, z]| x * x + y * y < r * r && z.abs() < l / 2.0),
            ),
            (
                Solid::Capsule(r, l),
                Box::new(move |[x, y, z]| {
                    let past = (z.abs() - l / 2.0).max(0.0);
                    x * x + y * y + past * past < r * r
                }),
            ),
            (
                Solid::Ellipsoid([0.5, 0.7, 0.9]),
                Box::new(|[x, y, z]| {
                    (x / 0.5).powi(2) + (y / 0.7).powi(2) + (z / 0.9).powi(2) < 1.0
                }),
            ),
        ] {
            let (volume, moments) = filled(&solid).unwrap_or_default();
            let (slow, added) = added_up(inside);
            assert!(
                (volume / slow - 1.0).abs() < 0.02,
                "{solid:?}: {volume} {slow}"
            );
            for (m, a) in moments.iter().zip(added) {
                assert!((m / a - 1.0).abs() < 0.03, "{solid:?}: {m} {a}");
            }
        }
    }

    // Two points of 1 kg on x, a metre apart, each in axes of its own: as one they resist about y and z alone.
    #[test]
    fn weights_add_up() {
        let end = |x: f64| Weight {
            mass: 1.0,
            place: RigidMotion::shift([x, 0.0, 0.0]).then(&RigidMotion::turn(Z, x)),
            tensor: [0.0; 6],
        };
        let whole = together(&[end(0.0), end(1.0)]);
        let found = whole.map(|w| (w.mass, w.place.translation, w.tensor));
        let tensor = [0.0, 0.5, 0.5, 0.0, 0.0, 0.0];
        assert_eq!(found, Some((2.0, [0.5, 0.0, 0.0], tensor)));
        let quarter = RigidMotion::turn(X, std::f64::consts::FRAC_PI_2);
        let turned = turned([1.0, 2.0, 3.0, 0.0, 0.0, 0.0], &quarter);
        assert_eq!(turned, [1.0, 3.0, 2.0, 0.0, 0.0, 0.0]);
        assert_eq!(together(&[]), None);
    }
}
