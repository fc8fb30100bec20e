//! Joint reactions of any mechanism: equilibrium, virtual work, frames, linearity, energy, self-stresses.

use crate::common::*;
mod command;
mod couplings;
mod cycle;
mod family;
mod named_drives;
mod point_masses;
mod rounding;
mod twists;
mod two_drives;
mod unilateral;

use ozols::statics::reactions::geometry::{cross, dot};

/// A number as written with nine decimals, so that the file's exactness is kept.
fn expr(x: f64) -> Expr {
    format!("{x:.9}").parse().unwrap()
}

fn vector(v: [f64; 3]) -> [Expr; 3] {
    v.map(expr)
}

/// Masses at the places of the joints, a little beside, from a seed of numbers between 0 and 1.
fn with_masses(m: &mut Mechanism, seed: &[f64]) {
    let mut next = seed.iter().copied().cycle();
    let mut draw = || next.next().unwrap();
    m.edit().loads.gravity = Some(vector([draw() * 9.0, -9.81 * draw(), 5.0 * draw() - 2.0]));
    for l in m.link_ids() {
        let at = m.joints.iter().find(|j| j.links.contains(&l)).unwrap();
        let near = to_vector(&at.frame.point).map(|x| x + draw() - 0.5);
        if !matches!(m.links[l].role, Role::Frame | Role::Object) {
            m.edit().links[l].mass = Some(MassProperties {
                mass: 0.1 + 3.0 * draw(),
                centre: vector(near),
                inertia: None,
            });
        }
    }
    let output = m
        .link_ids()
        .find(|&l| m.links[l].role == Role::Output)
        .unwrap();
    m.edit().loads.forces.push(ExternalForce {
        states: None,
        link: output,
        point: vector([draw(), draw(), draw()]),
        force: vector([20.0 * draw() - 10.0, 20.0 * draw(), 5.0 - 10.0 * draw()]),
        range: None,
    });
}

/// Greatest force, or moment about a far point, left over on a link, over the greatest load: summed up from the file.
fn left_over(m: &Mechanism, list: &[JointReaction]) -> f64 {
    let metres = m.length_unit.metres;
    let place = |p: &[Expr; 3]| to_vector(p).map(|x| x * metres);
    let about = [0.3, -0.2, 0.5];
    let planar = matches!(m.mode, Mode::Planar { .. });
    let (mut worst, mut greatest) = (0.0f64, 1e-300f64);
    let loaded = |l: LinkId| !matches!(m.links[l].role, Role::Frame | Role::Object);
    for l in m.link_ids().filter(|&l| loaded(l)) {
        let mut sum = [0.0; 6];
        let mut add = |sign: f64, p: [f64; 3], f: [f64; 3], moment: [f64; 3]| {
            let turn = cross([0, 1, 2].map(|i| p[i] - about[i]), f);
            for i in 0..3 {
                sum[i] += sign * f[i];
                sum[3 + i] += sign * (turn[i] + moment[i]);
                greatest = greatest.max(f[i].abs());
            }
        };
        if let (Some(g), Some(mass)) = (&m.loads.gravity, &m.links[l].mass) {
            let weight = to_vector(g).map(|x| x * mass.mass);
            add(1.0, place(&mass.centre), weight, [0.0; 3]);
        }
        for f in m.loads.forces.iter().filter(|f| f.link == l) {
            add(1.0, place(&f.point), to_vector(&f.force), [0.0; 3]);
        }
        for x in m.loads.moments.iter().filter(|x| x.link == l) {
            add(1.0, [0.0; 3], [0.0; 3], to_vector(&x.moment));
        }
        for r in list {
            let [a, b] = m.joints[r.joint].links;
            for (link, sign) in [(a, -1.0), (b, 1.0)] {
                if link == l {
                    add(sign, r.point, r.global_force(), r.global_moment());
                }
            }
        }
        // In planar mode, what is across the plane is not modelled.
        let kept: &[usize] = if planar {
            &[0, 1, 5]
        } else {
            &[0, 1, 2, 3, 4, 5]
        };
        worst = kept.iter().fold(worst, |w, &i| w.max(sum[i].abs()));
    }
    worst / greatest
}

pub(crate) fn greatest_force(list: &[JointReaction]) -> f64 {
    list.iter()
        .map(JointReaction::force_size)
        .fold(0.0, f64::max)
}

/// What the first drive bears.
pub(crate) fn effort(list: &[JointReaction]) -> f64 {
    list.iter().find_map(|r| r.effort).unwrap().1
}

fn solve(m: &Mechanism) -> Solution {
    Reactions::solve_at_home(m, StateId::FREE, &m.loads).unwrap()
}

