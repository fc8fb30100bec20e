//! How far a joint may be from what it nearly is, and what that is.

use crate::format::significant;
use crate::model::mechanism::{JointId, Mechanism};
use itertools::Itertools;

/// How far a joint may be from what it nearly is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Its point or line, in the file's unit of length.
    pub length: f64,
    /// Its axes `[rad]`.
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

/// What a joint nearly is, to another joint where there is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// A coordinate is all but zero.
    Zero,
    /// Its axis parallel to another, or to a global axis.
    Parallel,
    /// Its axis square to another.
    Square,
    /// Its axis in one plane with two others.
    InPlane,
    /// Its axis the same line as another.
    Coaxial,
    /// Its axis or centre through a point common with another.
    Meeting,
    /// Its centre the same point as another.
    Concentric,
}

/// A joint that is nearly special.
#[derive(Debug, Clone, PartialEq)]
pub struct NearJoint {
    /// The joint.
    pub joint: JointId,
    /// How far its line or centre is off, in the file's unit of length.
    pub shift: f64,
    /// How far its axes are off `[rad]`.
    pub turn: f64,
    /// What it nearly is, and to which joint.
    pub relations: Vec<(Relation, Option<JointId>)>,
}

impl NearJoint {
    /// Returns how far it is off: "0.002 degrees and 0.13 mm".
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
