//! The arms of a gripper's levers as functions of one of their parameters, with the others constant: the figures of the
//! paper, for any gripper.

use crate::grip::clamping::gripper_for;
use crate::grip::lever_arm::{Arms, Lever};
use crate::model::grip::GripSpec;

/// Number of points of a curve.
pub const POINTS: u32 = 121;

/// The parameter that is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Varied {
    /// L, from 0.4 to 1.6 of the stated value: fig. 2.
    LeverLength,
    /// α, from 60° to 140°, extended to the stated value: fig. 4.
    PrismAngle,
    /// γ, from 0° to 40°, extended to the stated value: fig. 5.
    MountingAngle,
}

impl Varied {
    /// All parameters.
    pub const ALL: [Varied; 3] = [
        Varied::LeverLength,
        Varied::PrismAngle,
        Varied::MountingAngle,
    ];

    /// Returns the range. `[m]` or `[rad]`
    fn value_range(self, spec: &GripSpec) -> [f64; 2] {
        let round = |from: f64, to: f64, own: f64| {
            let (from, to) = (from.to_radians(), to.to_radians());
            [from.min(own), to.max(own)]
        };
        match self {
            Varied::LeverLength => [0.4, 1.6].map(|x| x * spec.lever_length),
            Varied::PrismAngle => round(60.0, 140.0, spec.prism_angle),
            Varied::MountingAngle => round(0.0, 40.0, spec.mounting_angle),
        }
    }
}

/// Value of the parameter `[m]` or `[rad]`, with the arms if such a gripper can hold the part.
pub type Point = (f64, Option<Arms>);

/// Returns the arms on a part of a diameter, at [`POINTS`] equally spaced values.
///
/// # Units
/// `[m]`, `[rad]`.
///
/// # Sources
/// `[Pavlenko & Godunko 2010]` figs. 2, 4 and 5: combinations that cannot hold the part do not count.
#[must_use]
pub fn arm_curve(spec: &GripSpec, varied: Varied, diameter: f64) -> Vec<Point> {
    let [from, to] = varied.value_range(spec);
    let at = |i: u32| {
        let x = from + (to - from) * f64::from(i) / f64::from(POINTS - 1);
        let (mut l, mut a, mut g) = (spec.lever_length, spec.prism_angle, spec.mounting_angle);
        match varied {
            Varied::LeverLength => l = x,
            Varied::PrismAngle => a = x,
            Varied::MountingAngle => g = x,
        }
        let lever = Lever::new(l, a, g).ok();
        let held = lever.filter(|&l| {
            gripper_for(spec, l, diameter)
                .find_obstacles(diameter)
                .is_empty()
        });
        (x, held.map(|l| l.force_arms(diameter)))
    };
    (0..POINTS).map(at).collect()
}
