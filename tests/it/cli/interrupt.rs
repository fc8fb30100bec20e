//! Signals: what is said, what is left, and the exit code.

use crate::common::*;
use std::process::{Child, Command};
use std::thread::sleep;

/// The exit codes of signals by name.
const SIGNALS: [(&str, i32); 3] = [("INT", 130), ("TERM", 143), ("HUP", 129)];

/// Those that the tests themselves were not begun to ignore, as under `nohup`: what they start ignores them too, rightly.
fn signals() -> impl Iterator<Item = (&'static str, i32)> {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let ignored = mask.and_then(|m| u64::from_str_radix(m.trim(), 16).ok());
    let heard = move |code: i32| ignored.unwrap_or(0) >> (code - 129) & 1 == 0;
    SIGNALS.into_iter().filter(move |s| heard(s.1))
}

/// Options that take brute force minutes.
const MANY: &str = "revolute,cylindrical,universal,spherical";

/// Starts a command in a folder.
fn start<L: Line + ?Sized>(folder: &Folder, args: &L) -> Child {
    let mut ozols = Command::new(env!("CARGO_BIN_EXE_ozols"));
    ozols.args(args.words());
    spawn_in(folder, ozols)
}

/// Starts a command that the system ends after so many seconds of processor time.
fn start_limited(folder: &Folder, args: &str, seconds: u32) -> Child {
    let ozols = env!("CARGO_BIN_EXE_ozols");
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("ulimit -t {seconds}; exec '{ozols}' {args}")]);
    spawn_in(folder, shell)
}

