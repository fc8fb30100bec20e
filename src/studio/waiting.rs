//! Connections that have not shown the token yet. They take no place of those that have: where too many wait, the one that has waited
//! longest is closed.

use std::collections::VecDeque;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Most connections that wait at a time. The head of a request of the page itself is here at once.
const MOST: usize = 64;

/// The connections that wait, the one that came first at the front.
#[derive(Debug, Default)]
pub(super) struct Waiting {
    list: Mutex<(u64, VecDeque<(u64, TcpStream)>)>,
}

impl Waiting {
    fn lock(&self) -> MutexGuard<'_, (u64, VecDeque<(u64, TcpStream)>)> {
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lets a connection wait until the place that is returned is dropped. Returns `None` if the system has no more handles.
    pub(super) fn enter(self: &Arc<Self>, stream: &TcpStream) -> Option<WaitingPlace> {
        let handle = stream.try_clone().ok()?;
        let mut list = self.lock();
        list.0 += 1;
        let number = list.0;
        list.1.push_back((number, handle));
        if list.1.len() > MOST
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
        let mut list = self.waiting.lock();
        list.1.retain(|(number, _)| *number != self.number);
    }
}
