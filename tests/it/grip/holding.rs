//! Holding forces against closed forms, a polyhedral linear programme and plain statics.

use super::lever;
use crate::common::*;
use ozols::geom::vector::cross as cross3;
mod polyhedral;

use ozols::geom::vector::cross_plane as cross;
use ozols::grip::contact::{TouchingPose, Unholdable};
use ozols::grip::holding::{Holding, Spatial};

const COUPLINGS: [LeverDrive; 3] = [
    LeverDrive::Coupled,
    LeverDrive::Equal,
    LeverDrive::Independent,
];

fn pose() -> TouchingPose {
    Gripper::with_nominal(lever(0.1, 120.0, 30.0), 0.04)
        .touching_pose(0.04)
        .unwrap()
}

fn pull(force: Spatial) -> PartWrench {
    PartWrench {
        force,
        moment: [0.0; 3],
    }
}

fn held(pose: &TouchingPose, load: PartWrench, friction: f64, coupling: LeverDrive) -> Holding {
    match find_holding(pose, &load, friction, coupling).unwrap() {
        HoldingOutcome::Held(h) => h,
        HoldingOutcome::Slips(s) => panic!("slips: {s:?}"),
    }
}

/// Force of a contact in the gripper's axes.
fn force(pose: &TouchingPose, i: usize, f: &ContactForce) -> Spatial {
    let c = pose.contacts[i];
    [
        f.normal * c.normal[0] + f.along * c.tangent[0],
        f.normal * c.normal[1] + f.along * c.tangent[1],
        f.axial,
    ]
}

/// Equilibrium, friction and lever moments, from coordinates alone.
fn assert_statics(pose: &TouchingPose, load: &PartWrench, friction: f64, h: &Holding) {
    let size = load
        .force
        .iter()
        .chain(&load.moment)
        .map(|x| x.abs())
        .sum::<f64>()
        + h.drive / 0.1;
    let (mut sum, mut moment, mut levers) = (load.force, load.moment, [0.0; 2]);
    for (i, f) in h.forces.iter().enumerate() {
        assert!(f.normal >= 0.0);
        assert!(
            f.friction_force() <= friction * f.normal + 1e-6 * size,
            "{f:?}"
        );
        let (c, w) = (pose.contacts[i], force(pose, i, f));
        let from_centre = [
            c.point[0] - pose.centre[0],
            c.point[1] - pose.centre[1],
            0.0,
        ];
        let m = cross3(from_centre, w);
        (0..3).for_each(|a| {
            sum[a] += w[a];
            moment[a] += m[a];
        });
        let p = pose.pivots[c.lever];
        let opening = cross([c.point[0] - p[0], c.point[1] - p[1]], [-w[0], -w[1]]);
        levers[c.lever] += if c.lever == 0 { opening } else { -opening };
    }
    sum.iter().for_each(|x| near(*x, 0.0, 1e-6 * size));
    moment.iter().for_each(|x| near(*x, 0.0, 1e-7 * size));
    (0..2).for_each(|k| near(h.moments[k], levers[k], 1e-7 * size));
    assert!(
        h.lower_bound <= h.drive + 1e-7 * size && h.drive - h.lower_bound <= 1e-6 * size,
        "{h:?}"
    );
}

// The pose.

