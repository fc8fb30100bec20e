//! Local mobilities: links that move while every output is at rest, with the lines of these motions, and each as a
//! visible motion.

use crate::closure::Closure;
use crate::closure::tree::path_from_frame;
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::rigid::RigidMotion;
use crate::linalg::echelon::{Echelon, linear_combination, linear_relations};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::motion::drive_range::Way;
use crate::motion::pose::{FLAT, Pose};
use crate::rank::reduce::axis_names::Direction;
use crate::redundancy::motion::{Speeds, link_twist, link_twists};
use ozols_dense::{add_scaled, difference, dot, largest_entry, norm, svd};
use std::f64::consts::TAU;

/// One idle motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Idle {
    /// The links that move. A single one if the motion involves no other link.
    pub links: Vec<LinkId>,
    /// Whether these links move as one body.
    pub as_one: bool,
    /// Joints between these links and others that move, if the links do not move as one.
    pub moving: Vec<JointId>,
    /// Joints of one body whose points the motion leaves at rest. Two of them define the line it spins about.
    pub through: Vec<JointId>,
    /// Whether one body only turns (rather than slides).
    pub turns: bool,
    /// The axis or direction of the motion, for one body and if it has a name.
    pub direction: Option<Direction>,
}

/// Returns a basis of the motions that leave the outputs at rest. Motions of single links come first.
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
    let ids: Vec<LinkId> = mechanism.links_in(closure.state).collect();
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
        let joints: Vec<JointId> = mechanism.joints_at(l, closure.state).collect();
        for speeds in links.motions_alone(l, &joints) {
            if span.insert(&speeds) {
                let own = link_twist(exact, &links.motion[at], &speeds);
                found.push(links.motion_of_body(vec![l], &own));
            }
        }
    }
    for speeds in all {
        if span.insert(&speeds) {
            found.push(links.motion_of_links(&speeds));
        }
    }
    found
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
    let moved = kernel.iter().map(|x| link_twists(exact, &of_outputs, x));
    let all = linear_relations(f, &moved.collect::<Vec<_>>());
    all.iter()
        .map(|factors| linear_combination(f, kernel, factors))
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
        Links {
            exact,
            mechanism,
            closure,
            motion: closure.link_motions(exact, mechanism, &ids),
            ids,
            rows: closure.dense_columns(exact),
        }
    }

    /// Returns the motion of links as one body, with its twist.
    fn motion_of_body(&self, links: Vec<LinkId>, twist: &[Residue]) -> Idle {
        let joints = self.mechanism.joints_in(self.closure.state);
        let at_end = |j: &JointId| {
            let ends = self.mechanism.joints[*j].links;
            ends.iter().filter(|l| links.contains(l)).count() == 1
        };
        let rests = |j: &JointId| rests_at(self.exact, self.mechanism, *j, twist);
        Idle {
            through: joints.filter(at_end).filter(rests).collect(),
            as_one: true,
            moving: Vec::new(),
            turns: twist.len() == 6 && twist[..3].iter().any(|&x| x != 0),
            direction: motion_direction(self.exact, self.mechanism, twist),
            links,
        }
    }

    /// Returns the motion of several links at some speeds.
    fn motion_of_links(&self, speeds: &Speeds) -> Idle {
        let twists = self.ids.iter().zip(&self.motion);
        let twists = twists.map(|(l, m)| (*l, link_twist(self.exact, m, speeds)));
        let moved: Vec<_> = twists.filter(|(_, t)| t.iter().any(|&x| x != 0)).collect();
        let links = moved.iter().map(|(l, _)| *l).collect();
        if let Some((_, twist)) = moved
            .first()
            .filter(|(_, t)| moved.iter().all(|(_, u)| u == t))
        {
            return self.motion_of_body(links, twist);
        }
        let columns = self.closure.columns.iter().zip(speeds);
        let moving = columns.filter(|(_, x)| **x != 0).map(|(c, _)| c.joint);
        let mut moving: Vec<JointId> = moving.collect();
        moving.dedup();
        Idle {
            links,
            as_one: false,
            moving,
            through: Vec::new(),
            turns: false,
            direction: None,
        }
    }

    /// Returns the motions of a single link. Only its own joints move, and its neighbours and everything behind them
    /// are at rest.
    fn motions_alone(&self, link: LinkId, joints: &[JointId]) -> Vec<Speeds> {
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
        linear_relations(self.exact.field(), &images)
            .into_iter()
            .map(whole)
            .collect()
    }
}

