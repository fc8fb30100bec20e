//! What is redundant in a robot description, and what removes it.
//!
//! `cargo run --example lint`

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ozols::redundancy::duplicate_constraints::held_twice;
use ozols::robots::Options;
use ozols::view::lint::describe_release;
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/robots");
    let robot = ozols::import(format!("{folder}/gripper.xml"), &Options::default())?;
    let m = &robot.mechanism;
    let closes = |j| robot.origin.closes(j);
    let found = held_twice(m, &closes, &|_| true, None)?;
    println!(
        "{}: {} redundant constraints",
        m.name, found.analysis.redundant
    );
    for &i in &found.cheapest {
        println!("  {}", describe_release(m, &found.releases[i].1));
    }
    assert_eq!(found.cheapest.len(), found.lasting);
    Ok(())
}
