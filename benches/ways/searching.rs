//! Accuracy and speed of each way of searching. They are: the whole diagram over one prime and over two, with second
//! opinions and with a budget; rankings of larger and smaller pools; a search that prunes. Brute force runs over a prime and
//! in floating point.
//!
//! The truth comes from a third prime, which no way uses: variant by variant if there are few enough to examine each, and
//! otherwise by the whole diagram over that prime, with some variants drawn at random. A ranking is judged only by one of which it
//! is proven that no other variant can win.

mod ground_truth;
pub(crate) mod pictures;
pub(crate) mod pruned;
pub(crate) mod record;

pub(crate) use self::record::TrialEffort;

use self::ground_truth::{Truth, search_with};
use self::pruned::Pruned;
use self::record::{Bracket, Record, Trial, Way};
use num_bigint::BigUint;
use num_traits::ToPrimitive;
use ozols::accuracy::timing::{Stopwatch, Timing};
use ozols::model::mechanism::Mechanism;
use ozols::rank::numeric::Elimination;
use ozols::score::outcome::Outcome;
use ozols::score::request::{Check, List, Method, POOL, Request};
use ozols::score::run::RunError;
use ozols::search::check::brute::{Matrices, Seen};
use ozols::search::check::brute_float::{Approximate, RankedRows};
use ozols::search::diagram::Stop;
use std::hint::black_box;

/// The built-in mechanisms that are compared by default, in addition to some whose diagrams are large. They have few or
/// many variants, special geometry, coupled joints, planar mode, or loads to rank by.
pub(crate) const MECHANISMS: [&str; 6] = [
    "gripper-10",
    "gripper-10-loaded",
    "lever-gripper",
    "geared-gripper",
    "two-bennetts",
    "3-rrr-planar",
];

/// The budgets of nodes that are compared.
const BUDGETS: [usize; 5] = [1_000, 10_000, 100_000, 1_000_000, 10_000_000];

/// Tries every way of searching a mechanism. The request gives the conditions and the number of the best.
///
/// # Errors
/// Returns an error in the same cases as [`ozols::score::run::run`].
///
/// # Complexity
/// Some searches, and six examinations of each of [`TrialEffort::looked`] variants.
pub(crate) fn run_trial(
    mechanism: &Mechanism,
    request: &Request,
    effort: TrialEffort,
    watch: Stopwatch,
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
    let mut trial = Trial {
        mechanism: mechanism.name.clone(),
        top,
        ..Trial::default()
    };
    let mut found = None;
    let mut truth = None;
    if effort.looked > 0 {
        let present = search_with(mechanism, &base)?;
        let new = Truth::new(&present, mechanism, &base, effort)?;
        found.clone_from(&new.counts);
        trial.mechanism.clone_from(&present.search.mechanism.name);
        (trial.looked_at, trial.all_looked_at) = (new.looked.len(), new.is_whole());
        (trial.ranked_by_pool, trial.ranking_proven) = new.pool.unzip();
        truth = Some(new);
    }
    if let Some(truth) = &truth {
        let ways = list_ways(truth.pool.is_some(), effort.pool.unwrap_or(usize::MAX));
        for way in ways {
            trial.records.push(if way.examines_variants() {
                by_looking(truth, way, watch)?
            } else {
                by_diagram(Some(truth), way, mechanism, &base, watch)?.1
            });
        }
    }
    for (n, nodes) in BUDGETS.into_iter().enumerate() {
        let way = Way::Nodes(nodes);
        let (outcome, record) = by_diagram(truth.as_ref(), way, mechanism, &base, watch)?;
        trial.space = outcome.search.size().to_string();
        let exact = outcome.stop == Stop::Exhausted;
        let slow = record.counting.is_some_and(|t| t.median > effort.patience);
        // Otherwise it is the whole diagram over one prime again.
        if !exact || n > 0 || truth.is_none() {
            trial.records.push(record);
        }
        if exact {
            found.get_or_insert([outcome.determinate.total, outcome.admissible.total]);
        }
        if exact || slow {
            break;
        }
    }
    if let Some(found) = found {
        trial.judge_brackets(&found);
    }
    Ok(trial)
}

/// Returns the ways that are judged by variants. For a ranking these include all pools that are smaller than the one that judges it.
fn list_ways(ranked: bool, pool: usize) -> Vec<Way> {
    let checks = [Check::None, Check::Prime, Check::Full];
    let pools = [10, 100, 1000, 10_000, POOL].into_iter();
    let pools = pools.filter(|p| ranked && *p < pool).map(Some);
    let default = (ranked && pool == usize::MAX).then_some(None);
    let mut ways = checks.map(Way::Diagram).to_vec();
    ways.extend(pools.chain(default).map(Way::Pool));
    ways.extend([Way::Pruned, Way::Brute]);
    ways.extend(Elimination::ALL.map(Way::Float));
    ways
}

