//! Clamping levers against `[Pavlenko & Godunko 2010]`, and holding forces against independent statics.

use crate::common::*;
mod cases;
mod clamped;
mod effort;
mod holding;
mod motion;
mod published;

use ozols::grip::lever_arm::{Lever, LeverError};

/// A lever in millimetres and degrees.
fn lever(length: f64, prism: f64, mounting: f64) -> Lever {
    Lever::new(length, prism.to_radians(), mounting.to_radians()).unwrap()
}

/// [Pavlenko & Godunko 2010] equations (1) to (8), figures recomputed by hand: L = 100, D = 40, α = 120°, γ = 20°.
#[test]
fn arms_have_the_published_figures() {
    let arms = lever(100.0, 120.0, 20.0).force_arms(40.0);
    near(arms.l11, 76.604, 5e-4);
    near(arms.l12, 11.547, 5e-4);
    near(arms.l1, 88.151, 5e-4);
    near(arms.l21, 93.969, 5e-4);
    near(arms.l22, 11.547, 5e-4);
    near(arms.l2, 82.422, 5e-4);
    // The same with α = 120°, γ = 30°: l11 and l21 coincide (line 5 of fig. 3).
    let arms = lever(100.0, 120.0, 30.0).force_arms(40.0);
    near(arms.l11, 86.603, 5e-4);
    near(arms.l21, 86.603, 5e-4);
    let arms = lever(100.0, 90.0, 30.0).force_arms(40.0);
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
        let (a, b) = (lever(length, alpha, gamma).force_arms(d), lever(s * length, alpha, gamma).force_arms(s * d));
        let scale = length + d / (alpha / 2.0).to_radians().tan();
        prop_assert!((b.l1 - s * a.l1).abs() <= 1e-14 * s * scale);
        prop_assert!((b.l2 - s * a.l2).abs() <= 1e-14 * s * scale);
        let more = lever(length, alpha, gamma).force_arms(2.0 * d);
        prop_assert!(((more.l1 - a.l1) - (a.l2 - more.l2)).abs() <= 1e-14 * scale);
        prop_assert!(more.l1 > a.l1 && more.l2 < a.l2);
    }
}

proptest! {
    /// l1 - l2 = 2 cos(α/2) a with a signed: the near contact has the longer arm exactly where the levers cross.
    #[test]
    fn the_near_arm_is_longer_where_the_levers_cross(
        length in 0.01..1.0f64, alpha in 30.0..170.0f64, gamma in 0.0..90.0f64, d in 0.001..0.5f64,
    ) {
        let l = lever(length, alpha, gamma);
        let (arms, a) = (l.force_arms(d), Gripper::with_nominal(l, d).pivot);
        let stated = 2.0 * f64::to_radians(alpha / 2.0).cos() * a;
        prop_assert!((arms.l1 - arms.l2 - stated).abs() <= 1e-13 * (length + d / (alpha / 2.0).to_radians().tan()));
    }
}

// The command.

/// A gripper without a mechanism around it.
const SMALL: &str = r#"
name = "clamp"
length_unit = "mm"

[workload.grip]
lever_length = 100
prism_angle = "120deg"
mounting_angle = "pi/6"
diameter = 40
mass = 2
gravity = [-10, 0, 0]
friction = 0
drive_arm = 50
"#;

fn run_file(text: &str, more: &[&str]) -> (Option<i32>, String, String) {
    run_on("grip", "clamp.toml", text, more)
}

fn small_with(from: &str, to: &str) -> String {
    replace_once(SMALL, from, to)
}

/// What is printed is possible: friction within its cone, and a lower bound not above what it bounds.
#[test]
fn friction_and_bounds_keep_their_limits_in_print() {
    for more in ["", "--any-acceleration 9", "--acceleration 5,0,-2"] {
        let value = run_json(&format!("grip lever-gripper --format json {more}"));
        for row in value["diameters"].list() {
            let load = &row["load"];
            let bound = load["lower_bound"].real();
            assert!(bound <= load["drive_moment_per_lever"].real(), "{load}");
            for c in load["contacts"].list() {
                let friction = c["along_face"].real().hypot(c["along_part"].real());
                assert!(friction <= 0.2 * c["normal"].real(), "{c}");
            }
        }
    }
}

