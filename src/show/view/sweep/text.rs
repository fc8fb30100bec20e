//! A sweep for people.

use super::{
    NeighbouringSamples, Peak, PeakForce, RedesignsData, StateOverSamples, SweepData, Told,
};
use crate::format::number::{significant, tooltip};
use crate::format::phrase::plural;
use crate::view::terminal::layout::{fit, table};
use itertools::Itertools;
use std::collections::BTreeMap;

/// Items of a list that are told; JSON and the table have them all.
const TOLD: usize = 10;

/// Values by name: "a = 1.5, b = 2".
fn place(at: &BTreeMap<String, f64>) -> String {
    at.iter()
        .map(|(n, x)| format!("{n} = {}", tooltip(*x)))
        .join(", ")
}

/// The first of some sentences, and how many more there are.
fn some(mut all: Vec<String>, joined: &str) -> String {
    let more = all.len().saturating_sub(TOLD);
    all.truncate(TOLD);
    let tail = if more > 0 {
        format!("{joined}and {more} more")
    } else {
        String::new()
    };
    all.join(joined) + &tail
}

fn list(of: &[Told<'_>]) -> String {
    let one = |t: &Told<'_>| {
        let what = t.what.lines().next().unwrap_or("");
        format!(
            "{} ({}, first at {})",
            what,
            plural(t.samples, "sample"),
            place(t.first)
        )
    };
    some(of.iter().map(one).collect(), "; ")
}

/// A text made line by line, each fitted to a terminal of `width` columns where one is given.
struct Text {
    out: String,
    width: Option<u16>,
}

impl Text {
    fn say(&mut self, line: &str) {
        self.out += &fit(&format!("{line}\n"), self.width);
    }
}

impl SweepData<'_> {
    /// What was found, fitted to a terminal of `width` columns where one is given.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        let mut text = Text {
            out: String::new(),
            width,
        };
        self.head(&mut text);
        for state in &self.states {
            of_state(&mut text, state);
        }
        if let Some(best) = &self.redesigns {
            of_redesigns(&mut text, best);
        }
        if let Some(peaks) = &self.peak_force {
            of_peaks(&mut text, peaks);
        }
        self.of_methods(&mut text);
        text.out
    }

    /// What was sampled, and where there is no mechanism.
    fn head(&self, text: &mut Text) {
        let domain = |(name, of): (&String, &Vec<String>)| match &of[..] {
            [from, to] if from.starts_with("from ") => format!("{name} {from} {to}"),
            values => format!("{name} one of {}", some(values.to_vec(), ", ")),
        };
        let part = match self.shard {
            "1/1" => String::new(),
            part => format!(" of part {part}"),
        };
        text.say(&format!(
            "{}: {}, {}; {} of {} done{part}. What follows is of these samples; of what lies between them nothing is known.",
            self.mechanism,
            self.sampling,
            self.parameters.iter().map(domain).join(", "),
            self.done,
            plural(self.samples, "sample"),
        ));
        if !self.problems.is_empty() {
            text.say(&format!("\nNo mechanism: {}", list(&self.problems)));
        }
    }

    /// What each method says against the proven mobility.
    fn of_methods(&self, text: &mut Text) {
        if self.methods.is_empty() {
            return;
        }
        let row = |(name, words): (&String, &BTreeMap<String, usize>)| {
            let told = words.iter().map(|(w, n)| format!("{w} {n}"));
            vec![name.clone(), told.clone().join(", ")]
        };
        let rows = self.methods.iter().map(row).collect();
        let heads = ["method", "against the proven mobility"];
        text.out += &format!("\n{}\n", table(&heads, rows, text.width));
    }
}

