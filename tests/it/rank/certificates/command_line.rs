//! `ozols analyze --certificate` and `ozols verify`.

use crate::common::*;
#[test]
fn certificates_are_written_and_confirmed_and_false_ones_rejected() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("c.json");
    let path = path.to_str().unwrap();
    let plain = run_quiet("analyze gripper-10");
    assert_eq!(
        run_quiet(&["analyze", "gripper-10", "--certificate", path]),
        plain
    );
    let said = run_quiet(&["verify", "gripper-10", path]);
    assert_eq!(
        said,
        "gripper-10, state free: rank 13 of the 24 x 14 closure matrix is proven\n\
         gripper-10, state clamped: rank 14 of the 30 x 14 closure matrix is proven\n"
    );
    // Of another mechanism, with the same states.
    let (code, said, err) = run_full(&["verify", "gripper-10-redesign", path]);
    assert_eq!((code, err.as_str()), (Some(1), ""));
    has(
        &said,
        "state free: certificate rejected: it is for a 24 x 14 matrix",
    );
    // Of the same in a plane.
    let (code, _, _) = run_full(&["verify", "gripper-10", path, "--planar"]);
    assert_eq!(code, Some(1));
    run_quiet(&["analyze", "gripper-10", "--planar", "--certificate", path]);
    run_quiet(&["verify", "gripper-10", path, "--planar"]);
    // Of states it has not.
    run_quiet(&["analyze", "gripper-10", "--certificate", path]);
    let (code, said, err) = run_full(&["verify", "bennett", path]);
    assert_eq!((code, said.as_str()), (Some(2), ""));
    assert!(
        err.contains("state clamped") || err.contains("state free"),
        "{err}"
    );
    for garbled in ["", "{", "[]", "{\"format\": \"x\"}", "\u{0}"] {
        fs::write(path, garbled).unwrap();
        let (code, said, err) = run_full(&["verify", "gripper-10", path]);
        assert_eq!((code, said.as_str()), (Some(2), ""));
        has(&err, "not a file of certificates");
    }
    assert_fails("verify gripper-10 no-such.json", "cannot read no-such.json");
}

#[test]
fn a_field_that_is_too_large_is_said_and_no_error() {
    let folder = tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (file, certificates) = (path("fine.toml"), path("c.json"));
    let text = run_quiet("show four-bar");
    let at = text.find("axis = ").unwrap();
    let end = at + text[at..].find('\n').unwrap();
    let fine = format!(
        "{}axis = [\"cos(1deg/7)\", 0, 1]{}",
        &text[..at],
        &text[end..]
    );
    fs::write(&file, fine).unwrap();
    let (_, err) = run_successful(&["analyze", &file, "--certificate", &certificates]);
    has(
        &err,
        "note: no certificate of state free: the roots and angles generate a number field of degree",
    );
    let (code, said, _) = run_full(&["verify", &file, &certificates]);
    assert_eq!(code, Some(1));
    has(&said, "state free: no certificate: ");
}
