//! The cam of the torsional drive: its electromagnets, and the motion that it gives to a grip.

use crate::common::*;

/// The built-in module: its spring for this run, the pulses of its electromagnets, what they take.
#[test]
fn electromagnets_are_on_until_the_push_begins() {
    let value = run_json("drive torsion-module --format json");
    let cam = &value["design"]["cam"];
    // (13) for the 0.31 J fed, at an efficiency of 0.7.
    let energy = 0.31 / 0.7;
    near(cam["fitted"]["energy"].real(), energy, 1e-12);
    let magnet = &cam["electromagnet"];
    near(magnet["energy_per_swing"].real(), energy, 1e-12);
    near(magnet["energy_per_cycle"].real(), 2.0 * energy, 1e-12);
    let rate = cam["fitted"]["rate"].real();
    near(magnet["first_force"].real(), 0.5 * rate * 0.015, 1e-9);
    near(magnet["last_force"].real(), 1.5 * rate * 0.015, 1e-9);
    let pulses = magnet["pulses"].list();
    assert_eq!(pulses.len(), 8);
    let programme = value["design"]["programme"].list();
    let swings: Vec<&Value> = programme.iter().filter(|s| !s["swing"].is_null()).collect();
    for (pulse, swing) in pulses.iter().zip(swings) {
        assert_eq!(pulse["disc"], swing["swing"]["disc"]);
        near(pulse["on"].real(), swing["start"].real(), 1e-12);
        // From rest to the middle: a quarter of an oscillation and a little, for dry friction moves the middle back.
        let on = pulse["off"].real() - pulse["on"].real();
        assert!(on > 0.19 && on < 0.205, "{on}");
    }
    let time = 8.0 * (programme[0]["duration"].real() + 0.3);
    near(magnet["mean_power"].real(), 8.0 * energy / time, 1e-9);
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
