//! Assemblies that are wrong, incomplete or written by other versions: told in words, never a panic.

use super::make::{
    HERE, HINGES, Object, Place, assembled, fcstd, four_bar, grounded, group, joint, joint_type,
    label, packed, part, property, reference,
};
use super::{figures, read};
use crate::common::*;
use crate::robots::message_of;

fn changed(objects: &[Object], name: &str, from: &str, to: &str) -> Vec<Object> {
    let mut out = objects.to_vec();
    let found = out.iter_mut().find(|o| o.0 == name).unwrap();
    assert!(found.2.contains(from), "{}", found.2);
    found.2 = found.2.replacen(from, to, 1);
    out
}

#[test]
fn archives_that_are_broken_are_told() {
    let whole = fcstd(&four_bar(HINGES));
    let document = |text: &[u8]| packed(&[("Document.xml", text)]);
    for (bytes, words) in [
        (
            whole[..whole.len() / 2].to_vec(),
            "the zip archive cannot be read",
        ),
        (
            packed(&[("GuiDocument.xml", b"<Document/>")]),
            "no Document.xml",
        ),
        (
            document(b"<Document><Objects></Document>"),
            "not well-formed",
        ),
        (document(b"<svg/>"), "<svg>"),
        (fcstd(&[part("Base", HERE)]), "no assembly in the document"),
    ] {
        has(&message_of("x.FCStd", &bytes), words);
    }
    has(
        &message_of("x.FCStd", &whole[..whole.len() / 2]),
        "save the document again",
    );
}

// 70 MB of blanks pack into some kB.
#[test]
fn a_member_that_unpacks_to_too_much_is_refused() {
    let blanks = vec![b' '; 70 << 20];
    let bomb = packed(&[("Document.xml", &blanks)]);
    assert!(bomb.len() < 1 << 20);
    let said = message_of("x.FCStd", &bomb);
    has(&said, "more than the 67108864 allowed");
}

#[test]
fn numbers_and_places_that_are_none_are_named() {
    let bar = four_bar(HINGES);
    let zero = "Px=\"0.0000000000000000\"";
    for (from, to, words) in [
        (zero, "Px=\"nan\"", &["Px", "nan"][..]),
        (
            "<Integer value=\"1\"",
            "<Integer value=\"77\"",
            &["JointType", "from 0 to 12"],
        ),
        (
            "Q3=\"1.0000000000000000\"",
            "Q3=\"0\"",
            &["write a rotation"],
        ),
    ] {
        has_all(
            &message_of("x.FCStd", fcstd(&changed(&bar, "A", from, to))),
            words,
        );
    }
    let twice = [bar, vec![part("Crank", HERE)]].concat();
    has(&message_of("x.FCStd", fcstd(&twice)), "is defined twice");
}

// FreeCAD leaves such joints out, and so do the figures, which say so: W may be too high.
#[test]
fn joints_that_cannot_be_read_are_left_out_and_told() {
    let bar = four_bar(HINGES);
    let missing = changed(&bar, "D", "value=\"Rocker.Edge1\"", "value=\"Gone.Edge1\"");
    let i = read("x.FCStd", &fcstd(&missing), &Options::default());
    assert_eq!(figures(&i), (3, 0));
    assert_eq!(i.report.constraint_rows, 5);
    let told = i.report.text("x.FCStd");
    has(&told, "there is no object Gone");
    has(&told, "W is up to 5 too high");
    let mut other = bar.clone();
    let d = other.iter_mut().find(|o| o.0 == "D").unwrap();
    d.2 = d.2.replace(
        &joint_type("Revolute", &split_words(super::make::TYPES)),
        &joint_type("Helix", &["Fixed", "Helix"]),
    );
    let i = read("x.FCStd", &fcstd(&other), &Options::default());
    assert!(i.report.text("x").contains("type Helix is not known"));
}