/// Returns the rotation axis of a twist, or its direction of sliding if it does not turn.
fn motion_direction(exact: &ExactField, mechanism: &Mechanism, t: &[Residue]) -> Option<Direction> {
    let &[w0, w1, w2, v0, v1, v2] = t else {
        return None;
    };
    let of = if [w0, w1, w2] == [0; 3] {
        [v0, v1, v2]
    } else {
        [w0, w1, w2]
    };
    Direction::name_direction(exact, mechanism, of)
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

/// The largest coordinate of the animation: radians, or fractions of [`Pose::length`].
pub const FAR: f64 = 0.35;
/// Number of poses of the animation.
const STEPS: usize = 48;
/// Share of a step beyond which a closed pose is too far from the first-order prediction and belongs to another motion.
const ASTRAY: f64 = 0.5;

/// An idle freedom as an animation.
#[derive(Debug, Clone)]
pub struct Wiggle {
    /// The poses, once back and forth.
    pub way: Way,
    /// Whether every pose closes. If not, the poses follow the motion to first order, and parts separate to second
    /// order.
    pub closed: bool,
}

/// Returns one of the idle motions of a state. `None` if the numerical null vectors do not show it.
///
/// # Errors
/// Returns an error if a coordinate has no value.
///
/// # Complexity
/// Singular values of a matrix for each motion up to the requested one. It has six rows per contour and per link at rest.
/// Then one closure per pose.
pub fn animate_idle(
    mechanism: &Mechanism,
    state: StateId,
    idle: &[Idle],
    which: usize,
) -> Result<Option<Wiggle>, ExactError> {
    let pose = Pose::of_file(mechanism, state)?;
    let Some(speeds) = speeds_of_idle(mechanism, state, &pose, idle, which) else {
        return Ok(None);
    };
    let largest = largest_entry(&speeds);
    // links at rest in it stay at rest throughout
    let moving = |l: &LinkId| idle[which].links.contains(l);
    let rests = |&c: &usize| {
        !mechanism.joints[pose.columns[c].joint]
            .links
            .iter()
            .any(moving)
    };
    let held: Vec<usize> = (0..speeds.len()).filter(rests).collect();
    let mut closed = true;
    let mut at = Vec::new();
    let mut links = Vec::new();
    for step in 0..=STEPS {
        let far = FAR * (TAU * step as f64 / STEPS as f64).sin();
        let ahead: Vec<f64> = speeds.iter().map(|x| x * far / largest).collect();
        let near = |q: &Vec<f64>| norm(&difference(q, &ahead)) <= ASTRAY * norm(&ahead);
        let found = pose.close_loops(ahead.clone(), &held).ok().filter(near);
        closed &= found.is_some();
        let mut there = pose.moved_to(&found.unwrap_or(ahead)).links;
        // they are connected to moving links, within the closure tolerance
        for l in mechanism.link_ids().filter(|l| !moving(l)) {
            there[l.index()] = RigidMotion::IDENTITY;
        }
        links.push(there);
        at.push(far);
    }
    let way = Way {
        at,
        links,
        start: 0,
        closed: true,
        ends: [None, None],
    };
    Ok(Some(Wiggle { way, closed }))
}

/// Returns the speeds of one of the motions: the null vectors under which the same links are at rest, less the earlier
/// motions of some of these links.
fn speeds_of_idle(
    mechanism: &Mechanism,
    state: StateId,
    pose: &Pose,
    idle: &[Idle],
    which: usize,
) -> Option<Vec<f64>> {
    let mut before: Vec<(&[LinkId], Vec<f64>)> = Vec::new();
    for motion in &idle[..=which] {
        let resting = mechanism
            .link_ids()
            .filter(|l| !motion.links.contains(l))
            .map(|l| path_from_frame(mechanism, state, l));
        let resting: Vec<Vec<(JointId, bool)>> = resting.filter(|p| !p.is_empty()).collect();
        let svd = svd(&pose.jacobian_with(&resting, &[]))?;
        let null = svd.null_space(svd.rank(FLAT));
        let within = |links: &[LinkId]| links.iter().all(|l| motion.links.contains(l));
        let candidates = (0..null.ncols()).map(|c| {
            let mut v = null.col(c).to_vec();
            for (_, other) in before.iter().filter(|(links, _)| within(links)) {
                v = add_scaled(&v, -dot(&v, other), other);
            }
            let size = norm(&v);
            v.iter_mut().for_each(|x| *x /= size);
            (size, v)
        });
        let (size, v) = candidates.max_by(|a, b| a.0.total_cmp(&b.0))?;
        if size < FLAT {
            return None;
        }
        before.push((&motion.links, v));
    }
    before.pop().map(|(_, v)| v)
}
