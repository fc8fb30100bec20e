//! Distance from special geometry, 1 to 1e-16: a special mechanism with one coordinate displaced, exactly.

use super::change::power_of_ten;
use super::study::{Effort, Picture, Progress, Study};
use super::sweep::bands;
use crate::accuracy::BuiltIn;
use crate::accuracy::{AnswerVerdict, Truth};
use crate::chart::{Axis, Bands, Chart, Scale, Series, Style, VerdictKind};
use crate::closure::Closure;
use crate::file::problem::ImportError;
use crate::file::text::mechanism_from_str;
use crate::format::{csv, list, scientific};
use crate::geom::Reals;
use crate::geom::expr::Expr;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::rank::method::registry;
use crate::rank::method::{Answer, NoAnswer};
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::rank::numeric::scaling;
use ozols_dense::singular_values;
use rayon::prelude::*;
use serde::Serialize;

/// A special mechanism and how it is spoiled.
struct Special {
    name: &'static str,
    what: &'static str,
    joint: &'static str,
    /// Whether an axis is tilted instead of a point moved.
    axis: bool,
    coordinate: usize,
    /// The displacement at distance 1.
    unit: i64,
}

const SPECIALS: [Special; 4] = [
    Special {
        name: "bennett",
        what: "Bennett linkage, one hinge moved",
        joint: "1-2",
        axis: false,
        coordinate: 0,
        unit: 40,
    },
    Special {
        name: "parallelogram-3-rods",
        what: "Parallelogram with a third rod, that rod of another length",
        joint: "3-4",
        axis: false,
        coordinate: 1,
        unit: 200,
    },
    Special {
        name: "sarrus",
        what: "Sarrus linkage, one hinge tilted",
        joint: "2-3",
        axis: true,
        coordinate: 2,
        unit: 1,
    },
    Special {
        name: "collinear-truss",
        what: "Flat triangle of bars, one corner lifted",
        joint: "1-2",
        axis: false,
        coordinate: 1,
        unit: 60,
    },
];

impl Special {
    /// The mechanism at a distance from the special one.
    fn at(&self, mechanism: &Mechanism, distance: &Expr) -> Mechanism {
        let mut m = mechanism.clone();
        if let Some(j) = m.joint(self.joint) {
            let frame = &mut m.joints[j].frame;
            let vector = if self.axis {
                &mut frame.axis
            } else {
                &mut frame.point
            };
            let by = &Expr::from(self.unit) * distance;
            vector[self.coordinate] = &vector[self.coordinate] + &by;
        }
        m
    }
}

/// What every method says at one distance.
struct At {
    distance: f64,
    truth: Truth,
    answers: Vec<Result<Answer, NoAnswer>>,
    /// The smallest singular value that the exact rank counts, relative to the largest.
    smallest: f64,
}

/// A line of the table: what one method said at one distance.
#[derive(Serialize)]
struct DistanceRow {
    mechanism: &'static str,
    distance: String,
    method: &'static str,
    answer: Option<i64>,
    exact_instantaneous: i64,
    exact_finite: i64,
    special_instantaneous: i64,
    special_finite: i64,
    smallest_singular_value: String,
}

/// The true figures: the larger of the ranks over two primes, and no motion where not even an instantaneous one is left.
fn truth(m: &Mechanism) -> (Truth, usize) {
    let rank = |nth| {
        let exact = field_of(m, StateId::FREE, nth).ok()?;
        let closure = Closure::new(&exact, m, StateId::FREE).ok()?;
        Some((closure.columns.len(), modular::rank(&exact, &closure)))
    };
    let (f, rank) = (0..2)
        .filter_map(rank)
        .max_by_key(|r| r.1)
        .unwrap_or((0, 0));
    let free = i64::try_from(f - rank).unwrap_or(i64::MAX);
    let finite = if free == 0 {
        Some(0)
    } else {
        let answer = registry::by_name("finite").map(|x| x.answer(m, StateId::FREE));
        answer.and_then(Result::ok).map(|a| a.mobility)
    };
    let truth = Truth {
        instantaneous: free,
        finite: finite.unwrap_or(free),
    };
    (truth, rank)
}

fn smallest(m: &Mechanism, rank: usize) -> f64 {
    let values = Closure::new(&Reals, m, StateId::FREE)
        .ok()
        .and_then(|c| singular_values(&scaling::scaled(&c)));
    let mut values = values.unwrap_or_default();
    values.sort_by(|a, b| b.total_cmp(a));
    match (
        values.first(),
        rank.checked_sub(1).and_then(|r| values.get(r)),
    ) {
        (Some(largest), Some(value)) => value / largest,
        _ => f64::NAN,
    }
}