/// [Pavlenko & Godunko 2010]: the arms are those of the contact normals about the pivot, at any turn of the levers.
#[test]
fn arms_are_those_of_the_normals_in_every_pose() {
    for (prism, mounting) in [(120.0, 20.0), (120.0, 30.0), (90.0, 30.0), (100.0, 45.0)] {
        let l = lever(0.1, prism, mounting);
        let g = Gripper::with_nominal(l, 0.04);
        for d in [0.02, 0.03, 0.04, 0.05, 0.06] {
            let (pose, arms) = (g.touching_pose(d).unwrap(), l.force_arms(d));
            near(pose.turn, 0.0, if d == 0.04 { 1e-12 } else { 1.0 });
            for c in pose.contacts {
                let (p, v) = (pose.pivots[c.lever], pose.vertices[c.lever]);
                near((v[0] - p[0]).hypot(v[1] - p[1]), 0.1, 1e-15);
                // The contact is on the part's rim, its normal points at the centre, the face passes through the vertex.
                let face = l.face_distance(d);
                near(c.point[0] + d / 2.0 * c.normal[0], pose.centre[0], 1e-15);
                near(c.point[1] + d / 2.0 * c.normal[1], pose.centre[1], 1e-15);
                near(c.point[0] - face * c.tangent[0], v[0], 1e-15);
                near(c.point[1] - face * c.tangent[1], v[1], 1e-15);
                let arm = cross(
                    [c.point[0] - p[0], c.point[1] - p[1]],
                    [-c.normal[0], -c.normal[1]],
                );
                let stated = if c.far { arms.l1 } else { arms.l2 };
                near(if c.lever == 0 { arm } else { -arm }, stated, 1e-15);
            }
        }
    }
}

#[test]
fn parts_that_cannot_be_held_are_named() {
    let mut g = Gripper::with_nominal(lever(0.1, 120.0, 30.0), 0.04);
    g.face_length = Some(0.02);
    g.lever_width = 0.01;
    assert_eq!(g.find_obstacles(0.04), []);
    assert!(
        g.find_obstacles(0.08)
            .iter()
            .any(|o| matches!(o, Unholdable::OffFace { .. }))
    );
    assert!(matches!(
        g.find_obstacles(1.0)[..],
        [.., Unholdable::OffFace { .. }] | [Unholdable::OffFace { .. }, ..]
    ));
    g.lever_width = 0.06;
    assert!(matches!(
        g.find_obstacles(0.04)[..],
        [Unholdable::Crossed { .. }]
    ));
    // A long near face reaches over the axis before a thin part is touched.
    g.lever_width = 0.0;
    g.face_length = Some(0.06);
    assert!(
        g.find_obstacles(0.04)
            .iter()
            .any(|o| matches!(o, Unholdable::TipsMeet { .. }))
    );
    g.pivot = 0.2;
    assert!(matches!(
        g.find_obstacles(0.04)[..],
        [Unholdable::OutOfReach { .. }]
    ));
    // γ + α/2 small: the levers cross at the nominal diameter.
    let crossing = Gripper::with_nominal(lever(0.2, 120.0, 20.0), 0.04);
    assert!(crossing.pivot < 0.0);
    assert!(matches!(
        crossing.find_obstacles(0.04)[..],
        [Unholdable::Crossed { .. }]
    ));
}

// Closed forms.

/// Without friction, a pull in the plane is carried by two contacts whose forces follow from their directions alone; the
/// moments are then those forces times the arms l1 and l2 of [Pavlenko & Godunko 2010], which is the arms found by statics.
#[test]
fn statics_confirm_the_arms() {
    for (prism, mounting) in [(120.0, 20.0), (120.0, 30.0), (90.0, 30.0)] {
        let l = lever(0.1, prism, mounting);
        let pose = Gripper::with_nominal(l, 0.04).touching_pose(0.04).unwrap();
        let (arms, half) = (l.force_arms(0.04), f64::to_radians(prism / 2.0));
        for coupling in COUPLINGS {
            // Outwards: the far contacts of both levers. Inwards: the near ones.
            near(
                held(&pose, pull([10.0, 0.0, 0.0]), 0.0, coupling).drive,
                5.0 * arms.l1 / half.cos(),
                1e-7,
            );
            near(
                held(&pose, pull([-10.0, 0.0, 0.0]), 0.0, coupling).drive,
                5.0 * arms.l2 / half.cos(),
                1e-7,
            );
        }
        // Down: both contacts of the lower lever.
        let h = held(&pose, pull([0.0, -10.0, 0.0]), 0.0, LeverDrive::Coupled);
        let stated = 5.0 / half.sin() * (arms.l1 + arms.l2);
        near(h.moments[1], stated, 1e-7);
        near(h.moments[0], 0.0, 1e-7);
        near(h.drive, stated / 2.0, 1e-7);
        near(
            held(&pose, pull([0.0, -10.0, 0.0]), 0.0, LeverDrive::Independent).drive,
            stated,
            1e-7,
        );
    }
}

