//! Catalogues: building a part in this process, and merging parts.

use crate::answer::{failed, with_progress};
use ozols::catalog::build::{build_rows, plan_work};
use ozols::catalog::spec::Spec;
use ozols::catalog::store::Store;
use ozols::shard::Shard;
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

fn spec(json: &str) -> PyResult<Spec> {
    let spec: Spec = serde_json::from_str(json).map_err(|e| {
        // The position in the JSON is of no use: nobody typed it.
        let what = e.to_string();
        failed(
            what.rsplit_once(" at line")
                .map_or(&*what, |(what, _)| what),
        )
    })?;
    spec.check_all().map_err(failed)?;
    Ok(spec)
}

/// Returns the canonical text of a specification in JSON, and the ids of its structures.
#[pyfunction]
pub(crate) fn catalog_plan(py: Python<'_>, json: &str) -> PyResult<(String, Vec<String>)> {
    let spec = spec(json)?;
    let work = py
        .detach(|| plan_work(&spec, Shard::WHOLE))
        .map_err(failed)?;
    let mut ids: Vec<String> = work.structure_ids().collect();
    ids.sort_unstable();
    Ok((spec.to_canonical(), ids))
}

/// Adds the structures that a database lacks of a part (counted from 1), and returns how many were added. `progress` is called with
/// the structures done and their total number.
#[pyfunction]
pub(crate) fn catalog_build(
    py: Python<'_>,
    json: &str,
    path: PathBuf,
    part: (u64, u64),
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<usize> {
    let spec = &spec(json)?;
    let shard = Shard::nth_of(part.0, part.1).map_err(failed)?;
    with_progress(py, threads, progress, |stop, tell| {
        let mut store = Store::open_or_create(&path, spec).map_err(failed)?;
        let there = store.structure_ids().map_err(failed)?;
        let work = plan_work(spec, shard).map_err(failed)?;
        let all = work.structure_count();
        let mut added = 0;
        let stopped = || stop.load(Ordering::Relaxed);
        let made = store.add_while(|send| {
            build_rows(
                spec,
                &work,
                |id| stopped() || there.contains(id),
                |row| {
                    added += 1;
                    tell((there.len() + added, all));
                    if send.send(row).is_err() || stopped() {
                        ControlFlow::Break(())
                    } else {
                        ControlFlow::Continue(())
                    }
                },
            )
        });
        made.map_err(failed)?.map_err(failed)?;
        if !stopped() {
            store.finish_part(shard, all).map_err(failed)?;
        }
        Ok(added)
    })
}

/// Merges as `ozols catalog merge` and returns how many structures were added. A part that is refused is an error once the others are
/// in.
#[pyfunction]
pub(crate) fn catalog_merge(py: Python<'_>, path: PathBuf, parts: Vec<PathBuf>) -> PyResult<usize> {
    let mut refused = None;
    let merged =
        py.detach(|| Store::merge_parts(&path, &parts, |e| refused = refused.take().or(Some(e))));
    match refused {
        Some(e) => Err(failed(e)),
        None => merged.map(|m| m.added).map_err(failed),
    }
}
