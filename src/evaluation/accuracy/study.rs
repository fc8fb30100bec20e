//! One study: a range of one quantity, cases at each of its values, the questions about each case, and the truth. All studies, the survey
//! and the comparison of searches have the same tally, the same table, one chart and one conclusion.

mod conclusion;

pub use super::said::Figure;
use super::said::{Reply, Said, Tally};
use super::timing::Clock;
use crate::chart::{Axis, Band, Bands, Chart, Scale, Series, Style, VerdictKind, page};
use crate::format::csv;
use crate::score::outcome::pareto::front;
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;

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
    /// A point for each value of a row: a figure against its median time.
    Against(Figure),
}

/// The name of a row, with its tally at each of its values.
pub(super) type Row = (String, Vec<(f64, Tally)>);

/// The texts of a study.
#[derive(Debug, Clone, Deserialize)]
pub struct Texts {
    /// The title.
    pub title: String,
    /// The axis across, with its unit.
    axis: String,
    /// The head of the values in the table.
    column: String,
    /// Advice to the user.
    pub(super) advice: String,
}

/// The texts of each study by the stem of its files.
static TEXTS: LazyLock<BTreeMap<String, Texts>> =
    LazyLock::new(|| toml::from_str(include_str!("studies.toml")).expect("the texts are valid"));

/// A study.
#[derive(Debug, Clone)]
pub struct Study {
    /// The stem of its files.
    pub name: &'static str,
    /// Its texts.
    pub texts: Texts,
    /// The values of the quantity, ascending.
    pub values: Vec<f64>,
    /// How it is drawn.
    pub view: View,
    /// The rows.
    pub(super) rows: Vec<Row>,
}

impl Study {
    /// Returns a study without answers, which has texts by its name.
    pub(super) fn new(name: &'static str, values: Vec<f64>, view: View) -> Study {
        Study {
            name,
            texts: TEXTS[name].clone(),
            values,
            view,
            rows: Vec::new(),
        }
    }

    /// Asks about the given number of cases at each value. `ask` returns a reply for each row, `None` if it has none. Cases run in
    /// parallel unless they are timed.
    pub(super) fn ask_cases(
        mut self,
        rows: impl IntoIterator<Item = impl ToString>,
        cases: usize,
        progress: Progress<'_>,
        ask: impl Fn(usize, usize) -> Vec<Option<Reply>> + Sync,
    ) -> Study {
        let rows = rows.into_iter().map(|r| (r.to_string(), Vec::new()));
        self.rows = rows.collect();
        for v in 0..self.values.len() {
            progress(&self.texts.title, v, self.values.len());
            let found: Vec<Vec<Option<Reply>>> = if self.is_timed() {
                (0..cases).map(|case| ask(v, case)).collect()
            } else {
                let cases = (0..cases).into_par_iter();
                cases.map(|case| ask(v, case)).collect()
            };
            for (n, row) in self.rows.iter_mut().enumerate() {
                let replies = found.iter().filter_map(|f| f.get(n)?.as_ref());
                row.1.push((self.values[v], Tally::of(replies)));
            }
        }
        self
    }

    /// Adds a tally to a row, which is new if none has its name.
    pub(super) fn add_tally(&mut self, row: &str, value: f64, tally: Tally) {
        match self.rows.iter_mut().find(|r| r.0 == row) {
            Some(row) => row.1.push((value, tally)),
            None => self.rows.push((row.to_owned(), vec![(value, tally)])),
        }
    }

    fn is_timed(&self) -> bool {
        !matches!(self.view, View::Regions | View::Shares | View::Best)
    }

    /// Returns the table, with a line for each row and each value that has replies.
    pub fn to_csv(&self) -> String {
        let mut heads = vec![
            "asked",
            self.texts.column.as_str(),
            "cases",
            "right",
            "undecided",
        ];
        heads.extend(["wrong_not_exact", "wrong_and_sure", "wrong"]);
        heads.extend(self.is_timed().then_some("median_seconds"));
        let own = matches!(self.view, View::Against(Figure::Own(..)));
        heads.extend(own.then_some("figure"));
        let rows = self.rows.iter().flat_map(|(name, tallies)| {
            asked_of(tallies).map(move |(x, t)| {
                let mut row = vec![
                    name.clone(),
                    format!("{x:e}"),
                    t.count_replies().to_string(),
                ];
                row.extend(t.of.map(|n| n.to_string()));
                row.push(t.wrong.join("; ").replace('\n', " "));
                row.extend(self.is_timed().then(|| format!("{:.3e}", t.median_time())));
                row.extend(own.then(|| format!("{:.3e}", t.figure)));
                row
            })
        });
        csv::write_table(&heads, rows)
    }

