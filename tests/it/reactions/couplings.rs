//! What gears, racks and belts pass in statics: published and handed figures, figures by hand, the balance of power at poses,
//! and a twin that writes all equilibrium equations out.

use crate::common::*;
mod random;
mod twin;

use ozols::closure::drive::Driven;
use ozols::model::loads::Loads;
use ozols::redundancy::stress::exact_self_stresses;
use random::{Random, five_bar, train, with_loads};
use twin::Twin;

fn drives(m: &Mechanism) -> Vec<Driven> {
    driven_freedoms(m, StateId::FREE)
}

fn solve(m: &Mechanism) -> Solution {
    Reactions::solve_at_home(m, StateId::FREE, &m.loads)
        .unwrap_or_else(|e| panic!("{}: {e}", m.name))
}

fn effort(s: &Solution) -> f64 {
    s.reactions.iter().find_map(|r| r.effort).unwrap().1
}

fn joint<'s>(m: &Mechanism, s: &'s Solution, id: &str) -> &'s JointReaction {
    let j = m.joint_named(id).unwrap();
    s.reactions.iter().find(|r| r.joint == j).unwrap()
}

/// With masses, stroke and the file's loads left out, and a force on each link named.
fn loaded(name: &str, forces: &[(&str, [i64; 3], [i64; 3])]) -> Mechanism {
    let mut m = built_in(name);
    m.edit().loads = Loads::default();
    for &(link, point, force) in forces {
        let link = m.link_named(link).unwrap();
        m.edit().loads.forces.push(ExternalForce {
            states: None,
            link,
            point: point.map(Into::into),
            force: force.map(Into::into),
            range: None,
        });
    }
    m
}

/// Reference values of best force ratios of classic schemes, scheme rack-two-segments: force of one jaw across over that of the
/// drive, at tips from closed to 10 mm out, with the hinge at (80, 22.5) and the pitch line of the rack at 5 mm.
#[test]
fn the_rack_gripper_has_the_force_ratios_it_was_handed_with() {
    let handed = [
        0.4375, 0.43004, 0.42394, 0.41905, 0.41526, 0.41248, 0.41066, 0.40976, 0.40976, 0.41066,
        0.41248,
    ];
    let m = built_in("rack-gripper");
    let (x, y) = (20.0, -7.5f64);
    let (reach, start) = (f64::hypot(x, y), y.atan2(x));
    let to = |k: usize| 17.5 * (((y + k as f64) / reach).asin() - start);
    let positions: Vec<f64> = (0..handed.len()).map(to).collect();
    near(positions[10], 8.33141, 1e-5);
    let drives = drives(&m);
    let followed = follow_to(&m, StateId::FREE, &drives, &positions).unwrap();
    assert!(followed.stopped.is_none());
    for ((at, pose), ratio) in followed.poses.iter().zip(handed) {
        let s = Reactions::solve_at(&m, StateId::FREE, &m.loads, pose, *at, &drives).unwrap();
        assert_eq!(s.choice, Uniqueness::Unique);
        // The part pushes the jaws apart, so the drive pulls the rack back.
        near(-100.0 / effort(&s), ratio, 6e-6);
        // Each mesh has half of what the drive pulls.
        for c in &s.couplings {
            near(c.teeth.unwrap().tooth_force_size(), -effort(&s) / 2.0, 1e-9);
        }
    }
    near(-100.0 / effort(&solve(&m)), 0.4375, 1e-12);
}

/// A jaw of the geared gripper moves across by 40 mm a radian of its crank: 100 N on the lower one are 4 N·m in the gears, 400 N
/// at their teeth 10 mm from either axis, 4 N·m of the drive, and the bearings bear the teeth.
#[test]
fn teeth_of_the_geared_gripper_push_by_hand() {
    let m = loaded("geared-gripper", &[("5", [60, -20, 0], [0, -100, 0])]);
    let s = solve(&m);
    let c = &s.couplings[0];
    near(effort(&s).abs(), 4.0, 1e-9);
    near(c.efforts[0].abs(), 4.0, 1e-9);
    near(c.efforts[1].abs(), 4.0, 1e-9);
    let teeth = c.teeth.unwrap();
    near(teeth.tooth_force_size(), 400.0, 1e-7);
    (0..3).for_each(|i| near(teeth.point[i], 0.0, 1e-12));
    // No load but the teeth on the upper half: its crank's bearing stands against them alone.
    let upper = joint(&m, &s, "0-1");
    near(upper.force_size(), 400.0, 1e-7);
    near(joint(&m, &s, "1-2").force_size(), 0.0, 1e-7);
    // As a belt, or as what only says its ratio, no bearing feels it.
    let mut belt = m.clone();
    belt.edit().couplings[0].gear = false;
    let t = solve(&belt);
    assert!(t.couplings[0].teeth.is_none());
    near(t.couplings[0].efforts[1], c.efforts[1], 1e-9);
    near(effort(&t), effort(&s), 1e-9);
    near(joint(&belt, &t, "0-1").force_size(), 0.0, 1e-7);
}

