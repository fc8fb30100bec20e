//! Changes to a file keep all that they do not change: comments, digits, blanks.

use crate::common::*;
use crate::fuzz::runs;
use ozols::file::edit::{Edit, Thing, apply_edits};

fn set(what: Thing, id: &str, key: &str, value: Value) -> Edit {
    let (id, key) = (id.to_owned(), key.to_owned());
    Edit::Set {
        what,
        id,
        key,
        value,
    }
}

/// What is written behind each `#`.
fn comments(text: &str) -> Vec<&str> {
    let all = text.lines().filter_map(|l| l.split_once('#'));
    all.map(|(_, c)| c).collect()
}

/// Lines that are in one text and not in the other.
fn differing(a: &str, b: &str) -> usize {
    a.lines().filter(|l| !b.lines().any(|m| m == *l)).count()
}

#[test]
fn what_is_set_to_what_it_is_leaves_every_byte() {
    for name in builtin::names() {
        let text = builtin::text(name).unwrap();
        let entries: Value =
            serde_json::to_value(toml::from_str::<toml::Value>(text).unwrap()).unwrap();
        let mut edits = Vec::new();
        for (what, list) in [
            (Thing::Link, "link"),
            (Thing::Joint, "joint"),
            (Thing::Point, "point"),
        ] {
            for item in entries[list].as_array().into_iter().flatten() {
                for (key, value) in item.as_object().unwrap() {
                    // Tables within brackets are written anew.
                    if !value.to_string().contains('{') {
                        edits.push(set(what, item["id"].word(), key, value.clone()));
                    }
                }
            }
        }
        assert_eq!(apply_edits(text, &edits).unwrap(), text, "{name}");
    }
}

#[test]
fn one_coordinate_changes_one_line_and_keeps_the_digits_of_the_others() {
    let text = "name = \"x\" # a name\n\n# hinge\n[[joint]] # one\nid = \"a\"   # its id\npoint = [ 1.50, \"sqrt(2)\",0 ]  # where\n";
    let to = |value| apply_edits(text, &[set(Thing::Joint, "a", "point", value)]).unwrap();
    assert_eq!(
        to(json!([1.5, "sqrt(3)", 0])),
        text.replace("sqrt(2)", "sqrt(3)")
    );
    assert_eq!(
        to(json!(["1.50", "sqrt(2)", "7.250"])),
        text.replace("0 ]", "7.250 ]")
    );
    assert_eq!(to(json!([2, "sqrt(2)", 0])), text.replace("1.50", "2"));
    assert_eq!(
        to(Value::Null),
        text.replace("point = [ 1.50, \"sqrt(2)\",0 ]  # where\n", "")
    );
    let more = apply_edits(text, &[set(Thing::Joint, "a", "axis", json!([0, 0, "1"]))]).unwrap();
    assert_eq!(more, format!("{text}axis = [0, 0, 1]\n"));
}

#[test]
fn loads_and_couplings_are_tables_whose_comments_stay() {
    let put = |text: &str, value: Value| {
        let path = ["workload", "force"].map(str::to_owned).to_vec();
        apply_edits(text, &[Edit::Put { path, value }]).unwrap()
    };
    let force = |link: &str, y: f64| json!({ "link": link, "point": [0, "sqrt(2)", 0], "force": [0, y, 0] });
    let own = builtin::text("four-bar").unwrap();
    let one = put(own, json!([force("2", -10.0)]));
    let table = "\n[[workload.force]]\nlink = \"2\"\n";
    assert!(one.contains(table), "{one}");
    assert_eq!(read(&one).loads.forces.len(), 1);
    let noted = one.replace("link = \"2\"\n", "link = \"2\" # the coupler\n");
    let two = put(&noted, json!([force("2", -20.0), force("3", 5.0)]));
    has_all(&two, &["# the coupler", "-20.0"]);
    assert_eq!(read(&two).loads.forces.len(), 2);
    assert_eq!(
        put(&put(&two, json!([])), Value::Null)
            .matches("force")
            .count(),
        0
    );
}

