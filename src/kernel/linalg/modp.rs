//! Arithmetic modulo an odd prime below 2^62, in Montgomery form.
//!
//! Residues are plain `u64` in Montgomery form (`x·2^64 mod p`), which is a canonical representation: two residues are
//! equal if and only if their words are equal. With sixty-odd bits rather than thirty, a false zero in a whole search
//! (about 10^7 zero tests) is less likely than 10^-11. This holds as long as the numbers do not depend on the prime. A
//! coordinate that is a multiple of the prime is certainly a false zero, so primes are chosen by a hash of the
//! coordinates (`geom::exact`).

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// A residue in Montgomery form; meaningful only together with the [`Field`] that made it.
pub type Residue = u64;

/// The field of integers modulo an odd prime `p < 2^62`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    p: u64,
    /// -p^-1 mod 2^64
    neg_inv: u64,
    /// 2^64 mod p, the Montgomery form of 1
    one: u64,
    /// 2^128 mod p, multiplies a plain integer into Montgomery form
    r2: u64,
}

impl Field {
    /// Creates the field of `p` elements.
    ///
    /// # Panics
    /// Panics if `p` is even, or not below 2^62. The caller has to ensure that `p` is prime; see [`is_prime`].
    #[must_use]
    pub fn new(p: u64) -> Self {
        assert!(
            p & 1 == 1 && (3..1 << 62).contains(&p),
            "modulus out of range"
        );
        // Newton's iteration doubles the number of correct low bits each time.
        let mut inv = p;
        for _ in 0..6 {
            inv = inv.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inv)));
        }
        let one = ((1u128 << 64) % u128::from(p)) as u64;
        let r2 = ((u128::from(one) * u128::from(one)) % u128::from(p)) as u64;
        Field {
            p,
            neg_inv: inv.wrapping_neg(),
            one,
            r2,
        }
    }

    /// Returns the modulus.
    #[must_use]
    pub fn modulus(self) -> u64 {
        self.p
    }

    /// Returns the residue of 0.
    #[must_use]
    pub const fn zero(self) -> Residue {
        0
    }

    /// Returns the residue of 1.
    #[must_use]
    pub const fn one(self) -> Residue {
        self.one
    }

    /// Returns the product of two residues.
    #[inline(always)]
    #[must_use]
    pub fn mul(self, a: Residue, b: Residue) -> Residue {
        let t = u128::from(a) * u128::from(b);
        self.reduce_sum(t)
    }

    /// Returns `a·x - b·y` with one reduction.
    #[inline(always)]
    #[must_use]
    pub fn difference_of_products(self, a: Residue, x: Residue, b: Residue, y: Residue) -> Residue {
        // Below 2p² < 2^64·p/2, so the quotient is below 3p/2.
        let t = u128::from(a) * u128::from(x) + u128::from(b) * u128::from(self.p - y);
        self.reduce_sum(t)
    }

    /// Returns Σ a·b with one reduction.
    #[inline]
    #[must_use]
    pub fn sum_of_products(self, pairs: impl IntoIterator<Item = (Residue, Residue)>) -> Residue {
        // The sum is kept below p·2^64, and a product below p² is added: below 2^126 and 2^124.
        let least = u128::from(self.p) << 64;
        let t = pairs.into_iter().fold(0, |t: u128, (a, b)| {
            let t = t + u128::from(a) * u128::from(b);
            if t >= least { t - least } else { t }
        });
        self.reduce_sum(t)
    }

    /// Returns Σ x·y with one reduction, over the entries that both have.
    #[inline(always)]
    #[must_use]
    pub fn dot(self, x: &[Residue], y: &[Residue]) -> Residue {
        // Four products are below 4p², which is below p·2^64, the limit of the sum. Both together are below 2^128.
        let least = u128::from(self.p) << 64;
        let below = |t: u128| if t >= least { t - least } else { t };
        let product = |(&a, &b): (&Residue, &Residue)| u128::from(a) * u128::from(b);
        let (mut xs, mut ys) = (x.chunks_exact(4), y.chunks_exact(4));
        let mut t = 0;
        for (x, y) in xs.by_ref().zip(ys.by_ref()) {
            let product = |i: usize| product((&x[i], &y[i]));
            t = below(t + (product(0) + product(1)) + (product(2) + product(3)));
        }
        let done = x.len().min(y.len()) / 4 * 4;
        for pair in x[done..].iter().zip(&y[done..]) {
            t += product(pair);
        }
        self.reduce_sum(below(t))
    }

    /// Reduces a sum of products below p·2^64, divided by 2^64.
    #[inline(always)]
    fn reduce_sum(self, t: u128) -> Residue {
        let m = (t as u64).wrapping_mul(self.neg_inv);
        let u = ((t + u128::from(m) * u128::from(self.p)) >> 64) as u64;
        if u >= self.p { u - self.p } else { u }
    }

    /// Returns the sum of two residues.
    #[inline(always)]
    #[must_use]
    pub fn add(self, a: Residue, b: Residue) -> Residue {
        let s = a + b;
        if s >= self.p { s - self.p } else { s }
    }

    /// Returns the difference of two residues.
    #[inline(always)]
    #[must_use]
    pub fn sub(self, a: Residue, b: Residue) -> Residue {
        if a >= b { a - b } else { a + self.p - b }
    }

    /// Computes `x -= x[0]·y`, for `y[0] = 1`, which clears the first entry of `x`.
    #[inline]
    pub fn subtract_multiple(self, x: &mut [Residue], y: &[Residue]) {
        let a = x[0];
        if a != 0 {
            for (x, &y) in x.iter_mut().zip(y) {
                // Rows are sparse, and a product costs more than the test.
                if y != 0 {
                    *x = self.sub(*x, self.mul(a, y));
                }
            }
        }
    }

    /// Computes `x += a·y`.
    #[inline]
    pub fn add_multiple(self, x: &mut [Residue], a: Residue, y: &[Residue]) {
        for (x, &y) in x.iter_mut().zip(y).filter(|(_, y)| **y != 0) {
            *x = self.add(*x, self.mul(a, y));
        }
    }

    /// Computes `x += y` or `x -= y`.
    #[inline]
    pub fn add_or_subtract(self, x: &mut [Residue], y: &[Residue], plus: bool) {
        for (x, &y) in x.iter_mut().zip(y) {
            *x = if plus {
                self.add(*x, y)
            } else {
                self.sub(*x, y)
            };
        }
    }

    /// Returns the negative of a residue.
    #[inline(always)]
    #[must_use]
    pub fn neg(self, a: Residue) -> Residue {
        if a == 0 { 0 } else { self.p - a }
    }

    /// Returns `a` to the power `e`, in O(log e).
    #[must_use]
    pub fn pow(self, a: Residue, mut e: u64) -> Residue {
        let (mut base, mut acc) = (a, self.one);
        while e > 0 {
            if e & 1 == 1 {
                acc = self.mul(acc, base);
            }
            base = self.mul(base, base);
            e >>= 1;
        }
        acc
    }

    /// Returns the inverse of a nonzero residue.
    ///
    /// # Panics
    /// Panics if `a` is zero.
    #[must_use]
    pub fn inv(self, a: Residue) -> Residue {
        assert!(a != 0, "zero has no inverse");
        // Extended Euclid on plain integers is about three times faster than Fermat's power, and even faster for small
        // numbers. No factor exceeds p in size.
        let (mut r0, mut r1) = (self.p, self.to_u64(a));
        let (mut t0, mut t1) = (0i64, 1i64);
        while r1 != 0 {
            // Two quotients in three are below four, for which subtracting takes less time than a division.
            let (mut r, mut t) = (r0 - r1, t0 - t1);
            for _ in 0..2 {
                if r >= r1 {
                    (r, t) = (r - r1, t - t1);
                }
            }
            if r >= r1 {
                let q = r / r1;
                (r, t) = (r - q * r1, t - q.cast_signed() * t1);
            }
            (r0, r1, t0, t1) = (r1, r, t1, t);
        }
        let t = if t0 < 0 {
            t0 + self.p.cast_signed()
        } else {
            t0
        };
        self.mul(t.cast_unsigned(), self.r2)
    }

    /// Returns the residue of a small integer.
    #[must_use]
    pub fn from_i64(self, x: i64) -> Residue {
        let m = x.unsigned_abs() % self.p;
        let r = self.mul(m, self.r2);
        if x < 0 { self.neg(r) } else { r }
    }

    /// Returns the residue of an integer of any size.
    #[must_use]
    pub fn from_bigint(self, x: &BigInt) -> Residue {
        if let Some(small) = x.to_i64() {
            return self.from_i64(small);
        }
        let m = x
            .mod_floor(&BigInt::from(self.p))
            .to_u64()
            .expect("a residue is below p");
        self.mul(m, self.r2)
    }

    /// Returns the residue of a fraction, or `None` if `p` divides its denominator.
    #[must_use]
    pub fn from_rational(self, x: &BigRational) -> Option<Residue> {
        if x.is_integer() {
            return Some(self.from_bigint(x.numer()));
        }
        let d = self.from_bigint(x.denom());
        (d != 0).then(|| self.mul(self.from_bigint(x.numer()), self.inv(d)))
    }

    /// Returns the plain integer below `p` of a residue.
    #[must_use]
    pub fn to_u64(self, a: Residue) -> u64 {
        self.mul(a, 1)
    }

    /// Returns a square root of `a`, or `None` if `a` is not a square (Tonelli-Shanks; the smaller plain root).
    #[must_use]
    pub fn sqrt(self, a: Residue) -> Option<Residue> {
        if a == 0 {
            return Some(0);
        }
        let half = (self.p - 1) / 2;
        if self.pow(a, half) != self.one {
            return None;
        }
        let s = (self.p - 1).trailing_zeros();
        let q = (self.p - 1) >> s;
        let minus_one = self.neg(self.one);
        let z = (2..)
            .map(|i| self.from_i64(i))
            .find(|&z| self.pow(z, half) == minus_one)?;
        let (mut m, mut c, mut t, mut r) = (
            s,
            self.pow(z, q),
            self.pow(a, q),
            self.pow(a, q.div_ceil(2)),
        );
        while t != self.one {
            let mut i = 0;
            let mut t2 = t;
            while t2 != self.one {
                t2 = self.mul(t2, t2);
                i += 1;
            }
            let b = self.pow(c, 1 << (m - i - 1));
            m = i;
            c = self.mul(b, b);
            t = self.mul(t, c);
            r = self.mul(r, b);
        }
        let other = self.neg(r);
        Some(if self.to_u64(r) <= self.to_u64(other) {
            r
        } else {
            other
        })
    }
}

