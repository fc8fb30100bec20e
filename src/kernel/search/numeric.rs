//! The search by singular values, for mechanisms that exact arithmetic does not have.

pub mod at_tolerance;
pub(in crate::search) mod in_order;
