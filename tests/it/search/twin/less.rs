//! Which variants do with less than others.

use crate::common::*;
use crate::fuzz::readers::slow_search::{Q, allowed_twists, reduce};

/// Whether what one variant puts at each joint moves in part of the ways that another's does, and less at one joint: nothing
/// where it moves in others.
pub(crate) fn does_with_less(
    m: &Mechanism,
    less: &[(usize, Option<usize>)],
    more: &[(usize, Option<usize>)],
) -> bool {
    let motion = |j: usize, (option, unloading): (usize, Option<usize>)| {
        let joint = &m.joints[JointId::new(j)];
        let own = &joint.options[option];
        let mut out = allowed_twists(&m.mode, &own.frame, &own.joint_type);
        if let Some(u) = unloading {
            let u = &joint.unloading[u];
            out.extend(allowed_twists(&m.mode, &u.frame, &u.joint_type));
        }
        out
    };
    let rank = |rows: Vec<Vec<Q>>| reduce(rows).len();
    let mut smaller = false;
    for (j, (&a, &b)) in less.iter().zip(more).enumerate() {
        let (a, b) = (motion(j, a), motion(j, b));
        let (own, whole) = (rank(a.clone()), rank(b.clone()));
        if rank([a, b].concat()) != whole {
            return false;
        }
        smaller |= own < whole;
    }
    smaller
}
