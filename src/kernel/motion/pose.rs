//! Poses of a closed mechanism: every contour as a product of exponentials, every coupling as a linear equation.
//!
//! Each freedom is one unit twist at a reference pose. A contour is closed at coordinates q if the product of exp(±q_i ξ_i) along it is
//! the identity [Brockett 1984; Lynch & Park, "Modern Robotics", 2017, ch. 4 and 7]. Within a joint the translations come first, then the
//! rotations in the order of the list. So a guide or the first pin of a universal joint belongs to the first link of the joint. A slot (a
//! slide along x and none along y) belongs to its second link, and the pin or ball in it to the first. Lengths are divided by the size of
//! the mechanism and measured from its middle, so coordinates are radians and fractions of that size.

use crate::closure::contour::{Contour, contour_basis};
use crate::closure::tree::spanning_tree;
use crate::closure::twist::{FrameValues, MotionSpace, Twist, unit_twist};
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::geom::extent::OwnScale;
use crate::geom::rigid::{RigidMotion, split_twist};
use crate::geom::vector::{self, across, cross, dot, sub};
use crate::model::joint_type::{CoupledFreedom, Coupling, Freedom};
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use itertools::Itertools;
use ozols_dense::Matrix;

/// Largest residual of a closed pose: radians, and fractions of the mechanism's size.
const CLOSED: f64 = 1e-12;
/// Fraction of the largest singular value of J below which values are zero at a pose closed by Newton's method.
pub const FLAT: f64 = 1e-6;

/// Returns rotation and translation as six numbers that vanish together with a motion: (sin θ · axis; translation).
fn closure_defect(motion: &RigidMotion) -> [f64; 6] {
    // Beyond a quarter turn the sine decreases again. It is extended, so that half a turn is not a solution.
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
    /// Its displacement since the pose of the file: radians, or lengths in [`Pose::length`].
    pub moved: f64,
}

/// Freedoms in the order of passage, each with its direction.
type Walk = Vec<(usize, f64)>;

/// A pose of a mechanism in one state.
#[derive(Debug, Clone)]
pub struct Pose {
    /// The freedoms, joint by joint; within a joint, translations first.
    pub columns: Vec<PoseColumn>,
    /// The size of the mechanism, in the file's unit: half the diagonal of the bounding box of its joints.
    pub length: f64,
    /// The origin of the coordinates, in the file's unit.
    pub middle: [f64; 3],
    /// Motion of each link since the file's pose, in [`Pose::length`] about the middle.
    pub links: Vec<RigidMotion>,
    /// Relative error of the coordinates, which limits how well contours have to close.
    accuracy: f64,
    /// Contours as (column, direction).
    contours: Vec<Walk>,
    /// Couplings as sums of two coordinates with factors, of unit length, that must stay zero.
    couplings: Vec<[(usize, f64); 2]>,
    /// Links in the order from the frame: the link, the one before it, and the columns of the joint between them.
    tree: Vec<(LinkId, LinkId, Walk)>,
    /// First link of every column's joint, and the columns of that joint before it.
    base: Vec<(LinkId, usize)>,
}

impl Pose {
    /// Returns the position to which motions of links, in the lengths of this pose, move a point of one of them.
    #[must_use]
    pub fn carry_point(&self, links: &[RigidMotion], link: LinkId, p: [f64; 3]) -> [f64; 3] {
        let parts = sub(p, self.middle).map(|x| x / self.length);
        let there = links[link].map_point(parts);
        [0, 1, 2].map(|i| self.middle[i] + there[i] * self.length)
    }

