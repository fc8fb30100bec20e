//! The side that a kinematic scheme is seen from, where one is asked for.

use crate::geom::vector::Vector;

/// From where a kinematic scheme is looked at, as far as that is asked for; the rest is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sight {
    /// The direction from the mechanism to the reader, of any length but zero.
    pub toward: Option<Vector>,
    /// What goes up on paper, as far as it is not the direction looked in; z where it is not stated.
    pub up: Option<Vector>,
}
