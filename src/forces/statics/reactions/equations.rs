//! The transposed closure equations of the freedoms, solved by their singular values, for the wrenches of joints and
//! couplings. If redundant constraints leave reactions open, one of them is chosen: that of minimum norm, or that of
//! elastic joints.

use crate::closure::drive::Driven;
use crate::geom::vector::{add, add_scaled, scale};
use crate::model::loads::{Loads, Stiffness};
use crate::model::mechanism::Mechanism;
use crate::statics::reactions::geometry::{
    FreedomColumn, Geometry, Six, TOLERANCE, shift_wrench, wrench_power,
};
use crate::statics::reactions::unsolved::Unsolved;
use crate::statics::reactions::wrench::join_halves;
use ozols_dense::{Matrix, Svd, least_squares_pivoted, svd};

/// Wrenches of the joints and unknowns of the couplings.
#[derive(Debug, Clone)]
pub(crate) struct Transmitted {
    /// For each joint, the total wrench from its first link to its second, including couplings.
    pub(crate) joints: Vec<Six>,
    /// For each coupling of the state, its x.
    pub(crate) couplings: Vec<f64>,
}

impl Transmitted {
    /// Creates wrenches of joints, with zero in the couplings.
    pub(crate) fn of_joints(geometry: &Geometry, joints: Vec<Six>) -> Transmitted {
        Transmitted {
            joints,
            couplings: vec![0.0; geometry.couplings.len()],
        }
    }

    /// Adds wrenches around the contours, given by their coefficients in the basis, to those of the joints. The
    /// coefficients that follow them are added to the couplings.
    fn add_round(&mut self, geometry: &Geometry, coefficients: &[f64]) {
        let dim = geometry.basis.len();
        for (k, contour) in geometry.contours.iter().enumerate() {
            let each = geometry.basis.iter().zip(&coefficients[k * dim..]);
            let round = each.fold([0.0; 6], |sum, (b, x)| add_scaled(sum, *x, *b));
            for &(j, forward) in &contour.joints {
                let sign = if forward { 1.0 } else { -1.0 };
                self.joints[j] = add_scaled(self.joints[j], sign, round);
            }
        }
        let of_couplings = &coefficients[dim * geometry.contours.len()..];
        for (x, c) in self.couplings.iter_mut().zip(of_couplings) {
            *x += c;
        }
    }

    /// Returns the wrenches of the joints and their drives, without the parts of couplings that bypass them.
    pub(crate) fn own_wrenches(&self, geometry: &Geometry) -> Vec<Six> {
        let mut out = self.joints.clone();
        for (c, x) in geometry.couplings.iter().zip(&self.couplings) {
            for (n, end) in c.ends.iter().enumerate() {
                let beside = c.bypass_wrench(n, c.meshes);
                out[end.joint] = add_scaled(out[end.joint], -x, beside);
            }
        }
        out
    }

    /// Returns all numbers one after another: each joint of the state about its own point, then the couplings.
    pub(crate) fn flat_values(&self, geometry: &Geometry) -> Vec<f64> {
        let own = self.own_wrenches(geometry);
        let joints = geometry.joints.iter();
        joints
            .flat_map(|&j| shift_wrench(&own[j], geometry.points[j]))
            .chain(self.couplings.iter().copied())
            .collect()
    }

    /// Adds a multiple of other wrenches.
    pub(crate) fn add_multiple(&mut self, factor: f64, other: &Transmitted) {
        for (w, o) in self.joints.iter_mut().zip(&other.joints) {
            *w = add_scaled(*w, factor, *o);
        }
        for (x, o) in self.couplings.iter_mut().zip(&other.couplings) {
            *x += factor * o;
        }
    }

    /// Multiplies all wrenches.
    pub(crate) fn scale_by(&mut self, factor: f64) {
        let joints = self.joints.iter_mut().flatten();
        joints.chain(&mut self.couplings).for_each(|x| *x *= factor);
    }
}

