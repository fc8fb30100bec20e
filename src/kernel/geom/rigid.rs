//! Rigid motions of space: displacements of a body, or the position of a frame in another.

use crate::geom::vector::{Vector, X, Y, Z, across, add, cross, dot, length, scale};

/// A twist (ω; v): angular velocity, then the velocity of the point at the origin.
pub type Twist<N = f64> = [N; 6];

/// Returns angular velocity and velocity of a twist, or moment and force of a wrench.
#[must_use]
pub fn split_twist<N: Clone>(t: &[N]) -> ([N; 3], [N; 3]) {
    let three = |from: usize| std::array::from_fn(|i| t[from + i].clone());
    (three(0), three(3))
}

/// Returns the twist of an angular velocity and a velocity.
#[must_use]
pub fn join_twist<N>([a, b, c]: [N; 3], [d, e, f]: [N; 3]) -> Twist<N> {
    [a, b, c, d, e, f]
}

/// A rotation followed by a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion {
    /// The rotation matrix, by rows.
    pub rotation: [Vector; 3],
    /// The image of the origin.
    pub translation: Vector,
}

impl RigidMotion {
    /// The identity.
    pub const IDENTITY: RigidMotion = RigidMotion {
        rotation: [X, Y, Z],
        translation: [0.0; 3],
    };

    /// Returns a translation without rotation.
    #[must_use]
    pub fn from_translation(translation: Vector) -> RigidMotion {
        RigidMotion {
            translation,
            ..RigidMotion::IDENTITY
        }
    }

    /// Returns the rotation about an axis of any length through the origin `[rad]`; quarter turns are exact.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::rigid::RigidMotion;
    /// use ozols::geom::vector::{X, Y, Z};
    /// let quarter = RigidMotion::from_turn(Z, std::f64::consts::FRAC_PI_2);
    /// assert_eq!(quarter.map_point(X), Y);
    /// ```
    #[must_use]
    pub fn from_turn(axis: Vector, angle: f64) -> RigidMotion {
        let exact = |x: f64| {
            if (x - x.round()).abs() < 1e-15 {
                x.round()
            } else {
                x
            }
        };
        let (sine, cosine) = angle.sin_cos();
        RigidMotion {
            rotation: rotation_matrix(unit_or_z(axis), exact(sine), exact(cosine)),
            translation: [0.0; 3],
        }
    }

    /// Returns the rotation by fixed-axis roll, pitch and yaw, as in URDF and SDF: Rz(yaw)·Ry(pitch)·Rx(roll), and a
    /// translation.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::rigid::RigidMotion;
    /// use ozols::geom::vector::{X, Y};
    /// let half_pi = std::f64::consts::FRAC_PI_2;
    /// let yawed = RigidMotion::roll_pitch_yaw([5.0, 0.0, 0.0], [0.0, 0.0, half_pi]);
    /// assert_eq!(yawed.map_direction(X), Y);
    /// assert_eq!(yawed.map_point([0.0; 3]), [5.0, 0.0, 0.0]);
    /// ```
    #[must_use]
    pub fn roll_pitch_yaw(translation: Vector, angles: Vector) -> RigidMotion {
        let turns = [X, Y, Z].into_iter().zip(angles);
        let turned = turns.fold(RigidMotion::IDENTITY, |m, (axis, angle)| {
            RigidMotion::from_turn(axis, angle).then(&m)
        });
        RigidMotion {
            translation,
            ..turned
        }
    }

