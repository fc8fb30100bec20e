//! `ozols drive` as its users meet it.

use crate::common::*;

// The command.

const SMALL: &str = r#"
name = "turner"
length_unit = "mm"

[workload.drive]
swing_angle = "pi/2"
period = 0.8
inertia = 0.23
shear_modulus = 8e10
allowable_stress = 6e8
missing_angle = 2
spring_stroke = 15
swings = 5
"#;

fn run_file(text: &str, more: &str) -> (Option<i32>, String, String) {
    run_on("drive", "turner.toml", text, more)
}

fn refused(text: &str, says: &str) {
    assert_fails_on("drive", "turner.toml", text, "", says);
}

fn small_with(from: &str, to: &str) -> String {
    replace_once(SMALL, from, to)
}

fn small_json(text: &str, code: i32) -> Value {
    let (found, said) = answer_on("drive", "turner.toml", text, "");
    assert_eq!(found, Some(code), "{said:#}");
    said
}

#[test]
fn built_in_module_runs_its_programme() {
    let value = run_json("drive torsion-module --format json");
    let design = &value["design"];
    // I = 0.05 + 2 · 0.3², k = I (2π/0.8)².
    near(design["stiffness"].real(), 0.23 * (TAU / 0.8).powi(2), 1e-9);
    // Greatest acceleration: r p² φ0, as φ0 < 1.
    let p2 = design["stiffness"].real() / 0.23;
    near(
        design["motions"][0]["acceleration"].real(),
        0.3 * p2 * std::f64::consts::FRAC_PI_4,
        1e-9,
    );
    for s in design["programme"]
        .list()
        .iter()
        .filter(|s| !s["swing"].is_null())
    {
        near(s["swing"]["energy"]["residual"].real(), 0.0, 1e-9);
    }
}

/// [Klyuchkovskyi 1999] (12) and (14) from a measured missing angle; the simulation, damped to miss as much, agrees with both.
#[test]
fn missing_angle_gives_energy_and_spring() {
    let value = small_json(SMALL, 0);
    let (d, twist, missing) = (
        &value["design"],
        std::f64::consts::FRAC_PI_4,
        2f64.to_radians(),
    );
    let k = d["stiffness"].real();
    let energy = k / 2.0 * (2.0 * twist * missing - missing * missing);
    near(d["friction_energy"].real(), energy, 1e-12);
    near(
        d["cam"]["spring"]["rate"].real(),
        2.0 * energy / 0.015f64.powi(2),
        1e-8,
    );
    near(
        d["decrement"].real(),
        (twist / (twist - missing)).ln(),
        1e-15,
    );
    // Viscous damping takes a little more of a swing that is fed.
    let needed = d["needed_feed"].real();
    assert!(
        needed > energy && needed < 1.05 * energy,
        "{needed} {energy}"
    );
    // Without the cam the first swing ends short by the missing angle, and the latch does not catch it.
    let value = small_json(&small_with("swings = 5", "feed_energy = 0"), 1);
    let first = &value["design"]["programme"][0]["swing"];
    assert_eq!(first["end"], "missed");
    near(first["missing"].real(), missing, 1e-12);
}

#[test]
fn discs_that_cannot_swing_are_refused_or_told() {
    let stuck = small_with("missing_angle = 2", "friction_moment = 1e4");
    let (code, said, _) = run_file(&stuck, "");
    assert_eq!(code, Some(1));
    has(&said, "is stuck: friction is stronger than the wound bar");
    let creeps = small_with("missing_angle = 2", "viscous_damping = 1e4");
    refused(&creeps, "creeps and does not swing");
}

