//! Writers whose errors say what could not be written, and what to do about it.

use std::io::{self, ErrorKind, Write};

/// A writer to something with a name.
pub(super) struct Named<'n, W> {
    name: &'n str,
    out: W,
}

impl<W> Named<'_, W> {
    pub(super) fn new(name: &str, out: W) -> Named<'_, W> {
        Named { name, out }
    }

    /// Returns an error of the same kind that names what is written.
    fn named(&self, why: io::Error) -> io::Error {
        let remedy = match why.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
                "; make room there, or write elsewhere"
            }
            ErrorKind::FileTooLarge => "; raise the limit on the size of files (ulimit -f)",
            _ => "",
        };
        let words = format!("cannot write {}: {why}{remedy}", self.name);
        io::Error::new(why.kind(), words)
    }
}

impl<W: Write> Write for Named<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write(bytes).map_err(|why| self.named(why))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush().map_err(|why| self.named(why))
    }
}
