//! Names, numbers and quantities, with what is allowed of each.

pub(crate) mod limits;
pub(in crate::file::read) mod names;
pub(crate) mod number;
pub(crate) mod parameters;
pub(crate) mod quantity;
pub(in crate::file::read) mod tolerance;
pub(in crate::file::read) mod unit;
