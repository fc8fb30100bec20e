//! Errors and views as Python gets them, and long work without the GIL that signals can interrupt.

use ozols::model::mechanism::{Mechanism, StateId};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde::Serialize;
use std::fmt::Display;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

pyo3::create_exception!(
    ozols,
    Error,
    PyValueError,
    "An error of the library. Its text names the keywords of the call."
);

/// Returns an error of the library as an exception. Options in its text become keywords.
pub(crate) fn failed(e: impl Display) -> pyo3::PyErr {
    Error::new_err(keywords(&e.to_string()))
}

/// Returns a text with each option as the keyword of Python: `--max-mobility` becomes `max_mobility`.
fn keywords(text: &str) -> String {
    let mut parts = text.split("--");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| c != '-' && !c.is_ascii_lowercase());
        let (name, rest) = part.split_at(end.unwrap_or(part.len()));
        match name {
            "" => out += "--",
            name => out += &name.replace('-', "_"),
        }
        out += rest;
    }
    out
}

/// Returns the same with the lines of the file that the error is about.
pub(crate) fn refused(e: ozols::Error) -> pyo3::PyErr {
    match e {
        ozols::Error::File(problems) => failed(problems.render(false)),
        other => failed(other),
    }
}

/// Returns a view as JSON.
pub(crate) fn json(view: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(view).map_err(failed)
}

/// Returns a state by name.
pub(crate) fn state(m: &Mechanism, name: &str) -> PyResult<StateId> {
    m.state_named(name).ok_or_else(|| {
        let known = m.states.join(", ");
        failed(format!("{} has no state {name}; it has: {known}", m.name))
    })
}

/// Interval between checks for signals.
pub(crate) const TURN: Duration = Duration::from_millis(50);

/// Does `work` on a new thread. Its events go to `hear`, on this thread and with the GIL. If `hear` or a signal handler raises
/// (Ctrl-C), the work is stopped, and the exception is raised when it has ended.
pub(crate) fn patiently<T: Send, E: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool, &mut (dyn FnMut(E) + Send)) -> T + Send,
    mut hear: impl FnMut(E) -> PyResult<()>,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    std::thread::scope(|s| {
        let (tell, mut heard) = channel();
        let stop = &stop;
        // The receiver is gone when waiting has ended.
        let worker = s.spawn(move || work(stop, &mut |event| drop(tell.send(event))));
        let mut raised = None;
        loop {
            let heard = &mut heard;
            let event = py.detach(move || heard.recv_timeout(TURN));
            let ok = match event {
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => Ok(()),
                Ok(_) if raised.is_some() => Ok(()),
                Ok(event) => hear(event),
            };
            if let Err(e) = ok.and_then(|()| py.check_signals()) {
                stop.store(true, Ordering::Relaxed);
                raised.get_or_insert(e);
            }
        }
        let done = py.detach(|| worker.join());
        match (raised, done) {
            (_, Err(panic)) => std::panic::resume_unwind(panic),
            (Some(e), _) => Err(e),
            (None, Ok(done)) => Ok(done),
        }
    })
}

/// Does `work` as [`patiently`] on a number of threads (0: all). `progress` is called with the work done and its total.
pub(crate) fn with_progress<T: Send>(
    py: Python<'_>,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&AtomicBool, &mut (dyn FnMut((usize, usize)) + Send)) -> PyResult<T> + Send,
) -> PyResult<T> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    let pool = pool.build().map_err(failed)?;
    patiently(
        py,
        |stop, tell| pool.install(|| work(stop, tell)),
        |(done, all): (usize, usize)| match progress {
            Some(progress) => progress.call1((done, all)).map(drop),
            None => Ok(()),
        },
    )?
}