/// The equations of the freedoms that no drive holds.
pub(crate) struct System<'g> {
    geometry: &'g Geometry,
    /// Columns of the geometry.
    pub(crate) equations: Vec<usize>,
    unknowns: usize,
    svd: Svd,
    rank: usize,
}

impl<'g> System<'g> {
    pub(crate) fn new(geometry: &'g Geometry, drives: &[Driven]) -> Result<Self, Unsolved> {
        let held = |c: &FreedomColumn| drives.contains(&(c.joint, c.freedom));
        let equations: Vec<usize> = (0..geometry.columns.len())
            .filter(|&c| !held(&geometry.columns[c]))
            .collect();
        let unknowns = geometry.unknown_count();
        let rows: Vec<Vec<f64>> = equations
            .iter()
            .map(|&c| geometry.closure_row(&geometry.columns[c]))
            .collect();
        let a = Matrix::from_fn(rows.len(), unknowns, |r, c| rows[r][c]);
        let svd = svd(&a).ok_or(Unsolved::NoConvergence)?;
        let rank = svd.rank(TOLERANCE);
        Ok(System {
            geometry,
            equations,
            unknowns,
            svd,
            rank,
        })
    }

    pub(crate) fn undriven_freedoms(&self) -> usize {
        self.equations.len() - self.rank
    }

    pub(crate) fn condition_number(&self) -> f64 {
        match self.rank.checked_sub(1) {
            Some(last) => self.svd.values[0] / self.svd.values[last],
            None => 1.0,
        }
    }

    /// Returns the work of the joints' wrenches on the freedoms of the equations, without the parts that couplings
    /// transmit.
    fn remaining_work(&self, of: &Transmitted) -> Vec<f64> {
        let columns = self.equations.iter().map(|&c| &self.geometry.columns[c]);
        let one = |c: &FreedomColumn| {
            let coupled = self.geometry.coupling_entries(c);
            let coupled: f64 = coupled.map(|(q, e)| e * of.couplings[q]).sum();
            wrench_power(&c.twist, &of.joints[c.joint]) + coupled
        };
        columns.map(one).collect()
    }

    /// Adds contour wrenches and coupling unknowns so that no work is done on the freedoms, as far as possible. Returns
    /// the remaining work.
    pub(crate) fn balance_work(&self, of: &mut Transmitted) -> Vec<f64> {
        // The second round removes the rounding errors of the first.
        for _ in 0..2 {
            let work = self.remaining_work(of);
            let mut coefficients = vec![0.0; self.unknowns];
            for i in 0..self.rank {
                let share: f64 = work.iter().zip(self.svd.u.col(i)).map(|(x, u)| u * x).sum();
                let share = -share / self.svd.values[i];
                for (x, v) in coefficients.iter_mut().zip(self.svd.v.col(i)) {
                    *x += share * v;
                }
            }
            of.add_round(self.geometry, &coefficients);
        }
        self.remaining_work(of)
    }

    /// Returns independent sets of self-equilibrated wrenches, by joint, including those of couplings.
    pub(crate) fn self_stresses(&self, joints: usize) -> Vec<Transmitted> {
        let one = |i: usize| {
            let mut out = Transmitted::of_joints(self.geometry, vec![[0.0; 6]; joints]);
            out.add_round(self.geometry, self.svd.v.col(i));
            let all = out.flat_values(self.geometry).into_iter();
            let greatest = all.fold(0.0, |a: f64, x| a.max(x.abs()));
            out.scale_by(1.0 / greatest);
            out
        };
        (self.rank..self.unknowns).map(one).collect()
    }
}

/// Weight of couplings relative to the largest weight of a joint, if they are practically rigid. Its square is far
/// below the accuracy of stiffness, but it keeps self-stresses apart that load only couplings.
const RIGID: f64 = 1e-6;

