//! The desk: undo, conflicts, saving, and work that is left behind.

use super::served::Served;
use crate::common::*;

fn spherical(joint: &str) -> Value {
    json!({ "edits": [{ "do": "set", "what": "joint", "id": joint, "key": "type", "value": "spherical" }], "revision": null })
}

/// A folder with a mechanism file, and its text.
fn own_file(name: &str) -> (Folder, String) {
    let own = run_quiet(&format!("show {name}"));
    (Folder::with("mine.toml", &own), own)
}

/// The text after a change of a joint's type.
fn edited(s: &Served, joint: &str) -> String {
    s.done("edit", &spherical(joint))["text"].word().to_owned()
}

#[test]
fn every_change_can_be_undone_to_the_byte() {
    let (folder, own) = own_file("gripper-10");
    let s = Served::new(&folder, &["mine.toml"]);
    let mut texts = vec![own];
    texts.extend(
        split_words("1-2 2-3 4-5 5-1 1-6 6-7 8-9")
            .iter()
            .map(|j| edited(&s, j)),
    );
    for text in texts.iter().rev().skip(1) {
        assert_eq!(s.done("undo", &json!({}))["text"], text.as_str());
    }
    assert_eq!(s.status()["desk"]["saved"], true);
    // What is saved is not kept twice, and there is no step before the first.
    assert_eq!(folder.names(), ["mine.toml"]);
    assert_eq!(s.done("undo", &json!({}))["text"], Value::Null);
    for text in texts.iter().skip(1) {
        assert_eq!(s.done("redo", &json!({}))["text"], text.as_str());
    }
    s.done("save", &json!({ "name": null }));
    assert_eq!(folder.text("mine.toml"), texts[7]);
    assert_eq!(folder.names(), ["mine.toml"]);
}

#[test]
fn a_text_that_is_made_of_an_older_one_is_refused() {
    let folder = Folder::new();
    let s = Served::new(&folder, &["four-bar"]);
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
    let (folder, own) = own_file("four-bar");
    let s = Served::new(&folder, &["mine.toml"]);
    let text_after = |what: &str, with: Value| s.done(what, &with)["text"].word().to_owned();
    // Nothing unsaved: taken in, and a step of undo.
    folder.put("mine.toml", own.replace("# coupler, 100 mm", "# theirs"));
    s.until(|v| v["revision"] == 2);
    assert_eq!(text_after("undo", json!({})), own);
    let mine = edited(&s, "1-2");
    // Something unsaved: told, and nothing written over.
    let again = own.replace("# coupler, 100 mm", "# again");
    folder.put("mine.toml~", &again);
    fs::rename(folder.path("mine.toml~"), folder.path("mine.toml")).unwrap();
    s.until(|v| v["desk"]["conflict"] == true);
    assert_eq!(s.post("save", &json!({ "name": null })).0, 409);
    assert_eq!(folder.text("mine.toml"), again);
    assert_eq!(text_after("settle", json!({ "yes": true })), mine);
    // Theirs is a step away.
    assert_eq!(text_after("undo", json!({})), again);
    s.done("redo", &json!({}));
    s.done("save", &json!({ "name": null }));
    assert_eq!(folder.text("mine.toml"), mine);
    // The other way round.
    let unsaved = edited(&s, "2-3");
    folder.put("mine.toml", &own);
    s.until(|v| v["desk"]["conflict"] == true);
    assert_eq!(text_after("settle", json!({ "yes": false })), own);
    assert_eq!(text_after("undo", json!({})), unsaved);
}

#[test]
fn work_of_a_killed_program_is_offered() {
    let (folder, own) = own_file("four-bar");
    let served = || Served::new(&folder, &["mine.toml"]);
    let mut first = served();
    let mine = edited(&first, "1-2");
    // Another at work on the same file keeps its own, and takes that of the first for nobody's but its.
    let second = served();
    assert_eq!(second.status()["desk"]["left"], Value::Null);
    edited(&second, "2-3");
    let all = ["mine.toml", "mine.toml.autosave", "mine.toml.autosave-2"];
    assert_eq!(folder.names(), all);
    first.end(Some("-KILL"));
    drop(second);
    let third = served();
    assert_eq!(third.status()["desk"]["left"], all[1]);
    let restored = third.done("restore", &json!({ "yes": true }));
    assert_eq!(restored["text"], mine.as_str());
    assert_eq!(third.done("undo", &json!({}))["text"], own.as_str());
    drop(third);
    // The work of the second is still there; thrown away, it is gone.
    let fourth = served();
    assert_eq!(fourth.status()["desk"]["left"], all[2]);
    fourth.done("restore", &json!({ "yes": false }));
    assert_eq!(folder.names(), ["mine.toml"]);
    assert_eq!(folder.text("mine.toml"), own);
}

