//! How right and how fast each way of searching is: the span diagram over one prime and over two, with second opinions, and
//! cut short; rankings of larger and smaller pools; a search that prunes; brute force over a prime and in floating point.
//!
//! The truth comes from a third prime, which no way uses: variant by variant where there are few enough to look at each, and
//! else by the whole diagram over that prime, with as many variants as may be looked at drawn at random. A ranking is judged only
//! by one of which it is proven that no further variant can win. Verdicts are the same on every run; only times differ.

mod brute_judgement;
mod ground_truth;
pub mod pictures;
pub mod record;
pub mod search_method;

pub use ground_truth::TrialEffort;

use super::timing::{Stopwatch, Timing};
use crate::model::mechanism::Mechanism;
use crate::score::outcome::Outcome;
use crate::score::request::{Check, List, Method, Request};
use crate::score::run::RunError;
use crate::search::check::brute::Matrices;
use crate::search::check::brute_float::Approximate;
use crate::search::check::pruned::Pruned;
use crate::search::diagram::Stop;
use ground_truth::{Truth, listed};
use num_traits::ToPrimitive;
use rayon::prelude::*;
use record::{Record, Trial};
use search_method::Way;
use std::hint::black_box;

/// The built-in mechanisms that are compared by default, in addition to a planar ladder whose diagram does not fit. They have few or
/// many variants, special geometry, coupled joints, planar mode, or loads to rank by.
pub const MECHANISMS: [&str; 6] = [
    "gripper-10",
    "gripper-10-loaded",
    "lever-gripper",
    "geared-gripper",
    "two-bennetts",
    "3-rrr-planar",
];

/// Hears which way is under way, how many are done, and their number.
pub type Progress<'a> = &'a mut dyn FnMut(Way, usize, usize);

/// Tries every way of searching a mechanism. Of the request, the conditions count; which list is given, and how it is checked
/// and counted, the ways decide, but for the number of the best.
///
/// # Errors
/// As [`crate::score::run::run`].
///
/// # Complexity
/// Some searches, and six looks at each of [`TrialEffort::looked`] variants.
pub fn trial(
    mechanism: &Mechanism,
    request: &Request,
    effort: TrialEffort,
    watch: Stopwatch,
    progress: Progress<'_>,
) -> Result<Trial, RunError> {
    let top = match request.list {
        List::Top(k) => k,
        _ => 10,
    };
    let base = Request {
        list: List::Top(top),
        check: Check::None,
        method: Method::Diagram,
        poses: 0,
        pose_only: true,
        pool: Some(request.cheapest_scored()),
        ..request.clone()
    };
    let (present, _) = listed(mechanism, &base)?;
    let ranked = present.ranking.is_some();
    let truth = Truth::new(&present, mechanism, &base, top, effort)?;
    let nodes = present
        .diagrams
        .as_ref()
        .map_or(0, |d| d.determinate.nodes.max(d.admissible.nodes));
    let ways = search_method::all(nodes, ranked.then_some(effort.pool.unwrap_or(usize::MAX)));
    let mut records = Vec::with_capacity(ways.len());
    for (n, &way) in ways.iter().enumerate() {
        progress(way, n, ways.len());
        records.extend(match way {
            way if way.looks() => Some(by_looking(&truth, way, watch)?),
            _ => by_diagram(&truth, way, mechanism, &way.request(&base), watch)?,
        });
    }
    Ok(Trial {
        mechanism: present.search.mechanism.name.clone(),
        space: truth.search.size(),
        found: truth.found.clone(),
        looked: truth.looked.len(),
        whole: truth.whole,
        top,
        ranked: truth.pool,
        records,
    })
}

/// A search by the diagram; `None` where a budget of nodes cuts nothing, for every layer may have a few hundred. Counting is
/// timed without a list, and without the file's ranking.
fn by_diagram(
    truth: &Truth,
    way: Way,
    mechanism: &Mechanism,
    request: &Request,
    watch: Stopwatch,
) -> Result<Option<Record>, RunError> {
    let (found, naming) = watch.time(|| listed(mechanism, request));
    let (outcome, list) = found?;
    if matches!(way, Way::Nodes(_)) && outcome.stop == Stop::Exhausted {
        return Ok(None);
    }
    let judge =
        |choices: &[usize]| Ok::<_, RunError>(brute_judgement::by_diagram(&outcome, choices));
    let judged = brute_judgement::judge_all(&truth.looked, judge)?;
    let mut record = Record {
        way,
        counting: None,
        naming: Some(naming),
        by_proportion: false,
        counts: None,
        best: truth.best_right(&list)?,
        variants: truth.variants_right(&judged),
        bracket: bracket(&outcome),
    };
    if !way.only_names() {
        let mut unranked = mechanism.clone();
        unranked.ranking = None;
        let request = Request {
            list: List::Nothing,
            rank: Vec::new(),
            ..request.clone()
        };
        record.counting = Some(watch.time(|| listed(&unranked, &request)).1);
        record.counts = truth.counts_right(&brute_judgement::cells_of_counts(&outcome));
    }
    Ok(Some(record))
}

