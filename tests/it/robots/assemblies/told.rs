//! What lint says of assemblies: rows, misfits, the true number of freedoms and which types to change.

use super::make::{
    HERE, HINGES, Object, Place, assembled, document, fcstd, four_bar, grounded, joint, number,
    packed, part, property,
};
use super::{figures, read};
use crate::common::*;
use crate::robots::lint::linted;

fn lint(objects: &[Object]) -> (Option<i32>, Value) {
    linted("x.FCStd", fcstd(objects))
}

// Four hinges of a planar loop hold the way along z and the turns about x and y twice; a ball and a cylindrical joint let that
// go. 6·3 - 20 = -2.
#[test]
fn a_four_bar_holds_three_rows_twice() {
    let (code, v) = lint(&four_bar(HINGES));
    assert_eq!(code, Some(1));
    assert_eq!(
        (&v["mobility"], &v["redundant"], &v["counted"]),
        (&json!(1), &json!(3), &json!(-2))
    );
    let found = v["findings"].list();
    assert_eq!(found.len(), 3);
    let rows: Vec<&str> = found.iter().map(|f| f["row"].word()).collect();
    assert_eq!(rows, ["z", "turn about x", "turn about y"]);
    for f in found {
        assert_eq!(f["duplicates"].list().len(), 3);
        assert!(f["misfit"]["millimetres"].real() < 1e-9);
        assert!(f["file"].word().ends_with("x.FCStd/Document.xml"));
    }
    let changes = v["changes"].list();
    let to: Vec<&str> = changes.iter().map(|c| c["to"].word()).collect();
    assert_eq!(changes.len(), 2);
    assert!(
        to.contains(&"Ball") && to.contains(&"Cylindrical"),
        "{to:?}"
    );
    assert!(changes.iter().all(|c| c["from"] == "Revolute"));
}

// A hinge whose second frame is tilted by 1.2 degrees: so much is said, and nothing of other poses.
#[test]
fn what_is_open_is_told_in_degrees() {
    let mut bar = four_bar(HINGES);
    let a = bar.iter_mut().find(|o| o.0 == "A").unwrap();
    let tilted = Place([0.0; 3], 'x', 1.2).xml();
    let last = a.2.rfind("<PropertyPlacement").unwrap();
    a.2 = a.2[..last].to_owned() + &tilted + "</Property>";
    let (code, v) = lint(&bar);
    assert_eq!(code, Some(1));
    let told = v["approximated"][0].word();
    has(told, "joint \"A\": its two frames are 1.2 degrees apart");
    assert_eq!(v["over_motion_kind"], "unknown");
    let of_a = v["findings"].list().iter().find(|f| f["constraint"] == "A");
    if let Some(f) = of_a {
        assert!((f["misfit"]["degrees"].real() - 1.2).abs() < 1e-9);
    }
    // No motion of planar hinges closes it.
    let options = default_with(|o: &mut Options| o.assemble = true);
    let e = ozols::robots::import("x.FCStd", &fcstd(&bar), &crate::robots::no_files, &options);
    assert!(
        e.unwrap_err()
            .to_string()
            .contains("the loops do not close")
    );
}

// A crank that is out of its place by 3 degrees: the file is open, and the joints can be closed.
#[test]
fn assemble_closes_what_can_be_closed() {
    let mut bar = four_bar(HINGES);
    let crank = bar.iter_mut().find(|o| o.0 == "Crank").unwrap();
    *crank = part("Crank", Place([0.0; 3], 'z', 33.0));
    let bytes = fcstd(&bar);
    let i = read("x.FCStd", &bytes, &Options::default());
    assert!(
        i.report.approximated[0].contains("mm apart"),
        "{:?}",
        i.report.approximated
    );
    let options = default_with(|o: &mut Options| o.assemble = true);
    let i = read("x.FCStd", &bytes, &options);
    assert_eq!(figures(&i), (1, 3));
    let moved = i.report.moved.join("; ");
    has(&moved, "closed to");
    has(&moved, "mm apart in the file");
    assert!(i.report.approximated.is_empty());
}

