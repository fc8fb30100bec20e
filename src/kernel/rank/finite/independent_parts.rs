//! Independent parts of a mechanism, and removal of idle rotations, so that each part can be analysed on its own.
//!
//! Joints that share no contour and no coupling, directly or through others, do not interact. The closed poses of the
//! mechanism are the product of those of its parts, and finite mobilities add up. With a cycle basis these parts are
//! the biconnected components of the link graph [Whitney 1932], joined by couplings.
//!
//! Within a part, consider a link whose joints all leave it free to turn (or slide) in one common group H. It can do so
//! for any motion of the rest. H acts freely on the closed poses, which are H times those with as many freedoms locked
//! at one of the joints [Hervé 1978]. So the spin of a rod between two balls is proven to be a finite motion.

use crate::closure::Closure;
use crate::closure::tree::tied;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Mode, Role, StateId};
use crate::rank::finite::bonds::common;
use crate::rank::finite::displacement_group::{is_group, spatial_twists};
use crate::rank::finite::idle_ways::lock_ways;

/// Returns the joints of each part, in file order. Joints in no contour and no coupling belong to no part.
///
/// # Complexity
/// O(n log n) for contours of n joints in all.
#[must_use]
pub(crate) fn parts<T>(closure: &Closure<T>) -> Vec<Vec<JointId>> {
    let of_contours = closure
        .contours
        .iter()
        .map(|c| c.joints.iter().map(|&(j, _)| j).collect::<Vec<JointId>>());
    let of_couplings = closure.couplings.iter().map(|c| {
        c.entries
            .iter()
            .map(|&(i, _)| closure.columns[i].joint)
            .collect()
    });
    tied(of_contours.chain(of_couplings))
}

/// Returns a mechanism with only some of the joints, numbered as before. Its frame is one of their links.
#[must_use]
pub(crate) fn alone(mechanism: &Mechanism, joints: &[JointId]) -> Mechanism {
    let mut out = mechanism.clone();
    for j in mechanism.joint_ids() {
        if !joints.contains(&j) {
            out.joints[j].states = Some(Vec::new());
        }
    }
    let touched = |l: LinkId| {
        joints
            .iter()
            .any(|&j| mechanism.joints[j].links.contains(&l))
    };
    if let Some(&first) = joints.first()
        && !touched(mechanism.frame())
    {
        let frame = mechanism.frame();
        out.links[frame].role = Role::Output;
        out.links[mechanism.joints[first].links[0]].role = Role::Frame;
    }
    out
}

/// Locks the idle freedoms of links whose joints all leave them free in one group, or in one direction. Returns how
/// many were locked.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
pub fn lock_idle(
    exact: &ExactField,
    mechanism: &mut Mechanism,
    state: StateId,
) -> Result<usize, ExactError> {
    // In a plane, a ball is a pin whose axis is the normal of the plane.
    if matches!(mechanism.mode, Mode::Planar { .. }) {
        return Ok(0);
    }
    let mut whole: Vec<Option<Vec<Vec<Residue>>>> = vec![None; mechanism.joints.len()];
    for j in mechanism.joints_in(state) {
        let coupled = mechanism.couplings_of(j).next().is_some();
        let twists = spatial_twists(exact, mechanism, j)?;
        if !coupled && is_group(exact, &twists) {
            whole[j] = Some(twists);
        }
    }
    let mut locked = 0;
    for link in mechanism.link_ids() {
        let at: Vec<JointId> = mechanism
            .joints_in(state)
            .filter(|&j| mechanism.joints[j].links.contains(&link))
            .collect();
        let Some(groups) = at
            .iter()
            .map(|&j| whole[j].clone())
            .collect::<Option<Vec<_>>>()
        else {
            continue;
        };
        let Some((first, others)) = groups.split_first() else {
            continue;
        };
        if others.is_empty() {
            continue;
        }
        let shared = others
            .iter()
            .fold(first.clone(), |so_far, group| common(exact, &so_far, group));
        if shared.is_empty() {
            continue;
        }
        // Freedoms of the first joint that extend the common group to all of its own freedoms.
        let mut span = Echelon::of(exact.field(), &shared);
        let joint = &mut mechanism.joints[at[0]];
        let kept = joint.joint_type.freedoms().iter().zip(first);
        let kept = kept
            .filter(|(_, t)| span.insert(t))
            .map(|(&f, _)| f)
            .collect();
        joint.joint_type = JointType::Custom(kept);
        whole[at[0]] = None;
        locked += shared.len();
    }
    Ok(locked + lock_ways(exact, mechanism, state)?)
}
