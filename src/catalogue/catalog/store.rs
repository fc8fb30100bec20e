//! The file of a catalogue: an SQLite database with one transaction per structure, so that a build can be stopped at any moment and
//! continued.

mod held;
mod merge;
mod open;
mod version;

pub use held::Store;
pub use merge::Merged;
pub use version::StoreError;
