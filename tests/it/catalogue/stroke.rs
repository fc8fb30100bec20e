//! The stroke of a task: every figure of it against poses solved afresh, and what is said where it is not reached.

use super::paired::twin_figures::WorkedOut;
use super::paired::twin_figures::filed::{Gripper, To};
use super::{Drawn, each_structure, each_structure_of, form_of, layout};
use crate::common::*;
use ozols::chains::Symmetry;
use ozols::file::write;
use ozols::synthesis::mechanism::mechanism_file;
use ozols::synthesis::stroke::walk::StrokeEnd;
use ozols::synthesis::task::AskedMotion;

/// Returns the gripper of a layout, read from its mechanism file.
pub(super) fn read_layout(s: &Structure, l: &Drawn) -> Gripper {
    let menu = Spec::default().option_menu().unwrap();
    let file = mechanism_file(s, l, &menu, &Workload::default());
    Gripper::read(&write::toml(&file).unwrap())
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
    let f = layout_figures(s, l).unwrap();
    let task = &l.limits.task;
    assert_eq!(f.openings, [task.narrowest, task.widest], "{f:?}");
    let twin = read_layout(s, l);
    let found = WorkedOut::new(&twin, f.openings);
    near(f.travel, found.travel, 1e-6 * f.travel, "travel", s);
    let metre = if s.drive_input() == Input::Slide {
        1.0
    } else {
        1000.0
    };
    let [least, most] = found.forces.map(|x| metre * x);
    near(f.force[0], least, 0.01 * least, "least force", s);
    near(f.force[2], most, 0.01 * most, "greatest force", s);
    let mean = metre * f.travel / (s.structure.roles.jaws.len() as f64 / 2.0) / task.opening_span();
    near(f.force[1], mean, 1e-6 * mean, "mean force", s);
    for (told, found) in f.turns.iter().zip(&found.turns) {
        near(*told, *found, 2e-3, "turn", s);
    }
    for (told, found) in f.size.iter().zip(found.size) {
        near(*told, found, 0.1, "size", s);
    }
    let peak = found.peak.0;
    near(f.forces.peak, peak, 0.02 * peak, "joint force", s);
    near(f.transmission, found.transmission.0, 1.0, "transmission", s);
    near(
        f.forces.efficiency,
        found.efficiency.0,
        5e-3,
        "efficiency",
        s,
    );
    // How far the twin's figures keep the limits. Close to a limit, either verdict is right.
    let kept = [
        found.transmission.0 / task.transmission,
        task.pin_force / peak,
        found.efficiency.0 / task.efficiency,
        task.force_ratio * least / most,
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

/// How far apart the tips come as the drive goes on, until they turn back. Longer steps jump to another assembly near such a place.
fn widest(twin: &Gripper) -> f64 {
    let mut x = twin.drawn();
    let (mut most, mut drive, mut step) = (twin.width(&x), 0.0, 0.1 * twin.seen(x.clone()).drive());
    // Where they turn back, links may lock soon after.
    while step.abs() > 1e-6 {
        let (mut y, to) = (x.clone(), drive + step);
        if !twin.fits(&mut y, To::Drive(to)) {
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

#[test]
fn strokes_of_two_jaws_are_as_the_twin_says() {
    let forms = [
        form_of(Input::Slide, Symmetry::Generic, false),
        form_of(Input::Turn, Symmetry::Generic, false),
        form_of(Input::Slide, Symmetry::Mirror, false),
        form_of(Input::Turn, Symmetry::HalfTurn, false),
    ];
    let (mut n, mut tried) = (0, [0; 2]);
    for of in forms {
        each_structure(6, &[of], |_, s| {
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
    let threefold = [form_of(Input::Turn, Symmetry::Threefold, false)];
    let mut tried = 0;
    each_structure_of(8, 3, &threefold, |_, s| {
        if let Ok(l) = layout(&s, &Limits::default(), 1) {
            is_as_the_twin_says(&s, &l);
            tried += 1;
        }
    });
    assert_eq!(tried, 2);
}

fn made_for(task: Task) -> Limits {
    default_with(|l: &mut Limits| l.task = task)
}

/// Nearly every structure that can move does its task, by figures that the twin above confirms.
#[test]
fn nearly_all_do_their_task() {
    let mirror = [false, true].map(|parallel| form_of(Input::Slide, Symmetry::Mirror, parallel));
    let generic = [Input::Slide, Input::Turn].map(|i| form_of(i, Symmetry::Generic, false));
    let (mut all, mut doing, mut n) = (0, 0, 0);
    for (links, forms, every) in [
        (6, &mirror[..], 1),
        (8, &mirror, 1),
        (6, &generic, 2),
        (10, &mirror, 40),
    ] {
        each_structure(links, forms, |_, s| {
            n += 1;
            if n % every != 0 {
                return;
            }
            if let Ok(l) = layout(&s, &Limits::default(), 1) {
                all += 1;
                let f = layout_figures(&s, &l).unwrap();
                doing += usize::from(f.shortfall.is_none() && f.force[2] <= 3.0 * f.force[0]);
            }
        });
    }
    assert!(all > 40 && 100 * doing >= 95 * all, "{doing} of {all}");
}

/// Asked for more than links of this size can do, many do not; each says why, and the twin finds the end where it is said.
#[test]
fn what_is_not_reached_is_said() {
    let limits = made_for(default_with(|t: &mut Task| t.widest = 190.0));
    let generic = [form_of(Input::Turn, Symmetry::Generic, false)];
    let (mut n, mut short, mut turned) = (0, 0, 0);
    each_structure(6, &generic, |_, s| {
        n += 1;
        if n % 5 != 0 {
            return;
        }
        let Ok(l) = layout(&s, &limits, 1) else {
            return;
        };
        let f = layout_figures(&s, &l).unwrap();
        for (k, asked) in [0.0, 190.0].into_iter().enumerate() {
            assert_eq!(f.ends[k].is_some(), f.openings[k] != asked, "{f:?}");
            if f.ends[k].is_some() {
                assert_eq!(f.margin[k], 0.0);
                let said = f.shortfall.as_ref().unwrap().to_string();
                has_all(&said, &[" mm required", ": there "]);
                short += 1;
            }
            if k == 1 && f.ends[k] == Some(StrokeEnd::JawsTurnBack) {
                near(f.openings[1], widest(&read_layout(&s, &l)), 0.05, "end", &s);
                turned += 1;
            }
        }
    });
    assert!(short > 0 && turned > 0, "{short} {turned}");
}

/// Other tasks: the drawn tips stand within the stroke, parallel jaws do not turn, and what they are made for they do.
#[test]
fn other_tasks_are_done_as_well() {
    let wide = default_with(|t: &mut Task| (t.narrowest, t.widest) = (40.0, 70.0));
    assert_eq!(wide.half_opening(), 28);
    let parallel = default_with(|t: &mut Task| t.motion = AskedMotion::Parallel);
    // Jaws on parallelograms that open by 50 mm have less than 25 degrees at the ends of their stroke: 17.9 and 19.9.
    let on_long_rods = Task {
        transmission: 15.0,
        ..parallel
    };
    let swinging = default_with(|t: &mut Task| t.motion = AskedMotion::Swinging);
    let tight = default_with(|t: &mut Task| t.room = [150.0, 100.0]);
    let generic = form_of(Input::Slide, Symmetry::Generic, false);
    let on_parallelograms = form_of(Input::Turn, Symmetry::Generic, true);
    for (task, of, every) in [
        (wide, generic, 6),
        (parallel, generic, 13),
        (on_long_rods, on_parallelograms, 1),
        (swinging, generic, 6),
        (tight, generic, 6),
    ] {
        let (mut n, mut does) = (0, 0);
        each_structure(6, &[of], |_, s| {
            n += 1;
            if n % every != 0 {
                return;
            }
            let Ok(l) = layout(&s, &made_for(task), 1) else {
                return;
            };
            let f = layout_figures(&s, &l).unwrap();
            let swings = |&j: &usize| s.structure.chain.is_joined(s.structure.roles.frame, j);
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
