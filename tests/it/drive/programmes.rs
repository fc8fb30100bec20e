//! Programmes of swings, and their long run.

use crate::common::*;
mod repeated;

use repeated::Bench;

use ozols::drive::driving::design_drive;
use ozols::drive::programme::Module;
use ozols::drive::swing::{Disc, End, Latch};
use ozols::model::drive::ProgrammeStep;

/// Two discs on a latch at 0.8 rad, fed over the whole way.
fn drive(inertias: [f64; 2], viscous: f64, coulomb: f64, capture: f64, feed: f64) -> Module {
    let disc = |inertia| Disc {
        inertia,
        stiffness: 14.0,
        viscous,
        coulomb,
    };
    Module {
        discs: inertias.map(disc),
        latch: Latch { at: 0.8, capture },
        feed: Feed {
            energy: feed,
            from: 0.0,
        },
    }
}

fn module(viscous: f64, coulomb: f64, feed: f64) -> Module {
    drive([0.23, 0.11], viscous, coulomb, 0.02, feed)
}

fn steps(discs: &[usize]) -> Vec<ProgrammeStep> {
    discs.iter().map(|&d| ProgrammeStep::Swing(d)).collect()
}

/// [Klyuchkovskyi 1999]: discs that take turns both step on the same way by 2φ0; one disc goes to and fro.
#[test]
fn taking_turns_steps_on_and_one_disc_reverses() {
    let m = module(0.0, 0.0, 0.0);
    let turns = steps(&[1, 0, 1, 0, 1, 0]);
    let run = m.run_programme(&turns).unwrap();
    assert!(run.is_complete());
    near(run.angles[0], 0.8 + 3.0 * 1.6, 1e-9);
    near(run.angles[1], 3.0 * 1.6, 1e-9);
    let waited = [
        &steps(&[1])[..],
        &[ProgrammeStep::Dwell(0.3)],
        &steps(&[1, 1]),
    ]
    .concat();
    let run = m.run_programme(&waited).unwrap();
    near(run.angles[0], 0.8, 0.0);
    near(run.angles[1], 1.6, 1e-9);
    assert_eq!(run.steps[2].start, run.steps[0].duration + 0.3);
    // Unequal discs keep the bar's energy and their own times.
    let run = m.run_programme(&turns).unwrap();
    let times = run.iter_swings().map(|(_, s)| s.duration).collect_vec();
    near(times[1] / times[0], (0.23f64 / 0.11).sqrt(), 1e-7);
}

/// Speeds and accelerations of a run by differences of its angles, with every kind of friction and the cam's push, for either
/// disc and either way.
#[test]
fn samples_move_as_their_rates_say() {
    let m = module(0.01, 0.1, 0.4);
    let run = m.run_programme(&steps(&[0, 1, 0, 0, 1])).unwrap();
    assert!(run.is_complete());
    const PER_SWING: u32 = 500;
    let samples = m.sample_run(&run, PER_SWING);
    let (mut off, mut seen) = (0, 0);
    for swing in samples.chunks_exact(PER_SWING as usize + 1) {
        for w in swing.windows(3) {
            let step = w[1].time - w[0].time;
            for d in 0..2 {
                let by = |of: &dyn Fn(&ozols::drive::programme::RunMoment) -> f64| {
                    (of(&w[2]) - of(&w[0])) / (2.0 * step)
                };
                let speed = by(&|s| s.angles[d]);
                near(speed, w[1].speeds[d], 1e-3);
                // Friction stops and the push sets in at once: acceleration jumps there.
                let acceleration = by(&|s| s.speeds[d]);
                seen += 1;
                off += usize::from((acceleration - w[1].accelerations[d]).abs() > 1e-2);
            }
        }
    }
    assert!(off <= 3 * 5, "{off} of {seen}");
    let greatest = samples
        .iter()
        .flat_map(|s| s.accelerations.map(f64::abs))
        .fold(0.0, f64::max);
    assert!(greatest > 10.0, "{greatest}");
}

