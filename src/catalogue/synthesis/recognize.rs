//! A drawn mechanism as a structure: the chain of pairs that its joints are in their plane, with the roles of its links.
//!
//! What a joint does in the plane is what of its motions lies there: a ball is a hinge, a pin with play along its axis is one,
//! too. So a gripper and its redesign have the same structure.

mod found;
mod threads;

pub use found::{NoStructure, Recognized};

use crate::chains::pairs::chain::{Joint as PairJoint, MOST_LINKS, PairChain, ordered};
use crate::chains::pairs::classics::MadeAs;
use crate::chains::pairs::kind::PairKind;
use crate::chains::pairs::roles::PairRoles;
use crate::chains::pairs::structure::PairStructure;
use crate::closure::twist::FrameValues;
use crate::geom::exact::ExactField;
use crate::geom::scalars::Scalars;
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::coupling::Coupling;
use crate::model::id::{JointId, LinkId, StateId};
use crate::model::mechanism::{Joint, Mechanism, Mode};
use crate::rank::exact::field::exact_field;
use found::jaws;
use itertools::Itertools;
use petgraph::unionfind::UnionFind;
use threads::screw_with_nuts;

/// The structure of a mechanism in its free state.
///
/// # Errors
/// Why it has none.
///
/// # Complexity
/// A few eliminations of six columns for each joint and each axis.
pub fn recognize(m: &Mechanism) -> Result<Recognized, NoStructure> {
    screw_with_nuts(m)?.map_or_else(|| in_a_plane(m), Ok)
}

/// What each joint is in the plane, and which links do not move against each other there.
fn kinds_of(
    m: &Mechanism,
    plane: &MotionPlane,
    present: &[JointId],
) -> Result<(Vec<Option<PairKind>>, UnionFind<usize>), NoStructure> {
    let mut kinds = Vec::with_capacity(present.len());
    let mut merged = UnionFind::new(m.links.len());
    for &j in present {
        let joint = &m.joints[j];
        let kind = plane.kind(joint)?;
        if kind.is_none() {
            let [a, b] = joint.links.map(LinkId::index);
            merged.union(a, b);
        }
        kinds.push(kind);
    }
    Ok((kinds, merged))
}

/// The structure of what moves in a plane.
fn in_a_plane(m: &Mechanism) -> Result<Recognized, NoStructure> {
    let plane = MotionPlane::new(m)?;
    let present = m.joints_in(StateId::FREE).collect_vec();
    let (kinds, merged) = kinds_of(m, &plane, &present)?;
    let used = present.iter().flat_map(|&j| m.joints[j].links);
    let bodies = used.map(|l| merged.find(l.index())).unique().collect_vec();
    let body = |l: LinkId| bodies.iter().position(|&b| b == merged.find(l.index()));
    let ends = |j: JointId| ordered(m.joints[j].links.map(|l| body(l).unwrap_or(0)));
    if !(3..=MOST_LINKS).contains(&bodies.len()) {
        return Err(NoStructure::Links(bodies.len()));
    }
    let names = bodies
        .iter()
        .map(|&b| names_of(m, &merged, b))
        .collect_vec();
    let moving = present.iter().zip(kinds);
    let moving = moving.filter_map(|(&j, pair)| Some((ends(j), pair?)));
    let mut joints = moving.collect_vec();
    for coupling in m.couplings_in(StateId::FREE) {
        let gears = geared(coupling, ends);
        let gears = gears.ok_or_else(|| NoStructure::Coupling(coupling.name(m)))?;
        joints.push((gears, PairKind::Gear));
    }
    no_others_twice(&joints, &names)?;
    let frame = body(m.frame()).unwrap_or(0);
    let driven = present.iter().filter(|&&j| m.joints[j].drive);
    let driven = driven.map(|&j| ends(j)).collect_vec();
    let is_guide = |links: &[usize; 2]| links.contains(&frame) || driven.contains(links);
    let (joints, flat) = faces_as_slots(bodies.len(), joints, is_guide);
    let chain = PairChain::new(bodies.len(), joints);
    let roles = PairRoles {
        frame,
        input: input(&chain, &driven)?,
        jaws: jaws(m, body)?,
    };
    let at_frame = roles.jaws.map(|jaw| {
        let own = |&&j: &&JointId| ends(j) == ordered([frame, jaw]);
        present.iter().find(own).map(|&j| &m.joints[j])
    });
    let made_as = MadeAs {
        flat,
        jaws_on_one_pin: plane.are_on_one_pin(at_frame)?,
        threaded: false,
    };
    let structure = PairStructure { chain, roles };
    Ok(Recognized {
        structure,
        names,
        made_as,
    })
}

/// What the links are called that are one in the plane.
fn names_of(m: &Mechanism, merged: &UnionFind<usize>, body: usize) -> Vec<String> {
    let own = m.links_with_ids();
    let own = own.filter(|(l, _)| merged.find(l.index()) == body);
    own.map(|(_, link)| link.id.clone()).collect()
}

/// Nothing but two slots is between two links beside another joint.
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

/// Joints with slots in the place of flat faces, the slides between links that others join already, guides before others; and whether
/// there are any.
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

/// The links that a coupling gears: those of its two joints but the one that both have.
fn geared(coupling: &Coupling, ends: impl Fn(JointId) -> [usize; 2]) -> Option<[usize; 2]> {
    let [a, b] = [0, 1].map(|i| ends(coupling.ends[i].joint));
    let carrier = a.into_iter().find(|l| b.contains(l))?;
    let other = |links: [usize; 2]| links.into_iter().find(|l| *l != carrier);
    let (u, v) = (other(a)?, other(b)?);
    (u != v).then(|| ordered([u, v]))
}

