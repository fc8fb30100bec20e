//! What the gate compiles, it compiles once: tests, the program and the Python package share their dependencies and crates, since
//! none of them asks for features that the others do not have.

use crate::common::*;
use std::process::Command;

/// By package and target, the features it is compiled with, as cargo plans a command without running it. The plan is one of cargo's
/// unstable outputs, which the compiler's own switch for such gives.
fn planned(command: &[&str]) -> BTreeMap<(String, String), BTreeSet<String>> {
    let out = Command::new(env!("CARGO"))
        .args(command)
        .args(["--features", "png", "--locked"])
        .args(["-Z", "unstable-options", "--unit-graph"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("RUSTC_BOOTSTRAP", "1")
        .output()
        .unwrap();
    let plan: Value = serde_json::from_slice(&out.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&out.stderr)));
    let mut all: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
    for unit in plan["units"].list() {
        // Tests themselves, and what runs a build script, are no libraries.
        if unit["mode"] == "build" {
            let of = |what: &Value| what.word().to_owned();
            let name = (of(&unit["pkg_id"]), of(&unit["target"]["name"]));
            let with = (&unit["features"], &unit["profile"]["opt_level"]);
            all.entry(name).or_default().insert(format!("{with:?}"));
        }
    }
    all
}

#[test]
fn tests_program_and_python_package_share_what_is_compiled() {
    let tests = planned(&["test"]);
    assert!(tests.len() > 100, "{}", tests.len());
    for command in [&["build"][..], &["build", "-p", "ozols-python"]] {
        let anew: Vec<_> = planned(command)
            .into_iter()
            .filter(|(name, with)| tests.get(name).is_some_and(|t| !with.is_subset(t)))
            .collect();
        assert!(anew.is_empty(), "{command:?} compiles anew: {anew:#?}");
    }
}
