//! `ozols fix` of assemblies: other joint types in the owner's own file, and nothing else.

use super::make::{HINGES, fcstd, four_bar};
use super::{figures, read};
use crate::common::*;
use ozols::robots::{Options, apply_releases};
use std::io::Cursor;
use zip::ZipArchive;

/// Name and bytes of each member, in order.
fn members(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).unwrap();
    (0..archive.len())
        .map(|i| {
            let mut file = archive.by_index(i).unwrap();
            let mut out = Vec::new();
            file.read_to_end(&mut out).unwrap();
            (file.name().unwrap().into_owned(), out)
        })
        .collect()
}

// Two joints get another type: a number each, and a mark that FreeCAD is to solve them anew.
#[test]
fn fix_changes_types_and_nothing_else() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let (old, new) = (path("x.FCStd"), path("fixed.FCStd"));
    fs::write(&old, fcstd(&four_bar(HINGES))).unwrap();
    run_successful(&["fix", &old, "-o", &new]);
    let [before, after] = [&old, &new].map(|p| fs::read(p).unwrap());
    let i = read("fixed.FCStd", &after, &Options::default());
    assert_eq!(figures(&i), (1, 0));
    let [was, is] = [&before, &after].map(|b| members(b));
    assert_eq!(was[1..], is[1..]);
    assert_eq!(was[0].0, is[0].0);
    let [was, is] = [&was[0].1, &is[0].1].map(|b| String::from_utf8(b.clone()).unwrap());
    let differ = was.lines().zip(is.lines()).filter(|(a, b)| a != b);
    let differ: Vec<(&str, &str)> = differ.collect();
    assert_eq!(differ.len(), 4, "{differ:?}");
    assert_eq!(is.matches(" Touched=\"1\"").count(), 2);
    assert_eq!(is.replace(" Touched=\"1\"", "").len(), was.len());
    // What is fixed is written as it is.
    run_successful(&["fix", &new, "-o", &path("again.FCStd")]);
    let again = fs::read(path("again.FCStd")).unwrap();
    assert_eq!(members(&again), members(&after));
}

#[test]
fn fix_keeps_to_the_joints_that_may_be_changed() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let (old, new) = (path("x.FCStd"), path("fixed.FCStd"));
    fs::write(&old, fcstd(&four_bar(HINGES))).unwrap();
    run_successful(&["fix", &old, "--at", "B", "--at", "C", "-o", &new]);
    let i = read("x", &fs::read(&new).unwrap(), &Options::default());
    assert_eq!(figures(&i), (1, 0));
    for j in &i.mechanism.joints {
        let changed = j.joint_type.name() != "revolute";
        assert_eq!(changed, ["B", "C"].contains(&j.id.as_str()), "{}", j.id);
    }
    assert_fails(
        &["fix", &old, "--at", "B", "-o", &path("no.FCStd")],
        "no choice of joint types",
    );
    assert_fails(&["fix", &old, "--at", "Z"], "no such joint");
}

// A search may be asked for types that FreeCAD has no joint for; those are not written.
#[test]
fn types_that_freecad_has_not_are_refused() {
    let dir = tempdir().unwrap();
    let old = dir.path().join("x.FCStd").display().to_string();
    fs::write(&old, fcstd(&four_bar(HINGES))).unwrap();
    let words = [
        "fix",
        &old,
        "--idea",
        "1",
        "--options",
        "sphere-in-cylinder",
    ];
    assert_fails(&words, "has no joint type");
}

// export writes the same document as fix, of a variant or as it is, and of nothing but a document.
#[test]
fn export_writes_the_owners_document() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let (old, new, same) = (path("x.FCStd"), path("new.FCStd"), path("same.FCStd"));
    fs::write(&old, fcstd(&four_bar(HINGES))).unwrap();
    for (more, out) in [(&["--idea", "1"][..], &new), (&[], &same)] {
        let words = [&["export", &old, "--to", "fcstd", "-o", out], more].concat();
        run_successful(&words);
    }
    let [old_bytes, new_bytes, same_bytes] = [&old, &new, &same].map(|p| fs::read(p).unwrap());
    assert_eq!(members(&same_bytes), members(&old_bytes));
    assert_eq!(figures(&read("x", &new_bytes, &Options::default())), (1, 0));
    for (file, to, said) in [
        ("gripper-10", "fcstd", "is not a file"),
        (old.as_str(), "asmt", "is not one"),
    ] {
        let (code, _, told) = run_full(&["export", file, "--to", to]);
        assert_eq!(code, Some(2));
        assert!(told.contains(said), "{told}");
    }
}

// The label of a joint is its type there.
#[test]
fn asmt_files_get_other_labels() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let old = path("x.asmt");
    // Two hinges at one place between the same two parts: five rows are held twice, and no other type lets only those go.
    let text = super::ondsel::asmt("OndselSolver", "Revolute", "");
    let at = text.find("\t\tMotions").unwrap();
    let from = text.find("\t\t\tRevoluteJoint").unwrap();
    let second = text[from..at].replace("\tJ\n", "\tK\n");
    let twice = format!("{}{second}{}", &text[..at], &text[at..]);
    fs::write(&old, &twice).unwrap();
    let (code, out, said) = run_full(&["lint", &old]);
    assert_eq!(code, Some(1), "{said}");
    has(&out, "5 redundant constraints");
    assert_fails(
        &["fix", &old, "-o", &path("y.asmt")],
        "no choice of joint types",
    );
    let i = read("x.asmt", twice.as_bytes(), &Options::default());
    let slide = |direction: [f64; 3]| {
        let joint = i.mechanism.joint_ids().next().unwrap();
        let release = Release::Freedom {
            joint,
            slides: true,
            direction,
        };
        apply_releases(&i, &[(release, String::new())])
    };
    let other = String::from_utf8(slide([0.0, 0.0, 1.0]).unwrap()).unwrap();
    assert_eq!(
        other,
        twice.replacen("RevoluteJoint", "CylindricalJoint", 1)
    );
    let e = slide([1.0, 0.0, 0.0]).unwrap_err();
    has(&e.to_string(), "no joint type with the required freedoms");
}

// A hinge has the turn about its own axis already: an axis some digits off is no other type, while a square one is.
#[test]
fn a_freedom_that_a_joint_has_but_for_rounding_changes_no_type() {
    let i = read("x.FCStd", &fcstd(&four_bar(HINGES)), &Options::default());
    for joint in i.mechanism.joint_ids() {
        for off in [0.0, 1e-9, 3e-5] {
            let turn = (false, [0.0, off, 1.0]);
            assert_eq!(i.origin.cad_type(joint, &[turn]), None);
            assert!(!i.origin.can_be_freed(joint, turn));
            let slide = (true, [0.0, off, 1.0]);
            assert_eq!(
                i.origin.cad_type(joint, &[turn, slide]),
                Some("Cylindrical")
            );
        }
        assert_eq!(i.origin.cad_type(joint, &[]), Some("Revolute"));
    }
}
