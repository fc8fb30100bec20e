//! `ozols report`.

use super::args::{Args, Question, Report};
use super::question::{measured, state};
use super::search::{Wanted, answered, mechanism};
use super::{Done, output};
use crate::page::{Commands, Page, Redesigns, html};
use crate::redundancy::analysis::{Method, analyse};
use crate::search::certify::Summary;
use anyhow::ensure;
use std::path::Path;

/// A page with more variants than this is of no use to anybody.
const MOST: usize = 10_000;

pub(super) fn run(args: &Args, a: &Report) -> anyhow::Result<Done> {
    ensure!(
        (1..=MOST).contains(&a.top),
        "--top must be from 1 to {MOST} in a report; `ozols search` gives longer lists"
    );
    let mechanism = mechanism(&a.file.file, &a.question)?;
    let states: Vec<usize> = (0..mechanism.states.len()).collect();
    let states = analyse(&mechanism, &states, Method::Auto { tolerance: None })?;
    let commands = commands(a);
    let searched = state(&mechanism, &a.question)?.map(|(s, _)| s);
    let write = |redesigns: Result<Redesigns<'_>, String>| -> anyhow::Result<Done> {
        let page = html(&Page {
            mechanism: &mechanism,
            states: &states,
            redesigns,
            commands: commands.clone(),
        })?;
        output::to(a.output.as_deref(), |out| {
            out.write_all(page.as_bytes())?;
            Ok(Done::Found)
        })
    };
    // What is known of the mechanism as it is stands, even where its coordinates do not allow a search.
    let measured = match measured(&mechanism, searched, a.question.as_written) {
        Ok(measured) => measured,
        Err(why) => return write(Err(format!("{why:#}."))),
    };
    let wanted = Wanted {
        top: a.top,
        all: false,
        sample: None,
        count: false,
        by_cost: false,
    };
    answered(
        args,
        &mechanism,
        &a.question,
        measured,
        &wanted,
        |found, give| {
            let (mut variants, mut summary) = (Vec::new(), Summary::default());
            let given = give(&mut |_, v| {
                summary.add(&v);
                variants.push(v);
                Ok(())
            })?;
            summary.dropped = given.dropped;
            write(Ok(Redesigns {
                found,
                variants,
                summary,
                interrupted: given.interrupted,
            }))
        },
    )
}

/// The commands that give what the page shows.
fn commands(a: &Report) -> Commands {
    let file = quoted(&a.file.file);
    let flags = flags(&a.question);
    let asked = if flags.is_empty() {
        String::new()
    } else {
        format!(" {}", flags.join(" "))
    };
    let name = Path::new(&a.file.file).file_stem();
    let name = quoted(&name.map_or_else(|| "mechanism".into(), |n| n.to_string_lossy()));
    let row = |what: &str, command: String| (what.to_owned(), command);
    Commands {
        rows: vec![
            row(
                "This page",
                format!("ozols report {file}{asked} --top {} -o report.html", a.top),
            ),
            row("The mechanism as it is", format!("ozols analyze {file}")),
            row(
                "The variants, as text or data",
                format!(
                    "ozols search {file}{asked} --top {} --format text|json|csv",
                    a.top
                ),
            ),
            row(
                "The mechanism for other programs",
                format!("ozols export {file} --to sdf -o {name}.sdf"),
            ),
            row(
                "A drawing",
                format!("ozols draw {file} --kind scheme|kinematic -o {name}.svg"),
            ),
        ],
        draw: flags
            .is_empty()
            .then(|| format!("ozols draw {file} --variant {{}} -o variant-{{}}.svg")),
    }
}

/// The switches of a question that are not at their defaults.
fn flags(q: &Question) -> Vec<String> {
    let mut out = Vec::new();
    let mut put = |name: &str, value: Option<String>| {
        out.extend(value.map(|v| format!("--{name} {v}")));
    };
    put(
        "max-redundant",
        (q.max_redundant > 0).then(|| q.max_redundant.to_string()),
    );
    put("max-external", q.max_external.map(|n| n.to_string()));
    put("state", q.state.as_deref().map(quoted));
    put("max-mobility", q.max_mobility.map(|n| n.to_string()));
    put("max-changes", q.max_changes.map(|n| n.to_string()));
    put(
        "rank",
        (!q.rank.is_empty()).then(|| quoted(&q.rank.join(","))),
    );
    put("pool", (q.pool != 1000).then(|| q.pool.to_string()));
    for link in &q.hold {
        put("hold", Some(quoted(link)));
    }
    put(
        "options",
        (!q.options.is_empty()).then(|| quoted(&q.options.join(","))),
    );
    for rule in &q.allow {
        put("allow", Some(quoted(rule)));
    }
    for rule in &q.forbid {
        put("forbid", Some(quoted(rule)));
    }
    put("poses", (q.poses > 0).then(|| q.poses.to_string()));
    put("snap", q.snap.map(|t| t.to_string()));
    let switches = [
        ("allow-output-change", q.allow_output_change),
        ("symmetric", q.symmetric),
        ("one-per-orbit", q.one_per_orbit),
        ("generic-only", q.generic_only),
        ("as-written", q.as_written),
    ];
    out.extend(
        switches
            .iter()
            .filter(|(_, on)| *on)
            .map(|(name, _)| format!("--{name}")),
    );
    out
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=,:+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}
