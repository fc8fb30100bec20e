//! One swing against a step-by-step integrator.

use crate::common::*;
use ozols::drive::swing::{Disc, End, Feed, Latch, SwingError};
use ozols::drive::torsion::{decrement, frequency, friction_energy, stored_energy};
use proptest::prelude::*;

const NO_FEED: Feed = Feed {
    energy: 0.0,
    pieces: Vec::new(),
};

/// Classical Runge and Kutta in small steps, with friction against the motion and the piece of the push that the disc is in.
fn by_steps(disc: &Disc, start: f64, latch: f64, feed: &Feed) -> (f64, f64, f64) {
    let (mut work, mut end) = (0.0, latch);
    for (from, moment) in feed.pieces.iter().rev() {
        work += moment * (end - from);
        end = *from;
    }
    let acceleration = |u: f64, v: f64| {
        let reached = feed.pieces.iter().rfind(|piece| u >= piece.0);
        let cam = reached.map_or(0.0, |piece| feed.energy * piece.1 / work);
        (cam - disc.coulomb - disc.stiffness * u - disc.viscous * v) / disc.inertia
    };
    let h = 1e-4 / (disc.stiffness / disc.inertia).sqrt();
    let (mut u, mut v, mut t) = (-start, 0.0, 0.0);
    loop {
        let k1 = (v, acceleration(u, v));
        let k2 = (
            v + h / 2.0 * k1.1,
            acceleration(u + h / 2.0 * k1.0, v + h / 2.0 * k1.1),
        );
        let k3 = (
            v + h / 2.0 * k2.1,
            acceleration(u + h / 2.0 * k2.0, v + h / 2.0 * k2.1),
        );
        let k4 = (v + h * k3.1, acceleration(u + h * k3.0, v + h * k3.1));
        let (nu, nv) = (
            u + h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0),
            v + h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1),
        );
        if nv <= 0.0 || nu >= latch {
            return (u, v, t);
        }
        (u, v, t) = (nu, nv, t + h);
    }
}

#[test]
fn without_friction_a_swing_is_half_a_period_and_loses_nothing() {
    let disc = Disc {
        inertia: 0.05,
        stiffness: 200.0,
        viscous: 0.0,
        coulomb: 0.0,
    };
    let latch = Latch {
        at: 0.7,
        capture: 1e-9,
    };
    let s = disc.swing(0.7, latch, &NO_FEED).unwrap();
    assert!(
        matches!(s.end, End::Latched { .. } | End::Caught { .. }),
        "{:?}",
        s.end
    );
    near(s.duration, PI / frequency(200.0, 0.05), 1e-7);
    near(s.place, 0.7, 1e-12);
    let p = frequency(200.0, 0.05);
    for i in 0..=100 {
        let t = s.duration * f64::from(i) / 100.0;
        let (u, v) = s.at(t);
        near(u, -0.7 * (p * t).cos(), 1e-12);
        let energy = stored_energy(200.0, u) + 0.05 * v * v / 2.0;
        near(energy / stored_energy(200.0, 0.7), 1.0, 1e-9);
    }
}

#[test]
fn discs_that_do_not_swing_are_named() {
    let latch = Latch {
        at: 0.7,
        capture: 0.01,
    };
    let with = |change: &dyn Fn(&mut Disc)| {
        let mut disc = Disc {
            inertia: 0.05,
            stiffness: 200.0,
            viscous: 0.0,
            coulomb: 0.0,
        };
        change(&mut disc);
        disc
    };
    let swung = |change: &dyn Fn(&mut Disc)| with(change).swing(0.7, latch, &NO_FEED);
    assert_eq!(swung(&|d| d.coulomb = 150.0).unwrap().end, End::Stuck);
    let needed = with(&|d| d.coulomb = 150.0).needed_feed(latch, &Feed::even(1.0, 0.0));
    assert_eq!(needed.unwrap(), None);
    let thick = swung(&|d| d.viscous = 10.0);
    assert!(matches!(thick, Err(SwingError::Overdamped(z)) if z > 1.0));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(swung(&|d| d.inertia = bad).is_err());
        assert!(swung(&|d| d.stiffness = bad).is_err());
    }
    assert!(swung(&|d| d.viscous = f64::NAN).is_err());
    let missed = swung(&|d| d.coulomb = 10.0).unwrap();
    assert!(matches!(missed.end, End::Missed { .. }));
}

fn disc() -> impl Strategy<Value = Disc> {
    (0.01..1.0f64, 10.0..1000.0f64, 0.0..0.2f64, 0.0..0.1f64).prop_map(
        |(inertia, stiffness, ratio, dry)| Disc {
            inertia,
            stiffness,
            viscous: ratio * 2.0 * (stiffness * inertia).sqrt(),
            coulomb: dry * stiffness,
        },
    )
}

/// Pieces of a push: where each begins as a part of φ0, and its moment beside the first's.
fn pieces() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let further = proptest::collection::vec((0.1..0.3f64, 0.0..2.0f64), 0..3);
    (-0.5..0.9f64, further).prop_map(|(from, further)| {
        // Room for several.
        let mut at = if further.is_empty() { from } else { 0.6 * from };
        let window = 1.0 - at;
        let mut pieces = vec![(at, 1.0)];
        for (length, moment) in further {
            at += window * length;
            pieces.push((at, moment));
        }
        pieces
    })
}

fn pushed(energy: f64, twist: f64, pieces: &[(f64, f64)]) -> Feed {
    Feed {
        energy,
        pieces: pieces.iter().map(|&(at, m)| (at * twist, m)).collect(),
    }
}

