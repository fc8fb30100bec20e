//! About how many variants there are, by cuts of the diagram, where it has a searched state.
//!
//! Layers are cut down to a few nodes drawn at random, the more likely the more variants may pass through them, and what is
//! kept of a node's ways counts as much more as it was unlikely to be kept. So the sum of the ways to the ends is right on
//! average, whatever was drawn; how far sums of several such cuts lie apart says how good their mean is.
//!
//! # Sources
//! Knuth, "Estimating the efficiency of backtrack programs", Math. Comp. 29 (1975); Chen, "Heuristic sampling", SIAM J.
//! Comput. 21 (1992). Draws of a fixed number with given chances: Madow, "On the theory of systematic sampling, II", Annals
//! of Mathematical Statistics 20 (1949).

use crate::search::answer::counts::limited;
use crate::search::answer::estimate::completion_shares::{CompletionShares, LeadsTo};
use crate::search::answer::estimate::{Drawn, Estimate, WITHIN};
use crate::search::answer::keys::{Key, Steps};
use crate::search::diagram::layer::{Merge, Nodes};
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::{Carries, DEAD, Stop, expand, retain};
use crate::search::question::Question;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Cuts made.
const CUTS: usize = 16;
/// Standard errors on either side of the mean of so many cuts that hold it with a chance of 95 %: Student's t with 15 degrees of
/// freedom.
const STUDENT: f64 = 2.131;
/// Nodes kept of a layer at least.
const FEWEST: usize = 256;
/// Nodes kept of a layer where so few do not tell the number well enough: they take a second or so.
const WIDE: usize = 1024;
/// More than what is needed if the first cuts are right, for they are not quite.
const MARGIN: f64 = 1.2;

/// The diagram that is cut.
pub(in crate::search) struct Uncut<'a, C> {
    /// What carries nodes over its variables.
    pub(in crate::search) stages: Vec<C>,
    pub(in crate::search) limits: &'a Limits,
    /// Redundant constraints that every variant has.
    pub(in crate::search) already: u32,
    pub(in crate::search) shares: CompletionShares<'a>,
}

/// Estimates how many variants a diagram has; `filter` applies the conditions on mobility and changes too. `None` where it was
/// cancelled, where memory does not suffice, and where no cut has any variant, or too many for a floating-point number.
///
/// # Complexity
/// That of a diagram of half as many nodes as the limits allow, or of some ten thousand nodes a layer.
pub(in crate::search) fn estimate(
    question: &Question,
    of: &Uncut<'_, impl Carries>,
    seed: u64,
    filter: bool,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Estimate> {
    let kinds = if filter {
        limited(question)
    } else {
        <_>::default()
    };
    let mut cuts = Cuts {
        question,
        of,
        steps: question.steps.only(kinds),
        filter,
        keep: (of.limits.nodes / 2 / CUTS / of.stages.len().max(1)).max(FEWEST),
        cancelled,
    };
    let first = cuts.estimate(seed);
    let reach = first.as_ref().map_or(f64::INFINITY, Estimate::reach);
    // How far sums lie apart falls about as the nodes kept grow.
    let wider = wider(cuts.keep, reach);
    if wider == cuts.keep || reach <= WITHIN || cancelled() {
        return first;
    }
    cuts.keep = wider;
    cuts.estimate(seed).or(first)
}

/// Nodes to keep of a layer for an interval [`WITHIN`] the mean where so many give one that reaches so far: no fewer, and no more
/// than [`WIDE`] where these are fewer.
fn wider(keep: usize, reach: f64) -> usize {
    #[allow(clippy::cast_precision_loss, reason = "layers are far smaller")]
    let wanted = keep as f64 * MARGIN * reach / WITHIN;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "no more than is clamped"
    )]
    let wanted = wanted.ceil() as usize;
    wanted.clamp(keep, keep.max(WIDE))
}

/// The number of ways to a node, by what is told apart of them.
type WaysTo = BTreeMap<Key, f64>;

/// What all cuts have in common.
struct Cuts<'a, C> {
    question: &'a Question,
    of: &'a Uncut<'a, C>,
    /// What is told apart of choices.
    steps: Steps,
    /// Whether the conditions on mobility and changes apply too.
    filter: bool,
    /// Nodes kept of a layer.
    keep: usize,
    cancelled: &'a (dyn Fn() -> bool + Sync),
}

