//! Local mobilities: links that move while every output rests, and about which lines.

use crate::closure::matrix::Closure;
use crate::geom::exact::ExactField;
use crate::geom::scalars::Scalars;
use crate::linalg::echelon::{Echelon, combination, relations};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::rank::reduce::axis_names::Direction;
use crate::redundancy::motion::{Speeds, twist};

/// One idle motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Idle {
    /// The links that move; one where the motion is a link's own.
    pub links: Vec<LinkId>,
    /// Joints of a single link whose points the motion leaves at rest: two of them name the line it spins about.
    pub through: Vec<JointId>,
    /// Whether a single link only turns (rather than slides).
    pub turns: bool,
    /// What it turns about or slides along, for a single link and where it has a name.
    pub direction: Option<Direction>,
}

/// A basis of the motions that leave the outputs at rest: motions of one link alone first, then what is left.
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
    let f = exact.field();
    let links: Vec<LinkId> = mechanism
        .link_ids()
        .filter(|&l| {
            mechanism
                .joints_in(closure.state)
                .any(|j| mechanism.joints[j].links.contains(&l))
        })
        .collect();
    // What the outputs do under each motion, and the motions under which all of them rest.
    let there = links.iter().copied().filter(|l| outputs.contains(l));
    let of_outputs = closure.link_motions(exact, mechanism, &there.collect::<Vec<LinkId>>());
    let moved = |speeds: &Speeds| {
        let twists = of_outputs.iter().flat_map(|m| twist(exact, m, speeds));
        twists.chain([0]).collect()
    };
    let images: Vec<Vec<Residue>> = kernel.iter().map(moved).collect();
    let all = relations(f, &images);
    if all.is_empty() {
        // What one link does alone would be among them.
        return Vec::new();
    }
    let all = all.iter().map(|factors| combination(f, kernel, factors));
    let motion = closure.link_motions(exact, mechanism, &links);
    // What every column closes, and couples.
    let mut rows = closure.dense(exact);
    rows.iter_mut().for_each(|r| r.push(0));
    let mut span = Echelon::new(f);
    let mut found = Vec::new();
    for (at, &l) in links.iter().enumerate() {
        if outputs.contains(&l) {
            continue;
        }
        let joints: Vec<JointId> = mechanism
            .joints_in(closure.state)
            .filter(|&j| mechanism.joints[j].links.contains(&l))
            .collect();
        for speeds in alone(
            exact,
            closure,
            (&links, &motion),
            &rows,
            (mechanism, l, &joints),
        ) {
            if span.insert(&speeds) {
                let own = twist(exact, &motion[at], &speeds);
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
            let moving = links
                .iter()
                .zip(&motion)
                .filter(|(_, m)| twist(exact, m, &speeds).iter().any(|&x| x != 0));
            found.push(Idle {
                links: moving.map(|(l, _)| *l).collect(),
                through: Vec::new(),
                turns: false,
                direction: None,
            });
        }
    }
    found
}

/// Motions of one link alone: only its own joints move then, and its neighbours rest; what lies behind them does so with them.
fn alone(
    exact: &ExactField,
    closure: &Closure<Residue>,
    (links, motion): (&[LinkId], &[Vec<Vec<Residue>>]),
    rows: &[Vec<Residue>],
    (mechanism, link, joints): (&Mechanism, LinkId, &[JointId]),
) -> Vec<Speeds> {
    let mut neighbours: Vec<LinkId> = joints
        .iter()
        .flat_map(|&j| mechanism.joints[j].links)
        .filter(|&l| l != link)
        .collect();
    neighbours.sort_unstable();
    neighbours.dedup();
    let columns: Vec<usize> = (0..closure.columns.len())
        .filter(|&c| joints.contains(&closure.columns[c].joint))
        .collect();
    let image = |&c: &usize| {
        let mut image = rows[c].clone();
        for l in &neighbours {
            if let Some(at) = links.iter().position(|x| x == l) {
                image.extend(&motion[at][c]);
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
    relations(exact.field(), &images)
        .into_iter()
        .map(whole)
        .collect()
}

/// What a twist turns about, or slides along where it does not turn.
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

/// Whether a twist leaves a joint's point at rest: v + ω × p = 0.
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
