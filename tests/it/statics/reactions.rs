//! Loads and reactions: the methods agree, and with energy.

use super::{J, Mass, file_with, mechanism, p, r, shears};
use itertools::Itertools;
use ozols::model::loads::Stroke;
use ozols::model::mechanism::StateId;
use ozols::statics::contour_group::ContourGroup;
use ozols::statics::contour_group::pose::{GroupPose, GroupReactions};
use ozols::statics::cycle::{Moment, Statics, statics};
use ozols::statics::kinetostatics::{Equilibrium, LoadSource};
use ozols::statics::planar::{BodyId, PairId};
use ozols::statics::pose::{Linkage, cross, dot, minus};
use proptest::prelude::*;

fn over(text: &str, from: f64, to: f64, steps: usize) -> Statics {
    statics(
        &mechanism(text),
        StateId::FREE,
        Some(Stroke { from, to, steps }),
    )
    .unwrap()
}

fn shears_cycle() -> Statics {
    over(shears(), 0.0, std::f64::consts::TAU, 72)
}

/// Greatest force or moment by size left over on any body, about a point far from all, over the greatest load.
fn left_over(s: &Statics, m: &Moment, e: &Equilibrium) -> f64 {
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
        for r in &e.reactions {
            let all = r.on(&s.linkage, body, about);
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
    e: &Equilibrium,
) -> Option<GroupReactions> {
    let on = |pair: PairId, body: BodyId| {
        let r = e.reactions.iter().find(|r| r.pair == pair)?;
        Some(r.on(linkage, body, pose.d))
    };
    let force = |pair, body| on(pair, body).map(|[x, y, _]| [x, y]);
    let [gx, gy, guide_moment] = on(g.guide, g.slider)?;
    let guide = dot([gx, gy], pose.normal());
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
        let whole = m.whole.as_ref().unwrap();
        assert!(left_over(&s, m, whole) < 1e-12);
        assert!(whole.residual < 1e-12);
        cutting += usize::from(m.loads.iter().any(|l| l.source == LoadSource::External));
        for (g, (_, letters)) in m.groups.iter().zip(&s.contour_groups) {
            let (lu, worth) = g.equilibrium.unwrap();
            let exact = ozols::statics::contour_group::equilibrium::exact(&g.pose).unwrap();
            let out_of_whole = from_equilibrium(&s.linkage, letters, &g.pose, whole).unwrap();
            for (name, found) in [
                ("δ", g.delta),
                ("projective", g.projective),
                ("LU", lu),
                ("whole", out_of_whole),
            ] {
                let away = found.distance(&exact, &g.pose);
                assert!(away < 1e-9, "{name} {away} at {}", m.instant.drive);
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

#[test]
fn group_by_group_and_all_at_once_are_the_same() {
    let s = shears_cycle();
    for m in &s.moments {
        let whole = m.whole.as_ref().unwrap();
        let greatest = whole
            .reactions
            .iter()
            .flat_map(|r| r.force)
            .fold(0.0f64, |g, c| g.max(c.abs()));
        let parts = m.by_groups.as_ref().unwrap();
        assert_eq!(parts.len(), s.decomposition.groups.len() + 1);
        let all = parts.iter().flat_map(|e| &e.reactions).collect_vec();
        assert_eq!(all.len(), whole.reactions.len());
        for r in all {
            let other = whole.reactions.iter().find(|x| x.pair == r.pair).unwrap();
            for c in 0..2 {
                assert!((r.force[c] - other.force[c]).abs() < 1e-10 * greatest);
            }
            assert!((r.moment - other.moment).abs() < 1e-10 * greatest);
        }
    }
}

/// Kinetic and potential energy, forces outside their range left out.
fn energy(s: &Statics, m: &Moment) -> (f64, f64) {
    let (mut kinetic, mut potential) = (0.0, 0.0);
    for (body, mass) in s.loads.masses.iter().enumerate() {
        let Some(mass) = mass else { continue };
        let now = &m.instant;
        let at = s.linkage.point(&now.pose, body, mass.centre);
        let v = s
            .linkage
            .velocity(&now.pose, &now.velocity, body, mass.centre);
        kinetic += 0.5 * mass.mass * (v[0] * v[0] + v[1] * v[1]);
        kinetic += 0.5 * mass.inertia * now.velocity[body][2].powi(2);
        potential -= mass.mass * (s.loads.gravity[0] * at[0] + s.loads.gravity[1] * at[1]);
    }
    for f in &s.loads.forces {
        let at = s.linkage.point(&m.instant.pose, f.body, f.point);
        potential -= f.force[0] * at[0] + f.force[1] * at[1];
    }
    (kinetic, potential)
}

fn effort(s: &Statics, m: &Moment) -> f64 {
    let drive = s.decomposition.drives[0];
    let all = &m.whole.as_ref().unwrap().reactions;
    all.iter()
        .find(|r| r.pair == drive)
        .unwrap()
        .effort
        .unwrap()
}

#[test]
fn reactions_do_no_work() {
    let s = shears_cycle();
    let greatest = s
        .moments
        .iter()
        .map(|m| m.load_power.abs())
        .fold(0.0, f64::max);
    assert!(greatest > 1e4);
    for m in &s.moments {
        assert!((m.load_power + m.drive_power).abs() < 1e-10 * greatest);
    }
}

#[derive(Debug, Clone)]
struct Chain {
    joints: Vec<J>,
    masses: Vec<Mass>,
    force: ([f64; 2], [f64; 2]),
    gravity: [f64; 2],
}

impl Chain {
    fn text(&self, speed: f64, scale: f64) -> String {
        let mass = |l: &str| {
            self.masses
                .get(l.parse::<usize>().unwrap().wrapping_sub(1))
                .copied()
        };
        let mass = |l: &str| mass(l).map(|(m, c, i)| (m * scale, c, i * scale));
        let ([x, y], [fx, fy]) = self.force;
        let [gx, gy] = self.gravity;
        let (fx, fy) = (fx * scale, fy * scale);
        let more = format!(
            "[workload]\ngravity = [{gx:?}, {gy:?}, 0]\ndrive_speed = {speed:?}\n[[workload.force]]\nlink = \"3\"\npoint = [{x:?}, {y:?}, 0]\nforce = [{fx:?}, {fy:?}, 0]\n"
        );
        file_with(&self.joints, &mass, &more)
    }

    /// The same turned and shifted, loads with it.
    fn moved(&self, angle: f64, by: [f64; 2]) -> Chain {
        let turn = |v: [f64; 2]| {
            let (s, c) = angle.sin_cos();
            [c * v[0] - s * v[1], s * v[0] + c * v[1]]
        };
        let place = |v: [f64; 2]| {
            let t = turn(v);
            [t[0] + by[0], t[1] + by[1]]
        };
        let joint = |j: &J| J {
            at: place(j.at),
            slide: j.slide.map(turn),
            links: j.links.clone(),
        };
        Chain {
            joints: self.joints.iter().map(joint).collect(),
            masses: self
                .masses
                .iter()
                .map(|(m, c, i)| (*m, place(*c), *i))
                .collect(),
            force: (place(self.force.0), turn(self.force.1)),
            gravity: turn(self.gravity),
        }
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
                r("0", "1", 0.0, 0.0),
                r("1", "2", 0.5 * crank.cos(), 0.5 * crank.sin()),
                r("2", "3", 2.5 + 0.5 * x[1], 2.0 + 0.5 * x[2]),
            ];
            joints.push(if slider {
                p("3", "0", 3.0, 1.0, [1.0, 0.3 * x[3]])
            } else {
                r("3", "0", 3.5 + 0.3 * x[3], 0.3 * x[4])
            });
            if six {
                joints.extend([
                    r("2", "4", 1.5 + 0.3 * x[5], 3.0 + 0.3 * x[6]),
                    r("4", "5", 3.0 + 0.3 * x[7], 5.0 + 0.3 * x[8]),
                    r("5", "0", 5.0 + 0.3 * x[9], 3.5),
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
        let h = 1e-5;
        let s = over(&chain.text(0.0, 1.0), at - h, at + h, 2);
        prop_assume!(s.dead.is_none());
        let v = s.moments.iter().map(|m| energy(&s, m).1).collect_vec();
        let (slope, torque) = ((v[2] - v[0]) / (2.0 * h), effort(&s, &s.moments[1]));
        prop_assert!((slope - torque).abs() < 1e-6 * (100.0 + torque.abs()), "{slope} {torque}");
    }

    /// In motion, the drive's power feeds kinetic and potential energy.
    #[test]
    fn power_is_the_derivative_of_the_energy(chain in chains(), at in 0.0..0.5f64, speed in 0.5..5.0f64) {
        let h = 1e-5;
        let s = over(&chain.text(speed, 1.0), at - h, at + h, 2);
        prop_assume!(s.dead.is_none());
        let e = s.moments.iter().map(|m| { let (k, p) = energy(&s, m); k + p }).collect_vec();
        let rise = (e[2] - e[0]) / (2.0 * h) * speed;
        let power = s.moments[1].drive_power;
        prop_assert!((rise - power).abs() < 1e-5 * (1000.0 + power.abs()), "{rise} {power}");
        prop_assert!((power - effort(&s, &s.moments[1]) * speed).abs() < 1e-9 * (1.0 + power.abs()));
    }

    /// What acts is what is borne: every body is in equilibrium about any point.
    #[test]
    fn every_body_is_in_equilibrium(chain in chains(), at in 0.0..0.5f64) {
        let s = over(&chain.text(3.0, 1.0), at, at + 0.1, 2);
        prop_assume!(s.dead.is_none());
        for m in &s.moments {
            let e = m.whole.as_ref().unwrap();
            prop_assert!(left_over(&s, m, e) < 1e-12 * e.condition.max(1e3));
        }
    }

    /// A mechanism turned and shifted with its loads has the same reactions, turned.
    #[test]
    fn reactions_do_not_depend_on_the_frame(chain in chains(), angle in -3.0..3.0f64, x in -5.0..5.0f64, y in -5.0..5.0f64) {
        let (a, b) = (over(&chain.text(2.0, 1.0), 0.2, 0.2, 1), over(&chain.moved(angle, [x, y]).text(2.0, 1.0), 0.2, 0.2, 1));
        prop_assume!(a.dead.is_none());
        prop_assert!(b.dead.is_none());
        let (a, b) = (a.moments[0].whole.clone().unwrap(), b.moments[0].whole.clone().unwrap());
        let greatest = a.reactions.iter().flat_map(|r| r.force).fold(1.0f64, |g, c| g.max(c.abs()));
        for (r, q) in a.reactions.iter().zip(&b.reactions) {
            let (sin, cos) = angle.sin_cos();
            let turned = [cos * r.force[0] - sin * r.force[1], sin * r.force[0] + cos * r.force[1]];
            prop_assert!((turned[0] - q.force[0]).abs() < 1e-8 * greatest);
            prop_assert!((turned[1] - q.force[1]).abs() < 1e-8 * greatest);
            prop_assert!((r.moment - q.moment).abs() < 1e-8 * greatest);
        }
    }

    /// Masses and forces times s make reactions times s.
    #[test]
    fn reactions_are_linear_in_the_loads(chain in chains(), factor in 0.1..10.0f64) {
        let (a, b) = (over(&chain.text(2.0, 1.0), 0.2, 0.2, 1), over(&chain.text(2.0, factor), 0.2, 0.2, 1));
        prop_assume!(a.dead.is_none());
        let (a, b) = (a.moments[0].whole.clone().unwrap(), b.moments[0].whole.clone().unwrap());
        let greatest = b.reactions.iter().flat_map(|r| r.force).fold(1.0f64, |g, c| g.max(c.abs()));
        for (r, q) in a.reactions.iter().zip(&b.reactions) {
            for c in 0..2 {
                prop_assert!((factor * r.force[c] - q.force[c]).abs() < 1e-9 * greatest);
            }
        }
    }
}

/// The publication's first figure: loads on rods only, none on the ternary link's own; and h = 0 without loads but at B.
#[test]
fn a_group_without_loads_bears_nothing() {
    use ozols::statics::contour_group::{delta_point, projective};
    let s = over(shears(), 0.0, 0.0, 1);
    let mut g = s.moments[0].groups[0].pose.clone();
    g.loads.clear();
    g.push(1, g.f, [3.0, 4.0]);
    // A force at the head of rod 6 is borne as if it acted on link 4 there.
    let mut h = g.clone();
    h.loads.clear();
    h.push(0, g.f, [3.0, 4.0]);
    let (a, b) = (projective::solve(&g), projective::solve(&h));
    assert!((a.guide - b.guide).abs() < 1e-12 && (a.guide_moment - b.guide_moment).abs() < 1e-12);
    assert!((0..2).all(|c| (a.d[c] - b.d[c]).abs() < 1e-12 && (a.m[c] - b.m[c]).abs() < 1e-12));
    g.loads.clear();
    let nothing = projective::solve(&g);
    assert!(nothing.forces(&g).iter().flatten().all(|c| *c == 0.0));
    let (r, steps) = delta_point::solve(&g);
    assert!(r.d == [0.0; 2] && steps.r34_tangential == 0.0 && r.arm.is_nan());
}

/// A cylinder between two moving links: its force is the derivative of the potential energy by its length.
#[test]
fn a_cylinder_bears_the_boom() {
    let joints = [
        p("2", "3", 1.0, 1.0, [1.0, 0.9]),
        r("0", "1", 0.0, 1.0),
        r("0", "2", 0.5, 0.5),
        r("3", "1", 3.0, 2.7),
    ];
    let mass = |l: &str| match l {
        "1" => Some((50.0, [2.5, 2.0], 4.0)),
        "2" => Some((5.0, [1.0, 1.0], 0.1)),
        "3" => Some((4.0, [2.0, 1.8], 0.1)),
        _ => None,
    };
    let text = |speed: f64| {
        file_with(
            &joints,
            &mass,
            &format!("[workload]\ngravity = [0, -9.81, 0]\ndrive_speed = {speed:?}\n"),
        )
    };
    let h = 1e-5;
    let s = over(&text(0.0), 0.2 - h, 0.2 + h, 2);
    let v = s.moments.iter().map(|m| energy(&s, m).1).collect_vec();
    let (slope, force) = ((v[2] - v[0]) / (2.0 * h), effort(&s, &s.moments[1]));
    assert!(
        (slope - force).abs() < 1e-6 * force && force > 100.0,
        "{slope} {force}"
    );
    let s = over(&text(0.7), 0.2 - h, 0.2 + h, 2);
    let e = s
        .moments
        .iter()
        .map(|m| energy(&s, m))
        .map(|(k, p)| k + p)
        .collect_vec();
    let m = &s.moments[1];
    let rise = (e[2] - e[0]) / (2.0 * h) * 0.7;
    assert!(
        (rise - m.drive_power).abs() < 1e-5 * rise.abs(),
        "{rise} {}",
        m.drive_power
    );
    assert!((m.load_power + m.drive_power).abs() < 1e-9 * rise.abs());
    assert!(left_over(&s, m, m.whole.as_ref().unwrap()) < 1e-12);
}

/// A force over part of a turn acts there in every turn.
#[test]
fn forces_come_again_in_each_turn() {
    let turn = std::f64::consts::TAU;
    let s = over(shears(), -turn, 2.0 * turn, 3 * 72);
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
