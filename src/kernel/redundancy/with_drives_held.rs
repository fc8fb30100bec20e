//! Self-stresses while drives hold their freedoms, in exact geometry: the singular values that reactions come from take what is
//! nearly dependent for dependent.

use crate::closure::matrix::{Closure, Column};
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism, Mode, StateId};
use crate::model::rounded::looks_rounded;
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;

/// Self-stresses of a state in the pose of the file, with the freedoms that drives hold, by one prime; `None` for mechanisms of
/// a plane, whose equations are others, and where coordinates look rounded, so that they do not say.
///
/// # Complexity
/// That of [`modular::rank`].
#[must_use]
pub fn exact_self_stresses(
    m: &Mechanism,
    state: StateId,
    drives: &[(JointId, Freedom)],
) -> Option<usize> {
    if matches!(m.mode, Mode::Planar { .. }) || looks_rounded(m).is_some() {
        return None;
    }
    let exact = field_of(m, state, 0).ok()?;
    let mut closure = Closure::new(&exact, m, state).ok()?;
    let held = |c: &Column<Residue>| drives.contains(&(c.joint, c.freedom));
    // Held freedoms stay where they are, as columns of nothing: the rows of couplings know them by their places.
    for (i, column) in closure
        .columns
        .iter_mut()
        .enumerate()
        .filter(|(_, c)| held(c))
    {
        column.twist.fill(0);
        let entries = closure.couplings.iter_mut().flat_map(|q| &mut q.entries);
        entries.filter(|(c, _)| *c == i).for_each(|(_, x)| *x = 0);
    }
    Some(closure.rows() - modular::rank(&exact, &closure))
}
