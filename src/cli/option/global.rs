//! The options that every command has.

use clap::Args as ClapArgs;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Global {
    /// Nothing but errors on standard error: no progress bar, no report of an import, no warnings.
    #[arg(long, short, global = true)]
    pub(in crate::cli) quiet: bool,
    /// Threads to use; all processors by default. Results do not depend on it.
    #[arg(long, global = true, value_name = "N")]
    pub(in crate::cli) threads: Option<usize>,
    /// Seed of random samples.
    #[arg(long, global = true, value_name = "N", default_value_t = 1)]
    pub(in crate::cli) seed: u64,
}
