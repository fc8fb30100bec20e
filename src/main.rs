//! The `ozols` command; see the library for what it does.

/// Searches take and give back small pieces of memory by the million.
#[global_allocator]
static MEMORY: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    ozols::cli::run()
}
