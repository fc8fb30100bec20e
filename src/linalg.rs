//! Linear algebra over a prime field: exact zero tests at machine speed.

pub mod echelon;
pub mod lanes;
pub mod modp;
