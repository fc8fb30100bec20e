//! One of the reactions that redundant constraints leave open: that of minimum norm, or that of elastic joints.

use crate::model::loads::{Loads, Stiffness};
use crate::model::mechanism::Mechanism;
use crate::statics::reactions::geometry::{Geometry, Six, about};
use ozols_dense::{Matrix, least_squares_pivoted};

/// Adds self-stresses so that Σ (weight · (w at the joint's point) - aim)² becomes least; weights and aims by joint of the
/// state, six each.
fn fit(
    geometry: &Geometry,
    wrenches: &mut [Six],
    stresses: &[Vec<Six>],
    weights: &[Six],
    aims: &[Six],
) {
    if stresses.is_empty() {
        return;
    }
    let at = |w: &[Six], r: usize| {
        let (n, i) = (r / 6, r % 6);
        let j = geometry.joints[n];
        weights[n][i] * about(&w[j], geometry.points[j])[i]
    };
    let rows = 6 * geometry.joints.len();
    let a = Matrix::from_fn(rows, stresses.len(), |r, c| at(&stresses[c], r));
    let b: Vec<f64> = (0..rows)
        .map(|r| aims[r / 6][r % 6] - at(wrenches, r))
        .collect();
    for (x, stress) in least_squares_pivoted(&a, &b).iter().zip(stresses) {
        for (w, s) in wrenches.iter_mut().flatten().zip(stress.iter().flatten()) {
            *w += x * s;
        }
    }
}

/// The wrenches of least Σ |f|² + |m|²/ℓ² over the joints, about their own points.
pub(crate) fn least_norm(geometry: &Geometry, wrenches: &mut [Six], stresses: &[Vec<Six>]) {
    let n = geometry.joints.len();
    fit(
        geometry,
        wrenches,
        stresses,
        &vec![[1.0; 6]; n],
        &vec![[0.0; 6]; n],
    );
}

/// The wrenches of elastic joints, made askew as stated: of all that are in equilibrium, those of least energy
/// Σ ½ wᵀC w - wᵀd, C the joint's compliance and d what it is out by. `None` where no stiffness is stated or nothing is
/// left open.
pub(crate) fn elastic(
    m: &Mechanism,
    geometry: &Geometry,
    loads: &Loads,
    mut wrenches: Vec<Six>,
    stresses: &[Vec<Six>],
) -> Option<Vec<Six>> {
    if stresses.is_empty() || loads.stiffness.is_empty() {
        return None;
    }
    let (mut weights, mut aims) = (Vec::new(), Vec::new());
    for &j in &geometry.joints {
        let s = stiffness(loads, m.joints[j].joint_type.name())?;
        // Lengths in the size: a displacement is f/(k ℓ), a turn m ℓ/k for a moment m in N·ℓ.
        let (turn, shift) = (
            (geometry.size / s.angular).sqrt(),
            (1.0 / (s.linear * geometry.size)).sqrt(),
        );
        weights.push([turn, turn, turn, shift, shift, shift]);
        let mut off = [0.0; 6];
        for x in loads.misalignments.iter().filter(|x| x.joint == j) {
            for (k, axis) in geometry.axes[j].iter().enumerate() {
                for i in 0..3 {
                    off[i] += x.turn[k] * axis[i] / turn;
                    off[3 + i] += x.shift[k] / geometry.size * axis[i] / shift;
                }
            }
        }
        aims.push(off);
    }
    fit(geometry, &mut wrenches, stresses, &weights, &aims);
    Some(wrenches)
}

/// The stiffness of a joint type: its own, or the default.
fn stiffness(loads: &Loads, name: &str) -> Option<Stiffness> {
    let find = |name: &str| loads.stiffness.iter().find(|(n, _)| n == name);
    find(name).or_else(|| find("default")).map(|(_, s)| *s)
}
