//! Positions and orientations in double precision.

/// A vector.
pub(crate) type V3 = [f64; 3];

/// A rotation matrix, by rows.
pub(crate) type M3 = [[f64; 3]; 3];

/// The identity matrix.
pub(crate) const IDENTITY: M3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The three axes.
pub(crate) const X: V3 = [1.0, 0.0, 0.0];
pub(crate) const Y: V3 = [0.0, 1.0, 0.0];
pub(crate) const Z: V3 = [0.0, 0.0, 1.0];

pub(crate) fn add(a: V3, b: V3) -> V3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn sub(a: V3, b: V3) -> V3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn scale(a: V3, s: f64) -> V3 {
    [a[0] * s, a[1] * s, a[2] * s]
}

pub(crate) fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: V3, b: V3) -> V3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(crate) fn length(a: V3) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector, or z where there is none.
pub(crate) fn unit(a: V3) -> V3 {
    let l = length(a);
    if l > 0.0 && l.is_finite() {
        scale(a, 1.0 / l)
    } else {
        Z
    }
}

/// A unit vector across `axis`: the first of x, y, z that is not parallel to it, made perpendicular.
pub(crate) fn across(axis: V3) -> V3 {
    let z = unit(axis);
    let first = [X, Y, Z]
        .into_iter()
        .find(|g| dot(*g, z).abs() < 0.9)
        .unwrap_or(X);
    unit(sub(first, scale(z, dot(first, z))))
}

fn apply(m: &M3, v: V3) -> V3 {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

fn product(a: &M3, b: &M3) -> M3 {
    let mut out = IDENTITY;
    for (i, row) in out.iter_mut().enumerate() {
        for (j, x) in row.iter_mut().enumerate() {
            *x = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
        }
    }
    out
}

fn transpose(m: &M3) -> M3 {
    [
        [m[0][0], m[1][0], m[2][0]],
        [m[0][1], m[1][1], m[2][1]],
        [m[0][2], m[1][2], m[2][2]],
    ]
}

/// Sine and cosine; values a rounding error away from 0 and 1 are 0 and 1, so that quarter turns stay exact.
fn sin_cos(angle: f64) -> (f64, f64) {
    let (s, c) = angle.sin_cos();
    let exact = |x: f64| {
        if (x - x.round()).abs() < 1e-15 {
            x.round()
        } else {
            x
        }
    };
    (exact(s), exact(c))
}

/// The place of one frame in another: a rotation and the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    pub(super) turn: M3,
    pub(super) at: V3,
}

impl Pose {
    pub(crate) const IDENTITY: Pose = Pose {
        turn: IDENTITY,
        at: [0.0; 3],
    };

    /// A shift without a turn.
    pub(crate) fn shift(at: V3) -> Pose {
        Pose { turn: IDENTITY, at }
    }

    /// The turn by fixed-axis roll, pitch and yaw, as in URDF and SDF: Rz(yaw)·Ry(pitch)·Rx(roll).
    pub(crate) fn roll_pitch_yaw(at: V3, rpy: V3) -> Pose {
        let turn = [X, Y, Z]
            .into_iter()
            .zip(rpy)
            .fold(IDENTITY, |m, (axis, angle)| {
                product(&about(axis, angle), &m)
            });
        Pose { turn, at }
    }

