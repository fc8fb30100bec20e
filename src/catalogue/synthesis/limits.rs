//! What a layout must be like to be taken, and what it is to do.

use crate::synthesis::task::Task;

/// What a layout must be like to be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The longest link over the shortest, the frame left out.
    pub ratio: f64,
    /// The worst transmission angle of a rod, in degrees.
    pub transmission: f64,
    /// Crossings of links, and pins that lie on links that they are no part of, where no planes are known in which links pass each
    /// other.
    pub crossings: usize,
    /// What it is to do.
    pub task: Task,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            ratio: 8.0,
            transmission: 15.0,
            crossings: 6,
            task: Task::default(),
        }
    }
}

/// How far a number is beyond a limit, squared, in units of a width.
pub(super) fn beyond(over: f64, width: f64) -> f64 {
    (over.max(0.0) / width).powi(2)
}