/// Adds self-stresses so that Σ (weight · value - aim)² is minimal, with weights and aims by value of
/// [`Transmitted::flat_values`].
fn fit_stresses(
    geometry: &Geometry,
    of: &mut Transmitted,
    stresses: &[Transmitted],
    weights: &[f64],
    aims: &[f64],
) {
    if stresses.is_empty() {
        return;
    }
    let columns: Vec<Vec<f64>> = stresses.iter().map(|s| s.flat_values(geometry)).collect();
    let present = of.flat_values(geometry);
    let a = Matrix::from_fn(weights.len(), stresses.len(), |r, c| {
        weights[r] * columns[c][r]
    });
    let left = (0..weights.len()).map(|r| aims[r] - weights[r] * present[r]);
    let b: Vec<f64> = left.collect();
    for (x, stress) in least_squares_pivoted(&a, &b).iter().zip(stresses) {
        of.add_multiple(*x, stress);
    }
}

/// Adds self-stresses so that Σ |f|² + |m|²/ℓ² is minimal over the joints, about their own points, and over the
/// wrenches of couplings at both ends.
pub(crate) fn least_norm(geometry: &Geometry, of: &mut Transmitted, stresses: &[Transmitted]) {
    // The squares of the entries of a coupling add up to 1, so x² is the sum for both ends.
    let n = 6 * geometry.joints.len() + geometry.couplings.len();
    fit_stresses(geometry, of, stresses, &vec![1.0; n], &vec![0.0; n]);
}

/// Returns the wrenches of elastic joints with the stated misalignments. Among all wrenches in equilibrium, they
/// minimise the energy Σ ½ wᵀC w - wᵀd, with C the joint's compliance and d its misalignment; couplings are rigid.
///
/// Also returns the largest force, or moment divided by size, that a rigid joint would carry for its misalignment.
/// Returns `None` if no stiffness is stated or nothing is left open.
pub(crate) fn elastic_reactions(
    m: &Mechanism,
    geometry: &Geometry,
    loads: &Loads,
    mut of: Transmitted,
    stresses: &[Transmitted],
) -> Option<(Transmitted, f64)> {
    if stresses.is_empty() || loads.stiffness.is_empty() {
        return None;
    }
    let (mut weights, mut aims): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for &j in &geometry.joints {
        let s = joint_stiffness(loads, m.joints[j].joint_type.name())?;
        // Lengths in the size: a displacement is f/(k ℓ), a turn m ℓ/k for a moment m in N·ℓ.
        let (turn, shift) = (
            (geometry.size / s.angular).sqrt(),
            (1.0 / (s.linear * geometry.size)).sqrt(),
        );
        weights.extend([turn, turn, turn, shift, shift, shift]);
        let mut off: Six = [0.0; 6];
        for x in loads.misalignments.iter().filter(|x| x.joint == j) {
            for (k, axis) in geometry.axes[j].iter().enumerate() {
                let (turned, shifted) = (x.turn[k] / turn, x.shift[k] / geometry.size / shift);
                off = add(
                    off,
                    join_halves(scale(*axis, turned), scale(*axis, shifted)),
                );
            }
        }
        aims.extend(off);
    }
    let rigid = RIGID * weights.iter().fold(0.0, |a: f64, w| a.max(*w));
    weights.resize(weights.len() + geometry.couplings.len(), rigid);
    aims.resize(weights.len(), 0.0);
    fit_stresses(geometry, &mut of, stresses, &weights, &aims);
    let strained = weights.iter().zip(&aims).map(|(w, a)| (a / w).abs());
    Some((of, strained.fold(0.0, f64::max)))
}

/// Returns the stiffness of a joint type: its own, or the default.
fn joint_stiffness(loads: &Loads, name: &str) -> Option<Stiffness> {
    let find = |name: &str| loads.stiffness.iter().find(|(n, _)| n == name);
    find(name).or_else(|| find("default")).map(|(_, s)| *s)
}
