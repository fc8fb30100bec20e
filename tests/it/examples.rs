//! The examples of the library run; each holds its own figures.

#[path = "../examples/builder.rs"]
mod builder;
#[path = "../examples/catalogue.rs"]
mod catalogue;
#[path = "../examples/lint.rs"]
mod lint;
#[path = "../examples/ranking.rs"]
mod ranking;
#[path = "../examples/redesign.rs"]
mod redesign;

#[test]
fn a_redesign_is_found() {
    redesign::main().unwrap();
}

#[test]
fn redesigns_are_ranked_under_a_workload() {
    ranking::main().unwrap();
}

#[test]
fn a_catalogue_is_built() {
    catalogue::main().unwrap();
}

#[test]
fn a_robot_is_linted() {
    lint::main().unwrap();
}

#[test]
fn a_mechanism_is_built_in_code() {
    builder::main().unwrap();
}
