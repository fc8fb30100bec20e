//! Arguments that several commands have.

pub(in crate::cli) mod format;
pub(in crate::cli) mod global;
pub(in crate::cli) mod load;
pub(in crate::cli) mod named;
pub(in crate::cli) mod picture;
pub(in crate::cli) mod reading;
pub(in crate::cli) mod request;
pub(in crate::cli) mod variant;
