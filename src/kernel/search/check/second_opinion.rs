//! A second opinion on the counts of a search whose coordinates were rounded: the ranks that exact arithmetic counts on are
//! compared with those that singular values of the geometry in the file show, at the tolerance of its digits.
//!
//! The check covers the present mechanism, the listed variants, and samples of the admissible and of all variants. Counts must also obey a
//! law: options that only add freedoms remove no mobility. After one contradiction, no count is called exact.

use crate::geom::exact::ExactError;
use crate::rank::method::to_i64;
use crate::search::answer::counts::Counts;
use crate::search::answer::k_best::Assignment;
use crate::search::at_tolerance::{any_choices, choices_of_number};
use crate::search::check::brute::Matrices;
use crate::search::check::brute_float::{Approximate, RankedRows};
use crate::search::question::Question;
use crate::search::question::conditions::Written;
use crate::search::question::rounded_rank::{Digits, RankRange};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use num_bigint::BigUint;
use num_traits::{ToPrimitive, Zero};
use rayon::prelude::*;
use serde::Serialize;

/// Minimum and maximum number of variants drawn of each kind. A missed relation of the geometry may matter for few variants only.
const DRAWN: [usize; 2] = [64, 4096];
/// Products that half a second of one processor allows in decompositions, about.
const PRODUCTS: usize = 10_000_000;

/// How singular values went with the ranks of some variants.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Asked {
    /// Variants asked about.
    pub asked: usize,
    /// Those of which the digits do not decide a rank, and allow the exact one.
    pub undecided: usize,
    /// Those whose exact ranks the singular values contradict.
    pub contradicted: usize,
}

/// A variant whose exact ranks singular values contradict.
#[derive(Debug, Clone, PartialEq)]
pub struct Contradiction {
    /// The variant.
    pub choices: Vec<usize>,
    /// (W, σ) by exact arithmetic.
    pub exact: (i64, i64),
    /// The least (W, σ) that singular values allow, and the most.
    pub numeric: [(i64, i64); 2],
    /// Whether it is not these that differ, but how the kept links or the searched state move.
    pub elsewhere: bool,
    /// The smallest singular value kept, and the largest dropped, over the largest.
    pub gap: (f64, f64),
}

/// Variants that have less mobility than the mechanism they are made of by adding freedoms.
#[derive(Debug, Clone, PartialEq)]
pub struct BelowPresent {
    /// How many.
    pub variants: BigUint,
    /// The least mobility of the present mechanism.
    pub present: i64,
}

/// What singular values say of the counts.
#[derive(Debug, Clone, PartialEq)]
pub struct SecondOpinion {
    /// The accuracy of the digits.
    pub digits: Digits,
    /// The present mechanism and the listed variants.
    pub listed: Asked,
    /// A sample of the admissible ones.
    pub admissible: Asked,
    /// A sample of all; of a small space all.
    pub all: Asked,
    /// The narrowest gap of a rank that is decided: the smallest value kept over the largest dropped.
    pub narrowest: f64,
    /// The first that is contradicted.
    pub contradiction: Option<Contradiction>,
    /// What breaks the law.
    pub below_present: Option<BelowPresent>,
    /// The least and the most (determinate, admissible) of scenes that the digits do not rule out, where they differ.
    pub scenes: Option<[(BigUint, BigUint); 2]>,
}

impl SecondOpinion {
    /// Returns true if nothing contradicts the counts.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.contradiction.is_none() && self.below_present.is_none()
    }

    /// Returns the number of examined variants that are not decided.
    #[must_use]
    pub fn count_undecided(&self) -> usize {
        self.listed.undecided + self.admissible.undecided + self.all.undecided
    }

    /// Returns true if the counts may be called exact. Nothing contradicts them, and the digits decide the mechanism and
    /// every examined variant.
    #[must_use]
    pub fn confirms(&self) -> bool {
        let decided = !self.digits.undecided && self.count_undecided() == 0;
        self.agrees() && decided && self.scenes.is_none()
    }
}

/// The expected figures of a variant: redundant constraints of the free and of the searched state, and the dimension of the kept links'
/// motion.
struct Expected {
    choices: Vec<usize>,
    internal: u32,
    external: i32,
    motion: usize,
}

/// The result of one variant's singular values.
struct Said {
    undecided: bool,
    narrowest: f64,
    against: Option<Contradiction>,
}

/// Returns the number of variants of each kind that are checked. Small mechanisms have more, so that the check takes about half a second
/// except for the largest.
#[must_use]
pub fn sample_size(question: &Question) -> usize {
    let rows = usize::try_from(question.rows).unwrap_or(0).max(1);
    // There are about as many columns.
    let each = rows.saturating_pow(3);
    (PRODUCTS / each).clamp(DRAWN[0], DRAWN[1])
}

/// Draws some of all variants from `seed`. Returns all if there are few.
fn draw_variants(question: &Question, seed: u64) -> Vec<Vec<usize>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let most = sample_size(question);
    match question.size().to_u32().filter(|n| *n as usize <= most) {
        Some(n) => (0..n)
            .map(|number| choices_of_number(question, number))
            .collect(),
        None => (0..most)
            .map(|_| any_choices(question, &mut random))
            .collect(),
    }
}

