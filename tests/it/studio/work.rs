//! The work at a text: the values are those of the command line, and no two searches are at work.

use super::served::Served;
use crate::common::*;

#[test]
fn the_verdict_and_the_ideas_are_those_of_the_command_line() {
    for name in ["gripper-10", "bennett"] {
        let folder = Folder::with("mine.toml", run_quiet(&["show", name]));
        let s = Served::new(&folder, &["mine.toml"]);
        let mut window = s.window();
        let verdict = window.next("verdict");
        let analysis = run_json(&["analyze", name, "--format", "json"]);
        for key in ["mechanism", "length_unit", "states"] {
            assert_eq!(verdict["analysis"][key], analysis[key], "{name} {key}");
        }
        let motion = s.window().next("motion");
        assert!(motion["scenes"][0]["moves"][0]["poses"].list().len() > 10);
        let mut search = run_json(&format!("search {name} --distinct --top 10 --format json"));
        for key in ["format", "seconds"] {
            search.as_object_mut().unwrap().shift_remove(key);
        }
        assert_eq!(window.next("ideas")["found"], search, "{name}");
    }
}

#[test]
fn an_idea_that_is_taken_does_what_it_says_and_keeps_the_comments() {
    for (name, ideas) in [
        ("gripper-10", 4),
        ("four-bar", 3),
        ("lever-gripper", 3),
        ("parallelogram-3-rods", 3),
    ] {
        let own = run_quiet(&["show", name]);
        let folder = Folder::with("mine.toml", &own);
        let s = Served::new(&folder, &["mine.toml"]);
        let mut window = s.window();
        for k in 1..=ideas {
            let told = window.next("ideas");
            let list = told["found"]["variants"].list();
            let Some(idea) = list.get(k - 1) else { break };
            let taken = s.done("take", &json!({ "idea": k, "revision": told["revision"] }));
            let text = taken["text"].word();
            for comment in own.lines().filter_map(|l| l.split_once('#').map(|c| c.1)) {
                assert!(text.contains(comment), "{name}, idea {k}: {comment}");
            }
            let verdict = window.next("verdict");
            assert_eq!(
                verdict["revision"], taken["revision"],
                "{name}, idea {k}: {}",
                taken["told"]
            );
            let state = &verdict["analysis"]["states"][0];
            assert_eq!(state["mobility"], idea["mobility"], "{name}, idea {k}");
            assert_eq!(state["redundant"], idea["redundant"], "{name}, idea {k}");
            // The reasons are those of the command line, which gives them for three.
            let rows = told["reasons"].get(k - 1).and_then(Value::as_array);
            let rows = rows.unwrap_or_else(|| panic!("{name}, idea {k}: {}", told["reasons"]));
            assert!(!rows.is_empty(), "{name}, idea {k}");
            // A ranking lists variants.
            if k <= 3 && !idea["idea"].is_null() {
                let plain = |t: &str| t.split_whitespace().join(" ");
                let said = run_quiet(&format!("search {name} --distinct --verbose"));
                for row in rows {
                    let words = plain(row[1].word());
                    assert!(plain(&said).contains(&words), "{name}, idea {k}: {words}");
                }
            }
            window.next("ideas");
            assert_eq!(s.done("undo", &json!({}))["text"], own.as_str());
        }
        // Ideas of a text that is no more are not taken.
        assert_eq!(s.post("take", &json!({ "idea": 1, "revision": 1 })).0, 409);
    }
}

/// Where nothing is found each wider request can be asked, and the first one again.
#[test]
fn a_wider_request_is_asked_for_by_its_number() {
    let own = run_quiet("show bennett");
    let few = own.replace(r#""cylindrical", "universal", "spherical""#, r#""slotted""#);
    assert_ne!(few, own);
    let folder = Folder::with("mine.toml", few);
    let s = Served::new(&folder, &["mine.toml"]);
    let mut window = s.window();
    let mut told = window.next("ideas");
    assert_eq!(told["found"]["variants"].list().len(), 0);
    let wider = told["wider"].list().clone();
    assert!(!wider.is_empty());
    for (n, step) in wider.iter().enumerate() {
        s.done("ask", &json!({ "wider": n, "revision": told["revision"] }));
        let found = window.next("ideas");
        assert_eq!(found["asked"], step["gives"]);
        assert!(!step.to_string().contains("--"), "{step}");
        assert!(!found["found"]["variants"].list().is_empty(), "{step}");
        s.done(
            "ask",
            &json!({ "wider": null, "revision": found["revision"] }),
        );
        told = window.next("ideas");
        assert!(told["asked"].is_null());
        assert_eq!(told["wider"], json!(wider));
    }
    assert_eq!(s.post("ask", &json!({ "wider": 0, "revision": 1 })).0, 409);
}

#[test]
fn a_search_ends_when_another_text_comes() {
    let folder = Folder::with("mine.toml", run_quiet("show gripper-10"));
    let s = Served::new(&folder, &["mine.toml"]);
    let mut window = s.window();
    let mut last = 0;
    for n in 0..12 {
        let edit = json!({ "do": "set", "what": "joint", "id": "0-1", "key": "point", "value": [n + 1, 0, 0] });
        last = s.done("edit", &json!({ "edits": [edit], "revision": null }))["revision"].whole();
        let searches = &s.status()["searches"];
        let [begun, ended] = ["begun", "ended"].map(|k| searches[k].whole());
        assert!(begun - ended <= 1, "{searches}");
    }
    loop {
        let ideas = window.next("ideas");
        if ideas["revision"] == last {
            break;
        }
    }
    let status = s.until(|v| v["searches"]["begun"] == v["searches"]["ended"]);
    assert!(status["searches"]["begun"].whole() <= last, "{status}");
}

#[test]
fn a_change_is_tried_without_being_made() {
    let folder = Folder::new();
    let s = Served::new(&folder, &["four-bar"]);
    let before = s.status()["revision"].clone();
    let edit = |value: Value| json!({ "edits": [{ "do": "set", "what": "joint", "id": "1-2", "key": "point", "value": value }], "revision": null });
    let tried = s.done("draft", &edit(json!([0, "10*sqrt(3)", 0])));
    assert_eq!(tried["verdict"]["analysis"]["states"][0]["redundant"], 3);
    let y = tried["places"]["joint"][1][1].real();
    assert!((y - 10.0 * 3_f64.sqrt()).abs() < 1e-12);
    let wrong = s.done("draft", &edit(json!([0, "10*sqrt(", 0])));
    assert_eq!(wrong["told"][0]["about"], json!(["joint", 1]));
    assert_eq!(s.status()["revision"], before);
}

#[test]
fn a_description_takes_an_idea_and_no_other_change() {
    let folder = Folder::with("gripper.xml", read_data("robots/gripper.xml"));
    let s = Served::new(&folder, &["gripper.xml"]);
    let mut window = s.window();
    let redundant = |verdict: Value| verdict["analysis"]["states"][0]["redundant"].whole();
    assert_eq!(redundant(window.next("verdict")), 2);
    let told = window.next("ideas");
    let edit = json!({ "edits": [{ "do": "text", "text": "" }], "revision": told["revision"] });
    assert_eq!(s.post("edit", &edit).0, 422);
    s.done("take", &json!({ "idea": 1, "revision": told["revision"] }));
    assert_eq!(redundant(window.next("verdict")), 0);
    s.done("save", &json!({ "name": null }));
    has(&folder.text("gripper.xml"), "ozols fix");
}
