//! The same rows whatever the threads, the shards and the interruptions.

use super::command::{at, small, whole};
use crate::common::*;
use assert_cmd::cargo::CommandCargoExt as _;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[test]
fn a_catalogue_is_the_same_whatever_the_threads_and_the_shards() {
    let folder = tempdir().unwrap();
    let one = at(&folder, "one.db");
    ok(&small(&one, &["--threads", "1"]));
    let rows = whole(&one);
    assert!(rows.contains("slide,mirror") && rows.contains("turn,half-turn"));
    for threads in ["2", "8"] {
        let more = at(&folder, &format!("{threads}-threads.db"));
        ok(&small(&more, &["--threads", threads]));
        assert_eq!(whole(&more), rows, "{threads} threads");
    }
    let mut merge = vec!["catalog".to_owned(), "merge".to_owned()];
    for i in 1..=7 {
        let part = at(&folder, &format!("{i}.db"));
        ok(&small(&part, &["--shard", &format!("{i}/7")]));
        merge.push(part);
    }
    let merged = at(&folder, "merged.db");
    merge.extend(["-o".to_owned(), merged.clone()]);
    ok(&merge.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(whole(&merged), rows);
    // What is there already is not made again.
    assert!(ok(&small(&one, &[])).contains("0 structures added"));
}

/// Numbers that look random, the same on every run.
pub(super) fn scattered(seed: u64) -> impl Iterator<Item = u64> {
    let mut x = seed;
    std::iter::repeat_with(move || {
        x = x
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        x >> 33
    })
}

/// Runs a command and kills it ten times, each after a share of the time that it takes, and then lets it end.
#[cfg(unix)]
fn kill_ten_times(args: &[&str], takes: Duration) {
    for share in scattered(7).take(10) {
        let mut child = Command::cargo_bin("ozols")
            .unwrap()
            .args(args)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // Ten thirds of it in the mean: what is done is not done again.
        let share = u32::try_from(share % 1000).unwrap();
        std::thread::sleep(takes * share / 1500);
        child.kill().unwrap();
        child.wait().unwrap();
    }
    ok(args);
}

#[cfg(unix)]
#[test]
fn killed_at_any_moment_it_carries_on() {
    let folder = tempdir().unwrap();
    let (whole_file, killed) = (at(&folder, "whole.db"), at(&folder, "killed.db"));
    let begun = Instant::now();
    ok(&small(&whole_file, &[]));
    kill_ten_times(&small(&killed, &[]), begun.elapsed());
    assert_eq!(whole(&killed), whole(&whole_file));
}

/// Drawn mechanisms are there as soon as each is searched, and are not searched again.
#[cfg(unix)]
#[test]
fn a_search_of_drawn_mechanisms_carries_on_too() {
    let folder = tempdir().unwrap();
    let (whole_file, killed) = (at(&folder, "whole.db"), at(&folder, "killed.db"));
    fn drawn<'a>(file: &'a str, ideas: &'a str) -> Vec<&'a str> {
        let words = "catalog search tongs geared-gripper four-bar four-bar-planar spherical-four-bar --quiet --ideas";
        words.split(' ').chain([ideas, "-o", file]).collect()
    }
    let begun = Instant::now();
    assert!(ok(&drawn(&whole_file, "3")).contains("5 mechanisms added"));
    kill_ten_times(&drawn(&killed, "3"), begun.elapsed());
    assert_eq!(whole(&killed), whole(&whole_file));
    assert!(ok(&drawn(&killed, "3")).contains("0 mechanisms added"));
    // Asked for fewer ideas, it keeps no more.
    assert!(ok(&drawn(&killed, "1")).contains("5 mechanisms added"));
    let most = ok(&[
        "catalog",
        "query",
        &killed,
        "SELECT max(place) AS most FROM ideas",
        "--format",
        "csv",
    ]);
    assert_eq!(most, "most\n1\n");
}

/// What is there stays as it is: no idea of another search of the same mechanism is mixed into it.
#[test]
fn merging_keeps_the_first_search_of_a_mechanism_whole() {
    let folder = tempdir().unwrap();
    let all: Vec<String> = ["2", "3"]
        .iter()
        .map(|ideas| {
            let file = at(&folder, &format!("{ideas}.db"));
            let words = ["catalog", "search", "tongs", "four-bar", "--quiet"];
            ok(&[&words[..], &["--ideas", ideas, "-o", &file]].concat());
            file
        })
        .collect();
    let merged = at(&folder, "merged.db");
    ok(&["catalog", "merge", &all[0], &all[1], "-o", &merged]);
    assert_eq!(whole(&merged), whole(&all[0]));
    assert_ne!(whole(&all[0]), whole(&all[1]));
}
