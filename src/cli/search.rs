//! `ozols search`.

use super::answer::{Given, Giver, write_found};
use super::args::{Args, Asked, Check, Search as SearchArgs, SearchFormat, SearchMethod};
use super::question::{ask, ready};
use super::{Done, load, output, progress, ranked};
use crate::model::measured::Measured;
use crate::model::mechanism::Mechanism;
use crate::rank::measured::Verdicts;
use crate::redundancy::analysis::exact_field;
use crate::search::best::Variant;
use crate::search::certify::{CHECKED, Certified};
use crate::search::diagram::Stop;
use crate::search::over_stroke::Stroke;
use crate::search::primes;
use crate::search::relax::{Relaxation, relaxations};
use crate::search::request::{Request, Search};
use crate::view::search_json::Found;
use anyhow::{Context, ensure};
use num_bigint::BigUint;
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Poses that --generic-only looks at where their number is not given.
const POSES: usize = 3;
/// Brute force looks at no more variants than this.
const BRUTE_LIMIT: u64 = 1 << 32;

pub(super) fn run(args: &Args, a: &SearchArgs) -> anyhow::Result<Done> {
    let mut mechanism = load::mechanism(&a.file.file)?;
    let question = &a.asked.question;
    ready(&mut mechanism, question)?;
    let (request, measured) = ask(&mechanism, question, a.asked.state.as_deref())?;
    if a.method == SearchMethod::Brute {
        let search = Search::new(exact_field(&mechanism, 0)?, &mechanism, request)?;
        return brute(&search, a, measured);
    }
    let wanted = Wanted {
        top: a.top,
        all: a.all,
        sample: a.sample,
        count: a.count,
        by_cost: a.format == SearchFormat::Json,
    };
    answered(
        args,
        (&mechanism, measured),
        request,
        &a.asked,
        &wanted,
        |found, give| {
            let eased = eased(found)?;
            output::to(a.output.as_deref(), |out| {
                write_found(out, a, found, &eased, give)?;
                Ok(if found.admissible.total.is_zero() {
                    Done::Nothing
                } else {
                    Done::Found
                })
            })
        },
    )
}

/// What easing one condition would leave, where nothing was found.
fn eased(found: &Found<'_>) -> anyhow::Result<Vec<(Relaxation, BigUint)>> {
    let search = found.search;
    if !found.admissible.total.is_zero() || search.size() == BigUint::one() {
        return Ok(Vec::new());
    }
    let exact = exact_field(search.mechanism, 0)?;
    Ok(relaxations(
        search.mechanism,
        &exact,
        &search.request,
        &|| false,
    )?)
}

/// Which variants are given, and what is counted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted {
    /// The best so many.
    pub(super) top: usize,
    /// All instead.
    pub(super) all: bool,
    /// So many drawn at random instead.
    pub(super) sample: Option<usize>,
    /// None at all.
    pub(super) count: bool,
    /// Also counts by cost.
    pub(super) by_cost: bool,
}

