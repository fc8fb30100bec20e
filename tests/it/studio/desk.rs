//! The desk: undo, conflicts, saving, and work that is left behind.

use super::served::Served;
use crate::common::*;

fn spherical(joint: &str) -> Value {
    json!({ "edits": [{ "do": "set", "what": "joint", "id": joint, "key": "type", "value": "spherical" }], "revision": null })
}

fn names(folder: &Path) -> Vec<String> {
    let all = fs::read_dir(folder).unwrap();
    let mut all: Vec<String> = all
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        .collect();
    all.sort();
    all
}

#[test]
fn every_change_can_be_undone_to_the_byte() {
    let folder = tempdir().unwrap();
    let own = run_quiet("show gripper-10");
    fs::write(folder.path().join("mine.toml"), &own).unwrap();
    let s = Served::new(folder.path(), &["mine.toml"]);
    let mut texts = vec![own.clone()];
    for joint in ["1-2", "2-3", "4-5", "5-1", "1-6", "6-7", "8-9"] {
        texts.push(s.done("edit", &spherical(joint))["text"].word().to_owned());
    }
    for text in texts.iter().rev().skip(1) {
        assert_eq!(s.done("undo", &json!({}))["text"], text.as_str());
    }
    assert_eq!(s.status()["desk"]["saved"], true);
    assert_eq!(
        names(folder.path()),
        ["mine.toml"],
        "what is saved is not kept twice"
    );
    assert_eq!(
        s.done("undo", &json!({}))["text"],
        Value::Null,
        "there is no step before the first"
    );
    for text in texts.iter().skip(1) {
        assert_eq!(s.done("redo", &json!({}))["text"], text.as_str());
    }
    s.done("save", &json!({ "name": null }));
    assert_eq!(
        fs::read_to_string(folder.path().join("mine.toml")).unwrap(),
        texts[7]
    );
    assert_eq!(names(folder.path()), ["mine.toml"]);
}

#[test]
fn a_text_that_is_made_of_an_older_one_is_refused() {
    let folder = tempdir().unwrap();
    let s = Served::new(folder.path(), &["four-bar"]);
    let first = s.status()["revision"].clone();
    s.done("edit", &spherical("1-2"));
    let whole = |revision: &Value| json!({ "edits": [{ "do": "text", "text": "name = \"x\"" }], "revision": revision });
    let mut window = s.window();
    window.next("look");
    assert_eq!(s.post("edit", &whole(&first)).0, 409);
    let sent = window.next("look")["text"].word().to_owned();
    has(&sent, "spherical");
    s.done("edit", &whole(&s.status()["revision"]));
}

#[test]
fn what_another_program_writes_is_taken_in_or_told() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let own = run_quiet("show four-bar");
    fs::write(&file, &own).unwrap();
    let s = Served::new(folder.path(), &["mine.toml"]);
    // Nothing unsaved: taken in, and a step of undo.
    let theirs = own.replace("# coupler, 100 mm", "# theirs");
    fs::write(&file, &theirs).unwrap();
    s.until(|v| v["revision"] == 2);
    assert_eq!(s.done("undo", &json!({}))["text"], own.as_str());
    let mine = s.done("edit", &spherical("1-2"))["text"].word().to_owned();
    // Something unsaved: told, and nothing written over.
    let again = own.replace("# coupler, 100 mm", "# again");
    fs::write(folder.path().join("mine.toml~"), &again).unwrap();
    fs::rename(folder.path().join("mine.toml~"), &file).unwrap();
    s.until(|v| v["desk"]["conflict"] == true);
    assert_eq!(s.post("save", &json!({ "name": null })).0, 409);
    assert_eq!(fs::read_to_string(&file).unwrap(), again);
    let kept = s.done("settle", &json!({ "yes": true }));
    assert_eq!(kept["text"], mine.as_str());
    assert_eq!(
        s.done("undo", &json!({}))["text"],
        again.as_str(),
        "theirs is a step away"
    );
    s.done("redo", &json!({}));
    s.done("save", &json!({ "name": null }));
    assert_eq!(fs::read_to_string(&file).unwrap(), mine);
    // The other way round.
    let unsaved = s.done("edit", &spherical("2-3"))["text"].word().to_owned();
    fs::write(&file, &own).unwrap();
    s.until(|v| v["desk"]["conflict"] == true);
    assert_eq!(
        s.done("settle", &json!({ "yes": false }))["text"],
        own.as_str()
    );
    assert_eq!(s.done("undo", &json!({}))["text"], unsaved.as_str());
}

