//! Places as the formats write them.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, X, Y, length, sub};
use crate::robots::mechanism::series_of_single_joints::{escape, number, numbers};

/// Fixed-axis roll, pitch and yaw of a turn.
pub(crate) fn roll_pitch_yaw(m: &RigidMotion) -> Vector {
    let r = &m.rotation;
    let level = r[0][0].hypot(r[1][0]);
    // Below the rounding of the entries any yaw will do, and none is the plainest; above it, leaving it out would turn by as much.
    let yaw = if level > 1e-15 {
        r[1][0].atan2(r[0][0])
    } else {
        0.0
    };
    // The rest of the turn once the yaw is taken off: no digits are lost where the pitch is a quarter turn.
    let (s, c) = yaw.sin_cos();
    let roll = (s * r[0][2] - c * r[1][2]).atan2(c * r[1][1] - s * r[0][1]);
    let pitch = (-r[2][0]).atan2(c * r[0][0] + s * r[1][0]);
    [roll, pitch, yaw]
}

/// A quaternion w, x, y, z of a turn, w not negative.
pub(crate) fn quaternion(m: &RigidMotion) -> [f64; 4] {
    let v = m.rotation_vector();
    let angle = length(v);
    let (s, c) = (angle / 2.0).sin_cos();
    let k = if angle > 0.0 { s / angle } else { 0.0 };
    [c, v[0] * k, v[1] * k, v[2] * k]
}

/// Whether a turn is none but for rounding.
pub(crate) fn is_straight(m: &RigidMotion) -> bool {
    [X, Y]
        .iter()
        .all(|d| length(sub(m.direction(*d), *d)) < 1e-15)
}

/// `xyz="..." rpy="..."`.
pub(crate) fn xyz_rpy(m: &RigidMotion) -> String {
    let at = numbers(m.translation);
    format!("xyz=\"{at}\" rpy=\"{}\"", numbers(roll_pitch_yaw(m)))
}

/// Six numbers of SDF's `<pose>`.
pub(crate) fn pose(m: &RigidMotion) -> String {
    format!("{} {}", numbers(m.translation), numbers(roll_pitch_yaw(m)))
}

/// ` pos="..." xyaxes="..."`, as far as it is not zero: two axes of a turn by a quarter are whole numbers.
pub(crate) fn pos_axes(m: &RigidMotion) -> String {
    let at = match m.translation.map(number) {
        [0.0, 0.0, 0.0] => String::new(),
        at => format!(" pos=\"{}\"", numbers(at)),
    };
    if is_straight(m) {
        return at;
    }
    let [x, y] = [X, Y].map(|d| numbers(m.direction(d)));
    format!("{at} xyaxes=\"{x} {y}\"")
}

/// ` key="value"` for each.
pub(crate) fn attributes(words: &[(String, String)]) -> String {
    let one = |(k, v): &(String, String)| format!(" {k}=\"{}\"", escape(v));
    words.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn apart(a: &RigidMotion, b: &RigidMotion) -> f64 {
        let rows = a.rotation.iter().zip(b.rotation);
        rows.map(|(a, b)| length(sub(*a, b))).fold(0.0, f64::max)
    }

    proptest! {
        #[test]
        fn turns_come_back(roll in -3.2..3.2, lean in -1.0..1.0f64, yaw in -3.2..3.2, near in 0..16i32) {
            // Pitches at, and next to, a quarter turn among them.
            let off = 10f64.powi(-near) * lean;
            for pitch in [lean, std::f64::consts::FRAC_PI_2 + off] {
                let m = RigidMotion::roll_pitch_yaw([0.0; 3], [roll, pitch, yaw]);
                let again = RigidMotion::roll_pitch_yaw([0.0; 3], roll_pitch_yaw(&m));
                prop_assert!(apart(&m, &again) < 1e-14);
                let again = RigidMotion::quaternion([0.0; 3], quaternion(&m));
                prop_assert!(apart(&m, &again) < 1e-7);
            }
        }
    }
}