    /// Creates the pose of the file.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    pub fn of_file(mechanism: &Mechanism, state: StateId) -> Result<Pose, ExactError> {
        let joints: Vec<JointId> = mechanism.joints_in(state).collect();
        let space = MotionSpace::new(&Reals, &mechanism.mode)?;
        let points = joints.iter().map(|&j| &mechanism.joints[j].frame.point);
        let scale = OwnScale::from_points(&points.collect::<Vec<_>>());
        let extent = scale.extent();
        let mut all = JointColumns {
            columns: Vec::new(),
            base: Vec::new(),
            of_joint: vec![Vec::new(); mechanism.joints.len()],
        };
        for &j in &joints {
            all.add(mechanism, &space, j, &scale)?;
        }
        let couplings = mechanism
            .couplings_in(state)
            .filter_map(|c| coupling_factors(c, &all.columns, &scale))
            .collect();
        let walk = |c: &Contour| {
            c.joints
                .iter()
                .flat_map(|&(j, d)| all.walk_joint(j, d))
                .collect()
        };
        let contours = contour_basis(mechanism, state).iter().map(walk).collect();
        let tree = spanning_tree(mechanism, state)
            .into_iter()
            .map(|s| (s.link, s.from, all.walk_joint(s.joint, s.forward)))
            .collect();
        let JointColumns { columns, base, .. } = all;
        Ok(Pose {
            columns,
            length: extent.length,
            middle: extent.middle,
            links: vec![RigidMotion::IDENTITY; mechanism.links.len()],
            accuracy: 0.0,
            contours,
            couplings,
            tree,
            base,
        })
    }

    /// Returns the pose for measured geometry, with a relative error of its coordinates.
    #[must_use]
    pub(crate) fn with_accuracy(mut self, accuracy: f64) -> Pose {
        self.accuracy = accuracy;
        self
    }

    /// Returns the file's pose with the frame of one joint moved. If the joint then has a different number of motions in the mechanism's
    /// plane, each keeps the freedom that it is named by.
    #[must_use]
    pub(crate) fn with_frame(
        &self,
        mechanism: &Mechanism,
        space: &MotionSpace<f64>,
        joint: JointId,
        frame: &FrameValues<f64>,
    ) -> Pose {
        let frame = in_lengths(frame, self.middle, self.length);
        let motions = unit_motions(&frame, space, mechanism.joints[joint].joint_type.freedoms());
        let mut out = self.clone();
        let own = out.columns.iter_mut().filter(|c| c.joint == joint);
        let all = motions.len() == self.columns.iter().filter(|c| c.joint == joint).count();
        for (n, c) in own.enumerate() {
            c.twist = if all {
                motions[n].1
            } else {
                frame.twist_of(&Reals, c.freedom)
            };
        }
        out
    }

    /// Returns the file's pose with one column tied to another: it moves by `ratio` if the other moves by 1, each in its own unit.
    pub fn with_coupling(mut self, other: usize, column: usize, ratio: f64) -> Pose {
        let size = ratio.hypot(1.0);
        self.couplings
            .push([(other, -ratio / size), (column, 1.0 / size)]);
        self
    }

    /// Returns the relative error of the coordinates, 0 if they are exact.
    #[must_use]
    pub fn accuracy(&self) -> f64 {
        self.accuracy
    }

    /// Returns the largest gap of a pose that counts as closed: radians, and fractions of [`Pose::length`].
    #[must_use]
    pub fn closed_tolerance(&self) -> f64 {
        CLOSED.max(10.0 * self.accuracy)
    }

    /// Returns the number of rows of the closure equations, 6 per contour and one per coupling.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.constraint_rows(6)
    }

    /// Returns the number of rows of the closure matrix with `dim` per contour, 6 or 3, and one per coupling.
    #[must_use]
    pub fn constraint_rows(&self, dim: usize) -> usize {
        dim * self.contours.len() + self.couplings.len()
    }

    /// Returns the number of freedoms of joints in a contour or a coupling.
    #[must_use]
    pub(crate) fn looped_columns(&self) -> usize {
        let of_contours = self.contours.iter().flatten().map(|&(c, _)| c);
        let of_couplings = self.couplings.iter().flatten().map(|&(c, _)| c);
        of_contours.chain(of_couplings).unique().count()
    }

    /// Returns the gaps of the contours at coordinates `q`, six numbers each, then those of the couplings since the pose of the file.
    #[must_use]
    pub fn closure_gaps(&self, q: &[f64]) -> Vec<f64> {
        let mut out = Vec::with_capacity(self.rows());
        for contour in &self.contours {
            let mut at = RigidMotion::IDENTITY;
            for &(c, sign) in contour {
                at = at.then(&RigidMotion::exp(&self.columns[c].twist, sign * q[c]));
            }
            out.extend(closure_defect(&at));
        }
        let from_file = |&(c, factor): &(usize, f64)| factor * (self.columns[c].moved + q[c]);
        out.extend(
            self.couplings
                .iter()
                .map(|c| c.iter().map(from_file).sum::<f64>()),
        );
        out
    }

    /// Returns J at coordinates `q` from this pose, (6k + c) × f.
    #[must_use]
    pub fn jacobian_at(&self, q: &[f64]) -> Matrix {
        let mut matrix = Matrix::zeros(self.rows(), self.columns.len());
        for (k, contour) in self.contours.iter().enumerate() {
            let mut at = RigidMotion::IDENTITY;
            for &(c, sign) in contour {
                let twist = at.map_twist(&self.columns[c].twist);
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

    /// Returns the change of J along speeds `v`, times `v`: the remaining accelerations if all joints keep their speeds. It is exact, by
    /// the Lie brackets of successive twists [Müller 2016]. Couplings are linear and have none.
    #[must_use]
    pub(crate) fn bend_along(&self, v: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.rows()];
        for (contour, rows) in self.contours.iter().zip(out.chunks_mut(6)) {
            let (mut turn, mut shift) = ([0.0; 3], [0.0; 3]);
            for &(c, sign) in contour {
                let (w, u) = split_twist(&self.columns[c].twist.map(|x| sign * v[c] * x));
                let (a, b, d) = (cross(turn, w), cross(turn, u), cross(shift, w));
                for i in 0..3 {
                    rows[i] += a[i];
                    rows[3 + i] += b[i] + d[i];
                    turn[i] += w[i];
                    shift[i] += u[i];
                }
            }
        }
        out
    }

    /// Returns J at this pose with six more rows for each path of joints, the twist at its end. One more row for each of some columns is
    /// its speed.
    #[must_use]
    pub fn jacobian_with(&self, paths: &[Vec<(JointId, bool)>], speeds: &[usize]) -> Matrix {
        let f = self.columns.len();
        let (closure, rows) = (self.jacobian_at(&vec![0.0; f]), self.rows());
        let twists = 6 * paths.len();
        Matrix::from_fn(rows + twists + speeds.len(), f, |r, c| {
            let Some(r) = r.checked_sub(rows) else {
                return closure[(r, c)];
            };
            if let Some(speed) = r.checked_sub(twists) {
                return f64::from(u8::from(speeds[speed] == c));
            }
            let column = &self.columns[c];
            let passed = paths[r / 6].iter().find(|(j, _)| *j == column.joint);
            let twist = column.twist[r % 6];
            passed.map_or(0.0, |&(_, forward)| if forward { twist } else { -twist })
        })
    }

    /// Returns the pose at coordinates `q` from this one, with its twists updated.
    #[must_use]
    pub fn moved_to(&self, q: &[f64]) -> Pose {
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
            next.columns[c].twist = unit_twist(at.map_twist(&self.columns[c].twist));
            next.columns[c].moved += q[c];
        }
        square_balls(&mut next.columns);
        for (link, d) in next.links.iter_mut().zip(&since) {
            *link = d.then(link);
        }
        next
    }
}

