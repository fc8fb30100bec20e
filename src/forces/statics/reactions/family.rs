//! One of the reactions that redundant constraints leave open: that of minimum norm, or that of elastic joints.

use crate::model::loads::{Loads, Stiffness};
use crate::model::mechanism::Mechanism;
use crate::statics::reactions::geometry::{Geometry, Six};
use crate::statics::reactions::transmitted::Transmitted;
use ozols_dense::{Matrix, least_squares_pivoted};

/// The weight of couplings beside the greatest of a joint, where they are as good as rigid: the square of it is far below what
/// stiffness is known to, and yet it keeps self-stresses apart that load couplings alone.
const RIGID: f64 = 1e-6;

/// Adds self-stresses so that Σ (weight · value - aim)² becomes least; weights and aims by value of [`Transmitted::flat`].
fn fit(
    geometry: &Geometry,
    of: &mut Transmitted,
    stresses: &[Transmitted],
    weights: &[f64],
    aims: &[f64],
) {
    if stresses.is_empty() {
        return;
    }
    let columns: Vec<Vec<f64>> = stresses.iter().map(|s| s.flat(geometry)).collect();
    let present = of.flat(geometry);
    let a = Matrix::from_fn(weights.len(), stresses.len(), |r, c| {
        weights[r] * columns[c][r]
    });
    let left = (0..weights.len()).map(|r| aims[r] - weights[r] * present[r]);
    let b: Vec<f64> = left.collect();
    for (x, stress) in least_squares_pivoted(&a, &b).iter().zip(stresses) {
        of.add(*x, stress);
    }
}

/// The wrenches of least Σ |f|² + |m|²/ℓ² over the joints, about their own points, and over what couplings pass at both ends.
pub(crate) fn least_norm(geometry: &Geometry, of: &mut Transmitted, stresses: &[Transmitted]) {
    // The entries of a coupling have 1 for the sum of their squares: x² is that of both ends.
    let n = 6 * geometry.joints.len() + geometry.couplings.len();
    fit(geometry, of, stresses, &vec![1.0; n], &vec![0.0; n]);
}

/// The wrenches of elastic joints, made askew as stated: of all that are in equilibrium, those of least energy
/// Σ ½ wᵀC w - wᵀd, C the joint's compliance and d what it is out by; couplings are rigid. With them the greatest force, or
/// moment by size, that a joint which cannot give way would bear for what it is out by. `None` where no stiffness is stated or
/// nothing is left open.
pub(crate) fn elastic(
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
        let s = stiffness(loads, m.joints[j].joint_type.name())?;
        // Lengths in the size: a displacement is f/(k ℓ), a turn m ℓ/k for a moment m in N·ℓ.
        let (turn, shift) = (
            (geometry.size / s.angular).sqrt(),
            (1.0 / (s.linear * geometry.size)).sqrt(),
        );
        weights.extend([turn, turn, turn, shift, shift, shift]);
        let mut off: Six = [0.0; 6];
        for x in loads.misalignments.iter().filter(|x| x.joint == j) {
            for (k, axis) in geometry.axes[j].iter().enumerate() {
                for i in 0..3 {
                    off[i] += x.turn[k] * axis[i] / turn;
                    off[3 + i] += x.shift[k] / geometry.size * axis[i] / shift;
                }
            }
        }
        aims.extend(off);
    }
    let rigid = RIGID * weights.iter().fold(0.0, |a: f64, w| a.max(*w));
    weights.resize(weights.len() + geometry.couplings.len(), rigid);
    aims.resize(weights.len(), 0.0);
    fit(geometry, &mut of, stresses, &weights, &aims);
    let strained = weights.iter().zip(&aims).map(|(w, a)| (a / w).abs());
    Some((of, strained.fold(0.0, f64::max)))
}

/// The stiffness of a joint type: its own, or the default.
fn stiffness(loads: &Loads, name: &str) -> Option<Stiffness> {
    let find = |name: &str| loads.stiffness.iter().find(|(n, _)| n == name);
    find(name).or_else(|| find("default")).map(|(_, s)| *s)
}
