//! Grips that cannot be: refused, or told.

use super::text;
use crate::common::*;

/// Writes a file, runs commands on it, and gives exit code, output and errors.
pub(super) fn run(text: &str, line: &str) -> (Option<i32>, String, String) {
    let (_folder, path) = write_temporary("gripper.toml", text);
    run_full(&line.replace("FILE", path))
}

const STATICS: &str = "statics FILE --state clamped";

/// Files as users write them: what is wrong is refused at its line by every command, what cannot be held is said.
#[test]
fn impossible_grips_are_refused_or_told() {
    let with = |from: &str, to: &str| {
        assert!(text().contains(from), "{from}");
        text().replacen(from, to, 1)
    };
    // Wrong in itself: exit code 2 from all, with the line and what to give.
    for [from, to, line, part] in read_cases::<4>(
        r#"
        density = 7850 | density = -7850 | density | a number above 0
        density = 7850\npart_length = 120 | mass = -1 | mass = -1 | a number above 0
        id = "3" | id = "3"\nmass = -2\ncentre = [0, 0, 0] | mass = -2 | a number from 0
        prism_angle = 120 | prism_angle = 180 | prism_angle | at 180 the faces form no V
        prism_angle = 120 | prism_angle = "pi" | prism_angle | at 180 the faces form no V
        friction = 0.2 | friction = -0.2 | friction | a coefficient from 0 to 10
        friction = 0.2 |  | density | needs friction
        diameter = 40 | diameter = -40 | diameter = -40 | a number above 0
        lever_joints = ["0-1", "0-2"]\n |  | contacts | contacts needs lever_joints
        contacts = ["1-a far" | contacts = ["1-a fat" | contacts | unknown joint "1-a fat"
        contacts = ["1-a far", "1-a near" | contacts = ["2-a far", "1-a near" | contacts | turns in the first of lever_joints
        friction = 0.2 | friction = 0.2\nlevers = "independent" | contacts | one drive for both
        friction = 0.2 | friction = 0.2\npivots = "nominal" | contacts | pivots = "fixed"
"#,
    ) {
        let text = with(from, to);
        let place = place_of("gripper.toml", &text, line);
        for line_of in ["grip FILE", STATICS, "check FILE"] {
            let (code, said, errors) = run(&text, line_of);
            assert_eq!(
                (code, said.as_str()),
                (Some(2), ""),
                "{to} {line_of}: {errors}"
            );
            has_all(&errors, &[part, "gripper.toml:"]);
            if line != "contacts" && line != "density" {
                has(&errors, &place);
            }
        }
    }
    // Cannot be held: a valid file, exit code 1 with the reason.
    let several = "diameters = { from = 30, to = 50, count = 5 }";
    let unfounded = "slides along its axis (z); faces without friction cannot stop that";
    for (from, to, part) in [
        ("friction = 0.2", "friction = 0", unfounded),
        (several, "diameters = [90, 100]", "larger than the jaws"),
    ] {
        let text = with(from, to);
        for line in ["grip FILE", STATICS] {
            let (code, said, errors) = run(&text, line);
            assert_eq!((code, errors.as_str()), (Some(1), ""), "{to} {line}");
            has_all(&said, &[part, "cannot"]);
        }
        assert_eq!(run(&text, "check FILE").0, Some(0));
        let (code, said, _) = run(&text, "statics FILE --state clamped --format json");
        let said: Value = serde_json::from_str(&said).unwrap();
        assert_eq!((code, &said["held"]), (Some(1), &json!(false)));
        // Nothing to rank by.
        let (code, _, errors) = run(&text, "search FILE --top 1");
        assert_eq!(code, Some(2));
        has(&errors, "holds none of its parts");
    }
    // Friction 0 with a pull across the part alone can be held.
    let across = with("friction = 0.2", "friction = 0")
        .replace("any_acceleration = 5\n", "gravity = [-9.81, 0, 0]\n");
    // One of two: what is held is answered, what is not is said. Figures that are not those of the joints are refused.
    let some = with(several, "diameters = [40, 90]");
    let off = with("lever_length = 100", "lever_length = 99");
    let disagrees = "make the joints' points and the figures agree";
    for (text, line, code, part) in [
        (&across, "grip FILE", 0, ""),
        (&across, STATICS, 0, ""),
        (&some, "grip FILE", 1, ""),
        (
            &some,
            STATICS,
            0,
            "D = 90 mm cannot be held: larger than the jaws",
        ),
        (&some, "statics FILE --state clamped --diameter 90", 1, ""),
        (&off, STATICS, 2, disagrees),
        (&off, "check FILE", 2, disagrees),
        (&off, "grip FILE", 2, disagrees),
    ] {
        let (found, said, errors) = run(text, line);
        assert_eq!(found, Some(code), "{line}: {said}{errors}");
        has(&(said + &errors), part);
    }
    for more in [
        "--stroke 0:1:2",
        "--diameter 33",
        "--method delta",
        "--svg x",
    ] {
        assert_eq!(
            run(text(), &format!("{STATICS} {more}")).0,
            Some(2),
            "{more}"
        );
    }
    let (code, _, errors) = run(text(), "statics FILE --diameter 40");
    assert_eq!(code, Some(2));
    has(&errors, "no grip loads state free");
}
