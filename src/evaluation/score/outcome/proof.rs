//! Proof that no variant outside of a scored pool comes before its best ones: branch and bound over the diagram.
//!
//! The search follows the order of the diagram's variables. A branch ends if its bound is behind the last of the list. The bound has
//! cost, counts, and the reactions as far as they are determined. All other variants are scored. Some branches at a time are
//! searched, each with the list from before them, so that the result does not depend on the order of threads.

use crate::model::ranking::{Ranking, Term};
use crate::score::evaluation::beginnings::{Beginnings, Begun, TakenChoice};
use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::terms::Floor;
use crate::score::outcome::ranking::{Ranked, RankedPool, compare_ranked};
use crate::search::Search;
use crate::search::answer::by_tally::Places;
use crate::search::answer::k_best::{Assignment, least_from};
use crate::search::answer::keys::Key;
use crate::search::diagram::{DEAD, Diagram, ShouldCancel};
use rayon::prelude::*;

/// Branches that are searched at a time.
const BRANCHES: usize = 64;
/// Least number of branches of the diagram.
const DIVIDED: usize = 4096;
/// Bounds are sums in another order than scores.
const MARGIN: f64 = 1e-6;

/// Largest number of visited nodes, about half a minute on two cores.
const WORK: usize = 20_000_000;
/// The work of scoring a variant, in nodes.
const SCORING: usize = 8;

/// Why the search ended early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ended {
    Stopped,
    TooLong,
}

/// A beginning of variants: its choices by layer, and where they lead.
struct BranchStart {
    choices: Vec<usize>,
    node: usize,
}

/// The constants of a search.
struct BranchAndBound<'w> {
    evaluator: &'w Evaluator<'w>,
    search: &'w Search,
    diagram: &'w Diagram,
    ranking: &'w Ranking,
    begins: &'w Beginnings,
    places: &'w Places<'w>,
    /// Least bounds of all variants.
    floor: Floor,
    /// Least cost from each node, in steps.
    left: Vec<Vec<Option<u64>>>,
    /// Variants of the pool, the cheapest, which are scored.
    pooled: usize,
    top: usize,
    stop: ShouldCancel<'w>,
}

/// A thread's own.
struct Walker<'w> {
    walk: &'w BranchAndBound<'w>,
    begun: Begun<'w>,
    scratch: Scratch,
    choices: Vec<usize>,
    list: Vec<Ranked>,
    /// The sum that a variant may have at most to be among the list, and what bounds may be wrong by.
    allowed: f64,
    scored: usize,
    /// Visited nodes, and the work of scoring in nodes.
    work: usize,
    ended: Option<Ended>,
}

/// A visited node: its layer and place there, and bounds on cost and loads of the choices so far.
#[derive(Clone, Copy)]
struct Here {
    layer: usize,
    node: usize,
    key: Key,
    floor: Floor,
}

/// Examines all variants of a search that could be among the best in the list of a pool. Adds those that are. Applies to
/// sums of terms only, and only if it does not take too long. `progress` receives the number of branches done and the number
/// of all branches.
///
/// # Complexity
/// O(unknowns · (unknowns + load cases)) for each branch, and a scoring for each variant that no bound puts behind.
pub(in crate::score) fn prove_best(
    evaluator: &Evaluator<'_>,
    diagram: &Diagram,
    pool: &mut RankedPool,
    top: usize,
    stop: ShouldCancel<'_>,
    progress: &mut dyn FnMut(usize, usize),
) {
    let (search, ranking) = (evaluator.search, pool.ranking.clone());
    let best = pool.list.first();
    let begins = best.and_then(|b| evaluator.beginnings_of(&b.variant, &ranking));
    let places = Places::new(search, diagram, search.conditions.memory / 4);
    let (Some(begins), Some(places)) = (begins, places) else {
        return;
    };
    let walk = BranchAndBound {
        evaluator,
        search,
        diagram,
        ranking: &ranking,
        begins: &begins,
        places: &places,
        floor: evaluator.least_terms(),
        left: least_from(diagram, &search.steps),
        pooled: pool.scored,
        top,
        stop,
    };
    let (scored, ended) = walk.search_branches(&mut pool.list, progress);
    pool.elsewhere = Some(scored);
    pool.proof = match ended {
        None => "bounds on cost and reactions rule out the rest",
        Some(Ended::Stopped) => "going through the others was interrupted",
        Some(Ended::TooLong) => "going through all others would take too long",
    };
    pool.interrupted |= ended == Some(Ended::Stopped);
    pool.proven = ended.is_none();
    pool.missing = pool.missing.take().filter(|_| !pool.proven);
    if let (Some(missing), Some(last)) = (&mut pool.missing, pool.list.last()) {
        missing.last = last.total;
    }
}

