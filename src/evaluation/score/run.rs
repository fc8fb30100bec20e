//! From a mechanism and a request to the outcome: conditions, diagrams, the twin over a second prime, counts, orbits,
//! poses and the ranking.

use crate::model::mechanism::Mechanism;
use crate::redundancy::analysis::exact_field;
use crate::score::outcome::Outcome;
use crate::score::outcome::ranked::rank_variants;
use crate::score::outcome::ranking::RankedPool;
use crate::score::request::prepare::LooksRounded;
use crate::score::request::{Check, List, Method, Request, RequestError};
use crate::search::Search;
use crate::search::answer::counts::Counts;
use crate::search::answer::k_best::Assignment;
use crate::search::answer::search_counts::SearchCounts;
use crate::search::answer::search_counts::orbit_counts;
use crate::search::check::brute;
use crate::search::check::other_poses;
use crate::search::check::second_opinion::{self, SecondOpinion};
use crate::search::check::second_prime::{self, PrimeCheck};
use crate::search::check::singular_values::{self, CHECKED};
pub use crate::search::diagram::ShouldCancel;
use crate::search::diagram::{Control, Progress, Stop};
use crate::search::question::Question;
use crate::search::question::conditions::{Conditions, Symmetry};
use crate::search::question::rounded_rank::Digits;
use crate::search::solve::Diagrams;
use std::sync::{Arc, Mutex, PoisonError};

pub use crate::score::request::error::RunError;

/// Of so many ideas the first variants get a second opinion.
const IDEAS: usize = 100;
/// Brute force looks at no more variants than this.
const BRUTE_LIMIT: u64 = 1 << 32;
/// The note if counts are not split by their properties.
const ONLY_TOTALS: &str = "note: counts by mobility, changes and the like would take more than the memory allowed; only totals are given";
/// The note if the second opinion differs.
const CONTRADICTED: &str = "warning: singular values contradict the exact counts, so variants are judged by singular values instead, and no figure is exact";

/// What happens on the way, for whoever shows it.
#[derive(Debug)]
pub enum Event {
    /// A sentence about a changed or doubtful value.
    Note(String),
    /// How far the diagrams have come.
    Building(Progress),
    /// The diagrams are there. Cancelling up to here cuts them short; from here on it is about what follows.
    Built,
    /// The progress through the variants that a ranking did not score, in branches.
    Proving {
        /// Finished branches.
        done: usize,
        /// Branches in all.
        of: usize,
    },
}

/// Hears what happens on the way.
pub type Tell<'a> = &'a mut (dyn FnMut(Event) + Send);

/// Searches a mechanism.
///
/// # Errors
/// Returns an error if the request does not suit the mechanism, or if measured coordinates change the figures. Returns an
/// error if two primes disagree, or if a ranking needs loads that the file does not state.
///
/// # Guarantee
/// Counts are exact if [`Outcome::stop`] is [`Stop::Exhausted`], and lower bounds otherwise. A rank modulo a prime is a
/// lower bound of the true one; with [`Check::Prime`] or [`Check::Full`] two primes near 2^61 agree on every node.
///
/// # Examples
/// ```
/// use ozols::score::run::{Event, run};
/// let mut joints = 0;
/// let outcome = run(ozols::built_in("four-bar")?, &ozols::Request::default(), &|| false, &mut |event| {
///     if let Event::Building(progress) = event {
///         joints = joints.max(progress.done);
///     }
/// })?;
/// assert_eq!((outcome.admissible.to_string().as_str(), joints), ("14", 3));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn run(
    mechanism: Mechanism,
    request: &Request,
    should_cancel: ShouldCancel<'_>,
    tell: Tell<'_>,
) -> Result<Outcome, RunError> {
    let note = &mut |text| tell(Event::Note(text));
    let prepared = request.prepare(mechanism, note)?;
    let (conditions, measured) = request.search_conditions(&prepared, note)?;
    answer_request(
        Arc::new(prepared.mechanism),
        conditions,
        measured,
        request,
        should_cancel,
        tell,
    )
}

