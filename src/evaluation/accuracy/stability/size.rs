//! Size: 1 to 200 contours.

use super::study::{Effort, Picture, Progress, Study};
use super::sweep::{RightTally, bands};
use crate::accuracy::lattice::{self, LatticeKind as Shape};
use crate::accuracy::timing::{Stopwatch, quantile};
use crate::accuracy::{AnswerVerdict, Truth};
use crate::chart::{Axis, Bands, Chart, Scale, Series, Style, VerdictKind};
use crate::closure::Closure;
use crate::format::{csv, duration, list};
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::rank::method::registry;
use crate::rank::method::{Answer, MobilityMethod, NoAnswer};
use serde::Serialize;
use std::time::Duration;

const SIZES: [usize; 10] = [1, 2, 3, 5, 10, 20, 35, 60, 100, 200];
/// A method that takes longer is not asked about larger ones of the same shape.
const LIMIT: Duration = Duration::from_secs(2);
/// The same in a quick run.
const QUICK_LIMIT: Duration = Duration::from_millis(100);

/// What a method did with one size, over the shapes.
#[derive(Debug, Clone, Default)]
struct Record {
    tally: RightTally,
    times: Vec<f64>,
    skipped: usize,
}

/// A line of the table: what one method said of one mechanism.
#[derive(Serialize)]
struct SizeRow {
    shape: String,
    contours: usize,
    links: usize,
    joints: usize,
    method: &'static str,
    answer: String,
    expected: i64,
    verdict: &'static str,
    seconds: String,
}

/// Known by construction for the planar chains, by ranks over two primes for the grid.
fn truth(shape: Shape, m: &Mechanism) -> Truth {
    let one = Truth {
        instantaneous: 1,
        finite: 1,
    };
    if shape != Shape::Grid {
        return one;
    }
    let free = |nth| {
        let exact = field_of(m, StateId::FREE, nth).ok()?;
        let closure = Closure::new(&exact, m, StateId::FREE).ok()?;
        i64::try_from(closure.columns.len() - modular::rank(&exact, &closure)).ok()
    };
    let free = (0..2).filter_map(free).min().unwrap_or(0);
    // What cannot move instantaneously cannot move; otherwise only the mobility at the pose is known.
    Truth {
        instantaneous: free,
        finite: free,
    }
}

/// Runs the study.
pub(super) fn study(effort: Effort, progress: Progress<'_>) -> Study {
    let sizes = if effort.quick {
        &SIZES[..8]
    } else {
        &SIZES[..]
    };
    let limit = if effort.quick { QUICK_LIMIT } else { LIMIT };
    let mut records = vec![vec![Record::default(); sizes.len()]; registry::ALL.len()];
    let mut rows = Vec::new();
    for (s, shape) in Shape::ALL.into_iter().enumerate() {
        let mut slow = vec![false; registry::ALL.len()];
        for (n, &size) in sizes.iter().enumerate() {
            progress("size", s * sizes.len() + n, Shape::ALL.len() * sizes.len());
            let m = lattice::mechanism(shape, size);
            let truth = truth(shape, &m);
            for (i, method) in registry::ALL.iter().enumerate() {
                let record = &mut records[i][n];
                if slow[i] {
                    record.skipped += 1;
                    continue;
                }
                let (answer, seconds) = ask(*method, &m, effort);
                slow[i] = seconds > limit.as_secs_f64();
                let verdict = AnswerVerdict::on(&answer, truth);
                if verdict != AnswerVerdict::Silent {
                    record
                        .tally
                        .add(s, AnswerVerdict::keeps_promise(&answer, truth));
                    record.times.push(seconds);
                }
                rows.push(SizeRow {
                    shape: format!("{shape:?}"),
                    contours: size,
                    links: m.links.len(),
                    joints: m.joints.len(),
                    method: method.name(),
                    answer: answer
                        .as_ref()
                        .map_or_else(ToString::to_string, |a| a.mobility.to_string()),
                    expected: truth.instantaneous,
                    verdict: verdict.word(),
                    seconds: format!("{seconds:.3e}"),
                });
            }
        }
    }
    let sentence = sentence(sizes, &records, limit);
    Study {
        name: "stability-size",
        title: "Size".to_owned(),
        pictures: vec![
            Picture::of_chart("stability-size-time", &chart(sizes, &records)),
            Picture::of_bands("stability-size", &picture(sizes, &records)),
        ],
        sentence,
        csv: csv::records(rows),
    }
}

