//! One study: a range of one quantity, cases at each of its values, the questions about each case, and the truth. All studies have the
//! same loop, the same tally, the same table, one chart and one conclusion.

mod conclusion;

use crate::accuracy::said::{Reply, Said, Tally};
use crate::accuracy::timing::{Clock, quantile};
use crate::chart::{Axis, Band, Bands, Chart, Scale, Series, Style, VerdictKind};
use crate::format::csv;
use rayon::prelude::*;

/// How much to do.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Coarse steps and part of the mechanisms.
    pub quick: bool,
    /// Seed of the noise.
    pub seed: u64,
    /// What times are taken by.
    pub clock: Clock,
}

/// Receives the current study, the number of finished steps and the number of all steps.
pub type Progress<'a> = &'a mut dyn FnMut(&str, usize, usize);

/// How a study is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// The values for which each row is right.
    Regions,
    /// The shares of answers that are right, and of those that are wrong and sure.
    Shares,
    /// The share of answers that are right, and where it is largest.
    Best,
    /// The time of each row, asked one after another.
    Times,
    /// The time of each row as a multiple of another, asked one after another.
    Ratios,
    /// The share of wrong answers of each row by decades, with the bound of Schwartz and Zippel, which is this degree over the prime.
    /// The answers are timed.
    Errors(u32),
}

/// A study.
#[derive(Debug, Clone)]
pub struct Study {
    /// The stem of its files.
    pub name: &'static str,
    /// What was varied.
    pub title: &'static str,
    /// The axis across, with its unit.
    pub axis: &'static str,
    /// Its head in the table.
    pub column: &'static str,
    /// The values of the quantity, ascending.
    pub values: Vec<f64>,
    /// How it is drawn.
    pub view: View,
    /// Advice to the user.
    pub advice: &'static str,
    /// The name of each row, with its tally at each value.
    pub(super) rows: Vec<(String, Vec<Tally>)>,
}

impl Study {
    /// Asks about the given number of cases at each value. `ask` returns a reply for each row, `None` if it has none. Cases run in
    /// parallel unless they are timed.
    pub(super) fn asked(
        mut self,
        rows: impl IntoIterator<Item = impl ToString>,
        cases: usize,
        progress: Progress<'_>,
        ask: impl Fn(usize, usize) -> Vec<Option<Reply>> + Sync,
    ) -> Study {
        let rows = rows.into_iter().map(|r| (r.to_string(), Vec::new()));
        self.rows = rows.collect();
        for v in 0..self.values.len() {
            progress(self.title, v, self.values.len());
            let found: Vec<Vec<Option<Reply>>> = if self.is_timed() {
                (0..cases).map(|case| ask(v, case)).collect()
            } else {
                (0..cases)
                    .into_par_iter()
                    .map(|case| ask(v, case))
                    .collect()
            };
            for (n, row) in self.rows.iter_mut().enumerate() {
                let mut tally = Tally::default();
                let replies = found.iter().filter_map(|f| f.get(n)?.as_ref());
                replies.for_each(|reply| tally.add(reply));
                row.1.push(tally);
            }
        }
        self
    }

    fn is_timed(&self) -> bool {
        matches!(self.view, View::Times | View::Ratios | View::Errors(_))
    }

