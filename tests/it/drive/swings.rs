//! One swing against its equation of motion.

use crate::common::*;
use ozols::drive::swing::{Disc, End, Latch, SwingError};
use ozols::drive::torsion::{friction_energy, log_decrement, natural_frequency, stored_energy};

const FREE: Disc = Disc {
    inertia: 0.05,
    stiffness: 200.0,
    viscous: 0.0,
    coulomb: 0.0,
};

#[test]
fn discs_that_do_not_swing_are_named() {
    let latch = Latch {
        at: 0.7,
        capture: 0.01,
    };
    let with = |change: &dyn Fn(&mut Disc)| {
        let mut disc = FREE;
        change(&mut disc);
        disc
    };
    let swung = |change: &dyn Fn(&mut Disc)| with(change).swing_from(0.7, latch, Feed::NONE);
    assert_eq!(swung(&|d| d.coulomb = 150.0).unwrap().end, End::Stuck);
    let needed = with(&|d| d.coulomb = 150.0).needed_feed(latch, 0.0);
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The closed forms obey the equation of motion, by differences, from rest to the latch or to rest; the push sets in at once, where
    /// the acceleration jumps.
    #[test]
    fn swings_obey_their_equation(d in disc(), twist in 0.3..1.5f64, fed in 0.0..0.3f64, from in -0.5..0.9f64) {
        let feed = Feed { energy: fed * stored_energy(d.stiffness, twist), from: from * twist };
        let s = d.swing_from(twist, Latch { at: twist, capture: 0.0 }, feed).unwrap();
        let p = natural_frequency(d.stiffness, d.inertia);
        let h = 1e-4 / p;
        for i in 1..60 {
            let t = h + (s.duration - 2.0 * h) * f64::from(i) / 60.0;
            let [(a, b), (u, v), (e, f)] = [t - h, t, t + h].map(|t| s.position_at(t));
            let jumps = (a < feed.from) != (e < feed.from);
            // Where the push begins, the velocity has a bend, and the difference is off by at most a quarter of its change over a step.
            let bend = if jumps { h * feed.energy / (twist - feed.from) / d.inertia / 4.0 } else { 0.0 };
            prop_assert!(((e - a) / (2.0 * h) - v).abs() < 1e-6 * twist * p + bend);
            let push = if u >= feed.from { feed.energy / (twist - feed.from) } else { 0.0 };
            let rate = (push - d.coulomb - d.stiffness * u - d.viscous * v) / d.inertia;
            prop_assert!(jumps || ((f - b) / (2.0 * h) - rate).abs() < 1e-6 * twist * p * p, "{u} {rate}");
        }
        let (u, v) = s.position_at(0.0);
        prop_assert!((u + twist).abs() < 1e-14 && v.abs() < 1e-9 * p, "{u} {v}");
        let (u, v) = s.position_at(s.duration);
        prop_assert!((u - s.place).abs() < 1e-9 * twist);
        prop_assert!(v.abs() < 1e-6 * twist * p || (u - twist).abs() < 1e-9 * twist, "{u} {v}");
    }

    /// What the parts of the balance add up to, with every loss integrated by itself.
    #[test]
    fn energy_balances(d in disc(), twist in 0.3..1.5f64, fed in 0.0..0.5f64, from in -0.5..0.9f64) {
        let feed = Feed { energy: fed * stored_energy(d.stiffness, twist), from: from * twist };
        let s = d.swing_from(twist, Latch { at: twist, capture: 0.0 }, feed).unwrap();
        if matches!(s.end, End::Latched { .. }) {
            prop_assert!((s.balance.fed - feed.energy).abs() <= 1e-9 * s.balance.initial, "{:?}", s.balance);
        }
        prop_assert!(s.balance.residual().abs() <= 1e-9 * s.balance.initial, "{:?}", s.balance);
        // Equation (12) is the balance of a swing without the cam.
        let free = d.swing_from(twist, Latch { at: twist, capture: 0.0 }, Feed::NONE).unwrap();
        let lost = free.balance.coulomb + free.balance.viscous;
        let missing = twist - free.place;
        prop_assert!((lost - friction_energy(d.stiffness, twist, missing)).abs() <= 1e-9 * free.balance.initial);
        prop_assert!((missing - d.missing_angle(twist)).abs() <= 1e-9 * twist);
    }

    /// [Klyuchkovskyi 1999] equation (6): with viscous damping the decrement is π ζ/√(1 - ζ²) at any deflection, and a
    /// damping found from a missing angle gives it back.
    #[test]
    fn decrement_is_that_of_the_damping(d in disc(), twist in 0.3..1.5f64) {
        let d = Disc { coulomb: 0.0, ..d };
        let zeta = d.damping_ratio();
        let s = d.swing_from(twist, Latch { at: 2.0 * twist, capture: 0.0 }, Feed::NONE).unwrap();
        let stated = PI * zeta / (1.0 - zeta * zeta).sqrt();
        prop_assert!((log_decrement(twist, s.place) - stated).abs() <= 1e-12);
        let again = Disc::viscous_for(d.inertia, d.stiffness, twist, twist - s.place);
        prop_assert!((again - d.viscous).abs() <= 1e-9 * (1.0 + d.viscous));
    }

    /// The feed that is needed brings the disc to the latch, at rest; a little less does not.
    #[test]
    fn needed_feed_is_sharp(d in disc(), twist in 0.5..1.5f64, from in -0.5..0.9f64) {
        let latch = Latch { at: twist, capture: 0.0 };
        let from = from * twist;
        if let Some(need) = d.needed_feed(latch, from).unwrap() {
            let s = d.swing_from(twist, latch, Feed { energy: need, from }).unwrap();
            let End::Latched { impact } = s.end else { return Err(TestCaseError::fail(format!("{:?}", s.end))) };
            prop_assert!(impact <= 1e-9 * s.balance.initial, "{impact}");
            if need > 1e-9 {
                let less = d.swing_from(twist, latch, Feed { energy: need * 0.999, from }).unwrap();
                let missed = matches!(less.end, End::Missed { .. });
                prop_assert!(missed);
            }
        }
    }
}