/// A moment cut into pieces is the same push.
#[test]
fn one_moment_in_pieces_is_one_moment() {
    let disc = Disc {
        inertia: 0.2,
        stiffness: 14.0,
        viscous: 0.03,
        coulomb: 0.1,
    };
    let latch = Latch {
        at: 0.8,
        capture: 0.01,
    };
    let cut = |pieces: &[(f64, f64)]| pushed(0.5, 1.0, pieces);
    let whole = disc.swing(0.8, latch, &Feed::even(0.5, -0.1)).unwrap();
    for pieces in [
        vec![(-0.1, 3.0), (0.2, 3.0), (0.75, 3.0)],
        // Beyond the latch a cam does nothing, nor does a piece of no moment before it.
        vec![(-0.4, 0.0), (-0.1, 2.0), (0.9, 50.0)],
    ] {
        let found = disc.swing(0.8, latch, &cut(&pieces)).unwrap();
        near(found.duration, whole.duration, 1e-12);
        near(found.balance.impact, whole.balance.impact, 1e-12);
        near(found.balance.fed, 0.5, 1e-12);
        near(
            found.push_begins.unwrap(),
            whole.push_begins.unwrap(),
            1e-12,
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The closed forms follow the integrator, through the cam's push and to the end.
    #[test]
    fn swings_agree_with_an_integrator(d in disc(), twist in 0.3..1.5f64, fed in 0.0..0.3f64, pieces in pieces()) {
        let feed = pushed(fed * stored_energy(d.stiffness, twist), twist, &pieces);
        let latch = Latch { at: twist, capture: 0.0 };
        let exact = d.swing(twist, latch, &feed).unwrap();
        let (u, v, t) = by_steps(&d, twist, twist, &feed);
        let p = frequency(d.stiffness, d.inertia);
        // The integrator steps over the edge of the window and stops a step early, or where it is late, at the end.
        let t = t.min(exact.duration);
        prop_assert!((exact.at(t).0 - u).abs() < 1e-3 * twist, "{} {u}", exact.at(t).0);
        prop_assert!((exact.at(t).1 - v).abs() < 2e-3 * twist * p, "{} {v}", exact.at(t).1);
        prop_assert!((exact.place - u).abs() < 1e-3 * twist);
    }

    /// What the parts of the balance add up to, with every loss integrated by itself.
    #[test]
    fn energy_balances(d in disc(), twist in 0.3..1.5f64, fed in 0.0..0.5f64, pieces in pieces()) {
        let feed = pushed(fed * stored_energy(d.stiffness, twist), twist, &pieces);
        let s = d.swing(twist, Latch { at: twist, capture: 0.0 }, &feed).unwrap();
        if matches!(s.end, End::Latched { .. }) {
            prop_assert!((s.balance.fed - feed.energy).abs() <= 1e-9 * s.balance.initial, "{:?}", s.balance);
        }
        prop_assert!(s.balance.residual().abs() <= 1e-9 * s.balance.initial, "{:?}", s.balance);
        // Equation (12) is the balance of a swing without the cam.
        let free = d.swing(twist, Latch { at: twist, capture: 0.0 }, &NO_FEED).unwrap();
        let lost = free.balance.coulomb + free.balance.viscous;
        let missing = twist - free.place;
        prop_assert!((lost - friction_energy(d.stiffness, twist, missing)).abs() <= 1e-9 * free.balance.initial);
        prop_assert!((missing - d.missing(twist)).abs() <= 1e-9 * twist);
    }

    /// [Klyuchkovskyi 1999] equation (6): with viscous damping the decrement is π ζ/√(1 - ζ²) at any deflection, and a
    /// damping found from a missing angle gives it back.
    #[test]
    fn decrement_is_that_of_the_damping(d in disc(), twist in 0.3..1.5f64) {
        let d = Disc { coulomb: 0.0, ..d };
        let zeta = d.damping_ratio();
        let s = d.swing(twist, Latch { at: 2.0 * twist, capture: 0.0 }, &NO_FEED).unwrap();
        let stated = PI * zeta / (1.0 - zeta * zeta).sqrt();
        prop_assert!((decrement(twist, s.place) - stated).abs() <= 1e-12);
        let again = Disc::viscous_for(d.inertia, d.stiffness, twist, twist - s.place);
        prop_assert!((again - d.viscous).abs() <= 1e-9 * (1.0 + d.viscous));
    }

    /// The feed that is needed brings the disc to the latch, at rest where no piece pushes more than the one before; a little
    /// less does not.
    #[test]
    fn needed_feed_is_sharp(d in disc(), twist in 0.5..1.5f64, pieces in pieces()) {
        let latch = Latch { at: twist, capture: 0.0 };
        let of = |energy| pushed(energy, twist, &pieces);
        if let Some(need) = d.needed_feed(latch, &of(1.0)).unwrap() {
            let s = d.swing(twist, latch, &of(need)).unwrap();
            let End::Latched { impact } = s.end else { return Err(TestCaseError::fail(format!("{:?}", s.end))) };
            let falling = pieces.windows(2).all(|w| w[0].1 >= w[1].1);
            prop_assert!(!falling || impact <= 1e-9 * s.balance.initial, "{impact}");
            if need > 1e-9 {
                let less = d.swing(twist, latch, &of(need * 0.999)).unwrap();
                let missed = matches!(less.end, End::Missed { .. });
                prop_assert!(missed);
            }
        }
    }
}
