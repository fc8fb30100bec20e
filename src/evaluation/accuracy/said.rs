//! What is said of a mechanism against its true figures, counted over a range: right, left open, or wrong and sure; of every method and
//! of the automatic choice.

use super::study::Picture;
use super::sweep::RightTally;
use crate::accuracy::{AnswerVerdict, Truth};
use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::format::csv;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::auto::{Decision, decide};
use crate::rank::method::{MobilityMethod, NoAnswer, registry};

/// What is said against the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Said {
    /// The true figures.
    Right,
    /// No figures, or a range.
    Open,
    /// Other figures, and that they are not exact.
    Hedged,
    /// Other figures as exact or proven ones.
    Wrong,
}

impl Said {
    /// Judges an answer: whether it is given, whether it is called exact, and whether it is right.
    #[must_use]
    pub fn of(given: bool, exact: bool, right: bool) -> Said {
        match (given, right, exact) {
            (false, ..) => Said::Open,
            (_, true, _) => Said::Right,
            (_, _, false) => Said::Hedged,
            _ => Said::Wrong,
        }
    }

    /// W at the pose and finite mobility as decided, against the true ones. A geometry that is merely near gives no exact
    /// figures, nor does a motion that is followed.
    #[must_use]
    pub fn of_decision(found: Option<&Decision>, truth: (i64, i64)) -> [Said; 2] {
        let Some(d) = found else {
            return [Said::Open; 2];
        };
        let is = |w: usize, truth: i64| i64::try_from(w) == Ok(truth);
        let (given, exact) = (d.verdict.is_decided(), d.verdict.word() != "near");
        let w = d.verdict.figures(d.verdict.rank()).0;
        [
            Said::of(given, exact, is(w, truth.0)),
            Said::of(
                given && !d.finite.is_undecided(),
                exact && d.finite.is_proven(),
                is(d.finite.mobility, truth.1),
            ),
        ]
    }
}

/// Answers counted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct AnswerCount {
    /// How many of each of [`Said`].
    pub of: [usize; 4],
    /// The cases that are wrong and sure.
    pub wrong: Vec<String>,
}

impl AnswerCount {
    /// Counts an answer on a case.
    pub(crate) fn add(&mut self, said: Said, case: impl FnOnce() -> String) {
        self.of[said as usize] += 1;
        if said == Said::Wrong {
            self.wrong.push(case());
        }
    }

    /// Right, left open or called not exact, wrong and sure.
    #[must_use]
    pub(crate) fn three(&self) -> [usize; 3] {
        let [right, open, hedged, wrong] = self.of;
        [right, open + hedged, wrong]
    }
}

/// Counts over a range, for each of several questions.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Counts {
    /// The axis across, logarithmic.
    pub x: String,
    /// Its head in CSV.
    pub column: &'static str,
    /// Where it was looked at, ascending.
    pub values: Vec<f64>,
    /// What was asked, with the count at each value.
    pub rows: Vec<(String, Vec<AnswerCount>)>,
}

impl Counts {
    /// All that was asked as one.
    #[must_use]
    pub(crate) fn together(&self) -> Vec<AnswerCount> {
        let mut out = vec![AnswerCount::default(); self.values.len()];
        for (_, row) in &self.rows {
            for (sum, count) in out.iter_mut().zip(row) {
                sum.of.iter_mut().zip(count.of).for_each(|(s, n)| *s += n);
                sum.wrong.extend(count.wrong.iter().cloned());
            }
        }
        out
    }

    /// The shares of a row as three lines.
    #[must_use]
    pub(crate) fn picture(&self, name: &str, title: &str, row: &[AnswerCount]) -> Picture {
        let of = row.iter().map(|c| c.of.iter().sum::<usize>()).max();
        let names = ["right", "undecided, or not exact", "wrong and sure"];
        #[allow(clippy::cast_precision_loss, reason = "counts are small")]
        let share = |c: &AnswerCount, n: usize| {
            100.0 * c.three()[n] as f64 / c.of.iter().sum::<usize>().max(1) as f64
        };
        let line = |(n, name): (usize, &str)| Series {
            name: name.to_owned(),
            points: self
                .values
                .iter()
                .zip(row)
                .map(|(x, c)| (*x, share(c, n)))
                .collect(),
            style: Style::Line,
        };
        Picture::of_chart(
            name,
            &Chart {
                title: title.to_owned(),
                subtitle: format!("Of {} cases at each value.", of.unwrap_or(0)),
                x: Axis {
                    label: self.x.clone(),
                    scale: Scale::Log,
                },
                y: Axis {
                    label: "share of answers, %".to_owned(),
                    scale: Scale::Linear,
                },
                series: names.into_iter().enumerate().map(line).collect(),
            },
        )
    }

    /// One line for each row and value.
    #[must_use]
    pub(crate) fn csv(&self) -> String {
        let rows = self.rows.iter().flat_map(|(name, counts)| {
            self.values.iter().zip(counts).map(move |(x, c)| {
                let n = |s: Said| c.of[s as usize].to_string();
                [
                    name.clone(),
                    format!("{x:e}"),
                    n(Said::Right),
                    n(Said::Open),
                    n(Said::Hedged),
                    n(Said::Wrong),
                    c.wrong.join("; "),
                ]
            })
        });
        let heads = [
            "asked",
            self.column,
            "right",
            "undecided",
            "other_not_exact",
            "wrong_and_sure",
            "wrong",
        ];
        csv::table(&heads, rows)
    }
}

/// What was said of some mechanisms that belong together, and the file of the last.
pub(super) struct Replies {
    /// Of each method, whether it is right about all; `None` where it does not apply to one.
    right: Vec<Option<bool>>,
    /// What the automatic choice says of the last, the worse of W and finite mobility.
    auto: Said,
    text: String,
}

impl Replies {
    /// Asks about mechanisms that belong together; none of no mechanism.
    pub(super) fn new(all: &[(Mechanism, Truth)], text: String) -> Option<Replies> {
        let of = |method: &&dyn MobilityMethod| {
            let mut right = true;
            for (m, truth) in all {
                let answer = method.answer(m, StateId::FREE);
                if matches!(&answer, Err(e) if !matches!(e, NoAnswer::Failed(_))) {
                    return None;
                }
                right &= AnswerVerdict::keeps_promise(&answer, *truth);
            }
            Some(right)
        };
        let (last, truth) = all.last()?;
        let found = decide(last, StateId::FREE).ok();
        let [w, finite] = Said::of_decision(found.as_ref(), (truth.instantaneous, truth.finite));
        Some(Replies {
            right: registry::ALL.iter().map(of).collect(),
            auto: w.max(finite),
            text,
        })
    }
}

/// A row for each method, empty as yet.
pub(super) fn rows() -> Vec<(String, Vec<RightTally>)> {
    let names = registry::ALL.iter().map(|m| m.name().to_owned());
    names.map(|n| (n, Vec::new())).collect()
}

/// Adds what was said at one value to the row of each method.
pub(super) fn add(rows: &mut [(String, Vec<RightTally>)], found: &[Replies]) {
    for (i, row) in rows.iter_mut().enumerate() {
        let mut tally = RightTally::default();
        for (at, asked) in found.iter().enumerate() {
            asked.right[i].into_iter().for_each(|ok| tally.add(at, ok));
        }
        row.1.push(tally);
    }
}

/// What the automatic choice said, counted.
pub(super) fn auto<'a>(found: impl IntoIterator<Item = &'a Replies>) -> AnswerCount {
    let mut count = AnswerCount::default();
    for asked in found {
        count.add(asked.auto, || asked.text.replace('\n', " "));
    }
    count
}
