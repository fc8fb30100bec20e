//! Idle motions of links that are free at all their joints, even if the joints are not groups.
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

use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::rank::finite::displacement_group::{bracket, is_group, spatial_twists};

type Twist = Vec<Residue>;

/// Locks one freedom for each idle motion of a link that is free at all its joints. Returns how many were locked.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// O(f p) products of algebras per idle motion, for links of p joints with f freedoms.
pub(super) fn lock_ways(
    exact: &ExactField,
    mechanism: &mut Mechanism,
    state: StateId,
) -> Result<usize, ExactError> {
    let mut locked = 0;
    for link in mechanism.link_ids().collect::<Vec<_>>() {
        while let Some((joint, kept)) = way(exact, mechanism, state, link)? {
            mechanism.joints[joint].joint_type = JointType::Custom(kept);
            locked += 1;
        }
    }
    Ok(locked)
}

/// Returns a joint of a link, and the freedoms it keeps if it blocks an idle motion of the link that all its joints
/// allow.
fn way(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
    link: LinkId,
) -> Result<Option<(JointId, Vec<Freedom>)>, ExactError> {
    let at: Vec<JointId> = mechanism
        .joints_in(state)
        .filter(|&j| mechanism.joints[j].links.contains(&link))
        .collect();
    let coupled = |j: &JointId| mechanism.couplings_of(*j).next().is_some();
    if at.len() < 2 || at.iter().any(coupled) {
        return Ok(None);
    }
    let all = at
        .iter()
        .map(|&j| outward(exact, mechanism, j, link))
        .collect::<Result<Vec<_>, _>>()?;
    for (_, t) in &all[0] {
        let sharing: Vec<Vec<Freedom>> = all.iter().map(|o| sharing(exact, o, t)).collect();
        if sharing.iter().any(Vec::is_empty) {
            continue;
        }
        for (&j, freedoms) in at.iter().zip(&sharing) {
            let before = &mechanism.joints[j].joint_type;
            for held in freedoms {
                let kept = |f: &Freedom| f != held;
                let left: Vec<Freedom> = before.freedoms().iter().copied().filter(kept).collect();
                // The remaining freedoms must keep their order.
                let passed = before.passed().into_iter().filter(kept);
                if passed.eq(JointType::Custom(left.clone()).passed()) {
                    return Ok(Some((j, left)));
                }
            }
        }
    }
    Ok(None)
}

/// Returns the freedoms of a joint from a link outwards.
fn outward(
    exact: &ExactField,
    mechanism: &Mechanism,
    joint: JointId,
    link: LinkId,
) -> Result<Vec<(Freedom, Twist)>, ExactError> {
    let twists = spatial_twists(exact, mechanism, joint)?;
    let joint = &mechanism.joints[joint];
    let listed = joint.joint_type.freedoms();
    let mut passed: Vec<(Freedom, Twist)> = Vec::new();
    for f in joint.joint_type.passed() {
        let i = listed.iter().position(|g| *g == f);
        passed.extend(i.map(|i| (f, twists[i].clone())));
    }
    if joint.links[1] == link {
        passed.reverse();
    }
    Ok(passed)
}

/// Returns the freedoms with a share in a twist, of a group that contains it and is followed only by freedoms that
/// commute with it. Returns nothing if there is no such group.
fn sharing(exact: &ExactField, outward: &[(Freedom, Twist)], t: &Twist) -> Vec<Freedom> {
    let commutes = |(_, s): &&(Freedom, Twist)| bracket(exact, s, t).iter().all(|&x| x == 0);
    let commuting = outward.iter().take_while(commutes).count();
    for from in 0..=commuting {
        for to in from + 1..=outward.len() {
            let group = &outward[from..to];
            let twists: Vec<Twist> = group.iter().map(|(_, s)| s.clone()).collect();
            if !is_group(exact, &twists) || !spans(exact, &twists, t) {
                continue;
            }
            let has_share = |i: &usize| {
                let others: Vec<Twist> = (0..twists.len())
                    .filter(|k| k != i)
                    .map(|k| twists[k].clone())
                    .collect();
                !spans(exact, &others, t)
            };
            let shares = (0..twists.len()).filter(has_share);
            return shares.map(|i| group[i].0).collect();
        }
    }
    Vec::new()
}

fn spans(exact: &ExactField, twists: &[Twist], t: &Twist) -> bool {
    let mut span = Echelon::new(exact.field());
    for s in twists {
        span.insert(s);
    }
    span.contains(t)
}
