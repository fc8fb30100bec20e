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

/// A number below 2^(64 N), held in place: tables of counts that are added a million times allocate nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Wide<const N: usize>([u64; N]);

impl<const N: usize> Count for Wide<N> {
    fn zero_count() -> Self {
        Wide([0; N])
    }
    fn unit_count() -> Self {
        let mut digits = [0; N];
        digits[0] = 1;
        Wide(digits)
    }
    fn add_count(&mut self, other: &Self) {
        let mut carried = false;
        for (own, &digit) in self.0.iter_mut().zip(&other.0) {
            let (sum, over) = own.overflowing_add(digit);
            let (sum, again) = sum.overflowing_add(u64::from(carried));
            (*own, carried) = (sum, over | again);
        }
        debug_assert!(!carried, "no count exceeds that of all variants");
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
    fn to_big_uint(&self) -> BigUint {
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
        let (mut digits, mut big) = (Wide::<4>::unit_count(), BigUint::unit_count());
        for _ in 0..160 {
            let once = digits.clone();
            digits.add_count(&once);
            digits.add_count(&once);
            big *= 3u8;
            assert_eq!(digits.to_big_uint(), big);
        }
        assert!(big.bits() > 250, "all four digits are in use");
        while big.bits() < 256 {
            let once = digits.clone();
            digits.add_count(&once);
            big *= 2u8;
        }
        assert_eq!(digits.to_big_uint(), big);
    }

    /// Powers of a number of two digits, and what was before added, as numbers of any size have them.
    #[test]
    fn digits_multiply_as_numbers_of_any_size_do() {
        let mut factor = Wide::<8>::unit_count();
        (0..70).for_each(|_| factor.add_count(&factor.clone()));
        factor.add_count(&Wide::unit_count());
        let (mut digits, mut big) = (Wide::<8>::unit_count(), BigUint::unit_count());
        for _ in 0..7 {
            let once = digits.clone();
            digits.add_product(&once, &factor);
            big += &big * factor.to_big_uint();
            assert_eq!(digits.to_big_uint(), big);
        }
        assert!(big.bits() > 448, "all eight digits are in use");
    }
}
