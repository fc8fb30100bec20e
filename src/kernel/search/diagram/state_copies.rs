//! Ways on from the mechanism that the free state and the searched one have in common.
//!
//! Once all joints present in both states are chosen, a node says all that either state needs. It is written out once for
//! each *lane*, side by side in one space, and every joint to come is added in its own lanes with the twists it has there:
//! - the free state's, where joints are present in it alone;
//! - the searched state's;
//! - one for each face that may take moments: there the faces carry friction only, which is to say that what they do not
//!   carry moves freely. What is redundant in that lane is redundant by friction alone.

use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::search::diagram::frontier::{At, Step, components, copy, plan};
use crate::search::question::grasp::Grasp;
use crate::search::question::space::{Choice, Space};
use std::ops::Range;

/// Where a joint is added, and where what it makes redundant counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lane {
    /// Both states.
    Common,
    /// The free state.
    Free,
    /// The searched state.
    State,
    /// The searched state under friction, by the number of the face that shows moments too.
    Friction(usize),
}

/// A joint added in a lane.
#[derive(Debug, Clone)]
pub(crate) struct Move {
    /// Position of the joint within its variable.
    pub member: usize,
    /// What it does to a node.
    pub step: Step,
    /// The lane.
    pub lane: Lane,
    /// Whether the joint is the face of its lane.
    own: bool,
}

impl Move {
    /// A joint of both states.
    #[must_use]
    pub(crate) fn common(member: usize, step: Step) -> Move {
        Move {
            member,
            step,
            lane: Lane::Common,
            own: false,
        }
    }

    /// The twists of a choice in this lane; `None` where the lane does not apply, as its face is none.
    pub(in crate::search) fn span<'c>(&self, choice: &'c Choice) -> Option<&'c [Vec<Residue>]> {
        let plain = &choice.spans[self.member];
        let Lane::Friction(_) = self.lane else {
            return Some(plain);
        };
        match choice.faces.get(self.member).and_then(Option::as_ref) {
            Some(face) => Some(if self.own { &face.slides } else { &face.parts }),
            None => (!self.own).then_some(plain),
        }
    }
}

/// What must be so at the end of the searched state: of each link that is to be held, the places of its twist and of the
/// twists of what may hold it; `None` for the root, which rests.
pub(crate) type Held = Vec<(Option<usize>, Vec<Option<usize>>)>;

/// The stages after the common ones.
#[derive(Debug)]
pub(in crate::search) struct Ways {
    /// How often a common node is written out.
    pub(in crate::search) copies: usize,
    /// For each variable, its moves.
    pub(in crate::search) stages: Vec<(usize, Vec<Move>)>,
    /// What must be held at the end.
    pub(in crate::search) held: Held,
}

/// The ways on for the variables `alone` of the free state and `added` by the searched one, from a node with the live links
/// `live` as (root, link); `kept` are links whose motion in the free state counts, and `held` what is to be held.
pub(in crate::search) fn ways(
    mechanism: &Mechanism,
    space: &Space,
    alone: &[usize],
    added: &[usize],
    live: &[(LinkId, LinkId)],
    kept: &[LinkId],
    held: &[Grasp],
) -> Ways {
    let faces = faces(space, added);
    let free = (!alone.is_empty()).then_some(Lane::Free);
    let lanes: Vec<Lane> = free
        .into_iter()
        .chain([Lane::State])
        .chain((0..faces.len()).map(Lane::Friction))
        .collect();
    let state = usize::from(free.is_some());
    let mut list = additions(space, alone, 0..state);
    list.extend(additions(space, added, state..lanes.len()));
    let order: Vec<At> = list.iter().map(|a| a.at).collect();
    let copy = |l: LinkId, lane: usize| copy(mechanism, l, lane);
    let components = components(live);
    let start: Vec<Vec<LinkId>> = (0..lanes.len())
        .flat_map(|lane| {
            let of = |c: &Vec<LinkId>| c.iter().map(|&l| copy(l, lane)).collect();
            components.iter().map(of).collect::<Vec<_>>()
        })
        .collect();
    let hold = held.iter().flat_map(|g| g.jaws.iter().chain([&g.body]));
    let kept = kept.iter().filter(|_| !alone.is_empty());
    let pinned: Vec<LinkId> = hold
        .map(|&l| copy(l, state))
        .chain(kept.map(|&l| copy(l, 0)))
        .collect();
    let steps = plan(mechanism, &order, &pinned, &start).steps;
    let end = steps.last().map_or(&[][..], |s| &s.live);
    let place = |l: &LinkId| end.iter().position(|x| x.1 == copy(*l, state));
    let held = held
        .iter()
        .map(|g| (place(&g.body), g.jaws.iter().map(place).collect()))
        .collect();
    let moves = list.into_iter().zip(steps.iter().cloned());
    let moves = moves.map(|(a, step)| {
        let lane = lanes[a.at.lane];
        let next = Move {
            member: a.member,
            step,
            lane,
            own: matches!(lane, Lane::Friction(f) if faces[f] == a.at.joint),
        };
        (a.variable, next)
    });
    Ways {
        copies: lanes.len(),
        stages: by_variable(moves),
        held,
    }
}

