//! The image of each joint under a mirror, or under half or a third of a turn, that maps the mechanism to itself: as the file says, or, if
//! it says nothing, as the geometry shows.

use crate::closure::isometry::{Isometry, Spot, frame_directions};
use crate::geom::exact::ExactField;
use crate::geom::expr::Expr;
use crate::geom::vector::length;
use crate::model::mechanism::{Joint, JointId, LinkId, Mechanism, StateId};
use crate::search::question::second_axes::{Allowance, SecondAxis, are_near_images, carried_axes};
use crate::search::question::symmetry::{check_images, check_structure};
use itertools::Itertools;

/// Maximum number of mirrors and turns that are examined exactly.
const TRIED: usize = 12;
/// Maximum number of joints of an examined mechanism.
const JOINTS: usize = 60;
/// Most joints of one whose half turns are looked for: a pair of joints suggests one mirror and many half turns.
const TURNED: usize = 16;
/// Joints one of which a symmetry moves: those that it leaves in place are on its axis or in its plane.
const FIRST: usize = 6;
/// Maximum number of steps of the search for the images of joints at one place.
const STEPS: usize = 1_000;
/// Tolerance of images before they are examined exactly, relative to the mechanism's size, if its digits allow no more.
const NEAR: f64 = 1e-6;

/// Returns the image of each joint; `None` if the mechanism has no symmetry.
#[must_use]
pub(crate) fn own_images(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: Option<StateId>,
) -> Option<Vec<JointId>> {
    let found = match mechanism.search.symmetry_order() {
        1 => {
            let find = |order| OwnSymmetry::find_symmetry(exact, mechanism, state, order, None);
            let found = [2, 3].into_iter().find_map(find)?;
            let mut symmetric = mechanism.clone();
            found.apply_to(&mut symmetric);
            symmetric.search.clone()
        }
        _ => {
            check_images(exact, mechanism, state).ok()?;
            mechanism.search.clone()
        }
    };
    Some(
        mechanism
            .joint_ids()
            .map(|j| found.image_of_joint(j))
            .collect(),
    )
}

/// The joints that a mirror, or part of a turn, carries to each other.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::search) struct OwnSymmetry {
    groups: Vec<Vec<JointId>>,
    mirrored: bool,
    /// Whether images are off by no more than the digits, and not proven.
    near: bool,
}

/// A symmetry, with the second axes that options get in symmetric redesigns.
#[derive(Debug, Clone)]
pub(in crate::search) struct Carried {
    symmetry: OwnSymmetry,
    second_axes: Vec<SecondAxis>,
}

impl Carried {
    /// Writes the symmetry to what a mechanism asks of a search, and the second axes to its options.
    pub(in crate::search) fn apply_to(&self, mechanism: &mut Mechanism) {
        let OwnSymmetry {
            groups,
            mirrored,
            near,
        } = &self.symmetry;
        let parts = mechanism.parts_mut();
        parts.search.nearly_symmetric = *near;
        if *mirrored {
            parts.search.mirror = groups.iter().map(|g| (g[0], g[1])).collect();
        } else {
            parts.search.turn.clone_from(groups);
        }
        for (joint, option, axis) in &self.second_axes {
            if let Some(option) = parts.joints[*joint].options.get_mut(*option) {
                option.frame.reference.clone_from(axis);
            }
        }
    }
}

impl OwnSymmetry {
    /// Returns the first symmetry that is proven: a mirror or half turn if the order is 2, a third of a turn if it is 3. `loosely` gives the
    /// mechanism as its file writes it, for symmetric redesigns. Second axes that the file leaves open are then carried along, and if
    /// nothing is proven, images may be off by its digits.
    ///
    /// # Complexity
    /// Compares O(joints^order) groups. Computes O(joints²) distances for each symmetry that they suggest, and at most a
    /// dozen exact proofs.
    pub(in crate::search) fn find_symmetry(
        exact: &ExactField,
        mechanism: &Mechanism,
        state: Option<StateId>,
        order: usize,
        loosely: Option<&Mechanism>,
    ) -> Option<Carried> {
        if mechanism.joints.len() > JOINTS {
            return None;
        }
        let digits = loosely.and_then(Allowance::of_digits);
        let compared = ComparedJoints::new(mechanism, digits);
        let directions = frame_directions(mechanism);
        let mut tried: Vec<OwnSymmetry> = Vec::new();
        let mut nearest = None;
        let groups = mechanism.joint_ids().combinations(order);
        let groups = groups.take_while(|g| g[0].index() < FIRST);
        for group in groups.filter(|g| compared.may_be_images(g)) {
            for carrier in suggest_carriers(mechanism, &compared.spots, &directions, &group) {
                let Some(groups) = compared.image_groups(mechanism, &carrier, order) else {
                    continue;
                };
                let symmetry = OwnSymmetry {
                    groups,
                    mirrored: carrier.reflects,
                    near: false,
                };
                if tried.contains(&symmetry) {
                    continue;
                }
                let second_axes = loosely.map_or_else(Vec::new, |_| {
                    carried_axes(mechanism, &carrier, &symmetry.groups, compared.allowed)
                });
                let carried = Carried {
                    symmetry: symmetry.clone(),
                    second_axes,
                };
                let mut symmetric = mechanism.clone();
                carried.apply_to(&mut symmetric);
                if check_images(exact, &symmetric, state).is_ok() {
                    return Some(carried);
                }
                let image_of = |j| symmetric.search.image_of_joint(j);
                if nearest.is_none()
                    && digits.is_some()
                    && check_structure(&symmetric, state).is_ok()
                    && are_near_images(&symmetric, &carrier, &image_of, compared.allowed)
                {
                    nearest = Some(carried);
                }
                tried.push(symmetry);
                if tried.len() == TRIED {
                    return near_symmetry(nearest);
                }
            }
        }
        near_symmetry(nearest)
    }
}

