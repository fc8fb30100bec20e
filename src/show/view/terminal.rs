//! Common parts of texts for people: tables that fit the terminal, prefixes of units, next commands.

pub mod layout;
pub mod next_commands;
