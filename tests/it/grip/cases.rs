//! Cases of a load against every direction tried one by one, and obstacles against points of the levers.

use super::{SMALL, lever};
use crate::common::*;
use ozols::file::read::workload::grip_from_bytes;
use ozols::grip::arm_curves::{Varied, arm_curve};
use ozols::grip::clamping::{DiameterRow, study_diameters};
use ozols::grip::contact::Unholdable;
use ozols::model::grip::GripSpec;

fn spec(more: &str) -> GripSpec {
    let text = replace_once(SMALL, "friction = 0\n", "friction = 0.4\n");
    let text = replace_once(&text, "gravity = [-10, 0, 0]\n", "");
    grip_from_bytes("clamp.toml", format!("{text}{more}").as_bytes())
        .unwrap()
        .spec
}

fn only(spec: &GripSpec) -> DiameterRow {
    study_diameters(spec).unwrap().rows.remove(0)
}

/// The drive moment that a pull on the mass takes.
fn takes(row: &DiameterRow, pull: [f64; 3], load: (f64, [f64; 3], f64)) -> f64 {
    let (mass, centre, safety) = load;
    let force = pull.map(|x| mass * x * safety);
    let moment = cross(centre, force);
    let load = PartWrench { force, moment };
    match find_holding(row.pose.as_ref().unwrap(), &load, 0.4, LeverDrive::Coupled).unwrap() {
        HoldingOutcome::Held(h) => h.drive,
        HoldingOutcome::Slips(s) => panic!("{s:?}"),
    }
}

/// Directions all over a sphere.
fn sphere() -> impl Iterator<Item = [f64; 3]> {
    (0..900u32).map(|i| {
        let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / 900.0;
        let turn = f64::from(i) * 2.399_963_229_728_653;
        let r = (1.0 - z * z).sqrt();
        unit([r * turn.cos(), r * turn.sin(), z])
    })
}

/// Gravity less acceleration, times mass and safety, at the mass centre: whichever of the two has any direction, or both.
#[test]
fn the_hardest_case_is_the_worst_of_all_directions() {
    let g = 9.80665;
    type Pull = Box<dyn Fn([f64; 3]) -> [f64; 3]>;
    let cases: [(&str, Pull); 5] = [
        (
            "gravity = \"any\"\naccelerations = [[6, 0, 0]]\n",
            Box::new(move |u| [g * u[0] - 6.0, g * u[1], g * u[2]]),
        ),
        (
            "gravity = \"any\"\naccelerations = [[-6, 3, 0]]\n",
            Box::new(move |u| [g * u[0] + 6.0, g * u[1] - 3.0, g * u[2]]),
        ),
        (
            "gravity = [0, 0, -9.80665]\nany_acceleration = 7\n",
            Box::new(move |u| [7.0 * u[0], 7.0 * u[1], 7.0 * u[2] - g]),
        ),
        (
            "gravity = \"any\"\nany_acceleration = 7\n",
            Box::new(move |u| u.map(|x| (g + 7.0) * x)),
        ),
        (
            "gravity = [0, 0, -9.80665]\naccelerations = [[2, -1, 4]]\n",
            Box::new(move |_| [-2.0, 1.0, -g - 4.0]),
        ),
    ];
    for (file, pull) in cases {
        let more = "centre_of_mass = [3, -5, 20]\nsafety = 1.7\n";
        let row = only(&spec(&format!("{file}{more}")));
        let hardest = row.hardest.as_ref().unwrap();
        let Ok(HoldingOutcome::Held(found)) = &hardest.verdict else {
            panic!("{:?}", hardest.verdict)
        };
        let load = (2.0, [0.003, -0.005, 0.02], 1.7);
        let worst = sphere()
            .map(|u| takes(&row, pull(u), load))
            .fold(0.0, f64::max);
        assert!(
            found.drive >= worst * (1.0 - 1e-6) && found.drive <= worst * 1.01,
            "{file}: {} {worst}",
            found.drive
        );
        assert!((takes(&row, hardest.pull, load) / found.drive - 1.0).abs() < 1e-6);
    }
}

