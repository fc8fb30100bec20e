//! What outputs can do, in words, against what is published of each mechanism; and as twists, against the exact kernel of J.

use crate::common::*;
fn free(args: &[&str]) -> Value {
    run_json(&[&["analyze", "--state", "free", "--format", "json"], args].concat())["states"][0]
        .take()
}

/// Delta, tripteron and the orthogonal platforms translate; the agile eye turns about a point; 4-UPU has Schoenflies motion.
#[test]
fn outputs_move_as_published() {
    for (name, link, words) in [
        ("tripteron", "p", "three translations"),
        ("delta", "p", "three translations"),
        ("sarrus", "3", "translation along z"),
        ("4-upu", "p", "three translations and rotation about z"),
        ("stewart-gough", "p", "every motion"),
    ] {
        let state = free(&[name]);
        let motions = state["motions"].list();
        let found = motions.iter().find(|m| m["link"] == link);
        let found = found.unwrap_or_else(|| panic!("{name}: {motions:?}"));
        assert_eq!(found["text"], words, "{name}");
    }
    let eye = free(&["agile-eye"]);
    let text = eye["motions"][0]["text"].word();
    assert!(
        text.starts_with("three rotations, all axes through (0, 0, 0)"),
        "{text}"
    );
    let jaw = free(&["gripper-10"]);
    for m in jaw["motions"].list() {
        let text = m["text"].word();
        assert!(
            text.starts_with("translation along ") || text.starts_with("rotation about z"),
            "{text}"
        );
    }
}

/// A dimension is that of the twists, no more than the working mobility, and equal to it where there is one output.
#[test]
fn dimensions_are_those_of_the_exact_kernel() {
    let all = run_json("list --format json");
    let names: BTreeSet<&str> = all.list().iter().map(|m| m["name"].word()).collect();
    let mut named = 0;
    for name in names {
        let state = free(&[name]);
        let motions = state["motions"].list();
        let working = state["working_mobility"].whole();
        for m in motions {
            let dimension = m["dimension"].whole();
            assert_eq!(m["twists"].list().len() as u64, dimension, "{name}");
            assert!(dimension <= working, "{name}");
        }
        if let [one] = &motions[..] {
            assert_eq!(one["dimension"].whole(), working, "{name}");
        }
        named += motions.len();
    }
    assert!(named > 100, "{named}");
}

/// A screw's nut climbs by the lead of the thread in a turn, and the connectivity of two links is asked in either order.
#[test]
fn screws_and_connectivity() {
    let thread = "thread | 0 nut | helical | 1, 2, 3 | 0, 0, 1 | lead = 5";
    let (_folder, path) = write_temporary(
        "nut.toml",
        write_mechanism("name = \"nut\"", "0 nut*", thread),
    );
    let state = free(&[path]);
    let found = state["motions"][0]["text"].word();
    assert!(
        found.starts_with("screw motion along z through (1, 2, "),
        "{found}"
    );
    assert!(found.ends_with("lead 5 m"), "{found}");
    let one = |a: &str, b: &str| {
        let state = free(&["four-bar", "--link", a, "--relative-to", b]);
        state["motions"].list().last().unwrap().clone()
    };
    let [there, back] = [one("2", "1"), one("1", "2")];
    assert_eq!(there["dimension"], 1);
    for k in 0..6 {
        let of = |v: &Value| v["twists"][0][k].real().abs();
        near(of(&there), of(&back), 1e-9);
    }
    assert_fails(
        "analyze four-bar --link nowhere",
        "has no link nowhere; it has: 0, 1, 2, 3",
    );
}

/// A robot of three legs has Gogu's four numbers, which are W, σ, and the motions of its platform and of what that does not feel.
#[test]
fn robots_with_legs_have_the_numbers_of_gogu() {
    let of = |name: &str| run_json(&format!("analyze {name} --format json"))["states"][0].take();
    let crr = of("3-crr");
    for (symbol, key) in [
        ("M", "mobility"),
        ("N", "redundant"),
        ("S", "working_mobility"),
        ("T", "local_mobility"),
    ] {
        assert_eq!(crr["gogu"][symbol], crr[key]);
    }
    assert!(of("gripper-10")["gogu"].is_null());
}
