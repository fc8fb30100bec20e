//! Nothing is refused and nothing lost, wherever a command that writes a catalogue is killed, and however many write one at once.
//!
//! `killed.c` is put in front of the functions that write, and kills the process at its Nth write. `OZOLS_KILLS=10000` takes so
//! many places, all that there are and further ones in greater catalogues; a few of each command by default.

use super::carried_on::scattered_numbers;
use super::command::{path_in, small_build};
use crate::common::*;
use ozols::catalog::store::Store;
use std::process::Command;

/// The structures of four links, each a transaction.
fn tiny(file: &str, more: &str) -> String {
    format!("catalog build --links 4 --ideas 1 --threads 1 --quiet -o {file} {more}")
}

/// A command without its output, not begun yet.
#[cfg(unix)]
fn quiet(line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ozols"));
    command
        .args(split_words(line))
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command
}

/// What kills a process at a write.
#[cfg(target_os = "linux")]
fn killer(folder: &TempDir) -> PathBuf {
    let [source, made] = ["killed.c", "killed.so"].map(|n| folder.path().join(n));
    fs::write(&source, include_str!("killed.c")).unwrap();
    let mut cc = Command::new("cc");
    cc.args(["-shared", "-fPIC", "-O1", "-o"])
        .args([&made, &source])
        .arg("-ldl");
    assert!(cc.status().unwrap().success());
    made
}

/// Runs a command that is killed at a write; whether it was.
#[cfg(target_os = "linux")]
fn killed_at(killer: &Path, line: &str, write: usize) -> bool {
    use std::os::unix::process::ExitStatusExt as _;
    let mut command = quiet(line);
    command
        .env("LD_PRELOAD", killer)
        .env("OZOLS_KILL_AT", write.to_string());
    let status = command.status().unwrap();
    match status.signal() {
        Some(9) => true,
        None if status.success() => false,
        _ => panic!("{line}, write {write}: {status}"),
    }
}

/// How many places of each command are taken.
fn places(by_default: usize) -> usize {
    let said = std::env::var("OZOLS_KILLS").ok();
    said.map_or(by_default, |n| n.parse::<usize>().unwrap() / 3)
}

/// Kills a command at writes from the first to the last, or at as many places as are asked for, and each time lets it be
/// carried on. What it then holds is what it holds where nothing was killed.
#[cfg(target_os = "linux")]
fn wherever_it_is_killed(some: usize, command: &dyn Fn(&str) -> String) {
    let folder = tempdir().unwrap();
    let killer = killer(&folder);
    let plain = path_in(&folder, "plain.db");
    stdout_of(&command(&plain));
    let wanted = held(&plain);
    // The places among the first writes, where it is made, are all taken.
    let last = {
        let file = path_in(&folder, "counted.db");
        let (mut low, mut high) = (1_usize, 1 << 12);
        while low < high {
            let middle = (low + high).div_ceil(2);
            remove(&file);
            if killed_at(&killer, &command(&file), middle) {
                low = middle
            } else {
                high = middle - 1
            }
        }
        low
    };
    let places = places(some);
    let first = 1..=last.min(places / 2);
    let more = scattered_numbers(3).map(|x| 1 + usize::try_from(x).unwrap() % last);
    let mut taken = 0;
    for write in first.chain(more).take(places) {
        let file = path_in(&folder, "killed.db");
        remove(&file);
        // Rows come as threads make them, so that one run writes a little less often than another.
        let killed = killed_at(&killer, &command(&file), write);
        assert!(killed || write > last / 2, "{write} of {last}");
        // Every third time it is killed again while it carries on, early.
        if write % 3 == 0 {
            let _ = killed_at(&killer, &command(&file), 1 + write % 7);
        }
        // Whoever looks in between is told what is there, or that nothing is.
        if write % 5 == 0 && Path::new(&file).exists() {
            let (code, _, said) = run_full(&["catalog", "query", &file]);
            let answered = matches!(code, Some(0 | 1));
            assert!(answered || said.contains("is empty"), "{write}: {said}");
        }
        stdout_of(&command(&file));
        assert!(held(&file) == wanted, "killed at write {write} of {last}");
        taken += usize::from(killed);
    }
    assert!(10 * taken >= 8 * places.min(last), "{taken} of {places}");
    eprintln!("{taken} kills at {last} writes");
}