/// Willis: the sun goes by 3 against the carrier where that goes by 1, so 12 N·m on the carrier take 4 of the drive between
/// them; three planets share that alike at 20 mm from the sun's axis, 200/3 N a tooth, and each pin bears two of them.
#[test]
fn three_planets_share_alike_where_nothing_else_is_known() {
    let mut m = loaded("planetary-gear", &[]);
    let link = m.link_named("c").unwrap();
    m.edit().loads.moments.push(ExternalMoment {
        link,
        moment: [0, 0, 12].map(Into::into),
        states: None,
    });
    let s = solve(&m);
    near(effort(&s), -4.0, 1e-9);
    assert_eq!(
        (s.choice, s.self_stresses.len()),
        (Uniqueness::MinimumNorm, 2)
    );
    assert_eq!(exact_self_stresses(&m, StateId::FREE, &drives(&m)), Some(2));
    assert_eq!(s.couplings_open, [true; 6]);
    for c in &s.couplings {
        near(c.teeth.unwrap().tooth_force_size(), 200.0 / 3.0, 1e-8);
    }
    for pin in ["c-1", "c-2", "c-3"] {
        near(joint(&m, &s, pin).force_size(), 400.0 / 3.0, 1e-8);
    }
    for stress in &s.coupling_stresses {
        assert!(
            stress
                .iter()
                .any(|c| c.teeth.unwrap().tooth_force_size() > 1e-3)
        );
    }
}

/// Gears that repeat what a slider does already can be tight: one self-stress more, through the teeth.
#[test]
fn a_gear_too_many_is_a_self_stress_through_its_teeth() {
    let text = builtin::text("parallelogram-gripper").unwrap();
    let cut = text.find("[[expected]]").unwrap();
    let plain = read(&text[..cut]);
    let coupling = "[[coupling]]\njoints = [\"3-0\", \"7-0\"]\nratio = -1\n\n[search]";
    let geared = replace_once(&text[..cut], "[search]", coupling);
    let geared = read(&geared);
    let (a, b) = (solve(&plain), solve(&geared));
    assert_eq!(b.self_stresses.len(), a.self_stresses.len() + 1);
    assert_eq!(b.couplings_open, [true]);
    let exact = |m: &Mechanism| exact_self_stresses(m, StateId::FREE, &drives(m)).unwrap();
    assert_eq!(exact(&geared), exact(&plain) + 1);
    let loading = |n: usize| b.coupling_stresses[n][0].efforts[1].abs() > 1e-6;
    assert!((0..b.self_stresses.len()).any(loading));
}

/// Every joint's wrench, every coupling's force and what is open, as the twin's equations have them; none where these have no
/// solution, either.
fn as_the_twin_has_it(m: &Mechanism) -> Option<Solution> {
    let twin = Twin::new(m, &drives(m));
    let s = match Reactions::solve_at_home(m, StateId::FREE, &m.loads) {
        Ok(s) => s,
        Err(e) => {
            assert!(matches!(e, Unsolved::Moves { .. }), "{e}");
            assert!(twin.left_over(&twin.solved().0) > 1e-6, "{e}");
            return None;
        }
    };
    let found = twin.unknowns(&s);
    assert!(
        twin.left_over(&found) < 1e-8,
        "{}: {}",
        m.name,
        twin.left_over(&found)
    );
    let (wanted, open) = twin.solved();
    assert!(twin.left_over(&wanted) < 1e-8, "{}", m.name);
    assert_eq!(open, s.self_stresses.len(), "{}", m.name);
    if open == 0 {
        let greatest = wanted.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        for (n, (a, b)) in found.iter().zip(&wanted).enumerate() {
            assert!((a - b).abs() < 1e-6 * greatest, "{} {n}: {a} {b}", m.name);
        }
    }
    Some(s)
}