    /// The turn by a quaternion w, x, y, z of any length but zero.
    pub(crate) fn quaternion(at: V3, q: [f64; 4]) -> Pose {
        let n = q.iter().map(|x| x * x).sum::<f64>();
        let [w, x, y, z] = q;
        let s = if n > 0.0 { 2.0 / n } else { 0.0 };
        let turn = [
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
        Pose { turn, at }
    }

    /// The turn about an axis.
    pub(crate) fn turn(axis: V3, angle: f64) -> Pose {
        Pose {
            turn: about(axis, angle),
            at: [0.0; 3],
        }
    }

    /// This place, then another within it.
    pub(crate) fn then(&self, inner: &Pose) -> Pose {
        Pose {
            turn: product(&self.turn, &inner.turn),
            at: self.point(inner.at),
        }
    }

    pub(crate) fn inverse(&self) -> Pose {
        let turn = transpose(&self.turn);
        Pose {
            turn,
            at: scale(apply(&turn, self.at), -1.0),
        }
    }

    /// A point of the inner frame, in the outer one.
    pub(crate) fn point(&self, p: V3) -> V3 {
        add(apply(&self.turn, p), self.at)
    }

    /// A direction of the inner frame, in the outer one.
    pub(crate) fn direction(&self, d: V3) -> V3 {
        apply(&self.turn, d)
    }

    /// The rotation vector: the axis times the angle, at most π.
    pub(crate) fn rotation_vector(&self) -> V3 {
        let m = &self.turn;
        let axis = scale(
            [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]],
            0.5,
        );
        let (s, c) = (length(axis), (m[0][0] + m[1][1] + m[2][2] - 1.0) / 2.0);
        let angle = s.atan2(c);
        if s > 1e-9 {
            return scale(axis, angle / s);
        }
        if c > 0.0 {
            return axis;
        }
        // Half a turn: the columns of R + 1 are parallel to the axis.
        let column = |j: usize| {
            let mut v = [m[0][j], m[1][j], m[2][j]];
            v[j] += 1.0;
            v
        };
        let longest = (0..3)
            .map(column)
            .max_by(|a, b| length(*a).total_cmp(&length(*b)))
            .unwrap_or(Z);
        scale(unit(longest), std::f64::consts::PI)
    }
}

/// The rotation about an axis (Rodrigues).
fn about(axis: V3, angle: f64) -> M3 {
    if angle == 0.0 {
        return IDENTITY;
    }
    let [x, y, z] = unit(axis);
    let (s, c) = sin_cos(angle);
    let t = 1.0 - c;
    [
        [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
        [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
        [t * x * z - s * y, t * y * z + s * x, t * z * z + c],
    ]
}

/// The least turn that takes z to an axis.
pub(crate) fn turn_z_to(axis: V3) -> Pose {
    let to = unit(axis);
    let about = cross(Z, to);
    if length(about) < 1e-12 {
        return if dot(to, Z) > 0.0 {
            Pose::IDENTITY
        } else {
            Pose::turn(X, std::f64::consts::PI)
        };
    }
    Pose::turn(about, length(about).atan2(dot(Z, to)))
}

/// A number as it is written: rounding errors around multiples of 1e-9 are taken off.
pub(crate) fn clean(x: f64) -> f64 {
    let r = (x * 1e9).round() / 1e9;
    let y = if (r - x).abs() < 1e-12 { r } else { x };
    if y == 0.0 { 0.0 } else { y }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn near(a: V3, b: V3) {
        assert!(length(sub(a, b)) < 1e-14, "{a:?} {b:?}");
    }

    #[test]
    fn quarter_turns_are_exact() {
        let q = std::f64::consts::FRAC_PI_2;
        let p = Pose::roll_pitch_yaw([1.0, 2.0, 3.0], [q, 0.0, 0.0]);
        assert_eq!(p.direction(Z), [0.0, -1.0, 0.0]);
        assert_eq!(p.point([0.0, 0.1, 0.0]), [1.0, 2.0, 3.1]);
        near(
            Pose::quaternion([0.0; 3], [1.0, 1.0, 0.0, 0.0]).direction(Z),
            [0.0, -1.0, 0.0],
        );
    }

    #[test]
    fn roll_comes_first() {
        let q = std::f64::consts::FRAC_PI_2;
        let p = Pose::roll_pitch_yaw([0.0; 3], [q, 0.0, q]);
        // y -> z by the roll; the yaw leaves it there.
        assert_eq!(p.direction(Y), Z);
        assert_eq!(p.direction(X), Y);
    }

    #[test]
    fn inverse_and_rotation_vector() {
        for (axis, angle) in [
            (X, 0.3),
            ([1.0, -2.0, 0.5], 2.9),
            (Y, std::f64::consts::PI),
            (Z, 1e-12),
        ] {
            let p = Pose::turn(axis, angle);
            let v = p.rotation_vector();
            assert!((length(v) - angle).abs() < 1e-9);
            near(cross(v, unit(axis)), [0.0; 3]);
            let round = p.then(&p.inverse());
            near(round.direction([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
        }
    }

    #[test]
    fn clean_takes_off_rounding_only() {
        assert_eq!(clean(0.1 + 0.2), 0.3);
        assert_eq!(clean(6.1e-17), 0.0);
        assert_eq!(
            clean(std::f64::consts::FRAC_1_SQRT_2),
            std::f64::consts::FRAC_1_SQRT_2
        );
        assert!(clean(-1e-17).is_sign_positive());
    }
}