#[test]
fn it_ends_with_its_last_window_and_with_ctrl_c() {
    let folder = Folder::new();
    let mut s = Served::new(&folder, &["four-bar"]);
    let (mut one, two) = (s.window(), s.window());
    one.next("look");
    s.until(|v| v["windows"] == 2);
    drop(two);
    s.until(|v| v["windows"] == 1);
    drop(one);
    assert_eq!(s.end(None), Some(0));
    let mut s = Served::new(&folder, &["four-bar"]);
    assert_eq!(s.end(Some("-INT")), Some(130));
    // What was not changed leaves nothing.
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn what_cannot_be_opened_is_told() {
    let folder = Folder::with("sub/x", "");
    for [file, words] in read_cases::<2>(
        r"
        - | standard input cannot be saved
        grippper-10 | did you mean
        sub | is a folder
        nowhere/mine.toml | neither a file nor a built-in mechanism
        new.json | neither a file nor a built-in mechanism
",
    ) {
        folder.assert_fails(&["studio", "--no-open", file], words);
    }
}

#[test]
fn a_file_that_is_wrong_is_opened_to_be_mended() {
    let own = run_quiet("show four-bar");
    let folder = Folder::with("mine.toml", own.replacen("revolute", "revolut", 1));
    folder.put("bytes.toml", [0xff, 0xfe]);
    let s = Served::new(&folder, &["mine.toml"]);
    let look = s.window().next("look");
    let told = &look["told"][0];
    assert_eq!(told["about"], json!(["joint", 0]), "{told}");
    has(told["words"].word(), "unknown joint type");
    assert_eq!(s.done("edit", &spherical("0-1"))["whole"], true);
    let s = Served::new(&folder, &["bytes.toml"]);
    let look = s.window().next("look");
    has(look["told"][0]["words"].word(), "not UTF-8");
}

/// All names for unsaved work are taken, so that it cannot be kept: the page is told so until it is saved or kept.
#[test]
fn work_that_cannot_be_kept_is_told_until_it_is_saved() {
    let (folder, _) = own_file("four-bar");
    let number = |n: usize| {
        if n == 1 {
            String::new()
        } else {
            format!("-{n}")
        }
    };
    for n in 1..=20 {
        fs::create_dir(folder.path(&format!("mine.toml.autosave{}", number(n)))).unwrap();
    }
    let mut s = Served::new(&folder, &["mine.toml"]);
    let is_told = |s: &Served| s.status()["desk"]["trouble"].is_string();
    for (joint, name) in [("1-2", Value::Null), ("2-3", json!("other.toml"))] {
        edited(&s, joint);
        assert!(is_told(&s));
        s.done("save", &json!({ "name": name }));
        assert!(!is_told(&s));
    }
    // That is saved, too.
    s.done("undo", &json!({}));
    assert!(!is_told(&s));
    // With the last window closed the program is the one place where the work is.
    let mine = edited(&s, "0-1");
    assert!(is_told(&s));
    let mut window = s.window();
    window.next("look");
    drop(window);
    s.until(|v| v["windows"] == 0);
    for _ in 0..60 {
        std::thread::sleep(Duration::from_millis(100));
        assert!(s.runs(), "the work is lost");
    }
    fs::remove_dir(folder.path("mine.toml.autosave-7")).unwrap();
    assert_eq!(s.end(None), Some(0));
    assert_eq!(folder.text("mine.toml.autosave-7"), mine);
}

/// A limit on the size of files stands for a full disk; its signal ended the program once, and the work with it.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_takes_no_work() {
    use std::process::Command;
    let (folder, own) = own_file("four-bar");
    let mut shell = Command::new("sh");
    let limited = "ulimit -S -f 1; exec \"$0\" \"$@\"";
    shell.args(["-c", limited, env!("CARGO_BIN_EXE_ozols")]);
    let s = Served::run_by(shell, &folder, &["mine.toml"]);
    let mine = edited(&s, "1-2");
    has(s.status()["desk"]["trouble"].word(), "mine.toml.autosave");
    let (code, told) = s.post("save", &json!({ "name": null }));
    assert_eq!(code, 422);
    has(told["refused"].word(), "mine.toml: ");
    assert_eq!(folder.names(), ["mine.toml"]);
    assert_eq!(folder.text("mine.toml"), own);
    let mut raise = Command::new("prlimit");
    let raised = raise.args(["--fsize=unlimited", "--pid", &s.process()]);
    assert!(raised.status().unwrap().success());
    s.done("save", &json!({ "name": null }));
    assert_eq!(s.status()["desk"]["trouble"], Value::Null);
    assert_eq!(folder.text("mine.toml"), mine);
    assert_eq!(folder.names(), ["mine.toml"]);
}
