//! The cam of the torsional drive: its profile against the energy it must give, its electromagnets.

use crate::common::*;
use ozols::drive::cam::Cam;
use ozols::drive::swing::Feed;
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_4;

proptest! {
    /// By virtual work: spring force times fall by turn is one moment all along the flank, and all of it is (13).
    #[test]
    fn flanks_give_an_even_moment(psi in 0.05..2.0f64, from in -0.5..0.7f64, stroke in 0.001..0.05f64) {
        let half = 0.8;
        let from = from * half;
        let cam = Cam { half_swing: half, feed: Feed::even(1.0, from), stroke, mounting: psi, radius: 0.1, roller: 0.005 };
        let force = |fall: f64| (1.0 + psi) * stroke - fall;
        let energy = 0.5 * ((1.0 + psi).powi(2) - psi * psi) * stroke * stroke;
        let even = energy / (half - from);
        let h = 1e-6;
        for i in 1..20 {
            let turn = from + (half - from) * f64::from(i) / 20.0;
            let slope = (cam.fall(turn + h) - cam.fall(turn - h)) / (2.0 * h);
            prop_assert!((slope - cam.slope(turn)).abs() <= 1e-5 * stroke);
            prop_assert!((force(cam.fall(turn)) * slope / even - 1.0).abs() < 1e-5);
        }
        prop_assert!(cam.fall(from).abs() < 1e-15 && (cam.fall(half) - stroke).abs() < 1e-12);
    }

    /// By virtual work: flanks of several pieces give each its moment, the whole of (13), and nothing where a moment is 0.
    #[test]
    fn flanks_give_the_moments_of_their_pieces(psi in 0.05..2.0f64, second in 0.0..2.0f64, third in 0.0..2.0f64) {
        let (half, stroke) = (0.8, 0.01);
        let pieces = vec![(-0.1, 1.0), (0.3, second), (0.5, third)];
        let cam = Cam { half_swing: half, feed: Feed { energy: 7.0, pieces }, stroke, mounting: psi, radius: 0.1, roller: 0.005 };
        let force = |fall: f64| (1.0 + psi) * stroke - fall;
        let energy = 0.5 * ((1.0 + psi).powi(2) - psi * psi) * stroke * stroke;
        let one = energy / (0.4 + 0.2 * second + 0.3 * third);
        let h = 1e-6;
        for (turn, moment) in [(-0.3, 0.0), (0.1, 1.0), (0.28, 1.0), (0.32, second), (0.48, second), (0.6, third), (0.77, third)] {
            let slope = (cam.fall(turn + h) - cam.fall(turn - h)) / (2.0 * h);
            prop_assert!((slope - cam.slope(turn)).abs() <= 1e-5 * stroke);
            prop_assert!((force(cam.fall(turn)) * slope - moment * one).abs() < 1e-5 * one);
        }
        prop_assert!(cam.fall(-0.1).abs() < 1e-15 && (cam.fall(half) - stroke).abs() < 1e-12);
    }

    /// The roller touches the profile and cuts nothing: no point of the profile is nearer to its centre than its radius.
    #[test]
    fn rollers_roll_on_the_profile(psi in 0.2..1.0f64, roller in 0.002..0.01f64) {
        let cam = Cam { half_swing: FRAC_PI_4, feed: Feed::even(1.0, 0.0), stroke: 0.01, mounting: psi, radius: 0.08, roller };
        let profile = cam.profile(180);
        prop_assert!(profile.closes && profile.grooves.len() == 4 && profile.both_ways);
        prop_assert!(roller < profile.least_curvature);
        for (i, p) in profile.points.iter().enumerate() {
            let gaps = profile.outline.iter().map(|q| (p.pitch[0] - q[0]).hypot(p.pitch[1] - q[1]));
            let gap = gaps.fold(f64::INFINITY, f64::min);
            prop_assert!(gap >= roller * (1.0 - 1e-6), "{gap} {roller}");
            // Away from the crest, where flanks meet at an angle, it touches, as near as the points are to each other.
            if !(60..120).contains(&(i % 180)) {
                prop_assert!(gap <= roller * 1.01, "{i}: {gap} {roller}");
            }
        }
    }
}

/// The roller's centre at a turn, from the fall alone.
fn centre(cam: &Cam, turn: f64) -> [f64; 2] {
    let r = cam.radius - cam.fall(turn.abs());
    [r * turn.cos(), r * turn.sin()]
}

/// Radius of the circle through three points, without bound where they turn to the right.
fn circle([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let side = |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]);
    let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if twice > 0.0 {
        side(a, b) * side(b, c) * side(c, a) / (2.0 * twice)
    } else {
        f64::INFINITY
    }
}

