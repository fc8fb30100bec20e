//! Drives out of true: sample by sample against a plain integrator and a closed form, and the command that tells their shares.

use super::repeated::latched;
use super::{drive, steps};
use crate::common::*;
use ozols::drive::programme::{Endurance, Module};
use ozols::drive::shares;
use ozols::drive::swing::Feed;

/// A drive that needs about 0.33 J of its cam.
fn nominal(feed: f64) -> Module {
    drive([0.23, 0.19], 0.02, 0.1, 0.02, feed)
}

/// The integrator runs each sample round after round: the first swing that misses is the same, and so are the shares.
#[test]
fn samples_fail_where_a_plain_integrator_has_them_fail() {
    let (most, tolerance) = (60, 0.1);
    let none = nominal(0.0);
    let needs = none.discs.map(|d| d.needed_feed(none.latch, &none.feed));
    let need = needs
        .map(|n| n.unwrap().unwrap())
        .into_iter()
        .fold(0.0, f64::max);
    let (mut failing, mut lasting) = (0, 0);
    for (seed, discs) in [(7, vec![1, 0]), (8, vec![1, 1, 0, 0]), (9, vec![0, 1, 1])] {
        let module = nominal(0.98 * need);
        let found = shares(&module, &steps(&discs), tolerance, 40, seed).unwrap();
        let (mut swings, mut complete) = (0, 0);
        for (n, said) in found.long_runs.iter().enumerate() {
            let sample = module.out_of_true(tolerance, seed, n as u64);
            let (after, missed, margin) = latched(&sample, &discs, most);
            assert!(margin > 1e-7, "seed {seed}, sample {n} decides nothing");
            swings += after.min(discs.len());
            complete += usize::from(after >= discs.len());
            match said {
                Endurance::Fails { after: said } if *said < most => {
                    failing += 1;
                    assert_eq!((after, missed), (*said, true), "seed {seed}, sample {n}");
                }
                _ => {
                    lasting += 1;
                    assert!(!missed, "seed {seed}, sample {n}: {after} and not {said:?}");
                }
            }
        }
        assert_eq!((swings, complete), (found.latched(), found.complete()));
    }
    assert!(failing >= 30 && lasting >= 30, "{failing} {lasting}");
}

/// Dry friction alone takes 2c/k of a swing without a cam: a sample is latched where that is within its capture, and the
/// share of them is the part of the cube of drawn factors in which it is, here counted over a grid.
#[test]
fn the_share_is_the_volume_of_what_latches() {
    let (samples, tolerance, seed) = (4000, 0.1, 3);
    // Nominally 2 · 0.14 / 14 = 0.02 short, which is at most 1.03 · 0.02.
    let module = drive([0.23, 0.19], 0.0, 0.14, 1.03 * 0.02, 0.0);
    let found = shares(&module, &steps(&[1]), tolerance, samples, seed).unwrap();
    for (n, said) in found.long_runs.iter().enumerate() {
        let m = module.out_of_true(tolerance, seed, n as u64);
        let disc = &m.discs[1];
        let margin = m.latch.capture - 2.0 * disc.coulomb / disc.stiffness;
        let misses = matches!(said, Endurance::Fails { after: 0 });
        assert!(
            margin.abs() < 1e-12 || misses == (margin < 0.0),
            "{margin} {said:?}"
        );
    }
    let factor = |i: i32| 1.0 + tolerance * (2.0 * (f64::from(i) + 0.5) / 80.0 - 1.0);
    let mut within = 0;
    for (friction, stiffness) in (0..80).flat_map(|i| (0..80).map(move |j| (i, j))) {
        let short = factor(friction) / factor(stiffness);
        within += (0..80).filter(|k| short <= 1.03 * factor(*k)).count();
    }
    let volume = f64::from(u32::try_from(within).unwrap()) / 80f64.powi(3);
    assert!(volume > 0.55 && volume < 0.9, "{volume}");
    // Four standard deviations of a share of 4000.
    near(found.complete() as f64 / samples as f64, volume, 0.03);
}

/// At a tolerance of nothing every sample is the drive itself: all swings are latched where its own are, none after its own
/// failure where they are not.
#[test]
fn without_tolerance_samples_do_as_the_drive_does() {
    let discs = [1, 0, 1, 0];
    for (feed, every) in [(0.8, true), (0.15, false)] {
        let module = nominal(feed);
        let run = module.run(&steps(&discs)).unwrap();
        assert_eq!(run.complete(), every, "feed {feed}");
        let found = shares(&module, &steps(&discs), 0.0, 25, 1).unwrap();
        assert_eq!(found.latched(), 25 * run.latched);
        assert_eq!(found.complete(), if every { 25 } else { 0 });
        assert_eq!(found.lasting(), if every { 25 } else { 0 });
        let nominal = module.endurance(&steps(&discs)).unwrap();
        assert!(found.long_runs.iter().all(|r| *r == nominal));
    }
}