/// Searches a mechanism, and hands over what was found with a giver of the variants.
pub(super) fn answered(
    args: &Args,
    (mechanism, measured): (&Mechanism, Option<(Measured, Vec<Verdicts>)>),
    request: Request,
    a: &Asked,
    list: &Wanted,
    then: impl FnOnce(&Found<'_>, &mut Giver<'_>) -> anyhow::Result<Done>,
) -> anyhow::Result<Done> {
    let over = |nth: usize| -> anyhow::Result<Search<'_>> {
        let field = exact_field(mechanism, nth)?;
        Ok(Search::new(field, mechanism, request.clone())?)
    };
    let (search, twin) = match a.check {
        Check::None => (over(0)?, None),
        Check::Prime | Check::Full => {
            let (search, twin) = rayon::join(|| over(0), || over(1));
            (search?, Some(twin?))
        }
    };
    let stop = Arc::new(AtomicBool::new(false));
    let flag = stop.clone();
    // A second Ctrl-C ends the program at once.
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::SeqCst) {
            std::process::exit(130);
        }
    })
    .context("cannot watch for Ctrl-C")?;
    let cancelled = || stop.load(Ordering::Relaxed);
    let mut bar = progress::Bar::new(args.quiet);
    let (diagrams, second) = match &twin {
        None => (search.build(&cancelled, &mut |p| bar.show(p)), None),
        Some(twin) => {
            let both = [&search, twin];
            let (first, second) = primes::build_both(both, &cancelled, &mut |p| bar.show(p));
            (first, Some((twin, second)))
        }
    };
    bar.clear();
    let check = match &second {
        None => None,
        Some((twin, second)) => {
            let both = [&search, *twin];
            let verdict = primes::compare(both, [&diagrams, second], list.top)?;
            Some((primes::primes(both), verdict))
        }
    };
    // What was found so far is still given; another Ctrl-C stops the giving.
    stop.store(false, Ordering::SeqCst);
    let mut determinate = search.counts(&diagrams.determinate, false);
    let mut admissible = search.counts(&diagrams.admissible, true);
    if a.question.one_per_orbit {
        let all = (determinate, admissible);
        let orbits = match &twin {
            None => search.orbits(all, &cancelled)?,
            Some(twin) => {
                let (one, two) = rayon::join(
                    || search.orbits(all.clone(), &cancelled),
                    || twin.orbits(all.clone(), &cancelled),
                );
                let both = (one?, two?);
                if !cancelled() && diagrams.stop() != Stop::Interrupted {
                    primes::compare_counts([&search, twin], [&both.0, &both.1])?;
                }
                both.0
            }
        };
        (determinate, admissible) = orbits;
    }
    let by_cost = if list.by_cost && !a.question.one_per_orbit {
        search.counts_by_cost(&diagrams.admissible)
    } else {
        BTreeMap::new()
    };
    let poses = if a.generic_only && a.poses == 0 {
        POSES
    } else {
        a.poses
    };
    let stroke = (poses > 0)
        .then(|| search.stroke(poses, args.seed))
        .transpose()?;
    if stroke.as_ref().is_some_and(|s| s.reached() == 0) {
        eprintln!(
            "warning: no other pose of {} could be reached: it has no motion to follow from this one",
            mechanism.name
        );
    }
    // Further poses may drop some of the best, so that others must stand by.
    let standing = if a.generic_only {
        a.question.pool
    } else {
        list.top
    };
    let ranking = if list.all || list.count || list.sample.is_some() {
        None
    } else {
        ranked::pool(&search, &diagrams, &a.question, standing)?
    };
    let found = Found {
        search: &search,
        determinate,
        admissible,
        by_cost,
        diagrams: Some((&diagrams.determinate, &diagrams.admissible)),
        stop: diagrams.stop().word(),
        check,
        measured,
        poses: stroke.as_ref().map(|s| (s.asked, s.reached())),
        ranking,
    };
    let mut give =
        |write: &mut dyn FnMut(usize, Certified) -> anyhow::Result<()>| -> anyhow::Result<Given> {
            let wanted = if list.all { usize::MAX / 4 } else { list.top };
            let mut sink = Sink {
                search: &search,
                opinions: a.check == Check::Full,
                stroke: stroke.as_ref(),
                generic_only: a.generic_only,
                room: if list.sample.is_some() {
                    usize::MAX
                } else {
                    wanted
                },
                block: Vec::new(),
                given: 0,
                dropped: 0,
                write,
            };
            let mut failed = None;
            let mut visit = |v: Variant| match sink.take(v) {
                Ok(()) if cancelled() || sink.room == 0 => ControlFlow::Break(()),
                Ok(()) => ControlFlow::Continue(()),
                Err(e) => {
                    failed = Some(e);
                    ControlFlow::Break(())
                }
            };
            match list.sample {
                Some(n) => {
                    for v in search.sample(&diagrams, n, args.seed) {
                        if visit(v).is_break() {
                            break;
                        }
                    }
                }
                None if list.count => {}
                None if let Some(ranked) = &found.ranking => {
                    for r in &ranked.list {
                        if visit(r.variant.clone()).is_break() {
                            break;
                        }
                    }
                }
                // Lucky variants make room for others.
                None if a.generic_only && wanted > 0 => {
                    search.cheapest(&diagrams, wanted.saturating_mul(100).max(CHECKED), visit);
                }
                None => search.cheapest(&diagrams, wanted, visit),
            }
            if let Some(e) = failed {
                return Err(e);
            }
            sink.flush()?;
            Ok(Given {
                interrupted: cancelled(),
                dropped: sink.dropped,
            })
        };
    then(&found, &mut give)
}

/// Gives variants on, the first with a second opinion; those are gathered first, so that they are analysed in parallel.
struct Sink<'a> {
    search: &'a Search<'a>,
    /// Whether second opinions are wanted of those to come.
    opinions: bool,
    /// The poses that those to come are looked at in.
    stroke: Option<&'a Stroke>,
    generic_only: bool,
    /// How many more may be given.
    room: usize,
    block: Vec<Variant>,
    given: usize,
    dropped: usize,
    write: &'a mut dyn FnMut(usize, Certified) -> anyhow::Result<()>,
}

impl Sink<'_> {
    fn take(&mut self, variant: Variant) -> anyhow::Result<()> {
        if !self.opinions && self.stroke.is_none() {
            return self.give(Certified::unasked(variant));
        }
        self.block.push(variant);
        if self.generic_only && self.block.len() == self.room.clamp(16, CHECKED) {
            self.flush()?;
        } else if self.block.len() == CHECKED {
            self.flush()?;
            // Nothing is left out unseen, so a list of generic variants is looked at to its end.
            if !self.generic_only {
                (self.opinions, self.stroke) = (false, None);
            }
        }
        Ok(())
    }

    fn flush(&mut self) -> anyhow::Result<()> {
        let block = std::mem::take(&mut self.block);
        for certified in self.search.certify(block, self.opinions, self.stroke) {
            if self.room > 0 && self.generic_only && certified.lucky() {
                self.dropped += 1;
            } else {
                self.give(certified)?;
            }
        }
        Ok(())
    }

    fn give(&mut self, certified: Certified) -> anyhow::Result<()> {
        if self.room == 0 {
            return Ok(());
        }
        self.room -= 1;
        self.given += 1;
        (self.write)(self.given, certified)
    }
}

fn brute(
    search: &Search<'_>,
    a: &SearchArgs,
    measured: Option<(Measured, Vec<Verdicts>)>,
) -> anyhow::Result<Done> {
    let size = search.size();
    ensure!(
        size <= BRUTE_LIMIT.into(),
        "{size} variants are too many for brute force; use --method diagram, or fewer --options"
    );
    let (determinate, admissible) = search.brute();
    let found = Found {
        search,
        determinate,
        admissible,
        by_cost: BTreeMap::new(),
        diagrams: None,
        stop: "exhausted",
        check: None,
        measured,
        poses: None,
        ranking: None,
    };
    let eased = eased(&found)?;
    output::to(a.output.as_deref(), |out| {
        write_found(out, a, &found, &eased, &mut |_| Ok(Given::default()))?;
        Ok(if found.admissible.total.is_zero() {
            Done::Nothing
        } else {
            Done::Found
        })
    })
}
