//! What all texts for people have in common: tables that fit the terminal, prefixes of units, commands to go on with.

pub mod layout;
pub mod next_commands;
