//! Linear algebra over a prime field: exact zero tests at machine speed; and exact arithmetic in number rings.

pub mod echelon;
pub mod modp;
pub mod number_ring;
