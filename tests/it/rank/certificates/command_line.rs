//! `ozols analyze --certificate` and `ozols verify`.

use crate::common::*;
#[test]
fn certificates_are_written_and_confirmed_and_false_ones_rejected() {
    let folder = Folder::new();
    let (said, _) = folder.succeed("analyze gripper-10 --certificate c.json");
    assert_eq!(said, run_quiet("analyze gripper-10"));
    let (said, _) = folder.succeed("verify gripper-10 c.json");
    assert_eq!(
        said,
        "gripper-10, state free: rank 13 of the 24 x 14 closure matrix is proven\n\
         gripper-10, state clamped: rank 14 of the 30 x 14 closure matrix is proven\n"
    );
    // Of another mechanism, with the same states.
    let (code, said, err) = folder.run("verify gripper-10-redesign c.json");
    assert_eq!((code, err.as_str()), (Some(1), ""));
    let other = "state free: certificate rejected: it is for a 24 x 14 matrix";
    has(&said, other);
    // Of the same in a plane.
    assert_eq!(folder.run("verify gripper-10 c.json --planar").0, Some(1));
    folder.succeed("analyze gripper-10 --planar --certificate c.json");
    folder.succeed("verify gripper-10 c.json --planar");
    // Of states it has not.
    folder.succeed("analyze gripper-10 --certificate c.json");
    folder.assert_fails("verify bennett c.json", "state ");
    for garbled in ["", "{", "[]", "{\"format\": \"x\"}", "\u{0}"] {
        folder.put("c.json", garbled);
        let says = "not a file of certificates";
        folder.assert_fails("verify gripper-10 c.json", says);
    }
    folder.assert_fails("verify gripper-10 no-such.json", "cannot read no-such.json");
}

#[test]
fn a_field_that_is_too_large_is_said_and_no_error() {
    let axis = "axis = [\"cos(1deg/7)\", 0, 1]";
    let fine = replace_once(&run_quiet("show four-bar"), "axis = [0, 0, 1]", axis);
    let folder = Folder::with("fine.toml", fine);
    let (_, err) = folder.succeed("analyze fine.toml --certificate c.json");
    has(
        &err,
        "note: no certificate of state free: the roots and angles generate a number field of degree",
    );
    let (code, said, _) = folder.run("verify fine.toml c.json");
    assert_eq!(code, Some(1));
    has(&said, "state free: no certificate: ");
}