proptest! {
    /// Measured on the path itself: circles through neighbouring points, and the angle between the path and the circle round
    /// the axis, which is that between its normal and the follower's way.
    #[test]
    fn curvature_and_pressure_angle_are_those_of_the_path(
        psi in 0.1..1.5f64, stroke in 0.004..0.02f64, radius in 0.05..0.12f64, half in 0.4..1.2f64,
    ) {
        let cam = Cam { half_swing: half, feed: Feed::even(1.0, 0.0), stroke, mounting: psi, radius, roller: 0.003 };
        let (profile, step) = (cam.profile(360), 1e-4 * half);
        // Where the profile is looked at, but for the crest and the grooves, at which the path has corners.
        let turns = profile.points.iter().map(|p| p.turn).filter(|t| t.abs() > 2.0 * step && t.abs() < half - 2.0 * step);
        let bulge = |t: f64| circle([t - step, t, t + step].map(|t| centre(&cam, t)));
        let least = turns.map(bulge).fold(radius, f64::min);
        prop_assert!((profile.least_curvature / least - 1.0).abs() < 1e-3, "{} {least}", profile.least_curvature);
        // The path falls fastest where it comes to a groove.
        let [a, b] = [half - 1e-6 * half, half].map(|t| centre(&cam, t));
        let (way, arm) = ([b[0] - a[0], b[1] - a[1]], b);
        let across = (way[0] * arm[1] - way[1] * arm[0]).abs();
        let inwards = -(way[0] * arm[0] + way[1] * arm[1]);
        let angle = inwards.atan2(across);
        prop_assert!((profile.pressure_angle - angle).abs() < 1e-4, "{} {angle}", profile.pressure_angle);
    }
}

/// The built-in module: its spring for this run, the pulses of its electromagnets, what they take.
#[test]
fn electromagnets_are_on_until_the_push_begins() {
    let value = json(&["drive", "torsion-module", "--format", "json"]);
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
    let text = out(&["drive", "torsion-module"]);
    has_all(
        &text,
        &[
            "electromagnet: on at each release for",
            "J a cycle",
            "cam profile: 4 grooves",
        ],
    );
}

/// SVG, CSV and DXF have the same profile, in millimetres.
#[test]
fn profiles_are_written_for_the_workshop() {
    let folder = tempdir().unwrap();
    let at = folder.path().join("cam");
    out(&["drive", "torsion-module", "--svg", at.to_str().unwrap()]);
    assert!(
        fs::read_to_string(at.join("cam.svg"))
            .unwrap()
            .starts_with("<svg")
    );
    let table = fs::read_to_string(at.join("cam.csv")).unwrap();
    let points: Vec<[f64; 2]> = table
        .lines()
        .filter_map(|l| l.strip_prefix("path of the roller,"))
        .map(|l| l.split_once(',').unwrap())
        .map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()])
        .collect();
    assert_eq!(points.len(), 4 * 180);
    let radii = points.iter().map(|p| p[0].hypot(p[1]));
    near(radii.clone().fold(0.0, f64::max), 70.0, 1e-9);
    near(radii.fold(f64::INFINITY, f64::min), 55.0, 1e-9);
    let dxf = fs::read_to_string(at.join("cam.dxf")).unwrap();
    assert_eq!(dxf.matches("\nPOLYLINE\n").count(), 6);
    assert_eq!(dxf.matches("\nVERTEX\n").count(), table.lines().count() - 1);
    assert!(dxf.starts_with("0\nSECTION\n") && dxf.ends_with("0\nEOF\n"));
}

/// The payload's motion goes on to the grip: what a step takes is greatest where the disc is driven hardest.
#[test]
fn the_drives_motion_is_what_the_grip_takes() {
    let folder = tempdir().unwrap();
    let at = folder.path().join("drive");
    out(&["drive", "torsion-module", "--svg", at.to_str().unwrap()]);
    let table = at.join("motion.csv");
    let value = json(&format!(
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
    let told = json(&["drive", "torsion-module", "--format", "json"])["design"]["motions"][0]["acceleration"].real();
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

/// A swing that does not divide a turn, a roller too large, a flank that feeds one way only: all told.
#[test]
fn cams_that_will_not_do_are_told() {
    let text = out(&["show", "torsion-module"]);
    let with = |from: &str, to: &str| run_on("drive", "m.toml", &changed(&text, from, to), &[]).1;
    let said = with("swing_angle = 90", "swing_angle = 100");
    has(
        &said,
        "100° does not divide a turn: stepwise rotation finds no groove after 3 swings",
    );
    let said = with("feed_energy = 0.31", "feed_from = -10\nfeed_energy = 0.31");
    has(&said, "feeds swings one way only");
    let said = with("roller_radius = 8", "roller_radius = 54");
    has(&said, "THE ROLLER IS TOO LARGE");
    let said = with("cam_radius = 70\nroller_radius = 8\n", "");
    has(&said, "give cam_radius and roller_radius");
    for (from, to, part) in [
        ("roller_radius = 8\n", "", "cam_radius needs roller_radius"),
        (
            "cam_radius = 70",
            "cam_radius = 20",
            "keeps clear of the axis",
        ),
    ] {
        let (code, _, errors) = run_on("drive", "m.toml", &changed(&text, from, to), &[]);
        assert_eq!(code, Some(2));
        assert!(errors.contains(part), "{errors}");
    }
}
