//! The file of a catalogue: an SQLite database, a structure a transaction, so that it can be ended at any moment and
//! carried on.

mod held;
mod merge;
mod open;
mod version;

pub use held::Store;
pub use merge::Merged;
pub use version::StoreError;
