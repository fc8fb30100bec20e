//! How a link with mass moves, and its inertia force.

use crate::statics::inertia::LinkInertia;
use serde::Serialize;

/// Acceleration and inertia of a link.
#[derive(Debug, Serialize)]
pub struct LinkMotion<'a> {
    /// The link.
    pub link: &'a str,
    /// Its mass centre `[m]`.
    pub centre: [f64; 2],
    /// Of the mass centre `[m/s²]`.
    pub acceleration: [f64; 2],
    /// `[rad/s²]`
    pub angular_acceleration: f64,
    /// `[N]`
    pub inertia_force: [f64; 2],
    /// `[N·m]`
    pub inertia_moment: f64,
    /// How far aside of the centre the force alone does both `[m]`.
    pub offset: f64,
}

impl<'a> LinkMotion<'a> {
    /// That of a link of this name.
    #[must_use]
    pub fn new(link: &'a str, i: &LinkInertia) -> Self {
        LinkMotion {
            link,
            centre: i.centre,
            acceleration: i.acceleration,
            angular_acceleration: i.angular_acceleration,
            inertia_force: i.force,
            inertia_moment: i.moment,
            offset: i.offset(),
        }
    }
}
