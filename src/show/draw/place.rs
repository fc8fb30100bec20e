//! Placement of links and joints in a picture: layouts of schemes, found with a seeded random search, and projections
//! of mechanisms.

pub(super) mod graph;
pub(super) mod initial_layout;
pub(super) mod layout;
pub(super) mod layout_penalty;
pub(super) mod projection;

/// Numbers that look random and are the same each time.
#[derive(Debug)]
struct Dice(u64);

impl Dice {
    fn new(seed: u64) -> Dice {
        Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d)
    }

    /// Returns a uniform random number in 0..1.
    fn random_unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a uniform random number in -1..1.
    fn random_signed(&mut self) -> f64 {
        2.0 * self.random_unit() - 1.0
    }

    /// Returns a uniform random number in 0..n.
    fn random_below(&mut self, n: usize) -> usize {
        ((self.random_unit() * n as f64) as usize).min(n.saturating_sub(1))
    }
}