    /// Returns the chart as SVG.
    pub fn to_svg(&self) -> String {
        let share = |said: Said| move |t: &Tally| t.percent_of(said);
        let x = |scale| Axis {
            label: self.texts.axis.clone(),
            scale,
        };
        let chart = |about: &str, across, up: &str, scale, series| Chart {
            title: self.texts.title.clone(),
            subtitle: about.to_owned(),
            x: x(across),
            y: Axis {
                label: up.to_owned(),
                scale,
            },
            series,
        };
        let mut series = self.draw_lines("", Style::Line, share(Said::Right));
        match self.view {
            View::Regions => return self.draw_regions(x(Scale::Log)).svg(),
            View::Shares => {
                let sure = self.draw_lines(", wrong and sure", Style::Dashed, share(Said::Wrong));
                series.extend(sure.into_iter().filter(|s| s.points.iter().any(|p| p.1 > 0.0)));
                let about = "Solid: right. Dashed, if there are any: wrong and sure. The rest is undecided, or wrong but reported as \
                             not exact.";
                chart(about, Scale::Log, "share of answers, %", Scale::Linear, series)
            }
            View::Best => chart("", Scale::Log, "right answers, %", Scale::Linear, series),
            View::Times | View::Ratios => {
                let series = self.draw_lines("", Style::Line, Tally::median_time);
                let up = match self.view {
                    View::Times => "time of an answer, s",
                    _ => "times as long",
                };
                let about = "Median over the cases that a row applies to.";
                chart(about, Scale::Log, up, Scale::Log, series)
            }
            View::Errors(degree) => {
                let mut series = self.draw_lines("", Style::Line, share(Said::Wrong));
                series.push(Series {
                    name: "bound for random points".to_owned(),
                    points: self.values.iter().map(|b| (*b, error_bound(degree, *b))).collect(),
                    style: Style::Dashed,
                });
                let about = format!("Share of wrong ranks. Bound of Schwartz and Zippel: {degree} over the least prime of each size.");
                chart(&about, Scale::Linear, "wrong ranks, %", Scale::LogAndZero(-3), series)
            }
            View::Against(figure) => {
                let (about, up, scale) = match figure {
                    Figure::Right => ("", "right answers of all cases, %", Scale::Linear),
                    Figure::Wrong => ("A point for each mechanism and way.", "wrong, %", Scale::LogAndZero(-2)),
                    Figure::Own(up, zero) => ("", up, Scale::LogAndZero(zero)),
                };
                chart(about, Scale::Log, up, scale, self.points_over_time(figure))
            }
        }
        .svg()
    }

    /// Returns the points of each row over their times. Own figures of several values are lines.
    fn points_over_time(&self, figure: Figure) -> Vec<Series> {
        let point = |t: &Tally| (t.median_time(), t.figure_of(figure));
        let row = |(name, tallies): &Row| {
            let points: Vec<_> = asked_of(tallies).map(|(_, t)| point(t)).collect();
            Series {
                name: name.clone(),
                style: match figure {
                    Figure::Own(..) if points.len() < 2 => Style::Points,
                    Figure::Own(..) if name.contains(',') => Style::Dashed,
                    Figure::Own(..) => Style::Line,
                    _ => Style::Points,
                },
                points,
            }
        };
        let mut series: Vec<Series> = self.rows.iter().map(row).collect();
        if figure == Figure::Right {
            let mut points: Vec<_> = self
                .pareto_rows()
                .into_iter()
                .map(|(_, t)| point(t))
                .collect();
            let slowest = series
                .iter()
                .flat_map(|s| &s.points)
                .map(|p| p.0)
                .fold(0.0, f64::max);
            points.extend(points.last().map(|p| (slowest, p.1)));
            let front = Series {
                name: "Pareto front".to_owned(),
                points,
                style: Style::Steps,
            };
            series.insert(0, front);
        }
        series
    }

