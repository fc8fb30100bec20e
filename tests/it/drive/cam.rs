//! The cam of the torsional drive: its spring.

use crate::common::*;

/// The built-in module: its spring for this run.
#[test]
fn the_spring_of_a_run_gives_its_feed() {
    let value = run_json("drive torsion-module --format json");
    // (13) for the 0.31 J fed, at an efficiency of 0.7.
    let fitted = &value["design"]["cam"]["fitted"];
    near(fitted["energy"].real(), 0.31 / 0.7, 1e-12);
    // ½ ((1 + ψ0)² - ψ0²) c S², with ψ0 = 0.5 and S = 15 mm.
    let rate = fitted["rate"].real();
    near(rate * 0.015 * 0.015, 0.31 / 0.7, 1e-12);
}
