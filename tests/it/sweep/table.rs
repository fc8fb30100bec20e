//! The table of a sweep, however it is made: in threads, in parts, torn and carried on.

use super::{Works, all, asked, sweep, three_rods};
use ozols::Request;
use ozols::shard::Shard;
use ozols::sweep::SweepRequest;
use ozols::sweep::space::Sampling;
use ozols::sweep::table::{SweepWatch, make, merge, read};
use std::fs;
use std::path::Path;

/// Ends after so many calls.
struct Ends(usize);

impl SweepWatch for Ends {
    fn done(&mut self, _: usize, _: usize) {
        self.0 = self.0.saturating_sub(1);
    }
    fn ended(&self) -> bool {
        self.0 == 0
    }
}

#[test]
fn a_table_has_the_same_bytes_however_it_was_made() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let asked = SweepRequest {
        search: Some(Request::default()),
        ..asked()
    };
    let sweep = sweep(&three_rods(), Sampling::Grid { points: 4 }, asked);
    let whole = at("whole.jsonl");
    let table = all(&sweep, Some(&whole));
    let bytes = fs::read(&whole).unwrap();
    assert_eq!(
        (table.added, table.rows.len(), table.finished),
        (16, 16, true)
    );

    let threads = rayon_of(1);
    threads.install(|| all(&sweep, Some(&at("one.jsonl"))));
    assert!(
        fs::read(at("one.jsonl")).unwrap() == bytes,
        "with one thread"
    );

    // A second run does nothing.
    let before = fs::metadata(&whole).unwrap().modified().unwrap();
    assert_eq!(all(&sweep, Some(&whole)).added, 0);
    assert_eq!(fs::metadata(&whole).unwrap().modified().unwrap(), before);

    // Ended at any byte, it is carried on.
    for part in [0, 1, 100, bytes.len() / 3, bytes.len() / 2, bytes.len() - 1] {
        fs::write(at("torn.jsonl"), &bytes[..part]).unwrap();
        all(&sweep, Some(&at("torn.jsonl")));
        assert!(
            fs::read(at("torn.jsonl")).unwrap() == bytes,
            "after {part} bytes"
        );
    }
    // And so it is where it was told to end.
    let path = at("ended.jsonl");
    let table =
        rayon_of(1).install(|| make(&sweep, Shard::WHOLE, Some(&path), &mut Ends(2)).unwrap());
    assert_eq!((table.rows.len(), table.finished), (8, false));
    assert!(read(&path).is_err());
    assert_eq!(all(&sweep, Some(&path)).added, 8);
    assert!(fs::read(&path).unwrap() == bytes);

    let parts: Vec<_> = (1..=3).map(|i| at(&format!("{i}.jsonl"))).collect();
    for (i, path) in (1..).zip(&parts) {
        let part = make(&sweep, Shard::nth(i, 3).unwrap(), Some(path), &mut Works).unwrap();
        assert!(part.finished && part.rows.len() < 16);
    }
    let reversed: Vec<_> = parts.iter().rev().cloned().collect();
    // What a merge that was killed left is cleaned; what is none of its files is not.
    for left in [
        "merged.jsonl.4242.tmp",
        "merged.jsonl.tmp",
        "other.jsonl.4242.tmp",
    ] {
        fs::write(at(left), "left").unwrap();
    }
    let merged = merge(&reversed, &at("merged.jsonl")).unwrap();
    assert!(!at("merged.jsonl.4242.tmp").exists());
    for other in ["merged.jsonl.tmp", "other.jsonl.4242.tmp"] {
        fs::remove_file(at(other)).unwrap();
    }
    assert!(
        fs::read(at("merged.jsonl")).unwrap() == bytes,
        "in three parts"
    );
    assert_eq!(merged.digest, table_digest(&whole));
    let names: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .map(|e| e.unwrap().file_name())
        .collect();
    assert!(
        names
            .iter()
            .all(|n| n.to_string_lossy().ends_with(".jsonl")),
        "{names:?}"
    );
}

fn table_digest(path: &Path) -> ozols::shard::Digest {
    read(path).unwrap().digest
}

fn rayon_of(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap()
}
