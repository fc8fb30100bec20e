//! How far snapping may reach, what it makes exact, and what it moved.

use crate::format::number::significant;
use crate::format::phrase::list;
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::rounded::Units;
use itertools::Itertools;

/// How far a joint may be moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Its point or line, in the file's unit of length.
    pub length: f64,
    /// Its axes `[rad]`.
    pub angle: f64,
}

impl Reach {
    /// As far as the rounding of coordinates can have moved two joints of a mechanism of some size apart.
    #[must_use]
    pub(crate) fn of_units(units: Units, size: f64) -> Reach {
        Reach {
            length: 2.0 * (units.length + size * units.direction),
            angle: 2.0 * units.direction.max(units.length / size),
        }
    }

    /// A relative tolerance: radians, and fractions of the size.
    #[must_use]
    pub fn relative(tolerance: f64, size: f64) -> Reach {
        Reach {
            length: tolerance * size,
            angle: tolerance,
        }
    }
}

/// What a joint was made to be, to another joint where there is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// A coordinate was all but zero.
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
    /// As far from one joint as others are from each other, in the same direction.
    EqualVectors,
}

impl Relation {
    /// Whether both are from the same thing seen from two sides: lines that coincide are parallel.
    fn implies(self, other: Relation) -> bool {
        self == other || (self, other) == (Relation::Coaxial, Relation::Parallel)
    }

    fn words(self, other: Option<&str>) -> String {
        let to = |word: &str, preposition: &str| match other {
            Some(other) => format!("{word} {preposition} {other}"),
            None => format!("{word} {preposition} a global axis"),
        };
        match self {
            Relation::Zero => "a small coordinate set to 0".to_owned(),
            Relation::Parallel => to("parallel", "to"),
            Relation::Square => to("square", "to"),
            Relation::InPlane => to("in one plane", "with"),
            Relation::Coaxial => to("coaxial", "with"),
            Relation::Meeting => to("meeting", "with"),
            Relation::Concentric => to("concentric", "with"),
            Relation::EqualVectors => to("an equal distance", "as"),
        }
    }
}

/// A joint that was moved, or that is nearly special.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// The joint.
    pub joint: JointId,
    /// How far its line or centre went, in the file's unit of length.
    pub shift: f64,
    /// How far its axes turned `[rad]`.
    pub turn: f64,
    /// What it is now, and to which joint.
    pub relations: Vec<(Relation, Option<JointId>)>,
}

impl Moved {
    /// How far: "0.002 degrees and 0.13 mm".
    #[must_use]
    pub fn far(&self, m: &Mechanism) -> String {
        let turn = (self.turn > 0.0).then(|| format!("{} degrees", small(self.turn.to_degrees())));
        let shift =
            (self.shift > 0.0).then(|| format!("{} {}", small(self.shift), m.length_unit.symbol));
        let parts = turn.into_iter().chain(shift).join(" and ");
        if parts.is_empty() {
            "less than doubles tell".to_owned()
        } else {
            parts
        }
    }

    /// What it is now: "coaxial with LF, square to 2-3".
    #[must_use]
    pub fn is(&self, m: &Mechanism) -> String {
        let kept = self.relations.iter().enumerate().filter(|(i, (r, of))| {
            let others = self.relations.iter().enumerate();
            !others
                .filter(|(k, _)| k != i)
                .any(|(k, (s, to))| of == to && s.implies(*r) && (s != r || k < *i))
        });
        let words = kept
            .map(|(_, (r, of))| r.words(of.map(|j| m.joints[j].id.as_str())))
            .collect_vec();
        list(&words.iter().map(String::as_str).collect_vec())
    }

    /// "joint LR moved by 0.002 degrees and 0.13 mm: coaxial with LF".
    #[must_use]
    pub fn words(&self, m: &Mechanism) -> String {
        let id = &m.joints[self.joint].id;
        format!("joint {id} moved by {}: {}", self.far(m), self.is(m))
    }
}

/// A small figure to two digits.
fn small(x: f64) -> String {
    if (1e-4..1e4).contains(&x) {
        significant(x)
    } else {
        format!("{x:.1e}")
    }
}
