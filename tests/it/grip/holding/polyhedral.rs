//! A polyhedral linear programme brackets the holding force.

use super::{COUPLINGS, assert_statics, cross3, force, held, lever, pose, pull};
use crate::common::*;
use microlp::{ComparisonOp, OptimizationDirection, Problem};
use ozols::geom::vector::cross_plane as cross;
use ozols::grip::contact::TouchingPose;
use ozols::grip::holding::Spatial;

/// Drive moment with each friction cone replaced by `facets` edges on it (too few forces, so too much moment), or by edges
/// outside it (`outer`); `None` where it cannot be held.
fn polyhedral(
    pose: &TouchingPose,
    load: &PartWrench,
    friction: f64,
    coupling: LeverDrive,
    facets: usize,
    outer: bool,
) -> Option<f64> {
    let mu = if outer {
        friction / (TAU / 2.0 / facets as f64).cos()
    } else {
        friction
    };
    let mut lp = Problem::new(OptimizationDirection::Minimize);
    let t = lp.add_var(1.0, (0.0, f64::INFINITY));
    let moments = [0, 1].map(|_| {
        lp.add_var(
            0.0,
            (
                if coupling == LeverDrive::Independent {
                    0.0
                } else {
                    f64::NEG_INFINITY
                },
                f64::INFINITY,
            ),
        )
    });
    let mut balance: [Vec<(microlp::Variable, f64)>; 6] = Default::default();
    let mut levers = [vec![(moments[0], -1.0)], vec![(moments[1], -1.0)]];
    for (i, c) in pose.contacts.iter().enumerate() {
        for e in 0..facets {
            let (s, co) = (TAU * e as f64 / facets as f64).sin_cos();
            let w = force(
                pose,
                i,
                &ContactForce {
                    normal: 1.0,
                    along: mu * co,
                    axial: mu * s,
                },
            );
            let x = lp.add_var(0.0, (0.0, f64::INFINITY));
            let m = cross3(
                [
                    c.point[0] - pose.centre[0],
                    c.point[1] - pose.centre[1],
                    0.0,
                ],
                w,
            );
            (0..3).for_each(|a| {
                balance[a].push((x, w[a]));
                balance[a + 3].push((x, m[a]));
            });
            let p = pose.pivots[c.lever];
            let opening = cross([c.point[0] - p[0], c.point[1] - p[1]], [-w[0], -w[1]]);
            levers[c.lever].push((x, if c.lever == 0 { opening } else { -opening }));
        }
    }
    for a in 0..3 {
        lp.add_constraint(balance[a].as_slice(), ComparisonOp::Eq, -load.force[a]);
        lp.add_constraint(balance[a + 3].as_slice(), ComparisonOp::Eq, -load.moment[a]);
    }
    levers.iter().for_each(|l| {
        lp.add_constraint(l.as_slice(), ComparisonOp::Eq, 0.0);
    });
    match coupling {
        LeverDrive::Coupled => {
            lp.add_constraint(
                [(t, 2.0), (moments[0], -1.0), (moments[1], -1.0)],
                ComparisonOp::Ge,
                0.0,
            );
        }
        LeverDrive::Equal => moments.iter().for_each(|m| {
            lp.add_constraint([(t, 1.0), (*m, -1.0)], ComparisonOp::Eq, 0.0);
        }),
        LeverDrive::Independent => moments.iter().for_each(|m| {
            lp.add_constraint([(t, 1.0), (*m, -1.0)], ComparisonOp::Ge, 0.0);
        }),
    }
    Some(lp.solve().ok()?.solution()?.objective())
}

fn direction() -> impl Strategy<Value = Spatial> {
    [-1.0..1.0f64, -1.0..1.0, -1.0..1.0]
        .prop_filter("not zero", |v| v.iter().map(|x| x * x).sum::<f64>() > 0.01)
}

