//! A search by singular values, for mechanisms that exact arithmetic does not have as they are meant.
//!
//! Variants are judged one by one: all of a small space; of a larger one a sample drawn at random, and the cheapest in order.
//! What the digits do not decide is counted as doubtful, so that each count is between those that are sure and these with the
//! doubtful ones. Nothing of it is exact: a rank at a tolerance is likely, not proven.

mod answer;
mod found;
mod in_state;
mod judge;
mod sampled;

pub use found::{AtTolerance, Bracket, Sampled, Share};
pub(in crate::search) use found::{any_choices, choices};

use crate::geom::exact::ExactError;
use crate::search::answer::keys::Key;
use crate::search::diagram::Stop;
use crate::search::question::Question;
use crate::search::question::rounded_rank::Digits;
use found::{BLOCK, Met, VariantList, order};
use judge::{Judge, Standing};
use num_traits::ToPrimitive;
use rayon::prelude::*;

/// Spaces of no more variants than this are looked at whole.
pub const WHOLE: u32 = 50_000;

/// Searches by singular values. Of spaces too large to be looked at whole `list` of the cheapest are looked for, and a
/// sample is drawn from `seed`.
///
/// # Errors
/// Where a coordinate has no value.
///
/// # Complexity
/// Two or three decompositions of a matrix of 6k rows a variant, in parallel, [`WHOLE`] variants at most; memory is some
/// 20 bytes for each admissible one.
pub(crate) fn at_tolerance(
    question: &mut Question,
    digits: Digits,
    list: usize,
    seed: u64,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<AtTolerance, ExactError> {
    let judge = Judge::new(question, digits)?;
    let size = question.size();
    let found = match size.to_u32().filter(|n| *n <= WHOLE) {
        Some(n) => whole(question, &judge, n, cancelled),
        None => sampled::search(question, &judge, list, seed, cancelled),
    };
    let motion = judge.motion();
    drop(judge);
    question.present = Some(motion);
    Ok(found)
}

fn whole(
    question: &Question,
    judge: &Judge<'_>,
    size: u32,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> AtTolerance {
    let blocks = (size as usize).div_ceil(BLOCK);
    let block = |b: usize| {
        let (mut met, mut list) = (Met::default(), Vec::new());
        let to = ((b + 1) * BLOCK).min(size as usize);
        for number in (b * BLOCK..to).filter_map(|n| u32::try_from(n).ok()) {
            if cancelled() {
                break;
            }
            let judged = judge.judge(&choices(question, number));
            if let Standing::Sure(key) = judged.admissible {
                list.push((key, number));
            }
            met.add(&judged);
        }
        (met, list)
    };
    let together = |(mut met, mut list): (Met, Vec<_>), (more, others): (Met, Vec<_>)| {
        met.merge(more);
        list.extend(others);
        (met, list)
    };
    let all = (0..blocks).into_par_iter().map(block);
    let (met, mut list): (Met, Vec<(Key, u32)>) = all.reduce(Default::default, together);
    list.sort_unstable_by_key(|&(key, n)| (order(question, key), n));
    let [determinate, admissible] = met.brackets(question, &size.into());
    AtTolerance {
        digits: judge.digits(),
        looked: met.looked,
        determinate,
        admissible,
        by_cost: met.by_cost(question),
        sampled: None,
        stop: if met.looked == u64::from(size) {
            Stop::Exhausted
        } else {
            Stop::Interrupted
        },
        list: VariantList::Numbers(list),
    }
}