/// Good for the verdict of exact ranks, doubtful for that on the special mechanism, bad for any other.
fn kind(answer: &Result<Answer, NoAnswer>, truth: Truth, special: Truth) -> VerdictKind {
    match answer {
        Err(_) => VerdictKind::None,
        Ok(_) if AnswerVerdict::keeps_promise(answer, truth) => VerdictKind::Good,
        Ok(_) if AnswerVerdict::keeps_promise(answer, special) => VerdictKind::Warn,
        Ok(_) => VerdictKind::Bad,
    }
}

/// From where up a method tells a mechanism from the special one.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ToldApart {
    Always,
    From(f64),
    Never,
}

fn seen(of: &[(f64, VerdictKind)]) -> ToldApart {
    let good = of.iter().rev().take_while(|(_, k)| *k == VerdictKind::Good);
    match good.last() {
        None => ToldApart::Never,
        Some((d, _)) if *d == of[0].0 => ToldApart::Always,
        Some((d, _)) => ToldApart::From(*d),
    }
}

/// The distances looked at, ascending.
fn distances(quick: bool) -> Vec<(f64, Expr)> {
    let mut out: Vec<(f64, Expr)> = Vec::new();
    for e in (-16..=0).step_by(if quick { 2 } else { 1 }) {
        for lead in [1_i32, 3] {
            if lead == 1 || (e < 0 && !quick) {
                let d = &Expr::from(i64::from(lead)) * &power_of_ten(e);
                out.push((d.to_f64(), d));
            }
        }
    }
    out
}

/// A special mechanism, and what is said of it at every distance.
struct Displaced<'s> {
    special: &'s Special,
    at_zero: Truth,
    /// By method, whether it is right about the special mechanism.
    knows: Vec<bool>,
    found: Vec<At>,
}

impl<'s> Displaced<'s> {
    fn new(special: &'s Special, mechanism: &Mechanism, distances: &[(f64, Expr)]) -> Self {
        let (at_zero, _) = truth(mechanism);
        let knows: Vec<bool> = registry::ALL
            .iter()
            .map(|x| AnswerVerdict::keeps_promise(&x.answer(mechanism, StateId::FREE), at_zero))
            .collect();
        let found: Vec<At> = distances
            .par_iter()
            .map(|(distance, exact)| {
                let m = special.at(mechanism, exact);
                let (truth, rank) = truth(&m);
                At {
                    distance: *distance,
                    truth,
                    answers: registry::ALL
                        .iter()
                        .map(|x| x.answer(&m, StateId::FREE))
                        .collect(),
                    smallest: smallest(&m, rank),
                }
            })
            .collect();
        Displaced {
            special,
            at_zero,
            knows,
            found,
        }
    }

    /// The lines of the table.
    fn table(&self) -> impl Iterator<Item = DistanceRow> + '_ {
        self.found.iter().flat_map(|at| {
            let answers = registry::ALL.iter().zip(&at.answers);
            answers.map(|(method, answer)| DistanceRow {
                mechanism: self.special.name,
                distance: format!("{:e}", at.distance),
                method: method.name(),
                answer: answer.as_ref().ok().map(|a| a.mobility),
                exact_instantaneous: at.truth.instantaneous,
                exact_finite: at.truth.finite,
                special_instantaneous: self.at_zero.instantaneous,
                special_finite: self.at_zero.finite,
                smallest_singular_value: format!("{:.3e}", at.smallest),
            })
        })
    }

    /// What a method, by its place, says at each distance.
    fn verdicts(&self, method: usize) -> Vec<(f64, VerdictKind)> {
        let verdict = |a: &At| {
            let kind = kind(&a.answers[method], a.truth, self.at_zero);
            (a.distance, kind)
        };
        self.found.iter().map(verdict).collect()
    }

    /// From where up a method tells the mechanism from the special one; `None` where it says nothing.
    fn told_apart(&self, method: usize) -> Option<ToldApart> {
        let verdicts = self.verdicts(method);
        let answers = verdicts.iter().any(|(_, k)| *k != VerdictKind::None);
        // A method that is wrong about the special mechanism cannot tell another one from it.
        answers.then(|| {
            if self.knows[method] {
                seen(&verdicts)
            } else {
                ToldApart::Never
            }
        })
    }

    fn picture(&self) -> Picture {
        let xs: Vec<f64> = self.found.iter().map(|a| a.distance).collect();
        let rows = registry::ALL.iter().enumerate().map(|(m, method)| {
            let kinds = self.verdicts(m).into_iter().map(|(_, kind)| kind);
            (method.name().to_owned(), bands(&xs, kinds))
        });
        let far = self.found.last().map_or(self.at_zero, |a| a.truth);
        Picture::of_bands(
            format!("stability-distance-{}", self.special.name),
            &picture(self.special, rows.collect(), self.at_zero, far),
        )
    }

    /// The smallest singular value that counts, over the distance.
    fn smallest(&self) -> Series {
        Series {
            name: self.special.name.to_owned(),
            points: self
                .found
                .iter()
                .map(|a| (a.distance, a.smallest))
                .collect(),
            style: Style::Line,
        }
    }
}

