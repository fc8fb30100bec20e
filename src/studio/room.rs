//! The state shared by windows, worker and requests, and the open windows, which receive each event.

use super::desk::{Desk, Refused};
use super::disk::Opening;
use super::http;
use crate::score::outcome::Outcome;
use crate::score::request::Request;
use serde_json::{Value, json};
use std::io::{self, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The events about the newest text, for windows that open later.
#[derive(Debug, Default)]
struct Told {
    revision: u64,
    events: Vec<(&'static str, Arc<str>)>,
}

/// The room.
#[derive(Debug)]
pub(super) struct Room {
    desk: Mutex<Desk>,
    /// Another text is on the desk, or the room is closed.
    news: Condvar,
    /// The newest revision, for a search to see whether it is still of use.
    pub(super) newest: AtomicU64,
    pub(super) windows: Windows,
    told: Mutex<Told>,
    /// The last search that was finished.
    found: Mutex<Option<Arc<Found>>>,
    /// The first request, and the wider one that replaces it.
    request: Request,
    wider: Mutex<Option<(Request, String)>>,
    ended: AtomicBool,
    /// The revision whose search is to end with what it has.
    stopped: AtomicU64,
    /// The numbers of searches begun and ended, for tests that no two run at once.
    pub(super) searches: [AtomicU64; 2],
}

/// A search that was finished.
#[derive(Debug)]
pub(super) struct Found {
    /// The text it is of.
    pub(super) revision: u64,
    /// Its outcome.
    pub(super) outcome: Outcome,
    /// The requests that find something, where it found nothing, each with its result in words.
    pub(super) wider: Vec<(Request, String)>,
}

fn lock_mutex<T>(m: &Mutex<T>) -> MutexGuard<'_, T> {
    m.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Room {
    pub(super) fn new(opening: Opening, request: Request) -> io::Result<Room> {
        let desk = Desk::new(&opening)?;
        Ok(Room {
            newest: AtomicU64::new(desk.revision),
            desk: Mutex::new(desk),
            news: Condvar::new(),
            windows: Windows::default(),
            told: Mutex::default(),
            found: Mutex::default(),
            request,
            wider: Mutex::default(),
            ended: AtomicBool::new(false),
            stopped: AtomicU64::new(0),
            searches: Default::default(),
        })
    }

    /// Looks at the desk.
    pub(super) fn desk(&self) -> MutexGuard<'_, Desk> {
        lock_mutex(&self.desk)
    }

    /// Updates the desk and informs all windows.
    pub(super) fn at_desk(
        &self,
        act: impl FnOnce(&mut Desk) -> Result<(), Refused>,
    ) -> Result<Value, Refused> {
        let mut desk = self.desk();
        let done = act(&mut desk);
        let told = self.tell_of(&desk);
        done.map(|()| told)
    }

    /// Checks if another program has written to the file, and informs the windows.
    pub(super) fn look_at_disk(&self) {
        let mut desk = self.desk();
        // One that cannot be read now may be readable in a moment.
        if desk.look_at_disk().unwrap_or(false) {
            self.tell_of(&desk);
        }
    }

    /// Tells all windows what is on the desk now. The desk is held meanwhile: whoever sees its text must find it the newest.
    fn tell_of(&self, desk: &Desk) -> Value {
        let (revision, state) = (desk.revision, desk.file_state());
        if self.newest.swap(revision, Ordering::SeqCst) == revision {
            self.windows.tell_found(&format_event("desk", &state));
            return json!({ "desk": state, "revision": revision });
        }
        let look = desk.desk_json();
        self.windows.tell_found(&format_event("look", &look));
        self.news.notify_all();
        look
    }

    /// Waits for a text newer than a revision, and returns its revision; `None` if the room is closed.
    pub(super) fn wait_for_news(&self, done: u64) -> Option<u64> {
        let mut desk = self.desk();
        loop {
            if self.has_ended() {
                return None;
            }
            if desk.revision != done {
                return Some(desk.revision);
            }
            desk = self.news.wait(desk).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Returns true if a revision is outdated.
    pub(super) fn is_old(&self, revision: u64) -> bool {
        self.has_ended() || self.newest.load(Ordering::SeqCst) != revision
    }

    /// Stops the search of a revision, which returns what it has found; 0 stops none.
    pub(super) fn stop_search(&self, revision: u64) {
        self.stopped.store(revision, Ordering::SeqCst);
    }

    /// Returns true if the search of a revision is to end.
    pub(super) fn is_over(&self, revision: u64) -> bool {
        self.is_old(revision) || self.stopped.load(Ordering::SeqCst) == revision
    }

    /// Tells all windows, those too that come later, what was found of a revision.
    pub(super) fn tell_found(&self, revision: u64, name: &'static str, value: &Value) {
        let made = format_event(name, value);
        let mut told = lock_mutex(&self.told);
        if self.is_old(revision) {
            return;
        }
        if told.revision != revision {
            *told = Told {
                revision,
                events: Vec::new(),
            };
        }
        told.events.retain(|(n, _)| *n != name);
        told.events.push((name, made.clone()));
        self.windows.tell_found(&made);
    }

    /// Returns all events that a window needs when it opens.
    pub(super) fn events_now(&self) -> Vec<Arc<str>> {
        let look = self.desk().desk_json();
        let told = lock_mutex(&self.told);
        let newest = look["revision"].as_u64() == Some(told.revision);
        let known = told.events.iter().filter(|_| newest);
        std::iter::once(format_event("look", &look))
            .chain(known.map(|(_, e)| e.clone()))
            .collect()
    }

    /// Keeps what a search found.
    pub(super) fn keep_found(&self, found: Found) {
        *lock_mutex(&self.found) = Some(Arc::new(found));
    }

    /// Returns what was found for a revision.
    pub(super) fn found_for(&self, revision: u64) -> Option<Arc<Found>> {
        let found = lock_mutex(&self.found).clone();
        found.filter(|f| f.revision == revision)
    }

    /// Returns the request of a search, and the words of a wider one.
    pub(super) fn current_request(&self) -> (Request, Option<String>) {
        match lock_mutex(&self.wider).clone() {
            Some((request, words)) => (request, Some(words)),
            None => (self.request.clone(), None),
        }
    }

    /// Searches with a wider request from now on, or with the first one, and returns the state of the desk.
    pub(super) fn ask_search(&self, wider: Option<(Request, String)>) -> Result<Value, Refused> {
        *lock_mutex(&self.wider) = wider;
        self.at_desk(|desk| {
            desk.revision += 1;
            Ok(())
        })
    }

    pub(super) fn has_ended(&self) -> bool {
        self.ended.load(Ordering::SeqCst)
    }

    /// Closes it.
    pub(super) fn end_room(&self) {
        self.ended.store(true, Ordering::SeqCst);
        // The worker may be about to wait.
        drop(self.desk());
        self.news.notify_all();
    }

    /// Tries once more to keep unsaved work, and returns why it cannot be kept; `None` if it is kept or saved.
    pub(super) fn unkept_work(&self) -> Option<String> {
        self.desk().keep_again()
    }

    /// Returns the path of unsaved work, if there is any.
    pub(super) fn unsaved_path(&self) -> Option<PathBuf> {
        self.desk().unsaved_path()
    }

    /// Returns numbers for tests and diagnosis.
    pub(super) fn status_json(&self) -> Value {
        let [begun, ended] = self.searches.each_ref().map(|n| n.load(Ordering::SeqCst));
        json!({
            "windows": self.windows.window_count(),
            "revision": self.desk().revision,
            "desk": self.desk().file_state(),
            "searches": { "begun": begun, "ended": ended },
        })
    }
}

/// How often a window that hears nothing is asked whether it is still there.
const PULSE: Duration = Duration::from_millis(500);

/// The open windows.
#[derive(Debug, Default)]
pub(super) struct Windows {
    list: Mutex<Vec<(u64, Sender<Arc<str>>)>>,
    ever: AtomicBool,
}

/// Returns an event in the format of a browser's event stream.
pub(super) fn format_event(name: &str, value: &serde_json::Value) -> Arc<str> {
    format!("event: {name}\ndata: {value}\n\n").into()
}

impl Windows {
    /// Returns the number of open windows.
    pub(super) fn window_count(&self) -> usize {
        lock_mutex(&self.list).len()
    }

    /// Returns true if there were windows, and all are closed now.
    pub(super) fn have_left(&self) -> bool {
        self.ever.load(Ordering::SeqCst) && lock_mutex(&self.list).is_empty()
    }

    /// Tells all of them.
    pub(super) fn tell_found(&self, event: &Arc<str>) {
        lock_mutex(&self.list).retain(|(_, window)| window.send(event.clone()).is_ok());
    }

    /// Sends what there is `now`, and then all that is new, to a window until it is closed or all has `ended`.
    pub(super) fn serve_window(
        &self,
        stream: &mut TcpStream,
        now: impl FnOnce() -> Vec<Arc<str>>,
        ended: impl Fn() -> bool,
    ) -> io::Result<()> {
        let (tell, news) = channel();
        let number = {
            let mut list = lock_mutex(&self.list);
            // Nothing that happens from here on is missed.
            let number = list.iter().map(|(n, _)| n + 1).max().unwrap_or(0);
            list.push((number, tell));
            number
        };
        self.ever.store(true, Ordering::SeqCst);
        let served = send_events(stream, &news, now, ended);
        lock_mutex(&self.list).retain(|(n, _)| *n != number);
        served
    }
}

fn send_events(
    stream: &mut TcpStream,
    news: &Receiver<Arc<str>>,
    now: impl FnOnce() -> Vec<Arc<str>>,
    ended: impl Fn() -> bool,
) -> io::Result<()> {
    http::begin_stream(stream, "text/event-stream")?;
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
