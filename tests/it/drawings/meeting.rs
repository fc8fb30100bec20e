//! Joints whose axes meet in a point stand farther along them, each somewhere on its own axis.

use super::places::{Point, Shown, axis, point};
use crate::common::*;
use ozols::draw::{Sight, Subject, kinematic_seen};

/// Views: towards whom, what is right on paper, and what is up.
const SIDES: [[[f64; 3]; 3]; 3] = [
    [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
];

fn meet(m: &Mechanism, a: JointId, b: JointId) -> bool {
    let same = (0..3).all(|i| (point(m, a)[i] - point(m, b)[i]).abs() < 1e-9);
    a != b && same && dot(axis(m, a), axis(m, b)).abs() < 1.0 - 1e-9
}

/// Equations a·s + b·u + c·v = d of the scale s and the shift (u, v) of a drawing.
fn equations(
    m: &Mechanism,
    state: StateId,
    [_, right, up]: [[f64; 3]; 3],
    shown: &Shown,
) -> Vec<[f64; 4]> {
    let flat = |v: [f64; 3]| [dot(right, v), -dot(up, v)];
    let joints: Vec<JointId> = m.joints_in(state).collect();
    let mut out = Vec::new();
    for &j in &joints {
        let at = shown.joints[&m.joints[j].id];
        let p = flat(point(m, j));
        let along = flat(axis(m, j));
        if !joints.iter().any(|&k| meet(m, j, k)) {
            out.extend([[p[0], 1.0, 0.0, at[0]], [p[1], 0.0, 1.0, at[1]]]);
            continue;
        }
        // a slide may stand anywhere; an axis along the view is a point
        let length = along[0].hypot(along[1]);
        if m.joints[j].joint_type == JointType::Prismatic {
            continue;
        }
        if length < 1e-9 {
            out.extend([[p[0], 1.0, 0.0, at[0]], [p[1], 0.0, 1.0, at[1]]]);
            continue;
        }
        // the distance of where it is drawn from the axis
        let across = [-along[1] / length, along[0] / length];
        let of = |q: Point| q[0] * across[0] + q[1] * across[1];
        out.push([of(p), across[0], across[1], of(at)]);
    }
    out
}

/// The largest residual of the least squares, by normal equations; what nothing determines is held near 0.
fn residual(all: &[[f64; 4]]) -> f64 {
    let sum = |i: usize, k: usize| all.iter().map(|e| e[i] * e[k]).sum::<f64>();
    let size = (0..3).map(|i| sum(i, i)).fold(0.0, f64::max);
    let entry = |i: usize, k: usize| sum(i, k) + if i == k { 1e-13 * size } else { 0.0 };
    let columns = [0, 1, 2].map(|k| (0..3).map(|i| entry(i, k)).collect_vec());
    let x = crate::catalogue::solve_square(&columns, &[0, 1, 2].map(|i| sum(i, 3)));
    let off = |e: &[f64; 4]| (e[0] * x[0] + e[1] * x[1] + e[2] * x[2] - e[3]).abs();
    all.iter().map(off).fold(0.0, f64::max)
}

#[test]
fn joints_that_meet_in_a_point_stand_on_their_own_axes() {
    let (mut wrong, mut looked) = (Vec::new(), 0);
    for name in builtin::names() {
        let m = built_in(name);
        for state in m.state_ids() {
            let joints: Vec<JointId> = m.joints_in(state).collect();
            let meeting = |a: &JointId| joints.iter().any(|&b| meet(&m, *a, b));
            if !joints.iter().any(meeting) {
                continue;
            }
            for side in SIDES {
                let subject = Subject {
                    mechanism: &m,
                    state,
                    analysis: None,
                    marks: None,
                };
                let sight = Sight {
                    toward: Some(side[0]),
                    up: None,
                };
                let d = kinematic_seen(&subject, &sight, None);
                let all = equations(&m, state, side, &super::places::shown(&d));
                looked += 1;
                let off = residual(&all);
                // coordinates are written to a hundredth of a pixel
                if off > 0.05 {
                    wrong.push(format!("{name} {}: {off:.2} pixels off", m.states[state]));
                }
            }
        }
    }
    assert!(looked > 30, "{looked}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}