    /// Returns the rotation by a quaternion w, x, y, z of any nonzero length, and a translation.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::rigid::RigidMotion;
    /// // Any nonzero length: (0, 0, 0, 2) is half a turn about z.
    /// let half = RigidMotion::from_quaternion([0.0; 3], [0.0, 0.0, 0.0, 2.0]);
    /// assert_eq!(half.map_point([1.0, 0.0, 0.0]), [-1.0, 0.0, 0.0]);
    /// ```
    #[must_use]
    pub fn from_quaternion(translation: Vector, q: [f64; 4]) -> RigidMotion {
        let n = dot(q, q);
        let [w, x, y, z] = q;
        let s = if n > 0.0 { 2.0 / n } else { 0.0 };
        let rotation = [
            [
                1.0 - s * (y * y + z * z),
                s * (x * y - w * z),
                s * (x * z + w * y),
            ],
            [
                s * (x * y + w * z),
                1.0 - s * (x * x + z * z),
                s * (y * z - w * x),
            ],
            [
                s * (x * z - w * y),
                s * (y * z + w * x),
                1.0 - s * (x * x + y * y),
            ],
        ];
        RigidMotion {
            rotation,
            translation,
        }
    }

    /// Returns the smallest rotation that takes z to an axis.
    #[must_use]
    pub fn z_to(axis: Vector) -> RigidMotion {
        let to = unit_or_z(axis);
        let about = cross(Z, to);
        if length(about) < 1e-12 {
            return if dot(to, Z) > 0.0 {
                RigidMotion::IDENTITY
            } else {
                RigidMotion::from_turn(X, std::f64::consts::PI)
            };
        }
        RigidMotion::from_turn(about, length(about).atan2(dot(Z, to)))
    }

    /// Returns the exponential of a unit twist (unit angular velocity, or none) times `q`.
    ///
    /// # Sources
    /// Lynch & Park, "Modern Robotics", 2017, proposition 3.25.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::rigid::RigidMotion;
    /// // A turn about z through (1, 0, 0): its linear part is the speed at the origin.
    /// let turn = [0.0, 0.0, 1.0, 0.0, -1.0, 0.0];
    /// let moved = RigidMotion::exp(&turn, std::f64::consts::PI).map_point([0.0; 3]);
    /// assert!((moved[0] - 2.0).abs() < 1e-12 && moved[1].abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn exp(twist: &Twist, q: f64) -> RigidMotion {
        let (w, v) = split_twist(twist);
        if w == [0.0; 3] {
            return RigidMotion::from_translation(scale(v, q));
        }
        let (sine, cosine) = q.sin_cos();
        let rotation = rotation_matrix(w, sine, cosine);
        // (I - R)(ω × v) + ω (ω·v) q
        let u = cross(w, v);
        let along = dot(w, v) * q;
        RigidMotion {
            rotation,
            translation: [0, 1, 2].map(|i| u[i] - dot(rotation[i], u) + w[i] * along),
        }
    }

    /// Returns the product self·inner: a position within the frame moved by this motion, or this motion after another
    /// in fixed axes.
    #[must_use]
    pub fn then(&self, inner: &RigidMotion) -> RigidMotion {
        let column = |j: usize| inner.rotation.map(|row| row[j]);
        let columns = [column(0), column(1), column(2)];
        RigidMotion {
            rotation: self.rotation.map(|row| columns.map(|c| dot(row, c))),
            translation: self.map_point(inner.translation),
        }
    }

    /// Returns the inverse motion.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::rigid::RigidMotion;
    /// let turned = RigidMotion::from_quaternion([1.0, 2.0, 3.0], [1.0, 1.0, 0.0, 0.0]);
    /// let back = turned.then(&turned.inverse()).translation;
    /// assert!(back.iter().all(|x| x.abs() < 1e-12));
    /// ```
    #[must_use]
    pub fn inverse(&self) -> RigidMotion {
        let r = &self.rotation;
        let back = RigidMotion {
            rotation: [0, 1, 2].map(|j| r.map(|row| row[j])),
            translation: [0.0; 3],
        };
        RigidMotion {
            translation: scale(back.map_direction(self.translation), -1.0),
            ..back
        }
    }

    /// Returns the image of a point.
    #[must_use]
    pub fn map_point(&self, p: Vector) -> Vector {
        add(self.map_direction(p), self.translation)
    }

    /// Returns the image of a direction.
    #[must_use]
    pub fn map_direction(&self, d: Vector) -> Vector {
        self.rotation.map(|row| dot(row, d))
    }

    /// Returns the image of a twist.
    #[must_use]
    pub fn map_twist(&self, t: &Twist) -> Twist {
        let (w, v) = split_twist(t);
        let w = self.map_direction(w);
        let (v, m) = (self.map_direction(v), cross(self.translation, w));
        join_twist(w, add(v, m))
    }

    /// Returns the rotation axis times the sine of the angle.
    #[must_use]
    pub fn sine(&self) -> Vector {
        let r = &self.rotation;
        let twice = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
        twice.map(|x| x / 2.0)
    }

    /// Returns the cosine of the rotation angle.
    #[must_use]
    pub fn cosine(&self) -> f64 {
        let r = &self.rotation;
        (r[0][0] + r[1][1] + r[2][2] - 1.0) / 2.0
    }

    /// Returns the rotation angle `[rad]`, 0 to π.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::rigid::RigidMotion;
    /// let turn = RigidMotion::from_turn([0.0, 0.0, 2.0], 1.2);
    /// assert!((turn.angle() - 1.2).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn angle(&self) -> f64 {
        length(self.sine()).atan2(self.cosine())
    }

    /// Returns the rotation vector: the axis times the angle `[rad]`, at most π.
    #[must_use]
    pub fn rotation_vector(&self) -> Vector {
        let axis = self.sine();
        let s = length(axis);
        if s > 1e-9 {
            return scale(axis, self.angle() / s);
        }
        if self.cosine() > 0.0 {
            return axis;
        }
        // Half a turn: the columns of R + 1 are parallel to the axis.
        let column = |j: usize| {
            let mut v = self.rotation.map(|row| row[j]);
            v[j] += 1.0;
            v
        };
        let longest = (0..3)
            .map(column)
            .max_by(|a, b| length(*a).total_cmp(&length(*b)))
            .unwrap_or(Z);
        scale(unit_or_z(longest), std::f64::consts::PI)
    }
}

