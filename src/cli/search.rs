//! `ozols search`.

use super::answer::write_found;
use super::args::{Args, Check, Search as SearchArgs, SearchFormat, SearchMethod};
use super::question::{measured, request, restrict, state};
use super::{Done, load, output, progress};
use crate::model::measured::Measured;
use crate::rank::measured::Verdicts;
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::redundancy::analysis::exact_field;
use crate::report::search_json::Found;
use crate::search::best::Variant;
use crate::search::certify::{CHECKED, Certified, Second};
use crate::search::diagram::Stop;
use crate::search::primes;
use crate::search::request::Search;
use anyhow::{Context, ensure};
use num_traits::Zero;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Brute force looks at no more variants than this.
const BRUTE_LIMIT: u64 = 1 << 32;

pub(super) fn run(args: &Args, a: &SearchArgs) -> anyhow::Result<Done> {
    let mut mechanism = load::mechanism(&a.file.file)?;
    restrict(&mut mechanism, a)?;
    let state = state(&mechanism, a)?.map(|(s, _)| s);
    let measured = measured(&mechanism, state, a.as_written)?;
    let tolerance = measured
        .as_ref()
        .map_or(DEFAULT_TOLERANCE, |(m, _)| m.tolerance());
    let request = request(&mechanism, a, tolerance)?;
    if a.method == SearchMethod::Brute {
        let search = Search::new(exact_field(&mechanism, 0)?, &mechanism, request)?;
        return brute(&search, a, measured);
    }
    let over = |nth: usize| -> anyhow::Result<Search<'_>> {
        let field = exact_field(&mechanism, nth)?;
        Ok(Search::new(field, &mechanism, request.clone())?)
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
            let verdict = primes::compare(both, [&diagrams, second], a.top)?;
            Some((primes::primes(both), verdict))
        }
    };
    // What was found so far is still given; another Ctrl-C stops the giving.
    stop.store(false, Ordering::SeqCst);
    let mut determinate = search.counts(&diagrams.determinate, false);
    let mut admissible = search.counts(&diagrams.admissible, true);
    if a.one_per_orbit {
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
    let by_cost = if a.format == SearchFormat::Json && !a.one_per_orbit {
        search.counts_by_cost(&diagrams.admissible)
    } else {
        BTreeMap::new()
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
    };
    output::to(a.output.as_deref(), |out| {
        let mut give =
            |write: &mut dyn FnMut(usize, Certified) -> anyhow::Result<()>| -> anyhow::Result<bool> {
                let mut sink = Sink {
                    search: &search,
                    second: a.check == Check::Full,
                    block: Vec::new(),
                    given: 0,
                    write,
                };
                let mut failed = None;
                let mut visit = |v: Variant| match sink.take(v) {
                    Ok(()) if cancelled() => ControlFlow::Break(()),
                    Ok(()) => ControlFlow::Continue(()),
                    Err(e) => {
                        failed = Some(e);
                        ControlFlow::Break(())
                    }
                };
                match a.sample {
                    Some(n) => {
                        for v in search.sample(&diagrams, n, args.seed) {
                            if visit(v).is_break() {
                                break;
                            }
                        }
                    }
                    None if a.count => {}
                    None => search.cheapest(
                        &diagrams,
                        if a.all { usize::MAX / 4 } else { a.top },
                        visit,
                    ),
                }
                if let Some(e) = failed {
                    return Err(e);
                }
                sink.flush()?;
                Ok(cancelled())
            };
        write_found(out, a, &found, &mut give)?;
        Ok(if found.admissible.total.is_zero() {
            Done::Nothing
        } else {
            Done::Found
        })
    })
}

/// Gives variants on, the first with a second opinion; those are gathered first, so that they are analysed in parallel.
struct Sink<'a> {
    search: &'a Search<'a>,
    /// Whether second opinions are wanted of those to come.
    second: bool,
    block: Vec<Variant>,
    given: usize,
    write: &'a mut dyn FnMut(usize, Certified) -> anyhow::Result<()>,
}

impl Sink<'_> {
    fn take(&mut self, variant: Variant) -> anyhow::Result<()> {
        if !self.second {
            self.given += 1;
            let second = Second::Unasked;
            return (self.write)(self.given, Certified { variant, second });
        }
        self.block.push(variant);
        if self.block.len() == CHECKED {
            self.flush()?;
            self.second = false;
        }
        Ok(())
    }

    fn flush(&mut self) -> anyhow::Result<()> {
        for certified in self.search.certify(std::mem::take(&mut self.block)) {
            self.given += 1;
            (self.write)(self.given, certified)?;
        }
        Ok(())
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
    };
    output::to(a.output.as_deref(), |out| {
        write_found(out, a, &found, &mut |_| Ok(false))?;
        Ok(if found.admissible.total.is_zero() {
            Done::Nothing
        } else {
            Done::Found
        })
    })
}