/// Each quantity is drawn evenly within the tolerance and has nothing to do with another; the bar is one for both discs.
#[test]
fn quantities_are_drawn_evenly_and_each_by_itself() {
    let (samples, tolerance) = (4000, 0.07);
    let module = Module {
        feed: Feed::even(0.5, 0.3),
        ..nominal(0.5)
    };
    let quantities = |m: &Module| {
        let [a, b] = m.discs;
        assert_eq!(a.stiffness.to_bits(), b.stiffness.to_bits());
        let [latch, feed] = [
            [m.latch.at, m.latch.capture],
            [m.feed.energy, m.feed.begins()],
        ];
        let of = |d: ozols::drive::swing::Disc| [d.inertia, d.viscous, d.coulomb];
        [vec![a.stiffness], of(a).into(), of(b).into()]
            .concat()
            .into_iter()
            .chain(latch)
            .chain(feed)
            .collect::<Vec<f64>>()
    };
    let own = quantities(&module);
    assert_eq!(own.len(), 11);
    let drawn: Vec<Vec<f64>> = (0..samples)
        .map(|n| {
            let sample = quantities(&module.out_of_true(tolerance, 5, n));
            let part = |(x, own): (&f64, &f64)| (x / own - 1.0) / tolerance;
            sample.iter().zip(&own).map(part).collect()
        })
        .collect();
    let mean = |of: &dyn Fn(&Vec<f64>) -> f64| drawn.iter().map(of).sum::<f64>() / samples as f64;
    for i in 0..own.len() {
        assert!(drawn.iter().all(|d| d[i].abs() <= 1.0 + 1e-9));
        near(mean(&|d| d[i]), 0.0, 0.04);
        for j in 0..=i {
            let even = if i == j { 1.0 / 3.0 } else { 0.0 };
            near(mean(&|d| d[i] * d[j]), even, 0.025);
        }
    }
    let other = quantities(&module.out_of_true(tolerance, 6, 0));
    assert_ne!(other, quantities(&module.out_of_true(tolerance, 5, 0)));
}

/// More samples begin with the fewer.
#[test]
fn further_samples_leave_the_first_as_they_are() {
    let (module, programme) = (nominal(0.5), steps(&[1, 0]));
    let of = |n| shares(&module, &programme, 0.05, n, 4).unwrap().long_runs;
    assert_eq!(of(30)[..10], of(10));
}

// The command.

#[test]
fn the_same_seed_gives_the_same_bytes_for_any_number_of_threads() {
    let asked = |more: &[&str]| {
        let some = ["drive", "torsion-module", "--tolerance", "0.01"];
        out(&[&some[..], more].concat())
    };
    let one = asked(&["--threads", "1"]);
    assert_eq!(one, asked(&["--threads", "2"]));
    assert_eq!(one, asked(&["--seed", "1", "--samples", "200"]));
    assert_ne!(one, asked(&["--seed", "2"]));
}

#[test]
fn json_has_the_samples_or_null() {
    let plain = json(&["drive", "torsion-module", "--format", "json"]);
    assert!(plain.as_object().unwrap().contains_key("samples"));
    assert!(plain["samples"].is_null());
    let asked = |tolerance: &str| {
        let value = json(&format!(
            "drive torsion-module --tolerance {tolerance} --samples 50 --format json"
        ));
        value["samples"].clone()
    };
    let count = |v: &Value, key: &str| v[key].whole();
    let exact = asked("0");
    for key in ["latched_share", "complete_share", "lasting_share"] {
        near(exact[key].real(), 1.0, 0.0);
    }
    assert_eq!(exact["first_failures"].list().len(), 0);
    let found = asked("0.05");
    assert_eq!(count(&found, "samples"), 50);
    assert_eq!(count(&found, "swings"), 50 * 8);
    let failures = found["first_failures"].list();
    let all: u64 = failures.iter().map(|f| count(f, "samples")).sum();
    assert_eq!(all, count(&found, "failing"));
    assert!(all > 0 && all < 50, "{found}");
    assert_eq!(
        all + count(&found, "lasting") + count(&found, "drifting"),
        50
    );
    // What is not latched of the eight swings of each is after a failure within them.
    let lost: u64 = failures
        .iter()
        .map(|f| 9u64.saturating_sub(count(f, "swing")) * count(f, "samples"))
        .sum();
    assert_eq!(count(&found, "latched"), 50 * 8 - lost);
    // The second disc goes first.
    for f in failures {
        assert_eq!(count(f, "disc"), 1 + count(f, "swing") % 2);
    }
}

#[test]
fn wrong_tolerances_are_refused_with_a_remedy() {
    refuses(
        "
        drive torsion-module --tolerance -0.1 | a share from 0 to below 1, such as 0.05
        drive torsion-module --tolerance 1 | a share from 0 to below 1, such as 0.05
        drive torsion-module --tolerance nan | a share from 0 to below 1, such as 0.05
        drive torsion-module --tolerance 5 | a share from 0 to below 1, such as 0.05
        drive torsion-module --tolerance 0.1 --samples 0 | from 1 to 1000000
        drive torsion-module --tolerance 0.1 --samples 1000001 | from 1 to 1000000
        drive torsion-module --samples 5 | --tolerance
        ",
    );
    // Near the critical rate some samples creep.
    let creeping = "name = \"d\"\n[workload.drive]\nswing_angle = 90\nswing_time = 0.4\ninertia = 0.2\nshear_modulus = 8e10\n\
                    allowable_stress = 6e8\nviscous_damping = 3.1\n";
    let (code, _, errors) = run_on("drive", "d.toml", creeping, &["--tolerance", "0.3"]);
    assert_eq!(code, Some(2), "{errors}");
    has(&errors, "lower --tolerance");
}
