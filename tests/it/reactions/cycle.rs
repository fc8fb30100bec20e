//! Reactions over a stroke with inertia forces: in the plane and in space, and against differences of energy.

use super::expr;
use crate::common::*;
use crate::reactions::{effort, greatest_force};
use ozols::statics::reactions::geometry::{cross, dot};
use ozols::statics::reactions::{Contacts, Cycle, solve_cycle};

/// A built-in mechanism with masses beside its joints, gravity, and a drive at a speed.
fn moving(name: &str, speed: f64, inertia: impl Fn(f64) -> Inertia) -> Mechanism {
    let mut m = built_in(name);
    let mut draw = (1..).map(|i| (f64::from(i) * 0.618_034).fract());
    for l in m.link_ids() {
        if matches!(m.links[l].role, Role::Frame | Role::Object) {
            continue;
        }
        let at = m.joints.iter().find(|j| j.links.contains(&l)).unwrap();
        let p = to_vector(&at.frame.point);
        let flat = matches!(m.mode, Mode::Planar { .. });
        let near = [0, 1, 2].map(|i| {
            let off = draw.next().unwrap() - 0.5;
            p[i] + if flat && i == 2 { 0.0 } else { off }
        });
        m.edit().links[l].mass = Some(MassProperties {
            mass: 0.2 + draw.next().unwrap(),
            centre: near.map(expr),
            inertia: Some(inertia(0.1 + draw.next().unwrap())),
        });
    }
    m.edit().loads.gravity = Some([0.0, -9.81, 0.0].map(expr));
    m.edit().loads.drive_speeds = vec![speed];
    m
}

fn solved(c: &Cycle) -> Vec<(f64, &ozols::statics::reactions::Solution)> {
    c.positions
        .iter()
        .map(|(at, s)| (*at, s.as_ref().unwrap()))
        .collect()
}

const STROKE: Stroke = Stroke {
    from: -0.2,
    to: 0.3,
    steps: 5,
};

/// With all masses in the plane, what is redundant in space bears the same drive.
#[test]
fn the_drive_bears_the_same_in_the_plane_and_in_space() {
    for name in split_words("four-bar-planar watt-six-bar stephenson-six-bar gripper-10-planar") {
        let slides = name == "gripper-10-planar";
        let mut m = moving(name, if slides { 30.0 } else { 3.0 }, Inertia::Plane);
        m.edit().mode = Mode::Planar {
            normal: [0, 0, 1].map(Expr::from),
        };
        for l in &mut m.edit().links {
            if let Some(mass) = &mut l.mass {
                mass.centre[2] = Expr::from(0);
            }
        }
        let c = solve_cycle(&m, StateId::FREE, Some(STROKE), Contacts::AsJoints).unwrap();
        assert!(c.stopped.is_none(), "{name}");
        let planar = planar_statics(&m, StateId::FREE, Some(STROKE)).unwrap();
        assert!(planar.dead.is_none());
        let mut still = m.clone();
        still.edit().loads.drive_speeds.clear();
        let at_rest = solve_cycle(&still, StateId::FREE, Some(STROKE), Contacts::AsJoints).unwrap();
        m.edit().mode = Mode::Spatial;
        let spatial = solve_cycle(&m, StateId::FREE, Some(STROKE), Contacts::AsJoints).unwrap();
        let mut differs = 0.0f64;
        let all = solved(&c).into_iter().zip(solved(&spatial));
        let all = all.zip(solved(&at_rest)).zip(&planar.moments);
        for ((((_, s), (_, t)), (_, rest)), moment) in all {
            assert_eq!(s.choice, Uniqueness::Unique);
            let (a, b) = (effort(&s.reactions), effort(&t.reactions));
            assert!((a - b).abs() < 1e-8 * a.abs().max(1.0), "{name}: {a} {b}");
            let p = moment.reactions[planar.decomposition.drives[0]].effort;
            assert!((a - p.unwrap()).abs() < 1e-8 * a.abs().max(1.0), "{name}");
            differs = differs.max((a - effort(&rest.reactions)).abs() / a.abs());
        }
        assert!(differs > 1e-3, "{name}: {differs}");
    }
}

