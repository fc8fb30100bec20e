//! Files read no further than a bound: the one way that files of any size are read by. Each is noted as read.

use super::identity;
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// The bytes of a file, one more than `limit` at most: the reader of them says that there are too many.
///
/// # Errors
/// Where it is no regular file, or cannot be read.
pub fn bytes(path: &Path, limit: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    regular(path)?
        .take(limit as u64 + 1)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The same where nobody else says that there are too many.
///
/// # Errors
/// Where it is no regular file, is longer, or cannot be read.
pub fn at_most(path: &Path, limit: usize) -> io::Result<Vec<u8>> {
    let all = bytes(path, limit)?;
    if all.len() > limit {
        Err(too_long(limit))
    } else {
        Ok(all)
    }
}

/// The text of a file.
///
/// # Errors
/// As [`at_most`], and where it is no UTF-8.
pub fn text(path: &Path, limit: usize) -> io::Result<String> {
    let text = String::from_utf8(at_most(path, limit)?);
    text.map_err(|_| io::Error::new(ErrorKind::InvalidData, "it is not UTF-8 text"))
}

/// An open file that is none of those that never end, or wait for ever to be opened.
///
/// # Errors
/// Where it is none, or cannot be opened.
pub fn regular(path: &Path) -> io::Result<File> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    identity::note(path);
    File::open(path)
}

fn too_long(limit: usize) -> io::Error {
    io::Error::new(
        ErrorKind::InvalidData,
        format!("it has more than the {limit} bytes that are read"),
    )
}
