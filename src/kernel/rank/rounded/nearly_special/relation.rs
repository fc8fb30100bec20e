//! Maximum deviation of a joint from a special position, and the kind of that position.

use crate::format::significant;
use crate::model::mechanism::{JointId, Mechanism};
use itertools::Itertools;

/// Maximum deviation of a joint from a special position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Deviation of its point or line, in the file's unit of length.
    pub length: f64,
    /// Deviation of its axes `[rad]`.
    pub angle: f64,
}

impl Reach {
    /// Returns a reach relative to the size of a mechanism: radians, and fractions of the size.
    #[must_use]
    pub fn relative(tolerance: f64, size: f64) -> Reach {
        Reach {
            length: tolerance * size,
            angle: tolerance,
        }
    }
}

/// Special position of a joint, relative to another joint if there is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// A coordinate is almost zero.
    Zero,
    /// Its axis is parallel to another, or to a global axis.
    Parallel,
    /// Its axis is perpendicular to another.
    Square,
    /// Its axis is in one plane with two others.
    InPlane,
    /// Its axis is the same line as another.
    Coaxial,
    /// Its axis or centre passes through a common point with another.
    Meeting,
    /// Its centre is the same point as another.
    Concentric,
}

/// A joint that is nearly special.
#[derive(Debug, Clone, PartialEq)]
pub struct NearJoint {
    /// The joint.
    pub joint: JointId,
    /// Deviation of its line or centre, in the file's unit of length.
    pub shift: f64,
    /// Deviation of its axes `[rad]`.
    pub turn: f64,
    /// The special positions, and the joints they refer to.
    pub relations: Vec<(Relation, Option<JointId>)>,
}

impl NearJoint {
    /// Returns the deviation: "0.002 degrees and 0.13 mm".
    #[must_use]
    pub fn far(&self, m: &Mechanism) -> String {
        let turn = (self.turn > 0.0).then(|| format!("{} degrees", small(self.turn.to_degrees())));
        let shift =
            (self.shift > 0.0).then(|| format!("{} {}", small(self.shift), m.length_unit.symbol));
        turn.into_iter().chain(shift).join(" and ")
    }
}

/// Returns a small figure to two digits.
fn small(x: f64) -> String {
    if (1e-4..1e4).contains(&x) {
        significant(x)
    } else {
        format!("{x:.1e}")
    }
}
