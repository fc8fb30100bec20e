//! Admission of requests: only the page of this machine that has the address with the token. Connections wait until they have shown it.

use super::http::{Asked, Reply};
use std::collections::VecDeque;
use std::fmt::Write as _;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Bytes of a token.
const TOKEN: usize = 16;

/// Requirements that a request must meet.
#[derive(Debug)]
pub(super) struct Door {
    /// The only name that this server answers to: others may lead here by a name of theirs.
    host: String,
    token: String,
}

impl Door {
    /// Creates a door with a token that nobody can guess.
    pub(super) fn new(port: u16) -> std::io::Result<Door> {
        let mut bytes = [0; TOKEN];
        getrandom::fill(&mut bytes).map_err(std::io::Error::other)?;
        let token = bytes.iter().fold(String::new(), |mut text, b| {
            let _ = write!(text, "{b:02x}");
            text
        });
        Ok(Door {
            host: format!("127.0.0.1:{port}"),
            token,
        })
    }

    /// Returns the address of the page.
    pub(super) fn address(&self) -> String {
        format!("http://{}/{}/", self.host, self.token)
    }

    /// Returns the path after the token, or a refusal if the request is not from our page.
    pub(super) fn admit_request<'a>(&self, asked: &'a Asked) -> Result<&'a str, Reply> {
        let refused = |why| Err(Reply::refusal_reply(403, why));
        if asked.header_once("host") != Some(self.host.as_str()) {
            return refused("this server answers only to 127.0.0.1 and its port");
        }
        let own = format!("http://{}", self.host);
        let origin = asked.header_once("origin");
        let writes = asked.method != "GET";
        if (asked.has_header("origin") || writes) && origin != Some(own.as_str()) {
            return refused("requests from other pages are refused");
        }
        // "none" is an address that a person typed or clicked outside of any page.
        let site = asked.header_once("sec-fetch-site");
        if asked.has_header("sec-fetch-site") && !matches!(site, Some("same-origin" | "none")) {
            return refused("requests from other pages are refused");
        }
        if writes && asked.header_once("content-type") != Some("application/json") {
            return Err(Reply::refusal_reply(415, "requests must be JSON"));
        }
        let path = asked.path.split('?').next().unwrap_or_default();
        let inside = path.strip_prefix('/').and_then(|p| p.split_once('/'));
        match inside {
            Some((token, rest)) if same_text(token, &self.token) => Ok(rest),
            _ => refused("the address lacks the token that `ozols studio` printed"),
        }
    }
}

/// Returns true if two texts are the same. The time does not depend on how much of them is the same.
fn same_text(a: &str, b: &str) -> bool {
    let differ = a.bytes().zip(b.bytes()).fold(0, |d, (x, y)| d | (x ^ y));
    a.len() == b.len() && differ == 0
}

/// Maximum number of connections that wait at a time. The page itself sends the head of a request at once.
const MOST_WAITING: usize = 64;

/// Connections that have not shown the token yet, the oldest first. They are not counted as requests with the token. If too many wait,
/// the oldest is closed.
#[derive(Debug, Default)]
pub(super) struct Waiting {
    list: Mutex<(u64, VecDeque<(u64, TcpStream)>)>,
}

impl Waiting {
    fn lock_list(&self) -> MutexGuard<'_, (u64, VecDeque<(u64, TcpStream)>)> {
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lets a connection wait until the place that is returned is dropped. Returns `None` if the system has no more handles.
    pub(super) fn enter_queue(self: &Arc<Self>, stream: &TcpStream) -> Option<WaitingPlace> {
        let handle = stream.try_clone().ok()?;
        let mut list = self.lock_list();
        list.0 += 1;
        let number = list.0;
        list.1.push_back((number, handle));
        if list.1.len() > MOST_WAITING
            && let Some((_, longest)) = list.1.pop_front()
        {
            // Its thread reads the end of the request, and ends.
            let _ = longest.shutdown(Shutdown::Both);
        }
        let waiting = self.clone();
        Some(WaitingPlace { waiting, number })
    }
}

/// The place of a connection that waits.
#[derive(Debug)]
pub(super) struct WaitingPlace {
    waiting: Arc<Waiting>,
    number: u64,
}

impl Drop for WaitingPlace {
    fn drop(&mut self) {
        let mut list = self.waiting.lock_list();
        list.1.retain(|(number, _)| *number != self.number);
    }
}