#[test]
fn suppressed_joints_are_left_out_in_both_versions() {
    for (name, value) in [("Suppressed", "true"), ("Activated", "false")] {
        let mut bar = four_bar(HINGES);
        let d = bar.iter_mut().find(|o| o.0 == "D").unwrap();
        d.2 += &property(name, &format!("<Bool value=\"{value}\"/>"));
        let i = read("x.FCStd", &fcstd(&bar), &Options::default());
        // An open chain of three hinges.
        assert_eq!(figures(&i), (3, 0), "{name}");
        assert_eq!(i.report.dropped["suppressed joint"], ["D"]);
        assert_eq!(i.report.constraint_rows, 0);
    }
}

// FreeCAD 1.1 names the part itself as the root of a path, and the place of a type in its own list.
#[test]
fn both_versions_say_the_same() {
    let mut bar = four_bar(HINGES);
    for o in bar.iter_mut().filter(|o| o.2.contains("\"JointType\"")) {
        for part in ["Base", "Crank", "Rod", "Rocker"] {
            for which in 1..=2 {
                let old = reference(which, "Assembly", &format!("{part}.Edge1"));
                o.2 = o.2.replace(&old, &reference(which, part, "Edge1"));
            }
        }
        let new = joint_type("Revolute", &["Slider", "Fixed", "Revolute"]);
        o.2 = o.2.replace(
            &joint_type("Revolute", &split_words(super::make::TYPES)),
            &new,
        );
        assert!(!o.2.contains("name=\"Assembly\""));
    }
    let i = read("x.FCStd", &fcstd(&bar), &Options::default());
    assert_eq!(figures(&i), (1, 3));
    assert!(i.report.approximated.is_empty(), "{:?}", i.report);
}

// Of two assemblies the one with more joints is read, the other on demand; a part and a joint of it float.
#[test]
fn several_assemblies_and_parts_that_float() {
    let other = assembled(
        "Other",
        &[
            part("Post", HERE),
            part("Arm", HERE),
            (
                "G".to_owned(),
                "App::FeaturePython",
                property("ObjectToGround", "<Link value=\"Post\"/>"),
            ),
            {
                let mut j = joint("P", "Slider", [("Post", HERE), ("Arm", HERE)], "");
                j.2 = j.2.replace("name=\"Assembly\"", "name=\"Other\"");
                j
            },
        ],
    );
    let mut bar = four_bar(HINGES);
    let more = [
        part("Nut", Place([500.0, 0.0, 0.0], 'x', 0.0)),
        part("Bolt", HERE),
        joint("Loose", "Ball", [("Nut", HERE), ("Bolt", HERE)], ""),
    ];
    for o in &mut bar {
        o.2 = o.2.replace(
            "<Link value=\"D\"/>",
            "<Link value=\"D\"/><Link value=\"Loose\"/>",
        );
    }
    let both = [bar, more.to_vec(), other].concat();
    let bytes = fcstd(&both);
    let i = read("x.FCStd", &bytes, &Options::default());
    assert_eq!(figures(&i), (1, 3));
    let told = i.report.text("x");
    has(&told, "another assembly of the document");
    has(
        &told,
        "2 part that is not connected to the ground (Nut, Bolt)",
    );
    let options = default_with(|o: &mut Options| o.assembly = Some("Other".to_owned()));
    assert_eq!(figures(&read("x.FCStd", &bytes, &options)), (1, 0));
    let options = default_with(|o: &mut Options| o.assembly = Some("Third".to_owned()));
    let e = import("x.FCStd", &bytes, &crate::robots::no_files, &options).unwrap_err();
    assert!(
        e.to_string().contains("assemblies: Other") || e.to_string().contains("Assembly"),
        "{e}"
    );
}

