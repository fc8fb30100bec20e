//! The `[ranking]` and `[joint_types]` tables.

use crate::file::schema::{JointTypeEntry, LimitEntry, RankingEntry, TermEntry};
use crate::model::mechanism::Mechanism;
use crate::model::ranking::{ClearanceSum, Ranking};
use std::collections::BTreeMap;

/// The entry of a ranking.
pub(crate) fn ranking(m: &Mechanism, r: &Ranking) -> RankingEntry {
    let term = |&(term, weight): &(crate::model::ranking::Term, f64)| TermEntry {
        term: term.name().to_owned(),
        weight: Some(weight),
    };
    let limits = r.limits.iter().map(|l| LimitEntry {
        term: l.term.name().to_owned(),
        min: l.min,
        max: l.max,
    });
    RankingEntry {
        order: Some(r.order.name().to_owned()),
        terms: r.terms.iter().map(term).collect(),
        limits: limits.collect(),
        clearance: (r.clearance == ClearanceSum::Rms).then(|| "rms".to_owned()),
        states: r.states.iter().map(|&s| m.states[s].clone()).collect(),
    }
}

/// What the mechanism says its joint types bear; what they cost stands under `[search.costs]`.
pub(crate) fn joint_types(m: &Mechanism) -> BTreeMap<String, JointTypeEntry> {
    let each = m.joint_types.iter().map(|t| {
        let entry = JointTypeEntry {
            cost: None,
            capacity_force: t.capacity_force,
            capacity_moment: t.capacity_moment,
            clearance: t.clearance,
        };
        (t.name.clone(), entry)
    });
    each.collect()
}