/// All that a catalogue holds, and the parts that are whole.
fn held(file: &str) -> String {
    let store = Store::open_readonly(Path::new(file)).unwrap();
    let tables = [
        "parts ORDER BY part",
        "structures ORDER BY id",
        "layouts ORDER BY structure",
        "counts ORDER BY structure, mobility, changes",
        "ideas ORDER BY structure, place",
    ];
    let all = |t: &str| {
        store
            .query_rows(&format!("SELECT * FROM {t}"), None)
            .unwrap()
    };
    tables.map(|t| format!("{:?}", all(t))).join("\n")
}

fn remove(file: &str) {
    for ending in ["", "-journal"] {
        let _ = fs::remove_file(format!("{file}{ending}"));
    }
}

/// Once refused: after a kill at one of nine of 107 writes the same command said that its file was no catalogue.
#[cfg(target_os = "linux")]
#[test]
fn a_build_carries_on_wherever_it_is_killed() {
    wherever_it_is_killed(40, &|file| tiny(file, ""));
}

#[cfg(target_os = "linux")]
#[test]
fn a_merge_carries_on_wherever_it_is_killed() {
    let folder = tempdir().unwrap();
    let parts = [1, 2, 3].map(|part| {
        let file = path_in(&folder, &format!("{part}.db"));
        stdout_of(&tiny(&file, &format!("--shard {part}/3")));
        file
    });
    let parts = parts.join(" ");
    wherever_it_is_killed(40, &|file| format!("catalog merge {parts} -o {file}"));
}

/// Starts as many commands as files are named, and waits for all.
fn at_once(all: &[String]) -> Vec<Output> {
    let start = |line: &String| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ozols"));
        command
            .args(split_words(line))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command.spawn().unwrap()
    };
    let started = all.iter().map(start).collect_vec();
    let ended = started.into_iter().map(|c| c.wait_with_output().unwrap());
    ended.collect()
}

/// Once wrong: two failed in six of ten trials ("table meta already exists").
#[test]
fn one_to_eight_may_make_a_catalogue_at_once() {
    let folder = tempdir().unwrap();
    let plain = path_in(&folder, "plain.db");
    stdout_of(&tiny(&plain, ""));
    let wanted = held(&plain);
    let trials = match std::env::var_os("OZOLS_KILLS") {
        Some(_) => 20,
        None => 1,
    };
    for (n, trial) in (1..=8).flat_map(|n| (0..trials).map(move |t| (n, t))) {
        let file = path_in(&folder, &format!("{n}-{trial}.db"));
        for o in at_once(&vec![tiny(&file, ""); n]) {
            assert_eq!(
                o.status.code(),
                Some(0),
                "{n} at once: {}",
                utf8_text(&o.stderr)
            );
        }
        assert!(held(&file) == wanted, "{n} at once");
    }
}

/// Parts of it and a merge, all into one new file.
#[test]
fn different_commands_may_make_a_catalogue_at_once() {
    let folder = tempdir().unwrap();
    let [part, file, plain] = ["part.db", "all.db", "plain.db"].map(|n| path_in(&folder, n));
    stdout_of(&tiny(&part, "--shard 3/3"));
    let outputs = at_once(&[
        tiny(&file, "--shard 1/3"),
        tiny(&file, "--shard 2/3"),
        format!("catalog merge {part} -o {file}"),
    ]);
    // The merge may come when the parts are not finished, and says so then.
    for (n, o) in outputs.iter().enumerate() {
        let code = o.status.code();
        assert!(
            code == Some(0) || n == 2 && code == Some(1),
            "{}",
            utf8_text(&o.stderr)
        );
    }
    stdout_of(&tiny(&plain, ""));
    let rows = |file: &str| held(file).split_once("\n").unwrap().1.to_owned();
    assert!(rows(&file) == rows(&plain));
}

/// Kills of several at once: those that are left, and those that come after, make the whole.
#[cfg(unix)]
#[test]
fn some_of_several_may_be_killed() {
    let folder = tempdir().unwrap();
    let [plain, file] = ["plain.db", "some.db"].map(|n| path_in(&folder, n));
    stdout_of(&small_build(&plain, ""));
    for wait in scattered_numbers(11).take(6) {
        let start = |_| quiet(&small_build(&file, "--threads 1")).spawn().unwrap();
        let mut all = (0..3).map(start).collect_vec();
        std::thread::sleep(std::time::Duration::from_millis(wait % 250));
        for child in &mut all {
            let _ = child.kill();
            child.wait().unwrap();
        }
    }
    stdout_of(&small_build(&file, ""));
    assert!(held(&file) == held(&plain));
}