/// Searches a mechanism that [`Request::prepare`] gave, under what [`Request::search_conditions`] gave.
///
/// # Errors
/// Returns an error in the same cases as [`run`].
pub fn answer_request(
    mechanism: Arc<Mechanism>,
    conditions: Conditions,
    measured: Option<LooksRounded>,
    request: &Request,
    should_cancel: ShouldCancel<'_>,
    tell: Tell<'_>,
) -> Result<Outcome, RunError> {
    let over = |nth: usize| over_prime(&mechanism, &conditions, nth);
    if let Some(digits) = conditions.numeric {
        let search = over(0)?;
        return search_numerically(search, digits, measured, request, should_cancel, tell);
    }
    if request.method == Method::Brute {
        return by_brute_force(over(0)?, request, measured);
    }
    let (search, twin) = with_twin(request.check, over)?;
    if request.check == Check::Full && conditions.written.is_none() {
        singular_values::warning_of_present(&search)?
            .into_iter()
            .for_each(|warning| tell(Event::Note(warning)));
    }
    for note in search.already_loose()? {
        tell(Event::Note(note));
    }
    let (diagrams, check) = build_diagrams(&search, twin.as_ref(), should_cancel, tell)?;
    tell(Event::Built);
    let mut stops = [diagrams.determinate.stop, diagrams.admissible.stop];
    let mut counts = count_found(&search, &diagrams, request);
    if counts.determinate.only_total || counts.admissible.only_total {
        tell(Event::Note(ONLY_TOTALS.to_owned()));
    }
    let of_all = counts.determinate.clone();
    if request.symmetry == Symmetry::OnePerOrbit {
        (counts, stops) = count_orbits(&search, twin.as_ref(), counts, stops, should_cancel)?;
    }
    let stroke = in_other_poses(&search, request, should_cancel, tell)?;
    let ranking = rank_pool(&search, &diagrams, request, should_cancel, tell)?;
    let second = opinion_on_diagrams(&search, &diagrams, &of_all, ranking.as_ref(), request)?;
    let contradicted = second.as_ref().is_some_and(|s| !s.agrees());
    // A count as written is what was asked for; one as meant is not what is meant.
    if contradicted && !request.as_written && request.symmetry != Symmetry::OnePerOrbit {
        tell(Event::Note(CONTRADICTED.to_owned()));
        if let Some((search, digits)) = by_values(&search.conditions)? {
            let found = search_numerically(search, digits, measured, request, should_cancel, tell)?;
            return Ok(Outcome { second, ..found });
        }
    }
    Ok(Outcome {
        second,
        diagrams: Some(diagrams),
        stop: stops[0].combine_with(stops[1]),
        determinate_stop: stops[0],
        check,
        stroke,
        ranking,
        ..Outcome::of_counts(search, request.clone(), counts, measured)
    })
}

/// Returns the search over a prime, counted from 0.
fn over_prime(
    mechanism: &Arc<Mechanism>,
    conditions: &Conditions,
    nth: usize,
) -> Result<Search, RunError> {
    let field = exact_field(mechanism, nth)?;
    let mut conditions = conditions.clone();
    // The twin proves counts, and an estimate is none.
    conditions.estimate = conditions.estimate.filter(|_| nth == 0);
    Ok(Search::new(field, mechanism.clone(), conditions)?)
}

/// Returns the search over the first prime, with its twin over the second if a check needs it.
fn with_twin(
    check: Check,
    over: impl Fn(usize) -> Result<Search, RunError> + Sync,
) -> Result<(Search, Option<Search>), RunError> {
    Ok(match check {
        Check::None => (over(0)?, None),
        Check::Prime | Check::Full => {
            let (search, twin) = rayon::join(|| over(0), || over(1));
            (search?, Some(twin?))
        }
    })
}

/// Examines every variant.
fn by_brute_force(
    search: Search,
    request: &Request,
    measured: Option<LooksRounded>,
) -> Result<Outcome, RunError> {
    if search.size() > BRUTE_LIMIT.into() {
        return Err(RunError::TooMany(search.size()));
    }
    let counts = brute::every_variant(&search)?;
    let written = search.conditions.written.as_ref();
    let second = written.map(|w| {
        second_opinion::second_opinion(
            &search,
            w,
            Vec::new(),
            Vec::new(),
            &counts.determinate,
            request.seed,
        )
    });
    let second = second.transpose()?;
    let found = Outcome::of_counts(search, request.clone(), counts, measured);
    Ok(Outcome { second, ..found })
}

