//! A toggle gripper: a plunger, two rods and two jaws. What its file does not say is that one finger is the other's image.

use crate::common::*;
/// The file; fingers are each other's mirror image, or half a turn.
pub(super) fn gripper(type_of_plunger: &str, turned: bool, options: &str) -> String {
    let mut joints = format!(
        "P | 0 plunger | {type_of_plunger} | 0, 0, 0 | 1, 0, 0 | drive = true\\noptions = []\n"
    );
    for (k, side) in [(1, 1), (2, -1)] {
        let z = if turned { side } else { 1 };
        for (id, ends, x, y) in [
            ("A", format!("plunger rod-{k}"), 0, 8),
            ("B", format!("rod-{k} jaw-{k}"), 6, 30),
            ("C", format!("jaw-{k} 0"), 30, 25),
        ] {
            let y = side * y;
            joints += &format!("{id}{k} | {ends} | revolute | {x}, {y}, 0 | 0, 0, {z}\n");
        }
    }
    let head = "name = \"toggle-gripper\"\nlength_unit = \"mm\"";
    let head = format!("{head}\n[search]\noptions = [{options}]");
    write_mechanism(&head, "0 plunger rod-1 jaw-1* rod-2 jaw-2*", &joints)
}

/// The changes of each idea, by joint.
fn ideas(text: &str) -> Vec<BTreeMap<String, String>> {
    let (_folder, path) = write_temporary("toggle.toml", text);
    let found = run_json(&["search", path, "--distinct", "--format", "json"]);
    let word = |v: &Value| v.word().to_owned();
    let changes = |v: &Value| {
        let all = v["changes"].list().iter();
        all.map(|c| (word(&c["joint"]), word(&c["to"]))).collect()
    };
    found["variants"].list().iter().map(changes).collect()
}

#[test]
fn the_first_idea_changes_the_rod_ends_of_both_fingers_alike() {
    let all = "\"revolute\", \"cylindrical\", \"universal\", \"spherical\"";
    for (options, turned) in [
        (all, false),
        (all, true),
        ("\"revolute\", \"spherical\"", false),
    ] {
        let found = ideas(&gripper("prismatic", turned, options));
        let ends: Vec<&str> = found[0].keys().map(String::as_str).collect();
        assert_eq!(ends, ["A1", "A2", "B1", "B2"], "{options}");
        assert_eq!(found[0]["A1"], found[0]["A2"]);
        assert_eq!(found[0]["B1"], found[0]["B2"]);
        // Rod ends of one kind, four of them, are an idea of their own.
        let balls = found
            .iter()
            .position(|i| i.len() == 4 && i.values().all(|t| t == "spherical"));
        assert!(balls.is_some_and(|k| k < 3), "{found:?}");
        // No idea of the first three touches the drive or a pivot in the frame.
        let kept = found.iter().take(3).flat_map(|i| i.keys());
        assert!(
            kept.into_iter()
                .all(|j| !["P", "C1", "C2"].contains(&j.as_str()))
        );
    }
}

/// Where the plunger may turn, one finger has a freedom less to be given; the other joints are changed as their images all the same.
#[test]
fn fingers_differ_by_no_more_than_they_must() {
    let options = "\"revolute\", \"cylindrical\", \"spherical\"";
    let found = ideas(&gripper("cylindrical", false, options));
    let first = &found[0];
    let alone = first.keys().filter(|j| {
        let image = j.replace(['1', '2'], if j.ends_with('1') { "2" } else { "1" });
        first.get(*j) != first.get(&image)
    });
    assert_eq!(alone.count(), 1, "{first:?}");
}
