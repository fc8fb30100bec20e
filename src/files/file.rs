//! Mechanism files: one schema for TOML and JSON, read into a validated mechanism with every problem pointed at, written
//! back, looked over, changed with their comments kept, and made into templates.

#[doc(hidden)]
pub mod bounded;
mod control_characters;
pub mod costs;
mod digits;
mod doubted;
pub mod edit;
pub(crate) mod findings;
mod guessed_directions;
#[doc(hidden)]
pub mod identity;
#[doc(hidden)]
pub mod leftover;
mod lengths;
pub mod lint;
pub mod locate;
pub mod loose;
pub mod problem;
pub mod read;
mod rounding;
pub mod schema;
pub mod template;
pub mod text;
pub mod warning;
pub mod write;
