//! Redesigns ranked by the forces in their joints under a workload.
//!
//! `cargo run --example ranking`

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ozols::model::ranking::Term;
use ozols::score::request::List;
use ozols::{Error, Request};

pub(crate) fn main() -> Result<(), Error> {
    let loaded = ozols::built_in("gripper-10-loaded")?;
    let request = Request {
        rank: vec![(Term::PeakForce, 1.0), (Term::Cost, 0.1)],
        pool: Some(40),
        list: List::Top(3),
        ..Request::default()
    };
    let outcome = ozols::search(&loaded, &request)?;
    for variant in outcome.variants() {
        if let Some(scores) = variant.scores() {
            println!("{variant}; peak joint force {:.0} N", scores.force.value);
        }
    }
    Ok(())
}
