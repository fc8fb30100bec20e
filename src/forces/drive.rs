//! A torsional drive of two discs: its bar, a swing, a programme of swings, its design, and samples of it out of true.
//!
//! [`driving::drive`] does all of it.

pub mod cam;
pub mod driving;
pub mod programme;
pub mod swing;
pub mod tolerance_samples;
pub mod torsion;
