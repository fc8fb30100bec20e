//! Figures of forces that are rounding and nothing else are 0, in text, JSON and CSV.

use crate::common::*;
use std::fmt::Write;

/// Loads are of 1 N and more and lengths of 1 mm and more: what is smaller is rounding.
const ROUNDING: f64 = 1e-10;

/// One of some things.
fn one<'x, T: ?Sized>(of: &[&'x T], dice: &mut ChaCha8Rng) -> &'x T {
    of[dice.next_u64() as usize % of.len()]
}

/// A built-in file with a workload drawn at random: a force, joints made askew, or masses that the drive accelerates.
fn loaded(dice: &mut ChaCha8Rng) -> String {
    let name = one(&builtin::names(), dice);
    let mut file: toml::Table = builtin::text(name).unwrap().parse().unwrap();
    for key in ["workload", "expected", "claim", "ranking"] {
        file.remove(key);
    }
    let joints = file["joint"].as_array().unwrap().clone();
    let joint = |dice: &mut ChaCha8Rng| joints[dice.next_u64() as usize % joints.len()].clone();
    let is_planar = file
        .get("mode")
        .is_some_and(|m| m.as_str() == Some("planar"));
    let mut out = String::from("\n[workload]\n");
    match dice.next_u64() % 3 {
        0 => {
            let links: Vec<String> = file["link"]
                .as_array()
                .unwrap()
                .iter()
                .map(|l| l["id"].to_string())
                .collect();
            let force = one(&["[0, -100, 0]", "[100, 0, 0]", "[0, 0, 70]"], dice);
            let link = &links[1 + dice.next_u64() as usize % (links.len() - 1)];
            let point = &joint(dice)["point"];
            writeln!(
                out,
                "[[workload.force]]\nlink = {link}\npoint = {point}\nforce = {force}"
            )
            .unwrap();
        }
        1 => {
            out += "[workload.stiffness.default]\nlinear = 1e7\nangular = 1e4\n";
            let off = one(&["angle = 0.001", "length = 0.02"], dice);
            let axis = one(&["x", "y", "z"], dice);
            let joint = &joint(dice)["id"];
            writeln!(
                out,
                "[[workload.misalignment]]\njoint = {joint}\n{off}\naxis = \"{axis}\""
            )
            .unwrap();
        }
        _ => {
            for link in file["link"].as_array_mut().unwrap() {
                let link = link.as_table_mut().unwrap();
                link.insert("mass".to_owned(), 2.0.into());
                link.insert("centre".to_owned(), joint(dice)["point"].clone());
                if is_planar {
                    link.insert("inertia".to_owned(), 0.1.into());
                }
            }
            out += "drive_speed = 3\n";
        }
    }
    toml::to_string(&file).unwrap() + &out
}

/// Every number below the keys of forces, moments and accelerations.
fn figures(value: &Value, of_force: bool, out: &mut Vec<f64>) {
    const KEYS: &str = "
        force moment force_magnitude moment_magnitude global_force global_moment effort normal
        along_face tilting magnitude acceleration angular_acceleration inertia_force inertia_moment";
    match value {
        Value::Object(map) => {
            for (k, v) in map {
                figures(v, split_words(KEYS).contains(&k.as_str()), out);
            }
        }
        Value::Array(list) => list.iter().for_each(|v| figures(v, of_force, out)),
        Value::Number(n) if of_force => out.push(n.as_f64().unwrap()),
        _ => {}
    }
}

#[test]
fn rounding_is_nothing_in_any_output() {
    let asked = std::env::var("OZOLS_FUZZ")
        .ok()
        .and_then(|n| n.parse().ok());
    let (first, cases) = asked.map_or((1, 30), |n: u64| (fresh_seed(), n));
    let folder = tempdir().unwrap();
    let path = folder.path().join("loaded.toml");
    let file = path.to_str().unwrap();
    let (mut solved, mut nothing) = (0, 0);
    for seed in first..first + cases {
        let content = loaded(&mut ChaCha8Rng::seed_from_u64(seed));
        fs::write(&path, &content).unwrap();
        for model in [&[][..], &["--spatial"]] {
            let of =
                |format: &str| run(&[&["statics", file, "--format", format][..], model].concat());
            let found = of("json");
            if !found.status.success() {
                continue;
            }
            solved += 1;
            let mut all = Vec::new();
            figures(
                &serde_json::from_slice(&found.stdout).unwrap(),
                false,
                &mut all,
            );
            nothing += all.iter().filter(|x| **x == 0.0).count();
            let small = |x: &f64| *x != 0.0 && x.abs() < ROUNDING;
            let bad: Vec<&f64> = all.iter().filter(|x| small(x)).collect();
            assert!(bad.is_empty(), "seed {seed}, {model:?}: {bad:?}\n{content}");
            assert!(
                all.iter().all(|x| x.is_sign_positive() || *x != 0.0),
                "seed {seed}: -0"
            );
            for line in utf8_text(&of("text").stdout).lines() {
                // How far methods differ is told with one digit.
                let words = line.split([' ', ',', ':']).filter(|w| w.contains('.'));
                let told = ["residual", "balances", "differ"]
                    .iter()
                    .any(|w| line.contains(w));
                let bad = words.filter_map(|w| w.parse().ok()).find(small);
                assert!(
                    told || bad.is_none(),
                    "seed {seed}, {model:?}: {line}\n{content}"
                );
            }
        }
    }
    assert!(
        solved > cases / 2 && nothing > 0,
        "{solved} solved, {nothing} zeros"
    );
}

/// A file with a misalignment and nothing else is not said to state no loads.
#[test]
fn a_misalignment_is_not_passed_over() {
    for name in ["gripper-10", "four-bar-planar", "four-bar"] {
        let text_of = builtin::text(name).unwrap();
        let file: toml::Table = text_of.parse().unwrap();
        let joint = &file["joint"][1]["id"];
        let askew = format!(
            "\n[workload.stiffness.default]\nlinear = 1e7\nangular = 1e4\n[[workload.misalignment]]\njoint = {joint}\nangle = 0.001\naxis = \"x\"\n"
        );
        let (_folder, path) = write_temporary("askew.toml", text_of.to_owned() + &askew);
        let said = utf8_text(&run(&["statics", path]).stdout);
        assert!(
            said.contains("states no loads but 1 misalignment"),
            "{name}: {said}"
        );
    }
}
