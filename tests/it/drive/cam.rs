//! The cam of the torsional drive: its spring, and the motion that it gives to a grip.

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

/// The payload's motion goes on to the grip: what a step takes is greatest where the disc is driven hardest.
#[test]
fn the_drives_motion_is_what_the_grip_takes() {
    let folder = tempdir().unwrap();
    let at = folder.path().join("drive");
    run_quiet(&["drive", "torsion-module", "--svg", at.to_str().unwrap()]);
    let table = at.join("motion.csv");
    let value = run_json(&format!(
        "grip lever-gripper --motion {} --format json",
        table.display()
    ));
    let steps = value["motion"]["steps"].list();
    let size = |s: &Value| {
        let a = s["acceleration"].list();
        a.iter().map(|x| x.real().powi(2)).sum::<f64>().sqrt()
    };
    let greatest = steps.iter().map(size).fold(0.0, f64::max);
    // r p² φ0, as `ozols drive` prints it, less what dry friction takes at the release.
    let told =
        run_json("drive torsion-module --format json")["design"]["motions"][0]["acceleration"]
            .real();
    assert!(
        greatest < told && greatest > 0.97 * told,
        "{greatest} {told}"
    );
    // While the other disc swings or both dwell, the part hangs at rest.
    assert!(steps.iter().any(|s| size(s) == 0.0));
    let moments: Vec<f64> = steps
        .iter()
        .map(|s| s["drive_moment_per_lever"].real())
        .collect();
    let rest = steps.iter().position(|s| size(s) == 0.0).unwrap();
    assert!(moments.iter().copied().fold(0.0, f64::max) > 1.2 * moments[rest]);
}