/// Returns the diagrams, built over one prime or over two that must agree.
fn build_diagrams(
    search: &Search,
    twin: Option<&Search>,
    should_cancel: ShouldCancel<'_>,
    tell: Tell<'_>,
) -> Result<(Diagrams, Option<PrimeCheck>), RunError> {
    let tell = Mutex::new(tell);
    let progress = |p| {
        let mut tell = tell.lock().unwrap_or_else(PoisonError::into_inner);
        tell(Event::Building(p));
    };
    let control = Control {
        cancelled: should_cancel,
        progress: &progress,
    };
    let Some(twin) = twin else {
        return Ok((search.build_diagrams(control), None));
    };
    let both: [&Question; 2] = [search, twin];
    let (first, second) = second_prime::build_both(both, control);
    let check = second_prime::compare_primes(both, [&first, &second])?;
    Ok((first, Some(check)))
}

/// Returns the numbers of determinate and admissible variants.
fn count_found(search: &Search, diagrams: &Diagrams, request: &Request) -> SearchCounts {
    let both = !request.only_sums || request.symmetry == Symmetry::OnePerOrbit;
    let mut counts = SearchCounts::by_kind(search, diagrams, both);
    // What is cut down elsewhere may have none of the cheapest.
    if let Some(best) = &diagrams.cheapest {
        let known = search.count_variants(&best.diagram, true);
        for few in [&mut counts.determinate, &mut counts.admissible] {
            if few.total < known.total {
                few.clone_from(&known);
            }
        }
    }
    // Each is cut down by itself, and every admissible variant is determinate.
    if diagrams.determinate.stop != Stop::Exhausted {
        counts.determinate.raise_bounds(&counts.admissible);
    }
    counts
}

/// Returns other poses in which variants are examined, if the request asks for them.
fn in_other_poses(
    search: &Search,
    request: &Request,
    should_cancel: ShouldCancel<'_>,
    tell: Tell<'_>,
) -> Result<Option<other_poses::Stroke>, RunError> {
    let poses = request.poses;
    let stroke = (poses > 0)
        .then(|| other_poses::reach_poses(search, poses, request.seed, should_cancel))
        .transpose()?;
    if stroke.as_ref().is_some_and(|s| s.count_reached() == 0) && !should_cancel() {
        tell(Event::Note(format!(
            "warning: no other pose of {} could be reached: it has no motion to follow from this one",
            search.mechanism.name
        )));
    }
    Ok(stroke)
}

/// Returns the cheapest variants in the order of a ranking, if one is requested.
fn rank_pool(
    search: &Search,
    diagrams: &Diagrams,
    request: &Request,
    should_cancel: ShouldCancel<'_>,
    tell: Tell<'_>,
) -> Result<Option<RankedPool>, RunError> {
    let Some(by) = request.asked_ranking(&search.mechanism)? else {
        return Ok(None);
    };
    let progress = &mut |done, of| tell(Event::Proving { done, of });
    let pool =
        rank_variants(search, diagrams, request, &by, should_cancel, progress).map_err(|why| {
            let mechanism = search.mechanism.name.clone();
            RunError::Score { mechanism, why }
        })?;
    let mut speeds = search.mechanism.loads.drive_speeds.iter();
    if pool.is_some() && speeds.any(|s| *s != 0.0) {
        tell(Event::Note(
            "note: variants are ranked at rest, without the inertia forces of drive_speed; export a variant to compute them"
                .to_owned(),
        ));
    }
    Ok(pool)
}

/// Returns the search of the mechanism as its file writes it, for singular values.
fn by_values(conditions: &Conditions) -> Result<Option<(Search, Digits)>, RunError> {
    let mut conditions = conditions.clone();
    let Some(written) = conditions.written.take() else {
        return Ok(None);
    };
    let digits = written.digits;
    conditions.numeric = Some(digits);
    conditions.tolerance = conditions.tolerance.max(digits.tolerance);
    let field = exact_field(&written.mechanism, 0)?;
    let search = Search::new(field, written.mechanism, conditions)?;
    Ok(Some((search, digits)))
}

