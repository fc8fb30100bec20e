//! Independent checks: brute force, another prime, singular values, other poses. None of them builds a diagram.

pub mod brute;
pub mod brute_float;
pub(crate) mod full_matrices;
pub mod other_poses;
pub mod second_opinion;
pub mod second_prime;
pub mod singular_values;
pub mod variant_mechanism;
