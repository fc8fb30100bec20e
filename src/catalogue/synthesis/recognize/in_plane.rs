//! Links of a mechanism in its plane of motion, merged if they do not move relative to each other there, and the pairs between them.

use crate::chains::PairKind;
use crate::chains::chain::{Chain, Joint as PairJoint, MOST_LINKS, order_links};
use crate::chains::motion::moves_throughout;
use crate::model::joint_type::Coupling;
use crate::model::mechanism::{Joint, Mechanism};
use crate::model::{JointId, LinkId, StateId};
use crate::synthesis::recognize::found::NoStructure;
use crate::synthesis::recognize::motion_plane::MotionPlane;
use itertools::Itertools;
use petgraph::unionfind::UnionFind;

/// Returns the kind of each joint in the plane, and the links merged if they do not move relative to each other there.
fn kinds_of(
    m: &Mechanism,
    plane: &MotionPlane,
    present: &[JointId],
) -> Result<(Vec<Option<PairKind>>, UnionFind<usize>), NoStructure> {
    let mut kinds = Vec::with_capacity(present.len());
    let mut merged = UnionFind::new(m.links.len());
    for &j in present {
        let joint = &m.joints[j];
        let kind = plane.kind_in_plane(joint)?;
        if kind.is_none() {
            let [a, b] = joint.links.map(LinkId::index);
            merged.union(a, b);
        }
        kinds.push(kind);
    }
    Ok((kinds, merged))
}

/// Links and pairs of some joints in their plane.
pub(super) struct InPlane<'a> {
    m: &'a Mechanism,
    present: &'a [JointId],
    pub(super) plane: MotionPlane,
    pub(super) links: PlaneLinks,
}

/// Links merged in a plane, and pairs between them.
pub(super) struct PlaneLinks {
    /// The names of each link.
    pub(super) names: Vec<Vec<String>>,
    /// For each link of the mechanism, its merged link, if there is one.
    body: Vec<Option<usize>>,
    pub(super) joints: Vec<PairJoint>,
    pub(super) frame: usize,
    /// The links of the drive.
    pub(super) input: [usize; 2],
    pub(super) flat: bool,
}

impl PlaneLinks {
    fn new(
        m: &Mechanism,
        present: &[JointId],
        plane: &MotionPlane,
    ) -> Result<PlaneLinks, NoStructure> {
        let (kinds, merged) = kinds_of(m, plane, present)?;
        let used = present.iter().flat_map(|&j| m.joints[j].links);
        let bodies = used.map(|l| merged.find(l.index())).unique().collect_vec();
        let body = |l: LinkId| bodies.iter().position(|&b| b == merged.find(l.index()));
        let ends = |j: JointId| order_links(m.joints[j].links.map(|l| body(l).unwrap_or(0)));
        if !(3..=MOST_LINKS).contains(&bodies.len()) {
            return Err(NoStructure::Links(bodies.len()));
        }
        let names = bodies.iter().map(|&b| names_of(m, &merged, b));
        let names = names.collect_vec();
        let moving = present.iter().zip(kinds);
        let moving = moving.filter_map(|(&j, pair)| Some((ends(j), pair?)));
        let mut joints = moving.collect_vec();
        for coupling in m.couplings_in(StateId::FREE) {
            if !coupling.ends.iter().all(|e| present.contains(&e.joint)) {
                continue;
            }
            let gears = geared_links(coupling, ends);
            let gears = gears.ok_or_else(|| NoStructure::Coupling(coupling.name(m)))?;
            joints.push((gears, PairKind::Gear));
        }
        no_others_twice(&joints, &names)?;
        let frame = body(m.frame_link()).unwrap_or(0);
        let driven = present.iter().filter(|&&j| m.joints[j].drive);
        let driven = driven.map(|&j| ends(j)).collect_vec();
        let is_guide = |links: &[usize; 2]| links.contains(&frame) || driven.contains(links);
        let (joints, flat) = faces_as_slots(bodies.len(), joints, is_guide);
        Ok(PlaneLinks {
            body: m.link_ids().map(body).collect(),
            input: input(&joints, &driven)?,
            names,
            joints,
            frame,
            flat,
        })
    }

    /// Returns true if it moves in the way of the structures that are counted.
    fn is_counted(&self) -> bool {
        let chain = Chain::new(self.names.len(), self.joints.iter().copied());
        chain.has_carriers() && moves_throughout(&chain)
    }
}