impl<C: Carries> Cuts<'_, C> {
    /// The mean of some cuts; none where one was cancelled, or has too many for a floating-point number, and where none has any variant.
    fn estimate(&self, seed: u64) -> Option<Estimate> {
        let cuts = (0..CUTS).into_par_iter().map(|cut| {
            // Cuts of another width are others.
            let seed = seed.rotate_left(16) ^ ((self.keep as u64) << 8) ^ cut as u64;
            let random = ChaCha8Rng::seed_from_u64(seed);
            self.one(random).filter(|cut| cut.is_finite())
        });
        let sums: Vec<f64> = cuts.collect::<Option<_>>()?;
        #[allow(clippy::cast_precision_loss, reason = "cuts are few")]
        let n = CUTS as f64;
        let mean = sums.iter().sum::<f64>() / n;
        let spread: f64 = sums.iter().map(|x| (x / mean - 1.0).powi(2)).sum();
        let standard_error = mean * (spread / (n * (n - 1.0))).sqrt();
        (mean > 0.0).then_some(Estimate {
            mean,
            standard_error,
            between: [-1.0, 1.0].map(|side| (mean + side * STUDENT * standard_error).max(0.0)),
            at_most: None,
            drawn: Drawn::Cuts(CUTS),
            seed,
        })
    }

    /// The weighted number of variants of one random cut; none where it was cancelled, or where memory does not suffice.
    fn one(&self, mut random: ChaCha8Rng) -> Option<f64> {
        let mut nodes = Nodes::root(self.of.already);
        let mut ways = vec![WaysTo::from([(Key::default(), 1.0)])];
        let mut at = vec![LeadsTo::default()];
        for (done, stage) in self.of.stages.iter().enumerate() {
            if (self.cancelled)() {
                return None;
            }
            let (mut next, mut edges) = self.layer(done, stage, &nodes)?;
            let mut carried = self.carried(stage, &ways, &edges, next.len());
            let to = self.of.shares.over(done, &at, &edges, next.len());
            let size = |(i, ways): (usize, &WaysTo)| {
                let matrix = next.matrix(i).len();
                let share = self.of.shares.of(done + 1, &next.spent[i], matrix, to[i]);
                share * ways.values().sum::<f64>()
            };
            let sizes: Vec<f64> = carried.iter().enumerate().map(size).collect();
            let drawn = draw(&sizes, self.keep, &mut random);
            let kept: Vec<usize> = drawn.iter().map(|(i, _)| *i).collect();
            retain(&mut next, &kept, &mut edges);
            at = kept.iter().map(|&i| to[i]).collect();
            ways = drawn
                .into_iter()
                .map(|(i, chance)| {
                    let mut ways = std::mem::take(&mut carried[i]);
                    ways.values_mut().for_each(|n| *n /= chance);
                    ways
                })
                .collect();
            nodes = next;
        }
        Some(self.variants(&nodes, &ways))
    }

    /// Choices of a stage's variable.
    fn choices(&self, stage: &C) -> usize {
        let space = &self.question.model.space;
        space.variables[stage.variable()].choices.len()
    }

    /// The nodes behind a stage, but for those that have no completion, and the edges to them; none where memory does not suffice.
    fn layer(&self, done: usize, stage: &C, nodes: &Nodes) -> Option<(Nodes, Vec<u32>)> {
        let choices = self.choices(stage);
        let (bytes, edges) = (self.of.limits.bytes / CUTS, nodes.len() * choices);
        let mut merge = Merge::new(usize::MAX, bytes, Stop::Exhausted, edges);
        for part in expand(stage, choices, nodes, 0..nodes.len()) {
            let fails = |spent: &_, size, _| self.of.shares.fails(done + 1, spent, size);
            merge.take(&part, nodes, |_| 0, fails);
        }
        if merge.stop != Stop::Exhausted {
            return None;
        }
        let (mut next, mut edges) = (merge.next, merge.edges);
        if let Some(passed) = stage.passing(&next) {
            retain(&mut next, &passed, &mut edges);
        }
        Some((next, edges))
    }

    /// The ways to the nodes behind a stage, from those to the nodes before it.
    fn carried(&self, stage: &C, ways: &[WaysTo], edges: &[u32], next: usize) -> Vec<WaysTo> {
        let steps = &self.steps.keys[stage.variable()];
        let choices = self.choices(stage);
        let mut carried = vec![WaysTo::new(); next];
        for (e, &to) in edges.iter().enumerate().filter(|(_, to)| **to != DEAD) {
            for (key, n) in &ways[e / choices] {
                *carried[to as usize]
                    .entry(Key(key.0 + steps[e % choices].0))
                    .or_insert(0.0) += n;
            }
        }
        carried
    }

    /// The number of variants that come to the last nodes.
    fn variants(&self, nodes: &Nodes, ways: &[WaysTo]) -> f64 {
        let question = self.question;
        let ends = nodes.spent.iter().zip(ways).flat_map(|(spent, ways)| {
            let end = question.steps.redundancy(spent.redundancy()).0;
            ways.iter().map(move |(key, n)| (Key(key.0 + end), n))
        });
        let wanted = ends.filter(|(key, _)| !self.filter || question.wanted(*key));
        wanted.map(|(_, n)| n).sum()
    }
}

/// Some of a number of things, ascending, each with its chance of being drawn: in proportion to its size, or 1 where that
/// would be more; `keep` of them, or all where there are no more.
///
/// # Complexity
/// O(n log n).
fn draw(sizes: &[f64], keep: usize, random: &mut ChaCha8Rng) -> Vec<(usize, f64)> {
    if sizes.len() <= keep {
        return (0..sizes.len()).map(|i| (i, 1.0)).collect();
    }
    let mut falling = sizes.to_vec();
    falling.sort_by(|a, b| b.total_cmp(a));
    // The largest are certain; the others share what is left.
    let (mut rest, mut left): (f64, f64) = (falling.iter().sum(), 0.0);
    #[allow(clippy::cast_precision_loss, reason = "layers are far smaller")]
    for (certain, largest) in falling.iter().enumerate().take(keep) {
        left = (keep - certain) as f64;
        if largest * left < rest {
            break;
        }
        rest -= largest;
    }
    let chance = |size: f64| {
        if rest > 0.0 {
            (size * left / rest).min(1.0)
        } else {
            1.0
        }
    };
    // One number decides all: a thing is drawn where the sum of chances passes it plus a whole number.
    #[allow(clippy::cast_precision_loss, reason = "53 bits are exact")]
    let start = (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let (mut sum, mut out) = (0.0f64, Vec::with_capacity(keep + 1));
    for (i, &size) in sizes.iter().enumerate() {
        let chance = chance(size);
        if chance >= 1.0 {
            out.push((i, 1.0));
            continue;
        }
        let before = (sum - start).ceil();
        sum += chance;
        if (sum - start).ceil() > before {
            out.push((i, chance));
        }
    }
    out
}
