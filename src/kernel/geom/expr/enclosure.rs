//! Rigorous enclosures: intervals with big-integer ends that certainly contain a value.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::sync::LazyLock;

/// Precision of an enclosure, in bits.
const PRECISION: u64 = 256;
/// Scale of the fixed-point cosine series; the spare bits absorb the rounding of its terms.
const FIXED: u64 = 320;
/// Limit of binary exponents, far beyond the range of `f64`.
const EXPONENT_LIMIT: i64 = 1 << 40;

/// A closed interval `[lo, hi] * 2^e` that contains a real number.
#[derive(Clone)]
pub(super) struct Enclosure {
    pub(super) lo: BigInt,
    pub(super) hi: BigInt,
    pub(super) e: i64,
}

fn floor_shift(x: &BigInt, s: i64) -> BigInt {
    if s >= 0 {
        x >> s
    } else {
        x << s.unsigned_abs()
    }
}

fn ceil_shift(x: &BigInt, s: i64) -> BigInt {
    -floor_shift(&-x, s)
}

fn ceil_div(a: &BigInt, b: &BigInt) -> BigInt {
    -(-a).div_floor(b)
}

impl Enclosure {
    pub(super) fn new(lo: BigInt, hi: BigInt, e: i64) -> Enclosure {
        let excess = lo.bits().max(hi.bits()).saturating_sub(PRECISION) as i64;
        let (lo, hi) = if excess > 0 {
            (floor_shift(&lo, excess), ceil_shift(&hi, excess))
        } else {
            (lo, hi)
        };
        Enclosure {
            lo,
            hi,
            e: e.saturating_add(excess)
                .clamp(-EXPONENT_LIMIT, EXPONENT_LIMIT),
        }
    }

    pub(super) fn rational(r: &BigRational) -> Enclosure {
        let shift = if r.is_integer() {
            0
        } else {
            (PRECISION + r.denom().bits()).saturating_sub(r.numer().bits())
        };
        let n = r.numer() << shift;
        Enclosure::new(
            n.div_floor(r.denom()),
            ceil_div(&n, r.denom()),
            -(shift as i64),
        )
    }

    pub(super) fn has_zero(&self) -> bool {
        !self.lo.is_positive() && !self.hi.is_negative()
    }

    pub(super) fn is_zero(&self) -> bool {
        self.lo.is_zero() && self.hi.is_zero()
    }

    pub(super) fn neg(&self) -> Enclosure {
        Enclosure {
            lo: -&self.hi,
            hi: -&self.lo,
            e: self.e,
        }
    }

    pub(super) fn add(&self, other: &Enclosure) -> Enclosure {
        if self.is_zero() || other.is_zero() {
            let x = if self.is_zero() { other } else { self };
            return Enclosure {
                lo: x.lo.clone(),
                hi: x.hi.clone(),
                e: x.e,
            };
        }
        // A term far below the other is rounded away rather than aligned, for any exponents.
        let e = self
            .e
            .min(other.e)
            .max(self.e.max(other.e) - 2 * PRECISION as i64);
        let lo = floor_shift(&self.lo, e - self.e) + floor_shift(&other.lo, e - other.e);
        let hi = ceil_shift(&self.hi, e - self.e) + ceil_shift(&other.hi, e - other.e);
        Enclosure::new(lo, hi, e)
    }

    pub(super) fn mul(&self, other: &Enclosure) -> Enclosure {
        let products = [
            &self.lo * &other.lo,
            &self.lo * &other.hi,
            &self.hi * &other.lo,
            &self.hi * &other.hi,
        ];
        Enclosure::interval_hull(products.iter(), products.iter(), self.e + other.e)
    }

