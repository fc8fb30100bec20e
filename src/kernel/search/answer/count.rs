//! Numbers of variants, as wide as they need to be.

use num_bigint::BigUint;
use std::ops::AddAssign;

/// A number of variants.
pub(crate) trait Count: Clone + Send + Sync + for<'a> AddAssign<&'a Self> {
    /// No variant.
    fn none() -> Self;
    /// One variant.
    fn one() -> Self;
    /// Adds the product of two numbers.
    fn add_product(&mut self, a: &Self, b: &Self);
    /// As a number of any size.
    fn big(&self) -> BigUint;
    /// Bytes held besides the number itself.
    fn beside(&self) -> usize {
        0
    }
}

impl Count for u128 {
    fn none() -> Self {
        0
    }
    fn one() -> Self {
        1
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self += a * b;
    }
    fn big(&self) -> BigUint {
        BigUint::from(*self)
    }
}

impl Count for BigUint {
    fn none() -> Self {
        BigUint::ZERO
    }
    fn one() -> Self {
        BigUint::from(1u8)
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self += a * b;
    }
    fn big(&self) -> BigUint {
        self.clone()
    }
    fn beside(&self) -> usize {
        // Its digits, and what an allocation takes.
        usize::try_from(self.bits() / 8).unwrap_or(usize::MAX / 4) + 32
    }
}

/// A number below 2^(64 N), held in place: tables of counts that are added a million times allocate nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Wide<const N: usize>([u64; N]);

impl<const N: usize> AddAssign<&Wide<N>> for Wide<N> {
    fn add_assign(&mut self, other: &Wide<N>) {
        let mut carried = false;
        for (own, &digit) in self.0.iter_mut().zip(&other.0) {
            let (sum, over) = own.overflowing_add(digit);
            let (sum, again) = sum.overflowing_add(u64::from(carried));
            (*own, carried) = (sum, over | again);
        }
        debug_assert!(!carried, "no count exceeds that of all variants");
    }
}

impl<const N: usize> Count for Wide<N> {
    fn none() -> Self {
        Wide([0; N])
    }
    fn one() -> Self {
        let mut digits = [0; N];
        digits[0] = 1;
        Wide(digits)
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        for (i, &digit) in b.0.iter().enumerate().filter(|(_, d)| **d != 0) {
            let mut carried = 0;
            for (own, &other) in self.0[i..].iter_mut().zip(&a.0) {
                let sum = u128::from(*own) + u128::from(digit) * u128::from(other) + carried;
                (*own, carried) = (sum as u64, sum >> 64);
            }
            debug_assert!(carried == 0, "no count exceeds that of all variants");
        }
    }
    fn big(&self) -> BigUint {
        let halves = self.0.iter().flat_map(|&d| [d as u32, (d >> 32) as u32]);
        BigUint::new(halves.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::{Count, Wide};
    use num_bigint::BigUint;

    /// Three times as much again and again, then twice, up to the last bit, as numbers of any size have it.
    #[test]
    fn digits_add_as_numbers_of_any_size_do() {
        let (mut digits, mut big) = (Wide::<4>::one(), BigUint::one());
        for _ in 0..160 {
            let once = digits.clone();
            digits += &once;
            digits += &once;
            big *= 3u8;
            assert_eq!(digits.big(), big);
        }
        assert!(big.bits() > 250, "all four digits are in use");
        while big.bits() < 256 {
            let once = digits.clone();
            digits += &once;
            big *= 2u8;
        }
        assert_eq!(digits.big(), big);
    }

    /// Powers of a number of two digits, and what was before added, as numbers of any size have them.
    #[test]
    fn digits_multiply_as_numbers_of_any_size_do() {
        let mut factor = Wide::<8>::one();
        (0..70).for_each(|_| factor += &factor.clone());
        factor += &Wide::one();
        let (mut digits, mut big) = (Wide::<8>::one(), BigUint::one());
        for _ in 0..7 {
            let once = digits.clone();
            digits.add_product(&once, &factor);
            big += &big * factor.big();
            assert_eq!(digits.big(), big);
        }
        assert!(big.bits() > 448, "all eight digits are in use");
    }
}