impl<'a> InPlane<'a> {
    /// Chooses the plane in which the most joints move, preferably among those in which all links move together.
    pub(super) fn new(
        m: &'a Mechanism,
        present: &'a [JointId],
    ) -> Result<InPlane<'a>, NoStructure> {
        let (mut plane, normals) = MotionPlane::candidate_planes(m, present)?;
        let mut found = None;
        for normal in normals {
            plane.turn_to(normal);
            let links = PlaneLinks::new(m, present, &plane);
            if links.as_ref().is_ok_and(PlaneLinks::is_counted) {
                found = Some((normal, links));
                break;
            }
            found.get_or_insert((normal, links));
        }
        let (normal, links) = found.ok_or(NoStructure::NoPlane)?;
        plane.turn_to(normal);
        Ok(InPlane {
            links: links?,
            plane,
            m,
            present,
        })
    }

    pub(super) fn body(&self, link: LinkId) -> Option<usize> {
        self.links.body[link.index()]
    }

    /// Returns the joint of the frame with a link, if there is one.
    pub(super) fn at_frame(&self, link: usize) -> Option<&'a Joint> {
        let ends = |j: &Joint| order_links(j.links.map(|l| self.body(l).unwrap_or(0)));
        let all = self.present.iter().map(|&j| &self.m.joints[j]);
        let mut all = all.filter(|j| ends(j) == order_links([self.links.frame, link]));
        all.next()
    }
}

/// Returns the names of the links that are merged into one in the plane.
fn names_of(m: &Mechanism, merged: &UnionFind<usize>, body: usize) -> Vec<String> {
    let own = m.links_with_ids();
    let own = own.filter(|(l, _)| merged.find(l.index()) == body);
    own.map(|(_, link)| link.id.clone()).collect()
}

/// Returns an error if two links have more than one joint, unless the joints are two slots.
fn no_others_twice(
    joints: &[([usize; 2], PairKind)],
    names: &[Vec<String>],
) -> Result<(), NoStructure> {
    let are_slots = |links: &[usize; 2]| {
        let between = joints.iter().filter(|j| j.0 == *links);
        between.map(|j| j.1).eq([PairKind::Slot; 2])
    };
    let mut twice = joints.iter().duplicates_by(|j| j.0).map(|j| j.0);
    match twice.find(|links| !are_slots(links)) {
        None => Ok(()),
        Some(links) => {
            let [a, b] = links.map(|l| names[l].join(" "));
            Err(NoStructure::Twice(a, b))
        }
    }
}

/// Returns the joints with slots in place of flat faces, and whether there are any. Flat faces are slides between links that others join
/// already; guides come first.
fn faces_as_slots(
    links: usize,
    joints: Vec<([usize; 2], PairKind)>,
    is_guide: impl Fn(&[usize; 2]) -> bool,
) -> (Vec<PairJoint>, bool) {
    let mut together = UnionFind::<usize>::new(links);
    let mut flat = false;
    let mut one = |(links, mut pair): ([usize; 2], PairKind)| {
        if pair == PairKind::Slide && !together.union(links[0], links[1]) {
            pair = PairKind::Slot;
            flat = true;
        }
        PairJoint { links, pair }
    };
    let (guides, others): (Vec<_>, Vec<_>) = joints.into_iter().partition(|j| is_guide(&j.0));
    let all = guides.into_iter().chain(others).map(&mut one).collect();
    (all, flat)
}

/// Returns the links that a coupling gears: the links of its two joints without the common one.
fn geared_links(coupling: &Coupling, ends: impl Fn(JointId) -> [usize; 2]) -> Option<[usize; 2]> {
    let [a, b] = [0, 1].map(|i| ends(coupling.ends[i].joint));
    let carrier = a.into_iter().find(|l| b.contains(l))?;
    let other = |links: [usize; 2]| links.into_iter().find(|l| *l != carrier);
    let (u, v) = (other(a)?, other(b)?);
    (u != v).then(|| order_links([u, v]))
}

fn input(joints: &[PairJoint], driven: &[[usize; 2]]) -> Result<[usize; 2], NoStructure> {
    let lower = |links| joints.iter().any(|j| j.links == links && j.pair.is_lower());
    match driven[..] {
        [one] if lower(one) => Ok(one),
        [_] => Err(NoStructure::DriveKind),
        _ => Err(NoStructure::Drives(driven.len())),
    }
}
