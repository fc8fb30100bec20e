//! The order of a pool of variants, why it is what it is, and whether a variant outside of the pool could win.

use crate::format::three_digits;
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::ranking::{Order, Ranking, Term};
use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::load_cases::Gripped;
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::pareto::fronts;
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
    /// The weighted sum, where that is the order.
    pub total: Option<f64>,
    /// Its front from 1, where the order is Pareto's.
    pub front: Option<usize>,
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

/// Compares two variants by rank. The cheaper one comes first if the order does not decide.
pub fn compare_ranked(ranking: &Ranking, a: &Ranked, b: &Ranked) -> Ordering {
    let by_order = match ranking.order {
        Order::Weighted => a
            .scores
            .weighted_sum(ranking)
            .total_cmp(&b.scores.weighted_sum(ranking)),
        Order::Lexicographic => ranking
            .terms
            .iter()
            .map(|(t, _)| a.scores.term_loss(*t).total_cmp(&b.scores.term_loss(*t)))
            .find(|o| o.is_ne())
            .unwrap_or(Ordering::Equal),
        Order::Pareto => a
            .front
            .unwrap_or(usize::MAX)
            .cmp(&b.front.unwrap_or(usize::MAX)),
    };
    by_order.then(a.by_cost.cmp(&b.by_cost))
}

/// Returns the proof that no variant of at least this cost, with the other terms at least `floor`, can precede the last of
/// `list`. `None` if one could.
fn settling_proof(
    ranking: &Ranking,
    list: &[Ranked],
    least_milli: i64,
    floor: f64,
) -> Option<&'static str> {
    let last = list.last()?;
    let least = least_milli as f64 / 1000.0;
    match ranking.order {
        Order::Weighted => {
            let weight = ranking.terms.iter().find(|(t, _)| *t == Term::Cost)?.1;
            let behind = weight * least + floor >= last.scores.weighted_sum(ranking);
            (weight > 0.0 && behind).then_some(
                "cost puts every later variant behind, with the least the other terms can be",
            )
        }
        Order::Lexicographic => {
            let (first, _) = ranking.terms.first()?;
            (*first == Term::Cost && least > last.scores.term_value(Term::Cost))
                .then_some("cost comes first and every later variant costs more")
        }
        Order::Pareto => None,
    }
}

/// Computes the scores of a pool in parallel, in its order. They are the same for any number of threads.
fn score_all(evaluator: &Evaluator<'_>, pool: &[Assignment]) -> Vec<Result<Scores, Unsolved>> {
    pool.par_iter()
        .map_init(Scratch::default, |scratch, v| {
            evaluator.score_variant(v, scratch)
        })
        .collect()
}

/// Ranks variants given one by one in order of cost, and keeps the best: no more of them are held than a block, and in
/// Pareto's order all.
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
        let floor = match ranking.order {
            Order::Weighted => evaluator.least_terms().weighted_sum(ranking),
            Order::Lexicographic | Order::Pareto => 0.0,
        };
        Ranker {
            evaluator,
            floor,
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
                total: (ranking.order == Order::Weighted).then(|| scores.weighted_sum(ranking)),
                front: None,
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
        if ranking.order == Order::Pareto {
            return;
        }
        let top = self.top.max(1);
        self.kept.sort_by(|a, b| compare_ranked(ranking, a, b));
        if let Some(last) = block.last() {
            self.reached = self.evaluator.search.steps.cost_in_milli(last.key.cost());
        }
        if self.kept.len() >= top
            && let Some(proof) =
                settling_proof(ranking, &self.kept[..top], self.reached, self.floor)
        {
            (self.out.proven, self.out.proof) = (true, proof);
        }
        // What is behind the best so far stays behind.
        self.kept.truncate(top);
    }

    /// Returns the gap to a proof.
    fn missing_to_proof(&self) -> Option<Missing> {
        let ranking = &self.out.ranking;
        let weight = ranking.terms.iter().find(|(t, _)| *t == Term::Cost)?.1;
        let last = self.kept.get(self.top.max(1) - 1)?;
        if ranking.order != Order::Weighted || weight <= 0.0 {
            return None;
        }
        let last = last.scores.weighted_sum(ranking);
        let (reached, settled_at) = (
            self.reached as f64 / 1000.0,
            (1000.0 * (last - self.floor) / weight).ceil() as i64,
        );
        Some(Missing {
            least: weight * reached + self.floor,
            last,
            settled_at,
            cheaper: None,
        })
    }

    /// Returns the ranked pool. `all` means that every admissible variant was given.
    ///
    /// # Complexity
    /// One scoring a variant, in parallel, and a sort a block; for Pareto's order O(pool · front).
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
        let ranking = &self.out.ranking;
        if ranking.order == Order::Pareto {
            let point = |r: &Ranked| -> Vec<f64> {
                let terms = ranking.terms.iter();
                terms.map(|(t, _)| r.scores.term_loss(*t)).collect()
            };
            let points: Vec<Vec<f64>> = self.kept.iter().map(point).collect();
            for (r, front) in self.kept.iter_mut().zip(fronts(&points, self.top)) {
                r.front = front.map(|f| f + 1);
            }
            self.kept.sort_by(|a, b| compare_ranked(ranking, a, b));
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
        let gain = |(t, w): &(Term, f64)| {
            let weight = if self.ranking.order == Order::Weighted {
                *w
            } else {
                1.0
            };
            let (from, to) = (cheapest.scores.term_loss(*t), here.scores.term_loss(*t));
            match self.ranking.order {
                Order::Weighted => weight * (from - to),
                _ => (from - to) / from.abs().max(to.abs()).max(1e-300),
            }
        };
        let better = |tw: &&(Term, f64)| gain(tw) > 0.0;
        let term = match self.ranking.order {
            Order::Lexicographic => self.ranking.terms.iter().find(better),
            _ => self
                .ranking
                .terms
                .iter()
                .filter(better)
                .max_by(|a, b| gain(a).total_cmp(&gain(b))),
        }?;
        Some(format!(
            "rank {rank} was {} by cost: {}",
            ordinal(here.by_cost),
            describe_change(m, term.0, &cheapest.scores, &here.scores)
        ))
    }
}