/// Energy at a position, from places alone: kinetic by differences of places, less what the loads have done.
fn energies(m: &Mechanism, c: &Cycle, at: f64, speed: f64) -> f64 {
    let h = 2e-3;
    let steps = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| at + k * h);
    let poses = follow_to(m, StateId::FREE, &c.drives, &steps)
        .unwrap()
        .poses;
    assert_eq!(poses.len(), 5);
    let metres = m.length_unit.metres;
    let diff = |x: [f64; 5]| (8.0 * (x[3] - x[1]) - (x[4] - x[0])) / (12.0 * h) * speed;
    let mut energy = 0.0;
    for (l, link) in m.links_with_ids() {
        let Some(mass) = &link.mass else { continue };
        let file = to_vector(&mass.centre);
        let place = |pose: &Pose| {
            let to = pose.carry_point(&pose.links, l, file);
            to.map(|x| x * metres)
        };
        let axis = |pose: &Pose, i: usize| {
            pose.links[l].map_direction([0, 1, 2].map(|k| f64::from(u8::from(k == i))))
        };
        let five = |f: &dyn Fn(&Pose) -> f64| diff([0, 1, 2, 3, 4].map(|n: usize| f(&poses[n].1)));
        let v = [0, 1, 2].map(|i| five(&|p| place(p)[i]));
        let now = &poses[2].1;
        // ω = ½ Σ e × ė over the link's axes.
        let mut w = [0.0; 3];
        for i in 0..3 {
            let e = axis(now, i);
            let rate = [0, 1, 2].map(|k| five(&|p| axis(p, i)[k]));
            let c = cross(e, rate);
            (0..3).for_each(|k| w[k] += c[k] / 2.0);
        }
        let own = [0, 1, 2].map(|i| dot(axis(now, i), w));
        let spin = match mass.inertia.unwrap() {
            Inertia::Plane(i) => i * dot(own, own),
            Inertia::Principal(i) => (0..3).map(|k| i[k] * own[k] * own[k]).sum(),
            Inertia::Tensor([xx, yy, zz, xy, yz, zx]) => {
                let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
                dot(own, rows.map(|r| dot(r, own)))
            }
        };
        energy += 0.5 * mass.mass * dot(v, v) + 0.5 * spin;
        energy -= mass.mass * dot(to_vector(m.loads.gravity.as_ref().unwrap()), place(now));
    }
    energy
}

/// The drive's power is what energy gains, in space, with whole tensors of inertia.
#[test]
fn the_drive_feeds_the_energy_of_spatial_mechanisms() {
    let mut tried = 0;
    for (name, speed) in [
        ("rsur", 2.0),
        ("slider-crank-spatial", 2.0),
        ("bennett", 3.0),
        ("slider-crank-determinate", 2.0),
        ("geared-five-bar", 2.0),
        ("geared-gripper", 1.0),
        ("planetary-gear", 3.0),
    ] {
        let m = moving(name, speed, |x| {
            Inertia::Tensor([x, 1.3 * x, 0.8 * x, 0.1 * x, -0.05 * x, 0.07 * x])
        });
        // The five-bar goes away from its dead point, where differences of places are worth little.
        let [from, to] = match name {
            "geared-five-bar" => [-0.3, 0.0],
            _ => [0.0, 0.3],
        };
        let stroke = Stroke { from, to, steps: 2 };
        let c = solve_cycle(&m, StateId::FREE, Some(stroke), Contacts::AsJoints).unwrap();
        let slides = matches!(c.drives[0].1, Freedom::Tx | Freedom::Ty | Freedom::Tz);
        let unit = if slides { m.length_unit.metres } else { 1.0 };
        for (at, s) in solved(&c) {
            let h = 1e-2;
            let e = [-2.0, -1.0, 1.0, 2.0].map(|k| energies(&m, &c, at + k * h, speed));
            let gain = (8.0 * (e[2] - e[1]) - (e[3] - e[0])) / (12.0 * h) * speed;
            let power = effort(&s.reactions) * speed * unit;
            let greatest = greatest_force(&s.reactions);
            assert!(
                (power - gain).abs() < 1e-5 * (power.abs() + greatest * s.size),
                "{name} at {at}: {power} {gain}"
            );
            tried += 1;
        }
    }
    assert_eq!(tried, 21);
}

#[test]
fn an_inertia_for_a_plane_is_refused_in_space() {
    let m = moving("rsur", 1.0, Inertia::Plane);
    match solve_cycle(&m, StateId::FREE, None, Contacts::AsJoints) {
        Err(e @ Unsolved::PlaneInertia { .. }) => {
            assert!(e.to_string().contains("3 about the axes"))
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_command_goes_over_the_stroke() {
    let line = "statics gripper-10-loaded --spatial --format json";
    let v = run_json(&format!("{line} --stroke -0.3:0.3:4"));
    assert_eq!(v["positions"].list().len(), 5);
    assert_eq!(v["positions"][4]["drive"], 0.3);
    // The middle is the pose of the file.
    let one = run_json(line);
    let pairs = one["reactions"].list().iter();
    for (a, b) in pairs.zip(v["positions"][2]["reactions"].list()) {
        let (x, y) = (a["force_magnitude"].real(), b["force_magnitude"].real());
        assert!((x - y).abs() < 1e-9 * x.max(1.0));
    }
    // Farther than it goes.
    assert_eq!(run_full(&format!("{line} --stroke 0:1000:4")).0, Some(1));
}
