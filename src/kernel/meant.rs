//! What measured geometry means: the scene with the most relations among those that move no number by more than its digits allow.
//!
//! Directions first: parallel ones as one, each refined by the points that are square to it or along it, then made exact in a frame
//! of the scene's own. Points then: what lies in planes and on lines along those directions, coincides, or is equal as a vector is
//! solved together by least squares, each relation taken only if all still hold, and at last exactly over the rationals.

mod caution;
mod check;
mod consensus;
mod directions;
mod exact_directions;
mod frame;
pub mod mechanism;
pub(crate) mod number;
mod of_points;
mod projection;
pub(crate) mod relations;
pub mod resolve;
mod row;
pub mod scene;
mod solve;
mod stage;
mod symmetry;
mod together;
pub mod written;
