//! A pose in numbers suitable for statics: unit twists about the middle of the joints, lengths in the mechanism's size.
//!
//! Middle and size are the mean and the root mean square distance of the joints' points. So results do not depend on the axes of the file.
//! Twists are (ω; v), wrenches (m; f), forces in newtons and moments in newtons times the size.

use crate::closure::contour::{Contour, contour_basis};
use crate::closure::tree::{TreeStep, spanning_tree};
use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::geom::rigid::split_twist;
use crate::geom::vector::{add, add_scaled, scale, sub, unit};
pub use crate::geom::vector::{cross, dot};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Mode, StateId};
use crate::motion::pose::Pose;
use crate::statics::greatest_abs;
use crate::statics::reactions::couplings::{CouplingEquation, coupling_equations};
pub use crate::statics::reactions::wrench::{
    FreedomColumn, Six, force_wrench, shift_wrench, wrench_power,
};
use crate::statics::reactions::wrench::{PosedFreedoms, carried_part, join_halves};
use ozols_dense::Matrix;

/// Fraction of the largest singular value below which values count as zero.
pub(crate) const TOLERANCE: f64 = 1e-9;

/// A pose of a mechanism in one state.
#[derive(Debug, Clone)]
pub struct Geometry {
    /// The state.
    pub state: StateId,
    /// Orthonormal wrenches that contours transmit: six, or the three of a plane.
    pub basis: Vec<Six>,
    /// The size `[m]`.
    pub size: f64,
    /// The middle `[m]`.
    pub middle: [f64; 3],
    /// Metres in the file's unit.
    pub metres: f64,
    /// Joints of the state, in file order.
    pub joints: Vec<JointId>,
    /// The freedoms, grouped by joint.
    pub columns: Vec<FreedomColumn>,
    /// For each joint, its current point, from the middle, in the size.
    pub points: Vec<[f64; 3]>,
    /// For each joint, the current unit vectors x, y, z of its frame, which moves with the joint's first link.
    pub axes: Vec<[[f64; 3]; 3]>,
    /// The contours.
    pub contours: Vec<Contour>,
    /// The couplings, in file order.
    pub couplings: Vec<CouplingEquation>,
    /// The links except the frame, each after the one that supports it.
    pub tree: Vec<TreeStep>,
    /// Middle and half diagonal of the pose, in the file's unit.
    pose: ([f64; 3], f64),
}

