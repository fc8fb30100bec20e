//! How well coordinates are known, and what stops a motion whatever their errors do.

use crate::motion::pose::Pose;
use crate::rank::finite::tangent_cone::{Flat, Quadrics};

/// How well the coordinates of a mechanism are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Coordinates {
    /// Every digit holds.
    Exact,
    /// To a relative error: higher orders are not asked then, since rounding alone would stop a motion, and poses are followed to
    /// within the error.
    Within(f64),
    /// Exact as they are meant, by relations of points and directions; to this relative error beside. Equal lengths and angles may
    /// be lost, so what stops a motion counts only where an error so large cannot make it.
    Meant(f64),
}

/// Errors of coordinates times this do not make up what stops a motion.
const CLEARLY: f64 = 100.0;

/// Whether so many of the instantaneous motions are stopped to second order by self-stresses, by more than coordinates with this
/// relative error can do: one where they do any work, all where they let none pass.
pub(in crate::rank) fn is_less(
    pose: &Pose,
    instantaneous: usize,
    by: usize,
    accuracy: f64,
) -> bool {
    let pose = pose.clone().with_accuracy(CLEARLY * accuracy);
    let work = Quadrics::new(&pose, &Flat::new(&pose, Some(instantaneous)));
    (by == 1 && !work.vanish()) || (by == instantaneous && work.is_definite())
}
