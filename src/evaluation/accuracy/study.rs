//! One study: a range of one quantity, cases at each of its values, the questions about each case, and the truth. All studies, the survey
//! and the comparison of searches have the same tally, the same table, one chart and one conclusion.

mod conclusion;

use super::said::{Reply, Said, Tally};
use super::timing::Clock;
use crate::chart::{Axis, Chart, Scale, Series, Style, page};
use crate::format::{csv, round_digits};
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

/// How a study is drawn. All but the first two are timed: their cases are asked one after another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum View {
    /// The shares of answers that are right.
    Right,
    /// The shares of answers that are right, and of those that are wrong and sure.
    Shares,
    /// The time of each row.
    Times,
    /// The share of wrong answers.
    Errors,
    /// The share of right answers against the time, with the front of what is fastest and most often right.
    Front,
    /// The share of wrong answers against the time, or the figures of the tallies.
    Points,
}

/// The name of a row, with its tally at each of its values.
pub type Row = (String, Vec<(f64, Tally)>);

/// The texts of a study, and how it is drawn; `studies.toml` says more.
#[derive(Debug, Clone, Deserialize)]
pub struct Texts {
    /// The title.
    pub title: String,
    #[serde(default)]
    about: String,
    view: View,
    across: String,
    #[serde(default)]
    up: String,
    #[serde(default)]
    even: bool,
    zero: Option<i32>,
    column: String,
    at: Option<f64>,
    #[serde(default)]
    lead: String,
    #[serde(default = "said_words")]
    words: [String; 4],
    /// Advice to the user.
    pub advice: String,
}

fn said_words() -> [String; 4] {
    [
        "right",
        "undecided",
        "wrong but said not exact",
        "wrong and sure",
    ]
    .map(str::to_owned)
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
    /// The rows.
    pub rows: Vec<Row>,
    /// A further sentence for the conclusion, or empty.
    pub note: String,
}

