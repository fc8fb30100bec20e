//! The main job: every redesign of a gripper without redundant constraints, cheapest first.
//!
//! `cargo run --example redesign`

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ozols::score::request::List;
use ozols::{Error, Request};

pub(crate) fn main() -> Result<(), Error> {
    let gripper = ozols::built_in("gripper-10")?; // or ozols::open("mine.toml")
    let free = &ozols::analyze(&gripper)?[0];
    println!("as built: W = {}, σ = {}", free.mobility, free.redundant);

    let request = Request {
        max_mobility: Some(1),
        list: List::Top(3),
        ..Request::default()
    };
    let outcome = ozols::search(&gripper, &request)?;
    let size = outcome.search.size();
    println!("{} of {size} variants are determinate", outcome.admissible);
    for variant in outcome.variants() {
        println!("{variant}");
        assert_eq!((variant.redundant(), variant.mobility()), (0, 1));
    }
    let best = outcome.variants().next().map(|v| v.as_mechanism());
    let best = best.as_ref().unwrap_or(&gripper);
    println!("{} bytes of MJCF", ozols::export(best, "mjcf")?.len());
    Ok(())
}
