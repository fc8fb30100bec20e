//! Assembly forces of inaccurate joints, against a twin by displacements: each joint is a spring in its constrained directions, and the
//! links move to where the energy is least. The program uses self-stresses, so the two share no equations.

use ozols::geom::vector::to_vector;
use ozols::model::mechanism::{Mechanism, StateId};
use ozols::statics::reactions::misfit::{Misfit, Tolerances, misfit};

const TOLERANCES: Tolerances = Tolerances {
    position: 1e-4,
    angle: 1e-3,
};
const LINEAR: f64 = 1e7;
const ANGULAR: f64 = 1e4;

/// Numbers of the standard normal distribution: sums of twelve uniform ones.
struct Normal(u64);

impl Normal {
    fn next(&mut self) -> f64 {
        let mut unit = || {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| unit()).sum::<f64>() - 6.0
    }
}

/// Solves a positive definite system.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for c in 0..n {
        for r in c + 1..n {
            let factor = a[r][c] / a[c][c];
            let pivot = a[c].clone();
            for (x, p) in a[r].iter_mut().zip(&pivot) {
                *x -= factor * p;
            }
            b[r] -= factor * b[c];
        }
    }
    for c in (0..n).rev() {
        b[c] = (b[c] - (c + 1..n).map(|k| a[c][k] * b[k]).sum::<f64>()) / a[c][c];
    }
    b
}

/// The mean force at each joint of a mechanism of hinges about z, by displacements of the links.
fn mean_forces(m: &Mechanism, samples: usize) -> Vec<f64> {
    let metres = m.length_unit.metres;
    let points: Vec<[f64; 3]> = m
        .joints
        .iter()
        .map(|j| to_vector(&j.frame.point).map(|x| x * metres))
        .collect();
    let (frame, free) = (m.frame_link(), 6 * m.links.len());
    // The rows of each joint: how links displace it, turns first; the turn about z is free.
    let rows: Vec<Vec<(f64, Vec<f64>)>> = m
        .joints
        .iter()
        .zip(&points)
        .map(|(j, p)| {
            (0..6)
                .filter(|k| *k != 2)
                .map(|k| {
                    let mut row = vec![0.0; free];
                    for (link, sign) in [(j.links[0], -1.0), (j.links[1], 1.0)] {
                        let at = 6 * link.index();
                        row[at + k] += sign;
                        // A turn w about the origin moves the point by w × p.
                        let [x, y, z] = *p;
                        let by_turns = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
                        if let Some(axis) = k.checked_sub(3) {
                            for (turn, factor) in by_turns[axis].iter().enumerate() {
                                row[at + turn] += sign * factor;
                            }
                        }
                    }
                    (if k < 3 { ANGULAR } else { LINEAR }, row)
                })
                .collect()
        })
        .collect();
    let mut stiff = vec![vec![0.0; free]; free];
    for (k, row) in rows.iter().flatten() {
        for (a, x) in row.iter().enumerate().filter(|(_, x)| **x != 0.0) {
            for (b, y) in row.iter().enumerate() {
                stiff[a][b] += k * x * y;
            }
        }
    }
    // The frame is held, and motions of the mechanism meet a spring that is too soft to count.
    for (n, row) in stiff.iter_mut().enumerate() {
        row[n] += if n / 6 == frame.index() { 1e12 } else { 1e-3 };
    }
    let mut random = Normal(7);
    let mut sums = vec![0.0; points.len()];
    for _ in 0..samples {
        let errors: Vec<Vec<f64>> = rows
            .iter()
            .map(|rows| {
                rows.iter()
                    .map(|(k, _)| {
                        let tolerance = if *k == ANGULAR {
                            TOLERANCES.angle
                        } else {
                            TOLERANCES.position
                        };
                        tolerance / 3.0 * random.next()
                    })
                    .collect()
            })
            .collect();
        let mut right = vec![0.0; free];
        for ((k, row), e) in rows.iter().flatten().zip(errors.iter().flatten()) {
            for (b, x) in right.iter_mut().zip(row) {
                *b += k * x * e;
            }
        }
        let moved = solve(stiff.clone(), right);
        for ((sum, rows), errors) in sums.iter_mut().zip(&rows).zip(&errors) {
            let force = rows
                .iter()
                .zip(errors)
                .filter(|((k, _), _)| *k == LINEAR)
                .map(|((k, row), e)| {
                    let strain = row.iter().zip(&moved).map(|(a, b)| a * b).sum::<f64>() - e;
                    (k * strain).powi(2)
                });
            *sum += force.sum::<f64>().sqrt();
        }
    }
    sums.iter().map(|s| s / samples as f64).collect()
}

fn misfit_of(m: &Mechanism) -> Misfit {
    misfit(m, StateId::FREE, TOLERANCES, 50.0, 1).unwrap()
}

#[test]
fn assembly_forces_are_those_of_displacements() {
    for name in ["four-bar", "parallelogram-3-rods"] {
        let m = ozols::built_in(name).unwrap();
        let found = misfit_of(&m);
        for (joint, mean) in found.joints.iter().zip(mean_forces(&m, 2_000)) {
            assert!(
                (joint.force.mean - mean).abs() < 0.05 * mean,
                "{name}: {joint:?}, {mean}"
            );
            assert!(joint.force.most > joint.force.mean);
        }
    }
}

/// The argument of [Pogrebnyak 2018] for determinate mechanisms, as a number.
#[test]
fn determinate_redesigns_assemble_without_force() {
    let m = ozols::built_in("gripper-10").unwrap();
    let as_built = misfit_of(&m);
    assert!(as_built.force.mean > 10.0, "{:?}", as_built.force);
    assert!(as_built.by_hand < 1.0);
    let best = ozols::search(&m, &ozols::Request::default()).unwrap();
    let best = best.variants().next().unwrap().as_mechanism();
    let redesigned = misfit_of(&best);
    assert!(
        redesigned.force.most < 1e-6 * as_built.force.mean,
        "{:?}",
        redesigned.force
    );
    assert!((redesigned.by_hand - 1.0).abs() < 1e-12);
}
