//! Recovers the intended geometry from rounded coordinates: the scene with the most relations within the rounding of
//! every number.
//!
//! Directions come first. Parallel ones are merged, and each is refined by the points that lie along it or in planes
//! perpendicular to it. Then they are made exact in the scene's own frame.
//!
//! Points follow. Points in planes and on lines along those directions, coincident points and equal vectors are solved
//! together by least squares. Each relation is accepted only if all accepted ones still hold. At the end they are
//! solved exactly over the rationals.

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

use crate::meant::number::Rational3;
use crate::meant::relations::RelationKind;

/// A recovered scene.
#[derive(Debug, Clone)]
pub struct MeantScene {
    /// Its points, exact, in the file's frame.
    pub points: Vec<Rational3>,
    /// Its directions, exact, of any length.
    pub rays: Vec<Rational3>,
    /// For each ray, the index of its direction; parallel rays share one.
    pub cluster: Vec<usize>,
    /// The independent relations accepted, with the points of each.
    pub relations: Vec<(RelationKind, Vec<usize>)>,
    /// The largest move of a coordinate, in halves of its last digit.
    pub moved: f64,
}