/// Returns the outcome and the record of a search by the diagram. Counting is timed without a list, and without the file's ranking. Its
/// answers are judged if the truth is known.
fn by_diagram(
    truth: Option<&Truth>,
    way: Way,
    mechanism: &Mechanism,
    base: &Request,
    watch: Stopwatch,
) -> Result<(Outcome, Record), RunError> {
    let request = way.apply_to(base);
    let mut unranked = mechanism.clone();
    unranked.edit().ranking = None;
    let counting = Request {
        list: List::Nothing,
        rank: Vec::new(),
        ..request.clone()
    };
    let count = || watch.time_repeatedly(|| search_with(&unranked, &counting));
    let list = |outcome: &Outcome| drop(black_box(outcome.variants().collect::<Vec<_>>()));
    let name = || watch.time_repeatedly(|| search_with(mechanism, &request).inspect(list));
    let counted = (!way.only_names()).then(count);
    let named = (!matches!(way, Way::Nodes(_))).then(name);
    let times = [&counted, &named].map(|timed| timed.as_ref().map(|t| t.1));
    let outcome = named
        .or(counted)
        .map_or_else(|| search_with(mechanism, &request), |t| t.0)?;
    let judge = |choices: &[usize]| Ok::<_, RunError>(ground_truth::by_diagram(&outcome, choices));
    let judged = truth.map(|t| ground_truth::judge_all(&t.looked, judge));
    let judged = truth.zip(judged.transpose()?);
    let totals = [&outcome.determinate, &outcome.admissible].map(|c| c.total.clone());
    let counts = |t: &Truth| t.counts_right(&totals);
    let record = Record {
        way,
        counting: times[0],
        naming: times[1],
        by_proportion: false,
        counts: truth.filter(|_| !way.only_names()).and_then(counts),
        best: truth
            .filter(|_| times[1].is_some())
            .and_then(|t| t.best_right(&outcome)),
        variants: judged.map(|(truth, judged)| truth.variants_right(&judged)),
        bracket: matches!(way, Way::Nodes(_))
            .then(|| bracket_of(&outcome))
            .flatten(),
    };
    Ok((outcome, record))
}

/// Returns what is known of the number of admissible variants. `None` if the search was stopped and gives no estimate.
fn bracket_of(outcome: &Outcome) -> Option<Bracket> {
    let real = |n: &BigUint| n.to_f64().unwrap_or(f64::INFINITY);
    let counted = real(&outcome.admissible.total);
    let (certain, likely) = match outcome.estimates()[1] {
        // The diagram of the determinate variants may be stopped alone.
        _ if outcome.diagrams.as_ref()?.admissible.stop == Stop::Exhausted => {
            ([counted; 2], [counted; 2])
        }
        Some(estimate) => {
            let most = estimate
                .at_most
                .as_ref()
                .map_or_else(|| real(&outcome.search.size()), real);
            ([counted, most], estimate.between)
        }
        None => return None,
    };
    Some(Bracket {
        certain,
        likely,
        holds: None,
    })
}

/// What examines a variant.
type Look<'a> = Box<dyn Fn(&[usize]) -> Option<Seen> + Sync + 'a>;

/// Looks at one variant in floating point; `None` where the arithmetic fails.
pub(crate) fn look_in_floats(
    all: &Approximate,
    by: Elimination,
    choices: &[usize],
) -> Option<Seen> {
    let [_, kept, state] = all.row_counts();
    let rank = |rows| {
        let matrix = all.variant_matrix(choices, rows);
        let rank = by.rank_of(&matrix, by.default_tolerance());
        rank.ok().map(|r| r.rank)
    };
    let free = rank(RankedRows::Free)?;
    let with_kept = match kept {
        0 => free,
        _ => rank(RankedRows::WithKept)?,
    };
    let of_state = match state {
        0 => None,
        _ => Some(rank(RankedRows::State)?),
    };
    let ranks = [free, with_kept];
    Some(Seen::of_ranks(all.row_counts(), ranks, of_state))
}

/// Returns the record of a search that examines variants one by one, over the first prime or in floating point.
fn by_looking(truth: &Truth, way: Way, watch: Stopwatch) -> Result<Record, RunError> {
    let search = ground_truth::search_over_prime(&truth.search, 0)?;
    let look = || -> Result<Look<'_>, RunError> {
        Ok(match way {
            Way::Float(e) => {
                let scaled = e == Elimination::Svd;
                let all = Approximate::new(&search, &search.mechanism, scaled)?;
                Box::new(move |choices| look_in_floats(&all, e, choices))
            }
            Way::Pruned => {
                let all = Pruned::new(&search, &search.variable_orders().determinate);
                Box::new(move |choices| all.look_at(choices))
            }
            _ => {
                let all = Matrices::new(&search);
                Box::new(move |choices| Some(all.look_at(choices)))
            }
        })
    };
    let (look, ready) = watch.time_repeatedly(look);
    let look = look?;
    let judge = |choices: &[usize]| {
        let judged = look(choices).map(|seen| ground_truth::judge_seen(&search, choices, seen));
        Ok::<_, RunError>(judged.transpose()?.flatten())
    };
    let (judged, each) = watch.time_repeatedly(|| ground_truth::judge_all(&truth.looked, judge));
    let judged = judged?;
    let whole_time = |t: f64| t * truth.ratio + ready.median;
    let counting = Timing {
        median: whole_time(each.median),
        least: whole_time(each.least),
        most: whole_time(each.most),
        ..each
    };
    let whole = truth.is_whole();
    let counts = whole.then(|| ground_truth::count_judged(&judged));
    Ok(Record {
        way,
        // A search that prunes is slower one by one, since it goes down its branches again for each.
        counting: Some(counting).filter(|_| whole || way != Way::Pruned),
        naming: None,
        by_proportion: !whole,
        counts: counts.and_then(|c| truth.counts_right(&c)),
        best: None,
        variants: Some(truth.variants_right(&judged)),
        bracket: None,
    })
}
