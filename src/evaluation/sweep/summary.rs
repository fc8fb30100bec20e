//! What the rows of a sweep say together: where σ changes, which redesigns are best everywhere and which anywhere, the least and
//! the greatest peak force. All of it is of the samples alone.

use crate::sweep::row::SampleRow;
use crate::sweep::table::Table;
use std::collections::BTreeMap;

/// How many samples have the same, and the first of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampleTally {
    /// How many.
    pub samples: usize,
    /// The place of the first in the list of rows.
    pub first: usize,
}

/// Counts rows by a key.
fn tally<K: Ord>(
    rows: &[SampleRow],
    key: impl Fn(&SampleRow) -> Option<K>,
) -> BTreeMap<K, SampleTally> {
    let mut out: BTreeMap<K, SampleTally> = BTreeMap::new();
    for (first, row) in rows.iter().enumerate() {
        if let Some(key) = key(row) {
            let t = out.entry(key).or_insert(SampleTally { samples: 0, first });
            t.samples += 1;
        }
    }
    out
}

/// σ of a state over the samples.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Redundant {
    /// Name of the state.
    pub state: String,
    /// Samples by σ; where it is undecided, by the least and the most it can be.
    pub by_figure: BTreeMap<(usize, usize), SampleTally>,
    /// Samples by the word for how sure that is.
    pub by_certainty: BTreeMap<String, SampleTally>,
    /// Places of the rows whose σ is not the most common.
    pub special: Vec<usize>,
}

/// The redesigns over the samples.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Best {
    /// Samples that have a best one.
    pub samples: usize,
    /// Samples that were searched, but have none.
    pub without: usize,
    /// Samples whose best are not proven to be all the best there are.
    pub unproven: usize,
    /// What the best change, with the samples where they are; those best most often first.
    pub anywhere: Vec<(String, SampleTally)>,
}

impl Best {
    /// Those that are among the best at every sample that has any.
    pub fn everywhere(&self) -> impl Iterator<Item = &str> {
        let all = self.anywhere.iter();
        all.filter(|(_, t)| t.samples == self.samples)
            .map(|(words, _)| words.as_str())
    }
}

/// The peak force over the samples.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Peaks {
    /// Place of the row where it is least, and where it is greatest; of those whose stroke is complete.
    pub least_and_greatest: Option<[usize; 2]>,
    /// Samples with a peak.
    pub samples: usize,
    /// Samples where redundant constraints leave the reactions open.
    pub open: usize,
    /// Samples whose stroke ends early.
    pub incomplete: usize,
    /// Why others have none.
    pub without: BTreeMap<String, SampleTally>,
}

/// What the rows say together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Summary {
    /// Samples that make no mechanism, by why.
    pub problems: BTreeMap<String, SampleTally>,
    /// σ, state by state.
    pub redundant: Vec<Redundant>,
    /// The redesigns, where they were searched.
    pub best: Option<Best>,
    /// Why some samples were not searched.
    pub unsearched: BTreeMap<String, SampleTally>,
    /// The peak forces, where there are loads.
    pub peaks: Option<Peaks>,
    /// What each rank method was worth, by its name and the word.
    pub methods: BTreeMap<String, BTreeMap<String, usize>>,
}

impl Table {
    /// What its rows say together.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let rows = &self.rows;
        let mut methods: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
        for (method, word) in rows.iter().flat_map(|r| &r.methods) {
            let words = methods.entry(method.clone()).or_default();
            *words.entry(word.clone()).or_default() += 1;
        }
        Summary {
            problems: tally(rows, |r| r.problem.clone()),
            redundant: redundant(rows),
            best: best(rows),
            unsearched: tally(rows, |r| r.redesigns.as_ref()?.why().map(str::to_owned)),
            peaks: peaks(rows),
            methods,
        }
    }
}

fn redundant(rows: &[SampleRow]) -> Vec<Redundant> {
    let mut names: Vec<&str> = Vec::new();
    for state in rows.iter().flat_map(|r| &r.states) {
        if !names.contains(&state.state.as_str()) {
            names.push(&state.state);
        }
    }
    let of = |name: &str| {
        let state = |r: &SampleRow| r.states.iter().find(|s| s.state == name).cloned();
        let figure = |r: &SampleRow| {
            let s = state(r)?;
            Some((s.redundant, s.redundant_at_most.unwrap_or(s.redundant)))
        };
        let by_figure = tally(rows, figure);
        // Of several that are as common the least: the special ones have more.
        let common = by_figure
            .iter()
            .max_by_key(|(f, t)| (t.samples, std::cmp::Reverse(**f)));
        let common = common.map(|(f, _)| *f);
        let special =
            (0..rows.len()).filter(|&i| figure(&rows[i]).is_some_and(|f| Some(f) != common));
        Redundant {
            state: name.to_owned(),
            special: special.collect(),
            by_certainty: tally(rows, |r| state(r).map(|s| s.certainty)),
            by_figure,
        }
    };
    names.into_iter().map(of).collect()
}

fn best(rows: &[SampleRow]) -> Option<Best> {
    let searched = || {
        rows.iter()
            .enumerate()
            .filter_map(|(i, r)| Some((i, r.redesigns.as_ref()?)))
    };
    searched().next()?;
    let found = || searched().filter_map(|(i, r)| Some((i, r.get()?)));
    let some = || found().filter(|(_, r)| !r.best.is_empty());
    let mut anywhere: BTreeMap<&str, SampleTally> = BTreeMap::new();
    for (first, redesigns) in some() {
        for words in &redesigns.best {
            let t = anywhere
                .entry(words)
                .or_insert(SampleTally { samples: 0, first });
            t.samples += 1;
        }
    }
    let mut anywhere: Vec<(String, SampleTally)> = anywhere
        .into_iter()
        .map(|(words, t)| (words.to_owned(), t))
        .collect();
    anywhere.sort_by_key(|(_, t)| std::cmp::Reverse(t.samples));
    Some(Best {
        samples: some().count(),
        without: found().count() - some().count(),
        unproven: found().filter(|(_, r)| !r.proven).count(),
        anywhere,
    })
}

fn peaks(rows: &[SampleRow]) -> Option<Peaks> {
    rows.iter().find(|r| r.forces.is_some())?;
    let found = || {
        rows.iter()
            .enumerate()
            .filter_map(|(i, r)| Some((i, r.forces.as_ref()?.get()?)))
    };
    let whole = || found().filter(|(_, f)| f.complete);
    let least = whole().min_by(|a, b| a.1.peak_force.total_cmp(&b.1.peak_force));
    // The first of several that are as great.
    let most = whole()
        .rev()
        .max_by(|a, b| a.1.peak_force.total_cmp(&b.1.peak_force));
    Some(Peaks {
        least_and_greatest: least.zip(most).map(|((a, _), (b, _))| [a, b]),
        samples: found().count(),
        open: found().filter(|(_, f)| !f.unique).count(),
        incomplete: found().filter(|(_, f)| !f.complete).count(),
        without: tally(rows, |r| r.forces.as_ref()?.why().map(str::to_owned)),
    })
}