/// A pull along the part with l1 = l2 forced by no in-plane imbalance: with prism angles near 180° the four normals are
/// nearly parallel, and the least moment nears W/(4 μ) · (arms) per contact.
#[test]
fn symmetric_axial_pull_has_the_textbook_moment() {
    // α near 180° and γ so that the lever is at right angles to the bisector: both arms near L.
    let l = lever(0.1, 179.9, 0.05);
    let pose = Gripper::with_nominal(l, 0.04).touching_pose(0.04).unwrap();
    let h = held(&pose, pull([0.0, 0.0, -20.0]), 0.4, LeverDrive::Equal);
    // Each lever presses with W/(2μ) in all at the arm L.
    near(h.drive, 20.0 / (2.0 * 0.4) * 0.1, 20.0 / 0.8 * 0.1 * 5e-3);
}

// What cannot be held.

/// The slip a verdict rests on: the load works on it, and no force of any friction cone takes that work away.
#[test]
fn slips_are_certificates() {
    // Made for thin parts, these levers turn so far for thick ones that all four faces push out of the jaws.
    let g = Gripper::with_nominal(lever(0.1, 150.0, 80.0), 0.02);
    let mut slips = 0;
    let sizes = [0.02, 0.05, 0.1, 0.15, 0.2].into_iter();
    for (d, mu) in sizes.cartesian_product([0.0, 0.1]) {
        for f in [
            [3.0, 0.0, 0.0],
            [0.0, -3.0, 0.0],
            [0.0, 0.0, 3.0],
            [-3.0, 1.0, 1.0],
        ] {
            let Ok(pose) = g.touching_pose(d) else {
                continue;
            };
            let HoldingOutcome::Slips(s) =
                find_holding(&pose, &pull(f), mu, LeverDrive::Coupled).unwrap()
            else {
                // Nothing holds a part along its axis but friction.
                assert!(mu > 0.0 || f[2] == 0.0, "{d} {f:?}");
                continue;
            };
            slips += 1;
            assert!(
                (0..3).map(|a| f[a] * s.velocity[a]).sum::<f64>() > 0.0,
                "{s:?}"
            );
            for c in pose.contacts {
                let from_centre = [
                    (c.point[0] - pose.centre[0]) / 0.1,
                    (c.point[1] - pose.centre[1]) / 0.1,
                    0.0,
                ];
                let turning = cross3(s.rotation, from_centre);
                let v = [0, 1, 2].map(|a| s.velocity[a] + turning[a]);
                let dot = |d: [f64; 2]| d[0] * v[0] + d[1] * v[1];
                assert!(
                    dot(c.normal) >= mu * dot(c.tangent).hypot(v[2]) - 1e-6,
                    "{d} {f:?} {}",
                    c.name
                );
            }
        }
    }
    assert!(slips > 0);
}

#[test]
fn bad_numbers_are_refused() {
    for mu in [-0.1, f64::NAN, f64::INFINITY, 11.0] {
        assert!(find_holding(&pose(), &pull([1.0, 0.0, 0.0]), mu, LeverDrive::Equal).is_err());
    }
    assert!(find_holding(&pose(), &pull([f64::NAN, 0.0, 0.0]), 0.3, LeverDrive::Equal).is_err());
    let nothing = held(&pose(), pull([0.0; 3]), 0.0, LeverDrive::Equal);
    assert_eq!(nothing.drive, 0.0);
}