/// A search by looking at variants one by one, over the first prime or in floating point.
fn by_looking(truth: &Truth, way: Way, watch: Stopwatch) -> Result<Record, RunError> {
    let search = truth.over(0)?;
    let (look, ready) = match way {
        Way::Float(e) => {
            let (all, ready) = watch.time(|| Approximate::new(&search, e, e.default_tolerance()));
            (Look::Float(all?), ready)
        }
        Way::Pruned => {
            let order = search.orders().determinate;
            let (all, ready) = watch.time(|| Pruned::new(&search, &order));
            (Look::Pruned(all), ready)
        }
        _ => {
            let (all, ready) = watch.time(|| Matrices::new(&search));
            (Look::Exact(all), ready)
        }
    };
    let judge = |choices: &[usize]| {
        let seen = match &look {
            Look::Float(all) => all.look(choices),
            Look::Exact(all) => Some(all.look(choices)),
            Look::Pruned(all) => all.look(choices),
        };
        let judged = seen.map(|seen| brute_judgement::judged(&search, choices, seen));
        Ok(judged.transpose()?.flatten())
    };
    let (judged, mut time) =
        watch.time(|| brute_judgement::judge_all::<RunError>(&truth.looked, judge));
    let judged = judged?;
    match (&look, truth.whole) {
        // One by one the branches would be gone down again for each.
        (Look::Pruned(all), _) => time = branches(truth, all, watch),
        (_, true) => {}
        (_, false) => {
            time = time.scaled(brute_judgement::ratio(&search.size(), truth.looked.len()))
        }
    }
    let counting = time.plus(ready.median);
    let whole = truth.whole.then_some(&judged);
    let cells = whole.map(|j| brute_judgement::cells(&search, j));
    let best = whole.map(|j| brute_judgement::cheapest(&search, &truth.looked, j, truth.top));
    let best = match best {
        Some(best) if truth.pool.is_none() => truth.best_right(&best)?,
        _ => None,
    };
    Ok(Record {
        way,
        counting: Some(counting),
        naming: best.map(|_| counting),
        by_proportion: !truth.whole,
        counts: cells.and_then(|c| truth.counts_right(&c)),
        best,
        variants: truth.variants_right(&judged),
        bracket: None,
    })
}

/// Returns the nodes of a stopped search, and the width of its bracket of the determinate variants in per cent of the estimate.
fn bracket(outcome: &Outcome) -> Option<(f64, f64)> {
    let estimate = outcome.estimates()[0].filter(|e| e.mean > 0.0)?;
    let nodes = outcome.diagrams.as_ref()?.determinate.nodes;
    let [least, most] = estimate.between;
    let least = least.max(outcome.determinate.total.to_f64()?);
    Some((
        f64::from(u32::try_from(nodes).ok()?),
        100.0 * (most - least).max(0.0) / estimate.mean,
    ))
}

/// The time of all branches of a search that prunes, or of some in proportion to all: those below beginnings drawn at random,
/// each with the same chance, of so many variants together as are looked at.
fn branches(truth: &Truth, all: &Pruned, watch: Stopwatch) -> Timing {
    let (beginnings, of) =
        brute_judgement::beginnings(&truth.search, all.order(), truth.looked.len());
    let visit = |beginning: &Vec<usize>| {
        let mut found = 0usize;
        all.visit(beginning, &mut |_, seen| found += black_box(seen).motion);
        found
    };
    let all_of_them = || beginnings.par_iter().map(visit).sum::<usize>();
    let time = watch.time(all_of_them).1;
    time.scaled(brute_judgement::ratio(&of, beginnings.len()))
}

/// What looks at a variant.
enum Look {
    Exact(Matrices),
    Float(Approximate),
    Pruned(Pruned),
}
