//! A sweep as JSON, as text, as a flat table and as a plot; the keys of JSON are a stable contract.

mod csv;
pub mod plot;
mod text;

use crate::sweep::row::SampleRow;
use crate::sweep::summary::{Best, Peaks, Redundant, SampleTally, Summary};
use crate::sweep::table::Table;
use itertools::Itertools;
use serde::Serialize;
use std::collections::BTreeMap;

/// What a sweep found, in all.
#[derive(Debug, Serialize)]
pub struct SweepData<'a> {
    /// Name of the mechanism.
    pub mechanism: &'a str,
    /// What each parameter may be.
    pub parameters: &'a BTreeMap<String, Vec<String>>,
    /// The grid, or the sequence.
    pub sampling: &'a str,
    /// Which part of the sweep it is, such as "1/1".
    pub shard: &'a str,
    /// Samples of all parts.
    pub samples: usize,
    /// Samples that are done.
    pub done: usize,
    /// Whether that are all of this part.
    pub finished: bool,
    /// Samples that make no mechanism, by why.
    pub problems: Vec<Told<'a>>,
    /// σ, state by state.
    pub states: Vec<StateOverSamples<'a>>,
    /// The redesigns, where they were searched.
    pub redesigns: Option<RedesignsData<'a>>,
    /// The peak force, where there are loads.
    pub peak_force: Option<PeakForce<'a>>,
    /// What each rank method was worth, where that was asked: samples by the word.
    pub methods: BTreeMap<String, BTreeMap<String, usize>>,
    #[serde(skip)]
    table: &'a Table,
}

/// Something that some samples have.
#[derive(Debug, Serialize)]
pub struct Told<'a> {
    /// In words.
    pub what: String,
    /// How many.
    pub samples: usize,
    /// The first of them.
    pub first: &'a BTreeMap<String, f64>,
}

/// σ of a state over the samples.
#[derive(Debug, Serialize)]
pub struct StateOverSamples<'a> {
    /// Its name.
    pub state: String,
    /// By figure, the least first.
    pub redundant: Vec<Figure<'a>>,
    /// Samples by how sure that is.
    pub certainty: BTreeMap<String, usize>,
    /// Samples whose σ is not the most common.
    pub special: Vec<Special<'a>>,
    /// Pairs of samples that differ in one parameter, with none between them, whose σ differs.
    pub changes: Vec<NeighbouringSamples>,
}

/// A figure with its samples.
#[derive(Debug, Serialize)]
pub struct Figure<'a> {
    /// σ; the least it can be, where that is undecided.
    pub redundant: usize,
    /// The most it can be, where that is undecided.
    pub redundant_at_most: Option<usize>,
    /// How many samples.
    pub samples: usize,
    /// The first of them.
    pub first: &'a BTreeMap<String, f64>,
}

/// A sample with its σ.
#[derive(Debug, Serialize)]
pub struct Special<'a> {
    /// Where.
    pub at: &'a BTreeMap<String, f64>,
    /// The values that no decimal is.
    pub exact: &'a BTreeMap<String, String>,
    /// σ.
    pub redundant: usize,
}

/// Two samples next to each other.
#[derive(Debug, Serialize)]
pub struct NeighbouringSamples {
    /// The parameter that differs.
    pub parameter: String,
    /// Its value in the first.
    pub from: f64,
    /// In the second.
    pub to: f64,
    /// The other parameters.
    pub at: BTreeMap<String, f64>,
    /// σ of both.
    pub redundant: [usize; 2],
}

/// The redesigns over the samples.
#[derive(Debug, Serialize)]
pub struct RedesignsData<'a> {
    /// Samples with a best one.
    pub samples: usize,
    /// Samples searched without finding any.
    pub without: usize,
    /// Samples where it is not proven that these are all the best.
    pub unproven: usize,
    /// Those that are among the best at every sample that has any.
    pub everywhere: Vec<String>,
    /// Those that are at some.
    pub anywhere: Vec<Told<'a>>,
    /// Why others were not searched.
    pub unsearched: Vec<Told<'a>>,
}

/// The peak force over the samples.
#[derive(Debug, Serialize)]
pub struct PeakForce<'a> {
    /// Samples that have one.
    pub samples: usize,
    /// The least of those whose stroke is complete.
    pub least: Option<Peak<'a>>,
    /// The greatest.
    pub greatest: Option<Peak<'a>>,
    /// Samples where redundant constraints leave reactions open: they are those of minimum norm.
    pub open: usize,
    /// Samples whose stroke ends early.
    pub incomplete: usize,
    /// Why others have none.
    pub without: Vec<Told<'a>>,
}

/// A peak force.
#[derive(Debug, Serialize)]
pub struct Peak<'a> {
    /// `[N]`
    pub force: f64,
    /// The joint.
    pub joint: &'a str,
    /// Where the first drive is.
    pub drive_position: f64,
    /// Which sample.
    pub at: &'a BTreeMap<String, f64>,
}