/// The columns of a pose during construction, joint by joint.
struct JointColumns {
    columns: Vec<PoseColumn>,
    /// First link of every column's joint, and the columns of that joint before it.
    base: Vec<(LinkId, usize)>,
    /// The columns of each joint.
    of_joint: Vec<Vec<usize>>,
}

impl JointColumns {
    /// Adds the freedoms of a joint, in lengths of the scale and about the middle of all.
    fn add(
        &mut self,
        mechanism: &Mechanism,
        space: &MotionSpace<f64>,
        j: JointId,
        scale: &OwnScale,
    ) -> Result<(), ExactError> {
        let joint = &mechanism.joints[j];
        let frame = FrameValues {
            axes: FrameValues::new(&Reals, &joint.frame)?
                .axes
                .map(vector::unit),
            point: scale.relative_point(&joint.frame.point),
            pitch: scale.relative_length(&joint.frame.pitch),
        };
        let kept = unit_motions(&frame, space, joint.joint_type.freedoms());
        for (n, (freedom, twist)) in kept.into_iter().enumerate() {
            self.of_joint[j].push(self.columns.len());
            self.base.push((joint.links[0], n));
            self.columns.push(PoseColumn {
                joint: j,
                freedom,
                twist,
                moved: 0.0,
            });
        }
        Ok(())
    }