#[test]
fn built_in_gripper_holds() {
    let value = run_json("grip lever-gripper --format json");
    assert_eq!(value["holds"], true);
    assert_eq!(value["diameters"].list().len(), 5);
    let load = &value["hardest"]["load"];
    near(value["hardest"]["l1"].real(), 0.101036, 1e-6);
    let moment = load["drive_moment_per_lever"].real();
    near(load["lower_bound"].real(), moment, 1e-6);
}

/// A pull of 20 N into the jaws, without friction: both near contacts carry 10 N / cos 60°, at the arm l2.
#[test]
fn small_file_has_the_closed_form() {
    let value = json_on("grip", "clamp.toml", SMALL, "");
    let load = &value["diameters"][0]["load"];
    let moment = 20.0 * (86.60254 - 11.54701) * 1e-3;
    near(load["drive_moment_per_lever"].real(), moment, 1e-6);
    near(load["drive_effort"].real(), 2.0 * moment / 0.05, 1e-4);
    // An acceleration from the command line.
    assert_eq!(run_file(SMALL, &["--acceleration", "0,0,1"]).0, Some(1));
    assert_eq!(run_file(SMALL, &["--acceleration", "-3,0,0"]).0, Some(0));
}

#[test]
fn bad_tables_are_refused_where_they_stand() {
    for [from, to, line, part] in read_cases::<4>(
        r#"
        mass = 2 | mass = -2 | mass = -2 | mass -2 is out of range; give a number above 0
        mass = 2 | mass = nan | mass = nan | finite
        mass = 2 |  | gravity | gravity needs the mass of the part
        mass = 2 | mass = 2\ndensity = 7850 | mass = 2 | mass and density or part_length exclude each other
        mass = 2 | density = 7850 | density | density needs part_length
        friction = 0 |  | mass = 2 | mass needs friction
        friction = 0 | friction = -0.1 | friction | a coefficient from 0 to 10
        friction = 0 | friction = 0\nsafety = 0.5 | safety | a factor from 1
        "120deg" | 180 | prism_angle | 180 degrees is out of range
        "120deg" | "soon" | prism_angle | unknown word
        "pi/6" | -5 | mounting_angle | an angle from 0 to 179
        lever_length = 100 | lever_length = 0 | lever_length | a number above 0
        lever_length = 100 | lever_length = inf | lever_length | finite
        lever_length = 100 | lever_len = 100 | lever_len | did you mean lever_length?
        diameter = 40 | diameter = 40\ndiameters = [] | diameters | 1 to 1000
        diameter = 40 | diameter = 40\ndiameters = { from = 50, to = 40, count = 3 } | diameters | not below `from`
        diameter = 40 | diameter = 40\npivots = "loose" | pivots | known: fixed, nominal
        [-10, 0, 0] | "some" | gravity | known: any
        drive_arm = 50 | lever_joints = ["a", "b"] | lever_joints | needs a mechanism in the same file
        "mm" | "ell" | ell | unknown length unit
"#,
    ) {
        let text = small_with(from, to);
        let (code, said, errors) = run_file(&text, &[]);
        assert_eq!((code, said.as_str()), (Some(2), ""), "{to}: {errors}");
        part.split("; ").for_each(|p| has(&errors, p));
        has(&errors, &place_of("clamp.toml", &text, line));
    }
    let (code, _, errors) = run_file("name = \"x\"", &[]);
    assert_eq!(code, Some(2));
    has(&errors, "no [workload.grip] table");
    has(&errors, "lever-gripper");
    let (code, _, errors) = run_file(SMALL, &["--acceleration", "1,2"]);
    assert_eq!(code, Some(2), "{errors}");
    assert_eq!(run_file(SMALL, &["--any-acceleration", "-1"]).0, Some(2));
}