/// Returns true if `n` is prime: Miller-Rabin with the twelve bases that decide every 64-bit number.
///
/// # Sources
/// Sorenson & Webster, "Strong pseudoprimes to twelve prime bases", Math. Comp. 86 (2017).
///
/// # Examples
/// ```
/// use ozols::linalg::modp::is_prime;
/// assert!(is_prime((1 << 61) - 1)); // A prime of Mersenne.
/// assert!(!is_prime(561)); // The least number of Carmichael.
/// ```
#[must_use]
pub fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if n < 2 {
        return false;
    }
    for b in BASES {
        if n.is_multiple_of(b) {
            return n == b;
        }
    }
    let mulmod = |a: u64, b: u64| (u128::from(a) * u128::from(b) % u128::from(n)) as u64;
    let powmod = |mut b: u64, mut e: u64| {
        let mut acc = 1;
        while e > 0 {
            if e & 1 == 1 {
                acc = mulmod(acc, b);
            }
            b = mulmod(b, b);
            e >>= 1;
        }
        acc
    };
    let s = (n - 1).trailing_zeros();
    let d = (n - 1) >> s;
    BASES.iter().all(|&a| {
        let mut x = powmod(a, d);
        if x == 1 || x == n - 1 {
            return true;
        }
        (1..s).any(|_| {
            x = mulmod(x, x);
            x == n - 1
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn field() -> Field {
        let p = (1..)
            .map(|i| (1u64 << 61) + 2 * i + 1)
            .find(|&n| is_prime(n))
            .unwrap();
        Field::new(p)
    }

    #[test]
    fn inverses_are_right_in_the_smallest_and_the_largest_field() {
        let of = |mut all: Box<dyn Iterator<Item = u64>>| all.find(|&n| is_prime(n)).unwrap();
        let [least, most] = [of(Box::new(1 << 10..)), of(Box::new((0..1 << 62).rev()))];
        for f in [least, most].map(Field::new) {
            let half = f.modulus() / 2;
            for x in (1..500)
                .chain(half - 500..half + 500)
                .chain(f.modulus() - 500..f.modulus())
            {
                // Unchanged and as residues: each is a residue of some integer.
                for x in [x, f.mul(x, f.r2)] {
                    assert_eq!(f.mul(x, f.inv(x)), f.one(), "{x} modulo {}", f.modulus());
                }
            }
        }
    }

    proptest! {
        #[test]
        fn the_field_laws_hold_against_wide_integers(a in any::<i64>(), b in any::<i64>()) {
            let f = field();
            let p = i128::from(f.modulus());
            let (x, y) = (f.from_i64(a), f.from_i64(b));
            let wide = |v: i128| v.rem_euclid(p) as u64;
            prop_assert_eq!(f.to_u64(f.mul(x, y)), wide(i128::from(a) * i128::from(b)));
            prop_assert_eq!(f.to_u64(f.add(x, y)), wide(i128::from(a) + i128::from(b)));
            prop_assert_eq!(f.to_u64(f.sub(x, y)), wide(i128::from(a) - i128::from(b)));
            let (c, d) = (i64::from(b as i32), i64::from(a as i32));
            let cross = i128::from(a) * i128::from(c) - i128::from(b) * i128::from(d);
            prop_assert_eq!(f.to_u64(f.difference_of_products(x, f.from_i64(c), y, f.from_i64(d))), wide(cross));
            if x != 0 {
                prop_assert_eq!(f.mul(x, f.inv(x)), f.one());
            }
            let s = f.mul(x, x);
            let r = f.sqrt(s).unwrap();
            prop_assert_eq!(f.mul(r, r), s);
        }

        /// Includes the largest possible numbers in the largest field.
        #[test]
        fn sums_of_products_are_those_taken_one_by_one(
            pairs in prop::collection::vec((any::<u64>(), any::<u64>(), any::<bool>()), 0..60),
        ) {
            let largest = (1u64 << 61..1 << 62).rev().find(|&n| is_prime(n)).unwrap();
            for f in [field(), Field::new(largest)] {
                let most = f.modulus() - 1;
                let of = |x: u64, whole: bool| if whole { most } else { x % f.modulus() };
                let pairs = pairs.iter().map(|&(a, b, whole)| (of(a, whole), of(b, whole)));
                let slow = pairs.clone().fold(0, |sum, (a, b)| f.add(sum, f.mul(a, b)));
                prop_assert_eq!(f.sum_of_products(pairs.clone()), slow);
                let (x, y): (Vec<_>, Vec<_>) = pairs.unzip();
                prop_assert_eq!(f.dot(&x, &y), slow);
                prop_assert_eq!(f.dot(&x, &[&y[..], &[1; 5]].concat()), slow);
            }
        }
    }
}
