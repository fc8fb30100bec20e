//! The stroke of a task: every figure of it against poses solved afresh, and what is said where it is not reached.

use super::dense_twin::{Pose, Twin, carrier, place};
use super::{Drawn, each, each_of, form, layout};
use ozols::chains::{Input, Symmetry};
use ozols::synthesis::figures::{LayoutFigures, figures};
use ozols::synthesis::stroke::walk::StrokeEnd;
use ozols::synthesis::structure::Structure;
use ozols::synthesis::task::{AskedMotion, Friction, Limits, Task};

/// Poses at which a stroke is looked at.
const POSES: usize = 60;

/// The poses of a stroke, from the narrowest part to the widest, each with its drive.
pub(super) fn poses(twin: &Twin<'_>, f: &LayoutFigures) -> Vec<(f64, Pose)> {
    // The drive at both ends, by halving: a way on and back from the drawn pose.
    let end = |sign: f64, to: f64| -> f64 {
        let (mut x, mut drive, mut step) = (twin.drawn(), 0.0, sign * f.travel / 40.0);
        while step.abs() > 1e-9 * f.travel {
            let mut y = x.clone();
            twin.solve(&mut y, drive + step, None);
            let beyond = if sign == f.closes {
                twin.width(&y) < to
            } else {
                twin.width(&y) > to
            };
            if beyond {
                step /= 2.0;
            } else {
                (x, drive) = (y, drive + step);
            }
        }
        drive
    };
    let ends = [end(f.closes, f.openings[0]), end(-f.closes, f.openings[1])];
    let mut out = Vec::new();
    for (n, to) in ends.into_iter().enumerate() {
        let mut x = twin.drawn();
        for i in 0..=POSES / 2 {
            let drive = to * i as f64 / (POSES / 2) as f64;
            twin.solve(&mut x, drive, None);
            if i > 0 || n == 0 {
                out.push((drive, x.clone()));
            }
        }
    }
    out
}

/// Least and greatest.
fn between(all: impl Iterator<Item = f64>) -> [f64; 2] {
    all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| {
        [a.min(x), b.max(x)]
    })
}

/// The poses next to one, a little on and back, and how much the drive goes between them.
fn beside(twin: &Twin<'_>, drive: f64, x: &Pose) -> ([Pose; 2], f64) {
    let h = if twin.slides() { 1e-4 } else { 2e-6 };
    let both = [-h, h].map(|h| {
        let mut y = x.clone();
        twin.solve(&mut y, drive + h, None);
        y
    });
    (both, 2.0 * h)
}

/// The worst of joint forces at poses: the greatest, the transmission angle by forces and by rods, and the efficiency.
fn worst(twin: &Twin<'_>, all: &[(f64, Pose)], friction: &Friction) -> [f64; 3] {
    let (s, l) = (twin.s, twin.l);
    let r = &s.structure.roles;
    let (mut peak, mut angle, mut efficiency) = (0.0_f64, 90.0_f64, 1.0_f64);
    for (drive, x) in all {
        let ([back, ahead], _) = beside(twin, *drive, x);
        let size = |v: [f64; 2]| v[0].hypot(v[1]);
        let way = |link: usize, p: [f64; 2]| {
            let (a, b) = (place(&back, link, p), place(&ahead, link, p));
            [b[0] - a[0], b[1] - a[1]]
        };
        let given = twin.work(&back, &ahead).abs();
        let forces: Vec<[f64; 2]> = (0..l.pins.len())
            .map(|i| twin.joint(x, *drive, i))
            .collect();
        let mut lost = 0.0;
        for (i, &(u, v)) in l.pins.iter().enumerate() {
            if twin.slides() && twin.is_input(i) {
                let [across, moment] = forces[i].map(f64::abs);
                peak = peak.max(across);
                let press = across.max(2.0 * moment / friction.guide);
                lost += friction.coefficient * press * size(way(r.drive()[1], l.at[i].real()));
                continue;
            }
            peak = peak.max(size(forces[i]));
            let turn = |y: &Pose| y[3 * u] - y[3 * v];
            let turned = (turn(&ahead) - turn(&back)).abs();
            lost += friction.coefficient * friction.pin_radius * size(forces[i]) * turned;
        }
        efficiency = efficiency.min(given / (given + lost));
        let could = |link: usize| -> f64 {
            let pins = l.pins.iter().enumerate();
            let own = pins.filter(|(i, (u, v))| {
                (*u == link || *v == link) && !(twin.slides() && twin.is_input(*i))
            });
            own.map(|(i, _)| size(forces[i]) * size(way(link, l.at[i].real())))
                .sum()
        };
        let mut passed = |work: f64, link: usize| {
            angle = angle.min((work / could(link)).min(1.0).asin().to_degrees());
        };
        passed(given, r.drive()[1]);
        for (n, o) in twin.outward().iter().enumerate() {
            let w = way(r.jaws[n], l.tips[n].real());
            passed((w[0] * o[0] + w[1] * o[1]).abs(), r.jaws[n]);
        }
        angle = angle.min(rods(twin, &back, &ahead, x));
    }
    [peak, angle, efficiency]
}