#[test]
fn bad_tables_are_refused_where_they_stand() {
    for [from, to, line, part] in read_cases::<4>(
        r#"
        inertia = 0.23 | inertia = 0 | inertia | a number above 0
        inertia = 0.23 | inertia = -1 | inertia | a number above 0
        inertia = 0.23 | inertia = nan | inertia | finite
        inertia = 0.23 |  | [workload.drive] | drive needs inertia
        inertia = 0.23 | disc_inertia = 0 | disc_inertia | a disc or a payload
        inertia = 0.23 | inertia = 1\npayload_mass = 2 | payload_mass | needs payload_radius
        inertia = 0.23 | inertia = 1\ndisc_inertia = 1 | disc_inertia | and inertia exclude each other
        period = 0.8 |  | [workload.drive] | drive needs period
        period = 0.8 | period = 0.8\nswing_time = 0.4 | swing_time | and period exclude each other
        period = 0.8 | period = inf | period | finite
        "pi/2" | 0 | swing_angle | an angle above 0
        shear_modulus = 8e10 | shear_modulus = 80 | shear_modulus | such as 8e10 for steel
        missing_angle = 2 | missing_angle = 50 | missing_angle | below half the swing
        spring_stroke = 15 | cam_efficiency = 0.5 | cam_efficiency | needs spring_stroke
        spring_stroke = 15 | spring_stroke = 15\ncam_efficiency = 2 | cam_efficiency | up to 1
        swings = 5 | swings = 0 | swings | 1 to 10000
        swings = 5 | motion = "both" | motion | known: stepwise, reversing
        swings = 5 | programme = ["3"] | programme | wait 0.3
        swings = 5 | swings = 5\nprogramme = ["1"] | swings | and programme exclude each other
        swings = 5 | latch_capture = -1 | latch_capture | an angle from 0
        swings = 5 | feed_from = 50 | feed_from | within the swing
"#,
    ) {
        let text = small_with(from, to);
        let (code, said, errors) = run_file(&text, "");
        assert_eq!((code, said.as_str()), (Some(2), ""), "{to}: {errors}");
        has_all(&errors, &[part, &place_of("turner.toml", &text, line)]);
    }
    refused("name = \"x\"", "no [workload.drive] table");
    refused("name = \"x\"", "torsion-module");
}

/// Inertia of a link that turns about an axis aside of its mass centre, with a payload.
#[test]
fn inertia_comes_from_a_link() {
    let mechanism = write_mechanism("", "0 1*", "0-1 | 0 1 | revolute | 0, 0, 0 | 0, 0, 5");
    let heavy = "role = \"output\"\nmass = 3\ncentre = [100, 0, 40]\ninertia = [1, 2, 0.04]";
    let mechanism = &replace_once(&mechanism, "role = \"output\"", heavy);
    let with_link = |link: &str| {
        let table = small_with(
            "inertia = 0.23",
            &format!("disc_link = \"{link}\"\npayload_mass = 2\npayload_radius = 300"),
        );
        table + mechanism
    };
    let value = small_json(&with_link("1"), 0);
    near(
        value["inertias"][0].real(),
        0.04 + 3.0 * 0.01 + 2.0 * 0.09,
        1e-12,
    );
    refused(&with_link("7"), "unknown link \"7\"");
    refused(&with_link("0"), "disc_link needs a link with mass");
    let alone = small_with("inertia = 0.23", "disc_link = \"1\"");
    refused(&alone, "disc_link needs a mechanism in the same file");
}

#[test]
fn files_of_tables_alone_can_be_checked() {
    let (code, said, _) = run_on("check", "turner.toml", SMALL, "");
    assert_eq!(code, Some(0));
    assert_eq!(said, "turner: workload drive: valid\n");
    let wrong = small_with("inertia = 0.23", "inertia = 0");
    assert_fails_on("check", "turner.toml", &wrong, "", "inertia");
}

#[test]
fn programmes_are_read_step_by_step() {
    let programme = "programme = [\"2\", \"wait 0.25\", \"2\", \"wait 1 s\", \"1\"]";
    let value = small_json(&small_with("swings = 5", programme), 0);
    let steps = value["design"]["programme"].list();
    let discs = steps.iter().map(|s| s["swing"]["disc"].clone());
    assert_eq!(Value::from_iter(discs), json!([2, null, 2, null, 1]));
    near(steps[1]["duration"].real(), 0.25, 0.0);
    near(steps[3]["duration"].real(), 1.0, 0.0);
}
