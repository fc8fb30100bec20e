//! Parts put together.

use super::error::TableError;
use super::lines::{Output, read};
use super::rows::Table;
use crate::file::leftover;
use crate::shard::{Digest, Shard};
use itertools::Itertools;
use std::path::{Path, PathBuf};

/// Puts the parts of a sweep together; every part must be there once, whole and of the same sweep. The table is, byte for byte,
/// the one that is made at once, and appears under its name once it is complete.
///
/// # Errors
/// Where a part is missing, not finished, changed or of another sweep, or the whole cannot be written.
pub fn merge(parts: &[PathBuf], whole: &Path) -> Result<Table, TableError> {
    let GatheredParts { all, shards } = gather(parts)?;
    let mut all = all.ok_or_else(|| TableError::Parts("there are none".to_owned()))?;
    all_once(&shards)?;
    all.rows.sort_by_key(|r| r.sample);
    if !all.rows.iter().map(|r| r.sample).eq(0..all.head.samples) {
        let why = "some samples are missing";
        return Err(TableError::Parts(why.to_owned()));
    }
    all.head.shard = Shard::WHOLE.to_string();
    let rows = std::mem::take(&mut all.rows);
    all.digest = Digest::default();
    let text = all.add(rows);
    clean(whole);
    let mut beside = whole.as_os_str().to_owned();
    beside.push(format!(".{}.tmp", std::process::id()));
    let beside = PathBuf::from(beside);
    // Held until it has its name, so that nobody takes it for a left one.
    let placed = Output::open(&beside, &all.head).and_then(|mut out| {
        out.add(&text)?;
        out.finish(&all.digest)?;
        Output::wrap(whole, std::fs::rename(&beside, whole))
    });
    if placed.is_err() {
        let _ = std::fs::remove_file(&beside);
    }
    placed.map(|()| all)
}

/// Parts of one sweep.
struct GatheredParts {
    /// Their rows in one table, in the order of the parts; none where there are no parts.
    all: Option<Table>,
    /// Which part of how many each is.
    shards: Vec<(u64, u64)>,
}

/// Reads the parts, which must be of the same sweep.
fn gather(parts: &[PathBuf]) -> Result<GatheredParts, TableError> {
    let mut all: Option<Table> = None;
    let mut shards: Vec<(u64, u64)> = Vec::new();
    for path in parts {
        let part = read(path)?;
        let of: Shard = part
            .head
            .shard
            .parse()
            .map_err(|_| TableError::Other(path.clone()))?;
        shards.push((of.index, of.of));
        match &mut all {
            None => all = Some(part),
            Some(all) => {
                if let Some((what, there, asked)) = part.head.differs(&all.head) {
                    let path = path.clone();
                    return Err(TableError::Differs {
                        path,
                        what,
                        there,
                        asked,
                    });
                }
                all.rows.extend(part.rows);
            }
        }
    }
    Ok(GatheredParts { all, shards })
}

/// Refuses parts, one at least, that are not each of them there once.
fn all_once(shards: &[(u64, u64)]) -> Result<(), TableError> {
    let of = shards[0].1;
    let (missing, twice) = (
        (0..of).find(|i| !shards.contains(&(*i, of))),
        shards.iter().duplicates().next(),
    );
    let why = match (missing, twice, shards.iter().find(|s| s.1 != of)) {
        (.., Some(other)) => format!("one is of {of}, another of {}", other.1),
        (_, Some((i, of)), _) => format!("{}/{of} is there twice", i + 1),
        (Some(i), ..) => format!("{}/{of} is missing", i + 1),
        (None, None, None) => return Ok(()),
    };
    Err(TableError::Parts(why))
}

/// Removes what merges that were killed left beside the whole.
fn clean(whole: &Path) {
    let (Some(folder), Some(name)) = (whole.parent(), whole.file_name()) else {
        return;
    };
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let name = name.as_encoded_bytes();
    leftover::clean(folder, |other| {
        let rest = other.as_encoded_bytes().strip_prefix(name);
        let number = rest.and_then(|r| r.strip_prefix(b".")?.strip_suffix(b".tmp"));
        number.is_some_and(|n| !n.is_empty() && n.iter().all(u8::is_ascii_digit))
    });
}
