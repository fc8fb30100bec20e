//! About how many variants there are, where a diagram is cut down to its limits.

use crate::search::answer::counts::count_total;
use crate::search::answer::estimate::Estimate;
use crate::search::answer::estimate::samples::SetSamples;
use crate::search::build::at_most::at_most;
use crate::search::build::orders::Orders;
use crate::search::build::self_stress::Wanted;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::{Diagram, Stop};
use crate::search::question::Question;
use num_bigint::BigUint;

/// Returns estimates of the numbers of determinate and of admissible variants if their diagrams are cut. They are made by samples of a
/// larger set that is counted. An entry is `None` if its diagram is whole, if a state is searched, or if redundant constraints are allowed
/// that not all variants have.
pub(super) fn estimate_counts(
    question: &Question,
    [determinate, admissible]: [&Diagram; 2],
    orders: &Orders,
    limits: &Limits,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> [Option<Estimate>; 2] {
    let seed = match question.conditions.estimate {
        Some(seed) if determinate.stop.combine_with(admissible.stop).is_cut() => seed,
        _ => return [None, None],
    };
    let estimate = |order: &[usize], wanted, diagram: &Diagram, possible: Option<&BigUint>| {
        if !diagram.stop.is_cut() || question.conditions.state.is_some() {
            return None;
        }
        let filter = matches!(wanted, Wanted::Admissible);
        let of = at_most(question, order, limits, wanted, cancelled)?;
        let samples = SetSamples::draw_pilot(question, &of, seed, filter, cancelled)?;
        let found = samples.estimate_count(cancelled)?;
        Some(found.clamp_to_bounds(&count_total(question, diagram, filter), possible))
    };
    let first = estimate(&orders.determinate, Wanted::Determinate, determinate, None);
    let possible = match &first {
        Some(e) => e.at_most.clone(),
        None => {
            (determinate.stop == Stop::Exhausted).then(|| count_total(question, determinate, false))
        }
    };
    let order = &orders.admissible;
    let second = estimate(order, Wanted::Admissible, admissible, possible.as_ref());
    [first, second]
}