/// Returns a symmetry as one that is not proven.
fn near_symmetry(of: Option<Carried>) -> Option<Carried> {
    let mut of = of?;
    of.symmetry.near = true;
    Some(of)
}

/// Returns the mirrors and turns that may carry two or three joints to each other.
fn suggest_carriers(
    mechanism: &Mechanism,
    spots: &[Spot],
    directions: &[[[Expr; 3]; 3]],
    group: &[JointId],
) -> impl Iterator<Item = Isometry> {
    let mirrors = match *group {
        [a, b] => Isometry::mirrors_among(mechanism, spots, &[(a, b)]),
        _ => Vec::new(),
    };
    let turns = if group.len() == 3 || mechanism.joints.len() <= TURNED {
        Isometry::find_turns(mechanism, directions, &[group.to_vec()])
    } else {
        Vec::new()
    };
    mirrors.into_iter().map(|(mirror, _)| mirror).chain(turns)
}

/// The joints of a mechanism, prepared for comparison.
struct ComparedJoints {
    spots: Vec<Spot>,
    /// Those that offer the same, by name, are of one kind.
    kinds: Vec<usize>,
    /// How far off an image may be.
    allowed: Allowance,
}

impl ComparedJoints {
    fn new(mechanism: &Mechanism, digits: Option<Allowance>) -> ComparedJoints {
        let names = |j: &Joint| j.offered_options().map(|o| o.name.clone()).collect_vec();
        let of = |j: JointId| {
            let joint = &mechanism.joints[j];
            (&joint.joint_type, joint.drive, names(joint))
        };
        let all = mechanism.joint_ids().map(of).collect_vec();
        let kind = |one| all.iter().position(|other| other == one);
        let mut compared = ComparedJoints {
            spots: Spot::of_joints(mechanism),
            kinds: all.iter().filter_map(kind).collect(),
            allowed: Allowance {
                distance: 0.0,
                angle: NEAR,
            },
        };
        let mut ids = mechanism.joint_ids();
        let first = ids.next();
        let far = ids.filter_map(|j| Some(compared.distance_between(first?, j)));
        let far = far.fold(0.0, f64::max);
        // Joints of a spherical mechanism may all be drawn at its centre.
        compared.allowed.distance = NEAR * if far > 0.0 { far } else { 1.0 };
        if let Some(digits) = digits {
            let own = compared.allowed;
            compared.allowed = Allowance {
                distance: own.distance.max(digits.distance),
                angle: own.angle.max(digits.angle),
            };
        }
        compared
    }

    fn are_alike(&self, a: JointId, b: JointId) -> bool {
        self.kinds[a.index()] == self.kinds[b.index()]
    }

    fn distance_between(&self, a: JointId, b: JointId) -> f64 {
        let [p, q] = [a, b].map(|j| self.spots[j.index()].point);
        length([0, 1, 2].map(|i| p[i] - q[i]))
    }

    /// Returns whether two or three joints may be each other's images: they are of one kind, and equally far from each other.
    fn may_be_images(&self, group: &[JointId]) -> bool {
        let sides = || group.iter().zip(group.iter().cycle().skip(1));
        let far = || sides().map(|(&a, &b)| self.distance_between(a, b));
        let (least, most) = (far().fold(f64::MAX, f64::min), far().fold(0.0, f64::max));
        sides().all(|(&a, &b)| self.are_alike(a, b))
            && (least >= self.allowed.distance || group.len() == 3 && most == 0.0)
            && most - least < self.allowed.distance
    }

