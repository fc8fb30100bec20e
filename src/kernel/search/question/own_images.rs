//! Which joint each becomes in a mirror, or by half a turn, that carries the mechanism over to itself: as the file says, or as
//! its geometry has it where the file says nothing.

use crate::closure::mirror::Plane;
use crate::closure::symmetry_image::{Carrier, Spot};
use crate::closure::turn::{FrameDirections, Turn};
use crate::geom::exact::ExactField;
use crate::geom::vector::length;
use crate::model::mechanism::{Joint, JointId, LinkId, Mechanism, SearchSpec, StateId};
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
/// Steps of the search for the images of joints at one place, at most.
const STEPS: usize = 1_000;
/// How far off images may be before they are looked at exactly, in the mechanism's size.
const NEAR: f64 = 1e-6;

/// Returns the image of each joint; `None` where there is no symmetry but that of the whole lying still, or one of another order.
#[must_use]
pub(crate) fn own_images(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: Option<StateId>,
) -> Option<Vec<JointId>> {
    let found = match mechanism.search.order() {
        1 => OwnSymmetry::find(exact, mechanism, state)?.of(&mechanism.search),
        2 => {
            check(exact, mechanism, state).ok()?;
            mechanism.search.clone()
        }
        _ => return None,
    };
    Some(mechanism.joint_ids().map(|j| found.image(j)).collect())
}

/// The joints that a mirror, or half a turn, carries to each other.
#[derive(Debug, PartialEq)]
pub(in crate::search) struct OwnSymmetry {
    pairs: Vec<(JointId, JointId)>,
    mirrored: bool,
}

impl OwnSymmetry {
    /// Returns what is asked of a search with this symmetry in it.
    pub(in crate::search) fn of(&self, search: &SearchSpec) -> SearchSpec {
        let mut out = search.clone();
        if self.mirrored {
            out.mirror.clone_from(&self.pairs);
        } else {
            out.turn = self.pairs.iter().map(|&(a, b)| vec![a, b]).collect();
        }
        out
    }

    /// Returns the first mirror or half turn that is proven to carry the mechanism over to itself.
    ///
    /// # Complexity
    /// O(joints²) candidates, each for some distances, and a dozen exact proofs at most.
    pub(in crate::search) fn find(
        exact: &ExactField,
        mechanism: &Mechanism,
        state: Option<StateId>,
    ) -> Option<OwnSymmetry> {
        if mechanism.joints.len() > JOINTS {
            return None;
        }
        let proven = |one: &OwnSymmetry| {
            let mut symmetric = mechanism.clone();
            symmetric.search = one.of(&mechanism.search);
            check(exact, &symmetric, state).is_ok()
        };
        let compared = ComparedJoints::new(mechanism);
        let directions = FrameDirections::of(mechanism);
        let mut tried: Vec<OwnSymmetry> = Vec::new();
        let all = mechanism.joint_ids().tuple_combinations();
        for (a, b) in all.take_while(|(a, _): &(JointId, _)| a.index() < FIRST) {
            if !compared.are_alike(a, b) || compared.apart(a, b) < compared.near {
                continue;
            }
            for (carrier, mirrored) in suggested(mechanism, &compared.spots, &directions, [a, b]) {
                let Some(pairs) = compared.pairs(mechanism, &*carrier) else {
                    continue;
                };
                let one = OwnSymmetry { pairs, mirrored };
                if tried.contains(&one) {
                    continue;
                }
                if proven(&one) {
                    return Some(one);
                }
                tried.push(one);
                if tried.len() == TRIED {
                    return None;
                }
            }
        }
        None
    }
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

    /// Returns the joints that become each other, where all joints become joints like them between the images of their links, and
    /// back. Of joints at one place, such as two rods on one pin, the links tell which becomes which.
    fn pairs(
        &self,
        mechanism: &Mechanism,
        carrier: &dyn Carrier,
    ) -> Option<Vec<(JointId, JointId)>> {
        let close = |j: JointId, k: JointId| {
            let [from, to] = [j, k].map(|j| self.spots[j.index()]);
            let miss = carrier.miss(from, &mechanism.joints[j].joint_type, to);
            miss.distance < self.near && miss.angle < NEAR
        };
        let near = |j: JointId| {
            let all = mechanism.joint_ids();
            let near = all.filter(|&k| self.are_alike(j, k) && close(j, k));
            near.collect_vec()
        };
        let mut images = PartialImages {
            joints: vec![None; mechanism.joints.len()],
            links: vec![None; mechanism.links.len()],
        };
        images.links[mechanism.frame().index()] = Some(mechanism.frame());
        let near = mechanism.joint_ids().map(near).collect_vec();
        let mut steps = STEPS;
        let images = images.complete(mechanism, &near, &mut steps)?.joints;
        let images = mechanism.joint_ids().zip(images);
        let pairs = images.filter_map(|(j, k)| k.filter(|k| j < *k).map(|k| (j, k)));
        Some(pairs.collect_vec()).filter(|p| !p.is_empty())
    }
}

/// What some joints and links become; what one becomes becomes it.
#[derive(Clone)]
struct PartialImages {
    joints: Vec<Option<JointId>>,
    links: Vec<Option<LinkId>>,
}

impl PartialImages {
    /// Returns these images with one of each joint that is left, from those near its place; none where links do not fit, or where
    /// the steps run out.
    ///
    /// # Complexity
    /// O(joints²) comparisons a step; one step a joint unless several joints are at one place.
    fn complete(
        self,
        mechanism: &Mechanism,
        near: &[Vec<JointId>],
        steps: &mut usize,
    ) -> Option<PartialImages> {
        *steps = steps.checked_sub(1)?;
        let open = mechanism
            .joint_ids()
            .filter(|j| self.joints[j.index()].is_none());
        let choices = open.map(|j| {
            let near = near[j.index()].iter();
            near.flat_map(|&k| self.with(mechanism, j, k)).collect_vec()
        });
        match choices.min_by_key(Vec::len) {
            None => Some(self),
            Some(choices) => choices
                .into_iter()
                .find_map(|images| images.complete(mechanism, near, steps)),
        }
    }

    /// Returns these images with one joint becoming another, its links in either order.
    fn with(&self, mechanism: &Mechanism, j: JointId, k: JointId) -> Vec<PartialImages> {
        if self.joints[k.index()].is_some() {
            return Vec::new();
        }
        let ([u, v], [x, y]) = (mechanism.joints[j].links, mechanism.joints[k].links);
        let orders = [[(u, x), (v, y)], [(u, y), (v, x)]].into_iter().unique();
        let fitting = orders.filter_map(|links| {
            let mut out = self.clone();
            (out.joints[j.index()], out.joints[k.index()]) = (Some(k), Some(j));
            links
                .into_iter()
                .all(|(a, b)| out.join(mechanism, a, b))
                .then_some(out)
        });
        fitting.collect()
    }

    /// Makes two links each other's images, and returns whether they can be.
    fn join(&mut self, mechanism: &Mechanism, a: LinkId, b: LinkId) -> bool {
        let is = |of: LinkId, image: LinkId| self.links[of.index()].is_none_or(|l| l == image);
        let fits = is(a, b) && is(b, a) && mechanism.links[a].role == mechanism.links[b].role;
        (self.links[a.index()], self.links[b.index()]) = (Some(b), Some(a));
        fits
    }
}