impl Study {
    /// Returns a study without answers, which has texts by its name.
    pub fn new(name: &'static str, values: Vec<f64>) -> Study {
        Study {
            name,
            texts: TEXTS[name].clone(),
            values,
            rows: Vec::new(),
            note: String::new(),
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
    pub fn add_tally(&mut self, row: &str, value: f64, tally: Tally) {
        match self.rows.iter_mut().find(|r| r.0 == row) {
            Some(row) => row.1.push((value, tally)),
            None => self.rows.push((row.to_owned(), vec![(value, tally)])),
        }
    }

    fn is_timed(&self) -> bool {
        !matches!(self.texts.view, View::Right | View::Shares)
    }

    /// Returns the table, with a line for each row and each value that has replies.
    pub fn to_csv(&self) -> String {
        let mut heads = vec!["asked", self.texts.column.as_str(), "cases", "right"];
        heads.extend(["undecided", "wrong_not_exact", "wrong_and_sure", "wrong"]);
        heads.extend(self.is_timed().then_some("median_seconds"));
        let figures = |of: &[(f64, Tally)]| of.iter().any(|(_, t)| t.figure.is_some());
        let figures = self.rows.iter().any(|(_, t)| figures(t));
        heads.extend(figures.then_some("figure"));
        let rows = self.rows.iter().flat_map(|(name, tallies)| {
            replies_of(tallies).map(move |(x, t)| {
                let mut row = vec![name.clone(), format!("{:e}", round_digits(x, 12))];
                row.push(t.count_replies().to_string());
                row.extend(t.of.map(|n| n.to_string()));
                row.push(t.wrong.join("; ").replace('\n', " "));
                row.extend(self.is_timed().then(|| format!("{:.3e}", t.median_time())));
                let figure = || t.figure.map_or_else(String::new, |f| format!("{f:.3e}"));
                row.extend(figures.then(figure));
                row
            })
        });
        csv::write_table(&heads, rows)
    }

    /// Returns the figure of a tally that the chart shows.
    fn figure_of(&self, tally: &Tally) -> f64 {
        tally.figure.unwrap_or_else(|| match self.texts.view {
            View::Times => tally.median_time(),
            View::Errors | View::Points => tally.percent_of(Said::Wrong),
            _ => tally.percent_of(Said::Right),
        })
    }

    /// Returns the chart as SVG.
    pub fn to_svg(&self) -> String {
        let texts = &self.texts;
        let by_decades = |linear| if linear { Scale::Linear } else { Scale::Log };
        let x = Axis {
            label: texts.across.clone(),
            scale: by_decades(texts.even),
        };
        let scale = by_decades(texts.view != View::Times);
        let mut series = self.draw_rows("", |t| self.figure_of(t));
        if texts.view == View::Shares {
            let mut sure = self.draw_rows(", wrong and sure", |t| t.percent_of(Said::Wrong));
            sure.retain(|s| s.points.iter().any(|p| p.1 > 0.0));
            series.extend(sure);
        }
        if texts.view == View::Front {
            series.insert(0, self.draw_front());
        }
        Chart {
            title: texts.title.clone(),
            subtitle: texts.about.clone(),
            x,
            y: Axis {
                label: texts.up.clone(),
                scale: texts.zero.map_or(scale, Scale::LogAndZero),
            },
            series,
        }
        .svg()
    }

    /// Returns a line or points for each row. A row with a comma in its name is dashed.
    fn draw_rows(&self, after: &str, y: impl Fn(&Tally) -> f64) -> Vec<Series> {
        let over_time = matches!(self.texts.view, View::Front | View::Points);
        let x = |x: f64, t: &Tally| if over_time { t.median_time() } else { x };
        let row = |(name, tallies): &Row| {
            let name = format!("{name}{after}");
            let lone = tallies.len() < 2 || tallies.iter().all(|(_, t)| t.figure.is_none());
            Series {
                style: match name.contains(',') {
                    _ if over_time && lone => Style::Points,
                    true => Style::Dashed,
                    false => Style::Line,
                },
                points: replies_of(tallies).map(|(v, t)| (x(v, t), y(t))).collect(),
                name,
            }
        };
        self.rows.iter().map(row).collect()
    }

    /// Returns the line through the rows of the front.
    fn draw_front(&self) -> Series {
        let front = self.pareto_rows();
        let mut points: Vec<_> = front
            .iter()
            .map(|(_, t)| (t.median_time(), self.figure_of(t)))
            .collect();
        let times = self.rows.iter().flat_map(|(_, of)| of);
        let slowest = times.map(|(_, t)| t.median_time()).fold(0.0, f64::max);
        points.extend(points.last().map(|p| (slowest, p.1)));
        Series {
            name: "Pareto front".to_owned(),
            points,
            style: Style::Steps,
        }
    }

    /// Returns the rows of one value that no other one beats in both share and time, the fastest first.
    fn pareto_rows(&self) -> Vec<(&str, &Tally)> {
        let rows = self.rows.iter();
        let rows: Vec<_> = rows
            .filter_map(|(name, t)| Some((name.as_str(), &t.first()?.1)))
            .collect();
        let points: Vec<_> = rows
            .iter()
            .map(|(_, t)| (t.median_time(), t.percent_of(Said::Right)))
            .collect();
        front(&points).into_iter().map(|i| rows[i]).collect()
    }
}

/// Returns the indices of the points that are right more often than all faster ones, the fastest first. Points are (seconds,
/// share).
fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        let ((t, share), (u, other)) = (points[a], points[b]);
        t.total_cmp(&u).then(other.total_cmp(&share))
    });
    let mut best = f64::NEG_INFINITY;
    order.retain(|&i| {
        let ahead = points[i].1 > best;
        best = best.max(points[i].1);
        ahead
    });
    order
}

/// Returns the values of a row that have replies or a figure.
fn replies_of(of: &[(f64, Tally)]) -> impl Iterator<Item = (f64, &Tally)> {
    of.iter()
        .map(|(x, t)| (*x, t))
        .filter(|(_, t)| t.count_replies() > 0 || t.figure.is_some())
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
