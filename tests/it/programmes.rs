//! Programmes of swings, and their long run.

use crate::common::near;
use ozols::drive::programme::{Endurance, Module};
use ozols::drive::swing::{Disc, End, Feed, Latch};
use ozols::model::drive::Step;

fn module(viscous: f64, coulomb: f64, feed: f64) -> Module {
    let disc = |inertia| Disc {
        inertia,
        stiffness: 14.0,
        viscous,
        coulomb,
    };
    Module {
        discs: [disc(0.23), disc(0.11)],
        latch: Latch {
            at: 0.8,
            capture: 0.02,
        },
        feed: Feed {
            energy: feed,
            from: 0.0,
        },
    }
}

/// [Klyuchkovskyi 1999]: discs that take turns both step on the same way by 2φ0; one disc goes to and fro.
#[test]
fn taking_turns_steps_on_and_one_disc_reverses() {
    let m = module(0.0, 0.0, 0.0);
    let turns: Vec<Step> = (0..6).map(|i| Step::Swing((i + 1) % 2)).collect();
    let run = m.run(&turns).unwrap();
    assert!(run.complete());
    near(run.angles[0], 0.8 + 3.0 * 1.6, 1e-9);
    near(run.angles[1], 3.0 * 1.6, 1e-9);
    let run = m
        .run(&[
            Step::Swing(1),
            Step::Dwell(0.3),
            Step::Swing(1),
            Step::Swing(1),
        ])
        .unwrap();
    near(run.angles[0], 0.8, 0.0);
    near(run.angles[1], 1.6, 1e-9);
    assert_eq!(run.steps[2].start, run.steps[0].duration + 0.3);
    // Unequal discs keep the bar's energy and their own times.
    let times: Vec<f64> = m
        .run(&turns)
        .unwrap()
        .swings()
        .map(|(_, s)| s.duration)
        .collect();
    near(times[1] / times[0], (0.23f64 / 0.11).sqrt(), 1e-7);
}

/// Without friction the energy of a run is that of the wound bar at all times, to 1e-9.
#[test]
fn energy_of_a_run_is_conserved() {
    let m = module(0.0, 0.0, 0.0);
    let run = m
        .run(&[
            Step::Swing(1),
            Step::Swing(0),
            Step::Dwell(1.0),
            Step::Swing(0),
            Step::Swing(1),
        ])
        .unwrap();
    for s in m.samples(&run, 50) {
        near((s.potential + s.kinetic) / (14.0 * 0.32), 1.0, 1e-9);
    }
}

/// With friction, what a run stores at its end is what it had, plus what was fed, less what was lost.
#[test]
fn energy_of_a_run_balances() {
    let m = module(0.02, 0.1, 0.37);
    let run = m
        .run(&[
            Step::Swing(1),
            Step::Swing(0),
            Step::Swing(1),
            Step::Swing(1),
        ])
        .unwrap();
    assert!(run.complete());
    let mut had = 14.0 * 0.32;
    for (_, s) in run.swings() {
        let b = s.balance;
        near(b.initial, had, 1e-9);
        near(b.residual(), 0.0, 1e-9);
        had = b.stored;
    }
}

/// A cam that gives what is needed goes on for ever; one that gives what a swing without it lost, equation (12), loses ground.
#[test]
fn the_long_run_tells_enough_from_too_little() {
    let m = module(0.02, 0.1, 0.0);
    let need = m.discs[0].needed_feed(m.latch, 0.0).unwrap().unwrap();
    let fed = |energy| Module {
        feed: Feed { energy, from: 0.0 },
        ..m
    };
    assert!(
        matches!(fed(1.001 * need).endurance(&[0]).unwrap(), Endurance::Lasts { missing } if missing == 0.0)
    );
    let Endurance::Fails { after } = fed(0.97 * need).endurance(&[0]).unwrap() else {
        panic!()
    };
    // A run of as many swings is latched, and one more is not.
    let latched = |n: usize| {
        fed(0.97 * need)
            .run(&vec![Step::Swing(0); n])
            .unwrap()
            .latched
    };
    assert_eq!((latched(after), latched(after + 1)), (after, after));
    // Viscous damping alone takes less from a smaller swing: with much capture, swings settle short of the latch.
    let soft = Module {
        latch: Latch {
            at: 0.8,
            capture: 0.4,
        },
        ..module(0.05, 0.0, 0.3)
    };
    assert!(
        matches!(soft.endurance(&[0]).unwrap(), Endurance::Lasts { missing } if missing > 0.02)
    );
    // Two discs of different inertia that take turns end up repeating as well.
    let both = Module {
        feed: Feed {
            energy: 1.2 * need,
            from: 0.0,
        },
        ..m
    };
    assert!(matches!(
        both.endurance(&[0, 1]).unwrap(),
        Endurance::Lasts { .. }
    ));
}

