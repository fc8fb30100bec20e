//! The torsional drive against `[Klyuchkovskyi 1999]`.

use crate::common::*;
mod cam;
mod command;
mod programmes;
mod swings;
mod unequal;

use ozols::drive::torsion::{
    Bar, CamSpring, Wanted, bar_diameter, friction_energy, log_decrement, natural_frequency,
    stored_energy,
};

// The formulas.

/// [Klyuchkovskyi 1999] equations (7) to (10) say the same. The scan prints T for k in (7); with k as in (8), (9) and (10) follow.
#[test]
fn period_and_diameter_agree() {
    let bar = Bar {
        length: 0.8,
        diameter: 0.012,
        shear_modulus: 8e10,
    };
    let inertia = 0.05;
    let period = TAU * (inertia / bar.stiffness()).sqrt();
    near(bar_diameter(inertia, 0.8, period, 8e10), 0.012, 1e-16);
    // By hand: k = π · 0.012⁴ · 8e10 / (32 · 0.8) = 203.575 N·m/rad, τ = 2π √(0.05/203.575) = 0.098470 s.
    near(bar.stiffness(), 203.575, 1e-3);
    near(period, 0.098470, 1e-6);
}

/// [Klyuchkovskyi 1999] equations (1), (4), (6), (11), (12) and (14) by hand.
#[test]
fn formulas_have_their_figures() {
    // (1): 200 · 0.7²/2; (4): √(200/0.05).
    near(stored_energy(200.0, 0.7), 49.0, 1e-12);
    near(natural_frequency(200.0, 0.05), 4000f64.sqrt(), 1e-12);
    // (6): for small losses the decrement is the loss over the deflection.
    let (whole, lost) = (0.7, 0.7e-3);
    near(log_decrement(whole, whole - lost), 1e-3, 1e-6);
    assert!(log_decrement(whole, whole - lost) > 1e-3);
    let bar = Bar {
        length: 0.8,
        diameter: 0.012,
        shear_modulus: 8e10,
    };
    // (11) by hand: 2 · 0.8 · 6e8 / (0.012 · 8e10).
    near(bar.allowable_twist(6e8), 1.0, 1e-12);
    // (14) by hand: 2 · 1.7 / (0.8 · 1.8 · 0.02²); (12): 100 · (2 · 0.7 · 0.05 - 0.05²).
    near(
        CamSpring::for_friction(1.7, 0.8, 0.4, 0.02).rate,
        3.4 / 5.76e-4,
        1e-9,
    );
    near(friction_energy(200.0, 0.7, 0.05), 6.75, 1e-12);
}

/// [Klyuchkovskyi 1999] (13) and (14) agree when (13) has (1 + ψ0)², not the (1 + ψ0²) of the scan.
#[test]
fn cam_spring_gives_what_friction_takes() {
    let (e, eta, psi, s) = (1.7, 0.8, 0.4, 0.02);
    let spring = CamSpring::for_friction(e, eta, psi, s);
    near(spring.stroke_energy() * eta, e, 1e-14);
    // The work of a spring let go from (1 + ψ0) S to ψ0 S, added up in steps.
    let force = |i: i32| spring.rate * s * (psi + (f64::from(i) + 0.5) / 1000.0);
    let work: f64 = (0..1000).map(|i| force(i) * s / 1000.0).sum();
    near(spring.stroke_energy(), work, 1e-9);
    let as_printed = 0.5 * ((1.0 + psi * psi) - psi * psi) * spring.rate * s * s;
    assert!(
        (as_printed * eta - e).abs() > 0.4,
        "the scan's (13) contradicts (14)"
    );
}

// Sizing.

fn wanted() -> Wanted {
    Wanted {
        twist: 45f64.to_radians(),
        period: 0.8,
        inertia: 0.4,
        shear_modulus: 8e10,
        allowable_stress: 6e8,
        length: None,
        max_length: None,
        length_step: 1e-3,
        diameters: Vec::new(),
    }
}

/// [Klyuchkovskyi 1999]: d and l are tried again until (11) holds; the least length is in closed form.
#[test]
fn bars_are_sized_to_the_allowable_twist() {
    let w = wanted();
    let sizing = w.size_bar();
    let bar = sizing.bar.unwrap();
    assert!(bar.allowable_twist(6e8) > w.twist && bar.rim_stress(w.twist) < 6e8);
    near(TAU * (0.4 / bar.stiffness()).sqrt(), 0.8, 1e-12);
    assert!(
        bar.length >= w.least_length() && bar.length < w.least_length() + 2e-3,
        "{bar:?}"
    );
    assert!(sizing.trials.len() > 1 && !sizing.trials[0].strong);
    // A length that is enough is kept.
    let long = Wanted {
        length: Some(3.0),
        ..wanted()
    };
    assert_eq!(long.size_bar().bar.unwrap().length, 3.0);
}

#[test]
fn standard_diameters_are_taken_from_the_least() {
    let w = Wanted {
        diameters: [6.0, 8.0, 10.0, 12.0, 14.0, 16.0]
            .map(|d| d * 1e-3)
            .to_vec(),
        ..wanted()
    };
    let sizing = w.size_bar();
    let bar = sizing.bar.unwrap();
    near(bar.stiffness(), w.stiffness(), 1e-10);
    assert!(bar.allowable_twist(6e8) > w.twist);
    let before = &sizing.trials[..sizing.trials.len() - 1];
    assert!(before.iter().all(|t| !t.strong));
}

/// Each remedy, taken alone, is just enough.
#[test]
fn remedies_are_sharp() {
    let tight = || Wanted {
        max_length: Some(0.2),
        ..wanted()
    };
    let sizing = tight().size_bar();
    assert!(sizing.bar.is_none());
    let r = sizing.remedy.unwrap();
    let works = |change: &dyn Fn(&mut Wanted)| {
        let mut w = tight();
        change(&mut w);
        w.length = w.max_length;
        w.size_bar().bar.is_some()
    };
    for (factor, should) in [(1.0001, true), (0.9999, false)] {
        assert_eq!(works(&|w| w.max_length = Some(r.length * factor)), should);
        assert_eq!(
            works(&|w| w.allowable_stress = r.allowable_stress * factor),
            should
        );
        assert_eq!(works(&|w| w.period = r.period * factor), should);
        assert_eq!(works(&|w| w.twist = r.twist / factor), should);
        assert_eq!(works(&|w| w.inertia = r.inertia / factor), should);
    }
}