#[test]
fn another_name_is_put_wherever_the_file_has_it() {
    for name in builtin::names() {
        let text = builtin::text(name).unwrap();
        let m = read(text);
        let mut all: Vec<(Thing, &str)> = m
            .joints
            .iter()
            .map(|j| (Thing::Joint, j.id.as_str()))
            .collect();
        all.extend(m.links.iter().map(|l| (Thing::Link, l.id.as_str())));
        let edits = all.iter().map(|(what, id)| Edit::Rename {
            what: *what,
            id: (*id).to_owned(),
            to: format!("the {what} {id}"),
        });
        let renamed = apply_edits(text, &edits.collect_vec()).unwrap();
        let after = read(&renamed);
        let ids: Vec<String> = m
            .joints
            .iter()
            .map(|j| format!("the joint {}", j.id))
            .collect();
        assert!(after.joints.iter().map(|j| &j.id).eq(&ids), "{name}");
        assert_eq!(comments(&renamed), comments(text), "{name}");
        assert_eq!(after.search.mirror.len(), m.search.mirror.len(), "{name}");
        assert_eq!(after.couplings.len(), m.couplings.len(), "{name}");
        assert_eq!(after.contours.len(), m.contours.len(), "{name}");
    }
}

#[test]
fn what_names_a_thing_goes_with_it() {
    for name in builtin::names() {
        let text = builtin::text(name).unwrap();
        let m = read(text);
        for link in m.links.iter().filter(|l| l.role != Role::Frame) {
            let gone = Edit::Remove {
                items: vec![(Thing::Link, link.id.clone())],
            };
            let rest = apply_edits(text, &[gone]).unwrap();
            if let Err(e) = mechanism_from_str("rest.toml", &rest) {
                let said = e.to_string();
                let unknown = said.contains("unknown link") || said.contains("unknown joint");
                // Lever joints and the disc of a drive are what their tables are about.
                assert!(
                    !unknown
                        || text.contains("[workload.grip]")
                        || text.contains("[workload.drive]"),
                    "{name} without {}: {said}",
                    link.id
                );
            }
        }
    }
}

#[test]
fn what_cannot_be_done_changes_nothing_and_says_why() {
    let text = builtin::text("four-bar").unwrap();
    let entry = |id: &str| Edit::Add {
        what: Thing::Link,
        entry: json!({ "id": id }).as_object().unwrap().clone(),
    };
    let why = |edits: &[Edit]| apply_edits(text, edits).unwrap_err().to_string();
    assert!(
        why(&[set(Thing::Joint, "no", "type", json!("fixed"))])
            .contains("the file has no joint \"no\"")
    );
    assert!(why(&[entry("9"), entry("3")]).contains("link \"3\" already exists"));
    assert!(
        why(&[set(Thing::Joint, "0-1", "point", json!([1, null, 0]))])
            .contains("an empty value is not allowed")
    );
    assert!(
        apply_edits("a = [", &[entry("9")])
            .unwrap_err()
            .to_string()
            .contains("not valid TOML")
    );
    assert!(
        apply_edits("link = [{ id = \"0\" }]", &[entry("9")])
            .unwrap_err()
            .to_string()
            .contains("[[link]]")
    );
}

/// A change to a mechanism, chosen by some numbers.
fn chosen(m: &Mechanism, (kind, which, x, y): (usize, Index, i32, i32)) -> Option<Edit> {
    let joint = m.joints.get(which.index(m.joints.len().max(1)))?;
    let frame = m.links.iter().find(|l| l.role == Role::Frame)?;
    Some(match kind {
        0 => set(Thing::Joint, &joint.id, "point", json!([x, format!("{y}/7"), "sqrt(2)"])),
        1 => set(Thing::Joint, &joint.id, "tolerance", json!(0)),
        2 => Edit::Rename {
            what: Thing::Joint,
            id: joint.id.clone(),
            to: format!("{} {x} {y}", joint.id),
        },
        3 => Edit::Add {
            what: Thing::Joint,
            entry: json!({ "id": format!("new {x} {y} {}", m.joints.len()), "links": [frame.id, m.links.last()?.id], "type": "spherical", "point": [x, y, 0] }).as_object()?.clone(),
        },
        _ => Edit::Put {
            path: vec!["description".to_owned()],
            value: json!(format!("number {x}")),
        },
    })
}

proptest! {
    #![proptest_config(runs(60))]

    #[test]
    fn comments_outlive_any_changes(
        name in select(builtin::names()),
        picks in prop::collection::vec((0..5_usize, any::<Index>(), -50..50, -50..50), 1..8),
    ) {
        let text = builtin::text(name).unwrap();
        let mut now = text.to_owned();
        let mut changes = 0;
        for pick in picks {
            // A change may make a file of it that is no mechanism; then it is undone.
            let Ok(m) = mechanism_from_str("now.toml", &now) else { break };
            let Some(edit) = chosen(&m, pick) else { continue };
            let Ok(next) = apply_edits(&now, &[edit]) else { continue };
            prop_assert_eq!(comments(&next), comments(text));
            changes += 1;
            now = next;
        }
        // Names stand in several places; all else is a line or two.
        prop_assert!(differing(text, &now) <= 40 * changes);
    }
}
