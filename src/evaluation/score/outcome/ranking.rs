//! The order of a pool of variants, why it is what it is, and whether a variant outside of the pool could win.

use crate::format::three_digits;
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::ranking::{Ranking, Term};
use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::load_cases::Gripped;
use crate::score::evaluation::terms::Scores;
use crate::search::answer::k_best::Assignment;
use crate::statics::reactions::Unsolved;
use num_bigint::BigUint;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::ops::ControlFlow;

/// Variants scored between two tests of the proof.
const BLOCK: usize = 4096;

/// A variant with its place in both orders.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranked {
    /// The variant.
    pub variant: Assignment,
    /// Its place by cost, from 1.
    pub by_cost: usize,
    /// Its scores.
    pub scores: Scores,
    /// The weighted sum.
    pub total: f64,
}

/// A ranked pool.
#[derive(Debug, Clone, PartialEq)]
pub struct RankedPool {
    /// The best, in order.
    pub list: Vec<Ranked>,
    /// The terms and their weights.
    pub ranking: Ranking,
    /// Most variants allowed in the pool.
    pub pool: usize,
    /// Variants of the pool scored.
    pub scored: usize,
    /// Number of scored variants outside of the pool, if these were searched with bounds.
    pub elsewhere: Option<usize>,
    /// Those whose loads have no equilibrium.
    pub unheld: usize,
    /// Those beyond a limit.
    pub limited: usize,
    /// Those that redundant constraints leave open, scored by reactions of minimum norm.
    pub open: usize,
    /// Whether no variant outside of the pool can be among the list.
    pub proven: bool,
    /// Why it is proven, or is not.
    pub proof: &'static str,
    /// Whether scoring was cancelled.
    pub interrupted: bool,
    /// The gap to a proof, if the order is a weighted sum with cost.
    pub missing: Option<Missing>,
    /// The cheapest that could be scored, as a measure for the others.
    pub cheapest: Option<Ranked>,
    /// Number of examined poses.
    pub poses: usize,
    /// The parts whose contact forces are among the loads.
    pub gripped: Vec<Gripped>,
    /// Whether the stroke ended early.
    pub stroke_stopped: Option<f64>,
}

/// The gap to a proof that a pool holds the best.
#[derive(Debug, Clone, PartialEq)]
pub struct Missing {
    /// No variant that was not scored has a lower sum.
    pub least: f64,
    /// The sum of the last of the list.
    pub last: f64,
    /// Variants of this cost and dearer ones `[1/1000]` cannot be among the list.
    pub settled_at: i64,
    /// Variants cheaper than that, with those scored; `None` where they were not counted.
    pub cheaper: Option<BigUint>,
}

impl Missing {
    /// Returns the cost from which on no variant can be in the list.
    pub fn settled_at_cost(&self) -> f64 {
        self.settled_at as f64 / 1000.0
    }
}

/// Compares two variants by rank. The cheaper one comes first if their sums are equal.
pub fn compare_ranked(a: &Ranked, b: &Ranked) -> Ordering {
    let by_sum = a.total.total_cmp(&b.total);
    by_sum.then(a.by_cost.cmp(&b.by_cost))
}

/// Computes the scores of a pool in parallel, in its order. They are the same for any number of threads.
fn score_all(evaluator: &Evaluator<'_>, pool: &[Assignment]) -> Vec<Result<Scores, Unsolved>> {
    pool.par_iter()
        .map_init(Scratch::default, |scratch, v| {
            evaluator.score_variant(v, scratch)
        })
        .collect()
}

/// Ranks variants given one by one in order of cost, and keeps the best: no more of them are held than a block.
#[derive(Debug)]
pub struct Ranker<'e, 's> {
    evaluator: &'e Evaluator<'s>,
    /// Least weighted sum of the terms but cost.
    floor: f64,
    /// Cost of the last variant scored, in thousandths.
    reached: i64,
    top: usize,
    block: Vec<Assignment>,
    kept: Vec<Ranked>,
    out: RankedPool,
}

impl<'e, 's> Ranker<'e, 's> {
    /// Creates the ranking of a pool of at most `limit` variants, of which the best `top` are wanted.
    pub fn new(evaluator: &'e Evaluator<'s>, ranking: &Ranking, limit: usize, top: usize) -> Self {
        Ranker {
            evaluator,
            floor: evaluator.least_terms().weighted_sum(ranking),
            reached: 0,
            top,
            block: Vec::new(),
            kept: Vec::new(),
            out: RankedPool {
                list: Vec::new(),
                ranking: ranking.clone(),
                pool: limit,
                scored: 0,
                elsewhere: None,
                unheld: 0,
                limited: 0,
                open: 0,
                proven: false,
                proof: "dearer variants were not scored",
                interrupted: false,
                missing: None,
                cheapest: None,
                poses: evaluator.cases.list.len(),
                gripped: evaluator.cases.gripped.clone(),
                stroke_stopped: evaluator.cases.stopped,
            },
        }
    }

