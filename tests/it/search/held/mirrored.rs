//! Mirror pairs that are none.

use super::{refused, run_search};
use crate::common::*;

fn gripper() -> String {
    builtin::text("gripper-10").unwrap().to_owned()
}

#[test]
fn pairs_that_are_no_mirror_images_are_refused_with_their_distance() {
    let wrong = replace_once(
        &gripper(),
        "[\"2-3\", \"6-7\"], [\"3-0\", \"7-0\"]",
        "[\"2-3\", \"7-0\"], [\"3-0\", \"6-7\"]",
    );
    let place = place_of("m.toml", &wrong, "mirror = ");
    let (_folder, path) = write_temporary("m.toml", &wrong);
    for command in ["check", "search", "analyze"] {
        let said = refused(&[command, path]);
        // (3, 2.5) mirrored is (3, -2.5), and 7-0 is at (3.5, -0.5).
        for part in [
            "joints \"2-3\" and \"7-0\" are not mirror images",
            "2.06",
            "cm",
            &place,
        ] {
            assert!(said.contains(part), "{command}: no {part:?} in {said}");
        }
    }
}

/// Off by a little more than rounding of coordinates could be, the file is read, but its orbits are not counted.
#[test]
fn orbits_need_exact_images() {
    let near = replace_once(
        &gripper(),
        "point = [3, -2.5, 0]",
        "point = [3, -2.50004, 0]",
    );
    let (_folder, path) = write_temporary("m.toml", &near);
    for flag in ["--symmetric", "--one-per-orbit"] {
        let said = refused(&["search", path, flag, "--count"]);
        has(&said, "joint 2-3");
        has(&said, "4.000e-5 cm");
    }
    assert!(parse_count(&run_search(path, "--count")["determinate"]) > 0);
}

/// Joints without a partner are their own images, or there are no orbits.
#[test]
fn what_has_no_image_is_told() {
    let alone = replace_once(&gripper(), ", [\"4-a\", \"a-8\"]]", "]");
    let (_folder, path) = write_temporary("m.toml", &alone);
    let orbits = ["search", path, "--one-per-orbit", "--count"];
    let said = refused(&[&orbits[..], &["--state", "clamped"]].concat());
    has(&said, "joint 4-a has no image");
    // The free state has no contacts.
    assert!(parse_count(&run_search(path, &orbits[2..])["determinate"]) > 0);
    let said = refused(&["search", "gripper-10", "--one-per-orbit", "--hold", "5"]);
    has(&said, "links 5 and 9 are images of each other");
}

/// All variants are those that are their own images, and pairs of others.
#[test]
fn orbits_of_the_clamped_gripper() {
    let options = "--options revolute,spherical,sphere-in-cylinder";
    let admissible = |more: &str| {
        let question = format!("--max-external 2 {options} --count {more}");
        parse_count(&run_search("gripper-10", &question)["admissible"])
    };
    let (all, own) = (admissible(""), admissible("--symmetric"));
    assert_eq!(2 * admissible("--one-per-orbit"), all + own);
    assert!(all > 0);
}

/// Both pairs stand on the mirror plane, so their points alone do not say which plane it is: across x = 3 they are images
/// too, but there the slider, which has no partner, is not its own.
#[test]
fn joints_without_a_partner_and_skew_axes_say_which_plane_it_is() {
    for (axis, image) in [
        ([0, 0, 1], [0, 0, 1]),
        ([1, 2, -1], [1, -2, -1]),
        ([0, 1, 0], [0, -1, 0]),
    ] {
        let mut joints =
            "middle | f s | revolute | 0, 0, 0 | 1, 0, 0 | options = [\"cylindrical\"]\n"
                .to_owned();
        for (side, [x, y, z]) in [("u", axis), ("l", image)] {
            for (i, ends) in [format!("s {side}"), format!("{side} f")]
                .iter()
                .enumerate()
            {
                joints += &format!(
                    "{side}{i} | {ends} | revolute | 3, 0, {i} | {x}, {y}, {z} | options = [\"spherical\"]\n"
                );
            }
        }
        let head =
            "name = \"on the plane\"\n[search]\nmirror = [[\"u0\", \"l0\"], [\"u1\", \"l1\"]]";
        let text = write_mechanism(head, "f s u* l*", &joints);
        let m = read(&text);
        let conditions = default_with(|c: &mut Conditions| c.symmetry = Symmetry::SymmetricOnly);
        let search = Search::new(exact_field(&m, 0).unwrap(), &m, conditions);
        assert!(search.is_ok(), "{axis:?}: {:?}", search.err());
    }
}