    /// Returns the freedoms of a joint as they are passed in a direction.
    fn walk_joint(&self, j: JointId, forward: bool) -> Walk {
        let own = self.of_joint[j].iter();
        if forward {
            own.map(|&c| (c, 1.0)).collect()
        } else {
            own.rev().map(|&c| (c, -1.0)).collect()
        }
    }
}

/// Returns the motions of a joint as the columns of a pose use them: unit twists, in series.
fn unit_motions(
    frame: &FrameValues<f64>,
    space: &MotionSpace<f64>,
    freedoms: &[Freedom],
) -> Vec<(Freedom, Twist<f64>)> {
    let all = frame.motions_in_series(&Reals, space, freedoms);
    all.into_iter()
        .map(|(f, twist)| (f, unit_twist(twist)))
        .collect()
}

/// Returns a frame with axes of unit length, relative to a middle and in lengths of a size.
fn in_lengths(frame: &FrameValues<f64>, middle: [f64; 3], size: f64) -> FrameValues<f64> {
    FrameValues {
        axes: frame.axes.map(vector::unit),
        point: sub(frame.point, middle).map(|x| x / size),
        pitch: frame.pitch / size,
    }
}

/// Returns a coupling in the coordinates of a pose, with slides in lengths of the scale.
fn coupling_factors(
    coupling: &Coupling,
    columns: &[PoseColumn],
    scale: &OwnScale,
) -> Option<[(usize, f64); 2]> {
    let [a, b] = coupling.ends;
    let is_end = |c: &PoseColumn, e: CoupledFreedom| (c.joint, c.freedom) == (e.joint, e.freedom);
    let at = |e| columns.iter().position(|c| is_end(c, e));
    let rate = match [a, b].map(|e| e.freedom.is_slide()) {
        [false, true] => scale.relative_length(&coupling.ratio),
        [true, false] => scale.scaled_rate(&coupling.ratio),
        _ => coupling.ratio.to_f64(),
    };
    let factors = [-rate, 1.0];
    let size = factors[0].hypot(factors[1]);
    Some([(at(a)?, factors[0] / size), (at(b)?, factors[1] / size)])
}

/// Makes the three rotation axes of a ball perpendicular again, so that no two of them ever align. Each stays nearest its own axis, which
/// a drive may hold.
fn square_balls(columns: &mut [PoseColumn]) {
    let mut i = 0;
    while i + 2 < columns.len() {
        let j = columns[i].joint;
        if columns[i..i + 3]
            .iter()
            .all(|c| c.joint == j && c.freedom.is_turn())
        {
            let (w0, v0) = split_twist(&columns[i].twist);
            let (w2, v2) = split_twist(&columns[i + 2].twist);
            // The common point c: v = c × ω for two of the axes; two equations in the least-squares sense.
            let centre = meeting_point(w0, v0, w2, v2);
            let last = vector::unit(across(w2, w0));
            let middle = cross(last, w0);
            let (w1, _) = split_twist(&columns[i + 1].twist);
            let along = dot(middle, w1).signum();
            for (n, w) in [w0, middle.map(|x| x * along), last]
                .into_iter()
                .enumerate()
            {
                let v = cross(centre, w);
                columns[i + n].twist = [w[0], w[1], w[2], v[0], v[1], v[2]];
            }
            i += 3;
        } else {
            i += 1;
        }
    }
}

/// Returns the meeting point of two lines with unit directions, given by their twists about the origin: the middle of the common normal.
fn meeting_point(w0: [f64; 3], v0: [f64; 3], w1: [f64; 3], v1: [f64; 3]) -> [f64; 3] {
    let (p0, p1) = (cross(w0, v0), cross(w1, v1));
    let d = sub(p1, p0);
    let (c, a, b) = (dot(w0, w1), dot(d, w0), dot(d, w1));
    let [t0, t1] = [a - c * b, c * a - b].map(|x| x / (1.0 - c * c));
    [0, 1, 2].map(|i| f64::midpoint(p0[i] + t0 * w0[i], p1[i] + t1 * w1[i]))
}
