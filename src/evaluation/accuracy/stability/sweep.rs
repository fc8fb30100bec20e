//! Right answers of several methods over a range of one quantity.

use crate::chart::{Axis, Band, Bands, Chart, Scale, Series, Style, VerdictKind};
use crate::format::{csv, list};

/// Right answers of how many, and whose were not.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct RightTally {
    /// Right ones.
    pub right: usize,
    /// All asked for.
    pub of: usize,
    /// The cases with an answer that is not right, ascending.
    pub missed: Vec<usize>,
}

impl RightTally {
    /// Counts an answer on a case; cases come in ascending order.
    pub(crate) fn add(&mut self, case: usize, right: bool) {
        self.right += usize::from(right);
        self.of += 1;
        if !right && self.missed.last() != Some(&case) {
            self.missed.push(case);
        }
    }

    /// The share of right ones, 0 of none.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "counts are small")]
    pub(crate) fn share(&self) -> f64 {
        self.right as f64 / self.of.max(1) as f64
    }

    fn kind(&self) -> VerdictKind {
        match self.share() {
            _ if self.of == 0 => VerdictKind::None,
            _ if self.right == self.of => VerdictKind::Good,
            s if s >= 0.9 => VerdictKind::Warn,
            _ => VerdictKind::Bad,
        }
    }
}

/// Tallies over a range.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TallySweep {
    /// What is shown.
    pub title: String,
    /// The axis across, logarithmic.
    pub x: String,
    /// Its head in CSV.
    pub column: &'static str,
    /// Where it was looked at, ascending.
    pub values: Vec<f64>,
    /// The names of the cases.
    pub cases: Vec<String>,
    /// Names with a tally for each value.
    pub rows: Vec<(String, Vec<RightTally>)>,
}

/// Where a row does best.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Region {
    /// The first value of the longest stretch.
    pub first: usize,
    /// Its last value.
    pub last: usize,
    /// The cases missed on that stretch.
    pub missed: Vec<usize>,
}

/// Bands about the values of a log axis, neighbours of one kind as one.
#[must_use]
pub(crate) fn bands(values: &[f64], kinds: impl IntoIterator<Item = VerdictKind>) -> Vec<Band> {
    let between = |a: usize, b: usize| (values[a] * values[b]).sqrt();
    let mut out: Vec<Band> = Vec::new();
    for (n, kind) in kinds.into_iter().enumerate().take(values.len()) {
        let from = if n == 0 { values[0] } else { between(n - 1, n) };
        let to = if n + 1 == values.len() {
            values[n]
        } else {
            between(n, n + 1)
        };
        match out.last_mut() {
            Some(last) if last.2 == kind => last.1 = to,
            _ => out.push((from, to, kind)),
        }
    }
    out
}

impl TallySweep {
    /// The longest stretch of values over which a row misses as few cases as it ever does, or `slack` more.
    #[must_use]
    pub(crate) fn region(&self, row: usize, slack: usize) -> Option<Region> {
        let tallies = &self.rows[row].1;
        let asked = tallies.iter().filter(|t| t.of > 0);
        let fewest = asked.map(|t| t.missed.len()).min()?;
        let good = |t: &RightTally| t.of > 0 && t.missed.len() <= fewest + slack;
        let (mut best, mut begun) = (None::<(usize, usize)>, None);
        for (n, tally) in tallies.iter().enumerate() {
            if !good(tally) {
                begun = None;
                continue;
            }
            let from = *begun.get_or_insert(n);
            if best.is_none_or(|(first, last)| n - from > last - first) {
                best = Some((from, n));
            }
        }
        let (first, last) = best?;
        let mut missed: Vec<usize> = tallies[first..=last]
            .iter()
            .flat_map(|t| t.missed.iter().copied())
            .collect();
        missed.sort_unstable();
        missed.dedup();
        Some(Region {
            first,
            last,
            missed,
        })
    }

    /// Whether the stretch is the whole range.
    #[must_use]
    pub(crate) fn is_whole(&self, region: &Region) -> bool {
        region.first == 0 && region.last + 1 == self.values.len()
    }

    /// "in all cases", "in all cases but door-two-hinges", or "in 91 of 117 cases".
    #[must_use]
    pub(crate) fn but(&self, missed: &[usize]) -> String {
        match missed.len() {
            0 => "in all cases".to_owned(),
            1..=3 => {
                let names: Vec<String> = missed.iter().map(|&c| self.cases[c].clone()).collect();
                format!("in all cases but {}", list(&names))
            }
            n => format!("in {} of {} cases", self.cases.len() - n, self.cases.len()),
        }
    }

