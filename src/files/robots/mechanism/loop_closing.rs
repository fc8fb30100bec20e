//! Closing loops: damped least squares over all joint values, from the pose of the file.

use crate::robots::description::kinematics::{Tree, joint_motion, link_places, world_axes};
use crate::robots::prelude::*;
use ozols_dense::{Matrix, solve_positive};

/// A loop that is open by less than this fraction of the robot's size counts as closed: coordinates are rounded.
pub(crate) const CLOSED: f64 = 1e-6;
/// A loop that is open by less than this fraction also counts as closed if no motion of the joints closes it further. With redundant
/// constraints, rounded coordinates contradict each other in their last digit. It is reported.
pub(crate) const ROUNDED: f64 = 5e-4;
/// Maximum number of unknowns; with more, a pose must be given.
const MAX_UNKNOWNS: usize = 600;
/// Maximum number of steps from one start, and of starts.
const STEPS: usize = 300;
const STARTS: usize = 12;
/// Maximum step of a joint, in radians or sizes of the robot: the loops close near by or not at all.
const LONGEST: f64 = 0.3;

/// Error of a loop that is not closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gap {
    pub(in crate::robots) joint: usize,
    /// In metres.
    pub(in crate::robots) shift: f64,
    /// In radians.
    pub(in crate::robots) turn: f64,
}

/// Returns the size of the robot: the largest distance between joints of one link, for weighing angles against lengths.
pub(crate) fn robot_size(robot: &Robot) -> f64 {
    let sides = robot.joints.iter().flat_map(|j| &j.sides);
    sides.map(|s| length(s.translation)).fold(1e-3, f64::max)
}

/// Returns the difference between the two sides of a loop joint: a shift and a rotation vector, in the world.
fn loop_mismatch(robot: &Robot, places: &[RigidMotion], j: usize) -> (Vector, Vector) {
    let [near, far] = loop_sides(&robot.joints[j], places);
    let turn = match free_turns(robot, j) {
        3 => [0.0; 3],
        _ => near.map_direction(near.inverse().then(&far).rotation_vector()),
    };
    (sub(far.translation, near.translation), turn)
}

/// Returns the places of the two sides of a loop joint, the first moved by the joint.
fn loop_sides(p: &Part, places: &[RigidMotion]) -> [RigidMotion; 2] {
    let [a, b] = [0, 1].map(|i| places[p.links[i]].then(&p.sides[i]));
    [a.then(&joint_motion(p)), b]
}

fn free_turns(robot: &Robot, j: usize) -> usize {
    let freedoms = robot.joints[j].joint_type.freedoms().iter();
    freedoms.filter(|f| f.is_turn()).count()
}

/// Returns the gaps of all loops.
pub(crate) fn loop_gaps(robot: &Robot, tree: &Tree) -> Vec<Gap> {
    let places = link_places(robot, tree);
    let gap = |&joint: &usize| {
        let (shift, turn) = loop_mismatch(robot, &places, joint);
        let (shift, turn) = (length(shift), length(turn));
        Gap { joint, shift, turn }
    };
    tree.loops.iter().map(gap).collect()
}

/// Returns the largest gap as a length.
pub(crate) fn worst_gap(gaps: &[Gap], size: f64) -> f64 {
    gaps.iter()
        .map(|g| g.shift.max(g.turn * size))
        .fold(0.0, f64::max)
}

/// Adjusts the joint values so that the loops close, staying near the current values. Returns the largest gap left and the number
/// of joints outside their limits.
///
/// It tries several starts and takes the first that closes with all joints within their limits. If there is none, it takes the
/// one that breaks the fewest limits, then the first that comes as near as rounded coordinates allow; otherwise the values stay.
pub(crate) fn close_numerically(robot: &mut Robot, tree: &Tree) -> (f64, usize) {
    let size = robot_size(robot);
    let first = joint_values(robot);
    let mut best: Option<(usize, f64, Vec<Vec<f64>>)> = None;
    let mut near = None;
    for start in 0..STARTS {
        set_values(robot, &first);
        if start > 0 {
            set_start(robot, start);
        }
        let left = minimise_gaps(robot, tree, size);
        if left > ROUNDED * size || (left > CLOSED * size && near.is_some()) {
            continue;
        }
        let inside = robot.joints.iter_mut().map(wind_back);
        let broken = inside.filter(|inside| !inside).count();
        let values = joint_values(robot);
        if left > CLOSED * size {
            near = Some((broken, left, values));
            continue;
        }
        if best.as_ref().is_none_or(|(b, ..)| broken < *b) {
            best = Some((broken, left, values));
        }
        if broken == 0 {
            break;
        }
    }
    match best.or(near) {
        Some((broken, left, values)) => {
            set_values(robot, &values);
            (left, broken)
        }
        None => {
            set_values(robot, &first);
            (worst_gap(&loop_gaps(robot, tree), size), 0)
        }
    }
}

/// Returns the values of all joints.
pub(crate) fn joint_values(robot: &Robot) -> Vec<Vec<f64>> {
    robot.joints.iter().map(|j| j.values.clone()).collect()
}

fn set_values(robot: &mut Robot, values: &[Vec<f64>]) {
    for (j, v) in robot.joints.iter_mut().zip(values) {
        j.values.clone_from(v);
    }
}

/// Removes whole turns from angles. Returns true if the joint is within its limits.
fn wind_back(j: &mut Part) -> bool {
    const TURN: f64 = std::f64::consts::TAU;
    let middle = j.limits.map_or(0.0, |(low, high)| f64::midpoint(low, high));
    for (v, f) in j.values.iter_mut().zip(j.joint_type.freedoms()) {
        if f.is_turn() {
            *v -= TURN * ((*v - middle) / TURN).round();
        }
    }
    match (&j.values[..], j.limits) {
        ([v], Some((low, high))) => (low - 1e-3..=high + 1e-3).contains(v),
        _ => true,
    }
}

