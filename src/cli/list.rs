//! `ozols list`.

use super::{Done, near, output};
use crate::builtin;
use crate::model::mechanism::{Mechanism, StateId};
use crate::redundancy::figures::figures;
use crate::view::layout::table;
use anyhow::Context;
use clap::Args as ClapArgs;

#[derive(Debug, ClapArgs)]
pub(super) struct List {
    /// Only those with every one of these words in name, family or description.
    #[arg(value_name = "WORD")]
    words: Vec<String>,
}

/// The narrowest column that a description is worth.
const NARROWEST: usize = 16;

pub(super) fn run(a: &List) -> anyhow::Result<Done> {
    let wanted: Vec<String> = a.words.iter().map(|w| w.to_lowercase()).collect();
    let (mut rows, mut notes) = (Vec::new(), Vec::new());
    for (family, names) in builtin::families() {
        let mut heading = Some(family);
        for name in names {
            let m = Mechanism::builtin(name)?;
            let about = format!("{name} {family} {}", m.description).to_lowercase();
            if !wanted.iter().all(|w| about.contains(w)) {
                continue;
            }
            let states = rows_of(name, &m)?;
            notes.push((heading.take(), m.description));
            notes.resize(notes.len() + states.len() - 1, (None, String::new()));
            rows.extend(states);
        }
    }
    if rows.is_empty() {
        let hint = near::hint(&a.words.join("-"), builtin::names());
        output::note(&format!(
            "no built-in mechanism has all of: {}{hint}\n",
            a.words.join(", ")
        ));
        return Ok(Done::Nothing);
    }
    let header = ["mechanism", "state", "n", "p", "k", "f", "W", "σ"];
    let table = table(&header, rows, None);
    let width = output::width(None).map(usize::from);
    output::to(None, |out| {
        let lines: Vec<&str> = table.lines().collect();
        let (head, body) = lines.split_at(2);
        writeln!(out, "{}", head.join("\n"))?;
        let columns = lines.iter().map(|l| measure(l)).max().unwrap_or(0) + 2;
        for (line, (heading, description)) in body.iter().zip(&notes) {
            if let Some(heading) = heading {
                writeln!(out, "\n{heading}")?;
            }
            let gap = " ".repeat(columns - measure(line));
            match width.map(|w| w.saturating_sub(columns)) {
                _ if description.is_empty() => writeln!(out, "{line}")?,
                None => writeln!(out, "{line}{gap}{description}")?,
                Some(left) if left < NARROWEST => writeln!(out, "{line}")?,
                Some(left) => {
                    let short = console::truncate_str(description, left, "…");
                    writeln!(out, "{line}{gap}{short}")?;
                }
            }
        }
        if a.words.is_empty() {
            writeln!(
                out,
                "\nn links, p joints, k contours, f freedoms, W mobility, σ redundant constraints; see `ozols explain`"
            )?;
        }
        Ok(Done::Found)
    })
}

/// A row for each state.
fn rows_of(name: &str, m: &Mechanism) -> anyhow::Result<Vec<Vec<String>>> {
    let row = |(i, state): (usize, StateId)| {
        let s = figures(m, state).with_context(|| format!("built-in mechanism {name}"))?;
        let first = if i == 0 { name } else { "" };
        let mut row = vec![first.to_owned(), m.states[state].clone()];
        row.extend(
            [
                s.links,
                s.joints,
                s.contours,
                s.freedoms,
                s.mobility,
                s.redundant,
            ]
            .map(|n| n.to_string()),
        );
        Ok(row)
    };
    m.state_ids().enumerate().map(row).collect()
}

fn measure(line: &str) -> usize {
    console::measure_text_width(line)
}
