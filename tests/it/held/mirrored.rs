//! Mirror pairs that are none.

use super::{file, searched};
use crate::common::{changed, count, run};
use ozols::builtin;

fn gripper() -> String {
    builtin::text("gripper-10").unwrap().to_owned()
}

fn refused(args: &[&str]) -> String {
    let o = run(args);
    assert_eq!((o.status.code(), o.stdout.len()), (Some(2), 0), "{args:?}");
    String::from_utf8(o.stderr).unwrap()
}

#[test]
fn pairs_that_are_no_mirror_images_are_refused_with_their_distance() {
    let wrong = changed(
        &gripper(),
        "[\"2-3\", \"6-7\"], [\"3-0\", \"7-0\"]",
        "[\"2-3\", \"7-0\"], [\"3-0\", \"6-7\"]",
    );
    let line = wrong.lines().position(|l| l.starts_with("mirror")).unwrap() + 1;
    let (_folder, path) = file(&wrong);
    for command in ["check", "search", "analyze"] {
        let said = refused(&[command, &path]);
        // (3, 2.5) mirrored is (3, -2.5), and 7-0 is at (3.5, -0.5).
        for part in [
            "joints \"2-3\" and \"7-0\" are no mirror images",
            "2.06",
            "cm",
            &format!("m.toml:{line}:"),
        ] {
            assert!(said.contains(part), "{command}: no {part:?} in {said}");
        }
    }
}

/// Off by no more than rounding of coordinates could be, the file is read, but its orbits are not counted.
#[test]
fn orbits_need_exact_images() {
    let near = changed(
        &gripper(),
        "point = [3, -2.5, 0]",
        "point = [3, -2.50001, 0]",
    );
    let (_folder, path) = file(&near);
    for flag in ["--symmetric", "--one-per-orbit"] {
        let said = refused(&["search", &path, flag, "--count"]);
        assert!(
            said.contains("joint 2-3") && said.contains("1.000e-5 cm"),
            "{said}"
        );
    }
    assert!(count(&searched(&path, &["--count"])["determinate"]) > 0);
}

/// Joints without a partner are their own images, or there are no orbits.
#[test]
fn what_has_no_image_is_told() {
    let alone = changed(&gripper(), ", [\"4-a\", \"a-8\"]]", "]");
    let (_folder, path) = file(&alone);
    let orbits = ["search", &path, "--one-per-orbit", "--count"];
    let said = refused(&[&orbits[..], &["--state", "clamped"]].concat());
    assert!(said.contains("joint 4-a has no mirror image"), "{said}");
    // The free state has no contacts.
    assert!(count(&searched(&path, &orbits[2..])["determinate"]) > 0);
    let said = refused(&["search", "gripper-10", "--one-per-orbit", "--hold", "5"]);
    assert!(said.contains("links 5 and 9 are mirror images"), "{said}");
}

/// All variants are those that are their own images, and pairs of others.
#[test]
fn orbits_of_the_clamped_gripper() {
    let question = [
        "--max-external",
        "2",
        "--options",
        "revolute,spherical,sphere-in-cylinder",
        "--count",
    ];
    let admissible = |more: &[&str]| {
        count(&searched("gripper-10", &[&question[..], more].concat())["admissible"])
    };
    let (all, own) = (admissible(&[]), admissible(&["--symmetric"]));
    assert_eq!(2 * admissible(&["--one-per-orbit"]), all + own);
    assert!(all > 0);
}