fn spawn_in(folder: &Folder, mut command: Command) -> Child {
    command
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn send(child: &Child, signal: &str) {
    let status = Command::new("kill")
        .args([&format!("-{signal}"), &child.id().to_string()])
        .status();
    assert!(status.unwrap().success());
}

/// Sends a signal once `ready`, and gives what the command leaves.
fn interrupted(mut child: Child, signal: &str, mut ready: impl FnMut() -> bool) -> Output {
    let begun = Instant::now();
    while !ready() {
        let ended = child.try_wait().unwrap();
        assert!(
            ended.is_none() && begun.elapsed() < Duration::from_secs(60),
            "ended before it could be interrupted, or never came that far"
        );
        sleep(Duration::from_millis(5));
    }
    send(&child, signal);
    child.wait_with_output().unwrap()
}

/// Bytes of the temporary file that a command is writing.
fn written(folder: &Folder) -> u64 {
    let sizes = temporary(folder).into_iter();
    let sizes = sizes.filter_map(|f| Some(fs::metadata(folder.path(&f)).ok()?.len()));
    sizes.sum()
}

fn temporary(folder: &Folder) -> Vec<String> {
    let all = folder.names().into_iter();
    all.filter(|f| f.starts_with(".tmp")).collect()
}

/// Once wrong: code 0, not a word, and 102,736 of 25,761,436 rows under the final name.
#[test]
fn a_list_that_is_cut_short_says_so_at_its_end() {
    for (signal, code) in signals() {
        for format in ["csv", "jsonl", "json"] {
            let folder = &Folder::new();
            let line = format!("search gripper-10 --all --check prime --format {format} -o list");
            let child = start(folder, &line);
            let o = interrupted(child, signal, || written(folder) > 100_000);
            assert_eq!(o.status.code(), Some(code), "{signal} {format}");
            has(&utf8_text(&o.stderr), "interrupted by");
            assert_eq!(folder.names(), ["list"], "{signal}");
            let list = folder.text("list");
            let last = list.lines().last().unwrap();
            match format {
                // Rows alone: what reads them as a table is not to stumble.
                "csv" => {
                    let given = list.lines().count() - 1;
                    let end = format!(
                        "stopped early (interrupted): {given} of 21817629 admissible variants given\n"
                    );
                    has(&utf8_text(&o.stderr), &end);
                    lacks(&list, "#");
                }
                "jsonl" => {
                    let end: Value = serde_json::from_str(last).unwrap();
                    assert_eq!(end["stop"], "interrupted");
                    assert_eq!(end["given"], list.lines().count() - 1);
                    assert_eq!(end["admissible"], "25761436");
                }
                _ => {
                    let whole: Value = serde_json::from_str(&list).unwrap();
                    assert_eq!(whole["variants_stop"], "interrupted");
                    assert_eq!(whole["variants_complete"], false);
                    // The counts were finished before, and are what they are.
                    assert_eq!(whole["stop"], "exhausted");
                }
            }
        }
    }
}

/// A list cut to the node budget is no whole list either.
#[test]
fn a_list_of_a_bounded_search_says_so_at_its_end() {
    let line = "search gripper-10 --nodes 50 --top 2 --format csv";
    let csv = run_quiet(&format!("{line} --comment"));
    let last = csv.lines().last().unwrap();
    assert!(last.starts_with("# stopped early (node-budget): 2 of at least"));
    // Unless it is asked for in the list, it is said beside it.
    let (_, plain, said) = run_full(line);
    assert!(said.starts_with("stopped early (node-budget): 2 of at least"));
    assert_eq!(csv.strip_suffix(&format!("{last}\n")).unwrap(), plain);
}

/// Work that has nothing to give before its end ends at once, and leaves nothing.
#[test]
fn whatever_takes_long_ends_at_once() {
    for args in [
        "analyze delta --stroke 0:20deg:9999 -o x",
        &format!("search gripper-10 --method brute --options {MANY} -o x"),
        "accuracy -o x",
    ] {
        let folder = &Folder::new();
        let begun = Instant::now();
        // 0.4 s until the signal and less than two after it, on two threads.
        let child = start_limited(folder, &format!("{args} --threads 2"), 4);
        let o = interrupted(child, "INT", || {
            begun.elapsed() > Duration::from_millis(400)
        });
        assert_eq!(o.status.code(), Some(130), "{args} {o:?}");
        assert_eq!(utf8_text(&o.stderr), "interrupted by Ctrl-C\n", "{args:?}");
        assert_eq!(written(folder), 0);
        assert!(!folder.path("x").is_file());
    }
}

/// A ranking gives the best of what it scored, and poses what was looked at.
#[test]
fn a_ranking_and_poses_end_with_what_they_have() {
    let folder = &Folder::new();
    for args in [
        "search gripper-10-loaded --pool 100000000 --rank peak-force,conditioning --check none --format json",
        "search gripper-10 --poses 9000 --top 1000 --format json",
    ] {
        let begun = Instant::now();
        let child = start(folder, args);
        let o = interrupted(child, "INT", || begun.elapsed() > Duration::from_secs(3));
        assert_eq!(o.status.code(), Some(130), "{args} {o:?}");
        let found: Value = serde_json::from_slice(&o.stdout).unwrap();
        assert_eq!(found["variants_stop"], "interrupted", "{args:?}");
    }
}

/// nohup.
#[cfg(target_os = "linux")]
#[test]
fn an_ignored_hangup_stays_ignored() {
    let folder = &Folder::new();
    let command = format!(
        "trap '' HUP; exec '{}' search gripper-10 --method brute --options {MANY}",
        env!("CARGO_BIN_EXE_ozols")
    );
    let mut child = Command::new("sh")
        .args(["-c", &command])
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    sleep(Duration::from_millis(300));
    send(&child, "HUP");
    sleep(Duration::from_millis(300));
    assert!(child.try_wait().unwrap().is_none());
    send(&child, "TERM");
    assert_eq!(child.wait().unwrap().code(), Some(143));
}

/// Once lost: a finished list, and a finished page, were replaced by what there was when the signal came.
#[test]
fn what_is_cut_short_takes_nobodys_place() {
    let list = "search gripper-10 --all --check none --format csv -o older.csv";
    let page = "report gripper-10 --poses 9000 --top 2000 -o older.html";
    for (line, name, beside) in [
        (list, "older.csv", "older.interrupted.csv"),
        (page, "older.html", "older.interrupted.html"),
    ] {
        let folder = &Folder::new();
        folder.put(name, "whole and finished");
        let begun = Instant::now();
        let o = interrupted(start(folder, line), "INT", || {
            written(folder) > 100_000 || line == page && begun.elapsed() > Duration::from_secs(4)
        });
        let said = utf8_text(&o.stderr);
        assert_eq!(o.status.code(), Some(130), "{said}");
        assert_eq!(folder.text(name), "whole and finished");
        assert!(said.contains(name) && said.contains(beside), "{said}");
        assert!(folder.bytes(beside).len() > 1000);
        assert_eq!(folder.names().len(), 2);
    }
}
