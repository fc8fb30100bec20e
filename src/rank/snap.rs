//! Snapping measured geometry: axes that are parallel, square, coaxial or concurrent but for errors of measurement are made
//! so exactly, and everything moved is listed. The coordinates stay rational, so exact arithmetic applies afterwards.

use crate::geom::expr::Expr;
use crate::geom::vector::{Vector, cross, dot, length, real, sub, unit};
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Frame, JointId, Mechanism};

/// A mechanism with its near-coincidences made exact.
#[derive(Debug, Clone)]
pub struct Snapped {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What was moved, a sentence each.
    pub moved: Vec<String>,
}

fn exact_dot(a: &[Expr; 3], b: &[Expr; 3]) -> Expr {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}
fn exact_cross(a: &[Expr; 3], b: &[Expr; 3]) -> [Expr; 3] {
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}
/// a·s + b·t
fn exact_sum(a: &[Expr; 3], s: &Expr, b: &[Expr; 3], t: &Expr) -> [Expr; 3] {
    [0, 1, 2].map(|i| &(&a[i] * s) + &(&b[i] * t))
}

/// Directions met so far, exact, the global axes first.
struct Directions {
    known: Vec<[Expr; 3]>,
    tolerance: f64,
}

impl Directions {
    /// The exact direction that `d` is within the tolerance of, with how it was found; `d` itself where there is none.
    fn place(&mut self, d: &[Expr; 3]) -> ([Expr; 3], Option<&'static str>) {
        let v = unit(real(d));
        for k in &self.known {
            let u = unit(real(k));
            let along = dot(u, v);
            if length(cross(u, v)) <= self.tolerance {
                let sign = Expr::from(if along < 0.0 { -1 } else { 1 });
                let same = exact_cross(k, d).iter().all(is_zero);
                let out = k.clone().map(|x| &x * &sign);
                return if same {
                    (d.clone(), None)
                } else {
                    (out, Some("parallel"))
                };
            }
        }
        let square: Vec<[Expr; 3]> = self
            .known
            .iter()
            .filter(|k| dot(unit(real(k)), v).abs() <= self.tolerance)
            .cloned()
            .collect();
        let mut out = (d.clone(), None);
        if let Some(first) = square.first() {
            let across = square
                .iter()
                .find(|k| length(cross(unit(real(first)), unit(real(k)))) > 0.1);
            let snapped = match across {
                Some(second) => {
                    let c = exact_cross(first, second);
                    let sign = Expr::from(if dot(real(&c), v) < 0.0 { -1 } else { 1 });
                    c.map(|x| &x * &sign)
                }
                // d (k·k) - k (d·k)
                None => exact_sum(
                    d,
                    &exact_dot(first, first),
                    first,
                    &(&Expr::from(-1) * &exact_dot(first, d)),
                ),
            };
            if !exact_cross(&snapped, d).iter().all(is_zero) {
                out = (snapped, Some("square"));
            }
        }
        self.known.push(out.0.clone());
        out
    }
}

fn is_zero(e: &Expr) -> bool {
    e.is_zero_rational() || (e.as_rational().is_none() && e.to_f64() == 0.0)
}

/// Whether a joint's axis matters as a direction, and as a line.
fn uses(joint_type: &JointType) -> (bool, bool) {
    let freedoms = joint_type.freedoms();
    let turn = |f: &Freedom| matches!(f, Freedom::Rx | Freedom::Ry | Freedom::Rz | Freedom::Screw);
    let all_turns = [Freedom::Rx, Freedom::Ry, Freedom::Rz]
        .iter()
        .all(|r| freedoms.contains(r));
    (!all_turns || freedoms.len() > 3, freedoms.iter().any(turn))
}

/// Makes near-coincidences exact: directions within `tolerance` (radians) of each other or of square, lines within
/// `tolerance` times the size of the mechanism of a common point or of each other.
///
/// # Complexity
/// O(p³) in the number of joints p.
#[must_use]
pub fn snap(mechanism: &Mechanism, tolerance: f64) -> Snapped {
    let mut out = mechanism.clone();
    let mut moved = Vec::new();
    let points: Vec<Vector> = out.joints.iter().map(|j| real(&j.frame.point)).collect();
    // Errors go with the size of the coordinates, and a mechanism about one point has no other size.
    let size = points
        .iter()
        .flatten()
        .fold(f64::MIN_POSITIVE, |a, x| a.max(x.abs()));
    let near = tolerance * size;
    zeros(&mut out, near, tolerance, &mut moved);
    let mut directions = Directions {
        known: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
            .iter()
            .map(|a| a.map(Expr::from))
            .collect(),
        tolerance,
    };
    for j in 0..out.joints.len() {
        let joint = &mut out.joints[j];
        if !uses(&joint.joint_type).0 {
            continue;
        }
        let (axis, how) = directions.place(&joint.frame.axis);
        if let Some(how) = how {
            moved.push(format!(
                "axis of joint {} made {how} to another axis",
                joint.id
            ));
            joint.frame.axis = axis;
        }
        if joint
            .joint_type
            .freedoms()
            .iter()
            .any(|f| matches!(f, Freedom::Rx | Freedom::Tx | Freedom::Ry | Freedom::Ty))
        {
            let (reference, how) = directions.place(&joint.frame.reference);
            if let Some(how) = how {
                moved.push(format!(
                    "reference of joint {} made {how} to another axis",
                    joint.id
                ));
                joint.frame.reference = reference;
            }
        }
    }
    concurrent(&mut out, near, &mut moved);
    // Options that shared the joint's frame share it still.
    for (joint, before) in out.joints.iter_mut().zip(&mechanism.joints) {
        for option in joint.options.iter_mut().chain(&mut joint.unloading) {
            if same(&option.frame, &before.frame) {
                let pitch = option.frame.pitch.clone();
                option.frame = Frame {
                    pitch,
                    ..joint.frame.clone()
                };
            }
        }
    }
    Snapped {
        mechanism: out,
        moved,
    }
}

