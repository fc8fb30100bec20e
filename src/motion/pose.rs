//! Poses of a closed mechanism: every contour as a product of exponentials, every coupling as a linear equation, and
//! Newton's method to close them.
//!
//! Each freedom is one unit twist at a reference pose; a contour is closed at coordinates q when the product of
//! exp(±q_i ξ_i) along it is the identity [Brockett 1984; Lynch & Park, "Modern Robotics", 2017, ch. 4 and 7]. Within a
//! joint the translations come first and then the rotations in the order of the list, so that a guide or the first pin of
//! a universal joint belongs to the first link of the joint; but a slot (a slide along x and none along y) belongs to its
//! second, the pin or ball in it to the first. Lengths are divided by the size of the
//! mechanism and taken from its middle, so that coordinates are radians and fractions of that size.

use crate::closure::contour::{Contour, contour_basis};
use crate::closure::tree::spanning_tree;
use crate::closure::twist::{FrameValues, MotionSpace, Twist};
use crate::geom::exact::ExactError;
use crate::geom::extent::Extent;
use crate::geom::rigid::{RigidMotion, halves};
use crate::geom::scalars::Reals;
use crate::geom::vector::{self, across, cross, dot, length, sub};
use crate::model::coupling::{CoupledFreedom, Coupling};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use faer::Mat;
use faer::linalg::solvers::SolveLstsq;

/// Largest residual of a closed pose: radians, and fractions of the mechanism's size.
pub const CLOSED: f64 = 1e-12;
/// Newton steps before a pose is given up.
const STEPS: usize = 60;

/// Turn and shift as six numbers that vanish together with a motion: (sin θ · axis; translation).
fn defect(motion: &RigidMotion) -> [f64; 6] {
    // Beyond a quarter turn the sine falls again; keep it growing so that half a turn is no solution.
    let cosine = motion.cosine();
    let grow = if cosine < 0.0 {
        1.0 - 2.0 * cosine
    } else {
        1.0
    };
    let ([x, y, z], [u, v, w]) = (motion.sine(), motion.translation);
    [grow * x, grow * y, grow * z, u, v, w]
}

/// One freedom of a joint at a pose.
#[derive(Debug, Clone, Copy)]
pub struct PoseColumn {
    /// The joint.
    pub joint: JointId,
    /// The freedom.
    pub freedom: Freedom,
    /// Its unit twist, lengths in [`Pose::length`], about the middle of the mechanism.
    pub twist: Twist<f64>,
    /// How far it has moved since the pose of the file: radians, or lengths in [`Pose::length`].
    pub moved: f64,
}

/// Freedoms in the order they are passed in, each with its direction.
type Walk = Vec<(usize, f64)>;

/// A pose of a mechanism in one state.
#[derive(Debug, Clone)]
pub struct Pose {
    /// The freedoms, joint by joint; within a joint, translations first.
    pub columns: Vec<PoseColumn>,
    /// The size of the mechanism, in the file's unit: half the diagonal of the box round its joints.
    pub length: f64,
    /// The middle that coordinates are taken from, in the file's unit.
    pub middle: [f64; 3],
    /// RigidMotion of each link since the file's pose, in [`Pose::length`] about the middle.
    pub links: Vec<RigidMotion>,
    /// Relative error of the coordinates: contours need not close better than that.
    accuracy: f64,
    /// Contours as (column, direction).
    contours: Vec<Walk>,
    /// Couplings as sums of two coordinates with factors, of unit length, that must stay zero.
    couplings: Vec<[(usize, f64); 2]>,
    /// Links in the order they are reached from the frame: link, the joint that leads to it, its columns in order.
    tree: Vec<(LinkId, LinkId, Walk)>,
    /// First link of every column's joint, and the columns of that joint before it.
    base: Vec<(LinkId, usize)>,
}

/// Why a pose could not be reached.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PoseError {
    /// Newton's method found no closed pose.
    #[error(
        "the contours do not close: after {steps} steps a gap of {residual:.1e} of the mechanism's size is left"
    )]
    Open {
        /// Steps taken.
        steps: usize,
        /// The gap.
        residual: f64,
    },
}

