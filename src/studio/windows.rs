//! The windows that are open: what is new is sent to each as it comes.

use super::http;
use std::io::{self, Write};
use std::net::TcpStream;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How often a window that hears nothing is asked whether it is still there.
const PULSE: Duration = Duration::from_millis(500);

/// The open windows.
#[derive(Debug, Default)]
pub(super) struct Windows {
    list: Mutex<Vec<(u64, Sender<Arc<str>>)>>,
    ever: AtomicBool,
}

/// An event as a browser reads it.
pub(super) fn event(name: &str, value: &serde_json::Value) -> Arc<str> {
    format!("event: {name}\ndata: {value}\n\n").into()
}

impl Windows {
    fn lock(&self) -> MutexGuard<'_, Vec<(u64, Sender<Arc<str>>)>> {
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.lock().len()
    }

    /// Whether there were any, and none is there now.
    pub(super) fn left(&self) -> bool {
        self.ever.load(Ordering::SeqCst) && self.lock().is_empty()
    }

    /// Tells all of them.
    pub(super) fn tell(&self, event: &Arc<str>) {
        self.lock()
            .retain(|(_, window)| window.send(event.clone()).is_ok());
    }

    /// Sends what there is `now`, and then all that is new, to a window until it is closed or all has `ended`.
    pub(super) fn serve(
        &self,
        stream: &mut TcpStream,
        now: impl FnOnce() -> Vec<Arc<str>>,
        ended: impl Fn() -> bool,
    ) -> io::Result<()> {
        let (tell, news) = channel();
        let number = {
            let mut list = self.lock();
            // Nothing that happens from here on is missed.
            let number = list.iter().map(|(n, _)| n + 1).max().unwrap_or(0);
            list.push((number, tell));
            number
        };
        self.ever.store(true, Ordering::SeqCst);
        let served = send(stream, &news, now, ended);
        self.lock().retain(|(n, _)| *n != number);
        served
    }
}

fn send(
    stream: &mut TcpStream,
    news: &Receiver<Arc<str>>,
    now: impl FnOnce() -> Vec<Arc<str>>,
    ended: impl Fn() -> bool,
) -> io::Result<()> {
    http::begin(stream, "text/event-stream")?;
    for event in now() {
        stream.write_all(event.as_bytes())?;
    }
    stream.flush()?;
    while !ended() {
        match news.recv_timeout(PULSE) {
            Ok(event) => stream.write_all(event.as_bytes())?,
            Err(RecvTimeoutError::Timeout) => stream.write_all(b": \n\n")?,
            Err(RecvTimeoutError::Disconnected) => break,
        }
        stream.flush()?;
    }
    Ok(())
}