// The frame of the arm stands in a document beside: known where that can be read, and told where it cannot.
#[test]
fn linked_documents_are_read_where_they_are() {
    let link = |file: &str| {
        let placed = property("Placement", &HERE.xml());
        let to = property(
            "LinkedObject",
            &format!("<XLink file=\"{file}\" stamp=\"\" name=\"Sub\"/>"),
        );
        ("Arm".to_owned(), "App::Link", label("Arm") + &placed + &to)
    };
    let at = Place([0.0, 0.0, 5.0], 'x', 90.0);
    let back = Place([0.0, -5.0, 0.0], 'x', -90.0);
    let bytes = |file: &str| {
        fcstd(&assembled(
            "Assembly",
            &[
                part("Base", HERE),
                link(file),
                grounded("Base"),
                joint(
                    "J",
                    "Revolute",
                    [("Base", HERE), ("Arm.Body.Pad.Edge2", back)],
                    "",
                ),
            ],
        ))
    };
    // Sub has a body at a place; back is the way from it.
    let mut body = part("Body", at);
    body.1 = "PartDesign::Body";
    let sub = fcstd(&[body, ("Sub".to_owned(), "App::Part", group(&["Body"]))]);
    let beside = |name: &str| match name {
        "sub.FCStd" => Ok(sub.clone()),
        _ => Err(std::io::Error::other("there is no such file")),
    };
    let found = import("x.FCStd", &bytes("sub.FCStd"), &beside, &Options::default()).unwrap();
    assert_eq!(figures(&found), (1, 0));
    assert!(
        found.report.approximated.is_empty(),
        "{:?}",
        found.report.approximated
    );
    let not = read("x.FCStd", &bytes("gone.FCStd"), &Options::default());
    let told = not.report.text("x");
    has(&told, "its frame is uncertain");
}

#[test]
fn an_axis_that_is_z_but_for_rounding_is_z() {
    let mut bar = four_bar(HINGES);
    for o in &mut bar {
        o.2 = o.2.replace("Q0=\"0.0000000000000000\"", "Q0=\"1.3e-49\"");
    }
    let i = read("x.FCStd", &fcstd(&bar), &Options::default());
    let text = i.toml().unwrap();
    assert_eq!(text.matches("axis = [0, 0, 1]").count(), 4, "{text}");
}

#[test]
fn asmt_files_that_are_wrong_are_told_by_line() {
    let at = "Position3D\n\t\t\t\t0 0 0\n\t\t\tRotationMatrix\n\t\t\t\t1 0 0\n\t\t\t\t0 1 0\n\t\t\t\t0 0 1\n";
    let head = "OndselSolver\nAssembly\n\tName\n\t\tA\n\tPosition3D\n\t\t0 0 0\n\tRotationMatrix\n\t\t1 0 0\n\t\t0 1 0\n\t\t0 0 1\n";
    let joint = |kind: &str, i: &str, j: &str| {
        format!(
            "\tConstraintSets\n\t\tJoints\n\t\t\t{kind}\n\t\t\t\tName\n\t\t\t\t\tJ\n\t\t\t\tMarkerI\n\t\t\t\t\t{i}\n\t\t\t\tMarkerJ\n\t\t\t\t\t{j}\n"
        )
    };
    let parts = format!("\tParts\n\t\tPart\n\t\t\tName\n\t\t\t\tB\n\t\t\t{at}");
    for (rest, said) in [
        (
            joint("RevoluteJoint", "/A/x", "/A/y"),
            "names the marker \"/A/x\"",
        ),
        (
            parts.replace("0 0 1", "0 0 7"),
            "write the rows of a rotation",
        ),
        (parts.replace("0 0 0", "0 0"), "write 3 finite numbers"),
        ("\tParts\n\t\t\tPart\n".to_owned(), "one tab deeper"),
        ("\tParts\n\t\tPart\n\t\t\tx\n".to_owned(), "has no Name"),
    ] {
        let found = message_of("x.asmt", format!("{head}{rest}").as_bytes());
        assert!(found.contains(said), "{rest}: {found}");
        has(&found, "x.asmt");
    }
}

#[test]
fn bad_files_end_with_2() {
    let dir = Folder::with("x.FCStd", &fcstd(&four_bar(HINGES))[..200]);
    for command in ["lint", "analyze", "fix", "check"] {
        dir.assert_fails(&[command, "x.FCStd"], "x.FCStd");
    }
}