/// Returns whether all branches will take too long, from the work of the finished ones.
fn too_long(work: usize, done: usize, all: usize) -> bool {
    work > WORK / 8 && work * all > WORK * done
}

impl<'w> BranchAndBound<'w> {
    /// Searches all branches. Returns the number of scored variants, and why the search ended early.
    fn search_branches(
        &self,
        list: &mut Vec<Ranked>,
        progress: &mut dyn FnMut(usize, usize),
    ) -> (usize, Option<Ended>) {
        let all = self.divide_branches();
        let (mut scored, mut work) = (0, 0);
        let mut ended = None;
        for (n, branches) in all.chunks(BRANCHES).enumerate() {
            progress(n * BRANCHES, all.len());
            let found: Vec<Walker<'_>> = branches
                .par_iter()
                .map(|b| self.search_branch(b, list))
                .collect();
            let mut others = Vec::new();
            for walker in found {
                scored += walker.scored;
                work += walker.work;
                ended = ended.or(walker.ended);
                let new = |r: &Ranked| list.binary_search_by(|l| compare_ranked(l, r)).is_err();
                others.extend(walker.list.into_iter().filter(new));
            }
            list.extend(others);
            list.sort_by(compare_ranked);
            list.truncate(self.top);
            let done = ((n + 1) * BRANCHES).min(all.len());
            ended = ended.or_else(|| too_long(work, done, all.len()).then_some(Ended::TooLong));
            if ended.is_some() {
                break;
            }
        }
        progress(all.len(), all.len());
        (scored, ended)
    }

    /// Returns enough beginnings that together cover all variants.
    fn divide_branches(&self) -> Vec<BranchStart> {
        let mut out = vec![BranchStart {
            choices: Vec::new(),
            node: 0,
        }];
        for layer in &self.diagram.layers {
            if out.len() >= DIVIDED {
                break;
            }
            let next = out.iter().flat_map(|b| {
                let edges = &layer.edges[b.node * layer.choices..][..layer.choices];
                let alive = edges.iter().enumerate().filter(|(_, to)| **to != DEAD);
                alive.map(move |(choice, &to)| BranchStart {
                    choices: b.choices.iter().copied().chain([choice]).collect(),
                    node: to as usize,
                })
            });
            out = next.collect();
        }
        // Those that begin alike take alike long: each part of the work is of all kinds, and tells how long the rest takes.
        let parts = out.len().div_ceil(BRANCHES);
        let mut order: Vec<usize> = (0..out.len()).collect();
        order.sort_by_key(|at| (at % parts, *at));
        let mut given: Vec<Option<BranchStart>> = out.into_iter().map(Some).collect();
        order
            .into_iter()
            .filter_map(|at| given[at].take())
            .collect()
    }

    /// Searches a branch, starting with a list.
    fn search_branch(&self, branch: &BranchStart, list: &[Ranked]) -> Walker<'_> {
        let mut walker = Walker {
            walk: self,
            begun: self.begins.begin_empty(),
            scratch: Scratch::default(),
            choices: vec![0; self.search.space.variables.len()],
            list: list.to_vec(),
            allowed: 0.0,
            scored: 0,
            work: 0,
            ended: None,
        };
        walker.update_allowed();
        let mut here = Here {
            layer: 0,
            node: 0,
            key: Key::default(),
            floor: self.floor,
        };
        for &choice in &branch.choices {
            match walker.take_step(here, choice) {
                (_, Some(next)) => here = next,
                (_, None) => return walker,
            }
        }
        walker.walk_from(here);
        walker
    }

    /// Returns true if a variant below a node could have a sum that is allowed.
    fn may_win(&self, next: &Here, allowed: f64) -> bool {
        let left = self.left[next.layer][next.node];
        left.is_some_and(|left| {
            let cost = next.key.cost().saturating_add(left);
            self.least_sum(next.key, cost, next.floor) <= allowed
        })
    }

    /// Returns the least possible sum of the terms.
    fn least_sum(&self, key: Key, cost: u64, floor: Floor) -> f64 {
        let terms = self.ranking.terms.iter().map(|&(term, weight)| {
            let least = match term {
                Term::Cost => self.search.steps.cost_in_milli(cost) as f64 / 1000.0,
                Term::Changes => f64::from(key.changes()),
                // No variant moves less than not at all.
                Term::Idle => -(self.evaluator.working_freedoms() as f64),
                _ => floor.of(term),
            };
            weight * least
        });
        terms.sum()
    }
}

