//! Second-order obstructions of a motion that hold for any rounding of the coordinates.
//!
//! At a pose whose J has its intended rank, a motion is stopped if self-stresses do work on its gaps of second order.
//! That work changes with each coordinate, both directly and through the motion and the self-stress. Perturbation
//! theory gives these changes to first order [Stewart & Sun, "Matrix Perturbation Theory", 1990]. The sum of the
//! changes over half a unit of each coordinate bounds the effect of rounding on the work.

use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::Reals;
use crate::geom::vector::{length, real};
use crate::model::mechanism::{JointId, Mechanism, Mode};
use crate::model::rounded::Uncertainties;
use crate::motion::pose::Pose;
use crate::rank::finite::tangent_cone::{Flat, Quadrics, form, norm, works};
use crate::rank::rounded::size;
use ozols_dense::{Matrix, Svd, svd};

/// Step of finite differences, in radians and fractions of the size.
const STEP: f64 = 1e-5;
/// Factor by which first-order changes bound those of all orders.
const SAFE: f64 = 1.5;
/// Changes of J above this share of its smallest nonzero singular value are not small.
const SMALL: f64 = 0.1;
/// Work below this counts as zero in doubles.
const ZERO: f64 = 1e-11;
/// Number of standard deviations that rounding alone exceeds once in ten thousand times.
const RARE: f64 = 4.0;
/// Maximum product of coordinates, pairs of motions and entries of J.
const LARGEST: usize = 400_000_000;

/// Accuracy of the coordinates of a mechanism.
#[derive(Debug, Clone)]
pub(crate) struct Roundings {
    half: Uncertainties,
    /// Number of half units by which coordinates may be off.
    times: f64,
    /// One unit of the coarsest coordinate: radians, or a fraction of the size.
    pub(super) unit: f64,
}

impl Roundings {
    /// Creates the accuracy from half units of the coordinates, which may be off by `times` of them.
    pub(crate) fn new(mechanism: &Mechanism, half: Uncertainties, times: f64) -> Roundings {
        let [length, direction] = half.largest(mechanism);
        Roundings {
            unit: 2.0 * direction.max(length / size(mechanism)),
            half,
            times,
        }
    }

    /// Returns how far each component of the point, the axis and the reference of a joint may be off, if it matters.
    fn of(&self, mechanism: &Mechanism, j: JointId) -> [[f64; 3]; 3] {
        let (at, joint_type) = (j.index(), &mechanism.joints[j].joint_type);
        // In a plane, axes stay perpendicular to it.
        let turned = matches!(mechanism.mode, Mode::Spatial);
        let off = |half: [f64; 3], matters: bool| {
            half.map(|h| if matters { self.times * h } else { 0.0 })
        };
        [
            off(self.half.point[at], true),
            off(self.half.axis[at], turned && joint_type.is_directed()),
            off(
                self.half.reference[at],
                turned && joint_type.has_second_axis(),
            ),
        ]
    }
}

/// The second-order work at a pose, and the possible effect of rounding on it.
pub(super) struct SecondOrder {
    table: Matrix,
    /// Change of the table by half a unit of each coordinate.
    changes: Vec<Matrix>,
    quadrics: Quadrics,
    motions: usize,
}