/// A solid cylinder by its density.
#[test]
fn parts_weigh_what_their_cylinder_does() {
    let text = replace_once(SMALL, "mass = 2", "density = 7850\npart_length = 120");
    let spec = grip_from_bytes("clamp.toml", text.as_bytes()).unwrap().spec;
    // π r² l ρ for r = 20 mm and l = 120 mm.
    let mass = PI * 0.02 * 0.02 * 0.12 * 7850.0;
    assert!((only(&spec).mass - mass).abs() < 1e-12);
    let of_two = GripSpec {
        diameters: vec![0.02, 0.04],
        ..spec
    };
    let rows = study_diameters(&of_two).unwrap().rows;
    assert!((rows[0].mass - mass / 4.0).abs() < 1e-12 && (rows[1].mass - mass).abs() < 1e-12);
}

/// Curves over an angle go as far as the file's own value, where that lies beyond the usual ones.
#[test]
fn curves_reach_the_files_own_angle() {
    let own = |degrees: [f64; 2]| GripSpec {
        prism_angle: degrees[0].to_radians(),
        mounting_angle: degrees[1].to_radians(),
        ..spec("")
    };
    for (degrees, prism, mounting) in [
        ([150.0, 10.0], [60.0, 150.0], [0.0, 40.0]),
        ([50.0, 55.0], [50.0, 140.0], [0.0, 55.0]),
    ] {
        for (varied, wanted) in [
            (Varied::PrismAngle, prism),
            (Varied::MountingAngle, mounting),
        ] {
            let curve = arm_curve(&own(degrees), varied, 0.04);
            let ends = [curve[0].0, curve[curve.len() - 1].0].map(f64::to_degrees);
            assert!(
                (ends[0] - wanted[0]).abs() < 1e-9 && (ends[1] - wanted[1]).abs() < 1e-9,
                "{ends:?}"
            );
        }
    }
}

/// The least of y over many points of a segment.
fn lowest(a: [f64; 2], b: [f64; 2]) -> f64 {
    (0..=1000)
        .map(|i| a[1] + (b[1] - a[1]) * f64::from(i) / 1000.0)
        .fold(f64::INFINITY, f64::min)
}

proptest! {
    /// Each obstacle by what it is: the part over a pivot, a lever's strip over the axis, a tip of a face over the axis.
    #[test]
    fn obstacles_are_what_points_of_the_levers_say(
        alpha in 60.0..150.0f64, gamma in 0.0..70.0f64, d in 0.01..0.12f64, pivot in -0.06..0.12f64,
        face in 0.01..0.09f64, width in 0.0..0.06f64,
    ) {
        let l = lever(0.1, alpha, gamma);
        let gripper = Gripper { lever: l, pivot, face_length: Some(face), lever_width: width, may_cross: false };
        let Ok(pose) = gripper.touching_pose(d) else { return Ok(()) };
        let said = gripper.find_obstacles(d);
        let says = |of: fn(&Unholdable) -> bool| said.iter().any(of);
        let (p, v) = (pose.pivots[0], pose.vertices[0]);
        // A strip about the line from pivot to vertex, of the width measured across the axis.
        let strip = lowest(p, v) - width / 2.0;
        prop_assume!(strip.abs() > 1e-9);
        prop_assert_eq!(says(|o| matches!(o, Unholdable::Crossed { .. })), strip < 0.0);
        let tip = |k: usize| v[1] + face * pose.contacts[k].tangent[1];
        let tips = lowest(v, [0.0, tip(0)]).min(lowest(v, [0.0, tip(1)]));
        // Where the vertex itself is beyond the axis, so is the lever.
        if v[1] > 0.0 {
            prop_assert_eq!(says(|o| matches!(o, Unholdable::TipsMeet { .. })), tips < 0.0);
        }
        let reach = (pose.centre[0] - p[0]).hypot(pose.centre[1] - p[1]);
        prop_assert_eq!(says(|o| matches!(o, Unholdable::PivotInPart { .. })), reach <= d / 2.0);
        let touches = pose.contacts[0].point;
        let along = (touches[0] - v[0]).hypot(touches[1] - v[1]);
        prop_assume!((along - face).abs() > 1e-9);
        prop_assert_eq!(says(|o| matches!(o, Unholdable::OffFace { .. })), along > face);
    }
}
