//! The program as its users meet it: exit codes, messages, formats, repeatability.

use crate::common::*;
mod bad_files;
mod bounds;
mod formats;
#[cfg(unix)]
mod interrupt;
mod lengths;
mod lost;
mod numbers;
mod other_files;
mod output;
mod small;
mod too_many;

/// A search of the gripper in a small space.
fn small_search(more: &str) -> String {
    format!("search gripper-10 --options revolute,spherical {more}")
}

fn small_out(more: &str) -> String {
    run_quiet(&small_search(more))
}

/// Asserts that a run is refused with exit code 2, nothing on standard output, and these words.
fn assert_refused<L: Line + ?Sized>(args: &L, parts: &[&str]) -> String {
    let (code, out, said) = run_full(args);
    assert_eq!((code, &*out), (Some(2), ""), "{:?}: {said}", args.words());
    assert!(said.starts_with("error: "), "{said}");
    has_all(&said, parts);
    said
}

/// Runs a shell command in a folder; `ozols` stands for the program.
fn run_shell(folder: impl AsRef<Path>, words: &str) -> Output {
    let words = words.replace("ozols", &format!("'{}'", env!("CARGO_BIN_EXE_ozols")));
    let mut sh = std::process::Command::new("sh");
    sh.args(["-c", &words]).current_dir(folder);
    sh.output().unwrap()
}

/// Asserts that a shell command ends with exit code 2 and an error that contains these words.
fn shell_fails(folder: impl AsRef<Path>, words: &str, says: &str) {
    let o = run_shell(folder, words);
    let said = utf8_text(&o.stderr);
    assert_eq!(o.status.code(), Some(2), "{words}: {said}");
    assert!(said.contains(says), "{words}: {said}");
}

fn four_bar() -> String {
    run_quiet("show four-bar")
}

// Exit codes.

#[test]
fn exit_code_0_done() {
    let lines = "list/schema/show four-bar/check four-bar/analyze four-bar/search four-bar/--help/--version";
    for line in lines.split('/') {
        assert!(!run_quiet(line).is_empty());
    }
}

#[test]
fn exit_code_1_nothing_found() {
    let o = run("search gripper-10 --max-mobility 0 --quiet");
    assert_eq!(
        (o.status.code(), utf8_text(&o.stderr).as_str()),
        (Some(1), "")
    );
    assert!(utf8_text(&o.stdout).contains("13,841,287,201 variants"));
}

#[test]
fn bad_arguments_end_with_exit_code_2() {
    assert_all_fail(
        "
        nonsense |
        search |
        search four-bar --top x |
        search four-bar --all --count |
        analyze four-bar --format xml |
        list --threads 0 | --threads & from 1 to 1024
        search four-bar --threads 100000 | --threads must be from 1 to 1024
        search four-bar --memory 12 | such as 500M or 2G
        search four-bar --memory much | such as 500M or 2G
        analyze four-bar --method svd --tolerance 2 | --tolerance
        search gripper-10 --method brute | 13841287201 & too many for brute force
        search gripper-10 --options revolute,gearbox | no joint of gripper-10 has an option named gearbox & universal-y
        search gripper-10 --allow 2-3=gearbox | an option named gearbox & universal-y
        search gripper-10 --allow 2-3 | name the options to allow at 2-3
        search gripper-10 --allow x-y=revolute | gripper-10 has no joint x-y
        search gripper-10 --forbid 2-3=gearbox | an option named gearbox
        search gripper-10 --forbid x-y | gripper-10 has no joint x-y
        search gripper-10 --hold zz | gripper-10 has no link zz to hold
        search gripper-10 --state zz | no state zz & free, clamped
        analyze gripper-10 --state zz | no state zz & free, clamped
        search four-bar --max-external 0 | no state besides free
        check /no/such/file.toml | /no/such/file.toml & neither a file nor a built-in mechanism
        analyze gripper-1 | gripper-1 & did you mean & gripper-10 & ozols list
        search zzz | zzz is neither
        show zzz | zzz is not a built-in mechanism
        ",
    );
    if cfg!(unix) {
        assert_all_fail("check /dev/null | is not a regular file & standard input");
    }
}

#[test]
fn allow_forbid_hold_narrow_the_space() {
    let space = |more: &str| {
        let line = format!("search gripper-10 --count {more}");
        parse_count(&Folder::new().json(&line)["space"])
    };
    assert_eq!(space("--forbid 2-3"), 7u64.pow(11));
    assert_eq!(space("--forbid 2-3=spherical,universal"), 7u64.pow(11) * 5);
    assert_eq!(space("--allow 2-3=spherical"), 7u64.pow(11) * 2);
    assert_eq!(space("--hold 2"), 7u64.pow(12));
}

// The same every time.

#[test]
fn samples_repeat_with_the_seed() {
    let sample = |seed| {
        run_quiet(&format!(
            "search gripper-10 --sample 20 --seed {seed} --format csv"
        ))
    };
    let one = sample("1");
    assert_eq!(one.lines().count(), 21);
    assert_eq!(one, sample("1"));
    assert_ne!(one, sample("2"));
}

// Once wrong: every name contains the empty one, so all are "near".
#[test]
fn error_empty_name() {
    assert!(!assert_refused(&["check", ""], &["neither a file"]).contains("did you mean"));
}
