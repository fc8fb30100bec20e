//! `ozols completions`.

use super::args::Args;
use super::{Done, output};
use clap::Args as ClapArgs;
use clap::CommandFactory;

#[derive(Debug, ClapArgs)]
pub(super) struct Completions {
    /// The shell.
    #[arg(value_enum, value_name = "SHELL")]
    shell: clap_complete::Shell,
}

pub(super) fn run(a: &Completions) -> anyhow::Result<Done> {
    // The generator panics where it cannot write, so it writes to memory.
    let mut script = Vec::new();
    clap_complete::generate(a.shell, &mut Args::command(), "ozols", &mut script);
    output::to(None, |out| {
        out.write_all(&script)?;
        Ok(Done::Found)
    })
}
