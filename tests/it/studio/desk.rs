//! The desk: undo, conflicts, saving, and work that is left behind.

use super::served::Served;
use crate::common::{out, text};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

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
    let folder = tempfile::tempdir().unwrap();
    let own = out(&["show", "gripper-10"]);
    fs::write(folder.path().join("mine.toml"), &own).unwrap();
    let s = Served::new(folder.path(), &["mine.toml"]);
    let mut texts = vec![own.clone()];
    for joint in ["1-2", "2-3", "4-5", "5-1", "1-6", "6-7", "8-9"] {
        texts.push(
            s.done("edit", &spherical(joint))["text"]
                .as_str()
                .unwrap()
                .to_owned(),
        );
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
    let folder = tempfile::tempdir().unwrap();
    let s = Served::new(folder.path(), &["four-bar"]);
    let first = s.status()["revision"].clone();
    s.done("edit", &spherical("1-2"));
    let whole = |revision: &Value| json!({ "edits": [{ "do": "text", "text": "name = \"x\"" }], "revision": revision });
    let mut window = s.window();
    window.next("look");
    assert_eq!(s.post("edit", &whole(&first)).0, 409);
    let sent = window.next("look")["text"].as_str().unwrap().to_owned();
    assert!(
        sent.contains("spherical"),
        "whoever was late gets what there is"
    );
    s.done("edit", &whole(&s.status()["revision"]));
}

#[test]
fn what_another_program_writes_is_taken_in_or_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let own = out(&["show", "four-bar"]);
    fs::write(&file, &own).unwrap();
    let s = Served::new(folder.path(), &["mine.toml"]);
    // Nothing unsaved: taken in, and a step of undo.
    let theirs = own.replace("# coupler, 100 mm", "# theirs");
    fs::write(&file, &theirs).unwrap();
    s.until(|v| v["revision"] == 2);
    assert_eq!(s.done("undo", &json!({}))["text"], own.as_str());
    let mine = s.done("edit", &spherical("1-2"))["text"]
        .as_str()
        .unwrap()
        .to_owned();
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
    let unsaved = s.done("edit", &spherical("2-3"))["text"]
        .as_str()
        .unwrap()
        .to_owned();
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
    let folder = tempfile::tempdir().unwrap();
    let own = out(&["show", "four-bar"]);
    fs::write(folder.path().join("mine.toml"), &own).unwrap();
    let mut first = Served::new(folder.path(), &["mine.toml"]);
    let mine = first.done("edit", &spherical("1-2"))["text"]
        .as_str()
        .unwrap()
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
    let folder = tempfile::tempdir().unwrap();
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
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    for (file, words) in [
        ("-", "standard input is no file"),
        ("grippper-10", "did you mean"),
        ("sub", "is a folder"),
        (
            "nowhere/mine.toml",
            "neither a file nor a built-in mechanism",
        ),
        ("new.json", "neither a file nor a built-in mechanism"),
    ] {
        let mut command = crate::common::ozols(&["studio", "--no-open", file]);
        let o = command.current_dir(folder.path()).output().unwrap();
        assert_eq!(o.status.code(), Some(2), "{file}");
        assert!(
            text(&o.stderr).contains(words),
            "{file}: {}",
            text(&o.stderr)
        );
    }
}

#[test]
fn a_file_that_is_wrong_is_opened_to_be_mended() {
    let folder = tempfile::tempdir().unwrap();
    let own = out(&["show", "four-bar"]);
    fs::write(
        folder.path().join("mine.toml"),
        own.replacen("revolute", "revolut", 1),
    )
    .unwrap();
    let s = Served::new(folder.path(), &["mine.toml"]);
    let look = s.window().next("look");
    let told = &look["told"][0];
    assert_eq!(told["about"], json!(["joint", 0]), "{told}");
    assert!(
        told["words"]
            .as_str()
            .unwrap()
            .contains("unknown joint type")
    );
    let mended = s.done("edit", &spherical("0-1"));
    assert_eq!(mended["whole"], true);
    fs::write(folder.path().join("bytes.toml"), [0xff, 0xfe]).unwrap();
    let s = Served::new(folder.path(), &["bytes.toml"]);
    let look = s.window().next("look");
    assert!(
        look["told"][0]["words"]
            .as_str()
            .unwrap()
            .contains("not UTF-8")
    );
}