/// The least angle of the rods at a pose, in degrees.
fn rods(twin: &Twin<'_>, back: &Pose, ahead: &Pose, x: &Pose) -> f64 {
    let (s, l) = (twin.s, twin.l);
    let mut least = 90.0_f64;
    for link in 0..s.structure.chain.links() {
        let r = &s.structure.roles;
        let pins = l.pins.iter().zip(&l.at);
        let own: Vec<[f64; 2]> = pins
            .filter(|((u, v), _)| *u == link || *v == link)
            .map(|(_, p)| p.real())
            .collect();
        let other = link == r.frame || link == r.drive()[1] || r.jaws.contains(&link);
        let (false, [a, b]) = (other, &own[..]) else {
            continue;
        };
        let way = |p: &[f64; 2]| {
            let (a, b) = (place(back, link, *p), place(ahead, link, *p));
            [b[0] - a[0], b[1] - a[1]]
        };
        let size = |v: [f64; 2]| v[0].hypot(v[1]);
        let (va, vb) = (way(a), way(b));
        let (fast, slow) = if size(va) > size(vb) {
            (va, vb)
        } else {
            (vb, va)
        };
        if size(slow) < 1e-5 * size(fast) {
            continue;
        }
        let (a, b) = (place(x, link, *a), place(x, link, *b));
        let rod = [b[0] - a[0], b[1] - a[1]];
        let sine = (rod[0] * fast[0] + rod[1] * fast[1]).abs() / size(rod) / size(fast);
        least = least.min(sine.min(1.0).asin().to_degrees());
    }
    least
}

fn near(told: f64, found: f64, within: f64, what: &str, s: &Structure) {
    assert!(
        (told - found).abs() <= within,
        "{}: {what}: told {told}, found {found}",
        s.name()
    );
}

/// All figures of a layout that does its task, by the twin.
fn is_as_the_twin_says(s: &Structure, l: &Drawn) {
    let f = figures(s, l).unwrap();
    let task = &l.limits.task;
    assert_eq!(f.openings, [task.narrowest, task.widest], "{f:?}");
    let twin = Twin { s, l };
    let all = poses(&twin, &f);
    let drives = between(all.iter().map(|(d, _)| *d));
    near(
        f.travel,
        drives[1] - drives[0],
        1e-6 * f.travel,
        "travel",
        s,
    );
    let metre = if twin.slides() { 1.0 } else { 1000.0 };
    let force = |(drive, x): &(f64, Pose)| {
        let ([back, ahead], by) = beside(&twin, *drive, x);
        metre * by / twin.work(&back, &ahead).abs()
    };
    let forces = between(all.iter().map(force));
    near(f.force[0], forces[0], 0.01 * forces[0], "least force", s);
    near(f.force[2], forces[1], 0.01 * forces[1], "greatest force", s);
    let mean = metre * f.travel / (s.structure.roles.jaws.len() as f64 / 2.0) / task.span();
    near(f.force[1], mean, 1e-6 * mean, "mean force", s);
    for (n, &jaw) in s.structure.roles.jaws.iter().enumerate() {
        let [least, most] = between(all.iter().map(|(_, x)| x[3 * jaw]));
        near(f.turns[n], most - least, 2e-3, "turn", s);
    }
    let points = |x: &Pose| {
        let pins = l.pins.iter().zip(&l.at);
        let pins = pins.map(|(&pin, p)| place(x, carrier(s, pin), p.real()));
        pins.chain(twin.tips(x)).collect::<Vec<_>>()
    };
    for k in 0..2 {
        let [least, most] = between(all.iter().flat_map(|(_, x)| points(x)).map(|p| p[k]));
        near(f.size[k], most - least, 0.1, "size", s);
    }
    let [peak, angle, efficiency] = worst(&twin, &all, &task.friction);
    near(f.forces.peak, peak, 0.02 * peak, "joint force", s);
    near(f.transmission, angle, 1.0, "transmission", s);
    near(f.forces.efficiency, efficiency, 5e-3, "efficiency", s);
    // By how much of each limit the twin's figures keep it, the worst of them; so near to a limit as figures differ either is right.
    let kept = [
        angle / task.transmission,
        task.pin_force / peak,
        efficiency / task.efficiency,
        task.force_ratio * forces[0] / forces[1],
    ];
    let worst = kept.into_iter().fold(f64::INFINITY, f64::min) - 1.0;
    let does = f.shortfall.is_none();
    assert!(
        worst.abs() < 0.04 || does == (worst > 0.0),
        "{}: {worst}, {:?}",
        s.name(),
        f.shortfall
    );
}