/// Runs the study.
pub(super) fn study(
    built_in: BuiltIn<'_>,
    effort: Effort,
    progress: Progress<'_>,
) -> Result<Study, ImportError> {
    let distances = distances(effort.quick);
    let mut table = Vec::new();
    let mut pictures = Vec::new();
    let mut values = Vec::new();
    let mut met: Vec<Vec<ToldApart>> = vec![Vec::new(); registry::ALL.len()];
    for (n, special) in SPECIALS.iter().enumerate() {
        progress("distance from special geometry", n, SPECIALS.len());
        let found = built_in.iter().find(|(name, _)| *name == special.name);
        let text = found.map_or("", |(_, text)| text);
        let mechanism = mechanism_from_str(&format!("{}.toml", special.name), text)?;
        let displaced = Displaced::new(special, &mechanism, &distances);
        table.extend(displaced.table());
        for (method, met) in met.iter_mut().enumerate() {
            met.extend(displaced.told_apart(method));
        }
        pictures.push(displaced.picture());
        values.push(displaced.smallest());
    }
    pictures.push(Picture::of_chart(
        "stability-distance-values",
        &chart(values),
    ));
    Ok(Study {
        name: "stability-distance",
        title: "Distance from special geometry".to_owned(),
        sentence: sentence(&met),
        pictures,
        csv: csv::records(table),
    })
}

fn picture(
    special: &Special,
    rows: Vec<(String, Vec<crate::chart::Band>)>,
    at_zero: Truth,
    far: Truth,
) -> Bands {
    let figures = |t: Truth| {
        if t.instantaneous == t.finite {
            t.finite.to_string()
        } else {
            format!("{} ({} at the pose)", t.finite, t.instantaneous)
        }
    };
    Bands {
        title: special.what.to_owned(),
        subtitle: format!(
            "The special mechanism has mobility {}, displaced by any distance it has {}: right is the verdict of exact \
             ranks on the displaced one, in doubt is that on the special one, which may be what is meant.",
            figures(at_zero),
            figures(far)
        ),
        x: Axis {
            label: format!(
                "distance from the special geometry, in units of {}",
                match (special.axis, special.unit) {
                    (true, _) => "the axis".to_owned(),
                    (false, u) => format!("{u} mm"),
                }
            ),
            scale: Scale::Log,
        },
        rows,
    }
}

fn chart(mut series: Vec<Series>) -> Chart {
    let ends = series.first().map(|s| (s.points.first(), s.points.last()));
    if let Some((Some(&(from, _)), Some(&(to, _)))) = ends {
        series.push(Series {
            name: "default tolerance".to_owned(),
            points: vec![(from, DEFAULT_TOLERANCE), (to, DEFAULT_TOLERANCE)],
            style: Style::Dashed,
        });
    }
    Chart {
        title: "The singular value that tells a mechanism from the special one".to_owned(),
        subtitle: "It falls in proportion to the distance, until rounding in the sixteenth digit hides it: a tolerance \
                   is a distance below which geometry counts as special."
            .to_owned(),
        x: Axis {
            label: "distance from the special geometry".to_owned(),
            scale: Scale::Log,
        },
        y: Axis {
            label: "smallest singular value that the exact rank counts, relative to the largest"
                .to_owned(),
            scale: Scale::Log,
        },
        series,
    }
}

fn sentence(met: &[Vec<ToldApart>]) -> String {
    let (mut always, mut from, mut blind) = (Vec::new(), Vec::new(), Vec::new());
    for (method, seen) in registry::ALL.iter().zip(met) {
        let name = method.name().to_owned();
        let places = || {
            seen.iter().filter_map(|s| match s {
                ToldApart::From(d) => Some(*d),
                _ => None,
            })
        };
        let (low, high) = (
            places().fold(f64::MAX, f64::min),
            places().fold(0.0, f64::max),
        );
        if seen.iter().all(|s| *s == ToldApart::Always) {
            always.push(name);
        } else if seen.contains(&ToldApart::Never) {
            blind.push(name);
        } else if low < high {
            from.push(format!(
                "{name} {} to {}",
                scientific(low),
                scientific(high)
            ));
        } else {
            from.push(format!("{name} {}", scientific(low)));
        }
    }
    let mut out = format!(
        "{} tell the four displaced mechanisms from the special ones at every distance down to 1e−16",
        list(&always)
    );
    if !from.is_empty() {
        out += &format!(
            "; the smallest distance seen, over the four, is for {}",
            list(&from)
        );
    }
    if !blind.is_empty() {
        out += &format!(
            "; wrong about some of the four, special or displaced, at every distance: {}",
            list(&blind)
        );
    }
    out + ". auto takes displacements in the ninth digit and beyond for errors of measurement, and says so."
}
