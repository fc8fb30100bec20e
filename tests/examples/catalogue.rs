//! A small catalogue: every gripper of up to six links, laid out and searched.
//!
//! `cargo run --example catalogue`

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ozols::catalog::build::{build_rows, plan_work};
use ozols::catalog::spec::Spec;
use ozols::shard::Shard;
use std::error::Error;
use std::ops::ControlFlow;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let spec = Spec {
        links: "4..6".to_owned(),
        ..Spec::default()
    };
    let work = plan_work(&spec, Shard::WHOLE)?;
    let mut rows = Vec::new();
    build_rows(
        &spec,
        &work,
        |_| false,
        |row| {
            rows.push(row);
            ControlFlow::<()>::Continue(())
        },
    )?;
    rows.sort_by_key(|row| row.structure.id());
    for row in &rows {
        let id = row.structure.id();
        match &row.laid {
            Ok(laid) => println!(
                "{id}: W = {}, σ = {} as built",
                laid.as_built.0, laid.as_built.1
            ),
            Err(why) => println!("{id}: {why}"),
        }
    }
    assert_eq!(rows.len(), work.structure_count());
    Ok(())
}