impl Walker<'_> {
    /// Searches the variants behind a node.
    fn walk_from(&mut self, here: Here) {
        let Some(layer) = self.walk.diagram.layers.get(here.layer) else {
            return self.score_leaf(here.node, here.key);
        };
        self.work += 1;
        if self.work.is_multiple_of(4096) && (self.walk.stop)() {
            self.ended = Some(Ended::Stopped);
        } else if self.work > WORK / 4 {
            self.ended = Some(Ended::TooLong);
        }
        for choice in 0..layer.choices {
            if self.ended.is_some() {
                return;
            }
            let (taken, next) = self.take_step(here, choice);
            if let Some(next) = next {
                self.walk_from(next);
            }
            if let Some(taken) = taken {
                self.begun.give_back(taken);
            }
        }
    }

    /// Takes a choice at a node: what is to be given back, and the node that it leads to, if a variant behind that could come
    /// before the last of the list.
    fn take_step(&mut self, here: Here, choice: usize) -> (Option<TakenChoice>, Option<Here>) {
        let walk = self.walk;
        let layer = &walk.diagram.layers[here.layer];
        let variable = layer.variable;
        let to = layer.edges[here.node * layer.choices + choice];
        if to == DEAD {
            return (None, None);
        }
        let mut next = Here {
            layer: here.layer + 1,
            node: to as usize,
            key: Key(here.key.0 + walk.search.steps.keys[variable][choice].0),
            floor: here.floor,
        };
        if !walk.may_win(&next, self.allowed) {
            return (None, None);
        }
        self.choices[variable] = choice;
        let (taken, held) = self.begun.take_choice(variable, choice);
        if !held {
            return (Some(taken), None);
        }
        let (began, allowed) = (next, self.allowed);
        let raised = |peaks: Floor| {
            let mut next = began;
            next.floor.force = next.floor.force.max(peaks.force);
            next.floor.moment = next.floor.moment.max(peaks.moment);
            next
        };
        let ends = |peaks| !walk.may_win(&raised(peaks), allowed);
        if let Some(peaks) = self.begun.peak_bounds(&taken, ends) {
            next = raised(peaks);
            if !walk.may_win(&next, allowed) {
                return (Some(taken), None);
            }
            let error = self.begun.output_error();
            next.floor.output_error = next.floor.output_error.max(error);
        }
        let wins = walk.may_win(&next, allowed);
        (Some(taken), wins.then_some(next))
    }

    /// Updates the largest sum of a variant that still enters the list.
    fn update_allowed(&mut self) {
        let last = self.list.get(self.walk.top - 1);
        let sum = last.map_or(f64::INFINITY, |r| r.total);
        self.allowed = sum + MARGIN * (1.0 + sum.abs());
    }

    /// Computes the scores of a variant.
    fn score_leaf(&mut self, terminal: usize, key: Key) {
        let walk = self.walk;
        let end = walk
            .search
            .steps
            .redundancy_key(walk.diagram.terminals[terminal]);
        let variant = Assignment {
            choices: self.choices.clone(),
            key: Key(key.0 + end.0),
        };
        if !walk.search.is_wanted(variant.key) {
            return;
        }
        let by_cost = usize::try_from(walk.places.place_of(&variant)).unwrap_or(usize::MAX);
        if by_cost <= walk.pooled {
            return;
        }
        self.scored += 1;
        self.work += SCORING;
        let Ok(scores) = walk.evaluator.score_variant(&variant, &mut self.scratch) else {
            return;
        };
        let total = scores.weighted_sum(walk.ranking);
        if total > self.allowed || !scores.within_limits(walk.ranking) {
            return;
        }
        let ranked = Ranked {
            by_cost,
            variant,
            scores,
            total,
        };
        let at = self
            .list
            .partition_point(|r| compare_ranked(r, &ranked).is_lt());
        self.list.insert(at, ranked);
        self.list.truncate(walk.top);
        self.update_allowed();
    }
}
