//! The same rows whatever the threads, the shards and the interruptions.

use super::command::{dump_catalogue, path_in, small_build};
use crate::common::*;

#[test]
fn a_catalogue_is_the_same_whatever_the_threads_and_the_shards() {
    let folder = tempdir().unwrap();
    let made = |name: &str, more: &str| {
        let file = path_in(&folder, name);
        stdout_of(&small_build(&file, more));
        file
    };
    let one = made("one.db", "--threads 1");
    let rows = dump_catalogue(&one);
    has_all(&rows, &["slide,mirror", "turn,half-turn"]);
    for threads in ["2", "8"] {
        let more = made(threads, &format!("--threads {threads}"));
        assert_eq!(dump_catalogue(&more), rows, "{threads} threads");
    }
    let parts = (1..=7).map(|i| made(&format!("{i}.db"), &format!("--shard {i}/7")));
    let merged = path_in(&folder, "merged.db");
    stdout_of(&format!(
        "catalog merge {} -o {merged}",
        parts.collect_vec().join(" ")
    ));
    assert_eq!(dump_catalogue(&merged), rows);
    // What is there already is not made again.
    has(&stdout_of(&small_build(&one, "")), "0 structures added");
}

/// Numbers that look random, the same on every run.
pub(super) fn scattered_numbers(seed: u64) -> impl Iterator<Item = u64> {
    let mut x = seed;
    std::iter::repeat_with(move || {
        x = x
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        x >> 33
    })
}
