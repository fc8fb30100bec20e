//! Merges the parts of a catalogue, and finds the missing ones.

use super::held::{Store, Stored};
use super::open::plain_name;
use crate::catalog::spec::Spec;
use crate::catalog::store::version::StoreError;
use crate::shard::Shard;
use num_integer::Integer;
use rusqlite::params;
use std::path::{Path, PathBuf};

/// Maximum number of parts that are named one by one.
const FINEST: u64 = 100_000;

/// Result of merging.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Merged {
    /// Number of parts merged.
    pub taken: usize,
    /// Number of structures added.
    pub added: usize,
    /// Missing parts. Empty if all structures exist.
    pub missing: Vec<Shard>,
    /// Files whose part was not completed.
    pub unfinished: Vec<PathBuf>,
}

impl Merged {
    /// Merges a part into the whole, and opens the whole if necessary.
    fn take_in(&mut self, path: &Path, whole: Option<Store>, part: &Path) -> Stored<Store> {
        let from = Store::open_readonly(part)?;
        let other = || StoreError::Other(part.to_owned());
        let text = from.meta_value("spec")?.ok_or_else(other)?;
        toml::from_str::<Spec>(&text).map_err(|_| other())?;
        let is_finished = !from.finished_parts()?.is_empty();
        let whole = match whole {
            Some(mut whole) => {
                whole.be_of(&text)?;
                whole
            }
            None => Store::writable_of(path, &text)?,
        };
        self.added += whole.take_in(part)?;
        self.taken += 1;
        if !is_finished {
            self.unfinished.push(part.to_owned());
        }
        Ok(whole)
    }
}

impl Store {
    /// Adds the missing structures from other catalogues of the same specification. A part that cannot be merged is passed to `refuse` and
    /// does not affect the others.
    ///
    /// # Errors
    /// Returns an error if the merged file cannot be read.
    pub fn merge_parts(
        path: &Path,
        parts: &[PathBuf],
        mut refuse: impl FnMut(StoreError),
    ) -> Stored<Merged> {
        let mut merged = Merged::default();
        // The file is opened once, since opening reads all of it, and again after a part was refused.
        let mut whole: Option<Store> = None;
        for part in parts {
            match merged.take_in(path, whole.take(), part) {
                Ok(store) => whole = Some(store),
                Err(e) => refuse(e),
            }
        }
        if merged.taken > 0 {
            let whole = whole.map_or_else(|| Store::open_readonly(path), Ok)?;
            merged.missing = whole.missing_parts()?;
        }
        Ok(merged)
    }

    /// Records that a part is complete, with its number of structures.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn finish_part(&mut self, part: Shard, structures: usize) -> Stored<()> {
        let structures = i64::try_from(structures).unwrap_or(i64::MAX);
        let sql = "INSERT OR REPLACE INTO parts (part, structures) VALUES (?1, ?2)";
        self.change(sql, params![part.to_string(), structures])
    }

    /// Returns the complete parts.
    fn finished_parts(&self) -> Stored<Vec<Shard>> {
        let words = self.column("SELECT part FROM parts ORDER BY part", [])?;
        Ok(words.iter().filter_map(|w| w.parse().ok()).collect())
    }

    /// Returns the missing parts. Empty without a specification.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read.
    pub fn missing_parts(&self) -> Stored<Vec<Shard>> {
        if self.meta_value("spec")?.is_none() {
            return Ok(Vec::new());
        }
        Ok(missing_shards(&self.finished_parts()?))
    }

    fn take_in(&self, part: &Path) -> Stored<usize> {
        let all = || -> rusqlite::Result<usize> {
            self.attach_part(part)?;
            // Existing rows stay unchanged, without ideas of another search.
            self.db.execute_batch(
                "BEGIN IMMEDIATE;
                 CREATE TEMP TABLE there AS SELECT id FROM main.structures;",
            )?;
            let count = "SELECT count(*) FROM part.structures WHERE id NOT IN there";
            let added: i64 = self.db.query_row(count, [], |r| r.get(0))?;
            let of_structures = "layouts counts ideas strokes planes pairs classics".split(' ');
            let structures = std::iter::once(("structures", "id"));
            for (table, id) in structures.chain(of_structures.map(|table| (table, "structure"))) {
                let rows = format!("SELECT * FROM part.{table} WHERE {id} NOT IN there");
                (self.db).execute_batch(&format!("INSERT INTO main.{table} {rows}"))?;
            }
            self.db.execute_batch(
                "INSERT OR IGNORE INTO main.parts SELECT * FROM part.parts;
                 DROP TABLE there; COMMIT; DETACH DATABASE part;",
            )?;
            Ok(usize::try_from(added).unwrap_or(0))
        };
        self.check_result(all())
    }

    /// Attaches a part, whose name may have any bytes.
    fn attach_part(&self, part: &Path) -> rusqlite::Result<()> {
        let name = plain_name(part);
        #[cfg(unix)]
        let name = std::os::unix::ffi::OsStrExt::as_bytes(name.as_os_str());
        #[cfg(not(unix))]
        let name = name.to_string_lossy();
        self.db
            .execute("ATTACH DATABASE ?1 AS part", [&name])
            .map(drop)
    }
}

/// Returns the missing parts, in a partition that contains all given ones.
fn missing_shards(there: &[Shard]) -> Vec<Shard> {
    let of = there.iter().fold(
        1,
        |all: u64, part| {
            if all > FINEST { all } else { all.lcm(&part.of) }
        },
    );
    if of > FINEST {
        return vec![Shard::WHOLE];
    }
    let has = |index: u64| there.iter().any(|p| index % p.of == p.index);
    let all = (0..of).filter(|&index| !has(index));
    all.map(|index| Shard { index, of }).collect()
}

#[cfg(test)]
mod tests {
    use super::missing_shards;
    use crate::shard::Shard;

    fn words(there: &[&str]) -> String {
        let there: Vec<Shard> = there.iter().map(|p| p.parse().unwrap()).collect();
        let all: Vec<String> = missing_shards(&there)
            .iter()
            .map(ToString::to_string)
            .collect();
        all.join(" ")
    }

    #[test]
    fn parts_of_different_numbers_make_a_whole() {
        assert_eq!(words(&["1/1"]), "");
        assert_eq!(words(&[]), "1/1");
        assert_eq!(words(&["1/3", "3/3"]), "2/3");
        assert_eq!(words(&["1/2", "2/4", "4/4"]), "");
        assert_eq!(words(&["1/2", "2/4"]), "4/4");
        // Every missing piece is in one of the named parts, none of which is in the file.
        let there: Vec<Shard> = ["1/2", "3/3"].map(|p| p.parse().unwrap()).into();
        let gone = missing_shards(&there);
        for piece in 0..200 {
            let name = piece.to_string();
            let is_there = there.iter().any(|p| p.has_piece(&name));
            assert_eq!(
                is_there,
                !gone.iter().any(|p| p.has_piece(&name)),
                "{piece}"
            );
        }
    }

    #[test]
    fn parts_too_many_to_be_named_are_the_whole() {
        assert_eq!(words(&["1/99991", "1/99989"]), "1/1");
        let most = u64::MAX.to_string();
        assert_eq!(words(&[&format!("1/{most}"), "1/2"]), "1/1");
    }
}