    /// Returns the rows of one value that no other one beats in both share and time, the fastest first.
    fn pareto_rows(&self) -> Vec<(&str, &Tally)> {
        let rows = self
            .rows
            .iter()
            .filter_map(|(name, t)| Some((name.as_str(), &t.first()?.1)));
        let rows: Vec<_> = rows.collect();
        let points: Vec<_> = rows
            .iter()
            .map(|(_, t)| (t.median_time(), t.percent_of(Said::Right)))
            .collect();
        front(&points).into_iter().map(|i| rows[i]).collect()
    }

    /// Returns a line for each row through the values that have replies.
    fn draw_lines(&self, after: &str, style: Style, y: impl Fn(&Tally) -> f64) -> Vec<Series> {
        let line = |(name, tallies): &Row| Series {
            name: format!("{name}{after}"),
            points: asked_of(tallies).map(|(x, t)| (x, y(t))).collect(),
            style,
        };
        self.rows.iter().map(line).collect()
    }

    fn draw_regions(&self, x: Axis) -> Bands {
        let kind = |t: &Tally| match t.percent_of(Said::Right) {
            _ if t.count_replies() == 0 => VerdictKind::None,
            100.0 => VerdictKind::Good,
            right if right + t.percent_of(Said::Open) >= 90.0 => VerdictKind::Warn,
            _ => VerdictKind::Bad,
        };
        let row = |(name, tallies): &Row| {
            (
                name.clone(),
                verdict_bands(&self.values, tallies.iter().map(|(_, t)| kind(t))),
            )
        };
        Bands {
            title: self.texts.title.clone(),
            subtitle: "Right: in all cases; in doubt: right or undecided in nine of ten or more; wrong: in fewer."
                .to_owned(),
            x,
            rows: self.rows.iter().map(row).collect(),
        }
    }
}

/// Returns the values of a row that have replies.
fn asked_of(of: &[(f64, Tally)]) -> impl Iterator<Item = (f64, &Tally)> {
    of.iter()
        .map(|(x, t)| (*x, t))
        .filter(|(_, t)| t.count_replies() > 0)
}

/// Returns the bound of Schwartz and Zippel in per cent, for a prime of the given number of bits.
fn error_bound(degree: u32, bits: f64) -> f64 {
    (100.0 * f64::from(degree) / (bits - 1.0).exp2()).min(100.0)
}

/// Returns bands around the values of a log axis. Neighbours of the same kind are one band.
fn verdict_bands(values: &[f64], kinds: impl IntoIterator<Item = VerdictKind>) -> Vec<Band> {
    let between = |a: usize, b: usize| (values[a] * values[b]).sqrt();
    let last = values.len().saturating_sub(1);
    let mut out: Vec<Band> = Vec::new();
    for (n, kind) in kinds.into_iter().enumerate() {
        let from = between(n.saturating_sub(1), n);
        let to = between(n, (n + 1).min(last));
        match out.last_mut() {
            Some(last) if last.2 == kind => last.1 = to,
            _ => out.push((from, to, kind)),
        }
    }
    out
}

/// Returns the names and texts of all files of some studies and further tables. `index.html` is the last, so that it exists only after the
/// files that it shows. `made` says how they were made.
pub fn page_files(
    title: &str,
    made: &str,
    studies: &[Study],
    tables: Vec<(String, String)>,
) -> Vec<(String, String)> {
    let mut files = tables;
    let mut parts = Vec::new();
    for study in studies {
        let sentence = format!("{} What to do: {}", study.conclusion(), study.texts.advice);
        let (name, svg) = (study.name, study.to_svg());
        let link = format!("<p><a href=\"{name}.csv\">{name}.csv</a></p>");
        parts.push((study.texts.title.clone(), sentence, svg.clone() + &link));
        files.push((format!("{name}.csv"), study.to_csv()));
        files.push((format!("{name}.svg"), svg));
    }
    parts.push((
        "How this was made".to_owned(),
        made.to_owned(),
        String::new(),
    ));
    files.push(("index.html".to_owned(), page(title, &parts)));
    files
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
        let b = verdict_bands(&[1e-3, 1e-2, 1e-1, 1.0], kinds);
        assert_eq!((b.len(), b[0].0, b[2].1), (3, 1e-3, 1.0));
        assert_eq!(b[0].1, b[1].0);
    }
}
