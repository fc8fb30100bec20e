//! Joints of CAD assemblies: misfits and other types.

use crate::geom::vector::Vector;
use crate::redundancy::release::Release;
use crate::robots::Origin;
use crate::view::prelude::*;

/// Another type for a joint of a CAD assembly.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TypeChange {
    /// The joint.
    pub joint: String,
    /// Its type, as the CAD program calls it.
    pub from: String,
    /// Its new type.
    pub to: String,
}

impl TypeChange {
    /// Returns the type of a joint of an assembly after a release.
    pub(super) fn from_release(
        m: &Mechanism,
        origin: &Origin,
        release: &Release,
    ) -> Option<TypeChange> {
        let Release::Freedom {
            joint,
            slides,
            direction,
        } = *release
        else {
            return None;
        };
        TypeChange::at_joint(m, origin, joint, &[(slides, direction)])
    }

    /// Returns its type with more freedoms. Returns `None` if the file is not an assembly, or there is no such type.
    pub fn at_joint(
        m: &Mechanism,
        origin: &Origin,
        joint: JointId,
        more: &[(bool, Vector)],
    ) -> Option<TypeChange> {
        if !origin.is_assembly() {
            return None;
        }
        let now = origin.cad_type(joint, &[]);
        Some(TypeChange {
            joint: m.joints[joint].id.clone(),
            from: now.unwrap_or(m.joints[joint].joint_type.name()).to_owned(),
            to: origin.cad_type(joint, more)?.to_owned(),
        })
    }

    /// Describes a change: "Hinge: Revolute -> Ball".
    pub fn describe_change(&self) -> String {
        format!("{}: {} -> {}", self.joint, self.from, self.to)
    }
}

/// How far the two frames of a joint are apart in what the joint holds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Misfit {
    /// In millimetres.
    pub millimetres: f64,
    /// In degrees.
    pub degrees: f64,
}

/// Describes W with other joint types, if it is more than the current one.
pub(super) fn describe_then(now: usize, then: Option<usize>) -> String {
    match then {
        Some(w) if w > now => format!(" (W = {w}: a part may turn or slide by itself)"),
        _ => String::new(),
    }
}

/// Describes the freedoms as a CAD program counts them, in one line, if they differ.
pub(super) fn describe_count(counted: Option<i64>, mobility: usize) -> String {
    match counted {
        Some(n) if i64::try_from(mobility) != Ok(n) => format!(
            "  6 freedoms per part less all constraints would be {n}; the true number of freedoms is {mobility}\n"
        ),
        _ => String::new(),
    }
}
