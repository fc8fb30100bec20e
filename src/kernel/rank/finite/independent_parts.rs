//! Independent parts of a mechanism, and removal of idle rotations, so that each part can be analysed on its own.
//!
//! Joints that share no contour and no coupling, directly or through others, do not interact. The closed poses of the
//! mechanism are the product of those of its parts, and finite mobilities add up. With a cycle basis these parts are
//! the biconnected components of the link graph [Whitney 1932], joined by couplings.
//!
//! Within a part, consider a link whose joints all leave it free to turn (or slide) in one common group H. It can do so
//! for any motion of the rest. H acts freely on the closed poses, which are H times those with as many freedoms locked
//! at one of the joints [Hervé 1978]. So the spin of a rod between two balls is proven to be a finite motion.
//!
//! A link may be free at all its joints even if the joints are not groups.
//!
//! A joint's displacement from a neighbour to a link is a product of the displacements of its freedoms, the last of
//! them next to the link. Let the last ones, C, commute with a twist t, and let some before them, G, be all of a group
//! that contains t. Then the products P G C are the same as P G C exp(at), because exp(at) passes through C and is
//! absorbed by G. So the joint lets the link move by exp(at) while everything else is at rest, in any of its poses.
//!
//! If all joints of a link allow this, exp(at) acts freely on the closed poses. Take a freedom of G at one of the
//! joints that has a share in t: G consists of displacements with this freedom held, times exp(at). So near the pose of
//! the file, each orbit has exactly one pose with that freedom held. The closed poses there are those of the mechanism
//! with that freedom locked, times a line. The finite mobility is therefore exactly one more than that of the locked
//! mechanism. No freedom is assumed to be at rest because it is at rest to first order.
//!
//! A round part on flat faces slides along itself for any motion of the faces. Turning, sliding along and sliding
//! across form the group of the face, next to it. Rolling, next to the part, commutes with the slide.

use crate::closure::Closure;
use crate::closure::tree::connected_sets;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Mode, Role, StateId};
use crate::rank::finite::bonds::intersect_spans;
use crate::rank::finite::displacement_group::{
    is_group, lie_bracket, passed_twists, spatial_twists,
};

/// Returns the joints of each part, in file order. Joints in no contour and no coupling belong to no part.
///
/// # Complexity
/// O(n log n) for contours of n joints in all.
#[must_use]
pub(crate) fn independent_parts<T>(closure: &Closure<T>) -> Vec<Vec<JointId>> {
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
    connected_sets(of_contours.chain(of_couplings))
}

/// Returns the number of freedoms of joints that belong to none of the parts, and so move freely.
pub(crate) fn count_outside<T>(closure: &Closure<T>, parts: &[Vec<JointId>]) -> usize {
    let inside = |j: JointId| parts.iter().any(|p| p.contains(&j));
    closure.columns.iter().filter(|c| !inside(c.joint)).count()
}

