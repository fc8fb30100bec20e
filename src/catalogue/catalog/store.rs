//! The file of a catalogue: an SQLite database, a structure a transaction, so that it can be ended at any moment and
//! carried on.

mod error;
mod held;
mod merge;
mod open;
mod version;

pub use error::StoreError;
pub use held::Store;
pub use merge::Merged;