    /// Returns the joints that become each other if each joint becomes one of its kind between the images of its links, and is back after
    /// `order` times. Links decide which becomes which of joints at one place, such as two rods on one pin.
    fn image_groups(
        &self,
        mechanism: &Mechanism,
        carrier: &Isometry,
        order: usize,
    ) -> Option<Vec<Vec<JointId>>> {
        let close = |j: JointId, k: JointId| {
            let [from, to] = [j, k].map(|j| self.spots[j.index()]);
            let miss = carrier.miss_of_image(from, &mechanism.joints[j].joint_type, to);
            miss.distance < self.allowed.distance && miss.angle < self.allowed.angle
        };
        let near = |j: JointId| {
            let all = mechanism.joint_ids();
            let near = all.filter(|&k| self.are_alike(j, k) && close(j, k));
            Some(near.collect_vec()).filter(|near| !near.is_empty())
        };
        let frame = mechanism.frame_link().index();
        let mut images = PartialImages {
            order,
            joints: vec![None; mechanism.joints.len()],
            links: vec![None; mechanism.links.len()],
        };
        images.links[frame] = Some(frame);
        let near: Vec<Vec<JointId>> = mechanism.joint_ids().map(near).collect::<Option<_>>()?;
        let mut steps = STEPS;
        let images = images.complete_images(mechanism, &near, &mut steps)?;
        let groups = mechanism.joint_ids().map(|j| images.orbit_of(j));
        let groups = groups.filter(|g| g.len() > 1 && g.iter().min() == g.first());
        Some(groups.collect_vec()).filter(|all| !all.is_empty())
    }
}

/// What some joints and links become, by number.
#[derive(Clone)]
struct PartialImages {
    /// After how many times all is back: what one of two becomes becomes it.
    order: usize,
    joints: Vec<Option<usize>>,
    links: Vec<Option<usize>>,
}

impl PartialImages {
    /// Returns a joint and what it becomes, one after another until it is back, or for as many times as the order.
    fn orbit_of(&self, j: JointId) -> Vec<JointId> {
        let next = |j: &JointId| self.joints[j.index()].map(JointId::new);
        let all = std::iter::successors(Some(j), next).take(self.order);
        let others = all.skip(1).take_while(|&k| k != j);
        std::iter::once(j).chain(others).collect()
    }

    /// Returns the completed images, each remaining joint with one near its place. Returns `None` if links do not fit, or if the steps run
    /// out.
    ///
    /// # Complexity
    /// O(joints²) comparisons a step; one step a joint unless several joints are at one place.
    fn complete_images(
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
            near.flat_map(|&k| self.with_image(mechanism, j, k))
                .collect_vec()
        });
        match choices.min_by_key(Vec::len) {
            None => {
                let is_back = |j: JointId| {
                    let round = self.orbit_of(j);
                    let last = round.last().and_then(|l| self.joints[l.index()]);
                    [1, self.order].contains(&round.len()) && last == Some(j.index())
                };
                mechanism.joint_ids().all(is_back).then_some(self)
            }
            Some(choices) => choices
                .into_iter()
                .find_map(|images| images.complete_images(mechanism, near, steps)),
        }
    }

    /// Returns these images with one joint becoming another, its links in either order.
    fn with_image(&self, mechanism: &Mechanism, j: JointId, k: JointId) -> Vec<PartialImages> {
        let ([u, v], [x, y]) = (mechanism.joints[j].links, mechanism.joints[k].links);
        let orders = [[(u, x), (v, y)], [(u, y), (v, x)]].into_iter().unique();
        let role = |l: LinkId| mechanism.links[l].role;
        let fitting = orders.filter_map(|links| {
            let mut out = self.clone();
            let fits = set_image(&mut out.joints, [j.index(), k.index()], self.order)
                && links.into_iter().all(|(a, b)| {
                    role(a) == role(b)
                        && set_image(&mut out.links, [a.index(), b.index()], self.order)
                });
            fits.then_some(out)
        });
        fitting.collect()
    }
}

/// Makes one thing become another, and the other it where the order is 2, and returns whether they can.
fn set_image(images: &mut [Option<usize>], [a, b]: [usize; 2], order: usize) -> bool {
    let mut one = |a: usize, b: usize| {
        let others = images.iter().enumerate().filter(|(i, _)| *i != a);
        let is_free = others.into_iter().all(|(_, to)| *to != Some(b));
        let fits = is_free && images[a].is_none_or(|i| i == b);
        images[a] = Some(b);
        fits
    };
    one(a, b) && (order > 2 || one(b, a))
}