/// The answer and its time; short times are the median of several.
fn ask(
    method: &dyn MobilityMethod,
    m: &Mechanism,
    effort: Effort,
) -> (Result<Answer, NoAnswer>, f64) {
    let watch = |repeat| Stopwatch {
        clock: effort.clock,
        repeat,
    };
    let (answer, once) = watch(1).time(|| method.answer(m, StateId::FREE));
    if once.median > 0.05 {
        return (answer, once.median);
    }
    let (answer, time) = watch(5).time(|| method.answer(m, StateId::FREE));
    (answer, time.median)
}

fn points(sizes: &[usize], records: &[Record]) -> Vec<(f64, f64)> {
    let of = |(&k, r): (&usize, &Record)| {
        // Of all shapes, or of none: a median over fewer would jump.
        let whole = !r.times.is_empty() && r.skipped == 0;
        #[allow(clippy::cast_precision_loss, reason = "sizes are small")]
        whole.then(|| (k as f64, quantile(&r.times, 0.5)))
    };
    sizes.iter().zip(records).filter_map(of).collect()
}

fn chart(sizes: &[usize], records: &[Vec<Record>]) -> Chart {
    Chart {
        title: "Time against size".to_owned(),
        subtitle: format!(
            "Median over {} shapes: rows of four-bars, lazy tongs, and grids of many joint types.",
            Shape::ALL.len()
        ),
        x: Axis {
            label: "independent contours".to_owned(),
            scale: Scale::Log,
        },
        y: Axis {
            label: "time of an answer, s".to_owned(),
            scale: Scale::Log,
        },
        series: registry::ALL
            .iter()
            .zip(records)
            .map(|(m, r)| Series {
                name: m.name().to_owned(),
                points: points(sizes, r),
                style: Style::Line,
            })
            .collect(),
    }
}

fn kind(r: &Record) -> VerdictKind {
    match &r.tally {
        t if t.of == 0 || r.skipped > 0 => VerdictKind::None,
        t if t.right == t.of => VerdictKind::Good,
        t if t.right > 0 => VerdictKind::Warn,
        _ => VerdictKind::Bad,
    }
}

fn picture(sizes: &[usize], records: &[Vec<Record>]) -> Bands {
    #[allow(clippy::cast_precision_loss, reason = "sizes are small")]
    let xs: Vec<f64> = sizes.iter().map(|&k| k as f64).collect();
    Bands {
        title: "Right answers against size".to_owned(),
        subtitle: "Right: on each shape that the method applies to; in doubt: on some; no verdict: too slow, or not \
                   applicable."
            .to_owned(),
        x: Axis {
            label: "independent contours".to_owned(),
            scale: Scale::Log,
        },
        rows: registry::ALL
            .iter()
            .zip(records)
            .map(|(m, r)| (m.name().to_owned(), bands(&xs, r.iter().map(kind))))
            .collect(),
    }
}

/// The exponent of time over size, from the last two sizes measured that are at least three apart in ratio.
fn growth(points: &[(f64, f64)]) -> Option<f64> {
    let (x1, y1) = *points.last()?;
    let (x0, y0) = *points.iter().rev().find(|(x, _)| x * 3.0 <= x1)?;
    Some((y1 / y0).ln() / (x1 / x0).ln())
}

fn sentence(sizes: &[usize], records: &[Vec<Record>], limit: Duration) -> String {
    let largest = sizes.last().copied().unwrap_or(0);
    let mut always = Vec::new();
    let mut late = Vec::new();
    let mut times = Vec::new();
    for (method, r) in registry::ALL.iter().zip(records) {
        let name = method.name();
        if r.iter().all(|r| kind(r) == VerdictKind::Good) {
            always.push(name.to_owned());
        }
        if let Some(first) = r.iter().position(|r| r.skipped > 0) {
            late.push(format!("{name} at {}", sizes[first]));
        }
        let points = points(sizes, r);
        if ["lu", "svd", "modular", "rational", "finite", "auto"].contains(&name)
            && let (Some(grows), Some((k, t))) = (growth(&points), points.last())
        {
            times.push(format!(
                "{name} {} at {k:.0} (growing as k^{grows:.1})",
                duration(*t)
            ));
        }
    }
    let mut out = format!(
        "{} are right on all shapes up to {largest} contours. Times: {}.",
        list(&always),
        list(&times)
    );
    if !late.is_empty() {
        out += &format!(
            " Not asked any more, having taken over {}: {}.",
            duration(limit.as_secs_f64()),
            list(&late)
        );
    }
    out
}
