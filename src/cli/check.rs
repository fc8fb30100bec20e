//! `ozols check`, `show` and `schema`.

use super::args::{Args, File};
use super::{Done, load, output};
use crate::builtin;
use crate::import::text::mechanism_from_bytes;
use crate::import::workload::tables_alone;
use anyhow::bail;

pub(super) fn run(_: &Args, a: &File) -> anyhow::Result<Done> {
    let (name, bytes) = load::named(&a.file)?;
    if let Some((name, tables)) = tables_alone(&name, &bytes)? {
        return output::to(None, |out| {
            writeln!(out, "{name}: workload {}: valid", tables.join(", "))?;
            Ok(Done::Found)
        });
    }
    let m = mechanism_from_bytes(&name, &bytes)?;
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

pub(super) fn show(a: &File) -> anyhow::Result<Done> {
    let Some(text) = builtin::text(&a.file) else {
        bail!(load::no_built_in(&a.file))
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
