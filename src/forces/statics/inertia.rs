//! How links move and what their inertia does: accelerations, inertia forces and moments, by D'Alembert.

use crate::statics::planar::BodyId;
use crate::statics::planar_motion::Instant;
use crate::statics::pose::{Linkage, length};
use crate::statics::{rounding, without};
use serde::Serialize;

/// Mass data of a body in the plane: mass `[kg]`, centre at the pose of the file `[m]`, inertia `[kg·m²]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMass {
    /// Mass `[kg]`.
    pub mass: f64,
    /// Mass centre at the pose of the file `[m]`.
    pub centre: [f64; 2],
    /// Inertia about the mass centre and the plane's normal `[kg·m²]`.
    pub inertia: f64,
}

/// A link with mass at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LinkInertia {
    /// The link.
    #[serde(skip)]
    pub body: BodyId,
    /// Its mass centre now `[m]`.
    pub centre: [f64; 2],
    /// Acceleration of the mass centre `[m/s²]`.
    pub acceleration: [f64; 2],
    /// Angular acceleration `[rad/s²]`.
    pub angular_acceleration: f64,
    /// -m a, at the mass centre `[N]`.
    #[serde(rename = "inertia_force")]
    pub force: [f64; 2],
    /// -I ε `[N·m]`.
    #[serde(rename = "inertia_moment")]
    pub moment: f64,
}

impl LinkInertia {
    /// h_и, how far aside of the mass centre the inertia force alone does what force and moment do `[m]`; not finite where
    /// the mass centre has no acceleration.
    ///
    /// # Sources
    /// `[Bychkov, Dvornikov & Zhukov 2018]`, who offset the force by it.
    #[must_use]
    pub fn offset(&self) -> f64 {
        self.moment / length(self.force)
    }
}

/// The links with mass at an instant, the frame left out; `masses` by body.
#[must_use]
pub fn link_inertias(
    masses: &[Option<BodyMass>],
    linkage: &Linkage,
    now: &Instant,
) -> Vec<LinkInertia> {
    // Accelerations are sums of terms as great as the squares of the speeds, lengths in the mechanism's size.
    let size = linkage.size;
    let fastest = |v: &[f64; 3]| v[2].abs().max(v[0].abs().max(v[1].abs()) / size);
    let fastest = now.velocity.iter().map(fastest).fold(0.0, f64::max);
    let rounding = rounding(0.0, fastest * fastest, 3 * masses.len());
    let bodies = masses.iter().enumerate();
    let one = |(body, mass): (usize, &Option<BodyMass>)| {
        let mass = mass.filter(|_| body != linkage.mechanism.frame)?;
        let (pose, v, a) = (&now.pose, &now.velocity, &now.acceleration);
        let acceleration = linkage.acceleration(pose, v, a, body, mass.centre);
        let acceleration = acceleration.map(|a| without(rounding * size, a));
        let angular_acceleration = without(rounding, a[body][2]);
        Some(LinkInertia {
            body,
            centre: linkage.point(pose, body, mass.centre),
            acceleration,
            angular_acceleration,
            // From 0, so that 0 has no sign.
            force: acceleration.map(|a| 0.0 - a * mass.mass),
            moment: 0.0 - mass.inertia * angular_acceleration,
        })
    };
    bodies.filter_map(one).collect()
}