/// Mechanisms of one drive that holds them.
const SOLVED: &str = "
    four-bar-planar slider-crank-determinate slider-crank-spatial four-bar bennett gripper-10
    parallelogram-3-rods-planar rsur gripper-10-planar";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// What the drive bears follows: the virtual work of all wrenches is that of the loads. Of what equilibrium leaves open the least is
    /// taken, which has no part along any self-stress.
    #[test]
    fn every_link_is_in_equilibrium_and_joints_do_no_work(
        name in select(split_words(SOLVED)),
        seed in prop::collection::vec(0.0..1.0f64, 11..40),
    ) {
        let mut m = built_in(name);
        let planar = matches!(m.mode, Mode::Planar { .. });
        with_masses(&mut m, &seed);
        let s = solve(&m);
        prop_assert!(s.residual < 1e-10, "{}: {}", m.name, s.residual);
        prop_assert!(left_over(&m, &s.reactions) < 1e-10, "{}", m.name);
        prop_assert_eq!(s.choice == Uniqueness::Unique, s.self_stresses.is_empty());
        let greatest = greatest_force(&s.reactions);
        for r in &s.reactions {
            let moment = r.moment.map(|x| x / s.size);
            for f in m.joints[r.joint].joint_type.freedoms() {
                let work = match f {
                    Freedom::Rx => moment[0],
                    Freedom::Ry => moment[1],
                    Freedom::Rz => moment[2],
                    Freedom::Tx => r.force[0],
                    Freedom::Ty => r.force[1],
                    Freedom::Tz => r.force[2],
                    Freedom::Screw => continue,
                };
                let held = r.effort.is_some_and(|(d, _)| d == *f);
                let none = work.abs() < 1e-9 * greatest;
                prop_assert!(held || planar || none, "{} {f:?}: {work}", m.joints[r.joint].id);
            }
        }
        for stress in &s.self_stresses {
            let both = s.reactions.iter().zip(stress);
            let along = both.map(|(r, q)| dot(r.force, q.force) + dot(r.moment, q.moment) / (s.size * s.size));
            prop_assert!(along.sum::<f64>().abs() < 1e-7 * greatest * greatest_force(stress).max(1.0));
        }
    }

    /// Turned about an axis and moved, in another unit of length, each joint's reaction in its own frame is the same.
    #[test]
    fn reactions_do_not_depend_on_the_frame(name in select(split_words(SOLVED)), seed in prop::collection::vec(0.0..1.0f64, 11..40)) {
        let mut m = built_in(name);
        prop_assume!(!matches!(m.mode, Mode::Planar { .. }));
        with_masses(&mut m, &seed);
        let before = solve(&m);
        let after = solve(&turned_and_moved(&m, [3.0, -7.0, 2.0]));
        let greatest = greatest_force(&before.reactions);
        for (x, y) in before.reactions.iter().zip(&after.reactions) {
            for i in 0..3 {
                prop_assert!((x.force[i] - y.force[i]).abs() < 1e-7 * greatest, "{} {:?} {:?}", m.name, x, y);
                prop_assert!((x.moment[i] - y.moment[i]).abs() < 1e-7 * greatest * before.size);
            }
        }
        prop_assert!((before.condition - after.condition).abs() < 1e-6 * before.condition);
    }
}

#[test]
fn loads_on_a_motion_that_nothing_holds_are_told_with_the_link() {
    // Ball joints at both ends of the rod 5 let it spin; a moment along it turns it.
    let mut m = built_in("gripper-10-redesign");
    with_masses(&mut m, &[0.3, 0.9, 0.1, 0.7, 0.45, 0.62, 0.21]);
    match Reactions::solve_at_home(&m, StateId::FREE, &m.loads) {
        Err(Unsolved::Moves { link, mobility }) => {
            assert!(["5", "9"].contains(&link.as_str()), "{link}");
            assert_eq!(mobility, 2);
        }
        other => panic!("{other:?}"),
    }
    // Without loads on the rods all is well, and the spin is told.
    for l in ["5", "9"] {
        let l = m.link_named(l).unwrap();
        m.edit().links[l].mass = None;
    }
    let s = solve(&m);
    assert_eq!(s.undriven, 2);
    assert_eq!(s.self_stresses.len(), 1);
    assert!(left_over(&m, &s.reactions) < 1e-10);
}

/// A ball on two props that leave it one motion: its drive holds the turn that moves, and that turn stays the same when its axes
/// are squared up on the way.
#[test]
fn the_drive_of_a_ball_holds_its_own_turn() {
    let solve = |moment: &str| {
        let joints = "
            B | 0 a | spherical | 0, 0, 5 | 0, 0, 1 | reference = [1, 0, 0]\\ndrive = true
            S | 0 a | custom | 0, 0, 0 | 0, 0, 1 | freedoms = [\"rx\", \"rz\", \"tz\"]\\nreference = [1, 0, 0]";
        let load = format!("[[workload.moment]]\nlink = \"a\"\nmoment = {moment}\n");
        let text = write_mechanism("name = \"ball\"", "0 a*", joints) + &load;
        let m = read(&text);
        let found = ozols::statics::reactions::solve_cycle(
            &m,
            StateId::FREE,
            None,
            ozols::statics::reactions::Contacts::AsJoints,
        )
        .unwrap();
        found.positions[0].1.clone().unwrap()
    };
    for (moment, torque) in [("[0, 0, 1]", -1.0), ("[0, 1, 0]", 0.0)] {
        let found = solve(moment);
        let (freedom, effort) = found.reactions[0].effort.unwrap();
        assert_eq!(freedom.name(), "rz");
        assert!((effort - torque).abs() < 1e-12, "{moment}: {effort}");
        assert_eq!(found.self_stresses.len(), 1, "{moment}");
        // Forces along x of both, and the moment about y that the second holds.
        let open = [
            [true, false, false, false, false, false],
            [true, false, false, false, true, false],
        ];
        assert_eq!(found.open, open, "{moment}");
    }
}

/// Axes that differ by less than numbers tell are not passed over in silence.
#[test]
fn nearly_equal_axes_are_told() {
    let with = |tilt: &str| {
        let joints = format!(
            "B | 0 a | revolute | 0, 0, 5 | 0, 0, 1
             S | 0 a | revolute | 0, 0, 0 | \"{tilt}\", 0, 1"
        );
        let text = write_mechanism("name = \"near\"", "0 a*", &joints);
        let (_folder, path) = write_temporary("near.toml", text);
        run_quiet(&["statics", path, "--spatial"])
    };
    let said = with("1/10000000000");
    has(
        &said,
        "NOT DECIDED BY NUMBERS: in exact geometry there are 4 self-stresses",
    );
    for clear in ["0", "1/10"] {
        assert!(!with(clear).contains("NOT DECIDED"), "{clear}");
    }
}
