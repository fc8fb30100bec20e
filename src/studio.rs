//! The studio: a page in the browser for drawing and changing a mechanism, with results at every change.
//!
//! The text of the file is the only state: every change edits it and keeps its comments ([`crate::file::edit`]), and
//! all windows show its content. One thread analyses and searches the newest text only; a new text ends a search. The
//! server answers requests from this machine with the token of its address, and from no other page (`door`). It reads
//! and writes the open file, its own files in the same folder, and nothing else (`disk`).

mod desk;
mod disk;
mod door;
mod http;
mod idea;
mod reading;
mod room;
mod routes;
mod shelf;
mod work;

pub use disk::Opening;
pub(crate) use disk::begin_file;

use crate::score::request::Request;
use door::{Door, Waiting, WaitingPlace};
use room::Room;
use std::io;
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Maximum number of requests with the token at a time. The open windows need fewer.
const CONNECTIONS: usize = 64;
/// The interval between checks of the file and the windows.
const TICK: Duration = Duration::from_millis(100);
/// Ticks between two looks at the file.
const LOOK: u32 = 3;
/// Ticks of a second.
const SECOND: u32 = 10;
/// So long the server waits for a window that is loaded again.
const GRACE: Duration = Duration::from_secs(3);

/// A studio that is ready to be opened.
#[derive(Debug)]
pub(crate) struct Studio {
    listener: TcpListener,
    door: Arc<Door>,
    room: Arc<Room>,
}

impl Studio {
    /// Listens at a free port of this machine, for itself alone.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read or no port is free.
    pub(crate) fn new(opening: Opening, request: Request) -> io::Result<Studio> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
        let door = Arc::new(Door::new(listener.local_addr()?.port())?);
        let room = Arc::new(Room::new(opening, request)?);
        Ok(Studio {
            listener,
            door,
            room,
        })
    }

    /// Returns the address of the page, with its token.
    #[must_use]
    pub(crate) fn page_address(&self) -> String {
        self.door.address()
    }

    /// Serves until the last window is closed, and returns where unsaved work is, if any. The first window may take its time. Where
    /// unsaved work cannot be kept, that goes to `say`, and the studio serves on.
    ///
    /// # Errors
    /// Returns an error if threads cannot be started.
    pub(crate) fn serve_windows(
        self,
        say: impl Fn(&str),
    ) -> io::Result<Option<std::path::PathBuf>> {
        let Studio {
            listener,
            door,
            room,
        } = self;
        let (at_work, at_door) = (room.clone(), room.clone());
        let worker = std::thread::Builder::new().name("studio-work".to_owned());
        let worker = worker.spawn(move || work::run_worker(&at_work))?;
        let accept = std::thread::Builder::new().name("studio-door".to_owned());
        accept.spawn(move || accept_requests(&listener, &door, &at_door))?;
        let (mut ticks, mut alone_since, mut said) = (0_u32, None, false);
        loop {
            std::thread::sleep(TICK);
            ticks = ticks.wrapping_add(1);
            if ticks.is_multiple_of(LOOK) {
                room.look_at_disk();
            }
            let left = room.windows.have_left();
            alone_since = match (left, alone_since) {
                (true, None) => Some(Instant::now()),
                (true, since) => since,
                (false, _) => None,
            };
            let is_over = alone_since.is_some_and(|s| s.elapsed() > GRACE);
            if is_over && ticks.is_multiple_of(SECOND) {
                match room.unkept_work() {
                    None => break,
                    // The program is the one place where the work is left.
                    Some(why) if !said => {
                        said = true;
                        say(&format!(
                            "{why}; the studio goes on: open its address again, and save"
                        ));
                    }
                    Some(_) => {}
                }
            }
        }
        room.end_room();
        let _ = worker.join();
        Ok(room.unsaved_path())
    }
}

/// Handles each connection on its own thread.
fn accept_requests(listener: &TcpListener, door: &Arc<Door>, room: &Arc<Room>) {
    let busy = Arc::new(AtomicUsize::new(0));
    let waiting = Arc::new(Waiting::default());
    for stream in listener.incoming() {
        let Ok(mut stream) = stream else { continue };
        let Some(place) = waiting.enter_queue(&stream) else {
            continue;
        };
        let (door, room, busy) = (door.clone(), room.clone(), busy.clone());
        let made = std::thread::Builder::new().name("studio-request".to_owned());
        // One that cannot be made is a request that is not answered.
        let _ = made.spawn(move || {
            let tried = catch_unwind(AssertUnwindSafe(|| {
                answer_stream(&mut stream, &door, &room, place, &busy)
            }));
            if tried.is_err() {
                let words = "the program failed at this; please report it with the file";
                let _ = http::write_reply(&mut stream, &http::Reply::refusal_reply(500, words));
            }
        });
    }
}

/// A request with the token while it is answered, counted among all of them.
struct Busy<'a>(&'a AtomicUsize);

impl Busy<'_> {
    /// Returns a request that is counted, or `None` if there are too many.
    fn new(all: &AtomicUsize) -> Option<Busy<'_>> {
        let one = Busy(all);
        (all.fetch_add(1, Ordering::SeqCst) < CONNECTIONS).then_some(one)
    }
}

impl Drop for Busy<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Handles a request. Until it has shown the token it waits at `place`. After that `busy` counts it.
fn answer_stream(
    stream: &mut TcpStream,
    door: &Door,
    room: &Room,
    place: WaitingPlace,
    busy: &AtomicUsize,
) -> io::Result<()> {
    let mut asked = match http::read_head(stream)? {
        Ok(asked) => asked,
        Err(refusal) => return http::write_reply(stream, &refusal),
    };
    let path = match door.admit_request(&asked) {
        Ok(path) => path.to_owned(),
        Err(refusal) => return http::write_reply(stream, &refusal),
    };
    drop(place);
    let Some(_one) = Busy::new(busy) else {
        return http::write_reply(
            stream,
            &http::Reply::refusal_reply(503, "too many requests at once"),
        );
    };
    if let Err(refusal) = http::read_body(stream, &mut asked)? {
        return http::write_reply(stream, &refusal);
    }
    if path == "events" && asked.method == "GET" {
        return room
            .windows
            .serve_window(stream, || room.events_now(), || room.has_ended());
    }
    let answer = routes::answer_request(&asked, &path, room).packed_for(&asked)?;
    http::write_reply(stream, &answer)
}