impl Pose {
    /// The pose of the file.
    ///
    /// # Errors
    /// Where a coordinate has no value.
    pub fn of_file(mechanism: &Mechanism, state: StateId) -> Result<Pose, ExactError> {
        let joints: Vec<JointId> = mechanism.joints_in(state).collect();
        let space = MotionSpace::new(&Reals, &mechanism.mode)?;
        let frames = joints
            .iter()
            .map(|&j| FrameValues::new(&Reals, &mechanism.joints[j].frame))
            .collect::<Result<Vec<_>, _>>()?;
        let points: Vec<[f64; 3]> = frames.iter().map(|f| f.point).collect();
        let Extent {
            middle,
            length: size,
        } = Extent::of(&points);
        let (mut columns, mut base) = (Vec::new(), Vec::new());
        let mut of_joint = vec![Vec::new(); mechanism.joints.len()];
        for (&j, frame) in joints.iter().zip(&frames) {
            let joint = &mechanism.joints[j];
            let unit = FrameValues {
                axes: frame.axes.map(vector::unit),
                point: sub(frame.point, middle).map(|x| x / size),
                pitch: frame.pitch / size,
            };
            let kept = crate::closure::twist::joint_twists(
                &Reals,
                &space,
                &joint.frame,
                &joint.joint_type,
            )?;
            let turned = planar_ball(&space, joint.joint_type.freedoms(), unit);
            let mut freedoms: Vec<Freedom> = kept.into_iter().map(|(f, _)| f).collect();
            let slides = |f: &Freedom| matches!(f, Freedom::Tx | Freedom::Ty | Freedom::Tz);
            // A pin in a slot: the pin first, as in `workload::planar`.
            let has = |f| joint.joint_type.freedoms().contains(&f);
            let slot = has(Freedom::Tx) && !has(Freedom::Ty);
            freedoms.sort_by_key(|f| slides(f) == slot);
            for (n, freedom) in freedoms.into_iter().enumerate() {
                of_joint[j].push(columns.len());
                base.push((joint.links[0], n));
                columns.push(PoseColumn {
                    joint: j,
                    freedom,
                    twist: turned.twist(&Reals, freedom),
                    moved: 0.0,
                });
            }
        }
        let walk = |j: JointId, forward: bool| -> Walk {
            if forward {
                of_joint[j].iter().map(|&c| (c, 1.0)).collect()
            } else {
                of_joint[j].iter().rev().map(|&c| (c, -1.0)).collect()
            }
        };
        let couplings = mechanism
            .couplings_in(state)
            .filter_map(|c| coupled(c, &columns, size))
            .collect();
        let contours = contour_basis(mechanism, state)
            .iter()
            .map(|c: &Contour| c.joints.iter().flat_map(|&(j, d)| walk(j, d)).collect())
            .collect();
        let tree = spanning_tree(mechanism, state)
            .into_iter()
            .map(|s| (s.link, s.from, walk(s.joint, s.forward)))
            .collect();
        Ok(Pose {
            columns,
            length: size,
            middle,
            links: vec![RigidMotion::IDENTITY; mechanism.links.len()],
            accuracy: 0.0,
            contours,
            couplings,
            tree,
            base,
        })
    }

    /// The same pose of measured geometry, with a relative error of its coordinates.
    #[must_use]
    pub fn with_accuracy(mut self, accuracy: f64) -> Pose {
        self.accuracy = accuracy;
        self
    }

    /// Relative error of the coordinates, 0 where they are exact.
    #[must_use]
    pub fn accuracy(&self) -> f64 {
        self.accuracy
    }

    /// The largest gap of a pose that counts as closed: radians, and fractions of [`Pose::length`].
    #[must_use]
    pub fn closed(&self) -> f64 {
        CLOSED.max(10.0 * self.accuracy)
    }

