//! What every method, and the automatic choice, says of mechanisms of known figures.

use super::said::{AnswerCount, Said};
use super::sweep::RightTally;
use crate::accuracy::{AnswerVerdict, Truth};
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::auto::decide;
use crate::rank::method::registry;
use crate::rank::method::{MobilityMethod, NoAnswer};

/// What was said of some mechanisms that belong together, and the file of the last.
pub(super) struct Replies {
    /// Of each method, whether it is right about all; `None` where it does not apply to one.
    right: Vec<Option<bool>>,
    /// What the automatic choice says of the last, the worse of W and finite mobility.
    auto: Said,
    text: String,
}

impl Replies {
    /// Asks about mechanisms that belong together; none of no mechanism.
    pub(super) fn new(all: &[(Mechanism, Truth)], text: String) -> Option<Replies> {
        let of = |method: &&dyn MobilityMethod| {
            let mut right = true;
            for (m, truth) in all {
                let answer = method.answer(m, StateId::FREE);
                if matches!(&answer, Err(e) if !matches!(e, NoAnswer::Failed(_))) {
                    return None;
                }
                right &= AnswerVerdict::keeps_promise(&answer, *truth);
            }
            Some(right)
        };
        let (last, truth) = all.last()?;
        let found = decide(last, StateId::FREE).ok();
        let [w, finite] = Said::of_decision(found.as_ref(), (truth.instantaneous, truth.finite));
        Some(Replies {
            right: registry::ALL.iter().map(of).collect(),
            auto: w.max(finite),
            text,
        })
    }
}

/// A row for each method, empty as yet.
pub(super) fn rows() -> Vec<(String, Vec<RightTally>)> {
    let names = registry::ALL.iter().map(|m| m.name().to_owned());
    names.map(|n| (n, Vec::new())).collect()
}

/// Adds what was said at one value to the row of each method.
pub(super) fn add(rows: &mut [(String, Vec<RightTally>)], found: &[Replies]) {
    for (i, row) in rows.iter_mut().enumerate() {
        let mut tally = RightTally::default();
        for (at, asked) in found.iter().enumerate() {
            asked.right[i].into_iter().for_each(|ok| tally.add(at, ok));
        }
        row.1.push(tally);
    }
}

/// What the automatic choice said, counted.
pub(super) fn auto<'a>(found: impl IntoIterator<Item = &'a Replies>) -> AnswerCount {
    let mut count = AnswerCount::default();
    for asked in found {
        count.add(asked.auto, || asked.text.replace('\n', " "));
    }
    count
}
