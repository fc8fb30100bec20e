//! Joints of OndselSolver's files: what each leaves of the six freedoms of a part.

use super::{figures, read};
use crate::common::*;
use crate::robots::message_of;

/// A part off the origin and turned by 30 degrees about x, and one joint between the ground and it.
pub(crate) fn asmt(head: &str, kind: &str, figure: &str) -> String {
    let place = |tabs: &str, at: [f64; 3], degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        let [x, y, z] = at;
        format!(
            "{tabs}Position3D\n{tabs}\t{x}\t{y}\t{z}\t\n{tabs}RotationMatrix\n{tabs}\t1\t0\t0\t\n{tabs}\t0\t{c}\t{}\t\n{tabs}\t0\t{s}\t{c}\t\n",
            -s
        )
    };
    let marker = |tabs: &str, name: &str| {
        let outer = place(&format!("{tabs}\t\t"), [0.0; 3], 0.0);
        let inner = place(&format!("{tabs}\t\t\t\t"), [0.0; 3], 0.0);
        format!(
            "{tabs}RefPoints\n{tabs}\tRefPoint\n{outer}{tabs}\t\tMarkers\n{tabs}\t\t\tMarker\n{tabs}\t\t\t\tName\n{tabs}\t\t\t\t\t{name}\n{inner}"
        )
    };
    let figure = match figure.split_once(' ') {
        Some((label, value)) => format!("\t\t\t\t{label}\n\t\t\t\t\t{value}\n"),
        None => String::new(),
    };
    format!(
        "{head}\nAssembly\n\tName\n\t\tA/B\n{}{}\tParts\n\t\tPart\n\t\t\tName\n\t\t\t\tArm #1\n{}{}\tConstraintSets\n\t\tJoints\n\t\t\t{kind}Joint\n\t\t\t\tName\n\t\t\t\t\tJ\n\t\t\t\tMarkerI\n\t\t\t\t\t/A/B/M\n\t\t\t\tMarkerJ\n\t\t\t\t\t/A/B/Arm #1/N\n{figure}\t\tMotions\n\tTimeSeries\n\tthis is not read\n",
        place("\t", [0.0; 3], 0.0),
        marker("\t", "M"),
        place("\t\t\t", [3.0, 4.0, 5.0], 30.0),
        marker("\t\t\t", "N"),
    )
}

// Constraints of each by the definition of its equations: 3 for points that meet, and one for each cosine or distance.
#[test]
fn each_joint_leaves_six_less_its_constraints() {
    for (kind, figure, constraints) in [
        ("Revolute", "", 5),
        ("Translational", "", 5),
        ("Cylindrical", "", 4),
        ("Spherical", "", 3),
        ("Universal", "", 4),
        ("ConstantVelocity", "", 4),
        ("Planar", "offset 5", 3),
        ("Planar", "", 3),
        ("LineInPlane", "", 2),
        ("PointInPlane", "offset 5", 1),
        ("InPlane", "offset 5", 1),
        ("LineInPlane", "offset 5", 2),
        ("PointInLine", "", 2),
        ("InLine", "", 2),
        ("ParallelAxes", "", 2),
        ("NoRotation", "", 3),
        ("Perpendicular", "", 1),
        ("Angle", "theIzJz 0.5235987755982988", 1),
        ("SphSph", "distanceIJ 7.0710678118654755", 1),
        ("SphSph", "distanceIJ 0", 3),
        ("CylSph", "distanceIJ 5", 1),
        ("CylSph", "distanceIJ 0", 2),
        ("RevCyl", "distanceIJ 5", 3),
        ("RevCyl", "distanceIJ 0", 4),
        ("RevRev", "distanceIJ 5", 4),
        ("RevRev", "distanceIJ 0", 5),
    ] {
        for ends in ["\n", "\r\n"] {
            let text = asmt("OndselSolver", kind, figure).replace('\n', ends);
            let i = read("x.asmt", text.as_bytes(), &Options::default());
            assert_eq!(figures(&i), (6 - constraints, 0), "{kind} {figure}");
            assert_eq!(i.mechanism.length_unit.symbol, "mm");
            let freedoms = i64::try_from(6 - constraints).unwrap();
            assert_eq!(i.report.cad_freedoms, Some(freedoms), "{kind}");
        }
    }
    let old = asmt(
        "freeCAD: 3D CAD with Motion Simulation  by  askoh.com",
        "Planar",
        "offset 5",
    );
    let i = read("x.asmt", old.as_bytes(), &Options::default());
    assert_eq!(i.mechanism.length_unit.symbol, "m");
}

#[test]
fn a_type_that_is_not_known_is_named_with_those_that_are() {
    let text = asmt("OndselSolver", "Wobbly", "");
    let said = message_of("x.asmt", text.as_bytes());
    has(&said, "\"Wobbly\"");
    has(&said, "Cylindrical");
    let text = asmt("OndselSolver", "CylSph", "");
    let said = message_of("x.asmt", text.as_bytes());
    has(&said, "has no distanceIJ");
}
