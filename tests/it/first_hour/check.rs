//! `check` says what a file describes, and what in it is likely a slip.

use crate::common::*;
// check

fn four_bar_with(from: &str, to: &str) -> String {
    replace_once(builtin::text("four-bar").unwrap(), from, to)
}

/// Checks a text that can be used: what is said on standard output and on standard error.
fn checked(text: &str) -> (String, String) {
    let (_folder, path) = write_temporary("mine.toml", text);
    run_successful(&["check", path])
}

#[test]
fn check_says_what_a_file_describes() {
    let said = run_quiet("check gripper-10-loaded");
    has_all(
        &said,
        &[
            "gripper-10-loaded: valid",
            "11 links (frame 0; outputs 4, 8; object a), in space",
            "15 joints: 12 revolute, 2 fixed, 1 cylindrical; driven at 0-1",
            "2 states: free with 4 contours, clamped with 5 contours",
            "12 joints with 7 options, 1 place for an unloading joint, 6 mirror pairs; 13,841,287,201 choices",
            "workload: gravity, 10 links with mass, 4 forces, ranking by peak-moment",
        ],
    );
    assert!(run_quiet("check lever-gripper").contains("`ozols grip`"));
    assert!(run_quiet("check torsion-module").contains("`ozols drive`"));
    assert!(run_quiet("check four-bar-planar").contains("in the plane"));
}

#[test]
fn a_file_alone_is_checked_where_nobody_looks_on() {
    for name in ["four-bar", "gripper-10"] {
        let said = run_quiet(&[name]);
        assert!(said.starts_with(&run_quiet(&["check", name])), "{said}");
        for command in ["analyze", "search", "studio"] {
            has(&said, &format!("ozols {command} {name}\n"));
        }
    }
    assert_fails(
        "missing.toml",
        "missing.toml is neither a file nor a built-in mechanism",
    );
    assert_fails("analize", "unrecognized subcommand");
}

#[test]
fn check_doubts_what_is_likely_a_slip() {
    for [from, to, line, parts] in read_cases::<4>(
        r#"
        length_unit = "mm"\n |  | name = | 150 m across & length_unit = "mm"
        "mm" | "m" | length_unit | 150 m across & is correct
        point = [80, 90, 0] | point = [0, 30.00001, 0] | [[joint]] | 1-2 and 2-3 are & from coaxial
        point = [80, 90, 0] | point = [80.0123456789, 90, 0] | [[joint]] | measured & [tolerance]
        "spherical"] | "prismatic"] | "prismatic"] | option "prismatic" is never used
        [search]\n | [search]\nunloading = ["spherical"]\n | unloading = | no effect & unloading = true
        drive = true | drive = true\nunloading = true | unloading = true | "0-1" allows & [search] lists none
        drive = true | drive = true\nforbid = ["sferical"] | forbid | forbids "sferical"
        redundant = 3 | redundant = 2 | redundant = 2 | redundant = 2 in state free & finds 3
        [search]\n | [workload]\ngravity = [0, -9.81, 0]\n[search]\n | gravity | no link has a mass
        id = "1"\n | id = "1"\nmass = 1\ncentre = [0, 0, 0]\n | mass = 1 | no effect without gravity
        [search]\n | [ranking]\nterms = [{ term = "peak-force" }]\n[search]\n | terms = | peak-force & nothing loads
        # rocker on | [[joint]]\nid = "x"\nlinks = ["2", "1"]\ntype = "revolute"\npoint = [0, 30, 0]\naxis = [0, 0, 1]\n# rocker on | ["2", "1"] | "1-2" and "x" are identical
        [[contour]]\n | [[contour]]\njoints = ["2-3", "1-2", "0-1", "3-0"]  # turned\n[[contour]]\n | joints = ["0-1" | follows from the others
        [[contour]]\n | [[link]]\nid = "z"\n[[joint]]\nid = "3-z"\nlinks = ["3", "z"]\ntype = "revolute"\npoint = [9, 9, 9]\naxis = [0, 0, 1]\n[[contour]]\n | [[joint]]\nid = "3-z" | no loop passes through 3-z
        [[contour]]\n | [[link]]\nid = "z"\n[[joint]]\nid = "3-z"\nlinks = ["3", "z"]\ntype = "fixed"\npoint = [9, 9, 9]\n[[contour]]\n | type = "fixed" | "3-z" is fixed in every state & "3" and "z"
        [[contour]]\n | [[link]]\nid = "z"\nrole = "object"\n[[joint]]\nid = "3-z"\nlinks = ["3", "z"]\ntype = "fixed"\npoint = [9, 9, 9]\nstate = "held"\n[[contour]]\n | id = "z" | "z" has a single joint in state held
"#,
    ) {
        let file = four_bar_with(from, to);
        let (said, warned) = checked(&file);
        parts.split(" & ").for_each(|part| has(&warned, part));
        assert!(
            warned.starts_with("warning: ") && said.contains("warning"),
            "{warned}"
        );
        has(&warned, &place_of("mine.toml", &file, line));
    }
}

/// What the built-in files are doubted for is so: common options that suit none of their joints, and an arm.
#[test]
fn check_doubts_built_in_mechanisms_only_with_reason() {
    use ozols::file::lint::check_file;
    use ozols::file::problem::ProblemKind;
    let mut doubted = 0;
    for name in builtin::names() {
        let text = builtin::text(name).unwrap();
        let checked = check_file(&format!("{name}.toml"), text.as_bytes()).unwrap();
        doubted += usize::from(!checked.warnings.warnings.is_empty());
        for d in &checked.warnings.warnings {
            let known = match &d.kind {
                ProblemKind::UselessOption { option } => {
                    let named = |n: &String| n == option;
                    let m = &checked.mechanism;
                    !m.joints
                        .iter()
                        .any(|j| j.options.iter().any(|o| named(&o.name)))
                }
                ProblemKind::OpenChain { .. } => name == "pantograph",
                _ => false,
            };
            assert!(known, "{name}: {}", checked.warnings.render(false));
        }
    }
    assert!(doubted * 10 < builtin::names().len(), "{doubted}");
}

#[test]
fn check_is_quiet_when_asked() {
    let (_folder, path) =
        write_temporary("mine.toml", four_bar_with("redundant = 3", "redundant = 2"));
    let (code, said, warned) = run_full(&["check", "--quiet", path]);
    assert_eq!((code, warned.as_str()), (Some(0), ""));
    has(&said, "1 warning");
}
