//! A search by singular values, for mechanisms that exact arithmetic does not have as they are meant.
//!
//! Variants are judged one by one: all of a small space; of a larger one a sample drawn at random, and the cheapest in order.
//! Variants that the digits do not decide are counted as doubtful, so that each count is between those that are sure and these with the
//! doubtful ones. No count is exact: a rank at a tolerance is likely, not proven.

mod found;
mod in_state;
mod judge;

pub use found::{AtTolerance, Bracket, Sampled, Share};
pub(in crate::search) use found::{any_choices, choices_of_number};

use crate::geom::exact::ExactError;
use crate::search::answer::k_best::{Assignment, Cheapest, Reach, enter_all};
use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::diagram::{Diagram, Layer, ShouldCancel, Stop};
use crate::search::question::Question;
use crate::search::question::rounded_rank::Digits;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use found::Met;
use in_state::Answer;
use judge::{Judge, Judged};
use num_traits::ToPrimitive;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Spaces of at most this many variants are examined completely.
pub const WHOLE: u32 = 50_000;
/// Variants drawn of a larger one.
const DRAWN: usize = 20_000;
/// Maximum number of variants of a larger space that are examined in order of cost.
const IN_ORDER: usize = 20_000;
/// Number of variants that are examined before it is checked whether there are enough.
const AT_ONCE: usize = 2048;
/// Number of variants that a thread examines between two checks for cancellation.
const BLOCK: usize = 64;

impl Question {
    /// Tests variants by singular values, if exact arithmetic does not have the intended mechanism. If there are too many to
    /// test each, it tests the `list` cheapest and a sample drawn from `seed`.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    ///
    /// # Complexity
    /// Two or three decompositions per variant. They run in parallel, for at most [`WHOLE`] variants. Their matrices have 6k rows.
    pub fn at_tolerance(
        &mut self,
        digits: Digits,
        list: usize,
        seed: u64,
        cancelled: ShouldCancel<'_>,
    ) -> Result<AtTolerance, ExactError> {
        let judge = Judge::new(self, digits)?;
        let looking = Looking {
            question: self,
            judge: &judge,
            cancelled,
        };
        let found = looking.search_variants(list, seed);
        self.present = Some(judge.motion_dimension());
        Ok(found)
    }
}

/// A question whose variants are examined.
struct Looking<'a> {
    question: &'a Question,
    judge: &'a Judge<'a>,
    cancelled: ShouldCancel<'a>,
}

impl Looking<'_> {
    fn search_variants(&self, list: usize, seed: u64) -> AtTolerance {
        let question = self.question;
        let size = question.size();
        let whole = size.to_usize().filter(|n| *n <= WHOLE as usize);
        let mut met = Met::default();
        let (list, next_cost) = match whole {
            Some(all) => self.in_order(usize::MAX, all, &mut met),
            None => self.in_order(list, IN_ORDER, &mut met),
        };
        let looked = usize::try_from(met.looked).unwrap_or(usize::MAX);
        let sampled = whole.is_none().then(|| {
            let (drawn, [determinate, admissible]) = self.judge_sample(seed, next_cost, &mut met);
            Sampled {
                drawn,
                seed,
                determinate,
                admissible,
                in_order: looked,
                all_below: next_cost.map(|next| question.steps.cost_in_milli(next)),
            }
        });
        let stop = match whole {
            Some(all) if all == looked => Stop::Exhausted,
            None if !(self.cancelled)() => Stop::NodeBudget,
            _ => Stop::Interrupted,
        };
        let [determinate, admissible] = met.count_brackets(question, &size);
        AtTolerance {
            digits: self.judge.digits(),
            looked: met.looked,
            determinate,
            admissible,
            by_cost: whole.map(|_| met.by_cost(question)).unwrap_or_default(),
            sampled,
            stop,
            list,
        }
    }

    /// Judges variants, as many as it comes to before it is cancelled.
    fn judge_all(&self, all: Vec<Vec<usize>>) -> Vec<(Vec<usize>, Judged)> {
        let one = |choices: Vec<usize>| {
            (!(self.cancelled)()).then(|| {
                let judged = self.judge.judge_variant(&choices);
                (choices, judged)
            })
        };
        let all = all.into_par_iter().with_min_len(BLOCK).map(one);
        all.collect::<Vec<_>>().into_iter().flatten().collect()
    }

    /// Examines variants in order of cost until `wanted` are certainly admissible, or `most` are examined. Returns the certain ones, and
    /// the cost in steps of the first variant that was not examined.
    fn in_order(
        &self,
        wanted: usize,
        most: usize,
        met: &mut Met,
    ) -> (Vec<Assignment>, Option<u64>) {
        let question = self.question;
        let mut list: Vec<Assignment> = Vec::new();
        let diagram = diagram_of_all(question);
        // None, if the memory does not suffice for the order.
        let (steps, reach) = (
            &question.steps,
            Reach::Variants(most + 2 * AT_ONCE, u64::MAX),
        );
        let all = Cheapest::new(question, &diagram, steps, reach, &|_| true, enter_all());
        let mut all = all.peekable();
        while list.len() < wanted && (met.looked as usize) < most && !(self.cancelled)() {
            let block = all.by_ref().take(AT_ONCE).map(|v| v.choices).collect();
            for (choices, judged) in self.judge_all(block) {
                met.add_judged(&judged);
                if judged.admissible == Answer::Yes {
                    let key = judged.key;
                    list.push(Assignment { choices, key });
                }
            }
            if all.peek().is_none() {
                break;
            }
        }
        let order = |v: &Assignment| (question.sort_rank(v.key), v.choices.clone());
        list.sort_by_cached_key(order);
        (list, all.peek().map(|v| v.key.cost()))
    }

    /// Examines a sample of all variants. Returns its size, and the shares of determinate and admissible variants in it. Sampled variants
    /// that cost more than those examined in order are counted.
    fn judge_sample(
        &self,
        seed: u64,
        next_cost: Option<u64>,
        met: &mut Met,
    ) -> (usize, [Share; 2]) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let one = |_| any_choices(self.question, &mut random);
        let drawn = self.judge_all((0..DRAWN).map(one).collect());
        let mut seen = BTreeSet::new();
        let mut shares = [[0usize; 2]; 2];
        for (choices, judged) in &drawn {
            for (answer, [sure, may]) in [judged.determinate, judged.admissible]
                .iter()
                .zip(&mut shares)
            {
                *sure += usize::from(*answer == Answer::Yes);
                *may += usize::from(*answer != Answer::No);
            }
            let chosen = self.question.steps.keys.iter().zip(choices);
            let cost = chosen.map(|(keys, &c)| keys[c].cost()).sum::<u64>();
            // Those below were counted already.
            if next_cost.is_none_or(|next| cost > next) && seen.insert(choices) {
                met.add_judged(judged);
            }
        }
        let shares = shares.map(|[sure, may]| Share::from_sample(sure, may, drawn.len()));
        (drawn.len(), shares)
    }
}

/// Returns the diagram of every choice.
fn diagram_of_all(question: &Question) -> Diagram {
    let layer = |(variable, keys): (usize, &Vec<_>)| Layer {
        variable,
        nodes: 1,
        choices: keys.len(),
        edges: vec![0; keys.len()],
    };
    let layers = question.steps.keys.iter().enumerate().map(layer);
    Diagram::from_layers(layers.collect(), vec![Redundancy::default()])
}
