//! The load of a self-stress on each joint, in numbers.
//!
//! The self-stresses are exact, modulo a prime, and residues have no size. But each is determined, up to a factor, by
//! its zero entries. For friction at the contacts, the zero effects on the faces are used as well. The bases are in
//! reduced form, so no other self-stress has the same zeros. Its real numbers are the only solution of the closure
//! equations of those rows.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::geom::vector::{Vector, dot, scale, sub};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism};
use crate::redundancy::joint_wrench::JointWrenches;

/// Share of the first pivot below which pivots are zero.
const TOLERANCE: f64 = 1e-9;
/// Maximum number of products for all self-stresses of a state. Remaining ones have no shares.
const MOST_PRODUCTS: usize = 200_000_000;

/// The faces that a self-stress only loads with friction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Faces<'a> {
    /// The joints.
    pub(super) joints: &'a [JointId],
    /// The face at which moments are evaluated.
    pub(super) reference: Option<JointId>,
}

/// The load of a self-stress on a joint, in global axes: the wrench on the second of its links, and so the opposite of
/// that on the first. The unit of force is such that Σ |f|² + |m|²/ℓ² over the joints is 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Borne {
    /// The moment about the joint's point, in the unit of force times ℓ, the length that makes both comparable.
    pub moment: Vector,
    /// The force.
    pub force: Vector,
}

impl Borne {
    /// Returns its part of Σ |f|² + |m|²/ℓ² over the joints, about their own points.
    #[must_use]
    pub fn share(&self) -> f64 {
        dot(self.force, self.force) + dot(self.moment, self.moment)
    }
}

/// Shares of the joints in self-stresses, computed one after the other.
pub struct Shares<'a> {
    mechanism: &'a Mechanism,
    closure: Closure<f64>,
    columns: Vec<Vec<f64>>,
    wrenches: JointWrenches<'static, Reals>,
    /// Root mean square distance of the joints from their middle; 1 if they coincide.
    size: f64,
    left: usize,
}

impl std::fmt::Debug for Shares<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Shares")
            .field("size", &self.size)
            .finish_non_exhaustive()
    }
}

