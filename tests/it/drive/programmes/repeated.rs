//! The long run of a programme repeated as it is written, against a plain integrator that runs it round after round.

use super::{drive, steps};
use crate::common::*;
use ozols::drive::programme::{Endurance, Module};

/// Discs in absolute angles, with grooves and cams cut where they are: what is left of the drive when formulas are.
pub(super) struct Bench<'a> {
    drive: &'a Module,
    pub(super) at: [f64; 2],
    groove: [f64; 2],
}

impl Bench<'_> {
    pub(super) fn new(drive: &Module) -> Bench<'_> {
        let phi = drive.latch.at;
        Bench {
            drive,
            at: [phi, 0.0],
            groove: [phi, 0.0],
        }
    }

    /// How far short of its next groove a disc let go stops; 0 where it reaches it.
    pub(super) fn swing(&mut self, d: usize) -> f64 {
        let (m, o) = (self.drive, 1 - d);
        let (disc, phi) = (&m.discs[d], m.latch.at);
        let way = (self.groove[o] - self.groove[d]).signum();
        let target = self.groove[d] + way * 2.0 * phi;
        // Where along the way the push begins, and its moment.
        let from = way * self.groove[d] + phi + m.feed.from;
        let pushes = [(from, m.feed.energy / (phi - m.feed.from))];
        // Place and speed counted along the way; the step of Runge and Kutta under one push or none.
        let neutral = way * self.at[o];
        let rk = |(x, v): (f64, f64), h: f64, cam: f64| {
            let rate = |x: f64, v: f64| {
                let moment = cam - disc.coulomb - disc.stiffness * (x - neutral) - disc.viscous * v;
                (v, moment / disc.inertia)
            };
            let (a, b) = rate(x, v);
            let (c, e) = rate(x + h / 2.0 * a, v + h / 2.0 * b);
            let (g, i) = rate(x + h / 2.0 * c, v + h / 2.0 * e);
            let (p, q) = rate(x + h * g, v + h * i);
            (
                x + h / 6.0 * (a + 2.0 * c + 2.0 * g + p),
                v + h / 6.0 * (b + 2.0 * e + 2.0 * i + q),
            )
        };
        let h = 0.004 * (disc.inertia / disc.stiffness).sqrt();
        let mut now = (way * self.at[d], 0.0);
        // The part of a step after which something has happened, halved until it is a point.
        let until = |now: (f64, f64), cam: f64, met: &dyn Fn((f64, f64)) -> bool| {
            let (mut before, mut after) = (0.0, h);
            for _ in 0..50 {
                let half = (before + after) / 2.0;
                if met(rk(now, half, cam)) {
                    after = half;
                } else {
                    before = half;
                }
            }
            rk(now, after, cam)
        };
        let end = way * target;
        loop {
            let cam = pushes.iter().rfind(|p| now.0 >= p.0).map_or(0.0, |p| p.1);
            let ahead = pushes.iter().map(|p| p.0).find(|mark| *mark > now.0);
            let mark = ahead.unwrap_or(f64::INFINITY);
            let next = rk(now, h, cam);
            if next.1 <= 0.0 {
                now = until(now, cam, &|s| s.1 <= 0.0);
                // At the very mark the push takes over what would have stopped.
                if now.0 < mark {
                    break;
                }
            } else if next.0 >= mark {
                now = until(now, cam, &|s| s.0 >= mark);
            } else if next.0 >= end {
                now.0 = end;
                break;
            } else {
                now = next;
            }
        }
        self.at[d] = way * now.0;
        self.groove[d] = target;
        end - now.0
    }
}

/// Swings that are latched of a programme repeated so many times, all of them or up to the first that misses, and by how little
/// that or the nearest miss was decided.
pub(super) fn latched(drive: &Module, discs: &[usize], most: usize) -> (usize, bool, f64) {
    let mut bench = Bench::new(drive);
    let mut margin = f64::INFINITY;
    for n in 0..most {
        let short = bench.swing(discs[n % discs.len()]);
        margin = margin.min((short - drive.latch.capture).abs());
        if short > drive.latch.capture {
            return (n, true, margin);
        }
    }
    (most, false, margin)
}

/// Random drives and programmes: what is said to fail fails at that very swing, and what is said to last is latched for
/// hundreds of swings. Taking turns is not what a programme such as 2, 2, 1, 1 does.
#[test]
fn the_long_run_is_that_of_the_programme_as_it_is_written() {
    let mut random = ChaCha8Rng::seed_from_u64(29);
    let mut any = |from: f64, to: f64| {
        from + (to - from) * f64::from(random.next_u32()) / f64::from(u32::MAX)
    };
    let (mut lasting, mut failing, mut other) = (0, 0, 0);
    for case in 0..80 {
        let inertias = [any(0.1, 0.3), any(0.1, 0.3)];
        let (viscous, coulomb) = (any(0.0, 0.05), any(0.0, 0.2));
        let plain = drive(inertias, viscous, coulomb, any(0.005, 0.05), 0.0);
        let from = any(-0.2, 0.3);
        let need = plain
            .discs
            .map(|d| d.needed_feed(plain.latch, from).unwrap().unwrap());
        let feed = Feed {
            energy: any(0.95, 1.04) * need[0].max(need[1]),
            from,
        };
        let m = Module { feed, ..plain };
        let length = 1 + (any(0.0, 5.0) as usize);
        let discs = (0..length)
            .map(|_| usize::from(any(0.0, 1.0) < 0.5))
            .collect_vec();
        let programme = steps(&discs);
        let said = m.run_endlessly(&programme).unwrap();
        let (n, missed, margin) = latched(&m, &discs, 200);
        if margin < 1e-7 {
            continue;
        }
        match said {
            Endurance::Fails { after } if after < 200 => {
                failing += 1;
                assert_eq!((n, missed), (after, true), "case {case}: {m:?} {discs:?}");
            }
            Endurance::Lasts { .. } => {
                lasting += 1;
                assert!(!missed, "case {case}: fails after {n}: {m:?} {discs:?}");
            }
            _ => other += 1,
        }
    }
    assert!(
        lasting >= 15 && failing >= 15 && other <= 5,
        "{lasting} {failing} {other}"
    );
}

/// How far short the swings of the last rounds are at most is what the drive says.
#[test]
fn the_shortfall_of_the_long_run_is_the_largest_of_a_round() {
    for (discs, feed) in [
        (vec![1], 0.3),
        (vec![1, 1, 0, 0], 0.42),
        (vec![0, 1, 1], 0.42),
    ] {
        let m = drive([0.23, 0.11], 0.05, 0.0, 0.4, feed);
        let programme = steps(&discs);
        let Endurance::Lasts { missing } = m.run_endlessly(&programme).unwrap() else {
            panic!("{discs:?}")
        };
        let mut bench = Bench::new(&m);
        let swings = (0..400 * discs.len()).map(|n| bench.swing(discs[n % discs.len()]));
        let shorts: Vec<f64> = swings.collect();
        let last = shorts.iter().rev().take(4 * discs.len());
        let last = last.fold(0.0f64, |a, &b| a.max(b));
        assert!(last > 0.1, "{discs:?}");
        near(missing, last, 1e-6);
    }
}
