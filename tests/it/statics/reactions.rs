//! Loads and reactions: the methods agree, and with energy.

use super::{J, Mass, joints_of, planar_file_with, shears_text, sliding_joint, turning_joint};
use crate::common::*;
use ozols::statics::contour_group::ContourGroup;
use ozols::statics::contour_group::pose::{GroupPose, GroupReactions};
use ozols::statics::cycle::{Moment, Statics};
use ozols::statics::kinetostatics::{LoadSource, Reaction};
use ozols::statics::planar::{BodyId, PairId};
use ozols::statics::pose::{Linkage, cross, dot, minus};

fn over(text: &str, from: f64, to: f64, steps: usize) -> Statics {
    planar_statics(&read(text), StateId::FREE, Some(Stroke { from, to, steps })).unwrap()
}

fn shears_cycle() -> Statics {
    over(shears_text(), 0.0, TAU, 72)
}

/// Greatest force or moment by size left over on any body, about a point far from all, over the greatest load.
fn left_over(s: &Statics, m: &Moment) -> f64 {
    let about = [3.0, -2.0];
    let (mut worst, mut greatest) = (0.0f64, 0.0f64);
    for body in (0..s.linkage.mechanism.bodies.len()).filter(|&b| b != s.linkage.mechanism.frame) {
        let mut sum = [0.0; 3];
        for l in m.loads.iter().filter(|l| l.body == body) {
            let all = [
                l.force[0],
                l.force[1],
                l.moment + cross(minus(l.point, about), l.force),
            ];
            (0..3).for_each(|c| sum[c] += all[c]);
        }
        for r in &m.reactions {
            let all = r.wrench_on(&s.linkage, body, about);
            greatest = all.iter().fold(greatest, |g, c| g.max(c.abs()));
            (0..3).for_each(|c| sum[c] += all[c]);
        }
        worst = sum.iter().fold(worst, |w, c| w.max(c.abs()));
    }
    worst / greatest
}

/// The reactions of a group out of the equilibrium of all bodies.
fn from_equilibrium(
    linkage: &Linkage,
    g: &ContourGroup,
    pose: &GroupPose,
    reactions: &[Reaction],
) -> Option<GroupReactions> {
    let on = |pair: PairId, body: BodyId| {
        let r = reactions.iter().find(|r| r.pair == pair)?;
        Some(r.wrench_on(linkage, body, pose.d))
    };
    let force = |pair, body| on(pair, body).map(|[x, y, _]| [x, y]);
    let [gx, gy, guide_moment] = on(g.guide, g.slider)?;
    let guide = dot([gx, gy], pose.guide_normal());
    Some(GroupReactions {
        d: force(g.d, g.ternary)?,
        f: force(g.f, g.rods[0])?,
        k: force(g.k, g.rods[1])?,
        m: force(g.m, g.rods[0])?,
        l: force(g.l, g.rods[1])?,
        guide,
        guide_moment,
        arm: guide_moment / guide,
    })
}

#[test]
fn three_methods_agree_on_the_shears_to_nine_digits() {
    let s = shears_cycle();
    assert!(s.dead.is_none());
    assert_eq!(s.contour_groups.len(), 2);
    let mut cutting = 0;
    for m in &s.moments {
        assert!(left_over(&s, m) < 1e-12);
        assert!(m.worth.residual < 1e-12);
        assert_eq!(m.by_groups.len(), s.decomposition.groups.len() + 1);
        assert!(m.by_groups.iter().all(|w| w.residual < 1e-9));
        cutting += usize::from(m.loads.iter().any(|l| l.source == LoadSource::External));
        for (g, (_, letters)) in m.groups.iter().zip(&s.contour_groups) {
            let (lu, worth) = g.equilibrium.unwrap();
            let exact = super::stability::exact::solve_exactly(&g.pose).unwrap();
            let out_of_whole =
                from_equilibrium(&s.linkage, letters, &g.pose, &m.reactions).unwrap();
            for (name, found) in [
                ("δ", g.delta),
                ("projective", g.projective),
                ("LU", lu),
                ("whole", out_of_whole),
            ] {
                let away = found.distance_to(&exact, &g.pose);
                assert!(away < 1e-9, "{name} {away} at {}", m.drive);
                assert!(
                    (found.arm - exact.arm).abs() < 1e-9 * (1.0 + exact.arm.abs()),
                    "{name}"
                );
            }
            assert!(worth.condition < 1e4, "{}", worth.condition);
        }
    }
    assert!(
        cutting > 5,
        "the cutting force acts on part of the cycle: {cutting}"
    );
}

