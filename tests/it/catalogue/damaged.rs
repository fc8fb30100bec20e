//! Catalogues that are damaged: bytes changed, pages lost. SQLite's own check says which of them no command may take.

use super::carried_on::scattered_numbers;
use super::command::path_in;
use crate::common::*;
use rusqlite::Connection;

/// Bytes of a page of a catalogue.
const PAGE: usize = 8192;

/// Returns a file with something of it changed: some bytes, a page of zeros, a page in the place of another, or its end cut off.
fn damaged(bytes: &[u8], random: &mut impl Iterator<Item = u64>) -> Vec<u8> {
    let mut below = |n: usize| usize::try_from(random.next().unwrap()).unwrap() % n;
    let mut out = bytes.to_vec();
    let page = |n: usize| n * PAGE..(n + 1) * PAGE;
    let pages = bytes.len() / PAGE;
    match below(6) {
        0 => out.truncate(below(bytes.len())),
        1 => out.truncate(below(pages) * PAGE),
        2 => out[page(below(pages))].fill(0),
        3 => {
            let from = below(pages);
            out.copy_within(page(from), below(pages) * PAGE);
        }
        // Heads of pages are where most goes wrong.
        4 => {
            for _ in 0..=below(3) {
                let at = below(pages) * PAGE + below(24);
                out[at] ^= u8::try_from(1 + below(255)).unwrap();
            }
        }
        _ => {
            for _ in 0..=below(40) {
                let at = below(bytes.len());
                out[at] ^= u8::try_from(1 + below(255)).unwrap();
            }
        }
    }
    out
}

/// Whether SQLite finds nothing wrong with a file.
fn is_well(file: &str) -> bool {
    let db = Connection::open(file).unwrap();
    let found = db.query_row("PRAGMA quick_check", [], |r| r.get::<_, String>(0));
    found.is_ok_and(|said| said == "ok")
}

#[test]
fn what_fails_the_quick_check_is_refused_by_every_command() {
    let folder = tempdir().unwrap();
    let good = path_in(&folder, "good.db");
    let build = [
        "catalog", "build", "--links", "4", "--ideas", "2", "--quiet", "-o",
    ];
    stdout_of(&[&build[..], &[&good]].concat());
    let bytes = fs::read(&good).unwrap();
    let ids = "SELECT structure FROM layouts LIMIT 1";
    let id = stdout_of(&["catalog", "query", &good, ids, "--format", "csv"]);
    let id = id.lines().nth(1).unwrap();
    let [file, whole, page] = ["bad.db", "whole.db", "page.html"].map(|n| path_in(&folder, n));
    let commands: [&[&str]; 8] = [
        &[&build[..], &[&file]].concat(),
        &["catalog", "merge", &file, "-o", &whole],
        &["catalog", "merge", &good, "-o", &file],
        &["catalog", "query", &file],
        &["catalog", "show", &file, id],
        &["catalog", "export", &file, id, "-q"],
        &["catalog", "find", "gripper-10", "--in", &file],
        &["catalog", "page", &file, "-o", &page],
    ];
    let cases = std::env::var("OZOLS_FUZZ").map_or(15, |n| n.parse::<usize>().unwrap());
    let seed = fresh_seed();
    let mut random = scattered_numbers(seed);
    let (mut bad, mut with_word) = (0, 0);
    for case in 0..cases {
        let changed = damaged(&bytes, &mut random);
        fs::write(&file, &changed).unwrap();
        let is_well = is_well(&file);
        bad += usize::from(!is_well);
        for words in commands {
            fs::write(&file, &changed).unwrap();
            for made in [&whole, &page] {
                let _ = fs::remove_file(made);
            }
            let o = run(words);
            let said = utf8_text(&o.stderr);
            let code = o.status.code();
            let what = format!("seed {seed}, case {case}, {words:?}: {code:?} {said}");
            if is_well {
                assert!(matches!(code, Some(0..=2)), "{what}");
                continue;
            }
            assert_eq!(code, Some(2), "{what}");
            assert!(said.contains("bad.db"), "{what}");
            assert!(fs::read(&file).unwrap() == changed, "{what}");
            with_word += usize::from(said.contains(" is damaged ("));
        }
    }
    // A file whose head is gone is no database to SQLite, and is refused as such.
    assert!(with_word > 0);
    eprintln!("{cases} files, {bad} of them damaged to SQLite, none taken");
}