fn same(a: &Frame, b: &Frame) -> bool {
    let equal = |x: &[Expr; 3], y: &[Expr; 3]| real(x) == real(y);
    equal(&a.point, &b.point) && equal(&a.axis, &b.axis) && equal(&a.reference, &b.reference)
}

/// Rounding residues become zero.
fn zeros(mechanism: &mut Mechanism, near: f64, tolerance: f64, moved: &mut Vec<String>) {
    for joint in &mut mechanism.joints {
        let mut count = 0;
        for (vector, limit) in [
            (&mut joint.frame.point, near),
            (&mut joint.frame.axis, 0.0),
            (&mut joint.frame.reference, 0.0),
        ] {
            let limit = if limit > 0.0 {
                limit
            } else {
                tolerance * length(real(vector))
            };
            for x in vector.iter_mut() {
                let value = x.to_f64();
                if value != 0.0 && value.abs() <= limit && value.abs() < limit.max(1e-12) {
                    *x = Expr::from(0);
                    count += 1;
                }
            }
        }
        if count > 0 {
            moved.push(format!(
                "{count} small coordinate{} of joint {} set to 0",
                if count == 1 { "" } else { "s" },
                joint.id
            ));
        }
    }
}

/// Lines through a common point, and lines that coincide.
fn concurrent(mechanism: &mut Mechanism, near: f64, moved: &mut Vec<String>) {
    let lines: Vec<JointId> = mechanism
        .joint_ids()
        .filter(|&j| uses(&mechanism.joints[j].joint_type).1)
        .collect();
    let line = |m: &Mechanism, j: JointId| {
        (
            real(&m.joints[j].frame.point),
            unit(real(&m.joints[j].frame.axis)),
        )
    };
    let off = |p: Vector, (q, u): (Vector, Vector)| length(cross(sub(p, q), u));
    let is_point = |m: &Mechanism, j: JointId| {
        !uses(&m.joints[j].joint_type).0 || m.joints[j].joint_type == JointType::Universal
    };
    // Candidates: centres of balls and universal joints, and the points where two lines (nearly) meet.
    let mut candidates: Vec<([Expr; 3], Vector)> = Vec::new();
    for (n, &a) in lines.iter().enumerate() {
        let frame = &mechanism.joints[a].frame;
        let own = (frame.point.clone(), real(&frame.point));
        candidates.push(own);
        for &b in &lines[..n] {
            let ((p, u), (q, w)) = (line(mechanism, a), line(mechanism, b));
            let normal = cross(u, w);
            let s2 = dot(normal, normal);
            if s2 < 1e-6 || is_point(mechanism, a) || is_point(mechanism, b) {
                continue;
            }
            let gap = dot(sub(q, p), normal).abs() / s2.sqrt();
            if gap > near {
                continue;
            }
            // On line a, at t along its axis as the file has it; a decimal, so the point stays rational.
            let t = dot(cross(sub(q, p), w), normal) / s2;
            let (Ok(t), axis) = (
                Expr::from_f64(t / length(real(&mechanism.joints[a].frame.axis))),
                &mechanism.joints[a].frame.axis,
            ) else {
                continue;
            };
            let point = exact_sum(&mechanism.joints[a].frame.point, &Expr::from(1), axis, &t);
            let value = real(&point);
            candidates.push((point, value));
        }
    }
    let passing = |m: &Mechanism, p: Vector| -> Vec<JointId> {
        lines
            .iter()
            .copied()
            .filter(|&j| {
                if is_point(m, j) {
                    length(sub(p, real(&m.joints[j].frame.point))) <= near
                } else {
                    off(p, line(m, j)) <= near
                }
            })
            .collect()
    };
    let mut ranked: Vec<(usize, usize)> = candidates
        .iter()
        .enumerate()
        .map(|(i, (_, p))| (passing(mechanism, *p).len(), i))
        .filter(|(n, _)| *n > 1)
        .collect();
    ranked.sort_by_key(|&(n, i)| (std::cmp::Reverse(n), i));
    let mut fixed: Vec<Option<[Expr; 3]>> = vec![None; mechanism.joints.len()];
    for (_, i) in ranked {
        let (point, value) = &candidates[i];
        let through = passing(mechanism, *value);
        if through.len() < 2 {
            continue;
        }
        for j in through {
            let joint = &mut mechanism.joints[j];
            match &fixed[j] {
                None => {
                    let offset = [0, 1, 2].map(|k| &point[k] - &joint.frame.point[k]);
                    let on = exact_cross(&offset, &joint.frame.axis).iter().all(is_zero);
                    if !on {
                        moved.push(format!(
                            "axis of joint {} moved through a common point",
                            joint.id
                        ));
                        joint.frame.point = point.clone();
                    }
                    fixed[j] = Some(point.clone());
                }
                Some(first) => {
                    let along = [0, 1, 2].map(|k| &point[k] - &first[k]);
                    let far = length(real(&along));
                    let straight = exact_cross(&along, &joint.frame.axis).iter().all(is_zero);
                    if far > 1e3 * near
                        && !straight
                        && length(cross(unit(real(&along)), unit(real(&joint.frame.axis))))
                            <= near / far * 4.0
                    {
                        moved.push(format!(
                            "axis of joint {} turned through two common points",
                            joint.id
                        ));
                        joint.frame.axis = along;
                    }
                }
            }
        }
    }
}