/// A joint to be added in a lane.
#[derive(Clone, Copy)]
struct Addition {
    variable: usize,
    /// Position of the joint within its variable.
    member: usize,
    at: At,
}

/// The joints of variables, each in all of some lanes.
fn additions(space: &Space, variables: &[usize], lanes: Range<usize>) -> Vec<Addition> {
    let mut list = Vec::new();
    for &variable in variables {
        let joints = space.variables[variable].joints.iter();
        for (member, &joint) in joints.enumerate() {
            list.extend(lanes.clone().map(|lane| Addition {
                variable,
                member,
                at: At { joint, lane },
            }));
        }
    }
    list
}

/// The joints of variables that are faces in some choice.
fn faces(space: &Space, variables: &[usize]) -> Vec<JointId> {
    let faces = variables.iter().flat_map(|&v| {
        let variable = &space.variables[v];
        let is_face = |member: usize| {
            let mut choices = variable.choices.iter();
            choices.any(|c| c.faces.get(member).is_some_and(Option::is_some))
        };
        let joints = variable.joints.iter().copied().enumerate();
        joints.filter(move |(member, _)| is_face(*member))
    });
    faces.map(|(_, j)| j).collect()
}

/// The moves of each variable, which come one after another.
fn by_variable(moves: impl Iterator<Item = (usize, Move)>) -> Vec<(usize, Vec<Move>)> {
    let mut stages: Vec<(usize, Vec<Move>)> = Vec::new();
    for (v, next) in moves {
        match stages.last_mut() {
            Some((known, moves)) if *known == v => moves.push(next),
            _ => stages.push((v, vec![next])),
        }
    }
    stages
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::question::space::Face;

    /// In the lane of a face's friction a joint that is no face stands as it is, but for the lane's own: what has no face has no
    /// friction there.
    #[test]
    fn a_lane_of_friction_is_for_faces() {
        let span = |rows: usize| vec![vec![1]; rows];
        let choice = |face: Option<Face>| Choice {
            option: 0,
            unloading: None,
            spans: vec![span(1)],
            faces: vec![face],
            freedoms: 1,
            changes: 0,
            cost_milli: 0,
        };
        let face = Face {
            parts: span(2),
            slides: span(3),
        };
        let step = Step {
            closing: false,
            coupled: 0,
            blocks: Vec::new(),
            twist: Vec::new(),
            rates: Vec::new(),
            old_width: 0,
            width: 0,
            live: Vec::new(),
            pending: Vec::new(),
        };
        let rows = |lane, own, face| {
            let one = Move {
                own,
                lane,
                ..Move::common(0, step.clone())
            };
            one.span(&choice(face)).map(<[_]>::len)
        };
        let friction = Lane::Friction(0);
        assert_eq!(rows(Lane::State, false, Some(face.clone())), Some(1));
        assert_eq!(rows(friction, false, Some(face.clone())), Some(2));
        assert_eq!(rows(friction, true, Some(face)), Some(3));
        assert_eq!(rows(friction, false, None), Some(1));
        assert_eq!(rows(friction, true, None), None);
    }
}