/// Sets other values to start from: limited joints within their limits, others slightly rotated, differently each time.
fn set_start(robot: &mut Robot, start: usize) {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(start as u64);
    for j in &mut robot.joints {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        #[allow(clippy::cast_precision_loss, reason = "53 bits")]
        let part = (state >> 11) as f64 / (1_u64 << 53) as f64;
        let turns = matches!(j.joint_type.freedoms(), [Freedom::Rz]);
        if let ([value], Some((low, high))) = (&mut j.values[..], j.limits) {
            // The middle at first, then anywhere.
            let part = if start == 1 { 0.5 } else { part };
            if start > 1 || !(low..=high).contains(value) {
                *value = low + part * (high - low);
            }
        } else if turns && start > 1 {
            j.values[0] += part - 0.5;
        }
    }
}

/// Minimises the gaps by Levenberg-Marquardt with the exact twists as derivatives.
fn minimise_gaps(robot: &mut Robot, tree: &Tree, size: f64) -> f64 {
    let (mut offsets, mut unknowns) = (Vec::new(), 0);
    for j in &robot.joints {
        offsets.push(unknowns);
        unknowns += j.values.len();
    }
    let mut left = worst_gap(&loop_gaps(robot, tree), size);
    if unknowns == 0 || unknowns > MAX_UNKNOWNS {
        return left;
    }
    let (mut damping, mut cost) = (1e-4, gap_cost(robot, tree, size));
    let mut milestone = cost;
    for step in 1..=STEPS {
        // Hardly nearer for a while: a minimum that is not a closed pose.
        if step % 25 == 0 && std::mem::replace(&mut milestone, cost) * 0.99 < cost {
            break;
        }
        if left <= 1e-14 * size || damping > 1e8 {
            break;
        }
        let (jacobian, residual) = linearise_gaps(robot, tree, size, &offsets, unknowns);
        let mut normal = jacobian.transpose_times(&jacobian);
        let right = jacobian.transpose_times(&residual);
        for i in 0..unknowns {
            normal[(i, i)] += damping;
        }
        let Some(change) = solve_positive(&normal, right.col(0)) else {
            damping *= 10.0;
            continue;
        };
        let before = joint_values(robot);
        let longest = change.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let shrink = (LONGEST / longest).min(1.0);
        for (j, &first) in robot.joints.iter_mut().zip(&offsets) {
            for (i, (v, f)) in j.values.iter_mut().zip(j.joint_type.freedoms()).enumerate() {
                *v += shrink * change[first + i] * if f.is_slide() { size } else { 1.0 };
            }
        }
        let after = gap_cost(robot, tree, size);
        if after < cost {
            (cost, damping) = (after, (damping / 5.0).max(1e-15));
            left = worst_gap(&loop_gaps(robot, tree), size);
        } else {
            set_values(robot, &before);
            damping = (damping * 4.0).max(1e-12);
        }
    }
    left
}

fn gap_cost(robot: &Robot, tree: &Tree, size: f64) -> f64 {
    let places = link_places(robot, tree);
    let square = |v: Vector| dot(v, v);
    let cost = |&j: &usize| {
        let (shift, turn) = loop_mismatch(robot, &places, j);
        square(scale(shift, 1.0 / size)) + square(turn)
    };
    tree.loops.iter().map(cost).sum()
}

/// Returns the derivative of "near side less far side" and the mismatch to be corrected.
fn linearise_gaps(
    robot: &Robot,
    tree: &Tree,
    size: f64,
    offsets: &[usize],
    unknowns: usize,
) -> (Matrix, Matrix) {
    let places = link_places(robot, tree);
    let rows = 6 * tree.loops.len();
    let mut jacobian = Matrix::zeros(rows, unknowns);
    let mut residual = Matrix::zeros(rows, 1);
    for (n, &j) in tree.loops.iter().enumerate() {
        let (shift, turn) = loop_mismatch(robot, &places, j);
        let turning = free_turns(robot, j) != 3;
        for i in 0..3 {
            residual[(6 * n + i, 0)] = shift[i] / size;
            residual[(6 * n + 3 + i, 0)] = turn[i];
        }
        let p = &robot.joints[j];
        let [near, far] = loop_sides(p, &places).map(|side| side.translation);
        let mut put = |joint: usize, at: Vector, sign: f64| {
            let part = &robot.joints[joint];
            for (i, a) in world_axes(part, &places).iter().enumerate() {
                let d = unit_or_z(a.direction);
                let (v, w) = match a.freedom {
                    Freedom::Rx | Freedom::Ry | Freedom::Rz => (cross(d, sub(at, a.point)), d),
                    Freedom::Tx | Freedom::Ty | Freedom::Tz => (scale(d, size), [0.0; 3]),
                    Freedom::Screw => {
                        let along = scale(d, part.pitch);
                        (add(cross(d, sub(at, a.point)), along), d)
                    }
                };
                for k in 0..3 {
                    jacobian[(6 * n + k, offsets[joint] + i)] += sign * v[k] / size;
                    if turning {
                        jacobian[(6 * n + 3 + k, offsets[joint] + i)] += sign * w[k];
                    }
                }
            }
        };
        put(j, near, 1.0);
        for (link, at, sign) in [(p.links[0], near, 1.0), (p.links[1], far, -1.0)] {
            let mut next = tree.into[link];
            while let Some(s) = next.map(|s| tree.steps[s]) {
                put(s.joint, at, if s.forward { sign } else { -sign });
                next = tree.into[s.from];
            }
        }
    }
    (jacobian, residual)
}