    /// Rows of the closure equations, 6 per contour and one per coupling.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.constraints(6)
    }

    /// Rows of the closure matrix with so many per contour, 6 or 3, and one per coupling.
    #[must_use]
    pub fn constraints(&self, dim: usize) -> usize {
        dim * self.contours.len() + self.couplings.len()
    }

    /// Gaps of the contours at coordinates `q` from this pose, six numbers each, then those of the couplings since the
    /// pose of the file.
    #[must_use]
    pub fn gaps(&self, q: &[f64]) -> Vec<f64> {
        let mut out = Vec::with_capacity(self.rows());
        for contour in &self.contours {
            let mut at = RigidMotion::IDENTITY;
            for &(c, sign) in contour {
                at = at.then(&RigidMotion::exp(&self.columns[c].twist, sign * q[c]));
            }
            out.extend(defect(&at));
        }
        let from_file = |&(c, factor): &(usize, f64)| factor * (self.columns[c].moved + q[c]);
        out.extend(
            self.couplings
                .iter()
                .map(|c| c.iter().map(from_file).sum::<f64>()),
        );
        out
    }

    /// J at coordinates `q` from this pose, (6k + c) × f.
    #[must_use]
    pub fn jacobian(&self, q: &[f64]) -> Mat<f64> {
        let mut matrix = Mat::zeros(self.rows(), self.columns.len());
        for (k, contour) in self.contours.iter().enumerate() {
            let mut at = RigidMotion::IDENTITY;
            for &(c, sign) in contour {
                let twist = at.twist(&self.columns[c].twist);
                for (i, x) in twist.iter().enumerate() {
                    matrix[(6 * k + i, c)] += sign * x;
                }
                at = at.then(&RigidMotion::exp(&self.columns[c].twist, sign * q[c]));
            }
        }
        for (row, coupling) in (6 * self.contours.len()..).zip(&self.couplings) {
            for &(c, factor) in coupling {
                matrix[(row, c)] = factor;
            }
        }
        matrix
    }

    /// The closed coordinates nearest (nearly) to `q`, by damped least-norm Newton steps; `hold` keeps some coordinates.
    ///
    /// # Errors
    /// [`PoseError::Open`] where the gaps do not go below [`Pose::closed`].
    ///
    /// # Complexity
    /// O((6k)²·f) a step.
    pub fn close(&self, mut q: Vec<f64>, hold: &[usize]) -> Result<Vec<f64>, PoseError> {
        let closed = self.closed();
        // Errors of the coordinates must not be mended by running along the motion.
        let floor = (1e3 * self.accuracy).clamp(1e-11, 1e-2);
        let (mut residual, mut before) = (f64::INFINITY, f64::INFINITY);
        let mut best = (f64::INFINITY, q.clone());
        for _ in 0..STEPS {
            let gaps = self.gaps(&q);
            residual = gaps.iter().map(|x| x * x).sum::<f64>().sqrt();
            if residual < best.0 {
                best = (residual, q.clone());
            }
            // The last steps are for free: Newton's are quadratic, unless the pose is singular.
            if residual < 1e-14 || !residual.is_finite() {
                break;
            }
            // Measured contours never close quite: further steps would creep along the motion, to where they close better.
            if self.accuracy > 0.0 && residual < closed && residual > before / 2.0 {
                break;
            }
            before = residual;
            let mut jacobian = self.jacobian(&q);
            for &c in hold {
                jacobian.col_mut(c).fill(0.0);
            }
            let step = least_norm(&jacobian, &gaps, residual.clamp(floor, 1e-2));
            let length = step.iter().map(|x| x * x).sum::<f64>().sqrt();
            if !length.is_finite() || (length < 1e-16 && residual < closed) {
                break;
            }
            let shorten = (0.5 / length).min(1.0);
            for (x, s) in q.iter_mut().zip(&step) {
                *x -= shorten * s;
            }
        }
        if best.0 < closed {
            Ok(best.1)
        } else {
            Err(PoseError::Open {
                steps: STEPS,
                residual: residual.min(best.0),
            })
        }
    }

    /// The pose at coordinates `q` from this one, its twists taken there.
    #[must_use]
    pub fn moved(&self, q: &[f64]) -> Pose {
        let mut since = vec![RigidMotion::IDENTITY; self.links.len()];
        for (to, from, walk) in &self.tree {
            let mut at = since[*from];
            for &(c, sign) in walk {
                at = at.then(&RigidMotion::exp(&self.columns[c].twist, sign * q[c]));
            }
            since[*to] = at;
        }
        let mut next = self.clone();
        for (c, &(link, before)) in self.base.iter().enumerate() {
            let mut at = since[link];
            for (p, x) in q.iter().enumerate().take(c).skip(c - before) {
                at = at.then(&RigidMotion::exp(&self.columns[p].twist, *x));
            }
            next.columns[c].twist = unit(at.twist(&self.columns[c].twist));
            next.columns[c].moved += q[c];
        }
        square_balls(&mut next.columns);
        for (link, d) in next.links.iter_mut().zip(&since) {
            *link = d.then(link);
        }
        next
    }
}

