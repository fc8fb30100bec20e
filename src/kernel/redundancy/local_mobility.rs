//! Local mobilities: links that move while every output is at rest, with the lines of these motions.

use crate::closure::Closure;
use crate::geom::Scalars;
use crate::geom::exact::ExactField;
use crate::linalg::echelon::{Echelon, combination, relations};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::rank::reduce::axis_names::Direction;
use crate::redundancy::motion::{Speeds, twist};

/// One idle motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Idle {
    /// The links that move. A single one if the motion involves no other link.
    pub links: Vec<LinkId>,
    /// Joints of a single link whose points the motion leaves at rest. Two of them define the line it spins about.
    pub through: Vec<JointId>,
    /// Whether a single link only turns (rather than slides).
    pub turns: bool,
    /// The axis or direction of the motion, for a single link and if it has a name.
    pub direction: Option<Direction>,
}

/// Returns a basis of the motions that leave the outputs at rest: first motions of single links, then the others.
///
/// # Complexity
/// O(n · f) twists for n links; an elimination of each link's own columns, and one of W motions.
#[must_use]
pub fn idle_motions(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
    outputs: &[LinkId],
) -> Vec<Idle> {
    let ids = joined(mechanism, closure);
    let there = ids.iter().copied().filter(|l| outputs.contains(l));
    let there: Vec<LinkId> = there.collect();
    let all = at_rest(exact, mechanism, closure, kernel, &there);
    if all.is_empty() {
        // Motions of a single link would be among them.
        return Vec::new();
    }
    let links = Links::new(exact, mechanism, closure, ids);
    let mut span = Echelon::new(exact.field());
    let mut found = Vec::new();
    for (at, &l) in links.ids.iter().enumerate() {
        if outputs.contains(&l) {
            continue;
        }
        let joints: Vec<JointId> = mechanism
            .joints_in(closure.state)
            .filter(|&j| mechanism.joints[j].links.contains(&l))
            .collect();
        for speeds in links.alone(l, &joints) {
            if span.insert(&speeds) {
                let own = twist(exact, &links.motion[at], &speeds);
                let rests = |j: &JointId| rests_at(exact, mechanism, *j, &own);
                let turns = own.len() == 6 && own[..3].iter().any(|&x| x != 0);
                found.push(Idle {
                    links: vec![l],
                    through: joints.iter().copied().filter(rests).collect(),
                    turns,
                    direction: direction(exact, mechanism, &own),
                });
            }
        }
    }
    for speeds in all {
        if span.insert(&speeds) {
            found.push(Idle {
                links: links.moved(&speeds),
                through: Vec::new(),
                turns: false,
                direction: None,
            });
        }
    }
    found
}

/// Returns the links that have a joint in a state.
fn joined(mechanism: &Mechanism, closure: &Closure<Residue>) -> Vec<LinkId> {
    let is_joined = |l: &LinkId| {
        let mut joints = mechanism.joints_in(closure.state);
        joints.any(|j| mechanism.joints[j].links.contains(l))
    };
    mechanism.link_ids().filter(is_joined).collect()
}

/// Returns the motions under which all of some outputs are at rest.
fn at_rest(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
    outputs: &[LinkId],
) -> Vec<Speeds> {
    let f = exact.field();
    let of_outputs = closure.link_motions(exact, mechanism, outputs);
    let moved = |speeds: &Speeds| {
        let twists = of_outputs.iter().flat_map(|m| twist(exact, m, speeds));
        twists.chain([0]).collect()
    };
    let images: Vec<Vec<Residue>> = kernel.iter().map(moved).collect();
    let all = relations(f, &images);
    all.iter()
        .map(|factors| combination(f, kernel, factors))
        .collect()
}

/// The links of a state, and the effect of the columns of J on them.
struct Links<'a> {
    exact: &'a ExactField,
    mechanism: &'a Mechanism,
    closure: &'a Closure<Residue>,
    ids: Vec<LinkId>,
    /// For each link, the twist from each column.
    motion: Vec<Vec<Vec<Residue>>>,
    /// The closure and coupling entries of every column.
    rows: Vec<Vec<Residue>>,
}

impl<'a> Links<'a> {
    fn new(
        exact: &'a ExactField,
        mechanism: &'a Mechanism,
        closure: &'a Closure<Residue>,
        ids: Vec<LinkId>,
    ) -> Links<'a> {
        let mut rows = closure.dense(exact);
        rows.iter_mut().for_each(|r| r.push(0));
        Links {
            exact,
            mechanism,
            closure,
            motion: closure.link_motions(exact, mechanism, &ids),
            ids,
            rows,
        }
    }

    /// Returns the links that speeds move.
    fn moved(&self, speeds: &Speeds) -> Vec<LinkId> {
        let moving = |(_, m): &(&LinkId, &Vec<Vec<Residue>>)| {
            twist(self.exact, m, speeds).iter().any(|&x| x != 0)
        };
        let links = self.ids.iter().zip(&self.motion).filter(moving);
        links.map(|(l, _)| *l).collect()
    }

    /// Returns the motions of a single link. Only its own joints move, and its neighbours and everything behind them
    /// are at rest.
    fn alone(&self, link: LinkId, joints: &[JointId]) -> Vec<Speeds> {
        let closure = self.closure;
        let mut neighbours: Vec<LinkId> = joints
            .iter()
            .flat_map(|&j| self.mechanism.joints[j].links)
            .filter(|&l| l != link)
            .collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        let columns: Vec<usize> = (0..closure.columns.len())
            .filter(|&c| joints.contains(&closure.columns[c].joint))
            .collect();
        let image = |&c: &usize| {
            let mut image = self.rows[c].clone();
            for l in &neighbours {
                if let Some(at) = self.ids.iter().position(|x| x == l) {
                    image.extend(&self.motion[at][c]);
                }
            }
            image
        };
        let images: Vec<Vec<Residue>> = columns.iter().map(image).collect();
        let whole = |few: Vec<Residue>| {
            let mut speeds = vec![0; closure.columns.len()];
            columns
                .iter()
                .zip(few)
                .for_each(|(&c, speed)| speeds[c] = speed);
            speeds
        };
        relations(self.exact.field(), &images)
            .into_iter()
            .map(whole)
            .collect()
    }
}

/// Returns the rotation axis of a twist, or its direction of sliding if it does not turn.
fn direction(exact: &ExactField, mechanism: &Mechanism, t: &[Residue]) -> Option<Direction> {
    let &[w0, w1, w2, v0, v1, v2] = t else {
        return None;
    };
    let of = if [w0, w1, w2] == [0; 3] {
        [v0, v1, v2]
    } else {
        [w0, w1, w2]
    };
    Direction::of(exact, mechanism, of)
}

/// Returns true if a twist leaves a joint's point at rest: v + ω × p = 0.
fn rests_at(exact: &ExactField, mechanism: &Mechanism, joint: JointId, t: &[Residue]) -> bool {
    let (&[w0, w1, w2, v0, v1, v2], Ok(p)) = (t, exact.eval3(&mechanism.joints[joint].frame.point))
    else {
        return false;
    };
    let turn = exact.cross([w0, w1, w2], p);
    [v0, v1, v2]
        .iter()
        .zip(turn)
        .all(|(&v, t)| exact.field().add(v, t) == 0)
}