/// Returns a mechanism with only some of the joints, numbered as before. Its frame is one of their links.
#[must_use]
pub(crate) fn with_joints_only(mechanism: &Mechanism, joints: &[JointId]) -> Mechanism {
    let mut out = mechanism.clone();
    for j in mechanism.joint_ids() {
        if !joints.contains(&j) {
            out.parts_mut().joints[j].states = Some(Vec::new());
        }
    }
    let touched = |l: LinkId| {
        joints
            .iter()
            .any(|&j| mechanism.joints[j].links.contains(&l))
    };
    if let Some(&first) = joints.first()
        && !touched(mechanism.frame_link())
    {
        let frame = mechanism.frame_link();
        out.parts_mut().links[frame].role = Role::Output;
        out.parts_mut().links[mechanism.joints[first].links[0]].role = Role::Frame;
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
        let at: Vec<JointId> = mechanism.joints_at(link, state).collect();
        let groups: Option<Vec<_>> = at.iter().map(|&j| whole[j].clone()).collect();
        let Some([first, others @ ..]) = groups.as_deref() else {
            continue;
        };
        let shared = others.iter().fold(first.clone(), |so_far, group| {
            intersect_spans(exact, &so_far, group)
        });
        if others.is_empty() || shared.is_empty() {
            continue;
        }
        // Freedoms of the first joint that extend the common group to all of its own freedoms.
        let mut span = Echelon::from_vectors(exact.field(), &shared);
        let joint = &mut mechanism.parts_mut().joints[at[0]];
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

type Twist = Vec<Residue>;

/// Locks one freedom for each idle motion of a link that is free at all its joints. Returns how many were locked.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// O(f p) products of algebras per idle motion, for links of p joints with f freedoms.
fn lock_ways(
    exact: &ExactField,
    mechanism: &mut Mechanism,
    state: StateId,
) -> Result<usize, ExactError> {
    let mut locked = 0;
    for link in mechanism.link_ids().collect::<Vec<_>>() {
        while let Some((joint, kept)) = find_idle_motion(exact, mechanism, state, link)? {
            mechanism.parts_mut().joints[joint].joint_type = JointType::Custom(kept);
            locked += 1;
        }
    }
    Ok(locked)
}

/// Returns a joint of a link, and the freedoms it keeps if it blocks an idle motion of the link that all its joints
/// allow.
fn find_idle_motion(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
    link: LinkId,
) -> Result<Option<(JointId, Vec<Freedom>)>, ExactError> {
    let at: Vec<JointId> = mechanism.joints_at(link, state).collect();
    let coupled = |j: &JointId| mechanism.couplings_of(*j).next().is_some();
    if at.len() < 2 || at.iter().any(coupled) {
        return Ok(None);
    }
    let all = at
        .iter()
        .map(|&j| freedoms_outward(exact, mechanism, j, link))
        .collect::<Result<Vec<_>, _>>()?;
    for (_, t) in &all[0] {
        let sharing: Vec<Vec<Freedom>> =
            all.iter().map(|o| freedoms_sharing(exact, o, t)).collect();
        if sharing.iter().any(Vec::is_empty) {
            continue;
        }
        for (&j, freedoms) in at.iter().zip(&sharing) {
            let before = &mechanism.joints[j].joint_type;
            for held in freedoms {
                let kept = |f: &Freedom| f != held;
                let left: Vec<Freedom> = before.freedoms().iter().copied().filter(kept).collect();
                // The remaining freedoms must keep their order.
                let passed = before.freedoms_in_series().into_iter().filter(kept);
                if passed.eq(JointType::Custom(left.clone()).freedoms_in_series()) {
                    return Ok(Some((j, left)));
                }
            }
        }
    }
    Ok(None)
}

/// Returns the freedoms of a joint from a link outwards.
fn freedoms_outward(
    exact: &ExactField,
    mechanism: &Mechanism,
    joint: JointId,
    link: LinkId,
) -> Result<Vec<(Freedom, Twist)>, ExactError> {
    let mut passed = passed_twists(exact, mechanism, joint)?;
    if mechanism.joints[joint].links[1] == link {
        passed.reverse();
    }
    Ok(passed)
}

/// Returns the freedoms with a share in a twist, of a group that contains it and is followed only by freedoms that
/// commute with it. Returns nothing if there is no such group.
fn freedoms_sharing(exact: &ExactField, outward: &[(Freedom, Twist)], t: &Twist) -> Vec<Freedom> {
    let field = exact.field();
    let commutes = |(_, s): &&(Freedom, Twist)| lie_bracket(exact, s, t).iter().all(|&x| x == 0);
    let commuting = outward.iter().take_while(commutes).count();
    for from in 0..=commuting {
        for to in from + 1..=outward.len() {
            let group = &outward[from..to];
            let twists: Vec<Twist> = group.iter().map(|(_, s)| s.clone()).collect();
            if !is_group(exact, &twists) || !Echelon::from_vectors(field, &twists).contains(t) {
                continue;
            }
            let has_share = |i: &usize| {
                let others = [&twists[..*i], &twists[i + 1..]].concat();
                !Echelon::from_vectors(field, others).contains(t)
            };
            let shares = (0..twists.len()).filter(has_share);
            return shares.map(|i| group[i].0).collect();
        }
    }
    Vec::new()
}
