//! A rigid body against the point masses it may be made of: each a link of its own, fixed to the body, so that no tensor of
//! inertia and no ω × I ω is in what is compared with.

use super::{built_in, expr, vector};
use crate::common::*;
use crate::reactions::greatest_force;
use ozols::model::mechanism::{Joint, Link};
use ozols::statics::reactions::cycle::{Cycle, solve_cycle};

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
        let [a, b] = [&whole, &parts].map(|m| solve_cycle(m, StateId::FREE, stroke).unwrap());
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

    /// The planar solver takes the tensor's part about its normal, wherever that points.
    #[test]
    fn a_plane_that_leans_takes_the_tensor_along(seed in prop::collection::vec(0.0..1.0f64, 37), speed in 2.0..9.0f64) {
        let [mut upright, _] = both("slider-crank-determinate", &seed, speed);
        for j in &mut upright.edit().joints {
            // In the plane, the rod's ends are hinges.
            if matches!(j.joint_type, JointType::Cylindrical | JointType::Spherical) {
                j.joint_type = JointType::Revolute;
                j.frame.axis = vector([0.0, 0.0, 1.0]);
                j.frame.reference = vector([1.0, 0.0, 0.0]);
            }
        }
        for l in &mut upright.edit().links {
            if let Some(mass) = &mut l.mass {
                mass.centre[2] = Expr::from(0);
            }
        }
        upright.edit().loads.gravity = None;
        for l in &upright.links {
            prop_assert!(l.mass.iter().all(|m| matches!(m.inertia, Some(Inertia::Tensor(_)))));
        }
        let leans = turned_and_moved(&upright, [0.0; 3]);
        let stroke = Some(Stroke { from: 0.0, to: 1.0, steps: 4 });
        let efforts = |m: &Mechanism| -> Vec<f64> {
            let found = planar_statics(m, StateId::FREE, stroke).unwrap();
            let of = |x: &ozols::statics::cycle::Moment| x.reactions.iter().find_map(|r| r.effort).unwrap();
            found.moments.iter().map(of).collect()
        };
        let (a, b) = (efforts(&upright), efforts(&leans));
        let greatest = a.iter().fold(0.0, |g: f64, x| g.max(x.abs()));
        prop_assert!(greatest > 0.0 && a.len() == 5);
        for (x, y) in a.iter().zip(&b) {
            prop_assert!((x - y).abs() < 1e-6 * greatest, "{a:?} {b:?}");
        }
    }
}

/// A dumb-bell of two masses that turns askew about its bearing: each needs m ω² a towards the axis, at heights b and -b, so
/// that the bearing bears the couple 2 m ω² a b and no force.
#[test]
fn a_dumb_bell_that_leans_tugs_at_its_bearing() {
    let (mass, a, b, speed) = (0.7, 0.3, 0.2, 6.0);
    let product = -2.0 * mass * a * b;
    let square = 2.0 * mass;
    let inertia = [
        square * b * b,
        square * (a * a + b * b),
        square * a * a,
        0.0,
        0.0,
        product,
    ];
    let role = "role = \"output\"\n";
    let heavy = format!(
        "{role}mass = {}\ncentre = [0, 0, 0]\ninertia = {inertia:?}\n",
        2.0 * mass
    );
    let text = write_mechanism(
        "name = \"dumb-bell\"",
        "0 1*",
        "A | 0 1 | revolute | 0, 0, 0 | 0, 0, 1 | drive = true",
    );
    let text = replace_once(&text, role, &heavy) + &format!("[workload]\ndrive_speed = {speed}\n");
    let m = read(&text);
    let found = solve_cycle(&m, StateId::FREE, None).unwrap();
    let reaction = &solved(&found).next().unwrap().1.reactions[0];
    // r × F of both about y: z·Fx, with Fx = -m ω² a at z = b and the other way at -b.
    let couple = -2.0 * mass * speed * speed * a * b;
    let [x, y, z] = reaction.global_moment();
    assert!((y - couple).abs() < 1e-9 && x.abs() < 1e-9 && z.abs() < 1e-9);
    assert!(reaction.force_size() < 1e-9);
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
        let found = solve_cycle(&m, StateId::FREE, stroke(from)).unwrap();
        let of = |s: &Solution| s.reactions.iter().find_map(|r| r.effort).unwrap().1;
        solved(&found).map(|(_, s)| of(s)).collect()
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