    /// Takes the next variant; breaks once no later one can be among the best, or the pool is full.
    pub fn take_variant(&mut self, variant: Assignment) -> ControlFlow<()> {
        if self.out.proven || self.out.scored + self.block.len() >= self.out.pool {
            return ControlFlow::Break(());
        }
        self.block.push(variant);
        if self.block.len() == BLOCK {
            self.score_block();
        }
        if self.out.proven {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    /// Computes the scores of the block in parallel, and keeps the variants that may be among the best.
    fn score_block(&mut self) {
        let block = std::mem::take(&mut self.block);
        let ranking = &self.out.ranking;
        for (variant, scores) in block.iter().zip(score_all(self.evaluator, &block)) {
            self.out.scored += 1;
            let Ok(scores) = scores else {
                self.out.unheld += 1;
                continue;
            };
            self.out.open += usize::from(scores.minimum_norm);
            let ranked = Ranked {
                variant: variant.clone(),
                by_cost: self.out.scored,
                scores,
                total: scores.weighted_sum(ranking),
            };
            if self.out.cheapest.is_none() {
                self.out.cheapest = Some(ranked.clone());
            }
            if scores.within_limits(ranking) {
                self.kept.push(ranked);
            } else {
                self.out.limited += 1;
            }
        }
        let top = self.top.max(1);
        self.kept.sort_by(compare_ranked);
        if let Some(last) = block.last() {
            self.reached = self.evaluator.search.steps.cost_in_milli(last.key.cost());
        }
        let least = self.least_later();
        let last = self.kept.get(top - 1);
        if least
            .zip(last)
            .is_some_and(|(least, last)| least >= last.total)
        {
            let proof =
                "cost puts every later variant behind, with the least the other terms can be";
            (self.out.proven, self.out.proof) = (true, proof);
        }
        // What is behind the best so far stays behind.
        self.kept.truncate(top);
    }

    /// Returns the weight of cost; `None` if cost does not count.
    fn cost_weight(&self) -> Option<f64> {
        let mut terms = self.out.ranking.terms.iter();
        let weight = terms.find(|(t, _)| *t == Term::Cost)?.1;
        (weight > 0.0).then_some(weight)
    }

    /// Returns the least sum of every variant that was not scored; `None` if cost does not count.
    fn least_later(&self) -> Option<f64> {
        Some(self.cost_weight()? * (self.reached as f64 / 1000.0) + self.floor)
    }

    /// Returns the gap to a proof.
    fn missing_to_proof(&self) -> Option<Missing> {
        let last = self.kept.get(self.top.max(1) - 1)?.total;
        let settled_at = (1000.0 * (last - self.floor) / self.cost_weight()?).ceil() as i64;
        Some(Missing {
            least: self.least_later()?,
            last,
            settled_at,
            cheaper: None,
        })
    }

    /// Returns the ranked pool. `all` means that every admissible variant was given.
    ///
    /// # Complexity
    /// One scoring a variant, in parallel, and a sort a block.
    pub fn finish_pool(mut self, all: bool) -> RankedPool {
        if !self.block.is_empty() {
            self.score_block();
        }
        if all && !self.out.proven {
            (self.out.proven, self.out.proof) = (true, "every admissible variant was scored");
        }
        if !self.out.proven {
            self.out.missing = self.missing_to_proof();
        }
        self.kept.truncate(self.top);
        self.out.list = self.kept;
        self.out
    }
}

/// Returns an ordinal number: 1st, 2nd, 3rd, 4th.
fn ordinal(n: usize) -> String {
    let end = match (n % 100, n % 10) {
        (11..=13, _) => "th",
        (_, 1) => "st",
        (_, 2) => "nd",
        (_, 3) => "rd",
        _ => "th",
    };
    format!("{n}{end}")
}

/// Returns the change of a term in words.
fn describe_change(m: &Mechanism, term: Term, from: &Scores, to: &Scores) -> String {
    let joint = |j: JointId| m.joints.get(j.index()).map_or("", |j| j.id.as_str());
    match term {
        Term::PeakForce | Term::PeakMoment => {
            let (what, unit, to, from) = match term {
                Term::PeakForce => ("force", "N", to.force, from.force),
                _ => ("moment", "N·m", to.moment, from.moment),
            };
            format!(
                "peak {what} {} {unit} ({} of capacity, joint {}) instead of {} {unit} ({}, joint {})",
                three_digits(to.value),
                three_digits(to.utilisation),
                joint(to.joint),
                three_digits(from.value),
                three_digits(from.utilisation),
                joint(from.joint)
            )
        }
        Term::OutputError => format!(
            "output error {} mm instead of {} mm",
            three_digits(1e3 * to.output_error),
            three_digits(1e3 * from.output_error)
        ),
        _ => format!(
            "{} {} instead of {}",
            term.name(),
            three_digits(to.term_value(term)),
            three_digits(from.term_value(term))
        ),
    }
}

impl RankedPool {
    /// Returns the reason why a variant is not in its place by cost: the term that most favours it over the cheapest. `None`
    /// if its place is that by cost.
    pub fn place_reason(&self, m: &Mechanism, rank: usize) -> Option<String> {
        let (here, cheapest) = (
            self.list.get(rank.checked_sub(1)?)?,
            self.cheapest.as_ref()?,
        );
        if here.by_cost == rank || here.by_cost == cheapest.by_cost {
            return None;
        }
        let gain = |(t, weight): &(Term, f64)| {
            weight * (cheapest.scores.term_loss(*t) - here.scores.term_loss(*t))
        };
        let terms = self.ranking.terms.iter().filter(|tw| gain(tw) > 0.0);
        let term = terms.max_by(|a, b| gain(a).total_cmp(&gain(b)))?;
        Some(format!(
            "rank {rank} was {} by cost: {}",
            ordinal(here.by_cost),
            describe_change(m, term.0, &cheapest.scores, &here.scores)
        ))
    }
}