/// Potential energy of a mechanism in metres and in the plane of x and y, forces outside their range left out.
fn potential(mechanism: &Mechanism, s: &Statics, m: &Moment) -> f64 {
    let flat = |v: &[Expr; 3]| [v[0].to_f64(), v[1].to_f64()];
    let at = |link, point| {
        let body = s.linkage.mechanism.body_of(link).unwrap();
        s.linkage.point_at(&m.pose, body, flat(point))
    };
    let gravity = flat(mechanism.loads.gravity.as_ref().unwrap());
    let masses = mechanism.links_with_ids();
    let masses = masses.filter_map(|(l, link)| Some((l, link.mass.as_ref()?)));
    let of_masses = masses.map(|(l, mass)| mass.mass * dot(gravity, at(l, &mass.centre)));
    let forces = mechanism.loads.forces.iter();
    let of_forces = forces.map(|f| dot(flat(&f.force), at(f.link, &f.point)));
    -of_masses.sum::<f64>() - of_forces.sum::<f64>()
}

/// Kinetic energy in the middle of three moments, `dt` apart, by differences of places.
fn kinetic(mechanism: &Mechanism, s: &Statics, at: usize, dt: f64) -> f64 {
    let masses = mechanism.links_with_ids();
    let masses = masses.filter_map(|(l, link)| Some((l, link.mass.as_ref()?)));
    let one = |(l, mass): (LinkId, &MassProperties)| {
        let body = s.linkage.mechanism.body_of(l).unwrap();
        let centre = [mass.centre[0].to_f64(), mass.centre[1].to_f64()];
        let place = |i: usize| s.linkage.point_at(&s.moments[i].pose, body, centre);
        let v = minus(place(at + 1), place(at - 1)).map(|x| x / (2.0 * dt));
        let turned = s.moments[at + 1].pose[body][2] - s.moments[at - 1].pose[body][2];
        let Some(Inertia::Plane(inertia)) = mass.inertia else {
            panic!()
        };
        0.5 * mass.mass * dot(v, v) + 0.5 * inertia * (turned / (2.0 * dt)).powi(2)
    };
    masses.map(one).sum()
}

fn effort(s: &Statics, m: &Moment) -> f64 {
    m.reactions[s.decomposition.drives[0]].effort.unwrap()
}

/// Effort at rest and the slope of the potential energy.
fn at_rest(text: &str, at: f64) -> Option<[f64; 2]> {
    let (m, h) = (read(text), 1e-5);
    let s = over(text, at - h, at + h, 2);
    let v = s.moments.iter().map(|x| potential(&m, &s, x)).collect_vec();
    s.dead
        .is_none()
        .then(|| [(v[2] - v[0]) / (2.0 * h), effort(&s, &s.moments[1])])
}

/// The rise of the energy by time, and the moment at `at`.
fn in_motion(text: &str, at: f64, speed: f64) -> Option<(f64, Statics)> {
    let (m, h) = (read(text), 1e-4);
    let s = over(text, at - 2.0 * h, at + 2.0 * h, 4);
    let energy = |i: usize| kinetic(&m, &s, i, h / speed) + potential(&m, &s, &s.moments[i]);
    s.dead
        .is_none()
        .then(|| ((energy(3) - energy(1)) / (2.0 * h) * speed, s.clone()))
}