#[test]
fn strokes_of_two_jaws_are_as_the_twin_says() {
    let forms = [
        form(Input::Slide, Symmetry::Generic, false),
        form(Input::Turn, Symmetry::Generic, false),
        form(Input::Slide, Symmetry::Mirror, false),
        form(Input::Turn, Symmetry::HalfTurn, false),
    ];
    let (mut n, mut tried) = (0, [0; 2]);
    for of in forms {
        each(6, &[of], |_, s| {
            n += 1;
            if of.1.symmetry == Symmetry::Generic && n % 9 != 0 {
                return;
            }
            if let Ok(l) = layout(&s, &Limits::default(), 1) {
                is_as_the_twin_says(&s, &l);
                tried[usize::from(of.0 == Input::Slide)] += 1;
            }
        });
    }
    assert!(tried[0] > 4 && tried[1] > 4, "{tried:?}");
}

#[test]
fn strokes_of_three_jaws_are_as_the_twin_says() {
    let threefold = [form(Input::Turn, Symmetry::Threefold, false)];
    let mut tried = 0;
    each_of(8, 3, &threefold, |_, s| {
        if let Ok(l) = layout(&s, &Limits::default(), 1) {
            is_as_the_twin_says(&s, &l);
            tried += 1;
        }
    });
    assert_eq!(tried, 2);
}

fn made_for(task: Task) -> Limits {
    Limits {
        task,
        ..Limits::default()
    }
}

/// Nearly every structure that can move does its task, by figures that the twin above confirms.
#[test]
fn nearly_all_do_their_task() {
    let mirror = [false, true].map(|parallel| form(Input::Slide, Symmetry::Mirror, parallel));
    let generic = [Input::Slide, Input::Turn].map(|i| form(i, Symmetry::Generic, false));
    let (mut all, mut doing, mut n) = (0, 0, 0);
    for (links, forms, every) in [
        (6, &mirror[..], 1),
        (8, &mirror, 1),
        (6, &generic, 2),
        (10, &mirror, 40),
    ] {
        each(links, forms, |_, s| {
            n += 1;
            if n % every != 0 {
                return;
            }
            if let Ok(l) = layout(&s, &Limits::default(), 1) {
                all += 1;
                let f = figures(&s, &l).unwrap();
                doing += usize::from(f.shortfall.is_none() && f.force[2] <= 3.0 * f.force[0]);
            }
        });
    }
    assert!(all > 40 && 100 * doing >= 95 * all, "{doing} of {all}");
}

