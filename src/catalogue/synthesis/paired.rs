//! Layouts of grippers with slides, gears and slots, symmetric ones.
//!
//! Here every link has a pose of its own, and a joint is the rows that hold between two of them, whatever its kind: what hinges
//! alone allow, turns as the only unknown, does not go on with slots. Points are whole millimetres, directions have whole
//! lengths (3, 4 and 5), radii are whole, so that layouts are exact as they stand.

pub mod direction;
pub(crate) mod equations;
pub mod figures;
pub(crate) mod forces;
pub mod known;
pub mod layout;
pub(crate) mod mechanism;
pub(crate) mod mechanism_of_three;
mod moves;
pub mod places;
pub(crate) mod rows;
pub mod rules;
pub mod sketch;
pub mod structure;
pub(crate) mod threefold;
