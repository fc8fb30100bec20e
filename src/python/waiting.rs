//! Long work without the GIL, which hears signals all the same.

use crate::told::failed;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// How long nobody looks whether a signal came.
pub(crate) const TURN: Duration = Duration::from_millis(50);

/// Does `work` on a thread of its own. What it tells is given to `hear`, here and with the GIL. Where `hear` raises, or a
/// signal's handler does (Ctrl-C), the work is told to stop, and that is raised once it has.
pub(crate) fn patiently<T: Send, E: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool, &mut (dyn FnMut(E) + Send)) -> T + Send,
    mut hear: impl FnMut(E) -> PyResult<()>,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    std::thread::scope(|s| {
        let (tell, mut heard) = channel();
        let stop = &stop;
        // Nobody is left to tell once waiting has ended.
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

/// As [`patiently`], on so many threads (0: all), for work that tells what is done of all; `progress` hears it.
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
