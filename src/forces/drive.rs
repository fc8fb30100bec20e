//! A torsional drive of two discs: its bar, a swing, a programme of swings, and its design.
//!
//! [`driving::design_drive`] combines all of it.

pub mod driving;
pub mod programme;
pub mod swing;
pub mod torsion;
