//! Searches, their outcomes, and their variants.

use crate::answer::{TURN, failed, json, patiently};
use crate::mechanism::{Mechanism, drawn};
use ozols::draw::Marks;
use ozols::score::outcome::variant;
use ozols::score::request::{List, Request};
use ozols::score::run::{Event, run};
use ozols::search::answer::k_best::Assignment;
use ozols::view::search::csv;
use ozols::view::search::json;
use ozols::view::search::text;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

/// Number of variants prepared ahead.
const AHEAD: usize = 64;

/// Reads a [`Request`] from the JSON of the keywords.
fn request(asked: &str) -> PyResult<Request> {
    let from = &mut serde_json::Deserializer::from_str(asked);
    serde_path_to_error::deserialize(from).map_err(|e| {
        // The position in the JSON is of no use: nobody typed it.
        let what = e.inner().to_string();
        let what = what
            .rsplit_once(" at line")
            .map_or(&*what, |(what, _)| what);
        failed(format!("{}: {what}", e.path()))
    })
}

/// Searches as `ozols search`. `progress` is called with the layers done, their total number, and the nodes so far.
#[pyfunction]
pub(crate) fn search(
    py: Python<'_>,
    mechanism: &Bound<'_, Mechanism>,
    asked: &str,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Outcome> {
    let request = &request(asked)?;
    let m = mechanism.get().0.clone();
    let found = patiently(
        py,
        |stop, tell| run(m, request, &|| stop.load(Ordering::Relaxed), tell),
        |event| match (event, progress) {
            (Event::Note(text), _) => {
                let text = CString::new(text).map_err(failed)?;
                PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 2)
            }
            (Event::Building(p), Some(progress)) => {
                progress.call1((p.done, p.of, p.nodes)).map(drop)
            }
            (Event::Building(_) | Event::Built | Event::Proving { .. }, _) => Ok(()),
        },
    )?;
    Ok(Outcome(Arc::new(found.map_err(failed)?)))
}

/// An outcome of the library.
#[derive(Debug)]
#[pyclass(frozen, module = "ozols._native")]
pub(crate) struct Outcome(Arc<ozols::Outcome>);

#[pymethods]
impl Outcome {
    /// Returns everything except the variants as JSON.
    fn counts(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| json(&json::search_json(&self.0)))
    }

    /// Returns the JSON that the command prints, without the seconds.
    fn data(&self, py: Python<'_>) -> PyResult<String> {
        let o = &*self.0;
        written(py, |out| {
            let remarks = o.make_remarks(&|| false).map_err(failed)?;
            json::write_json(out, o, o.variants(), &remarks, None).map_err(failed)
        })
    }

    fn csv(&self, py: Python<'_>) -> PyResult<String> {
        written(py, |out| {
            let written = csv::write_csv(out, &self.0, self.0.variants());
            written.map(drop).map_err(failed)
        })
    }

    fn text(&self, py: Python<'_>) -> PyResult<String> {
        let o = &*self.0;
        written(py, |out| {
            let remarks = o.make_remarks(&|| false).map_err(failed)?;
            let name = &o.search.mechanism.name;
            text::write_text(out, o, o.variants(), &remarks, name, None, false).map_err(failed)
        })
    }

    /// Returns the requested variants, all variants, or a sample.
    fn variants(&self, all: bool, sample: Option<usize>, seed: u64) -> Variants {
        let outcome = self.0.clone();
        let list = match (all, sample) {
            (_, Some(n)) => List::Sample(n),
            (true, None) => List::All,
            (false, None) => outcome.request.list,
        };
        Variants::new(outcome, list, seed)
    }
}

fn written(
    py: Python<'_>,
    write: impl FnOnce(&mut Vec<u8>) -> PyResult<()> + Send,
) -> PyResult<String> {
    let out = py.detach(|| {
        let mut out = Vec::new();
        write(&mut out).map(|()| out)
    })?;
    String::from_utf8(out).map_err(failed)
}

/// An iterator over variants. A thread prepares some of them ahead.
#[derive(Debug)]
#[pyclass(frozen, module = "ozols._native")]
pub(crate) struct Variants {
    heard: Mutex<Receiver<Variant>>,
    stop: Arc<AtomicBool>,
}

impl Variants {
    fn new(outcome: Arc<ozols::Outcome>, list: List, seed: u64) -> Variants {
        let (tell, heard) = sync_channel(AHEAD);
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = stop.clone();
        std::thread::spawn(move || {
            let cancelled = || stopped.load(Ordering::Relaxed);
            let list = outcome.list_unless(list, seed, &cancelled);
            // Ends when the receiver is dropped.
            let _ = json::for_each_variant(&outcome, list, |v, data| {
                let variant = Variant {
                    outcome: outcome.clone(),
                    assignment: v.assignment().clone(),
                    name: v.name(),
                    position: v.position(),
                    text: v.to_string(),
                    data: serde_json::to_string(data).ok(),
                };
                tell.send(variant).map_err(drop)
            });
        });
        let heard = Mutex::new(heard);
        Variants { heard, stop }
    }
}

impl Drop for Variants {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

#[pymethods]
impl Variants {
    fn __iter__(this: Py<Self>) -> Py<Self> {
        this
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Variant>> {
        loop {
            let next = || {
                let heard = self.heard.lock().unwrap_or_else(PoisonError::into_inner);
                heard.recv_timeout(TURN)
            };
            match py.detach(next) {
                Ok(variant) => return Ok(Some(variant)),
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
                Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            }
        }
    }
}

/// A variant and its outcome.
#[derive(Debug)]
#[pyclass(frozen, module = "ozols._native")]
pub(crate) struct Variant {
    outcome: Arc<ozols::Outcome>,
    assignment: Assignment,
    /// "variant 3", or "idea 3" in a list of ideas.
    name: String,
    #[pyo3(get)]
    position: usize,
    #[pyo3(get)]
    text: String,
    #[pyo3(get)]
    data: Option<String>,
}

#[pymethods]
impl Variant {
    fn mechanism(&self) -> Mechanism {
        let search = &self.outcome.search;
        Mechanism(variant::as_mechanism(search, &self.assignment, &self.name))
    }

    fn draw(&self, py: Python<'_>, kind: &str, state: &str) -> PyResult<String> {
        py.detach(|| {
            let (realized, marks) =
                Marks::of_variant(&self.outcome.search, &self.assignment, &self.name);
            drawn(&realized, kind, state, Some(marks))
        })
    }
}
