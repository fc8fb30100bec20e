//! `ozols completions`.

use super::args::{Args, Completions};
use super::{Done, output};
use clap::CommandFactory;

pub(super) fn run(a: &Completions) -> anyhow::Result<Done> {
    // The generator panics where it cannot write, so it writes to memory.
    let mut script = Vec::new();
    clap_complete::generate(a.shell, &mut Args::command(), "ozols", &mut script);
    output::to(None, |out| {
        out.write_all(&script)?;
        Ok(Done::Found)
    })
}
