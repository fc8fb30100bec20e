//! `ozols catalog find`: the structure of a drawn mechanism, what it is known as, and where a catalogue has it.

use super::command::{path_in, query_lines};
use super::rows::all_of_six;
use crate::common::*;
use ozols::synthesis::recognize::{NoStructure, recognize_structure};

/// Mechanisms of known schemes, as far as they are built in.
#[test]
fn built_in_grippers_are_what_they_are_known_as() {
    for (name, id) in [
        ("parallelogram-gripper", "parallelogram-piston"),
        ("rack-gripper", "rack-two-segments"),
        ("lever-slot-gripper", "wedge-levers"),
        ("geared-gripper", "geared-parallelograms"),
    ] {
        let data = run_json(&["catalog", "find", name, "--json"]);
        let known = data["classics"].as_array().unwrap();
        assert!(known.iter().any(|c| c["id"] == id), "{name}: {known:?}");
    }
    // None of these, so that the exit code is 1.
    let (code, told, _) = run_full("catalog find gripper-10 --json");
    assert_eq!(code, Some(1));
    let data: Value = serde_json::from_str(&told).unwrap();
    assert_eq!(data["links"], 10);
    assert_eq!([&data["hinges"], &data["slides"]], [12, 1]);
    assert_eq!([&data["mirror"], &data["essential"]], [true, true]);
    assert_eq!(data["translating"], false);
}

/// A redesign in space moves as before in its plane, so that its structure is the same.
#[test]
fn a_redesign_has_the_structure_it_had() {
    let name = |m: &str| recognize_structure(&built_in(m)).unwrap().structure.name();
    assert_eq!(name("gripper-10-redesign"), name("gripper-10"));
    assert_eq!(name("gripper-10-planar"), name("gripper-10"));
}

/// Names do not depend on the order in which links are numbered, and tell structures apart.
#[test]
fn every_scheme_has_a_name_of_its_own() {
    let all = known_classics();
    assert_eq!(all.len(), 34);
    for (i, a) in all.iter().enumerate() {
        let links: Vec<usize> = (0..a.structure.chain.links()).rev().collect();
        let turned = a.structure.part_of(&links);
        assert_ne!(turned, a.structure, "{}", a.id);
        assert_eq!(turned.name(), a.structure.name(), "{}", a.id);
        assert_eq!(
            turned.canonical_key(),
            a.structure.canonical_key(),
            "{}",
            a.id
        );
        for b in &all[..i] {
            // Tongs with their pins apart are a piston with two rods, and flat faces stand as slots.
            let tongs = a.id == "scissors-one-pin" && b.id == "piston-links-angular"
                || [a, b].iter().any(|c| c.made_as.threaded)
                    && a.structure.canonical_key() == b.structure.canonical_key()
                || a.made_as.flat && b.id == "wedge-hook"
                || b.made_as.flat && a.id == "wedge-hook";
            assert_eq!(
                a.structure.name() == b.structure.name(),
                tongs,
                "{} {}",
                a.id,
                b.id
            );
            assert_eq!(
                a.structure.canonical_key() == b.structure.canonical_key(),
                tongs
            );
        }
    }
}

fn slot_gripper() -> String {
    let joints = "
        drive | frame piston | prismatic | 0, 0, 0 | 1, 0, 0 | drive = true
        a | piston upper | slotted | 20, 5, 0 | 0, 0, 1 | reference = [1, 2, 0]
        b | piston lower | slotted | 20, -5, 0 | 0, 0, 1 | reference = [1, -2, 0]
        c | frame upper | spherical | 30, 15, 0 | 0, 0, 1
        d | frame lower | revolute | 30, -15, 0 | 0, 0, 1";
    write_mechanism(
        "name = \"slotted\"\nlength_unit = \"mm\"",
        "frame piston upper* lower*",
        joints,
    )
}

#[test]
fn a_pin_in_a_slot_is_a_slot_and_a_ball_a_hinge() {
    let (_folder, file) = write_temporary("slot.toml", slot_gripper());
    let found = run_json(&["catalog", "find", file, "--json"]);
    let counts = ["links", "hinges", "slides", "slots"].map(|key| &found[key]);
    assert_eq!(counts, [4, 2, 1, 2]);
    assert!(
        found["classics"]
            .list()
            .iter()
            .any(|c| c["id"] == "wedge-levers")
    );
    assert_eq!(found["mirror"], true);
}

#[test]
fn what_is_no_structure_says_why() {
    for [from, to, says] in read_cases::<3>(
        r#"
        drive = true |  | 0 joints are driven
        role = "output" |  | 1 links are outputs
        type = "slotted" | type = "planar" | joint "a" leaves 1 turns and 2 slides
        "#,
    ) {
        let (_folder, file) = write_temporary("none.toml", replace_once(&slot_gripper(), from, to));
        assert_fails(&["catalog", "find", file], says);
        assert_fails(&["catalog", "find", file], "none.toml");
    }
    // Four hinges with no plane in common.
    let bennett = recognize_structure(&built_in("bennett"));
    assert!(matches!(bennett, Err(NoStructure::Links(_))), "{bennett:?}");
}

/// What a catalogue laid out is found in it again, under its own name and in each of its forms.
#[test]
fn a_catalogue_has_what_it_laid_out() {
    let (folder, db) = (tempdir().unwrap(), all_of_six());
    let laid =
        "SELECT structure FROM layouts JOIN structures ON id = structure WHERE symmetry = 'mirror'";
    let ids = query_lines(db, laid);
    assert!(!ids.is_empty());
    for id in &ids {
        let file = path_in(&folder, &format!("{id}.toml"));
        stdout_of(&["catalog", "export", db, id, "-o", &file]);
        let data = run_json(&["catalog", "find", &file, "--in", db, "--json"]);
        assert!(
            data["catalogue"].list().iter().any(|e| e["id"] == **id),
            "{id}: {data}"
        );
    }
    let (_, told, _) = run_full(&["catalog", "find", "geared-gripper", "--in", db]);
    has(&told, "Not in this catalogue");
}
