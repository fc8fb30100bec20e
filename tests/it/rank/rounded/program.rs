//! One verdict, whichever command is asked.

use crate::common::*;
use ozols::model::rounded::looks_rounded;
use ozols::rank::rounded::nearly_special::{NearJoint, Reach, Relation, nearly_special};

/// The built-in four-bar tilted by 30 degrees about x, to so many decimals, its axes within the last of them.
fn tilted(decimals: usize) -> String {
    tilted_by(
        decimals,
        2e-5 * 10f64.powi(6 - i32::try_from(decimals).unwrap()),
    )
}

/// The same with axes out of parallel by so many degrees.
fn tilted_by(decimals: usize, off: f64) -> String {
    let mut file = run_quiet("show four-bar");
    let (s, c) = 30f64.to_radians().sin_cos();
    for (x, y) in [(0, 0), (0, 30), (80, 90), (120, 0)] {
        let (u, v) = (f64::from(y) * c, f64::from(y) * s);
        file = file.replace(
            &format!("point = [{x}, {y}, 0]"),
            &format!("point = [{x}, {u:.decimals$}, {v:.decimals$}]"),
        );
    }
    let axis = |n: i32| {
        let (s, c) = (30.0 + off * f64::from(n)).to_radians().sin_cos();
        format!("axis = [0, {:.decimals$}, {c:.decimals$}]", -s)
    };
    let mut n = 0;
    while file.contains("axis = [0, 0, 1]") {
        file = file.replacen("axis = [0, 0, 1]", &axis(n % 3 - 1), 1);
        n += 1;
    }
    file
}

fn value(stdout: &str) -> Value {
    serde_json::from_str(stdout).unwrap()
}

#[test]
fn every_command_takes_the_mechanism_as_meant() {
    let file = tilted(6);
    let s = &json_on("analyze", "it.toml", &file, "")["states"][0];
    assert_eq!(s["mobility"], 1, "{s:#}");
    assert_eq!(s["redundant"], 3, "{s:#}");
    assert_eq!(s["finite_mobility"], 1);
    assert_eq!(s["as_written"]["mobility"], 0);
    let v = json_on("search", "it.toml", &file, "");
    assert_eq!(v["determinate"], "34");
    assert_eq!(v["measured"]["agree"], false);
    assert_eq!(v["measured"]["states"][0]["meant"], "snapped");
    let on = |line: &str, more: &str| run_on(line, "it.toml", &file, more);
    has(
        &on("check", "").2,
        "the idealised geometry gives W = 1, σ = 3",
    );
    has(&on("report", "").1, "3 redundant constraints");
    has(&on("draw", "--kind scheme").1, "σ = 3");
    let (code, variant, _) = on("export", "--to toml --variant 1");
    assert_eq!(code, Some(0));
    let s = &json_on("analyze", "v.toml", &variant, "")["states"][0];
    assert_eq!((&s["mobility"], &s["redundant"]), (&json!(1), &json!(0)));
}

#[test]
fn what_is_meant_is_exported_exactly_and_what_is_written_on_demand() {
    let file = tilted(6);
    let export = |more: &[&str]| {
        let (code, text, stderr) = run_on(
            "export",
            "it.toml",
            &file,
            &[&["--to", "toml"], more].concat(),
        );
        assert_eq!(code, Some(0), "{stderr}");
        (text, stderr)
    };
    let (meant, told) = export(&[]);
    has(&told, "snapped: 4 axes parallel");
    let again = read(&meant);
    assert!(looks_rounded(&again).is_none(), "{meant}");
    let (_, stdout, stderr) = run_on("search", "again.toml", &meant, "--format json");
    lacks(&stderr, "snapped");
    let v = value(&stdout);
    assert_eq!(v["determinate"], "34");
    assert_eq!(v["exact"], true);
    let (written, told) = export(&["--as-written"]);
    lacks(&told, "snapped");
    let same = |text: &str| uncertainties(&read(text));
    assert_eq!(same(&written), same(&file));
}

/// A wishbone on two bolts, its ball, and the upright on a second ball and a rod: dimensions to 0.01 mm.
fn wishbone() -> String {
    write_mechanism(
        "name = \"wishbone\"\nlength_unit = \"mm\"",
        "0 arm upright*",
        "
        LF | 0 arm | revolute | 151.23, 0.00, 12.04 | 0.99998, 0.00001, 0.00632
        LR | 0 arm | revolute | -149.85, 0.00, 10.14 | 0.99998, -0.00002, 0.00635
        ball | arm upright | spherical | 3.42, 310.55, -14.31
        top | 0 upright | sphere-on-plane | 1.23, 290.12, 240.33 | 0, 1, 0
        ",
    )
}