    /// Returns the table, with a line for each row and each value that has replies.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut heads = vec!["asked", self.column, "cases", "right", "undecided"];
        heads.extend(["wrong_not_exact", "wrong_and_sure", "wrong"]);
        let timed = self.is_timed();
        heads.extend(timed.then_some("median_seconds"));
        let rows = self.rows.iter().flat_map(|(name, tallies)| {
            self.asked_of(tallies).map(move |(x, t)| {
                let mut row = vec![name.clone(), format!("{x:e}"), t.total().to_string()];
                row.extend(t.of.map(|n| n.to_string()));
                row.push(t.wrong.join("; ").replace('\n', " "));
                row.extend(timed.then(|| format!("{:.3e}", quantile(&t.seconds, 0.5))));
                row
            })
        });
        csv::table(&heads, rows)
    }

    /// Returns the chart as SVG.
    #[must_use]
    pub fn svg(&self) -> String {
        let share = |said: Said| move |t: &Tally| t.percent(said);
        match self.view {
            View::Regions => return self.regions().svg(),
            View::Shares => {
                let mut series = self.lines("", Style::Line, share(Said::Right));
                let sure = self.lines(", wrong and sure", Style::Dashed, share(Said::Wrong));
                series.extend(sure.into_iter().filter(|s| s.points.iter().any(|p| p.1 > 0.0)));
                let about = "Solid: right. Dashed, if there are any: wrong and sure. The rest is undecided, or wrong but reported as \
                             not exact.";
                self.chart(about.to_owned(), "share of answers, %", Scale::Linear, series)
            }
            View::Best => {
                let series = self.lines("", Style::Line, share(Said::Right));
                self.chart(String::new(), "right answers, %", Scale::Linear, series)
            }
            View::Times | View::Ratios => {
                let series = self.lines("", Style::Line, |t| quantile(&t.seconds, 0.5));
                let up = match self.view {
                    View::Times => "time of an answer, s",
                    _ => "times as long",
                };
                let about = "Median over the cases that a row applies to.".to_owned();
                self.chart(about, up, Scale::Log, series)
            }
            View::Errors(degree) => {
                let mut series = self.lines("", Style::Line, share(Said::Wrong));
                series.push(Series {
                    name: "bound for random points".to_owned(),
                    points: self.values.iter().map(|b| (*b, bound(degree, *b))).collect(),
                    style: Style::Dashed,
                });
                let about = format!("Share of wrong ranks. Bound of Schwartz and Zippel: {degree} over the least prime of each size.");
                self.chart(about, "wrong ranks, %", Scale::LogAndZero(-3), series)
            }
        }
        .svg()
    }

    fn scale(&self) -> Scale {
        match self.view {
            View::Errors(_) => Scale::Linear,
            _ => Scale::Log,
        }
    }

    fn x(&self) -> Axis {
        Axis {
            label: self.axis.to_owned(),
            scale: self.scale(),
        }
    }

    /// Returns a line for each row through the values that have replies.
    fn lines(&self, after: &str, style: Style, y: impl Fn(&Tally) -> f64) -> Vec<Series> {
        let line = |(name, tallies): &(String, Vec<Tally>)| Series {
            name: format!("{name}{after}"),
            points: self.asked_of(tallies).map(|(x, t)| (x, y(t))).collect(),
            style,
        };
        self.rows.iter().map(line).collect()
    }

    fn asked_of<'a>(&'a self, of: &'a [Tally]) -> impl Iterator<Item = (f64, &'a Tally)> {
        let values = self.values.iter().copied().zip(of);
        values.filter(|(_, t)| t.total() > 0)
    }

    fn chart(&self, subtitle: String, up: &str, scale: Scale, series: Vec<Series>) -> Chart {
        Chart {
            title: self.title.to_owned(),
            subtitle,
            x: self.x(),
            y: Axis {
                label: up.to_owned(),
                scale,
            },
            series,
        }
    }

    fn regions(&self) -> Bands {
        let kind = |t: &Tally| match t.percent(Said::Right) {
            _ if t.total() == 0 => VerdictKind::None,
            100.0 => VerdictKind::Good,
            right if right + t.percent(Said::Open) >= 90.0 => VerdictKind::Warn,
            _ => VerdictKind::Bad,
        };
        let row = |(name, t): &(String, Vec<Tally>)| {
            (name.clone(), bands(&self.values, t.iter().map(kind)))
        };
        Bands {
            title: self.title.to_owned(),
            subtitle: "Right: in all cases; in doubt: right or undecided in nine of ten or more; wrong: in fewer."
                .to_owned(),
            x: self.x(),
            rows: self.rows.iter().map(row).collect(),
        }
    }
}

/// Returns the bound of Schwartz and Zippel in per cent, for a prime of the given number of bits.
fn bound(degree: u32, bits: f64) -> f64 {
    (100.0 * f64::from(degree) / (bits - 1.0).exp2()).min(100.0)
}

/// Returns bands around the values of a log axis. Neighbours of the same kind are one band.
fn bands(values: &[f64], kinds: impl IntoIterator<Item = VerdictKind>) -> Vec<Band> {
    let between = |a: usize, b: usize| (values[a] * values[b]).sqrt();
    let last = values.len().saturating_sub(1);
    let mut out: Vec<Band> = Vec::new();
    for (n, kind) in kinds.into_iter().enumerate() {
        let (from, to) = (
            between(n.saturating_sub(1), n),
            between(n, (n + 1).min(last)),
        );
        match out.last_mut() {
            Some(last) if last.2 == kind => last.1 = to,
            _ => out.push((from, to, kind)),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_meet_half_way_and_hold_their_verdict() {
        let kinds = [
            VerdictKind::Good,
            VerdictKind::Good,
            VerdictKind::Warn,
            VerdictKind::Bad,
        ];
        let b = bands(&[1e-3, 1e-2, 1e-1, 1.0], kinds);
        assert_eq!((b.len(), b[0].0, b[2].1), (3, 1e-3, 1.0));
        assert_eq!(b[0].1, b[1].0);
    }
}