/// A shaft in a hinge and a rack on a slider, and what couples them.
fn pair(word: &str, more: &str, slides: bool) -> Vec<Object> {
    let along_x = Place([0.0, -10.0, 0.0], 'y', 90.0);
    let other = Place([50.0, 0.0, 0.0], 'z', 0.0);
    let second = if slides {
        joint("S", "Slider", [("Base", along_x), ("Second", along_x)], "")
    } else {
        joint("S", "Revolute", [("Base", other), ("Second", other)], "")
    };
    let at = if slides { along_x } else { other };
    assembled(
        "Assembly",
        &[
            part("Base", HERE),
            part("First", HERE),
            part("Second", HERE),
            grounded("Base"),
            joint("R", "Revolute", [("Base", HERE), ("First", HERE)], ""),
            second,
            joint("K", word, [("Second", at), ("First", HERE)], more),
        ],
    )
}

// Gears of 20 and 30 mm turn against each other as 3 to 2; a belt turns both the same way; a rack goes 10 mm a radian.
#[test]
fn couplings_have_their_ratios() {
    let two = |a: f64, b: f64| number("Distance", a) + &number("Distance2", b);
    for (objects, ratio) in [
        (pair("Gears", &two(20.0, 30.0), false), 2.0 / 3.0),
        (pair("Belt", &two(20.0, 30.0), false), 2.0 / 3.0),
        (pair("Belt", &two(25.0, 25.0), false), 1.0),
        (pair("RackPinion", &number("Distance", 10.0), true), 0.1),
    ] {
        let i = read("x.FCStd", &fcstd(&objects), &Options::default());
        assert_eq!(figures(&i), (1, 0));
        let [c] = &i.mechanism.couplings[..] else {
            panic!("{:?}", i.report);
        };
        assert!(
            (c.ratio.to_f64().abs() - ratio).abs() < 1e-9,
            "{}",
            c.ratio.to_f64()
        );
        // Gears turn against each other, what a belt drives turns along.
        if !objects
            .iter()
            .any(|o| o.0 == "S" && o.2.contains("value=\"3\""))
        {
            let against = ratio < 1.0
                && objects
                    .iter()
                    .any(|o| o.0 == "K" && o.2.contains("value=\"11\""));
            assert_eq!(c.ratio.to_f64() < 0.0, against);
        }
    }
}

// By hand: a part at a distance of a grounded one keeps 6 less the constraints of the table.
#[test]
fn distance_and_angle_joints_hold_what_the_table_says() {
    let tilted = Place([0.0, 0.0, 40.0], 'x', 30.0);
    let up = Place([0.0, 0.0, 40.0], 'x', 0.0);
    let (distance, angle) = (|d| number("Distance", d), |a| number("Angle", a));
    for (word, shape, place, more, held) in [
        ("Distance", "Vertex1", up, distance(40.0), (1, 1)),
        ("Distance", "Vertex1", HERE, distance(0.0), (3, 0)),
        ("Parallel", "Edge1", up, String::new(), (2, 0)),
        ("Angle", "Edge1", tilted, angle(30.0), (1, 1)),
        ("Angle", "Edge1", tilted, distance(30.0), (1, 1)),
        ("Angle", "Edge1", up, distance(0.0), (2, 0)),
        // Faces of unknown kind: taken as planes, and said.
        ("Distance", "Face1", up, distance(40.0), (3, 1)),
    ] {
        let [base, arm] = ["Base", "Arm"].map(|p| format!("{p}.{shape}"));
        let objects = assembled(
            "Assembly",
            &[
                part("Base", HERE),
                part("Arm", place),
                grounded("Base"),
                joint("J", word, [(&base, HERE), (&arm, HERE)], &more),
            ],
        );
        let i = read("x.FCStd", &fcstd(&objects), &Options::default());
        let found = (6 - figures(&i).0, i.report.approximated.len());
        assert_eq!(found, held, "{word} {shape}");
    }
}

