//! Linear algebra over a prime field: exact zero tests at machine speed; and exact arithmetic in number rings.

pub mod common_denominator;
pub mod echelon;
pub(crate) mod exterior;
pub mod modp;
pub mod number_ring;
