//! Numbers of variants, as wide as they need to be.

use num_bigint::BigUint;

/// A number of variants.
pub(crate) trait Count: Clone + Send + Sync {
    /// Returns the count of no variant.
    fn zero_count() -> Self;
    /// Returns the count of one variant.
    fn unit_count() -> Self;
    /// Adds a number.
    fn add_count(&mut self, other: &Self);
    /// Adds the product of two numbers.
    fn add_product(&mut self, a: &Self, b: &Self);
    /// Returns the count as a number of any size.
    fn to_big_uint(&self) -> BigUint;
    /// Returns the number of bytes held in addition to the number itself.
    fn heap_bytes(&self) -> usize {
        0
    }
}

/// What exceeds 128 bits counts as the largest number.
impl Count for u128 {
    fn zero_count() -> Self {
        0
    }
    fn unit_count() -> Self {
        1
    }
    fn add_count(&mut self, other: &Self) {
        *self = self.saturating_add(*other);
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self = self.saturating_add(a.saturating_mul(*b));
    }
    fn to_big_uint(&self) -> BigUint {
        BigUint::from(*self)
    }
}

impl Count for BigUint {
    fn zero_count() -> Self {
        BigUint::ZERO
    }
    fn unit_count() -> Self {
        BigUint::from(1u8)
    }
    fn add_count(&mut self, other: &Self) {
        *self += other;
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self += a * b;
    }
    fn to_big_uint(&self) -> BigUint {
        self.clone()
    }
    fn heap_bytes(&self) -> usize {
        // Its digits, and what an allocation takes.
        usize::try_from(self.bits() / 8).unwrap_or(usize::MAX / 4) + 32
    }
}
