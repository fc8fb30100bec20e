//! Arguments of several commands, and arguments of every command.

pub(super) mod load;
pub(super) mod named;
pub(super) mod picture;
pub(super) mod reading;
pub(super) mod request;
pub(super) mod variant;

use clap::{Args as ClapArgs, ValueEnum};

#[derive(Debug, ClapArgs)]
pub(super) struct Global {
    /// Print errors only: no progress, import report or warnings.
    #[arg(long, short, global = true)]
    pub(super) quiet: bool,
    /// Number of threads [default: all processors]. Results do not depend on it.
    #[arg(long, global = true, value_name = "N")]
    pub(super) threads: Option<usize>,
    /// Seed of random samples.
    #[arg(long, global = true, value_name = "N", default_value_t = 1)]
    pub(super) seed: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum TextOrJson {
    Text,
    Json,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum TextJsonOrCsv {
    Text,
    Json,
    Csv,
}