impl Geometry {
    /// Computes the geometry of a state at one of its poses.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    pub fn new(m: &Mechanism, state: StateId, pose: &Pose) -> Result<Geometry, ExactError> {
        let metres = m.length_unit.metres;
        let joints: Vec<JointId> = m.joints_in(state).collect();
        let (mut points, mut axes) = (Vec::new(), Vec::new());
        for joint in &m.joints {
            let (frame, link) = (FrameValues::new(&Reals, &joint.frame)?, joint.links[0]);
            points.push(pose.carry_point(&pose.links, link, frame.point));
            axes.push(frame.axes.map(|a| pose.links[link].map_direction(unit(a))));
        }
        let (mean, spread) = middle_and_size(&joints, &points, pose.length);
        for &j in &joints {
            points[j] = sub(points[j], mean).map(|x| x / spread);
        }
        let shift = sub(mean, pose.middle);
        let columns = pose.columns.iter().map(|c| {
            let (w, v) = split_twist(&c.twist);
            let twist = if w == [0.0; 3] {
                c.twist
            } else {
                let v = add_scaled(cross(w, shift), pose.length, v);
                join_halves(w, v.map(|x| x / spread))
            };
            FreedomColumn {
                joint: c.joint,
                freedom: c.freedom,
                twist,
            }
        });
        let basis = wrench_basis(&m.mode)?;
        let mut out = Geometry {
            state,
            basis,
            size: spread * metres,
            middle: mean.map(|x| x * metres),
            metres,
            columns: columns.collect(),
            points,
            axes,
            contours: contour_basis(m, state),
            couplings: Vec::new(),
            tree: spanning_tree(m, state),
            joints,
            pose: (mean, spread),
        };
        let posed = PosedFreedoms {
            columns: &out.columns,
            points: &out.points,
            basis: &out.basis,
            size: spread,
        };
        out.couplings = coupling_equations(m, state, &posed);
        Ok(out)
    }

    /// Returns the number of unknowns of its equations: wrenches around the contours, and one for each coupling.
    #[must_use]
    pub fn unknown_count(&self) -> usize {
        self.basis.len() * self.contours.len() + self.couplings.len()
    }

    /// Returns the current position of a point of a link, from the middle, in the size. `point` is in the file's unit
    /// at the pose of the file.
    #[must_use]
    pub fn point_position(&self, pose: &Pose, link: LinkId, point: [f64; 3]) -> [f64; 3] {
        self.of_file(pose.carry_point(&pose.links, link, point))
    }

    /// Converts a point from the middle, in the size, to metres from the origin of the file.
    #[must_use]
    pub(crate) fn to_metres(&self, point: [f64; 3]) -> [f64; 3] {
        add_scaled(self.middle, self.size, point)
    }

    /// Returns true if a link exists in the state and is not the frame.
    #[must_use]
    pub(crate) fn has_link(&self, link: LinkId) -> bool {
        self.tree.iter().any(|s| s.link == link)
    }

    /// Converts a point of the file to one from the middle, in the size, for links at their position in the file.
    #[must_use]
    pub fn of_file(&self, point: [f64; 3]) -> [f64; 3] {
        let (mean, spread) = self.pose;
        sub(point, mean).map(|x| x / spread)
    }

    /// Returns the part of a wrench that the model can carry: all of it, or the part in the plane.
    #[must_use]
    pub fn carried_part(&self, w: &Six) -> Six {
        carried_part(&self.basis, w)
    }

    /// Returns the wrenches of joints on their second links if all loads go along the tree to the frame, by joint.
    #[must_use]
    pub fn along_tree(&self, joints: usize, loads: &[Six]) -> Vec<Six> {
        let mut hanging = loads.to_vec();
        let mut out = vec![[0.0; 6]; joints];
        for step in self.tree.iter().rev() {
            let load = hanging[step.link];
            hanging[step.from] = add(hanging[step.from], load);
            out[step.joint] = scale(load, if step.forward { -1.0 } else { 1.0 });
        }
        out
    }

    /// Returns the entries of the couplings at a column, by the coupling's index.
    pub fn coupling_entries(&self, column: &FreedomColumn) -> impl Iterator<Item = (usize, f64)> {
        let own = (column.joint, column.freedom);
        let all = self.couplings.iter().enumerate();
        all.flat_map(move |(q, c)| {
            let ends = c.ends.iter().zip(c.entries);
            ends.filter(move |(e, _)| (e.joint, e.freedom) == own)
                .map(move |(_, x)| (q, x))
        })
    }

    /// Returns the row of the transposed closure matrix for a column: its power on a unit of each contour's wrenches,
    /// then its entries in the couplings.
    #[must_use]
    pub fn closure_row(&self, column: &FreedomColumn) -> Vec<f64> {
        let dim = self.basis.len();
        let mut out = vec![0.0; self.unknown_count()];
        for (k, contour) in self.contours.iter().enumerate() {
            if let Some(forward) = contour.direction_of(column.joint) {
                let sign = if forward { 1.0 } else { -1.0 };
                for (o, b) in out[k * dim..].iter_mut().zip(&self.basis) {
                    *o = sign * wrench_power(b, &column.twist);
                }
            }
        }
        let first = dim * self.contours.len();
        for (q, x) in self.coupling_entries(column) {
            out[first + q] = x;
        }
        out
    }

    /// Returns the closure matrix of some columns: a column for each of them, as by [`Geometry::closure_row`].
    pub(crate) fn closure_matrix(&self, columns: &[usize]) -> Matrix {
        let rows: Vec<Vec<f64>> =
            (columns.iter().map(|&c| self.closure_row(&self.columns[c]))).collect();
        Matrix::from_fn(self.unknown_count(), columns.len(), |r, c| rows[c][r])
    }

    /// Returns the twists of the links if the freedoms move at these speeds, by link.
    #[must_use]
    pub fn link_twists(&self, links: usize, speeds: &[f64]) -> Vec<Six> {
        let mut of_joint = vec![[0.0; 6]; self.points.len()];
        for (c, s) in self.columns.iter().zip(speeds) {
            of_joint[c.joint] = add_scaled(of_joint[c.joint], *s, c.twist);
        }
        let mut out = vec![[0.0; 6]; links];
        for step in &self.tree {
            let sign = if step.forward { 1.0 } else { -1.0 };
            out[step.link] = add_scaled(out[step.from], sign, of_joint[step.joint]);
        }
        out
    }
}

/// Returns the mean of the points of joints, and the root mean square distance from it, or `length` if they coincide.
fn middle_and_size(joints: &[JointId], points: &[[f64; 3]], length: f64) -> ([f64; 3], f64) {
    #[allow(clippy::cast_precision_loss, reason = "a count of joints")]
    let count = joints.len().max(1) as f64;
    let mean = [0, 1, 2].map(|i| joints.iter().map(|&j| points[j][i]).sum::<f64>() / count);
    let off = joints.iter().map(|&j| sub(points[j], mean));
    let square: f64 = off.map(|v| dot(v, v)).sum();
    let far = greatest_abs(&mean);
    let spread = (square / count).sqrt();
    if spread > 1e-9 * far && spread > 1e-12 {
        (mean, spread)
    } else {
        (mean, length)
    }
}

/// Returns orthonormal wrenches that contours transmit: six, or the three of a plane.
fn wrench_basis(mode: &Mode) -> Result<Vec<Six>, ExactError> {
    Ok(match MotionSpace::new(&Reals, mode)? {
        MotionSpace::Spatial => (0..6)
            .map(|i| std::array::from_fn(|k| f64::from(u8::from(i == k))))
            .collect(),
        MotionSpace::Planar { axes: [n, e1, e2] } => {
            let [n, e1, e2] = [unit(n), unit(e1), unit(e2)];
            let none = [0.0; 3];
            vec![
                join_halves(n, none),
                join_halves(none, e1),
                join_halves(none, e2),
            ]
        }
    })
}
