//! Twins and second opinions: every variant looked at, another prime, singular values, other poses. No diagram is built with any of it.

pub mod brute;
pub mod brute_float;
pub(crate) mod full_matrices;
pub mod other_poses;
pub mod pruned;
pub mod second_opinion;
pub mod second_prime;
pub mod singular_values;
pub mod variant_mechanism;
