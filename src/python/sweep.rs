//! Sweeps: a part made in this process, parts put together, and tables as what is told of them.

use crate::search;
use crate::told::{Told, failed, json};
use crate::waiting::with_progress;
use ozols::file::read::workload::motion;
use ozols::score::request::Request;
use ozols::shard::Shard;
use ozols::sweep::space::Sampling;
use ozols::sweep::table::{Head, SweepWatch, make, merge, read};
use ozols::sweep::{Spec, Sweep, SweepError, SweepRequest};
use ozols::view;
use ozols::view::sweep::plot::PlottedQuantity;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

/// A [`Spec`] as keywords of Python's.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Asking {
    file: String,
    text: String,
    grid: usize,
    sobol: Option<usize>,
    seed: u32,
    search: Option<String>,
    top: usize,
    stroke: Option<String>,
    methods: bool,
    as_written: bool,
}

impl Asking {
    fn sweep(self) -> PyResult<Sweep> {
        let search = self.search.as_deref().map(search::request).transpose()?;
        let search = search.map(|request| Request {
            as_written: self.as_written,
            ..request
        });
        let stroke = match self.stroke {
            Some(text) => Some((text.clone(), motion::stroke(&text).map_err(failed)?)),
            None => None,
        };
        let spec = Spec {
            file: self.file,
            text: self.text,
            sampling: match (self.sobol, self.seed) {
                (Some(count), seed) => Sampling::Sobol { count, seed },
                (None, _) => Sampling::Grid { points: self.grid },
            },
            asked: SweepRequest {
                search,
                top: self.top,
                stroke,
                methods: self.methods,
                as_written: self.as_written,
            },
        };
        Sweep::new(spec).map_err(|e| match e {
            SweepError::File(problems) => failed(problems.render(false)),
            other => failed(other),
        })
    }
}

/// The first line that the table of a sweep has, and how many samples there are.
#[pyfunction]
pub(crate) fn sweep_plan(asked: Asking) -> PyResult<(String, usize)> {
    let sweep = asked.sweep()?;
    let head = json(&Head::new(&sweep, Shard::WHOLE))?;
    Ok((head, sweep.space.len()))
}

/// As `ozols sweep`: what a table lacks of a part, counted from 1, is added to it; rows, the digest of all, and how many were
/// added. `progress` hears samples done and in all.
#[pyfunction]
pub(crate) fn sweep_make(
    py: Python<'_>,
    asked: Asking,
    path: PathBuf,
    part: (u64, u64),
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(usize, String, usize)> {
    let sweep = &asked.sweep()?;
    let shard = Shard::nth(part.0, part.1).map_err(failed)?;
    with_progress(py, threads, progress, |stop, tell| {
        let mut watching = Watching { stop, tell };
        let made = make(sweep, shard, Some(&path), &mut watching).map_err(failed)?;
        Ok((made.rows.len(), made.digest.hex(), made.added))
    })
}

/// What is heard of the work.
type Tell<'t> = &'t mut (dyn FnMut((usize, usize)) + Send);

struct Watching<'t> {
    stop: &'t AtomicBool,
    tell: Tell<'t>,
}

impl SweepWatch for Watching<'_> {
    fn done(&mut self, done: usize, of: usize) {
        (self.tell)((done, of));
    }
    fn ended(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// As `ozols sweep --merge`; rows and their digest.
#[pyfunction]
pub(crate) fn sweep_merge(
    py: Python<'_>,
    path: PathBuf,
    parts: Vec<PathBuf>,
) -> PyResult<(usize, String)> {
    let made = py.detach(|| merge(&parts, &path)).map_err(failed)?;
    Ok((made.rows.len(), made.digest.hex()))
}

/// What a finished table says.
#[pyfunction]
pub(crate) fn sweep_read(py: Python<'_>, path: PathBuf) -> PyResult<Told> {
    py.detach(|| {
        let table = read(&path).map_err(failed)?;
        let told = view::sweep::SweepData::new(&table);
        Ok((json(&told)?, told.text(None), Some(told.csv()), None))
    })
}

/// A plot of a finished table, as `ozols sweep --svg`.
#[pyfunction]
pub(crate) fn sweep_plot(
    py: Python<'_>,
    path: PathBuf,
    quantity: &str,
    over: Vec<String>,
) -> PyResult<String> {
    let known = PlottedQuantity::ALL;
    let found = known.iter().find(|(word, _)| *word == quantity);
    let &(_, quantity) = found.ok_or_else(|| {
        let known = known.map(|(word, _)| word).join(", ");
        failed(format!("quantity {quantity:?} is none of {known}"))
    })?;
    py.detach(|| {
        let table = read(&path).map_err(failed)?;
        let told = view::sweep::SweepData::new(&table);
        Ok(told.plot(quantity, &over).map_err(failed)?.svg())
    })
}