    pub(super) fn interval_hull<'a>(
        lows: impl Iterator<Item = &'a BigInt>,
        highs: impl Iterator<Item = &'a BigInt>,
        e: i64,
    ) -> Enclosure {
        Enclosure::new(
            lows.min().cloned().unwrap_or_default(),
            highs.max().cloned().unwrap_or_default(),
            e,
        )
    }

    /// Returns the quotient. A divisor that contains zero (which callers exclude) yields zero.
    pub(super) fn div(&self, other: &Enclosure) -> Enclosure {
        if other.has_zero() {
            return Enclosure::new(BigInt::zero(), BigInt::zero(), 0);
        }
        let shift = PRECISION + other.lo.bits().max(other.hi.bits());
        let (lo, hi) = (&self.lo << shift, &self.hi << shift);
        let pairs = [
            (&lo, &other.lo),
            (&lo, &other.hi),
            (&hi, &other.lo),
            (&hi, &other.hi),
        ];
        let (lows, highs) = (
            pairs.map(|(a, b)| a.div_floor(b)),
            pairs.map(|(a, b)| ceil_div(a, b)),
        );
        Enclosure::interval_hull(lows.iter(), highs.iter(), self.e - other.e - shift as i64)
    }

    pub(super) fn pow(&self, n: i64) -> Enclosure {
        let mut result = Enclosure::new(BigInt::one(), BigInt::one(), 0);
        for bit in (0..64 - n.unsigned_abs().leading_zeros()).rev() {
            result = result.mul(&result);
            if n.unsigned_abs() >> bit & 1 == 1 {
                result = result.mul(self);
            }
        }
        if n < 0 {
            Enclosure::new(BigInt::one(), BigInt::one(), 0).div(&result)
        } else {
            result
        }
    }

    pub(super) fn sqrt(&self) -> Enclosure {
        let mut shift = (2 * PRECISION).saturating_sub(self.hi.bits());
        if (self.e - shift as i64).rem_euclid(2) == 1 {
            shift += 1;
        }
        let positive = |x: &BigInt| {
            if x.is_negative() {
                BigInt::zero()
            } else {
                x << shift
            }
        };
        let (lo, hi) = (positive(&self.lo), positive(&self.hi));
        let root = hi.sqrt();
        let root = if &root * &root == hi { root } else { root + 1 };
        Enclosure::new(lo.sqrt(), root, (self.e - shift as i64) / 2)
    }

    pub(super) fn sin(k: u64, n: u64) -> Enclosure {
        // sin x = cos(x - 1/4 turn); the parser's bound on n keeps 4n in range.
        let (k, n) = (u128::from(k) * 4 + 3 * u128::from(n), u128::from(n) * 4);
        Enclosure::cos_turns(k % n, n)
    }

    pub(super) fn cos(k: u64, n: u64) -> Enclosure {
        Enclosure::cos_turns(u128::from(k), u128::from(n))
    }

    pub(super) fn cos_turns(k: u128, n: u128) -> Enclosure {
        let k = k.min(n.saturating_sub(k));
        if 4 * k > n {
            // cos x = -cos(1/2 turn - x)
            return Enclosure::cos_turns(n - 2 * k, 2 * n).neg();
        }
        static PI: LazyLock<BigInt> = LazyLock::new(|| {
            // Machin: pi = 16 atan(1/5) - 4 atan(1/239)
            let atan = |x: u32| {
                let mut power = (BigInt::one() << FIXED) / x;
                let (mut sum, mut j) = (BigInt::zero(), 0u32);
                while !power.is_zero() {
                    let term = &power / (2 * j + 1);
                    sum = if j % 2 == 0 { sum + term } else { sum - term };
                    power /= x * x;
                    j += 1;
                }
                sum
            };
            atan(5) * 16 - atan(239) * 4
        });
        let x: BigInt = &*PI * 2 * BigInt::from(k) / BigInt::from(n.max(1));
        let square: BigInt = (&x * &x) >> FIXED;
        let mut term = BigInt::one() << FIXED;
        let (mut sum, mut j) = (BigInt::zero(), 0u32);
        while !term.is_zero() {
            sum = if j % 2 == 0 { sum + &term } else { sum - &term };
            term = ((term * &square) >> FIXED) / ((2 * j + 1) * (2 * j + 2));
            j += 1;
        }
        // About 80 terms of an ulp or two each, times a few for pi.
        let slack = BigInt::from(1 << 14);
        Enclosure::new(&sum - &slack, sum + slack, -(FIXED as i64))
    }

    /// Returns the midpoint rounded to nearest even.
    pub(super) fn to_f64(&self) -> f64 {
        let (mid, e) = (&self.lo + &self.hi, self.e - 1);
        let signs_differ = self.lo.is_negative() && self.hi.is_positive();
        // Below all subnormals; aligning such a number would take memory in proportion to its exponent.
        if signs_differ || mid.is_zero() || e + (mid.bits() as i64) < -1080 {
            return 0.0;
        }
        // With this exponent and any larger one the number is infinite.
        let e = e.min(1100);
        if mid.bits() < 1000 && e > -1000 {
            // The nearest double of the midpoint, which a power of two scales exactly.
            let near = mid.to_f64().unwrap_or(f64::NAN) * 2f64.powi(e as i32);
            if near.abs() > f64::MIN_POSITIVE {
                return near;
            }
        }
        let exact = BigRational::new_raw(mid << e.max(0), BigInt::one() << (-e).max(0));
        exact.to_f64().unwrap_or(f64::NAN)
    }
}

#[cfg(test)]
mod tests {
    use super::Enclosure;
    use num_bigint::BigInt;

    /// A longer number of the same value is rounded as a fraction.
    #[test]
    fn short_and_long_numbers_have_the_same_double() {
        let odd = [1_i64 << 53, 1 << 54, 1 << 60, i64::MAX - 2000];
        let near = odd.into_iter().flat_map(|n| (-9..=9).map(move |by| n + by));
        for n in near.flat_map(|n| [n, -n, 3 * (n >> 2)]).map(BigInt::from) {
            let of = |n: &BigInt, e| {
                Enclosure {
                    lo: n.clone(),
                    hi: n.clone(),
                    e,
                }
                .to_f64()
            };
            for e in [-900, -1, 0, 70] {
                assert_eq!(of(&n, e), of(&(&n << 1100), e - 1100), "{n}");
            }
            let tail: BigInt = (&n << 150) + 1;
            assert_eq!(of(&tail, -150), of(&(&tail << 1000), -1150), "{tail}");
        }
    }
}