    /// The row of a name.
    #[must_use]
    pub(crate) fn row(&self, name: &str) -> Option<usize> {
        self.rows.iter().position(|r| r.0 == name)
    }

    /// Where each row is right on all, on at least nine in ten, on fewer.
    #[must_use]
    pub(crate) fn bands(&self) -> Bands {
        Bands {
            title: self.title.clone(),
            subtitle: "Right: in all cases; in doubt: in nine of ten or more; wrong: in fewer."
                .to_owned(),
            x: self.axis(),
            rows: self
                .rows
                .iter()
                .map(|(name, t)| {
                    (
                        name.clone(),
                        bands(&self.values, t.iter().map(|t| t.kind())),
                    )
                })
                .collect(),
        }
    }

    /// The share of right answers as lines.
    #[must_use]
    pub(crate) fn chart(&self, title: &str, subtitle: &str) -> Chart {
        Chart {
            title: title.to_owned(),
            subtitle: subtitle.to_owned(),
            x: self.axis(),
            y: Axis {
                label: "share right, %".to_owned(),
                scale: Scale::Linear,
            },
            series: self
                .rows
                .iter()
                .map(|(name, tallies)| Series {
                    name: name.clone(),
                    points: self
                        .values
                        .iter()
                        .zip(tallies)
                        .map(|(x, t)| (*x, 100.0 * t.share()))
                        .collect(),
                    style: Style::Line,
                })
                .collect(),
        }
    }

    fn axis(&self) -> Axis {
        Axis {
            label: self.x.clone(),
            scale: Scale::Log,
        }
    }

    /// One line for each row and value.
    #[must_use]
    pub(crate) fn csv(&self) -> String {
        let rows = self.rows.iter().flat_map(|(name, tallies)| {
            self.values.iter().zip(tallies).map(move |(x, t)| {
                let missed: Vec<&str> = t.missed.iter().map(|&c| self.cases[c].as_str()).collect();
                [
                    name.clone(),
                    format!("{x:e}"),
                    t.right.to_string(),
                    t.of.to_string(),
                    format!("{:.4}", t.share()),
                    missed.join("; "),
                ]
            })
        });
        let heads = ["method", self.column, "right", "of", "share", "missed"];
        csv::table(&heads, rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten cases; those named are missed at each of four values.
    fn sweep(missed: [&[usize]; 4]) -> TallySweep {
        let tally = |missed: &[usize]| {
            let mut tally = RightTally::default();
            (0..10).for_each(|c| tally.add(c, !missed.contains(&c)));
            tally
        };
        TallySweep {
            title: String::new(),
            x: String::new(),
            column: "x",
            values: vec![1e-3, 1e-2, 1e-1, 1.0],
            cases: (0..10).map(|c| format!("c{c}")).collect(),
            rows: vec![("m".to_owned(), missed.map(tally).to_vec())],
        }
    }

    #[test]
    fn the_region_is_the_longest_stretch_with_the_fewest_misses() {
        let ends = |s: TallySweep| s.region(0, 0).map(|r| (r.first, r.last, s.but(&r.missed)));
        let all = || "in all cases".to_owned();
        assert_eq!(ends(sweep([&[], &[3], &[], &[]])), Some((2, 3, all())));
        assert_eq!(ends(sweep([&[], &[], &[], &[1]])), Some((0, 2, all())));
        let but = "in all cases but c3".to_owned();
        assert_eq!(ends(sweep([&[3], &[3], &[1, 3], &[2]])), Some((0, 1, but)));
        let slack = sweep([&[], &[3], &[2, 3], &[]]).region(0, 1);
        assert_eq!(
            slack.map(|r| (r.first, r.last, r.missed)),
            Some((0, 1, vec![3]))
        );
        let many = "in 6 of 10 cases".to_owned();
        assert_eq!(ends(sweep([&[1, 2, 3, 4]; 4])), Some((0, 3, many)));
    }

    #[test]
    fn bands_meet_half_way_and_hold_their_verdict() {
        let b = bands(
            &[1e-3, 1e-2, 1e-1, 1.0],
            [
                VerdictKind::Good,
                VerdictKind::Good,
                VerdictKind::Warn,
                VerdictKind::Bad,
            ],
        );
        assert_eq!(b.len(), 3);
        assert_eq!(b[0].0, 1e-3);
        assert_eq!(b[0].1, b[1].0);
        assert_eq!(b[2].1, 1.0);
    }
}
