//! Files written, standard input and output, closed pipes.

use super::four_bar;
use crate::common::*;

// Files written.

#[test]
fn output_file_is_whole() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("x");
    let file = path.to_str().unwrap();
    for args in [
        &["search", "four-bar", "--format", "json"][..],
        &["search", "four-bar", "--all", "--format", "csv"],
        &["search", "four-bar"],
        &["analyze", "four-bar", "--format", "json"],
        &["analyze", "four-bar"],
    ] {
        assert_eq!(run_quiet(&[args, &["-o", file]].concat()), "");
        let written = without_time(&fs::read_to_string(&path).unwrap());
        assert_eq!(written, run_quiet(args), "{args:?}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn show_round_trips_through_standard_input() {
    let shown = four_bar();
    let o = ozols("check -")
        .write_stdin(shown.clone())
        .output()
        .unwrap();
    assert_eq!(
        (o.status.code(), utf8_text(&o.stderr).as_str()),
        (Some(0), "")
    );
    assert_eq!(utf8_text(&o.stdout), run_quiet("check four-bar"));
    let o = ozols("analyze - --format json")
        .write_stdin(shown)
        .output()
        .unwrap();
    let mut read: Value = serde_json::from_slice(&o.stdout).unwrap();
    let mut named = run_json("analyze four-bar --format json");
    // What to do next names the file.
    for v in [&mut read, &mut named] {
        v["next"].take();
    }
    assert_eq!(read, named);
    let o = ozols("check -").write_stdin("x = [").output().unwrap();
    assert_eq!(o.status.code(), Some(2));
    assert!(utf8_text(&o.stderr).contains("standard input:1:"));
}

// `ozols search ... | head -1`
#[test]
fn a_closed_pipe_is_quiet() {
    for format in ["csv", "jsonl"] {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_ozols"))
            .args(["search", "gripper-10", "--all", "--format", format])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut first = String::new();
        BufReader::new(child.stdout.take().unwrap())
            .read_line(&mut first)
            .unwrap();
        assert!(!first.is_empty());
        let mut said = String::new();
        child
            .stderr
            .take()
            .unwrap()
            .read_to_string(&mut said)
            .unwrap();
        assert_eq!(said, "");
        assert!(child.wait().unwrap().success());
    }
}

// Once wrong: the temporary file is renamed over whatever PATH is. As root, `-o /dev/null` replaces the
// device by an ordinary file; a FIFO stands for it here. Never try this with a real device.
#[cfg(unix)]
#[test]
fn output_to_a_special_file_keeps_it() {
    use std::os::unix::fs::FileTypeExt;
    let folder = tempdir().unwrap();
    let path = folder.path().join("fifo");
    assert!(
        std::process::Command::new("mkfifo")
            .arg(&path)
            .status()
            .unwrap()
            .success()
    );
    // Open at both ends, so that neither side waits.
    let _both = fs::OpenOptions::new()
        .read(true)
        .write(true)
        .open(&path)
        .unwrap();
    run_quiet(&["analyze", "four-bar", "-o", path.to_str().unwrap()]);
    assert!(fs::symlink_metadata(&path).unwrap().file_type().is_fifo());
}

// Once wrong: the same with a symbolic link: the link is replaced, its target keeps the old content.
#[cfg(unix)]
#[test]
fn output_through_a_symbolic_link() {
    let folder = tempdir().unwrap();
    let (real, link) = (folder.path().join("real"), folder.path().join("link"));
    fs::write(&real, "old").unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    run_quiet(&["analyze", "four-bar", "-o", link.to_str().unwrap()]);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(
        fs::read_to_string(&real).unwrap(),
        run_quiet("analyze four-bar")
    );
}

// Time.

#[test]
fn a_search_says_how_long_it_took() {
    let o = run("search four-bar --format json");
    let whole = utf8_text(&o.stdout);
    let v: Value = serde_json::from_str(&whole).unwrap();
    let seconds = v["seconds"].real();
    assert!(seconds > 0.0 && seconds < 600.0, "{seconds}");
    // It is the last key, so that all before it is the same every time.
    let last = whole.lines().rev().nth(1).unwrap();
    assert!(last.starts_with("  \"seconds\": "), "{last}");
    assert_eq!(utf8_text(&o.stderr), "");

    let said = |args: &[&str]| utf8_text(&run(args).stderr);
    let line = said(&["search", "four-bar"]);
    assert!(line.starts_with("Searched in ") && line.lines().count() == 1);
    assert_eq!(said(&["search", "four-bar", "--quiet"]), "");
    for format in ["csv", "jsonl"] {
        assert_eq!(said(&["search", "four-bar", "--format", format]), "");
    }
}

/// Whatever a command reads stays as it is, by whatever name it is to be written over, and no catalogue is taken for an old result.
#[test]
fn what_is_read_is_not_written_over() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (file, robot, same, db) = (at("in.toml"), at("in.xml"), at("./in.toml"), at("c.db"));
    fs::write(&file, four_bar()).unwrap();
    let made = run(&["export", &file, "--to", "mjcf", "-o", &robot]);
    assert_eq!(made.status.code(), Some(0));
    run_quiet(&["catalog", "build", "--links", "4", "--quiet", "-o", &db]);
    let id = run_quiet(&[
        "catalog",
        "query",
        &db,
        "SELECT structure FROM layouts LIMIT 1",
        "--format",
        "csv",
    ]);
    let id = id.lines().nth(1).unwrap();
    let read = || [&file, &robot, &db].map(|f| fs::read(f).unwrap());
    let before = read();
    let over: [&[&str]; 17] = [
        &["analyze", &file, "-o", &same],
        &["analyze", &file, "--certificate", &file],
        &["search", &file, "-o", &file],
        &["draw", &file, "-o", &file],
        &["report", &file, "-o", &file],
        &["export", &file, "--to", "json", "-o", &file],
        &["search", "four-bar", "--costs", &file, "-o", &file],
        &["export", &robot, "--to", "toml", "-o", &robot],
        &["export", &robot, "--to", "mjcf", "-o", &robot],
        &["lint", &robot, "--format", "json", "-o", &robot],
        &["fix", &robot, "-o", &robot],
        &["catalog", "export", &db, id, "-o", &db],
        &["catalog", "page", &db, "-o", &db],
        &["catalog", "query", &db, "-o", &db],
        &["catalog", "show", &db, id, "--svg", &db],
        &["catalog", "count", "--links", "4", "-o", &db],
        &["catalog", "find", "gripper-10", "--in", &db, "-o", &db],
    ];
    for words in over {
        let o = run(words);
        let said = utf8_text(&o.stderr);
        assert_eq!(o.status.code(), Some(2), "{words:?}: {said}");
        assert!(
            said.contains("name another file to write") || words.contains(&"--costs"),
            "{words:?}: {said}"
        );
        assert!(read() == before, "{words:?}");
    }
}

#[test]
fn a_robot_description_on_standard_input_is_told_from_toml() {
    let xml = "\n<robot name='r'/>";
    let o = ozols("analyze -").write_stdin(xml).output().unwrap();
    let said = utf8_text(&o.stderr);
    assert_eq!(o.status.code(), Some(2), "{said}");
    has(&said, "standard input is XML");
}
