//! Joints whose axes meet in a point stand farther along them, each somewhere on its own axis.

use super::places::{Point, Shown, axis, point};
use crate::common::*;
use ozols::draw::{Sight, Subject, kinematic_seen};

/// A view by what is right and up on paper.
struct Side {
    toward: [f64; 3],
    right: [f64; 3],
    up: [f64; 3],
}

const SIDES: [Side; 3] = [
    Side {
        toward: [0.0, 0.0, 1.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
    },
    Side {
        toward: [0.0, -1.0, 0.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 0.0, 1.0],
    },
    Side {
        toward: [1.0, 0.0, 0.0],
        right: [0.0, 1.0, 0.0],
        up: [0.0, 0.0, 1.0],
    },
];

impl Side {
    fn flat(&self, v: [f64; 3]) -> Point {
        [dot(self.right, v), -dot(self.up, v)]
    }
}

fn meet(m: &Mechanism, a: JointId, b: JointId) -> bool {
    let same = (0..3).all(|i| (point(m, a)[i] - point(m, b)[i]).abs() < 1e-9);
    a != b && same && dot(axis(m, a), axis(m, b)).abs() < 1.0 - 1e-9
}

/// Equations a·s + b·u + c·v = d of the scale s and the shift (u, v) of a drawing.
fn equations(m: &Mechanism, state: StateId, side: &Side, shown: &Shown) -> Vec<[f64; 4]> {
    let joints: Vec<JointId> = m.joints_in(state).collect();
    let mut out = Vec::new();
    for &j in &joints {
        let at = shown.joints[&m.joints[j].id];
        let p = side.flat(point(m, j));
        let along = side.flat(axis(m, j));
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

/// The largest residual of the least squares.
fn residual(all: &[[f64; 4]]) -> f64 {
    // normal equations by Gauss with pivoting; unknowns that nothing determines are 0
    let mut a = [[0.0f64; 4]; 3];
    for e in all {
        for i in 0..3 {
            for k in 0..4 {
                a[i][k] += e[i] * e[k];
            }
        }
    }
    let size: f64 = (0..3).map(|i| a[i][i]).fold(0.0, f64::max);
    let mut x = [0.0f64; 3];
    let mut pivots = Vec::new();
    for column in 0..3 {
        let free = (0..3).filter(|r| !pivots.iter().any(|&(p, _)| p == *r));
        let best = free.max_by(|&r, &q| a[r][column].abs().total_cmp(&a[q][column].abs()));
        let Some(row) = best.filter(|&r| a[r][column].abs() > 1e-9 * size) else {
            continue;
        };
        let pivot = a[row];
        for r in (0..3).filter(|&r| r != row) {
            let by = a[r][column] / pivot[column];
            for (x, p) in a[r].iter_mut().zip(pivot) {
                *x -= by * p;
            }
        }
        pivots.push((row, column));
    }
    for (row, column) in pivots {
        x[column] = a[row][3] / a[row][column];
    }
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
            for side in &SIDES {
                let subject = Subject {
                    mechanism: &m,
                    state,
                    analysis: None,
                    marks: None,
                };
                let sight = Sight {
                    toward: Some(side.toward),
                    up: None,
                };
                let d = kinematic_seen(&subject, &sight);
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