/// A shape with a plane as its first face and a cylinder of 1.5 mm as its second.
const SHAPE: &str = "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 0\nPolygon3D 0\nPolygonOnTriangulations 0\nSurfaces 2\n1 0 0 0 0 0 1 1 0 0 0 1 0 \n2 0 0 0 0 0 1 1 0 0 0 1 0 1.5\nTriangulations 0\n\nTShapes 3\nFa\n0  1e-07 1 0\n\n0111000\n*\nFa\n0  1e-07 2 0\n\n0111000\n*\nSh\n\n0101100\n+3 0 -2 0 *\n\n+1 0 \n";

// A cylinder of 1.5 mm that lies 38.5 mm above a plane: its axis is 40 mm above it, whichever of the two is named first.
#[test]
fn kinds_of_faces_stand_in_the_shapes() {
    let lying = Place([0.0, 0.0, 40.0], 'y', 90.0);
    let standing = Place([0.0, 0.0, 40.0], 'x', 0.0);
    let shaped = |name: &str| {
        let mut o = part(name, HERE);
        o.2 += &property("Shape", "<Part file=\"S.brp\"/>");
        o
    };
    let one = |ends: [(&str, Place); 2], d: f64| {
        let objects = assembled(
            "Assembly",
            &[
                shaped("Base"),
                shaped("Arm"),
                grounded("Base"),
                joint("J", "Distance", ends, &number("Distance", d)),
            ],
        );
        let bytes = packed(&[
            ("Document.xml", document(&objects).as_bytes()),
            ("S.brp", SHAPE.as_bytes()),
        ]);
        let i = read("x.FCStd", &bytes, &Options::default());
        (6 - figures(&i).0, i.report.approximated.join("; "))
    };
    let (plane, lies) = (("Base.Face1", HERE), ("Arm.Face2", lying));
    assert_eq!(one([plane, lies], 38.5), (2, String::new()));
    assert_eq!(
        one([("Arm.Face2", lying), ("Base.Face1", HERE)], 38.5),
        (2, String::new())
    );
    // As far below it, on the side that the plane's normal points away from.
    let below = Place([0.0, 0.0, -40.0], 'y', 90.0);
    assert_eq!(one([plane, ("Arm.Face2", below)], 38.5), (2, String::new()));
    let (held, told) = one([plane, lies], 38.0);
    assert!(held == 2 && told.contains("0.5 mm apart"), "{told}");
    assert_eq!(
        one([plane, ("Arm.Face1", standing)], 40.0),
        (3, String::new())
    );
    assert_eq!(
        one([plane, ("Arm.Vertex1", standing)], 40.0),
        (1, String::new())
    );
    // Two cylinders 40 mm apart are parallel lines.
    let aside = Place([40.0, 0.0, 0.0], 'x', 0.0);
    let (held, told) = one([("Base.Face2", HERE), ("Arm.Face2", aside)], 37.0);
    assert!(held == 3 && !told.contains("apart"), "{told}");
}

#[test]
fn limits_are_said_to_be_left_out() {
    let mut bar = four_bar(HINGES);
    let a = bar.iter_mut().find(|o| o.0 == "A").unwrap();
    a.2 += &property("EnableAngleMin", "<Bool value=\"true\"/>");
    a.2 += &property("EnableAngleMax", "<Bool value=\"false\"/>");
    let i = read("x.FCStd", &fcstd(&bar), &Options::default());
    let notes = &i.report.approximated;
    assert_eq!(notes.len(), 1);
    assert!(
        notes[0].starts_with("joint \"A\": limits are omitted"),
        "{notes:?}"
    );
    assert_eq!(figures(&i), (1, 3));
}