/// Returns the unit vector, or z if there is none.
#[must_use]
pub fn unit_or_z(a: Vector) -> Vector {
    let l = length(a);
    if l > 0.0 && l.is_finite() {
        scale(a, 1.0 / l)
    } else {
        Z
    }
}

/// Returns a direction perpendicular to an axis: the first of x, y, z that is not parallel to it, made perpendicular.
#[must_use]
pub fn perpendicular(axis: Vector) -> Vector {
    let z = unit_or_z(axis);
    let first = [X, Y, Z]
        .into_iter()
        .find(|g| dot(*g, z).abs() < 0.9)
        .unwrap_or(X);
    unit_or_z(across(first, z))
}

/// Returns the rotation about a unit vector (Rodrigues).
fn rotation_matrix([x, y, z]: Vector, s: f64, c: f64) -> [Vector; 3] {
    let t = 1.0 - c;
    [
        [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
        [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
        [t * x * z - s * y, t * y * z + s * x, t * z * z + c],
    ]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::geom::vector::{sub, unit};
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn vector() -> impl Strategy<Value = Vector> {
        [-2.0..2.0, -2.0..2.0, -2.0..2.0]
    }

    fn motion() -> impl Strategy<Value = RigidMotion> {
        (vector(), [-1.0..1.0, -1.0..1.0, -1.0..1.0, 0.1..1.0f64])
            .prop_map(|(at, q)| RigidMotion::from_quaternion(at, q))
    }

    /// Returns the largest difference of two motions.
    fn apart(a: &RigidMotion, b: &RigidMotion) -> f64 {
        let rows = a.rotation.iter().zip(b.rotation);
        rows.map(|(a, b)| length(sub(*a, b)))
            .fold(length(sub(a.translation, b.translation)), f64::max)
    }

    proptest! {
        #[test]
        fn products_are_associative(a in motion(), b in motion(), c in motion()) {
            prop_assert!(apart(&a.then(&b).then(&c), &a.then(&b.then(&c))) < 1e-13);
        }

        #[test]
        fn a_motion_and_its_inverse_cancel(a in motion()) {
            prop_assert!(apart(&a.then(&a.inverse()), &RigidMotion::IDENTITY) < 1e-13);
            prop_assert!(apart(&a.inverse().then(&a), &RigidMotion::IDENTITY) < 1e-13);
        }

        #[test]
        fn lengths_angles_and_handedness_stay(a in motion(), u in vector(), v in vector()) {
            let [x, y] = [u, v].map(|d| a.map_direction(d));
            prop_assert!((dot(x, y) - dot(u, v)).abs() < 1e-13);
            prop_assert!(length(sub(cross(x, y), a.map_direction(cross(u, v)))) < 1e-12);
        }

        #[test]
        fn turns_about_one_axis_add_up(axis in vector(), at in vector(), a in -3.0..3.0, b in -3.0..3.0) {
            prop_assume!(length(axis) > 0.1);
            let (w, v) = (unit(axis), cross(at, unit(axis)));
            let twist = [w[0], w[1], w[2], v[0] + 0.3 * w[0], v[1] + 0.3 * w[1], v[2] + 0.3 * w[2]];
            let product = RigidMotion::exp(&twist, a).then(&RigidMotion::exp(&twist, b));
            prop_assert!(apart(&product, &RigidMotion::exp(&twist, a + b)) < 1e-12);
        }

        #[test]
        fn a_carried_twist_generates_the_carried_motion(a in motion(), axis in vector(), v in vector(), q in -3.0..3.0) {
            prop_assume!(length(axis) > 0.1);
            let w = unit(axis);
            let twist = [w[0], w[1], w[2], v[0], v[1], v[2]];
            let carried = a.then(&RigidMotion::exp(&twist, q)).then(&a.inverse());
            prop_assert!(apart(&carried, &RigidMotion::exp(&a.map_twist(&twist), q)) < 1e-12);
        }

        #[test]
        fn the_rotation_vector_gives_the_turn_back(axis in vector(), angle in 0.001..3.1) {
            prop_assume!(length(axis) > 0.1);
            let turn = RigidMotion::from_turn(axis, angle);
            prop_assert!((turn.angle() - angle).abs() < 1e-12);
            prop_assert!(length(sub(turn.rotation_vector(), scale(unit(axis), angle))) < 1e-10);
        }

        #[test]
        fn z_goes_to_the_axis(axis in vector()) {
            prop_assume!(length(axis) > 0.1);
            prop_assert!(length(sub(RigidMotion::z_to(axis).map_direction(Z), unit(axis))) < 1e-9);
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        let p = RigidMotion::roll_pitch_yaw([1.0, 2.0, 3.0], [FRAC_PI_2, 0.0, 0.0]);
        assert_eq!(p.map_direction(Z), [0.0, -1.0, 0.0]);
        assert_eq!(p.map_point([0.0, 0.1, 0.0]), [1.0, 2.0, 3.1]);
    }

    #[test]
    fn roll_comes_first() {
        let p = RigidMotion::roll_pitch_yaw([0.0; 3], [FRAC_PI_2, 0.0, FRAC_PI_2]);
        // The roll takes y to z; the yaw leaves it there.
        assert_eq!(p.map_direction(Y), Z);
        assert_eq!(p.map_direction(X), Y);
    }

    #[test]
    fn half_a_turn_has_its_axis() {
        for axis in [X, Y, unit([1.0, -2.0, 0.5])] {
            let v = RigidMotion::from_turn(axis, PI).rotation_vector();
            assert!(length(cross(v, axis)) < 1e-9 && (length(v) - PI).abs() < 1e-9);
        }
    }
}
