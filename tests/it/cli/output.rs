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
    let (code, out, said) = run_with_input("check -", &shown);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    assert_eq!(out, run_quiet("check four-bar"));
    let (_, out, _) = run_with_input("analyze - --format json", &shown);
    let mut read: Value = serde_json::from_str(&out).unwrap();
    let mut named = run_json("analyze four-bar --format json");
    // What to do next names the file.
    for v in [&mut read, &mut named] {
        v["next"].take();
    }
    assert_eq!(read, named);
    let (code, _, said) = run_with_input("check -", "x = [");
    assert_eq!(code, Some(2));
    has(&said, "standard input:1:");
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
    let folder = Folder::with("in.toml", four_bar());
    folder.succeed("export in.toml --to mjcf -o in.xml");
    folder.succeed("catalog build --links 4 --quiet -o c.db");
    let sql = "SELECT structure FROM layouts LIMIT 1";
    let (id, _) = folder.succeed(&["catalog", "query", "c.db", sql, "--format", "csv"]);
    let id = id.lines().nth(1).unwrap();
    let read = || ["in.toml", "in.xml", "c.db"].map(|f| folder.bytes(f));
    let before = read();
    for line in [
        "analyze in.toml -o ./in.toml",
        "analyze in.toml --certificate in.toml",
        "search in.toml -o in.toml",
        "draw in.toml -o in.toml",
        "report in.toml -o in.toml",
        "export in.toml --to json -o in.toml",
        "search four-bar --costs in.toml -o in.toml",
        "export in.xml --to toml -o in.xml",
        "export in.xml --to mjcf -o in.xml",
        "lint in.xml --format json -o in.xml",
        "fix in.xml -o in.xml",
        "catalog export c.db ID -o c.db",
        "catalog page c.db -o c.db",
        "catalog query c.db -o c.db",
        "catalog show c.db ID --svg c.db",
        "catalog count --links 4 -o c.db",
        "catalog find gripper-10 --in c.db -o c.db",
    ] {
        let of_costs = line.contains("--costs");
        let says = if of_costs {
            ""
        } else {
            "name another file to write"
        };
        folder.assert_fails(&line.replace("ID", id), says);
        assert!(read() == before, "{line}");
    }
}

#[test]
fn a_robot_description_on_standard_input_is_told_from_toml() {
    let (code, _, said) = run_with_input("analyze -", "\n<robot name='r'/>");
    assert_eq!(code, Some(2), "{said}");
    has(&said, "standard input is XML");
}
