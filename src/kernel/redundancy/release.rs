//! Releases: a freedom added to a joint, or a coupling removed. Each removes one redundant constraint and adds no
//! mobility.
//!
//! A release adds a column to J (or removes a row). It adds no mobility if that column is outside the image of J, that
//! is, if a self-stress does work on the new freedom. A set of σ releases removes all redundant constraints and
//! preserves W if and only if the σ × σ matrix of these powers is regular. So the cheapest set is a basis of a matroid,
//! and the greedy choice finds it. The joint constraints that such a set removes are the redundant ones, expressed in
//! the joints' own directions.

use crate::closure::twist::{MotionSpace, joint_twists};
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::geom::rigid::split_twist;
use crate::geom::vector::{Vector, cross, length, sub, to_vector, unit};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Frame, JointId, Mechanism};
use ozols_dense::{add_scaled, dot, norm};

/// Distance below which directions count as equal.
pub(super) const ALIKE: f64 = 1e-5;

/// The constraint that is removed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Release {
    /// A joint gets one more freedom.
    Freedom {
        /// The joint.
        joint: JointId,
        /// Whether it is a slide along a line; otherwise a turn about it.
        slides: bool,
        /// Direction of the line through the joint's point, of unit length.
        direction: Vector,
    },
    /// A coupling, by its index among those of the state.
    Coupling(usize),
}

impl Release {
    /// Returns the joint that gets a freedom, whether the freedom is a slide, and its direction. Returns `None` for a coupling.
    #[must_use]
    pub fn added_freedom(&self) -> Option<(JointId, bool, Vector)> {
        match *self {
            Release::Freedom {
                joint,
                slides,
                direction,
            } => Some((joint, slides, direction)),
            Release::Coupling(_) => None,
        }
    }
}

/// A redundant constraint.
#[derive(Debug, Clone, PartialEq)]
pub struct Duplicate {
    /// The constraint, as the release that would remove it.
    pub row: Release,
    /// The joints that impose the same constraint, those that its self-stress loads.
    pub by: Vec<JointId>,
    /// Indices of the contours in which its self-stress acts.
    pub contours: Vec<usize>,
    /// Couplings that its self-stress loads.
    pub couplings: Vec<usize>,
    /// Indices in the list of candidates of the releases that remove it, in the order of their costs.
    pub remedies: Vec<usize>,
}

/// Describes the joint with one more freedom: by the name of its type if it has one.
///
/// # Examples
/// ```
/// use ozols::redundancy::release::released_type;
/// let four_bar = ozols::built_in("four-bar")?;
/// let first = four_bar.joint_ids().next().expect("there are four");
/// // A hinge that may slide along its axis is a bush.
/// assert!(released_type(&four_bar, first, true, [0.0, 0.0, 1.0]).contains("cylindrical"));
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn released_type(m: &Mechanism, joint: JointId, slides: bool, direction: Vector) -> String {
    let j = &m.joints[joint];
    let along = length(cross(unit(to_vector(&j.frame.axis)), direction)) < ALIKE;
    match (&j.joint_type, slides, along) {
        (JointType::Revolute, true, true) | (JointType::Prismatic, false, true) => {
            JointType::Cylindrical.name().to_owned()
        }
        (JointType::Revolute, false, false) => JointType::Universal.name().to_owned(),
        (JointType::Revolute, true, false) => JointType::Slotted.name().to_owned(),
        (JointType::Spherical, true, _) => JointType::SphereInCylinder.name().to_owned(),
        (JointType::Fixed, true, _) => JointType::Prismatic.name().to_owned(),
        (JointType::Fixed, false, _) => JointType::Revolute.name().to_owned(),
        (t, true, _) => format!("{} with a slide", t.name()),
        (t, false, _) => format!("{} with a turn", t.name()),
    }
}

pub(super) fn point_positive(d: Vector) -> Vector {
    let largest = d.iter().fold(
        0.0,
        |m: f64, x| if x.abs() > m.abs() + ALIKE { *x } else { m },
    );
    let sign = if largest < 0.0 { -1.0 } else { 1.0 };
    // Avoids negative zeros and rounding errors.
    d.map(|x| if x.abs() < 1e-12 { 0.0 } else { sign * x })
}

/// Returns the remainder of a vector after projection on orthonormal vectors.
pub(super) fn remainder_of(v: &[f64], span: &[Vec<f64>]) -> Vec<f64> {
    let without = |v: Vec<f64>, s: &Vec<f64>| add_scaled(&v, -dot(&v, s), s);
    span.iter().fold(v.to_vec(), without)
}

pub(super) fn orthonormal_span(vectors: impl Iterator<Item = Vec<f64>>) -> Vec<Vec<f64>> {
    let mut span: Vec<Vec<f64>> = Vec::new();
    for v in vectors {
        let r = remainder_of(&v, &span);
        if norm(&r) > ALIKE {
            span.push(r.iter().map(|x| x / norm(&r)).collect());
        }
    }
    span
}

/// Returns the turns and slides of another option at the joint that the joint lacks, about and along unit directions
/// through its point.
///
/// # Errors
/// Returns an error if a coordinate has no value.
pub fn added_freedoms(
    now: (&Frame, &JointType),
    then: (&Frame, &JointType),
) -> Result<Vec<(bool, Vector)>, ExactError> {
    let origin = to_vector(&now.0.point);
    let single = |(frame, kind): (&Frame, &JointType)| -> Result<Vec<[Vector; 2]>, ExactError> {
        let all = joint_twists(&Reals, &MotionSpace::Spatial, frame, kind)?;
        let about = |t: Vec<f64>| {
            let (w, v) = split_twist(&t);
            [w, sub(v, cross(origin, w))]
        };
        Ok(all.into_iter().map(|(_, t)| about(t)).collect())
    };
    let flat = |[w, v]: [Vector; 2]| -> Vec<f64> {
        let all: Vec<f64> = w.into_iter().chain(v).collect();
        let size = norm(&all).max(f64::MIN_POSITIVE);
        all.into_iter().map(|x| x / size).collect()
    };
    let mut span = orthonormal_span(single(now)?.into_iter().map(flat));
    let mut out = Vec::new();
    for [w, v] in single(then)? {
        let r = remainder_of(&flat([w, v]), &span);
        if norm(&r) > ALIKE {
            let slides = dot(&w, &w) < ALIKE * ALIKE;
            out.push((slides, point_positive(unit(if slides { v } else { w }))));
            span.push(r.iter().map(|x| x / norm(&r)).collect());
        }
    }
    Ok(out)
}