#[derive(Debug, Clone)]
struct Chain {
    joints: Vec<J>,
    masses: Vec<Mass>,
    force: ([f64; 2], [f64; 2]),
    gravity: [f64; 2],
}

impl Chain {
    fn text(&self, speed: f64) -> String {
        let mass = |l: &str| {
            self.masses
                .get(l.parse::<usize>().unwrap().wrapping_sub(1))
                .copied()
        };
        let ([x, y], [fx, fy]) = self.force;
        let [gx, gy] = self.gravity;
        let more = format!(
            "[workload]\ngravity = [{gx:?}, {gy:?}, 0]\ndrive_speed = {speed:?}\n[[workload.force]]\nlink = \"3\"\npoint = [{x:?}, {y:?}, 0]\nforce = [{fx:?}, {fy:?}, 0]\n"
        );
        planar_file_with(&self.joints, &mass, &more)
    }
}

/// Crank-rockers and slider-cranks, with or without a dyad on the coupler.
fn chains() -> impl Strategy<Value = Chain> {
    let number = || -1.0..1.0f64;
    (
        proptest::collection::vec(number(), 40),
        any::<bool>(),
        any::<bool>(),
    )
        .prop_map(|(x, slider, six)| {
            let crank = 3.0 * x[0];
            let mut joints = vec![
                turning_joint("0", "1", 0.0, 0.0),
                turning_joint("1", "2", 0.5 * crank.cos(), 0.5 * crank.sin()),
                turning_joint("2", "3", 2.5 + 0.5 * x[1], 2.0 + 0.5 * x[2]),
            ];
            joints.push(if slider {
                sliding_joint("3", "0", 3.0, 1.0, [1.0, 0.3 * x[3]])
            } else {
                turning_joint("3", "0", 3.5 + 0.3 * x[3], 0.3 * x[4])
            });
            if six {
                joints.extend([
                    turning_joint("2", "4", 1.5 + 0.3 * x[5], 3.0 + 0.3 * x[6]),
                    turning_joint("4", "5", 3.0 + 0.3 * x[7], 5.0 + 0.3 * x[8]),
                    turning_joint("5", "0", 5.0 + 0.3 * x[9], 3.5),
                ]);
            }
            let links = if six { 5 } else { 3 };
            let mass = |i: usize| {
                let at = &x[10 + 4 * i..];
                (2.0 + at[0], [2.0 * at[1], 2.0 * at[2]], 0.5 + 0.4 * at[3])
            };
            Chain {
                joints,
                masses: (0..links).map(mass).collect(),
                force: ([2.0 + x[30], x[31]], [20.0 * x[32], 20.0 * x[33]]),
                gravity: [x[34], -9.81],
            }
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// At rest, the drive's torque is the derivative of the potential energy.
    #[test]
    fn torque_at_rest_is_the_derivative_of_the_potential_energy(chain in chains(), at in 0.0..0.5f64) {
        let found = at_rest(&chain.text(0.0), at);
        prop_assume!(found.is_some());
        let [slope, torque] = found.unwrap();
        prop_assert!((slope - torque).abs() < 1e-6 * (100.0 + torque.abs()), "{slope} {torque}");
    }

    /// In motion, the drive's power feeds kinetic and potential energy.
    #[test]
    fn power_is_the_derivative_of_the_energy(chain in chains(), at in 0.0..0.5f64, speed in 0.5..5.0f64) {
        let found = in_motion(&chain.text(speed), at, speed);
        prop_assume!(found.is_some());
        let (rise, s) = found.unwrap();
        let power = s.moments[2].drive_power;
        prop_assert!((rise - power).abs() < 1e-3 * (1000.0 + power.abs()), "{rise} {power}");
        prop_assert!((power - effort(&s, &s.moments[2]) * speed).abs() < 1e-9 * (1.0 + power.abs()));
    }

    /// What acts is what is borne: every body is in equilibrium about any point.
    #[test]
    fn every_body_is_in_equilibrium(chain in chains(), at in 0.0..0.5f64) {
        let s = over(&chain.text(3.0), at, at + 0.1, 2);
        prop_assume!(s.dead.is_none());
        for m in &s.moments {
            prop_assert!(left_over(&s, m) < 1e-12 * m.worth.condition.max(1e3));
        }
    }
}

/// The publication's first figure: loads on rods only, none on the ternary link's own; and h = 0 without loads but at B.
#[test]
fn a_group_without_loads_bears_nothing() {
    use ozols::statics::contour_group::{delta_point, projective};
    let s = over(shears_text(), 0.0, 0.0, 1);
    let mut g = s.moments[0].groups[0].pose.clone();
    g.loads.clear();
    let at = g.f;
    super::stability::study::push_link(&mut g, 1, at, [3.0, 4.0]);
    // A force at the head of rod 6 is borne as if it acted on link 4 there.
    let mut h = g.clone();
    h.loads.clear();
    super::stability::study::push_link(&mut h, 0, at, [3.0, 4.0]);
    let (a, b) = (
        projective::solve_projective(&g),
        projective::solve_projective(&h),
    );
    assert!((a.guide - b.guide).abs() < 1e-12 && (a.guide_moment - b.guide_moment).abs() < 1e-12);
    assert!((0..2).all(|c| (a.d[c] - b.d[c]).abs() < 1e-12 && (a.m[c] - b.m[c]).abs() < 1e-12));
    g.loads.clear();
    let nothing = projective::solve_projective(&g);
    assert!(
        nothing
            .force_vectors(&g)
            .iter()
            .flatten()
            .all(|c| *c == 0.0)
    );
    let (r, steps) = delta_point::solve_delta(&g);
    assert!(r.d == [0.0; 2] && steps.r34_tangential == 0.0 && r.arm.is_nan());
}

/// A cylinder between two moving links: its force is the derivative of the potential energy by its length.
#[test]
fn a_cylinder_bears_the_boom() {
    let joints = joints_of("2-3 1 1 1 0.9, 0-1 0 1, 0-2 0.5 0.5, 3-1 3 2.7");
    let mass = |l: &str| match l {
        "1" => Some((50.0, [2.5, 2.0], 4.0)),
        "2" => Some((5.0, [1.0, 1.0], 0.1)),
        "3" => Some((4.0, [2.0, 1.8], 0.1)),
        _ => None,
    };
    let text = |speed: f64| {
        let workload = format!("[workload]\ngravity = [0, -9.81, 0]\ndrive_speed = {speed:?}\n");
        planar_file_with(&joints, &mass, &workload)
    };
    let [slope, force] = at_rest(&text(0.0), 0.2).unwrap();
    assert!(force > 100.0);
    near(slope, force, 1e-6 * force);
    let (rise, s) = in_motion(&text(0.7), 0.2, 0.7).unwrap();
    let m = &s.moments[2];
    near(rise, m.drive_power, 1e-4 * rise.abs());
    near(m.load_power, -m.drive_power, 1e-9 * rise.abs());
    assert!(left_over(&s, m) < 1e-12);
}

/// A force over part of a turn acts there in every turn.
#[test]
fn forces_come_again_in_each_turn() {
    let turn = TAU;
    let s = over(shears_text(), -turn, 2.0 * turn, 3 * 72);
    let cutting = |m: &Moment| {
        m.loads
            .iter()
            .filter(|l| l.source == LoadSource::External)
            .count()
    };
    for i in 0..72 {
        // 165 to 200 degrees, ends included.
        let expected = if (33..=40).contains(&i) { 2 } else { 0 };
        for k in 0..3 {
            assert_eq!(cutting(&s.moments[72 * k + i]), expected, "{i} {k}");
        }
    }
}