#[test]
fn work_of_a_killed_program_is_offered() {
    let folder = tempdir().unwrap();
    let own = run_quiet("show four-bar");
    fs::write(folder.path().join("mine.toml"), &own).unwrap();
    let mut first = Served::new(folder.path(), &["mine.toml"]);
    let mine = first.done("edit", &spherical("1-2"))["text"]
        .word()
        .to_owned();
    // Another at work on the same file keeps its own, and takes that of the first for nobody's but its.
    let second = Served::new(folder.path(), &["mine.toml"]);
    assert_eq!(second.status()["desk"]["left"], Value::Null);
    second.done("edit", &spherical("2-3"));
    assert_eq!(
        names(folder.path()),
        ["mine.toml", "mine.toml.autosave", "mine.toml.autosave-2"]
    );
    first.end(Some("-KILL"));
    drop(second);
    let third = Served::new(folder.path(), &["mine.toml"]);
    assert_eq!(third.status()["desk"]["left"], "mine.toml.autosave");
    assert_eq!(
        third.done("restore", &json!({ "yes": true }))["text"],
        mine.as_str()
    );
    assert_eq!(third.done("undo", &json!({}))["text"], own.as_str());
    drop(third);
    // The work of the second is still there; thrown away, it is gone.
    let fourth = Served::new(folder.path(), &["mine.toml"]);
    assert_eq!(fourth.status()["desk"]["left"], "mine.toml.autosave-2");
    fourth.done("restore", &json!({ "yes": false }));
    assert_eq!(names(folder.path()), ["mine.toml"]);
    assert_eq!(
        fs::read_to_string(folder.path().join("mine.toml")).unwrap(),
        own
    );
}

#[test]
fn it_ends_with_its_last_window_and_with_ctrl_c() {
    let folder = tempdir().unwrap();
    let mut s = Served::new(folder.path(), &["four-bar"]);
    let (mut one, two) = (s.window(), s.window());
    one.next("look");
    s.until(|v| v["windows"] == 2);
    drop(two);
    s.until(|v| v["windows"] == 1);
    drop(one);
    assert_eq!(s.end(None), Some(0));
    let mut s = Served::new(folder.path(), &["four-bar"]);
    assert_eq!(s.end(Some("-INT")), Some(130));
    assert_eq!(
        names(folder.path()),
        [""; 0],
        "what was not changed leaves nothing"
    );
}

#[test]
fn what_cannot_be_opened_is_told() {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    for [file, words] in read_cases::<2>(
        r"
        - | standard input cannot be saved
        grippper-10 | did you mean
        sub | is a folder
        nowhere/mine.toml | neither a file nor a built-in mechanism
        new.json | neither a file nor a built-in mechanism
",
    ) {
        let mut command = ozols(&["studio", "--no-open", file]);
        let o = command.current_dir(folder.path()).output().unwrap();
        assert_eq!(o.status.code(), Some(2), "{file}");
        assert!(
            utf8_text(&o.stderr).contains(words),
            "{file}: {}",
            utf8_text(&o.stderr)
        );
    }
}