/// A coupling in the coordinates of a pose, where slides are counted in `length`.
fn coupled(coupling: &Coupling, columns: &[PoseColumn], length: f64) -> Option<[(usize, f64); 2]> {
    let unit = |f: Freedom| match f {
        Freedom::Tx | Freedom::Ty | Freedom::Tz => length,
        _ => 1.0,
    };
    let [a, b] = coupling.ends;
    let at = |e: CoupledFreedom| {
        columns
            .iter()
            .position(|c| (c.joint, c.freedom) == (e.joint, e.freedom))
    };
    let factors = [-coupling.ratio.to_f64() * unit(a.freedom), unit(b.freedom)];
    let size = factors[0].hypot(factors[1]);
    Some([(at(a)?, factors[0] / size), (at(b)?, factors[1] / size)])
}

/// In a plane, joints with all three turns turn about the normal, as in [`crate::closure::twist::joint_twists`].
fn planar_ball(
    space: &MotionSpace<f64>,
    freedoms: &[Freedom],
    mut frame: FrameValues<f64>,
) -> FrameValues<f64> {
    let turns = [Freedom::Rx, Freedom::Ry, Freedom::Rz];
    let slides = [Freedom::Tx, Freedom::Ty, Freedom::Tz];
    if let MotionSpace::Planar { axes: [n, e1, e2] } = space
        && turns.iter().all(|t| freedoms.contains(t))
        && !slides.iter().any(|t| freedoms.contains(t))
    {
        frame.axes = [*e1, *e2, *n].map(vector::unit);
    }
    frame
}

/// Rounding must not let axes grow or shrink over many steps.
fn unit(mut t: Twist<f64>) -> Twist<f64> {
    let (w, v) = halves(&t);
    let size = match length(w) {
        0.0 => length(v),
        turn => turn,
    };
    t.iter_mut().for_each(|x| *x /= size);
    t
}

/// The three turns of a ball, squared up again, so that no two of its axes ever come to lie along each other.
fn square_balls(columns: &mut [PoseColumn]) {
    let turn = |c: &PoseColumn| matches!(c.freedom, Freedom::Rx | Freedom::Ry | Freedom::Rz);
    let mut i = 0;
    while i + 2 < columns.len() {
        let j = columns[i].joint;
        if columns[i..i + 3].iter().all(|c| c.joint == j && turn(c)) {
            let (w0, v0) = halves(&columns[i].twist);
            let (w2, v2) = halves(&columns[i + 2].twist);
            // The common point c: v = c × ω for two of the axes; two equations in the least-squares sense.
            let centre = meeting_point(w0, v0, w2, v2);
            let e0 = w0;
            let e1 = vector::unit(across(w2, e0));
            for (n, w) in [e0, e1, cross(e0, e1)].into_iter().enumerate() {
                let v = cross(centre, w);
                columns[i + n].twist = [w[0], w[1], w[2], v[0], v[1], v[2]];
            }
            i += 3;
        } else {
            i += 1;
        }
    }
}

/// Where two lines with unit directions meet (their twists about the origin given): the middle of the common normal.
fn meeting_point(w0: [f64; 3], v0: [f64; 3], w1: [f64; 3], v1: [f64; 3]) -> [f64; 3] {
    let (p0, p1) = (cross(w0, v0), cross(w1, v1));
    let d = sub(p1, p0);
    let (c, a, b) = (dot(w0, w1), dot(d, w0), dot(d, w1));
    let s = 1.0 - c * c;
    let (t0, t1) = ((a - c * b) / s, (c * a - b) / s);
    [0, 1, 2].map(|i| f64::midpoint(p0[i] + t0 * w0[i], p1[i] + t1 * w1[i]))
}

/// The damped solution of J·x = gaps, min |J·x - gaps|² + λ|x|² by orthogonal factors, λ in proportion to the gap: where J is
/// singular at the solution this still converges, and where it is regular the damping vanishes faster than the error
/// [Yamashita & Fukushima 2001].
fn least_norm(jacobian: &Mat<f64>, gaps: &[f64], damping: f64) -> Vec<f64> {
    let (rows, columns) = jacobian.shape();
    let stacked = Mat::from_fn(rows + columns, columns, |r, c| match r.checked_sub(rows) {
        None => jacobian[(r, c)],
        Some(i) if i == c => damping,
        Some(_) => 0.0,
    });
    let right = Mat::from_fn(rows + columns, 1, |r, _| {
        gaps.get(r).copied().unwrap_or(0.0)
    });
    let x = stacked.qr().solve_lstsq(&right);
    (0..columns).map(|i| x[(i, 0)]).collect()
}