#[test]
fn nothing_further_than_its_reach_is_nearly_special() {
    let m = read(&wishbone());
    for tolerance in [1e-6, 1e-5, 1e-4, 1e-3, 1e-2] {
        let reach = Reach::relative(tolerance, mechanism_size(&m));
        let near = nearly_special(&m, reach);
        assert!(
            near.iter()
                .all(|x| x.shift <= 1.0001 * reach.length && x.turn <= 1.0001 * reach.angle),
            "{tolerance}: {near:?}"
        );
    }
    let bolts = nearly_special(&m, Reach::relative(1e-3, mechanism_size(&m)));
    let [front, rear] = ["LF", "LR"].map(|id| m.joint_named(id).unwrap());
    let coaxial = |x: &NearJoint| {
        x.joint == rear
            && x.describe_deviation(&m).starts_with("0.0")
            && x.relations.contains(&(Relation::Coaxial, Some(front)))
    };
    assert!(bolts.iter().any(coaxial), "{bolts:?}");
}

#[test]
fn what_is_not_decided_is_said_so_everywhere() {
    // Twelve digits that agree in six: left over from rounding, or real?
    let file = tilted_by(12, 1e-4);
    let s = &json_on("analyze", "it.toml", &file, "")["states"][0];
    assert_eq!(s["certainty_kind"], "undecided");
    assert_eq!(s["finite_mobility_proven"], false);
    assert!(
        s["mobility_at_most"].as_i64() > s["mobility"].as_i64(),
        "{s:#}"
    );
    // Whichever is meant, the truth is in the bracket.
    let v = json_on("search", "it.toml", &file, "");
    let bound = |key: &str| -> u64 {
        let text = v["numeric"]["determinate"][key].word();
        text.parse().unwrap()
    };
    assert_eq!(v["exact"], false);
    assert_eq!(v["certainty"], "numeric");
    assert!(bound("from") <= 34 && 34 <= bound("to"), "{v:#}");
    has(&run_on("check", "it.toml", &file, "").2, "undecided");
    // What it says helps.
    let known = format!("{file}\n[tolerance]\ndirection = 1e-5\n");
    let v = json_on("search", "it.toml", &known, "");
    assert_eq!(v["determinate"], "34");
}

#[test]
fn the_finite_mobility_is_that_of_the_rank_whatever_the_method() {
    let file = tilted(6);
    let whole = registry::ALL
        .into_iter()
        .filter(|m| Method::of_method(m, None).is_some());
    for method in whole.map(|m| m.name()) {
        for tolerance in [None, Some("1e-4"), Some("1e-12")] {
            if tolerance.is_some() && ["auto", "modular", "rational", "finite"].contains(&method) {
                continue;
            }
            let tolerance = tolerance.map_or(String::new(), |t| format!("--tolerance {t}"));
            let more = format!("--method {method} {tolerance}");
            let s = &json_on("analyze", "it.toml", &file, &more)["states"][0];
            let figure = |key: &str| s[key].as_i64();
            let (w, finite) = (figure("mobility"), figure("finite_mobility"));
            // A four-bar in a regular pose: what moves at first order moves.
            let most = figure("finite_mobility_at_most").or(finite);
            assert!(finite <= w && w <= most, "{method} {tolerance:?}: {s:#}");
            let numeric = s["certainty_kind"] == "numeric";
            assert!(
                !numeric || s["finite_mobility_proven"] == false,
                "{method} {tolerance:?}"
            );
        }
    }
}

#[test]
fn a_tolerance_is_never_ignored() {
    for method in ["modular", "auto"] {
        let words = ["--method", method, "--tolerance", "1e-6"];
        assert_fails_on(
            "analyze",
            "it.toml",
            &tilted(6),
            &words,
            &format!("--method {method}"),
        );
    }
    // Exact geometry, too: the tilt of 1e-3 is nothing to 1e-2.
    let exact =
        run_quiet("show four-bar").replacen("axis = [0, 0, 1]", "axis = [0, \"1/1000\", 1]", 1);
    let w =
        |more: &str| json_on("analyze", "it.toml", &exact, more)["states"][0]["mobility"].whole();
    assert_eq!((w(""), w("--method svd --tolerance 1e-2")), (0, 1));
}