impl SecondOrder {
    /// Creates the table of a pose with `motions` instantaneous motions. Returns `None` if it is too large, or if J is
    /// too close to having more motions.
    ///
    /// # Complexity
    /// O(n²) matrices J for n motions and each coordinate.
    pub(super) fn new(
        mechanism: &Mechanism,
        pose: &Pose,
        motions: usize,
        known: &Roundings,
    ) -> Option<SecondOrder> {
        let f = pose.columns.len();
        let here = pose.jacobian(&vec![0.0; f]);
        let joints: Vec<JointId> = {
            let mut of: Vec<JointId> = pose.columns.iter().map(|c| c.joint).collect();
            of.dedup();
            of
        };
        let matrices = 18 * joints.len() * motions * (motions + 1);
        if matrices * pose.rows() * f > LARGEST {
            return None;
        }
        let factors = svd(&here)?;
        let rank = f.checked_sub(motions)?;
        let least = *factors.values.get(rank.checked_sub(1)?)?;
        let flat = Flat {
            kernel: factors.null_space(rank),
            stresses: factors.left_null_space(rank),
            clear: true,
        };
        let turned = Svd {
            values: factors.values.clone(),
            u: factors.v.clone(),
            v: factors.u.clone(),
        };
        // The table with one joint displaced, and the change of J there.
        let table_at = |there: &Pose| {
            let mut change = there.jacobian(&vec![0.0; f]);
            change.add_multiple(-1.0, &here);
            let transposed = Matrix::from_fn(f, change.nrows(), |r, c| change[(c, r)]);
            let mut flat = Flat {
                kernel: flat.kernel.clone(),
                stresses: flat.stresses.clone(),
                clear: true,
            };
            let motion = factors.least_norm(rank, &change.times(&flat.kernel));
            let stress = turned.least_norm(rank, &transposed.times(&flat.stresses));
            flat.kernel.add_multiple(-1.0, &motion);
            flat.stresses.add_multiple(-1.0, &stress);
            (works(there, &flat), change)
        };
        let space = MotionSpace::new(&Reals, &mechanism.mode).ok()?;
        let (mut changes, mut moved) = (Vec::new(), 0.0);
        for j in joints {
            let joint = &mechanism.joints[j];
            let vectors = [
                &joint.frame.point,
                &joint.frame.axis,
                &joint.frame.reference,
            ]
            .map(real);
            let pitch = joint.frame.pitch.to_f64();
            for (v, off) in known.of(mechanism, j).into_iter().enumerate() {
                let scale = if v == 0 {
                    pose.length
                } else {
                    length(vectors[v])
                };
                for (c, off) in off.into_iter().enumerate().filter(|(_, off)| *off > 0.0) {
                    let at = |by: f64| {
                        let mut vectors = vectors;
                        vectors[v][c] += by;
                        let frame = FrameValues::of(&Reals, vectors, pitch);
                        table_at(&pose.reframed(mechanism, &space, j, &frame))
                    };
                    let step = STEP * scale;
                    let ((mut up, mut up_by), (down, down_by)) = (at(step), at(-step));
                    up.add_multiple(-1.0, &down);
                    up_by.add_multiple(-1.0, &down_by);
                    let part = off / (2.0 * step);
                    moved += (part * size_of(&up_by)).powi(2);
                    changes.push(Matrix::from_fn(up.nrows(), up.ncols(), |r, c| {
                        part * up[(r, c)]
                    }));
                }
            }
        }
        if moved.sqrt() > SMALL * least {
            return None;
        }
        let table = works(pose, &flat);
        Some(SecondOrder {
            quadrics: Quadrics::of_table(&table, motions, ZERO),
            table,
            changes,
            motions,
        })
    }

    /// Returns the maximum number of motions left for any rounding. It is 0 if the work of a combination of
    /// self-stresses is definite, and one less if any work is nonzero.
    pub(super) fn at_most(&self) -> usize {
        let stresses = self.quadrics.stresses();
        let definite = self.quadrics.definite().filter(|(weights, least)| {
            let stress: Vec<f64> = (0..self.table.nrows())
                .map(|r| stresses.iter().zip(weights).map(|(s, w)| s[r] * w).sum())
                .collect();
            *least > SAFE * self.change(&stress)
        });
        // As a row of the table, a form has size 1.
        let is_there = |stress: &Vec<f64>| SAFE * self.change(stress) < 0.5;
        match definite {
            Some(_) if self.motions > 0 => 0,
            _ => self.motions - usize::from(stresses.iter().any(is_there)),
        }
    }

    /// Returns the possible effect of rounding on the form of a self-stress.
    fn change(&self, stress: &[f64]) -> f64 {
        let one = |change: &Matrix| {
            let row = change.transpose_times(&Matrix::column(stress));
            size_of(&form(row.col(0), self.motions))
        };
        self.changes.iter().map(one).sum()
    }

    /// Returns true if rounding can explain all the work.
    pub(super) fn may_vanish(&self) -> bool {
        let Some(factors) = svd(&self.table) else {
            return false;
        };
        (0..factors.values.len()).all(|k| {
            let (u, v) = (factors.u.col(k), factors.v.col(k));
            let one = |change: &Matrix| -> f64 {
                let row = change.transpose_times(&Matrix::column(u));
                row.col(0).iter().zip(v).map(|(a, b)| a * b).sum()
            };
            let squares: f64 = self.changes.iter().map(|c| one(c).powi(2) / 3.0).sum();
            factors.values[k] <= ZERO.max(RARE * squares.sqrt())
        })
    }
}

/// Returns the Frobenius norm.
fn size_of(matrix: &Matrix) -> f64 {
    let columns = (0..matrix.ncols()).map(|c| norm(matrix.col(c)).powi(2));
    columns.sum::<f64>().sqrt()
}
