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

/// The figures of a document in the folder.
fn figures_of(dir: &Folder, name: &str) -> (usize, usize) {
    figures(&read(name, &dir.bytes(name), &Options::default()))
}

// Two joints get another type: a number each, and a mark that FreeCAD is to solve them anew.
#[test]
fn fix_changes_types_and_nothing_else() {
    let dir = Folder::with("x.FCStd", fcstd(&four_bar(HINGES)));
    dir.succeed("fix x.FCStd -o new.FCStd");
    assert_eq!(figures_of(&dir, "new.FCStd"), (1, 0));
    // What is fixed is written as it is.
    dir.succeed("fix new.FCStd -o again.FCStd");
    let [was, is, again] = ["x.FCStd", "new.FCStd", "again.FCStd"].map(|f| members(&dir.bytes(f)));
    assert_eq!(again, is);
    assert_eq!(was[1..], is[1..]);
    assert_eq!(was[0].0, is[0].0);
    let [was, is] = [&was, &is].map(|m| utf8_text(&m[0].1));
    let differ = was.lines().zip(is.lines()).filter(|(a, b)| a != b);
    assert_eq!(differ.count(), 4, "{is}");
    assert_eq!(is.matches(" Touched=\"1\"").count(), 2);
    assert_eq!(is.replace(" Touched=\"1\"", "").len(), was.len());
}

#[test]
fn fix_keeps_to_the_joints_that_may_be_changed() {
    let dir = Folder::with("x.FCStd", fcstd(&four_bar(HINGES)));
    dir.succeed("fix x.FCStd --at B --at C -o new.FCStd");
    let i = read("x", &dir.bytes("new.FCStd"), &Options::default());
    assert_eq!(figures(&i), (1, 0));
    for j in &i.mechanism.joints {
        let changed = j.joint_type.name() != "revolute";
        assert_eq!(changed, ["B", "C"].contains(&j.id.as_str()), "{}", j.id);
    }
    // A search may be asked for types that FreeCAD has no joint for; those are not written.
    for [more, said] in read_cases::<2>(
        "--at B -o no.FCStd | no choice of joint types
        --at Z | no such joint
        --idea 1 --options sphere-in-cylinder | has no joint type",
    ) {
        dir.assert_fails(&format!("fix x.FCStd {more}"), said);
    }
}

// The label of a joint is its type there.
#[test]
fn asmt_files_get_other_labels() {
    // Two hinges at one place between the same two parts: five rows are held twice, and no other type lets only those go.
    let text = super::ondsel::asmt("OndselSolver", "Revolute", "");
    let at = text.find("\t\tMotions").unwrap();
    let from = text.find("\t\t\tRevoluteJoint").unwrap();
    let second = text[from..at].replace("\tJ\n", "\tK\n");
    let twice = format!("{}{second}{}", &text[..at], &text[at..]);
    let (code, out, said) = run_on("lint", "x.asmt", &twice, "");
    assert_eq!(code, Some(1), "{said}");
    has(&out, "5 redundant constraints");
    assert_fails_on(
        "fix",
        "x.asmt",
        &twice,
        "-o y.asmt",
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
