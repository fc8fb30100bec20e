//! `ozols catalog find`: the structure of a drawn mechanism, what it is known as, and where a catalogue has it.

use crate::common::*;
use ozols::chains::classics::classics;
use ozols::synthesis::recognize::{NoStructure, recognize};

/// Mechanisms of known schemes, as far as they are built in.
#[test]
fn built_in_grippers_are_what_they_are_known_as() {
    for (name, id) in [
        ("parallelogram-gripper", "parallelogram-piston"),
        ("rack-gripper", "rack-two-segments"),
        ("lever-slot-gripper", "wedge-levers"),
        ("geared-gripper", "geared-parallelograms"),
    ] {
        let data = json(&["catalog", "find", name, "--json"]);
        let known = data["classics"].as_array().unwrap();
        assert!(known.iter().any(|c| c["id"] == id), "{name}: {known:?}");
    }
    // None of these, so that the exit code is 1.
    let o = ozols(&["catalog", "find", "gripper-10", "--json"])
        .output()
        .unwrap();
    assert_eq!(o.status.code(), Some(1));
    let data: Value = serde_json::from_str(&text(&o.stdout)).unwrap();
    assert_eq!(data["links"], 10);
    assert_eq!([&data["hinges"], &data["slides"]], [12, 1]);
    assert_eq!([&data["mirror"], &data["essential"]], [true, true]);
    assert_eq!(data["translating"], false);
}

/// A redesign in space moves as before in its plane, so that its structure is the same.
#[test]
fn a_redesign_has_the_structure_it_had() {
    let name = |m: &str| recognize(&built_in(m)).unwrap().structure.name();
    assert_eq!(name("gripper-10-redesign"), name("gripper-10"));
    assert_eq!(name("gripper-10-planar"), name("gripper-10"));
}

/// Names do not depend on the order in which links are numbered, and tell structures apart.
#[test]
fn every_scheme_has_a_name_of_its_own() {
    let all = classics();
    assert_eq!(all.len(), 34);
    for (i, a) in all.iter().enumerate() {
        let links: Vec<usize> = (0..a.structure.chain.links()).rev().collect();
        let turned = a.structure.part(&links);
        assert_ne!(turned, a.structure, "{}", a.id);
        assert_eq!(turned.name(), a.structure.name(), "{}", a.id);
        assert_eq!(turned.key(), a.structure.key(), "{}", a.id);
        for b in &all[..i] {
            // Tongs with their pins apart are a piston with two rods, and flat faces stand as slots.
            let tongs = a.id == "scissors-one-pin" && b.id == "piston-links-angular"
                || [a, b].iter().any(|c| c.made_as.threaded)
                    && a.structure.key() == b.structure.key()
                || a.made_as.flat && b.id == "wedge-hook"
                || b.made_as.flat && a.id == "wedge-hook";
            assert_eq!(
                a.structure.name() == b.structure.name(),
                tongs,
                "{} {}",
                a.id,
                b.id
            );
            assert_eq!(a.structure.key() == b.structure.key(), tongs);
        }
    }
}

const SLOT_GRIPPER: &str = r#"
name = "slotted"
length_unit = "mm"
[[link]]
id = "frame"
role = "frame"
[[link]]
id = "piston"
[[link]]
id = "upper"
role = "output"
[[link]]
id = "lower"
role = "output"
[[joint]]
id = "drive"
links = ["frame", "piston"]
type = "prismatic"
point = [0, 0, 0]
axis = [1, 0, 0]
drive = true
[[joint]]
id = "a"
links = ["piston", "upper"]
type = "slotted"
point = [20, 5, 0]
axis = [0, 0, 1]
reference = [1, 2, 0]
[[joint]]
id = "b"
links = ["piston", "lower"]
type = "slotted"
point = [20, -5, 0]
axis = [0, 0, 1]
reference = [1, -2, 0]
[[joint]]
id = "c"
links = ["frame", "upper"]
type = "spherical"
point = [30, 15, 0]
axis = [0, 0, 1]
[[joint]]
id = "d"
links = ["frame", "lower"]
type = "revolute"
point = [30, -15, 0]
axis = [0, 0, 1]
"#;

fn written(name: &str, text: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("find");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_pin_in_a_slot_is_a_slot_and_a_ball_a_hinge() {
    let file = written("slot.toml", SLOT_GRIPPER);
    let o = ozols(&["catalog", "find", &file]).output().unwrap();
    let out = text(&o.stdout);
    assert!(out.contains("4 links, 2 hinges, 1 slide, 2 slots"), "{out}");
    assert!(out.contains("Known as wedge-levers"), "{out}");
    assert!(out.contains("Symmetric layouts: mirror."), "{out}");
}

#[test]
fn what_is_no_structure_says_why() {
    let undriven = SLOT_GRIPPER.replace("drive = true", "");
    let one_jaw = SLOT_GRIPPER.replacen("role = \"output\"", "", 1);
    let wide = SLOT_GRIPPER.replacen("type = \"slotted\"", "type = \"planar\"", 1);
    for (name, bad, said) in [
        ("undriven.toml", &undriven, "0 joints are driven"),
        ("one_jaw.toml", &one_jaw, "1 links are outputs"),
        (
            "wide.toml",
            &wide,
            "joint \"a\" leaves 1 turns and 2 slides",
        ),
    ] {
        let file = written(name, bad);
        let o = ozols(&["catalog", "find", &file]).output().unwrap();
        assert_eq!(o.status.code(), Some(2), "{name}");
        let told = text(&o.stderr);
        assert!(told.contains(said) && told.contains(name), "{told}");
    }
    // Four hinges with no plane in common.
    let bennett = recognize(&built_in("bennett"));
    assert!(matches!(bennett, Err(NoStructure::Links(_))), "{bennett:?}");
}

/// What a catalogue laid out is found in it again, under its own name and in each of its forms.
#[test]
fn a_catalogue_has_what_it_laid_out() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("find");
    fs::create_dir_all(&folder).unwrap();
    let db = folder.join("six.db");
    let _ = fs::remove_file(&db);
    let db = db.to_str().unwrap();
    let built = [
        "catalog",
        "build",
        "--links",
        "6",
        "--symmetry",
        "mirror",
        "-o",
        db,
    ];
    assert!(ozols(&built).output().unwrap().status.success());
    let laid_out = "SELECT id FROM structures JOIN layouts ON structure = id";
    let rows = json(&["catalog", "query", db, laid_out, "--format", "json"]);
    let rows = rows.as_array().unwrap();
    assert!(!rows.is_empty());
    for row in rows {
        let id = row["id"].as_str().unwrap();
        let file = folder.join(format!("{id}.toml"));
        let file = file.to_str().unwrap();
        let exported = ["catalog", "export", db, id, "-o", file];
        assert!(ozols(&exported).output().unwrap().status.success());
        let data = json(&["catalog", "find", file, "--in", db, "--json"]);
        let found = data["catalogue"].as_array().unwrap();
        assert!(found.iter().any(|e| e["id"] == id), "{id}: {data}");
    }
    let o = ozols(&["catalog", "find", "geared-gripper", "--in", db])
        .output()
        .unwrap();
    assert!(text(&o.stdout).contains("does not have it"));
}