/// The acceleration of a payload is tangential p² φ and radial φ̇², each times its radius: greatest at the ends of a small swing
/// and in the middle of a great one.
#[test]
fn payloads_are_flung_outwards_in_great_swings() {
    for angle in [40, 90, 114, 116, 170] {
        let text = format!(
            "name = \"d\"\n[workload.drive]\nswing_angle = {angle}\nswing_time = 0.7\nshear_modulus = 8e10\n\
             allowable_stress = 6e8\ninertia = 0.2\npayload_radius = 0.4\n"
        );
        let file = drive_from_bytes("d.toml", text.as_bytes()).unwrap();
        let design = design_drive(&file.spec).unwrap().design.unwrap();
        let (twist, square) = (file.spec.twist, design.stiffness / 0.2);
        let size = |i: i32| {
            let at = twist * f64::from(i) / 1000.0;
            let speed = square * (twist * twist - at * at);
            0.4 * (square * at).hypot(speed)
        };
        let greatest = (0..=1000).map(size).fold(0.0, f64::max);
        let told = design.motions[0].acceleration.unwrap();
        assert!(
            (told / greatest - 1.0).abs() < 1e-9,
            "{angle}: {told} {greatest}"
        );
    }
}

/// The same run by a plain integrator, grooves and cam fixed on each disc: where each swing ends.
fn by_steps(m: &Module, turns: &[usize]) -> Vec<f64> {
    let (mut bench, mut out) = (Bench::new(m), Vec::new());
    for &d in turns {
        let short = bench.swing(d);
        out.push(bench.at[d]);
        if short > m.latch.capture {
            break;
        }
    }
    out
}

/// Grooves are on the discs: what one swing falls short, the next begins with. The built-in module with too weak a cam.
#[test]
fn shortfalls_add_up_against_grooves_that_stay() {
    let text = builtin::text("torsion-module").unwrap();
    let file = drive_from_bytes("torsion-module.toml", text.as_bytes()).unwrap();
    let design = design_drive(&file.spec).unwrap().design;
    let built_in = design.unwrap().module;
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
        let run = m.run_programme(&steps(turns)).unwrap();
        let slow = by_steps(&m, turns);
        assert_eq!(run.steps.len(), most, "feed {feed}");
        assert_eq!(slow.len(), most, "feed {feed}");
        for (n, (step, slow)) in run.steps.iter().skip(1).zip(&slow).enumerate() {
            near(step.angles[turns[n]], *slow, 1e-4);
        }
        near(run.angles[turns[most - 1]], slow[most - 1], 1e-4);
        // The last swing's shortfall is against its groove, and as far as the disc is from it.
        let (End::Caught { missing } | End::Missed { missing }) =
            run.iter_swings().last().unwrap().1.end
        else {
            panic!("feed {feed}")
        };
        let groove = (run.angles[turns[most - 1]] / m.latch.at).round() * m.latch.at;
        near((groove - run.angles[turns[most - 1]]).abs(), missing, 1e-12);
        assert_eq!(missing > m.latch.capture, most < 40);
    }
}

/// Discs that stand far short of their grooves: the push stays where the swinging disc's own grooves have it, though it swings about
/// another place.
#[test]
fn the_push_stays_with_the_grooves_of_the_disc_that_swings() {
    for (energy, from) in [(0.1, 0.5), (0.2, 0.6), (0.05, 0.3)] {
        let weak = module(0.02, 0.1, energy);
        let m = Module {
            latch: Latch {
                capture: 0.5,
                ..weak.latch
            },
            feed: Feed { energy, from },
            ..weak
        };
        let turns = [1, 0, 1, 0];
        let run = m.run_programme(&steps(&turns)).unwrap();
        let slow = by_steps(&m, &turns);
        assert_eq!((run.steps.len(), slow.len()), (4, 4));
        for (n, (step, slow)) in run.steps.iter().skip(1).zip(&slow).enumerate() {
            near(step.angles[turns[n]], *slow, 1e-4);
        }
        near(run.angles[0], slow[3], 1e-4);
        // Far from where they would stand if nothing fell short.
        assert!(slow[3] < 0.8 + 2.0 * 1.6 - 0.05, "{slow:?}");
    }
}