/// The redundant constraints of a state, and where they are others.
fn of_state(text: &mut Text, state: &StateOverSamples<'_>) {
    text.say(&format!("\nState {}: {}", state.state, redundant(state)));
    let words = state.certainty.iter().map(|(w, n)| format!("{w} at {n}"));
    text.say(&format!("  How sure: {}", words.clone().join(", ")));
    if !state.special.is_empty() {
        let one = |s: &super::Special<'_>| format!("{} (σ = {})", place_of(s), s.redundant);
        let all = state.special.iter().map(one).collect();
        text.say(&format!("  Unlike most: {}", some(all, "; ")));
    }
    if !state.changes.is_empty() {
        let n = state.changes.len();
        let times = if n == 1 {
            "once"
        } else {
            &format!("{n} times")
        };
        let all = state.changes.iter().map(change).collect();
        text.say(&format!(
            "  From a sample to the next σ changes {times}: {}",
            some(all, "; ")
        ));
    }
}

/// Which redesigns are best, everywhere and somewhere.
fn of_redesigns(text: &mut Text, best: &RedesignsData<'_>) {
    let mut line = format!("\nBest redesigns, at {}", plural(best.samples, "sample"));
    if best.without > 0 {
        line += &format!("; at {} more there is none", best.without);
    }
    if best.unproven > 0 {
        line += &format!(
            "; at {} not proven to be all the best there are",
            best.unproven
        );
    }
    text.say(&line);
    match &best.everywhere[..] {
        _ if best.samples == 0 => {}
        [] => text.say("  At all of these: none"),
        all => text.say(&format!("  At all of these: {}", some(all.to_vec(), " | "))),
    }
    if best.anywhere.len() > best.everywhere.len() {
        let row = |t: &Told<'_>| vec![t.samples.to_string(), t.what.clone(), place(t.first)];
        let rows = best.anywhere.iter().take(TOLD).map(row).collect();
        let heads = ["samples", "best there", "first at"];
        text.out += &format!("{}\n", table(&heads, rows, text.width));
        let more = best.anywhere.len().saturating_sub(TOLD);
        if more > 0 {
            text.out += &format!("  and {more} more\n");
        }
    }
    if !best.unsearched.is_empty() {
        text.say(&format!("  Not searched: {}", list(&best.unsearched)));
    }
}

/// The least and the greatest peak force of the mechanism as it is.
fn of_peaks(text: &mut Text, p: &PeakForce<'_>) {
    let one = |p: &Peak<'_>| {
        format!(
            "{} N in {} at {}",
            significant(p.force),
            p.joint,
            place(p.at)
        )
    };
    if let (Some(least), Some(most)) = (&p.least, &p.greatest) {
        text.say(&format!(
            "\nPeak force as built: from {} to {}",
            one(least),
            one(most)
        ));
    } else {
        text.say("\nPeak force as built: at no sample over the whole stroke");
    }
    if p.open > 0 {
        text.say(&format!(
            "  At {} redundant constraints leave the reactions open: these are the ones of minimum norm",
            plural(p.open, "sample")
        ));
    }
    if p.incomplete > 0 {
        text.say(&format!(
            "  At {} the stroke ends early; these are not counted",
            plural(p.incomplete, "sample")
        ));
    }
    if !p.without.is_empty() {
        text.say(&format!("  None: {}", list(&p.without)));
    }
}

/// Where a sample is, by expressions where no decimal is the value.
fn place_of(s: &super::Special<'_>) -> String {
    let one = |(n, x): (&String, &f64)| match s.exact.get(n) {
        Some(text) if text.len() < 24 => format!("{n} = {text}"),
        _ => format!("{n} = {}", tooltip(*x)),
    };
    s.at.iter().map(one).join(", ")
}

fn redundant(state: &StateOverSamples<'_>) -> String {
    let one = |f: &super::Figure<'_>| {
        let sigma = match f.redundant_at_most {
            Some(most) => format!("{} to {most}", f.redundant),
            None => f.redundant.to_string(),
        };
        format!("σ = {sigma} at {}", plural(f.samples, "sample"))
    };
    state.redundant.iter().map(one).join(", ")
}

fn change(c: &NeighbouringSamples) -> String {
    let [one, two] = c.redundant;
    let at = match place(&c.at) {
        at if at.is_empty() => at,
        at => format!(" at {at}"),
    };
    let (from, to) = (tooltip(c.from), tooltip(c.to));
    format!("{} {from} to {to}{at}: {one} to {two}", c.parameter)
}
