//! Freedoms that rest at first order, held, so that what moves is seen to be a planar, spherical or other simple mechanism.
//!
//! A freedom whose speed is 0 in every instantaneous motion takes no part in any: with it locked the null space of J is as
//! large as before. What then moves for certain moves in the whole mechanism, too, of which it is a part; and nothing moves
//! more than instantaneously. So the finite mobility of a pose is proven where it is that of the mechanism with such freedoms
//! locked: the spatial slider of a planar linkage that could turn about its guide, and does not.

use crate::closure::Closure;
use crate::geom::exact::ExactField;
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::JointType;
use crate::model::mechanism::Mechanism;

/// The mechanism with every freedom locked that rests in all instantaneous motions; none where there is none to lock.
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
    // A row of the reduced form with its pivot alone says that this freedom has speed 0.
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
