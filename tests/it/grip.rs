//! Clamping levers against `[Pavlenko & Godunko 2010]`, and holding forces against independent statics.

use ozols::workload::lever_arm::{Lever, LeverError};
use proptest::prelude::*;

/// A lever in millimetres and degrees.
fn lever(length: f64, prism: f64, mounting: f64) -> Lever {
    Lever::new(length, prism.to_radians(), mounting.to_radians()).unwrap()
}

fn near(found: f64, stated: f64, tolerance: f64) {
    assert!(
        (found - stated).abs() <= tolerance,
        "found {found}, stated {stated}"
    );
}

/// [Pavlenko & Godunko 2010] equations (1) to (8), figures recomputed by hand: L = 100, D = 40, α = 120°, γ = 20°.
#[test]
fn arms_have_the_published_figures() {
    let arms = lever(100.0, 120.0, 20.0).arms(40.0);
    near(arms.l11, 76.604, 5e-4);
    near(arms.l12, 11.547, 5e-4);
    near(arms.l1, 88.151, 5e-4);
    near(arms.l21, 93.969, 5e-4);
    near(arms.l22, 11.547, 5e-4);
    near(arms.l2, 82.422, 5e-4);
    // The same with α = 120°, γ = 30°: l11 and l21 coincide (line 5 of fig. 3).
    let arms = lever(100.0, 120.0, 30.0).arms(40.0);
    near(arms.l11, 86.603, 5e-4);
    near(arms.l21, 86.603, 5e-4);
    let arms = lever(100.0, 90.0, 30.0).arms(40.0);
    near(arms.l1, 70.000, 5e-4);
    near(arms.l2, 66.603, 5e-4);
}

#[test]
fn nominal_pivot_is_where_both_bisectors_are_one_line() {
    let l = lever(100.0, 120.0, 20.0);
    near(
        l.nominal_pivot(40.0),
        20.0 / 60f64.to_radians().sin() - 100.0 * 80f64.to_radians().cos(),
        1e-12,
    );
    near(l.nominal_diameter(l.nominal_pivot(40.0)), 40.0, 1e-12);
}

#[test]
fn impossible_levers_are_refused() {
    let (a, g) = (2.0, 0.3);
    assert_eq!(
        Lever::new(0.1, 180f64.to_radians(), g),
        Err(LeverError::PrismAngle(180.0))
    );
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        assert!(Lever::new(bad, a, g).is_err());
        assert!(Lever::new(0.1, bad, g).is_err());
    }
    for bad in [f64::NAN, f64::INFINITY, -0.1, 3.2] {
        assert!(Lever::new(0.1, a, bad).is_err());
    }
}

proptest! {
    /// [Pavlenko & Godunko 2010], findings: linear in L and in D, l1 grows and l2 falls with D by the same amount.
    #[test]
    fn arms_are_linear_in_length_and_diameter(
        length in 0.01..1.0f64, alpha in 30.0..170.0f64, gamma in 0.0..90.0f64, d in 0.001..0.5f64, s in 0.1..10.0f64,
    ) {
        let (a, b) = (lever(length, alpha, gamma).arms(d), lever(s * length, alpha, gamma).arms(s * d));
        let scale = length + d / (alpha / 2.0).to_radians().tan();
        prop_assert!((b.l1 - s * a.l1).abs() <= 1e-14 * s * scale);
        prop_assert!((b.l2 - s * a.l2).abs() <= 1e-14 * s * scale);
        let more = lever(length, alpha, gamma).arms(2.0 * d);
        prop_assert!(((more.l1 - a.l1) - (a.l2 - more.l2)).abs() <= 1e-14 * scale);
        prop_assert!(more.l1 > a.l1 && more.l2 < a.l2);
    }
}
