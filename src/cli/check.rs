//! `ozols check`, `list`, `show` and `schema`.

use super::args::{Args, File};
use super::{Done, load, output};
use crate::builtin;
use crate::import::text::mechanism_from_bytes;
use crate::import::workload::tables_alone;
use crate::redundancy::analysis::{Method, analyse};
use crate::report::words;
use crate::workload::jaw_loads::{Gripping, JawError};
use anyhow::{Context, bail};

pub(super) fn run(_: &Args, a: &File) -> anyhow::Result<Done> {
    let (name, bytes) = load::named(&a.file)?;
    if let Some((name, tables)) = tables_alone(&name, &bytes)? {
        return output::to(None, |out| {
            writeln!(out, "{name}: workload {}: valid", tables.join(", "))?;
            Ok(Done::Found)
        });
    }
    let m = mechanism_from_bytes(&name, &bytes)?;
    for state in 0..m.states.len() {
        match Gripping::new(&m, state) {
            // What cannot be held is for `ozols grip` to say; the file is valid.
            Ok(_) | Err(JawError::Nominal(_)) => {}
            Err(e) => return Err(e).with_context(|| format!("{name}: [workload.grip]")),
        }
    }
    output::to(None, |out| {
        writeln!(
            out,
            "{}: {} links, {} joints, states {}: valid",
            m.name,
            m.links.len(),
            m.joints.len(),
            m.states.join(", ")
        )?;
        Ok(Done::Found)
    })
}

pub(super) fn list() -> anyhow::Result<Done> {
    let mut rows = Vec::new();
    for name in builtin::names() {
        let m = load::mechanism(name).with_context(|| format!("built-in mechanism {name}"))?;
        let states: Vec<usize> = (0..m.states.len()).collect();
        for s in analyse(&m, &states, Method::Modular)? {
            let numbers = [
                s.links,
                s.joints,
                s.contours,
                s.freedoms,
                s.mobility,
                s.redundant,
            ];
            let mut row = vec![
                if s.state == "free" {
                    name.to_owned()
                } else {
                    String::new()
                },
                s.state,
            ];
            row.extend(numbers.map(|n| n.to_string()));
            rows.push(row);
        }
    }
    output::to(None, |out| {
        writeln!(
            out,
            "{}",
            words::table(
                &["mechanism", "state", "n", "p", "k", "f", "W", "σ"],
                rows,
                output::width(None)
            )
        )?;
        Ok(Done::Found)
    })
}

pub(super) fn show(a: &File) -> anyhow::Result<Done> {
    let Some(text) = builtin::text(&a.file) else {
        bail!(load::unknown(&a.file))
    };
    output::to(None, |out| {
        write!(out, "{text}")?;
        Ok(Done::Found)
    })
}

pub(super) fn schema() -> anyhow::Result<Done> {
    output::to(None, |out| {
        writeln!(out, "{:#}", crate::import::schema::json_schema())?;
        Ok(Done::Found)
    })
}
