//! Which joint each becomes in a mirror, or by half a turn, that carries the mechanism over to itself: as the file says, or as
//! its geometry has it where the file says nothing.

use crate::closure::mirror::Plane;
use crate::closure::symmetry_image::{Carrier, Spot};
use crate::closure::turn::{FrameDirections, Turn};
use crate::geom::exact::ExactField;
use crate::geom::vector::length;
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
    let compared = ComparedJoints::new(mechanism);
    let directions = FrameDirections::of(mechanism);
    let mut tried: Vec<(Vec<(JointId, JointId)>, bool)> = Vec::new();
    let all = mechanism.joint_ids().tuple_combinations();
    for (a, b) in all.take_while(|(a, _): &(JointId, _)| a.index() < FIRST) {
        if !compared.are_alike(a, b) || compared.apart(a, b) < compared.near {
            continue;
        }
        for (carrier, mirrored) in suggested(mechanism, &compared.spots, &directions, [a, b]) {
            let Some(pairs) = compared.pairs(mechanism, &*carrier) else {
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

/// The mirrors and turns that may carry two joints to each other, and whether it is a mirror.
fn suggested(
    mechanism: &Mechanism,
    spots: &[Spot],
    directions: &FrameDirections,
    [a, b]: [JointId; 2],
) -> impl Iterator<Item = (Box<dyn Carrier>, bool)> {
    let planes = Plane::among(mechanism, spots, &[(a, b)]).into_iter();
    let planes = planes.map(|(p, _)| (Box::new(p) as Box<dyn Carrier>, true));
    let turns = match mechanism.joints.len() {
        ..=TURNED => Turn::of_groups(mechanism, directions, &[vec![a, b]]),
        _ => Vec::new(),
    };
    let turns = turns.into_iter();
    planes.chain(turns.map(|t| (Box::new(t) as Box<dyn Carrier>, false)))
}

/// A mechanism's joints as they are looked at for each candidate.
struct ComparedJoints {
    spots: Vec<Spot>,
    /// Those that offer the same, by name, are of one kind.
    kinds: Vec<usize>,
    /// How far off an image may be, in the file's unit.
    near: f64,
}

impl ComparedJoints {
    fn new(mechanism: &Mechanism) -> ComparedJoints {
        let names = |j: &Joint| j.offered().map(|o| o.name.clone()).collect_vec();
        let of = |j: JointId| {
            let joint = &mechanism.joints[j];
            (&joint.joint_type, joint.drive, names(joint))
        };
        let all = mechanism.joint_ids().map(of).collect_vec();
        let kind = |one| all.iter().position(|other| other == one);
        let mut compared = ComparedJoints {
            spots: Spot::of_joints(mechanism),
            kinds: all.iter().filter_map(kind).collect(),
            near: 0.0,
        };
        let mut ids = mechanism.joint_ids();
        let first = ids.next();
        let far = ids.filter_map(|j| Some(compared.apart(first?, j)));
        compared.near = NEAR * far.fold(0.0, f64::max);
        compared
    }

    fn are_alike(&self, a: JointId, b: JointId) -> bool {
        self.kinds[a.index()] == self.kinds[b.index()]
    }

    fn apart(&self, a: JointId, b: JointId) -> f64 {
        let [p, q] = [a, b].map(|j| self.spots[j.index()].point);
        length([0, 1, 2].map(|i| p[i] - q[i]))
    }

    /// Joints that become each other, where all joints become joints like them, and back.
    fn pairs(
        &self,
        mechanism: &Mechanism,
        carrier: &dyn Carrier,
    ) -> Option<Vec<(JointId, JointId)>> {
        let mut to: Vec<Option<JointId>> = vec![None; mechanism.joints.len()];
        for (j, joint) in mechanism.joints_with_ids() {
            if to[j.index()].is_some() {
                continue;
            }
            let from = self.spots[j.index()];
            let is_image = |&k: &JointId| {
                let close = || {
                    let miss = carrier.miss(from, &joint.joint_type, self.spots[k.index()]);
                    miss.distance < self.near && miss.angle < NEAR
                };
                to[k.index()].is_none() && self.are_alike(j, k) && close()
            };
            let k = mechanism.joint_ids().find(is_image)?;
            (to[j.index()], to[k.index()]) = (Some(k), Some(j));
        }
        let images = mechanism.joint_ids().zip(to);
        let pairs = images.filter_map(|(j, k)| k.filter(|k| j < *k).map(|k| (j, k)));
        Some(pairs.collect_vec()).filter(|p| !p.is_empty())
    }
}
