//! Making what a table lacks.

use super::error::TableError;
use super::head::Head;
use super::lines::Output;
use super::rows::Table;
use crate::shard::Shard;
use crate::sweep::Sweep;
use crate::sweep::row::SampleRow;
use rayon::prelude::*;
use std::path::Path;

/// Says how far a sweep has come, samples done and in all; and whether to end early.
pub trait SweepWatch {
    /// Hears how far.
    fn done(&mut self, done: usize, of: usize);
    /// Whether to end.
    fn ended(&self) -> bool;
}

/// Makes what a table lacks of a part, or all of it in memory where there is no file. What was whole stays as it is.
///
/// # Errors
/// Where the file cannot be written, or is something else.
///
/// # Complexity
/// That of the rows, which are made in parallel; memory for all of them.
pub fn make(
    sweep: &Sweep,
    shard: Shard,
    path: Option<&Path>,
    watch: &mut (dyn SweepWatch + Send),
) -> Result<Table, TableError> {
    let head = Head::new(sweep, shard);
    let mut out = match path {
        Some(path) => Some(Output::open(path, &head)?),
        None => None,
    };
    let (rows, digest) = out.as_mut().map(Output::there).unwrap_or_default();
    let mut table = Table {
        finished: out.as_ref().is_some_and(|o| o.finished),
        added: 0,
        head,
        rows,
        digest,
    };
    if table.finished {
        return Ok(table);
    }
    let all = 0..sweep.space.len();
    let own: Vec<usize> = match shard {
        Shard::WHOLE => all.collect(),
        part => all
            .into_par_iter()
            .filter(|&n| part.has(&sweep.space.sample(n).name()))
            .collect(),
    };
    if !table
        .rows
        .iter()
        .map(|r| r.sample)
        .eq(own.iter().copied().take(table.rows.len()))
    {
        return Err(TableError::Spoilt(path.unwrap_or(Path::new("")).to_owned()));
    }
    // As many at a time as keep all threads at it; what is written does not depend on it.
    let chunk = 4 * rayon::current_num_threads();
    for numbers in own[table.rows.len()..].chunks(chunk) {
        if watch.ended() {
            return Ok(table);
        }
        let each = numbers.par_iter();
        let rows: Vec<SampleRow> = each.map(|&n| sweep.row(&sweep.space.sample(n))).collect();
        let text = table.add(rows);
        if let Some(out) = &mut out {
            out.add(&text)?;
        }
        watch.done(table.rows.len(), own.len());
    }
    if let Some(out) = &mut out {
        out.finish(&table.digest)?;
    }
    table.finished = true;
    Ok(table)
}
