//! The `ozols` command.
fn main() {}
