//! Numbers, phrases and tables as text, for everything that writes for people or for other programs.

pub(crate) mod csv;
pub(crate) mod number;
pub(crate) mod phrase;
pub(crate) mod plain;
