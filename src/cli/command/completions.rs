//! `ozols completions`.

use crate::cli::prelude::*;
use clap::Command;

#[derive(Debug, ClapArgs)]
pub(crate) struct Completions {
    /// Shell to complete for.
    #[arg(value_enum, value_name = "SHELL")]
    shell: clap_complete::Shell,
}

pub(crate) fn run(a: &Completions, mut program: Command) -> anyhow::Result<Done> {
    // The generator panics where it cannot write, so it writes to memory.
    let mut script = Vec::new();
    clap_complete::generate(a.shell, &mut program, "ozols", &mut script);
    output::put(None, script)
}
