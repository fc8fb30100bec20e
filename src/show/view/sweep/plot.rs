//! A quantity of a sweep over two of its parameters, or over its only one.

use super::SweepData;
use crate::chart::{Axis, Chart, Contours, Scale, Series, Style};
use crate::sweep::row::SampleRow;
use itertools::Itertools;
use std::collections::BTreeMap;
use thiserror::Error;

/// What is plotted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlottedQuantity {
    /// σ of the first state.
    Redundant,
    /// W of the first state.
    Mobility,
    /// The greatest joint force as built.
    PeakForce,
    /// The cost of the best redesign.
    BestCost,
}

impl PlottedQuantity {
    /// All, by their words.
    pub const ALL: [(&'static str, PlottedQuantity); 4] = [
        ("redundant", PlottedQuantity::Redundant),
        ("mobility", PlottedQuantity::Mobility),
        ("force", PlottedQuantity::PeakForce),
        ("best-cost", PlottedQuantity::BestCost),
    ];

    fn label(self) -> &'static str {
        match self {
            PlottedQuantity::Redundant => "redundant constraints σ",
            PlottedQuantity::Mobility => "mobility W",
            PlottedQuantity::PeakForce => "peak force, N",
            PlottedQuantity::BestCost => "cost of the best redesign",
        }
    }

    /// Whether it goes in steps, so that there is nothing between two of its values.
    fn is_count(self) -> bool {
        self != PlottedQuantity::PeakForce
    }

    #[allow(clippy::cast_precision_loss, reason = "counts are small")]
    fn of(self, row: &SampleRow) -> Option<f64> {
        let count = |n: usize| n as f64;
        match self {
            PlottedQuantity::Redundant => Some(count(row.states.first()?.redundant)),
            PlottedQuantity::Mobility => Some(count(row.states.first()?.mobility)),
            PlottedQuantity::PeakForce => {
                let found = row.forces.as_ref()?.get()?;
                found.complete.then_some(found.peak_force)
            }
            PlottedQuantity::BestCost => Some(row.redesigns.as_ref()?.get()?.ranking.first()?.cost),
        }
    }
}

/// A plot.
#[derive(Debug, Clone, PartialEq)]
pub enum Plotted {
    /// Over two parameters.
    Two(Contours),
    /// Over one.
    One(Chart),
}

impl Plotted {
    /// As SVG.
    #[must_use]
    pub fn svg(&self) -> String {
        match self {
            Plotted::Two(plot) => plot.svg(),
            Plotted::One(plot) => plot.svg(),
        }
    }
}

/// Why there is no plot.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("--over takes one or two of the parameters that vary, such as {known}; not {asked}")]
pub struct NoPlot {
    asked: String,
    known: String,
}

impl SweepData<'_> {
    /// A quantity over two parameters, the first two that vary where none are named, or over one. Of samples that differ in other
    /// parameters alone the greatest value is shown.
    ///
    /// # Errors
    /// Where a name is none of a parameter that varies, or there are not one or two.
    pub fn plot(&self, what: PlottedQuantity, over: &[String]) -> Result<Plotted, NoPlot> {
        let named = self.named(over)?;
        let (places, merged) = self.greatest_at(what, &named);
        let title = format!("{}: {}", self.mechanism, what.label());
        let mut rest = self.parameters.keys().filter(|n| !named.contains(n));
        let rest = rest.join(", ");
        let greatest = if merged {
            format!(" Of samples that differ in {rest} alone, the greatest.")
        } else {
            String::new()
        };
        let axis = |name: &str| Axis {
            label: name.to_owned(),
            scale: Scale::Linear,
        };
        let count = places.len();
        let places = places.into_iter();
        Ok(match &named[..] {
            [x, y] => {
                let lines = if what.is_count() {
                    ""
                } else {
                    " Lines are read between the samples."
                };
                Plotted::Two(Contours {
                    title,
                    subtitle: format!("At {count} places, {}.{lines}{greatest}", self.sampling),
                    x: axis(x),
                    y: axis(y),
                    value: what.label().to_owned(),
                    samples: places.map(|(at, v)| (at[0], at[1], v)).collect(),
                    counts: what.is_count(),
                })
            }
            one => Plotted::One(Chart {
                title,
                subtitle: format!("At {count} places, {}.{greatest}", self.sampling),
                x: axis(one[0]),
                y: axis(what.label()),
                series: vec![Series {
                    name: String::new(),
                    points: places
                        .map(|(at, v)| (at[0], v))
                        .sorted_by(|a, b| a.0.total_cmp(&b.0))
                        .collect(),
                    style: Style::Points,
                }],
            }),
        })
    }

    /// The parameters that a plot goes over: the first two that vary where none are named.
    fn named<'a>(&'a self, over: &'a [String]) -> Result<Vec<&'a String>, NoPlot> {
        let known: Vec<&String> = self.parameters.keys().collect();
        let named: Vec<&String> = match over {
            [] => known.iter().copied().take(2).collect(),
            names => names.iter().collect(),
        };
        let unknown = named.iter().any(|n| !known.contains(n));
        if unknown || named.is_empty() || named.len() > 2 || !named.iter().all_unique() {
            return Err(NoPlot {
                asked: over.iter().join(","),
                known: known.iter().take(2).join(","),
            });
        }
        Ok(named)
    }

    /// The greatest value at each place in some parameters, and whether several samples with a value are in one place.
    fn greatest_at(
        &self,
        what: PlottedQuantity,
        named: &[&String],
    ) -> (Vec<(Vec<f64>, f64)>, bool) {
        let mut values: BTreeMap<Vec<u64>, (Vec<f64>, f64)> = BTreeMap::new();
        let mut merged = false;
        for row in &self.table.rows {
            let at: Vec<f64> = named.iter().map(|n| row.at[*n]).collect();
            let key = at.iter().map(|x| x.to_bits()).collect();
            let value = what.of(row).unwrap_or(f64::NAN);
            let there = values.entry(key).or_insert((at, f64::NAN));
            merged |= !there.1.is_nan();
            // The greater of two, and of a number and none the number.
            there.1 = there.1.max(value);
        }
        (values.into_values().collect(), merged)
    }
}
