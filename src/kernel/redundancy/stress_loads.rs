//! The wrench of a self-stress on each joint, in any number system, and its load in numbers.
//!
//! The self-stresses are exact, modulo a prime, and residues have no size. But each is determined, up to a factor, by
//! its zero entries. For friction at the contacts, the zero effects on the faces are used as well. The bases are in
//! reduced form, so no other self-stress has the same zeros. Its real numbers are the only solution of the closure
//! equations of those rows.

use crate::closure::Closure;
use crate::closure::contour::Contour;
use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::exact::ExactError;
use crate::geom::rigid::{join_twist, split_twist};
use crate::geom::vector::{Vector, dot, scale, sub};
use crate::geom::{Reals, Scalars};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use ozols_dense::{Matrix, svd};

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
    pub fn energy_share(&self) -> f64 {
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
    /// Prepares the shares for a state and contours of it.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    pub(super) fn new(
        mechanism: &'a Mechanism,
        state: StateId,
        contours: &[Contour],
    ) -> Result<Self, ExactError> {
        let closure = Closure::with_contours(&Reals, mechanism, state, contours.to_vec())?;
        let points: Vec<[f64; 3]> = mechanism
            .joints_in(state)
            .map(|j| [0, 1, 2].map(|i| mechanism.joints[j].frame.point[i].to_f64()))
            .collect();
        let count = points.len().max(1) as f64;
        let middle = [0, 1, 2].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / count);
        let square = |p: &[f64; 3]| dot(sub(*p, middle), sub(*p, middle));
        let size = (points.iter().map(square).sum::<f64>() / count).sqrt();
        Ok(Shares {
            mechanism,
            columns: closure.dense_columns(&Reals),
            wrenches: JointWrenches::new(&Reals, mechanism, &closure)?,
            closure,
            size: if size > 0.0 { size } else { 1.0 },
            left: MOST_PRODUCTS,
        })
    }

    /// Returns the unit of an unknown: moments are divided by the size.
    fn row_unit(&self, row: usize) -> f64 {
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

    /// Returns the numbers of a self-stress, or `None` if the numbers do not distinguish the self-stress from others, or if
    /// there are too many of them.
    ///
    /// # Complexity
    /// O(r² f) for r nonzero rows and f freedoms in their contours.
    pub(super) fn numbers_of(
        &mut self,
        stress: &[Residue],
        faces: Option<Faces<'_>>,
    ) -> Option<Vec<f64>> {
        let rows: Vec<usize> = (0..stress.len()).filter(|&r| stress[r] != 0).collect();
        let equation = |column: &Vec<f64>| -> Vec<f64> {
            rows.iter()
                .map(|&r| column[r] * self.row_unit(r) / self.size)
                .collect()
        };
        let mut equations: Vec<Vec<f64>> = self.columns.iter().map(equation).collect();
        equations.retain(|e| e.iter().any(|x| *x != 0.0));
        if let Some(faces) = faces {
            let one = |&r: &usize| {
                let mut unit = vec![0.0; stress.len()];
                unit[r] = self.row_unit(r);
                let at = |&j: &JointId| {
                    self.wrenches
                        .harm_at_face(&unit, j, Some(j) == faces.reference)
                };
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
            real[r] = x * self.row_unit(r);
        }
        Some(real)
    }

    /// Returns the self-stress that is nearest to these numbers, of all in a pose that has `count` independent ones.
    pub(super) fn nearest_to(&self, numbers: &[f64], count: usize) -> Option<Vec<f64>> {
        let unit = |r: usize| self.row_unit(r) / self.size;
        let equations = Matrix::from_fn(numbers.len(), self.columns.len(), |r, c| {
            self.columns[c][r] * unit(r)
        });
        let all = svd(&equations)?.left_null_space(numbers.len().checked_sub(count)?);
        let mut out = vec![0.0; numbers.len()];
        for c in 0..count {
            let along = |r: usize| all[(r, c)] * numbers[r] / unit(r);
            let part: f64 = (0..out.len()).map(along).sum();
            (0..out.len()).for_each(|r| out[r] += part * all[(r, c)] * unit(r));
        }
        Some(out)
    }

    /// Returns the load on each joint under a self-stress, or `None` if it loads none.
    pub(super) fn loads_under(&self, real: &[f64]) -> Option<Vec<Borne>> {
        let mut out = vec![Borne::default(); self.mechanism.joints.len()];
        for j in self.mechanism.joints_in(self.closure.state) {
            let w = self.wrenches.wrench_at(real, j);
            let unit = self.wrenches.moment_scale().unwrap_or(1.0) * self.size;
            out[j] = Borne {
                moment: scale(self.wrenches.moment_at(j, &w), 1.0 / unit),
                force: [w[3], w[4], w[5]],
            };
        }
        let whole = out.iter().map(Borne::energy_share).sum::<f64>().sqrt();
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

/// A wrench about the global origin, (m; f) in global axes.
pub(super) type Wrench<N> = [N; 6];

/// The wrenches of the joints of a state under self-stresses.
///
/// A self-stress of planar mode has three numbers per contour, a moment about the plane's normal n and forces along the
/// e1 and e2 of [`MotionSpace`]. As a wrench in space this is (μ n; f1 e1 + f2 e2), whose power on any twist in the
/// plane is the same.
pub(crate) struct JointWrenches<'a, S: Scalars> {
    s: &'a S,
    dim: usize,
    space: MotionSpace<S::Number>,
    frames: Vec<FrameValues<S::Number>>,
    /// For each joint, the contours that pass it, and whether forward.
    passes: Vec<Vec<(usize, bool)>>,
}

impl<'a, S: Scalars> JointWrenches<'a, S> {
    /// Prepares the joints of a mechanism, with the contours of any closure of the state.
    pub(crate) fn new<N>(
        s: &'a S,
        m: &Mechanism,
        closure: &Closure<N>,
    ) -> Result<Self, ExactError> {
        let mut passes = vec![Vec::new(); m.joints.len()];
        for (i, c) in closure.contours.iter().enumerate() {
            for &(j, forward) in &c.joints {
                passes[j].push((i, forward));
            }
        }
        let frames = m.joints.iter().map(|j| FrameValues::new(s, &j.frame));
        Ok(JointWrenches {
            s,
            dim: closure.dim,
            space: MotionSpace::new(s, &m.mode)?,
            frames: frames.collect::<Result<_, _>>()?,
            passes,
        })
    }

    fn zero_vector(&self) -> [S::Number; 3] {
        std::array::from_fn(|_| S::Number::default())
    }

    /// Returns the wrench of a self-stress on a joint as the coordinates whose products with those of a twist give its power: six numbers, or
    /// three in a plane.
    pub(crate) fn coordinates_at(&self, stress: &[S::Number], joint: JointId) -> Vec<S::Number> {
        let s = self.s;
        let mut sum = vec![S::Number::default(); self.dim];
        for &(i, forward) in &self.passes[joint] {
            let block = &stress[i * self.dim..(i + 1) * self.dim];
            for (x, b) in sum.iter_mut().zip(block) {
                *x = if forward {
                    s.add(x.clone(), b.clone())
                } else {
                    s.sub(x.clone(), b.clone())
                };
            }
        }
        sum
    }

    /// Returns the wrench of a self-stress on a joint.
    pub(super) fn wrench_at(&self, stress: &[S::Number], joint: JointId) -> Wrench<S::Number> {
        let (s, sum) = (self.s, self.coordinates_at(stress, joint));
        let (m, f) = match (&self.space, &sum[..]) {
            (MotionSpace::Planar { axes: [n, e1, e2] }, [turn, along, across]) => {
                let first = s.scaled_sum(along.clone(), e1.clone(), self.zero_vector());
                (
                    s.scaled_sum(turn.clone(), n.clone(), self.zero_vector()),
                    s.scaled_sum(across.clone(), e2.clone(), first),
                )
            }
            (_, sum) => split_twist(sum),
        };
        join_twist(m, f)
    }

    /// Returns the moment of a wrench about the joint's point, m - p × f. In a plane it is the part along the normal,
    /// times [`Self::scale`].
    pub(super) fn moment_at(&self, joint: JointId, w: &Wrench<S::Number>) -> [S::Number; 3] {
        let s = self.s;
        let (m, f) = split_twist(w);
        let arm = s.cross(self.frames[joint].point.clone(), f);
        let moment = std::array::from_fn(|i| s.sub(m[i].clone(), arm[i].clone()));
        match &self.space {
            MotionSpace::Spatial => moment,
            MotionSpace::Planar { axes: [n, ..] } => {
                s.scaled_sum(s.dot(n.clone(), moment), n.clone(), self.zero_vector())
            }
        }
    }

    /// Returns the factor of [`Self::moment_at`] in a plane, n · n, or `None` in space.
    pub(super) fn moment_scale(&self) -> Option<S::Number> {
        match &self.space {
            MotionSpace::Spatial => None,
            MotionSpace::Planar { axes: [n, ..] } => Some(self.s.dot(n.clone(), n.clone())),
        }
    }

    /// Returns the components of a self-stress at a face (z its normal) other than friction: a normal force and, if
    /// requested, tangential moments.
    pub(super) fn harm_at_face(
        &self,
        stress: &[S::Number],
        joint: JointId,
        moments: bool,
    ) -> Vec<S::Number> {
        let (s, w) = (self.s, self.wrench_at(stress, joint));
        let m = self.moment_at(joint, &w);
        let [x, y, z] = self.frames[joint].axes.clone();
        let [_, _, _, f0, f1, f2] = w;
        let mut out = vec![s.dot([f0, f1, f2], z)];
        if moments {
            out.extend([s.dot(m.clone(), x), s.dot(m, y)]);
        }
        out
    }
}