pub(super) fn coupling() -> impl Strategy<Value = LeverDrive> {
    prop::sample::select(COUPLINGS.to_vec())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// A linear programme by another solver, with friction cones from inside and from outside, brackets the answer.
    #[test]
    fn polyhedral_programmes_bracket_the_answer(
        f in direction(), m in direction(), mu in 0.1..1.0f64, d in 0.03..0.05f64, by in coupling(),
    ) {
        let pose = Gripper::with_nominal(lever(0.1, 120.0, 30.0), 0.04).touching_pose(d).unwrap();
        let load = PartWrench { force: f.map(|x| 10.0 * x), moment: m.map(|x| 0.05 * x) };
        let (inner, outer) = (
            polyhedral(&pose, &load, mu, by, 24, false),
            polyhedral(&pose, &load, mu, by, 24, true),
        );
        match find_holding(&pose, &load, mu, by).unwrap() {
            HoldingOutcome::Held(h) => {
                assert_statics(&pose, &load, mu, &h);
                if let Some(most) = inner {
                    prop_assert!(h.drive <= most * (1.0 + 1e-6) + 1e-9, "{} above {most}", h.drive);
                }
                let least = outer.unwrap();
                prop_assert!(h.drive >= least * (1.0 - 1e-6) - 1e-9, "{} below {least}", h.drive);
                if let Some(most) = inner {
                    prop_assert!(most <= least * 1.2 + 1e-6, "the bracket is tight: {least} {most}");
                }
            }
            HoldingOutcome::Slips(_) => prop_assert!(inner.is_none()),
        }
    }

    /// Twice the load takes twice the moment; so does twice the size of everything.
    #[test]
    fn moment_scales_with_load_and_size(f in direction(), mu in 0.1..1.0f64, s in 0.01..100.0f64, by in coupling()) {
        let once = held(&pose(), pull(f), mu, by).drive;
        let more = held(&pose(), pull(f.map(|x| s * x)), mu, by).drive;
        prop_assert!((more - s * once).abs() <= 1e-7 * s, "{more} {once}");
        let large = Gripper::with_nominal(lever(0.1 * s, 120.0, 30.0), 0.04 * s).touching_pose(0.04 * s).unwrap();
        let large = held(&large, pull(f), mu, by).drive;
        prop_assert!((large - s * once).abs() <= 1e-7 * s, "{large} {once}");
    }

    /// Mirrored in the axis of symmetry or in the plane of motion, the load takes the same moment; opposite axial pulls too.
    #[test]
    fn mirror_images_take_the_same_moment(f in direction(), mu in 0.1..1.0f64, by in coupling()) {
        let once = held(&pose(), pull(f), mu, by);
        let upside_down = held(&pose(), pull([f[0], -f[1], f[2]]), mu, by);
        let other_way = held(&pose(), pull([f[0], f[1], -f[2]]), mu, by);
        prop_assert!((once.drive - upside_down.drive).abs() <= 1e-7);
        prop_assert!((once.drive - other_way.drive).abs() <= 1e-7);
    }

    /// More friction never takes more moment.
    #[test]
    fn friction_helps(f in direction(), mu in 0.1..0.9f64, by in coupling()) {
        let (less, more) = (held(&pose(), pull(f), mu, by), held(&pose(), pull(f), mu + 0.1, by));
        prop_assert!(more.drive <= less.drive + 1e-7);
    }

    /// Grippers of all sizes and shapes, under loads over eight decades, always get an answer, and its forces balance the load.
    #[test]
    fn every_gripper_gets_an_answer(
        size in -3.0..1.0f64, prism in 20.0..175.0f64, mounting in 0.0..100.0f64, part in -2.0..0.0f64, other in 0.5..1.5f64,
        f in direction(), m in direction(), decade in -4.0..4.0f64, friction in prop::option::of(-2.5..1.0f64), by in coupling(),
    ) {
        let l = lever(10f64.powf(size), prism, mounting);
        let d = l.length * 10f64.powf(part);
        let g = Gripper { may_cross: true, ..Gripper::with_nominal(l, d) };
        let pose = g.touching_pose(d * other);
        if let (Ok(pose), true) = (pose, g.find_obstacles(d * other).is_empty()) {
            let strength = 10f64.powf(decade);
            let load = PartWrench { force: f.map(|x| x * strength), moment: m.map(|x| x * strength * l.length) };
            let mu = friction.map_or(0.0, |e| 10f64.powf(e));
            let outcome = find_holding(&pose, &load, mu, by);
            prop_assert!(outcome.is_ok(), "{outcome:?}");
            if let Ok(HoldingOutcome::Held(h)) = outcome {
                let mut sum = load.force;
                for (i, c) in h.forces.iter().enumerate() {
                    let w = force(&pose, i, c);
                    (0..3).for_each(|a| sum[a] += w[a]);
                }
                let most = strength + h.forces.iter().map(|c| c.normal).sum::<f64>();
                sum.iter().for_each(|x| near(*x, 0.0, 1e-6 * most));
                near(h.drive, h.lower_bound, 1e-4 * (h.drive + strength * l.length));
            }
        }
    }
}
