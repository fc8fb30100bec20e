//! Right answers of several methods over a range of one quantity.

use crate::accuracy::csv::Csv;
use crate::accuracy::words::scientific;
use crate::chart::{Axis, Band, Bands, Chart, Kind, Scale, Series, Style};

/// Right answers of how many.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// Right ones.
    pub right: usize,
    /// All asked for.
    pub of: usize,
}

impl Tally {
    /// Counts one more.
    pub fn add(&mut self, right: bool) {
        self.right += usize::from(right);
        self.of += 1;
    }

    /// Counts what another tally has counted.
    pub fn join(&mut self, other: Tally) {
        self.right += other.right;
        self.of += other.of;
    }

    /// The share of right ones, 0 of none.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "counts are small")]
    pub fn share(self) -> f64 {
        self.right as f64 / self.of.max(1) as f64
    }

    fn kind(self) -> Kind {
        match self.share() {
            _ if self.of == 0 => Kind::None,
            _ if self.right == self.of => Kind::Good,
            s if s >= 0.9 => Kind::Warn,
            _ => Kind::Bad,
        }
    }
}

/// Tallies over a range.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// What is shown.
    pub title: String,
    /// The axis across, logarithmic.
    pub x: String,
    /// Its head in CSV.
    pub column: &'static str,
    /// Where it was looked at, ascending.
    pub values: Vec<f64>,
    /// Names with a tally for each value.
    pub rows: Vec<(String, Vec<Tally>)>,
}

/// Bands about the values of a log axis, neighbours of one kind as one.
#[must_use]
pub fn bands(values: &[f64], kinds: impl IntoIterator<Item = Kind>) -> Vec<Band> {
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

impl Sweep {
    /// The longest stretch of values over which a row is right throughout.
    #[must_use]
    pub fn region(&self, row: usize) -> Option<(f64, f64)> {
        let tallies = &self.rows[row].1;
        let mut best: Option<(usize, usize)> = None;
        let mut begun = None;
        for (n, tally) in tallies.iter().enumerate() {
            if tally.of == 0 || tally.right < tally.of {
                begun = None;
                continue;
            }
            let from = *begun.get_or_insert(n);
            if best.is_none_or(|(a, b)| n - from > b - a) {
                best = Some((from, n));
            }
        }
        best.map(|(a, b)| (self.values[a], self.values[b]))
    }

    /// "1e-12 to 1e-6", or "nowhere".
    #[must_use]
    pub fn region_in_words(&self, row: usize) -> String {
        match self.region(row) {
            Some((a, b)) if a < b => format!("{} to {}", scientific(a), scientific(b)),
            Some((a, _)) => format!("{} alone", scientific(a)),
            None => "nowhere".to_owned(),
        }
    }

    /// Where a row is right in all cases, and its best and worst shares: "is right in all cases from 1e-12 to 1e-6,
    /// and in 45 % to 100 % over the whole range".
    #[must_use]
    pub fn least_in_words(&self, row: usize) -> String {
        let shares = || self.rows[row].1.iter().map(|t| 100.0 * t.share());
        let (low, high) = (
            shares().fold(f64::MAX, f64::min).floor(),
            shares().fold(0.0, f64::max).floor(),
        );
        match self.region(row) {
            Some(_) => format!(
                "is right in all from {}, elsewhere in as few as {low:.0} %",
                self.region_in_words(row)
            ),
            None => format!("is right in {low:.0} to {high:.0} % and nowhere in all"),
        }
    }

    /// The row of a name.
    #[must_use]
    pub fn row(&self, name: &str) -> Option<usize> {
        self.rows.iter().position(|r| r.0 == name)
    }

    /// Where each row is right on all, on at least nine in ten, on fewer.
    #[must_use]
    pub fn bands(&self, subtitle: &str) -> Bands {
        Bands {
            title: self.title.clone(),
            subtitle: subtitle.to_owned(),
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

    /// The share of right answers.
    #[must_use]
    pub fn chart(&self, subtitle: &str) -> Chart {
        Chart {
            title: self.title.clone(),
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
    pub fn csv(&self) -> String {
        let mut csv = Csv::new(&["method", self.column, "right", "of", "share"]);
        for (name, tallies) in &self.rows {
            for (x, t) in self.values.iter().zip(tallies) {
                csv.row(&[
                    name.clone(),
                    format!("{x:e}"),
                    t.right.to_string(),
                    t.of.to_string(),
                    format!("{:.4}", t.share()),
                ]);
            }
        }
        csv.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(right: [usize; 4]) -> Sweep {
        Sweep {
            title: String::new(),
            x: String::new(),
            column: "x",
            values: vec![1e-3, 1e-2, 1e-1, 1.0],
            rows: vec![(
                "m".to_owned(),
                right.map(|right| Tally { right, of: 10 }).to_vec(),
            )],
        }
    }

    #[test]
    fn the_region_is_the_longest_stretch_without_a_mistake() {
        assert_eq!(sweep([10, 9, 10, 10]).region(0), Some((1e-1, 1.0)));
        assert_eq!(sweep([10, 10, 10, 3]).region_in_words(0), "1e−3 to 1e−1");
        assert_eq!(sweep([1, 9, 0, 3]).region_in_words(0), "nowhere");
    }

    #[test]
    fn bands_meet_half_way_and_hold_their_verdict() {
        let b = bands(
            &sweep([10, 10, 9, 3]).values,
            [Kind::Good, Kind::Good, Kind::Warn, Kind::Bad],
        );
        assert_eq!(b.len(), 3);
        assert_eq!(b[0].0, 1e-3);
        assert_eq!(b[0].1, b[1].0);
        assert_eq!(b[2].1, 1.0);
    }
}