/// Tests variants by singular values of a geometry: those `listed`, some that `admissible` gives, and some of all variants
/// drawn from `seed`. Also tests whether the counts keep the law.
///
/// # Errors
/// Returns an error if a coordinate has no value.
///
/// # Complexity
/// Two or three decompositions per variant, in parallel.
pub fn second_opinion(
    question: &Question,
    written: &Written,
    listed: Vec<Assignment>,
    admissible: Vec<Assignment>,
    determinate: &Counts,
    seed: u64,
) -> Result<SecondOpinion, ExactError> {
    let digits = written.digits;
    let of_file = Approximate::new(question, &written.mechanism, true)?;
    let exact = Matrices::new(question);
    let looked = |choices: Vec<usize>| {
        let seen = exact.look_at(&choices);
        Expected {
            choices,
            internal: seen.internal,
            external: seen.external,
            motion: seen.motion,
        }
    };
    let counted = |v: Assignment| Expected {
        choices: v.choices,
        internal: v.key.internal(),
        external: v.key.external(),
        motion: question.present_motion(),
    };
    let nothing = vec![0; question.space.variables.len()];
    let mut first = vec![looked(nothing.clone())];
    first.extend(listed.into_iter().map(counted));
    let kinds = [
        first,
        admissible.into_iter().map(counted).collect(),
        draw_variants(question, seed)
            .into_par_iter()
            .map(looked)
            .collect(),
    ];
    let mut narrowest = f64::INFINITY;
    let mut contradiction = None;
    let asked = kinds.map(|all| {
        let said: Vec<Said> = all
            .into_par_iter()
            .filter_map(|e| compare_variant(question, &of_file, e, digits))
            .collect();
        let asked = Asked {
            asked: said.len(),
            undecided: said.iter().filter(|s| s.undecided).count(),
            contradicted: said.iter().filter(|s| s.against.is_some()).count(),
        };
        for s in said {
            narrowest = narrowest.min(s.narrowest);
            if contradiction.is_none() {
                contradiction = s.against;
            }
        }
        asked
    });
    let present = of_file.rank_range(&nothing, RankedRows::Free, digits);
    let below_present = present
        .filter(|_| written.only_adds)
        .and_then(|p| less_than_present(question, p, determinate));
    let [listed, admissible, all] = asked;
    Ok(SecondOpinion {
        digits,
        listed,
        admissible,
        all,
        narrowest,
        contradiction,
        below_present,
        scenes: None,
    })
}

/// Returns the number of freedoms of a variant in the free state.
fn count_freedoms(question: &Question, choices: &[usize]) -> i64 {
    let keys = question.steps.keys.iter().zip(choices);
    keys.map(|(keys, &c)| i64::from(keys[c].freedoms())).sum()
}

/// Returns the variants that break a law: options that only add freedoms take no mobility away.
fn less_than_present(
    question: &Question,
    present: RankRange,
    counts: &Counts,
) -> Option<BelowPresent> {
    let nothing = vec![0; question.space.variables.len()];
    let had = count_freedoms(question, &nothing) - to_i64(present.most);
    let fewer = counts.by_mobility.range(..had).map(|(_, n)| n);
    let variants: BigUint = fewer.sum();
    (!variants.is_zero()).then_some(BelowPresent {
        variants,
        present: had,
    })
}

/// Returns the finding of singular values on a variant. `None` if they do not converge.
fn compare_variant(
    question: &Question,
    of_file: &Approximate,
    e: Expected,
    digits: Digits,
) -> Option<Said> {
    let [rows, _, state_rows] = of_file.row_counts();
    let free = of_file.rank_range(&e.choices, RankedRows::Free, digits)?;
    let rank = rows.saturating_sub(e.internal as usize);
    let mut all = vec![(free, rank)];
    if question.conditions.keep_output {
        let kept = of_file.rank_range(&e.choices, RankedRows::WithKept, digits)?;
        all.push((kept, rank + e.motion));
    }
    let in_state = usize::try_from(i64::from(e.external) + i64::from(e.internal));
    if let (Some(_), Ok(redundant)) = (question.conditions.state, in_state) {
        let state = of_file.rank_range(&e.choices, RankedRows::State, digits)?;
        all.push((state, state_rows.saturating_sub(redundant)));
    }
    let decided = all.iter().filter(|(r, _)| r.is_decided());
    let narrowest = decided
        .map(|(r, _)| r.kept / r.dropped)
        .fold(f64::INFINITY, f64::min);
    let against = all
        .iter()
        .find(|(r, rank)| !r.allows_rank(*rank))
        .map(|(r, _)| {
            let f = count_freedoms(question, &e.choices);
            let figures = |rank: usize| (f - to_i64(rank), to_i64(rows) - to_i64(rank));
            Contradiction {
                exact: figures(rank),
                numeric: [figures(free.most), figures(free.least)],
                elsewhere: free.allows_rank(rank),
                gap: (r.kept, r.dropped),
                choices: e.choices.clone(),
            }
        });
    Some(Said {
        undecided: against.is_none() && all.iter().any(|(r, _)| !r.is_decided()),
        narrowest,
        against,
    })
}
