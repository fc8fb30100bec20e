//! A rigid body against the point masses it may be made of: each a link of its own, fixed to the body, so that no tensor of
//! inertia and no ω × I ω is in what is compared with.

use super::{built_in, expr, vector};
use crate::common::*;
use crate::reactions::{effort, greatest_force};
use ozols::model::mechanism::{Joint, Link};
use ozols::statics::reactions::{Contacts, Cycle, solve_cycle};

/// Masses `[kg]` at points in the file's unit.
type Points = Vec<(f64, [f64; 3])>;

/// Some point masses about the joints of each link that moves.
fn points(m: &Mechanism, seed: &[f64]) -> Vec<(LinkId, Points)> {
    let mut next = seed.iter().copied().cycle();
    let mut draw = || next.next().unwrap();
    let moving = m.link_ids().filter(|&l| m.links[l].role != Role::Frame);
    moving
        .map(|l| {
            let at = m.joints.iter().find(|j| j.links.contains(&l)).unwrap();
            let near = to_vector(&at.frame.point);
            let point = |_| (0.1 + draw(), near.map(|x| x + 60.0 * draw() - 30.0));
            (l, (0..4).map(point).collect())
        })
        .collect()
}

/// Mass, centre and tensor of point masses, by their sums.
fn together(points: &Points, metres: f64) -> MassProperties {
    let mass: f64 = points.iter().map(|(m, _)| m).sum();
    let centre = [0, 1, 2].map(|i| points.iter().map(|(m, p)| m * p[i]).sum::<f64>() / mass);
    let mut t = [[0.0; 3]; 3];
    for (m, p) in points {
        let r = [0, 1, 2].map(|i| (p[i] - centre[i]) * metres);
        let square: f64 = r.iter().map(|x| x * x).sum();
        for i in 0..3 {
            for k in 0..3 {
                t[i][k] += m * (if i == k { square } else { 0.0 } - r[i] * r[k]);
            }
        }
    }
    MassProperties {
        mass,
        centre: vector(centre),
        inertia: Some(Inertia::Tensor([
            t[0][0], t[1][1], t[2][2], t[0][1], t[1][2], t[2][0],
        ])),
    }
}

/// The mechanism with rigid bodies, and with the points they are made of.
fn both(name: &str, seed: &[f64], speed: f64) -> [Mechanism; 2] {
    let mut whole = built_in(name);
    whole.edit().loads.gravity = Some(vector([1.0, -9.81, 2.0]));
    whole.edit().loads.drive_speeds = vec![speed];
    let mut parts = whole.clone();
    for (l, points) in points(&whole, seed) {
        whole.edit().links[l].mass = Some(together(&points, whole.length_unit.metres));
        let at = parts.joints.iter().find(|j| j.links.contains(&l)).unwrap();
        let frame = at.frame.clone();
        for (i, (mass, p)) in points.iter().enumerate() {
            let id = format!("{}~{i}", parts.links[l].id);
            let new = LinkId::new(parts.links.len());
            parts.edit().links.push(Link {
                id: id.clone(),
                role: Role::Inner,
                mass: Some(MassProperties {
                    mass: *mass,
                    centre: vector(*p),
                    inertia: None,
                }),
            });
            parts.edit().joints.push(Joint {
                id,
                links: [l, new],
                joint_type: JointType::Fixed,
                frame: frame.clone(),
                drive: false,
                drive_freedom: None,
                states: None,
                options: Vec::new(),
                unloading: Vec::new(),
            });
        }
    }
    [whole, parts]
}

fn solved(c: &Cycle) -> impl Iterator<Item = (f64, &Solution)> {
    c.positions.iter().map(|(at, s)| (*at, s.as_ref().unwrap()))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 12, ..Default::default() })]

    #[test]
    fn a_rigid_body_is_its_points(
        which in 0..2usize, seed in prop::collection::vec(0.0..1.0f64, 37), speed in 2.0..9.0f64,
    ) {
        let name = ["rsur", "slider-crank-determinate"][which];
        let [whole, parts] = both(name, &seed, speed);
        let stroke = Some(Stroke { from: 0.0, to: 0.4, steps: 2 });
        let [a, b] = [&whole, &parts].map(|m| solve_cycle(m, StateId::FREE, stroke, Contacts::AsJoints).unwrap());
        prop_assert_eq!(a.positions.len(), 3);
        for ((_, x), (_, y)) in solved(&a).zip(solved(&b)) {
            prop_assert_eq!((x.choice, y.choice), (Uniqueness::Unique, Uniqueness::Unique));
            let greatest = greatest_force(&x.reactions);
            for (r, s) in x.reactions.iter().zip(&y.reactions) {
                prop_assert_eq!(r.joint, s.joint);
                for i in 0..3 {
                    prop_assert!((r.global_force()[i] - s.global_force()[i]).abs() < 1e-6 * greatest, "{r:?} {s:?}");
                    let arm = greatest * x.size;
                    prop_assert!((r.global_moment()[i] - s.global_moment()[i]).abs() < 1e-6 * arm, "{r:?} {s:?}");
                }
                prop_assert_eq!(r.effort.map(|e| e.0), s.effort.map(|e| e.0));
            }
        }
    }

}

/// A force over part of a turn acts there in every turn, in space as in the plane.
#[test]
fn forces_come_again_in_each_turn_in_space() {
    let mut m = built_in("slider-crank-determinate");
    let slider = m.link_named("3").unwrap();
    let guide = m.joint_named("3-0").unwrap();
    let point = m.joints[guide].frame.point.clone();
    m.edit().loads.forces.push(ExternalForce {
        states: None,
        link: slider,
        point,
        force: [-100.0, 0.0, 0.0].map(expr),
        range: Some([0.3, 0.8]),
    });
    let turn = TAU;
    let stroke = |from: f64| {
        Some(Stroke {
            from,
            to: from + 1.0,
            steps: 4,
        })
    };
    let efforts = |from| -> Vec<f64> {
        let found = solve_cycle(&m, StateId::FREE, stroke(from), Contacts::AsJoints).unwrap();
        solved(&found).map(|(_, s)| effort(&s.reactions)).collect()
    };
    // At 0, 0.25, 0.5, 0.75 and 1 rad, and again a turn later and a turn before.
    let first = efforts(0.0);
    let acts: Vec<bool> = first.iter().map(|x| x.abs() > 0.1).collect();
    assert_eq!(acts, [false, false, true, true, false], "{first:?}");
    // Half a turn on, nothing acts.
    assert!(efforts(turn / 2.0).iter().all(|x| x.abs() < 1e-6));
    for from in [turn, -turn] {
        for (x, y) in first.iter().zip(efforts(from)) {
            assert!((x - y).abs() < 1e-6, "{first:?} {:?}", efforts(from));
        }
    }
}