#[test]
fn a_missed_latch_ends_the_run() {
    let m = module(0.05, 0.1, 0.0);
    let run = m
        .run(&[Step::Swing(1), Step::Swing(0), Step::Swing(1)])
        .unwrap();
    assert!(!run.complete() && run.steps.len() < 3 + 1);
    assert!(matches!(
        run.swings().last().unwrap().1.end,
        End::Missed { .. }
    ));
}

/// The same run by a plain integrator in absolute angles, grooves and cam fixed on each disc: where each swing ends.
fn by_steps(m: &Module, turns: &[usize]) -> Vec<f64> {
    let (phi, push) = (m.latch.at, m.feed.energy / (m.latch.at - m.feed.from));
    let (mut at, mut groove, mut out) = ([phi, 0.0], [phi, 0.0f64], Vec::new());
    for &d in turns {
        let (disc, o) = (&m.discs[d], 1 - d);
        let way = (groove[o] - groove[d]).signum();
        let (pushed_from, target) = (
            groove[d] + way * (phi + m.feed.from),
            groove[d] + way * 2.0 * phi,
        );
        let moment = |x: f64, v: f64| {
            let cam = if way * (x - pushed_from) >= 0.0 {
                push
            } else {
                0.0
            };
            way * (cam - disc.coulomb) - disc.stiffness * (x - at[o]) - disc.viscous * v
        };
        let (mut x, mut v, h) = (at[d], 0.0, 2e-6);
        loop {
            // The middle of a step carries it: an error of second order.
            let half = v + h / 2.0 * moment(x, v) / disc.inertia;
            let speed = v + h * moment(x + h / 2.0 * v, half) / disc.inertia;
            if way * speed <= 0.0 {
                break;
            }
            (x, v) = (x + h * half, speed);
            if way * (x - target) >= 0.0 {
                x = target;
                break;
            }
        }
        (at[d], groove[d]) = (x, target);
        out.push(x);
        if way * (target - x) > m.latch.capture {
            break;
        }
    }
    out
}

/// Grooves are on the discs: what one swing falls short, the next begins with. The built-in module with too weak a cam.
#[test]
fn shortfalls_add_up_against_grooves_that_stay() {
    let text = ozols::builtin::text("torsion-module").unwrap();
    let file =
        ozols::file::read::workload::drive_from_bytes("torsion-module.toml", text.as_bytes())
            .unwrap();
    let built_in = ozols::drive::driving::drive(&file.spec)
        .unwrap()
        .design
        .unwrap()
        .module;
    let reversing = vec![1; 40];
    let stepwise: Vec<usize> = (0..40).map(|i| (i + 1) % 2).collect();
    for (feed, turns, most) in [
        (0.306, &stepwise, 14),
        (0.3012, &stepwise, 7),
        (0.306, &reversing, 40),
    ] {
        let m = Module {
            feed: Feed {
                energy: feed,
                from: 0.0,
            },
            ..built_in
        };
        let steps: Vec<Step> = turns.iter().map(|&d| Step::Swing(d)).collect();
        let run = m.run(&steps).unwrap();
        let slow = by_steps(&m, turns);
        assert_eq!(run.steps.len(), most, "feed {feed}");
        assert_eq!(slow.len(), most, "feed {feed}");
        for (n, (step, slow)) in run.steps.iter().skip(1).zip(&slow).enumerate() {
            near(step.angles[turns[n]], *slow, 1e-4);
        }
        near(run.angles[turns[most - 1]], slow[most - 1], 1e-4);
        // The last swing's shortfall is against its groove, and as far as the disc is from it.
        let (End::Caught { missing } | End::Missed { missing }) =
            run.swings().last().unwrap().1.end
        else {
            panic!("feed {feed}")
        };
        let groove = (run.angles[turns[most - 1]] / m.latch.at).round() * m.latch.at;
        near((groove - run.angles[turns[most - 1]]).abs(), missing, 1e-12);
        assert_eq!(missing > m.latch.capture, most < 40);
    }
}
