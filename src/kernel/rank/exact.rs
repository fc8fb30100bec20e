//! Ranks and kernels in exact arithmetic: modulo primes, over the rationals, and with certificates.

pub mod certificate;
pub mod field;
pub(in crate::rank) mod kernel;
pub mod modular;
pub mod rational;
pub(crate) mod reconstruct;