impl<'a> Shares<'a> {
    /// Prepares the shares for the state and contours of a closure.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    pub(crate) fn new(mechanism: &'a Mechanism, of: &Closure<Residue>) -> Result<Self, ExactError> {
        let closure = Closure::with_contours(&Reals, mechanism, of.state, of.contours.clone())?;
        let points: Vec<[f64; 3]> = mechanism
            .joints_in(of.state)
            .map(|j| [0, 1, 2].map(|i| mechanism.joints[j].frame.point[i].to_f64()))
            .collect();
        #[allow(clippy::cast_precision_loss, reason = "a count of joints")]
        let count = points.len().max(1) as f64;
        let middle = [0, 1, 2].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / count);
        let square = |p: &[f64; 3]| dot(sub(*p, middle), sub(*p, middle));
        let size = (points.iter().map(square).sum::<f64>() / count).sqrt();
        Ok(Shares {
            mechanism,
            columns: closure.dense(&Reals),
            wrenches: JointWrenches::new(&Reals, mechanism, of)?,
            closure,
            size: if size > 0.0 { size } else { 1.0 },
            left: MOST_PRODUCTS,
        })
    }

    /// Returns the unit of an unknown: moments are divided by the size.
    fn unit(&self, row: usize) -> f64 {
        let (dim, of_contours) = (self.closure.dim, self.closure.contour_rows());
        let turning = if dim == 6 { 3 } else { 1 };
        if row < of_contours && row % dim < turning {
            self.size
        } else {
            1.0
        }
    }

    /// Returns ℓ, the size of the mechanism: the root mean square distance of the joints from their middle.
    pub(super) fn size(&self) -> f64 {
        self.size
    }

    /// Returns the load on each joint, or `None` if the numbers do not distinguish the self-stress from others, or if
    /// there are too many of them.
    ///
    /// # Complexity
    /// O(r² f) for r nonzero rows and f freedoms in their contours.
    pub(super) fn of(
        &mut self,
        stress: &[Residue],
        faces: Option<Faces<'_>>,
    ) -> Option<Vec<Borne>> {
        let rows: Vec<usize> = (0..stress.len()).filter(|&r| stress[r] != 0).collect();
        let equation = |column: &Vec<f64>| -> Vec<f64> {
            rows.iter()
                .map(|&r| column[r] * self.unit(r) / self.size)
                .collect()
        };
        let mut equations: Vec<Vec<f64>> = self.columns.iter().map(equation).collect();
        equations.retain(|e| e.iter().any(|x| *x != 0.0));
        if let Some(faces) = faces {
            let one = |&r: &usize| {
                let mut unit = vec![0.0; stress.len()];
                unit[r] = self.unit(r);
                let at = |&j: &JointId| self.wrenches.harm(&unit, j, Some(j) == faces.reference);
                faces.joints.iter().flat_map(at).collect::<Vec<f64>>()
            };
            let harm: Vec<Vec<f64>> = rows.iter().map(one).collect();
            let many = harm.first().map_or(0, Vec::len);
            equations.extend((0..many).map(|i| harm.iter().map(|h| h[i]).collect()));
        }
        self.left = self
            .left
            .checked_sub(equations.len() * rows.len() * rows.len())?;
        let found = only_solution(equations, rows.len())?;
        let mut real = vec![0.0; stress.len()];
        for (&r, x) in rows.iter().zip(&found) {
            real[r] = x * self.unit(r);
        }
        let mut out = vec![Borne::default(); self.mechanism.joints.len()];
        for j in self.mechanism.joints_in(self.closure.state) {
            let w = self.wrenches.at(&real, j);
            let unit = self.wrenches.scale().unwrap_or(1.0) * self.size;
            out[j] = Borne {
                moment: scale(self.wrenches.moment_at(j, &w), 1.0 / unit),
                force: [w[3], w[4], w[5]],
            };
        }
        let whole = out.iter().map(Borne::share).sum::<f64>().sqrt();
        for b in &mut out {
            (b.moment, b.force) = (scale(b.moment, 1.0 / whole), scale(b.force, 1.0 / whole));
        }
        (whole > 0.0).then_some(out)
    }
}

/// Returns the solution, up to a factor, of homogeneous equations in `n` unknowns by elimination with complete
/// pivoting. Returns `None` if they have no solution or several.
fn only_solution(mut rows: Vec<Vec<f64>>, n: usize) -> Option<Vec<f64>> {
    // The unknown at each position of the elimination.
    let mut order: Vec<usize> = (0..n).collect();
    // Rows of turns, shifts and faces are scaled to equal weight.
    for row in &mut rows {
        let greatest = row.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        row.iter_mut()
            .filter(|_| greatest > 0.0)
            .for_each(|x| *x /= greatest);
    }
    let greatest_from = |rows: &[Vec<f64>], k: usize, order: &[usize]| {
        let each = (k..rows.len()).flat_map(|r| (k..n).map(move |c| (r, c)));
        let sized = each.map(|(r, c)| (rows[r][order[c]].abs(), r, c));
        sized
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, k, k))
    };
    for k in 0..n.checked_sub(1)? {
        let (size, r, c) = greatest_from(&rows, k, &order);
        if size <= TOLERANCE {
            return None;
        }
        rows.swap(k, r);
        order.swap(k, c);
        let (done, rest) = rows.split_at_mut(k + 1);
        let head = &done[k];
        for row in rest {
            let factor = row[order[k]] / head[order[k]];
            for &c in &order[k..] {
                row[c] -= factor * head[c];
            }
        }
    }
    if greatest_from(&rows, n - 1, &order).0 > TOLERANCE {
        return None;
    }
    let mut out = vec![0.0; n];
    out[order[n - 1]] = 1.0;
    for k in (0..n - 1).rev() {
        let sum: f64 = order[k + 1..].iter().map(|&c| rows[k][c] * out[c]).sum();
        out[order[k]] = -sum / rows[k][order[k]];
    }
    Some(out)
}