/// Asked for more than links of this size can do, many do not; each says why, and the twin finds the end where it is said.
#[test]
fn what_is_not_reached_is_said() {
    let limits = made_for(Task {
        widest: 190.0,
        ..Task::default()
    });
    let generic = [form(Input::Turn, Symmetry::Generic, false)];
    let (mut n, mut short, mut turned) = (0, 0, 0);
    each(6, &generic, |_, s| {
        n += 1;
        if n % 5 != 0 {
            return;
        }
        let Ok(l) = layout(&s, &limits, 1) else {
            return;
        };
        let f = figures(&s, &l).unwrap();
        for (k, asked) in [0.0, 190.0].into_iter().enumerate() {
            assert_eq!(f.ends[k].is_some(), f.openings[k] != asked, "{f:?}");
            if f.ends[k].is_some() {
                assert_eq!(f.margin[k], 0.0);
                let said = f.shortfall.as_ref().unwrap().to_string();
                assert!(
                    said.contains(" mm where ") && said.contains(": there "),
                    "{said}"
                );
                short += 1;
            }
            if k == 1 && f.ends[k] == Some(StrokeEnd::JawsTurnBack) {
                near(f.openings[1], widest(&s, &l, &f), 0.05, "end", &s);
                turned += 1;
            }
        }
    });
    assert!(short > 0 && turned > 0, "{short} {turned}");
}

/// How far apart the tips come as the drive goes on, until they turn back.
fn widest(s: &Structure, l: &Drawn, f: &LayoutFigures) -> f64 {
    let twin = Twin { s, l };
    let (mut x, mut drive) = (twin.drawn(), 0.0);
    let (mut most, mut step) = (twin.width(&x), f.travel / 500.0);
    // Where they turn back, links may lock soon after.
    while step > 1e-6 * f.travel {
        let (mut y, to) = (x.clone(), drive - f.closes * step);
        if !twin.closes(&mut y, to, None) {
            step /= 2.0;
            continue;
        }
        let now = twin.width(&y);
        if now < most {
            return most;
        }
        (x, drive, most) = (y, to, now);
    }
    most
}

/// Other tasks: the drawn tips stand within the stroke, parallel jaws do not turn, and what they are made for they do.
#[test]
fn other_tasks_are_done_as_well() {
    let wide = Task {
        narrowest: 40.0,
        widest: 70.0,
        ..Task::default()
    };
    assert_eq!(wide.half_opening(), 28);
    let parallel = Task {
        motion: AskedMotion::Parallel,
        ..Task::default()
    };
    // Jaws on parallelograms that open by 50 mm have less than 25 degrees at the ends of their stroke: 17.9 and 19.9.
    let on_long_rods = Task {
        transmission: 15.0,
        ..parallel
    };
    let swinging = Task {
        motion: AskedMotion::Swinging,
        ..Task::default()
    };
    let tight = Task {
        room: [150.0, 100.0],
        ..Task::default()
    };
    let generic = form(Input::Slide, Symmetry::Generic, false);
    let on_parallelograms = form(Input::Turn, Symmetry::Generic, true);
    for (task, of, every) in [
        (wide, generic, 6),
        (parallel, generic, 13),
        (on_long_rods, on_parallelograms, 1),
        (swinging, generic, 6),
        (tight, generic, 6),
    ] {
        let (mut n, mut does) = (0, 0);
        each(6, &[of], |_, s| {
            n += 1;
            if n % every != 0 {
                return;
            }
            let Ok(l) = layout(&s, &made_for(task), 1) else {
                return;
            };
            let f = figures(&s, &l).unwrap();
            let swings = |&j: &usize| s.structure.chain.joined(s.structure.roles.frame, j);
            let hinged = s.structure.roles.jaws.iter().all(swings);
            if let Some(lacks) = f.shortfall {
                // Of those that close and open so far, without a hinge for each jaw, it is said that they do not swing.
                let says = lacks.to_string().contains("swing");
                assert!(
                    every != 13 || lacks.to_string().contains("parallel"),
                    "{lacks}"
                );
                assert!(
                    !says || (task.motion == AskedMotion::Swinging && !hinged),
                    "{lacks}"
                );
                return;
            }
            does += 1;
            assert_eq!(f.openings, [task.narrowest, task.widest]);
            let turn = f.turns.iter().fold(0.0_f64, |m, t| m.max(*t)).to_degrees();
            assert!(
                task.motion != AskedMotion::Parallel || turn <= 1.0,
                "{turn}"
            );
            assert!(task.motion != AskedMotion::Swinging || hinged);
            let room = |k: usize| task.room[k] == 0.0 || f.size[k] <= task.room[k];
            assert!(room(0) && room(1), "{f:?}");
        });
        // Without parallelograms few jaws keep their attitude; the others say by how much they turn.
        assert!(does > 0 || every == 13, "{task:?}");
    }
}
