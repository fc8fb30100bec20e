//! Numbers, phrases and tables as text, for everything that writes for people or for other programs.

pub mod csv;
pub mod number;
pub mod phrase;
pub mod plain;
