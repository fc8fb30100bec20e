//! What this process may have of the machine's memory: by the machine, by its control group, by `ulimit`.

use super::group;
use crate::cli::terminal::machine;

/// The least of all that bounds this process, in bytes; none where nothing is told.
pub(super) fn least() -> Option<u64> {
    let known = [machine::memory(), group::limit(), ulimit()];
    known.into_iter().flatten().min()
}

/// Most bytes of addresses, or of data, that the process may have: `ulimit -v` and `ulimit -d`.
#[cfg(unix)]
pub(super) fn ulimit() -> Option<u64> {
    use rustix::process::{Resource, getrlimit};
    let limits = [Resource::As, Resource::Data].map(|r| getrlimit(r).current);
    limits.into_iter().flatten().min()
}

#[cfg(not(unix))]
pub(super) fn ulimit() -> Option<u64> {
    None
}

/// Starts the program anew where addresses are scarce, with one pool of memory for all threads: glibc sets 64 MiB of addresses aside
/// for each thread's own, so that a few threads would use up what there is without holding any of it.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub(in crate::cli) fn share_pools(words: &[std::ffi::OsString]) {
    use std::os::unix::process::CommandExt;
    const POOLS: &str = "MALLOC_ARENA_MAX";
    /// With more than this, what is set aside does not matter.
    const PLENTY: u64 = 16 << 30;
    if ulimit().is_none_or(|l| l > PLENTY) || std::env::var_os(POOLS).is_some() {
        return;
    }
    if let (Ok(program), [name, rest @ ..]) = (std::env::current_exe(), words) {
        // It comes back where that does not work, and all goes on as it was.
        let _ = std::process::Command::new(program)
            .arg0(name)
            .args(rest)
            .env(POOLS, "1")
            .exec();
    }
}

#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub(in crate::cli) fn share_pools(_: &[std::ffi::OsString]) {}
