//! The `ozols` command; see the library for what it does.

fn main() -> std::process::ExitCode {
    ozols::cli::run()
}