/// Searches by singular values, if exact arithmetic cannot represent the mechanism that is meant.
fn search_numerically(
    mut search: Search,
    digits: Digits,
    measured: Option<LooksRounded>,
    request: &Request,
    should_cancel: ShouldCancel<'_>,
    tell: Tell<'_>,
) -> Result<Outcome, RunError> {
    if request.symmetry == Symmetry::OnePerOrbit {
        return Err(RequestError::NumericOrbits.into());
    }
    let left_out = [
        (
            request.asked_ranking(&search.mechanism)?.is_some(),
            "ranked",
        ),
        (request.poses > 0, "checked in other poses"),
    ];
    for (_, what) in left_out.iter().filter(|(asked, _)| *asked) {
        tell(Event::Note(format!(
            "note: variants judged by singular values are not {what}"
        )));
    }
    let list = match request.list {
        List::Top(_) => request.cheapest_needed(&search.mechanism)?,
        List::All => usize::MAX,
        List::Sample(_) | List::Nothing => 0,
    };
    let found = search.at_tolerance(digits, list, request.seed, should_cancel)?;
    tell(Event::Built);
    let counts = SearchCounts {
        determinate: found.determinate.sure.clone(),
        admissible: found.admissible.sure.clone(),
        lasting: None,
    };
    Ok(Outcome {
        stop: found.stop,
        determinate_stop: found.stop,
        numeric: Some(found),
        ..Outcome::of_counts(search, request.clone(), counts, measured)
    })
}

/// Computes the counts of orbits over one prime or two, which must agree. Also returns why the search ended, including that
/// for the symmetric variants.
fn count_orbits(
    search: &Search,
    twin: Option<&Search>,
    all: SearchCounts,
    stops: [Stop; 2],
    should_cancel: ShouldCancel<'_>,
) -> Result<(SearchCounts, [Stop; 2]), RunError> {
    let of = |s: &Search| orbit_counts(s, all.clone(), should_cancel);
    let (first, second) = rayon::join(|| of(search), || twin.map(of).transpose());
    let (first, second) = (first?, second?);
    let stops = [0, 1].map(|i| stops[i].combine_with(first.1[i]));
    let ended = |stops: &[Stop; 2]| stops.contains(&Stop::Interrupted);
    if let (Some(twin), Some(second)) = (twin, &second)
        && !ended(&stops)
        && !ended(&second.1)
    {
        second_prime::compare_counts([search, twin], [&first.0, &second.0])?;
    }
    Ok((first.0, stops))
}

/// Returns the finding of singular values on the counts, the listed variants and a sample, if coordinates look rounded.
fn opinion_on_diagrams(
    search: &Search,
    diagrams: &Diagrams,
    determinate: &Counts,
    ranking: Option<&RankedPool>,
    request: &Request,
) -> Result<Option<SecondOpinion>, RunError> {
    let Some(written) = &search.conditions.written else {
        return Ok(None);
    };
    let mut listed: Vec<Assignment> = match (ranking, request.list) {
        (Some(r), _) => r
            .list
            .iter()
            .map(|r| r.variant.clone())
            .take(CHECKED)
            .collect(),
        (_, List::Top(k)) => search.cheapest_variants(diagrams, k.min(CHECKED)).collect(),
        (_, List::All) => search.cheapest_variants(diagrams, CHECKED).collect(),
        (_, List::Sample(n)) => {
            let drawn = search.sample_variants(diagrams, request.seed);
            drawn.take(n.min(CHECKED)).collect()
        }
        (_, List::Nothing) => Vec::new(),
    };
    // People are given the first of each idea.
    if let (None, List::Top(k @ 1..=IDEAS)) = (ranking, request.list) {
        listed.extend(search.list_ideas(diagrams, k).into_iter().map(|i| i.first));
    }
    let most = second_opinion::sample_size(search);
    let drawn = search
        .sample_variants(diagrams, request.seed)
        .take(most)
        .collect();
    let said =
        second_opinion::second_opinion(search, written, listed, drawn, determinate, request.seed)?;
    Ok(Some(said))
}
