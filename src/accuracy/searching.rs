//! How right and how fast each way of searching is: the span diagram over one prime and over two, with second opinions, and
//! cut short; rankings of larger and smaller pools; brute force over a prime and in floating point.
//!
//! The truth comes from a third prime, which no way uses: variant by variant where there are few enough to look at each, and
//! else by the whole diagram over that prime, with as many variants as may be looked at drawn at random. Verdicts are the
//! same on every run; only times differ.

mod looked;
pub mod pictures;
pub mod record;
pub mod table;
mod truth;
pub mod way;

pub use truth::Effort;

use super::timing::Stopwatch;
use crate::model::mechanism::Mechanism;
use crate::score::request::{Check, List, Method, Request};
use crate::score::run::RunError;
use crate::search::check::brute::Matrices;
use crate::search::check::brute_float::Approximate;
use crate::search::diagram::Stop;
use record::{Record, Trial};
use truth::{Truth, listed};
use way::Way;

/// The built-in mechanisms that are looked at unless others are named: few variants and many, special geometry, coupled
/// joints, planar mode, loads to rank by.
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
/// Some searches, and six looks at each of [`Effort::looked`] variants.
pub fn trial(
    mechanism: &Mechanism,
    request: &Request,
    effort: Effort,
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
        generic_only: false,
        ..request.clone()
    };
    let (present, _) = listed(mechanism, &base)?;
    let ranked = present.ranking.is_some();
    let truth = Truth::new(&present, mechanism, (&base, top), effort)?;
    let nodes = present
        .diagrams
        .as_ref()
        .map_or(0, |d| d.determinate.nodes.max(d.admissible.nodes));
    let ways = way::all(nodes, ranked.then_some(effort.pool));
    let mut records = Vec::with_capacity(ways.len());
    for (n, &way) in ways.iter().enumerate() {
        progress(way, n, ways.len());
        records.extend(match way {
            Way::Brute | Way::Float(_) => Some(by_looking(&truth, way, watch)?),
            _ => by_diagram(&truth, way, (mechanism, &way.request(&base)), watch)?,
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

/// A search by the diagram; `None` where a budget of nodes cuts nothing, for every layer may have a few hundred.
fn by_diagram(
    truth: &Truth,
    way: Way,
    (mechanism, request): (&Mechanism, &Request),
    watch: Stopwatch,
) -> Result<Option<Record>, RunError> {
    let (found, time) = watch.time(|| listed(mechanism, request));
    let (outcome, list) = found?;
    if matches!(way, Way::Nodes(_)) && outcome.stop == Stop::Exhausted {
        return Ok(None);
    }
    let judge = |choices: &[usize]| Ok::<_, RunError>(looked::by_diagram(&outcome, choices));
    let judged = looked::judge_all(&truth.looked, judge)?;
    Ok(Some(Record {
        way,
        time,
        by_proportion: false,
        counts: truth.counts_right(&looked::cells_of_counts(&outcome)),
        best: truth.best_right(&list)?,
        variants: truth.variants_right(&judged),
    }))
}

/// A search by looking at each variant, over the first prime or in floating point.
fn by_looking(truth: &Truth, way: Way, watch: Stopwatch) -> Result<Record, RunError> {
    let search = truth.over(0)?;
    let (look, ready) = match way {
        Way::Float(e) => {
            let (all, ready) = watch.time(|| Approximate::new(&search, e, e.default_tolerance()));
            (Look::Float(all?), ready)
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
        };
        let judged = seen.map(|seen| looked::judged(&search, choices, seen));
        Ok(judged.transpose()?.flatten())
    };
    let (judged, time) = watch.time(|| looked::judge_all::<RunError>(&truth.looked, judge));
    let judged = judged?;
    let time = match truth.whole {
        true => time,
        false => time.scaled(looked::ratio(&search.size(), truth.looked.len())),
    };
    let whole = truth.whole.then_some(&judged);
    let cells = whole.map(|j| looked::cells(&search, j));
    let best = whole.map(|j| looked::cheapest(&search, &truth.looked, j, truth.top));
    Ok(Record {
        way,
        time: time.plus(ready.median),
        by_proportion: !truth.whole,
        counts: cells.and_then(|c| truth.counts_right(&c)),
        best: match best {
            Some(best) if truth.pool.is_none() => truth.best_right(&best)?,
            _ => None,
        },
        variants: truth.variants_right(&judged),
    })
}

/// What looks at a variant.
enum Look {
    Exact(Matrices),
    Float(Approximate),
}