#[test]
fn reactions_are_those_of_all_equilibrium_equations_written_out() {
    let (mut toothed, mut plain, mut solved) = (0, 0, 0);
    for seed in 0..120 {
        let mut random = Random::new(27_000 + seed);
        let text = if seed % 3 == 0 {
            five_bar(&mut random)
        } else {
            train(&mut random)
        };
        let mut m = read(&text);
        with_loads(&mut m, &mut random);
        let Some(s) = as_the_twin_has_it(&m) else {
            continue;
        };
        toothed += s.couplings.iter().filter(|c| c.teeth.is_some()).count();
        plain += s.couplings.iter().filter(|c| c.teeth.is_none()).count();
        solved += usize::from(s.choice == Uniqueness::Unique);
    }
    assert!(
        toothed > 60 && plain > 60 && solved > 100,
        "{toothed} {plain} {solved}"
    );
}

#[test]
fn redundant_mechanisms_are_in_equilibrium_with_what_their_couplings_pass() {
    for name in split_words("geared-gripper geared-five-bar planetary-gear rack-gripper") {
        for seed in 0..4 {
            let mut m = loaded(name, &[]);
            with_loads(&mut m, &mut Random::new(900 + seed));
            assert!(as_the_twin_has_it(&m).is_some(), "{name}");
        }
    }
}

#[test]
fn the_program_tells_what_a_coupling_passes() {
    let text = replace_once(
        builtin::text("rack-gripper").unwrap(),
        "stroke = { from = 0, to = 8, steps = 8 }\n",
        "",
    );
    let c = json_on("statics", "rack.toml", &text, "")["couplings"][0].clone();
    assert_eq!(c["ends"][1]["unit"], "N·m");
    assert_eq!((&c["gear"], &c["open"]), (&json!(true), &json!(false)));
    near(c["teeth"]["magnitude"].real(), 800.0 / 7.0, 1e-9);
    let none = run_json("statics gripper-10-loaded --spatial --format json");
    assert_eq!(none["couplings"], json!([]));
}

/// Gears whose teeth cannot be placed are told of, and pass what they pass along the freedoms.
#[test]
fn gears_that_cannot_mesh_are_told_of() {
    let text = builtin::text("rack-gripper").unwrap();
    // A hinge and a slide that are not across.
    let bevel = replace_once(
        text,
        "point = [80, 22.5, 0]\naxis = [0, 0, 1]",
        "point = [80, 22.5, 0]\naxis = [1, 0, 1]",
    );
    let (code, said, _) = run_on("statics", "bevel.toml", &bevel, "--spatial");
    assert_eq!(code, Some(0), "{said}");
    has(
        &said,
        "The file does not determine where the teeth of 0-1 ~ 0-2 are",
    );
    // A pinion that may shift across is pushed aside by its teeth.
    let loose = replace_once(
        text,
        "type = \"revolute\"\npoint = [80, 22.5, 0]\naxis = [0, 0, 1]",
        "type = \"slotted\"\npoint = [80, 22.5, 0]\naxis = [0, 0, 1]\nreference = [1, 0, 0]",
    );
    let loose = replace_once(&loose, "[\"0-1\", \"0-2\"]", "[\"0-1\", \"0-2:rz\"]");
    let loose = loose.split("[[expected]]").next().unwrap().to_owned();
    let (_, said, _) = run_on("statics", "loose.toml", &loose, "--spatial");
    has(
        &said,
        "The file does not determine where the teeth of 0-1 ~ 0-2:rz are",
    );
}

/// What Assur groups are for is still refused, with the way to go on.
#[test]
fn groups_of_coupled_joints_are_refused_with_a_way_on() {
    for more in [&["--groups"][..], &["--method", "delta"]] {
        let o = run(&[&["statics", "geared-gripper"][..], more].concat());
        assert_eq!(o.status.code(), Some(2), "{more:?}");
        let said = utf8_text(&o.stderr);
        has_all(
            &said,
            &["joints 0-1 ~ 0-4 are coupled", "spatial reactions"],
        );
    }
}