fn told<'a>(rows: &'a [SampleRow], of: &BTreeMap<String, SampleTally>) -> Vec<Told<'a>> {
    let one = |(what, t): (&String, &SampleTally)| Told {
        what: what.clone(),
        samples: t.samples,
        first: &rows[t.first].at,
    };
    of.iter().map(one).collect()
}

impl<'a> SweepData<'a> {
    /// What a table says.
    #[must_use]
    pub fn new(table: &'a Table) -> SweepData<'a> {
        let (head, rows) = (&table.head, &table.rows[..]);
        let Summary {
            problems,
            redundant,
            best,
            unsearched,
            peaks,
            methods,
        } = table.summary();
        SweepData {
            mechanism: &head.sweep,
            parameters: &head.parameters,
            sampling: &head.sampling,
            shard: &head.shard,
            samples: head.samples,
            done: rows.len(),
            finished: table.finished,
            problems: told(rows, &problems),
            states: redundant.into_iter().map(|r| state(rows, r)).collect(),
            redesigns: best.map(|b| redesigns(rows, b, &unsearched)),
            peak_force: peaks.map(|p| peak_force(rows, &p)),
            methods,
            table,
        }
    }
}

/// σ of the state of a row.
fn sigma(row: &SampleRow, state: &str) -> Option<usize> {
    let found = row.states.iter().find(|s| s.state == state)?;
    Some(found.redundant)
}

fn state<'a>(rows: &'a [SampleRow], r: Redundant) -> StateOverSamples<'a> {
    let figure = |(&(least, most), t): (&(usize, usize), &SampleTally)| Figure {
        redundant: least,
        redundant_at_most: (most > least).then_some(most),
        samples: t.samples,
        first: &rows[t.first].at,
    };
    let special = |&i: &usize| Special {
        at: &rows[i].at,
        exact: &rows[i].exact,
        redundant: sigma(&rows[i], &r.state).unwrap_or(0),
    };
    let by_certainty = r.by_certainty.iter();
    StateOverSamples {
        redundant: r.by_figure.iter().map(figure).collect(),
        certainty: by_certainty.map(|(w, t)| (w.clone(), t.samples)).collect(),
        special: r.special.iter().map(special).collect(),
        changes: changes(rows, &r.state),
        state: r.state,
    }
}

/// Pairs of neighbours with different σ, parameter by parameter.
fn changes(rows: &[SampleRow], state: &str) -> Vec<NeighbouringSamples> {
    let Some(first) = rows.first() else {
        return Vec::new();
    };
    let mut out = Vec::new();
    for parameter in first.at.keys() {
        let others = |r: &SampleRow| {
            let all = r.at.iter().filter(|(n, _)| *n != parameter);
            all.map(|(n, x)| (n.clone(), *x))
                .collect::<BTreeMap<_, _>>()
        };
        let bits = |r: &SampleRow| others(r).values().map(|x| x.to_bits()).collect_vec();
        let groups = rows.iter().into_group_map_by(|r| bits(r));
        for mut group in groups.into_values().sorted_by_key(|g| g[0].sample) {
            group.sort_by(|a, b| a.at[parameter].total_cmp(&b.at[parameter]));
            for (a, b) in group.iter().tuple_windows() {
                let (Some(one), Some(two)) = (sigma(a, state), sigma(b, state)) else {
                    continue;
                };
                if one != two {
                    out.push(NeighbouringSamples {
                        parameter: parameter.clone(),
                        from: a.at[parameter],
                        to: b.at[parameter],
                        at: others(a),
                        redundant: [one, two],
                    });
                }
            }
        }
    }
    out
}

fn redesigns<'a>(
    rows: &'a [SampleRow],
    best: Best,
    unsearched: &BTreeMap<String, SampleTally>,
) -> RedesignsData<'a> {
    let one = |(what, t): &(String, SampleTally)| Told {
        what: what.clone(),
        samples: t.samples,
        first: &rows[t.first].at,
    };
    RedesignsData {
        samples: best.samples,
        without: best.without,
        unproven: best.unproven,
        everywhere: best.everywhere().map(str::to_owned).collect(),
        anywhere: best.anywhere.iter().map(one).collect(),
        unsearched: told(rows, unsearched),
    }
}

fn peak_force<'a>(rows: &'a [SampleRow], p: &Peaks) -> PeakForce<'a> {
    let at = |which: usize| {
        let row = &rows[p.least_and_greatest?[which]];
        let found = row.forces.as_ref()?.get()?;
        Some(Peak {
            force: found.peak_force,
            joint: &found.joint,
            drive_position: found.drive_position,
            at: &row.at,
        })
    };
    PeakForce {
        samples: p.samples,
        least: at(0),
        greatest: at(1),
        open: p.open,
        incomplete: p.incomplete,
        without: told(rows, &p.without),
    }
}
