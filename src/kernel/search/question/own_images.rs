//! Which joint each becomes in a mirror, or by half a turn, that carries the mechanism over to itself: as the file says, or as
//! its geometry has it where the file says nothing.

use crate::closure::mirror::Plane;
use crate::closure::symmetry_image::Carrier;
use crate::closure::turn::Turn;
use crate::geom::exact::ExactField;
use crate::geom::vector::{length, real};
use crate::model::mechanism::{Joint, JointId, Mechanism, StateId};
use crate::search::question::symmetry::check;
use itertools::Itertools;

/// Mirrors and turns that are proven or refused exactly, at most.
const TRIED: usize = 12;
/// Joints of a mechanism that is looked at, at most.
const JOINTS: usize = 60;
/// Joints of one whose turns are looked for, at most: a pair of joints suggests one mirror and many turns.
const TURNED: usize = 16;
/// Joints one of which a symmetry moves: those that it leaves in place are on its axis or in its plane.
const FIRST: usize = 6;
/// How far off images may be before they are looked at exactly, in the mechanism's size.
const NEAR: f64 = 1e-6;

/// The image of each joint; `None` where there is no symmetry but that of the whole lying still, or one of another order.
///
/// # Complexity
/// O(joints²) candidates, each for some distances, and a dozen exact proofs at most.
#[must_use]
pub(crate) fn own_images(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: Option<StateId>,
) -> Option<Vec<JointId>> {
    let of = |m: &Mechanism| m.joint_ids().map(|j| m.search.image(j)).collect_vec();
    if mechanism.search.order() > 1 {
        let holds = mechanism.search.order() == 2 && check(exact, mechanism, state).is_ok();
        return holds.then(|| of(mechanism));
    }
    if mechanism.joints.len() > JOINTS {
        return None;
    }
    let proven = |pairs: &Vec<(JointId, JointId)>, mirrored: bool| {
        let mut symmetric = mechanism.clone();
        if mirrored {
            symmetric.search.mirror.clone_from(pairs);
        } else {
            symmetric.search.turn = pairs.iter().map(|&(a, b)| vec![a, b]).collect();
        }
        check(exact, &symmetric, state)
            .is_ok()
            .then(|| of(&symmetric))
    };
    let mut tried: Vec<(Vec<(JointId, JointId)>, bool)> = Vec::new();
    let all = mechanism.joint_ids().tuple_combinations();
    for (a, b) in all.take_while(|(a, _): &(JointId, _)| a.index() < FIRST) {
        let joints = [a, b].map(|j| &mechanism.joints[j]);
        if !alike(joints[0], joints[1]) || apart(mechanism, a, b) < NEAR * size(mechanism) {
            continue;
        }
        let planes = Plane::of_pairs(mechanism, &[(a, b)]);
        let planes = planes
            .into_iter()
            .map(|(p, _)| (Box::new(p) as Box<dyn Carrier>, true));
        let turns = match mechanism.joints.len() {
            ..=TURNED => Turn::of_groups(mechanism, &[vec![a, b]]),
            _ => Vec::new(),
        };
        let turns = turns.into_iter();
        let turns = turns.map(|t| (Box::new(t) as Box<dyn Carrier>, false));
        for (carrier, mirrored) in planes.chain(turns) {
            let Some(pairs) = pairs(mechanism, &*carrier) else {
                continue;
            };
            let one = (pairs, mirrored);
            if tried.contains(&one) {
                continue;
            }
            if let Some(images) = proven(&one.0, mirrored) {
                return Some(images);
            }
            tried.push(one);
            if tried.len() == TRIED {
                return None;
            }
        }
    }
    None
}

/// Joints that become each other, where all joints become joints like them, and back.
fn pairs(mechanism: &Mechanism, carrier: &dyn Carrier) -> Option<Vec<(JointId, JointId)>> {
    let near = NEAR * size(mechanism);
    let mut to: Vec<Option<JointId>> = vec![None; mechanism.joints.len()];
    for (j, joint) in mechanism.joints_with_ids() {
        if to[j.index()].is_some() {
            continue;
        }
        let is_image = |&k: &JointId| {
            let other = &mechanism.joints[k];
            let miss = || carrier.miss((&joint.frame, &joint.joint_type), &other.frame);
            let close = || miss().distance < near && miss().angle < NEAR;
            to[k.index()].is_none() && alike(joint, other) && close()
        };
        let k = mechanism.joint_ids().find(is_image)?;
        (to[j.index()], to[k.index()]) = (Some(k), Some(j));
    }
    let images = mechanism.joint_ids().zip(to);
    let pairs = images.filter_map(|(j, k)| k.filter(|k| j < *k).map(|k| (j, k)));
    Some(pairs.collect_vec()).filter(|p| !p.is_empty())
}

/// Whether joints offer the same, by name.
fn alike(a: &Joint, b: &Joint) -> bool {
    let names = |j: &Joint| j.offered().map(|o| o.name.clone()).collect_vec();
    a.joint_type == b.joint_type && a.drive == b.drive && names(a) == names(b)
}

fn apart(mechanism: &Mechanism, a: JointId, b: JointId) -> f64 {
    let [p, q] = [a, b].map(|j| real(&mechanism.joints[j].frame.point));
    length([0, 1, 2].map(|i| p[i] - q[i]))
}

/// The largest distance from the first joint.
fn size(mechanism: &Mechanism) -> f64 {
    let mut ids = mechanism.joint_ids();
    let Some(first) = ids.next() else { return 0.0 };
    ids.map(|j| apart(mechanism, first, j)).fold(0.0, f64::max)
}
