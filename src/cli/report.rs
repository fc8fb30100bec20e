//! `ozols report`.

use super::args::{Args, Report};
use super::question::{ask, flags, ready, state};
use super::search::{Wanted, answered};
use super::{Done, load, output};
use crate::model::mechanism::{Mechanism, StateId};
use crate::page::{Commands, Page, Redesigns, html};
use crate::redundancy::analysis::{Method, analyse};
use crate::search::certify::Summary;
use crate::view::next::{file_name, word};
use anyhow::ensure;
use itertools::Itertools;

/// A page with more variants than this is of no use to anybody.
const MOST: usize = 10_000;

pub(super) fn run(args: &Args, a: &Report) -> anyhow::Result<Done> {
    ensure!(
        (1..=MOST).contains(&a.top),
        "--top must be from 1 to {MOST} in a report; `ozols search` gives longer lists"
    );
    let (question, named) = (&a.asked.question, a.asked.state.as_deref());
    let mut mechanism = load::mechanism(&a.file.file)?;
    ready(&mut mechanism, question)?;
    // An unknown state is a mistake; geometry that cannot be searched is not.
    state(&mechanism, question, named)?;
    let states: Vec<StateId> = mechanism.state_ids().collect();
    let states = analyse(&mechanism, &states, Method::Auto { tolerance: None })?;
    let commands = commands(&mechanism, a);
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
    let (request, measured) = match ask(&mechanism, question, named) {
        Ok(asked) => asked,
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
        (&mechanism, measured),
        request,
        &a.asked,
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
fn commands(mechanism: &Mechanism, a: &Report) -> Commands {
    let file = word(&a.file.file);
    let list = flags(mechanism, &a.asked);
    let mut more = vec![list.clone()];
    if a.asked.poses > 0 {
        more.push(format!("--poses {}", a.asked.poses));
    }
    if a.asked.generic_only {
        more.push("--generic-only".to_owned());
    }
    more.push(format!("--top {}", a.top));
    let more = more.iter().filter(|m| !m.is_empty()).join(" ");
    let row = |what: &str, command: String| (what.to_owned(), command);
    let named = |ending: &str| file_name(&mechanism.name, ending);
    let of_variant = |what: &str, command: &str, rest: &str| {
        let words = [command, &file, &list, "--variant {}", rest];
        row(what, words.iter().filter(|w| !w.is_empty()).join(" "))
    };
    Commands {
        rows: vec![
            row(
                "This page",
                format!("ozols report {file} {more} -o report.html"),
            ),
            row("The mechanism as it is", format!("ozols analyze {file}")),
            row(
                "The variants, as text or data",
                format!("ozols search {file} {more} --format text|json|csv"),
            ),
            row(
                "The mechanism for other programs",
                format!("ozols export {file} --to sdf -o {}", named("sdf")),
            ),
            row(
                "A drawing",
                format!(
                    "ozols draw {file} --kind scheme|kinematic -o {}",
                    named("svg")
                ),
            ),
        ],
        // `draw` and `export` count the lucky variants, too.
        variant: if a.asked.generic_only {
            Vec::new()
        } else {
            vec![
                of_variant("The same drawing", "ozols draw", "-o variant-{}.svg"),
                of_variant(
                    "This variant as a file",
                    "ozols export",
                    "--to toml -o variant-{}.toml",
                ),
            ]
        },
    }
}