fn input(chain: &PairChain, driven: &[[usize; 2]]) -> Result<[usize; 2], NoStructure> {
    let lower = |[u, v]: [usize; 2]| chain.between(u, v).is_some_and(PairKind::is_lower);
    match driven[..] {
        [one] if lower(one) => Ok(one),
        _ => Err(NoStructure::Drives(driven.len())),
    }
}

/// The plane of motion, with the field its numbers are in.
struct MotionPlane {
    exact: ExactField,
    normal: [Residue; 3],
}

impl MotionPlane {
    fn new(m: &Mechanism) -> Result<MotionPlane, NoStructure> {
        let exact = exact_field(m, 0)?;
        if let Mode::Planar { normal } = &m.mode {
            let normal = exact.eval3(normal)?;
            return Ok(MotionPlane { exact, normal });
        }
        // The axis about which the most joints turn or across which they slide.
        let mut axes = Vec::new();
        let mut ways = Vec::new();
        for j in m.joints_in(StateId::FREE) {
            let joint = &m.joints[j];
            let frame = FrameValues::new(&exact, &joint.frame)?;
            for freedom in joint.joint_type.freedoms() {
                let [x, y, z, a, b, c] = frame.twist(&exact, *freedom);
                if freedom.turns() {
                    axes.push([x, y, z]);
                } else {
                    ways.push([a, b, c]);
                }
            }
        }
        // Where nothing turns, wedges alone, what is square to two slides.
        if axes.is_empty() {
            let two = ways.iter().tuple_combinations();
            axes = two.map(|(a, b)| exact.cross(*a, *b)).collect();
            let zero = exact.field().zero();
            axes.retain(|n| n.iter().any(|x| *x != zero));
        }
        let mut best: Option<(usize, [Residue; 3])> = None;
        let normal = [exact.field().zero(); 3];
        let mut plane = MotionPlane { exact, normal };
        for normal in axes {
            plane.normal = normal;
            let moving = plane.moving(m)?;
            if best.is_none_or(|(most, _)| moving > most) {
                best = Some((moving, normal));
            }
        }
        plane.normal = best.ok_or(NoStructure::NoPlane)?.1;
        Ok(plane)
    }

    /// Whether two joints are hinges in the plane, at one place there.
    fn are_on_one_pin(&self, joints: [Option<&Joint>; 2]) -> Result<bool, NoStructure> {
        let [Some(a), Some(b)] = joints else {
            return Ok(false);
        };
        let joints = [a, b];
        let kinds = [self.kind(joints[0])?, self.kind(joints[1])?];
        let [a, b] = joints.map(|j| FrameValues::new(&self.exact, &j.frame));
        let (a, b) = (a?.point, b?.point);
        let apart = [0, 1, 2].map(|k| self.exact.field().sub(a[k], b[k]));
        let zero = self.exact.field().zero();
        let along = self.exact.cross(apart, self.normal) == [zero; 3];
        Ok(along && kinds == [Some(PairKind::Hinge); 2])
    }

    /// How many joints are of a kind in the plane.
    fn moving(&self, m: &Mechanism) -> Result<usize, NoStructure> {
        let mut out = 0;
        for j in m.joints_in(StateId::FREE) {
            match self.kind(&m.joints[j]) {
                Ok(kind) => out += usize::from(kind.is_some()),
                Err(NoStructure::Kind { .. }) => {}
                Err(e) => return Err(e),
            }
        }
        Ok(out)
    }

    fn span(&self, twists: impl IntoIterator<Item = [Residue; 6]>) -> Echelon {
        let mut out = Echelon::new(self.exact.field());
        for twist in twists {
            out.insert(&twist);
        }
        out
    }

    /// What a joint is in the plane; nothing where it does not move there.
    fn kind(&self, joint: &Joint) -> Result<Option<PairKind>, NoStructure> {
        let frame = FrameValues::new(&self.exact, &joint.frame)?;
        let freedoms = joint.joint_type.freedoms();
        let twists = freedoms.iter().map(|&f| frame.twist(&self.exact, f));
        let twists = twists.collect_vec();
        // How much of the joint's motions is in a space: dimensions add up to those of the sum and of what both have.
        let own = self.span(twists.iter().copied()).rank();
        let shared = |space: &[[Residue; 6]]| {
            let both = twists.iter().chain(space).copied();
            own + self.span(space.iter().copied()).rank() - self.span(both).rank()
        };
        let slides = self.slides();
        let turn = {
            let [x, y, z] = self.normal;
            let p = frame.point;
            let [a, b, c] = self.exact.cross(p, self.normal);
            [x, y, z, a, b, c]
        };
        let all = slides.into_iter().chain([turn]).collect_vec();
        let slides = shared(&slides);
        let turns = shared(&all) - slides;
        match (turns, slides) {
            (0, 0) => Ok(None),
            (1, 0) => Ok(Some(PairKind::Hinge)),
            (0, 1) => Ok(Some(PairKind::Slide)),
            (1, 1) => Ok(Some(PairKind::Slot)),
            _ => Err(NoStructure::Kind {
                joint: joint.id.clone(),
                turns,
                slides,
            }),
        }
    }

    /// Two slides across the normal.
    fn slides(&self) -> [[Residue; 6]; 2] {
        let zero = self.exact.field().zero();
        let one = self.exact.field().one();
        let units = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        let across = units.map(|u| self.exact.cross(self.normal, u));
        let independent = across.into_iter().tuple_combinations().find(|&(a, b)| {
            let wide = |[x, y, z]: [Residue; 3]| [zero, zero, zero, x, y, z];
            self.span([wide(a), wide(b)]).rank() == 2
        });
        let (a, b) = independent.unwrap_or((units[0], units[1]));
        [a, b].map(|[x, y, z]| [zero, zero, zero, x, y, z])
    }
}
