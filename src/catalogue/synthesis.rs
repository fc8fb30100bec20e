//! Synthesis: from a kinematic chain to grippers that have a place for every joint.
//!
//! A structure is a chain with the roles of its links, the motion of its driver, and its symmetry. A layout places its pins in the plane.
//! It is exactly symmetric and regular, and it moves as a gripper does. A search optimises its proportions. Coordinates are whole
//! millimetres, or thousandths in catalogues of structures that have only hinges: whole ones often give a special pose by chance. Turns of
//! whole coordinates by 120° are exact, too. This module also makes the random numbers for the search.

pub(crate) mod equations;
pub mod figures;
pub mod layout;
pub mod mechanism;
pub mod options;
pub mod place;
pub mod places;
pub mod recognize;
pub mod rules;
pub mod sketch;
pub mod stroke;
pub mod structure;
pub mod task;
pub mod workload;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};

/// Returns the random numbers of a start, the same for the same name and seed.
pub(crate) fn random_for(name: &str, seed: u64, start: u32) -> ChaCha8Rng {
    random_of(&format!("{name} {seed} {start}"))
}

/// Returns random numbers that follow from a text, the same for the same text.
pub(crate) fn random_of(text: &str) -> ChaCha8Rng {
    ChaCha8Rng::from_seed(Sha256::digest(text).into())
}

/// Returns a random number from 0 to 1.
#[allow(clippy::cast_precision_loss, reason = "53 bits")]
pub(crate) fn random_unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Returns a roughly normal random number of variance 1: the sum of four uniform numbers of 16 bits, each of variance 1/12.
pub(crate) fn random_normal(random: &mut ChaCha8Rng) -> f64 {
    let bits = random.next_u64();
    let sum: u64 = [0, 16, 32, 48].map(|at| bits >> at & 0xffff).iter().sum();
    #[allow(clippy::cast_precision_loss, reason = "18 bits")]
    let even = sum as f64 / f64::from(1 << 16);
    (even - 2.0) * 3.0_f64.sqrt()
}

/// Returns a random number below `n`.
#[allow(clippy::cast_possible_truncation, reason = "the remainder is an index")]
pub(crate) fn random_below(n: usize, random: &mut ChaCha8Rng) -> usize {
    (random.next_u64() % n as u64) as usize
}