#[test]
fn a_file_that_is_wrong_is_opened_to_be_mended() {
    let folder = tempdir().unwrap();
    let own = run_quiet("show four-bar");
    fs::write(
        folder.path().join("mine.toml"),
        own.replacen("revolute", "revolut", 1),
    )
    .unwrap();
    let s = Served::new(folder.path(), &["mine.toml"]);
    let look = s.window().next("look");
    let told = &look["told"][0];
    assert_eq!(told["about"], json!(["joint", 0]), "{told}");
    assert!(told["words"].word().contains("unknown joint type"));
    let mended = s.done("edit", &spherical("0-1"));
    assert_eq!(mended["whole"], true);
    fs::write(folder.path().join("bytes.toml"), [0xff, 0xfe]).unwrap();
    let s = Served::new(folder.path(), &["bytes.toml"]);
    let look = s.window().next("look");
    assert!(look["told"][0]["words"].word().contains("not UTF-8"));
}

/// All names for unsaved work are taken, so that it cannot be kept: the page is told so until it is saved or kept.
#[test]
fn work_that_cannot_be_kept_is_told_until_it_is_saved() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("mine.toml"), run_quiet("show four-bar")).unwrap();
    let taken = |n: usize| match n {
        1 => folder.path().join("mine.toml.autosave"),
        _ => folder.path().join(format!("mine.toml.autosave-{n}")),
    };
    for n in 1..=20 {
        fs::create_dir(taken(n)).unwrap();
    }
    let mut s = Served::new(folder.path(), &["mine.toml"]);
    let trouble = |s: &Served| s.status()["desk"]["trouble"].clone();
    s.done("edit", &spherical("1-2"));
    assert!(trouble(&s).is_string());
    s.done("save", &json!({ "name": null }));
    assert_eq!(trouble(&s), Value::Null);
    s.done("edit", &spherical("2-3"));
    assert!(trouble(&s).is_string());
    s.done("save", &json!({ "name": "other.toml" }));
    assert_eq!(trouble(&s), Value::Null);
    s.done("undo", &json!({}));
    assert_eq!(trouble(&s), Value::Null, "that is saved, too");
    // With the last window closed the program is the one place where the work is.
    let mine = s.done("edit", &spherical("0-1"))["text"].word().to_owned();
    assert!(trouble(&s).is_string());
    let mut window = s.window();
    window.next("look");
    drop(window);
    s.until(|v| v["windows"] == 0);
    for _ in 0..60 {
        std::thread::sleep(std::time::Duration::from_millis(100));
        assert!(s.runs(), "the work is lost");
    }
    fs::remove_dir(taken(7)).unwrap();
    assert_eq!(s.end(None), Some(0));
    assert_eq!(fs::read_to_string(taken(7)).unwrap(), mine);
}

/// A limit on the size of files stands for a full disk; its signal ended the program once, and the work with it.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_takes_no_work() {
    use std::process::Command;
    let folder = tempdir().unwrap();
    let own = run_quiet("show four-bar");
    fs::write(folder.path().join("mine.toml"), &own).unwrap();
    let mut shell = Command::new("sh");
    shell.args([
        "-c",
        "ulimit -S -f 1; exec \"$0\" \"$@\"",
        env!("CARGO_BIN_EXE_ozols"),
    ]);
    let s = Served::run_by(shell, folder.path(), &["mine.toml"]);
    let mine = s.done("edit", &spherical("1-2"))["text"].word().to_owned();
    let told = s.status()["desk"]["trouble"].word().to_owned();
    has(&told, "mine.toml.autosave");
    let (code, told) = s.post("save", &json!({ "name": null }));
    assert_eq!(code, 422);
    assert!(told["refused"].word().contains("mine.toml: "), "{told}");
    assert_eq!(names(folder.path()), ["mine.toml"]);
    assert_eq!(
        fs::read_to_string(folder.path().join("mine.toml")).unwrap(),
        own
    );
    let raised = Command::new("prlimit")
        .args(["--fsize=unlimited", "--pid", &s.process()])
        .status();
    assert!(raised.unwrap().success());
    s.done("save", &json!({ "name": null }));
    assert_eq!(s.status()["desk"]["trouble"], Value::Null);
    assert_eq!(
        fs::read_to_string(folder.path().join("mine.toml")).unwrap(),
        mine
    );
    assert_eq!(names(folder.path()), ["mine.toml"]);
}
