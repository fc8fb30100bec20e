//! Locks freedoms at rest to first order, so that the moving rest is recognised as a planar, spherical or other simple
//! mechanism.
//!
//! A freedom with speed 0 in every instantaneous motion takes no part in any of them. If it is locked, the null space
//! of J is as large as before. A proven motion of the locked mechanism is also a motion of the whole mechanism, and no
//! motion exceeds the instantaneous mobility. So the finite mobility of a pose is proven if it is that of the mechanism
//! with such freedoms locked. An example is the spatial slider of a planar linkage that could turn about its guide, but
//! does not.

use crate::closure::Closure;
use crate::geom::exact::ExactField;
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::JointType;
use crate::model::mechanism::Mechanism;

/// Returns the mechanism with every freedom locked that is at rest in all instantaneous motions, or `None` if there are
/// none.
///
/// # Complexity
/// One elimination of J by rows, O((6k)² f).
#[must_use]
pub(crate) fn lock_resting(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Option<Mechanism> {
    let columns = closure.dense(exact);
    let mut rows = Echelon::new(exact.field());
    for r in 0..closure.rows() {
        let row: Vec<Residue> = columns.iter().map(|c| c[r]).collect();
        rows.insert(&row);
    }
    // A row of the reduced form with no entry other than its pivot means that this freedom has speed 0.
    let rests = |row: &Vec<Residue>| row.iter().filter(|&&x| x != 0).count() == 1;
    let resting: Vec<usize> = rows
        .reduced()
        .iter()
        .filter(|row| rests(row))
        .filter_map(|row| row.iter().position(|&x| x != 0))
        .collect();
    let coupled = |c: &usize| {
        let joint = closure.columns[*c].joint;
        mechanism.couplings_of(joint).next().is_some()
    };
    let resting: Vec<usize> = resting.into_iter().filter(|c| !coupled(c)).collect();
    if resting.is_empty() {
        return None;
    }
    let mut out = mechanism.clone();
    for j in mechanism.joint_ids() {
        let held = |f| {
            let columns = resting.iter().map(|&c| &closure.columns[c]);
            columns.into_iter().any(|c| (c.joint, c.freedom) == (j, f))
        };
        let joint = &mut out.joints[j];
        let all = joint.joint_type.freedoms();
        let kept: Vec<_> = all.iter().copied().filter(|&f| !held(f)).collect();
        if kept.len() < all.len() {
            joint.joint_type = JointType::Custom(kept);
        }
    }
    Some(out)
}
