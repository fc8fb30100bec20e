//! Roots of rationals as rationals times roots of distinct primes.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::geom::expr::Expr;
use crate::linalg::modp::is_prime;

/// Reason why expressions have no image in a prime field.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExactError {
    /// A nested root lies in the field already, and its sign could not be determined.
    #[error(
        "the nested root sqrt({radicand}) depends on the other roots and angles in a way that \
        cannot be resolved exactly; write it without nesting, or give a decimal"
    )]
    AmbiguousNestedRoot {
        /// The number under the root.
        radicand: String,
    },
    /// A divisor is zero.
    #[error("`{expression}` divides by zero; correct the divisor")]
    DivisionByZero {
        /// The expression.
        expression: String,
    },
    /// A radicand could not be factored.
    #[error(
        "the number under sqrt({radicand}) is too large to factor; write it with fewer digits, or give a decimal"
    )]
    RadicandTooLarge {
        /// The number under the root.
        radicand: String,
    },
    /// The angles have no small common denominator.
    #[error("the angles have no common denominator below 2^44; write them with fewer decimals")]
    AnglesTooFine,
    /// Too many independent square roots.
    #[error(
        "{count} independent square roots exceed the limit of {limit}; give some of them as decimals"
    )]
    TooManyRoots {
        /// Number of roots.
        count: usize,
        /// Maximum number of roots.
        limit: usize,
    },
    /// There are no more primes of the required size.
    #[error(
        "no suitable prime number {nth} below 2^62; ask for fewer, or simplify roots and angles"
    )]
    NoPrime {
        /// Index of the requested prime.
        nth: usize,
    },
    /// The expression was not among those the field was made for.
    #[error(
        "`{expression}` lies outside the field; include it among the expressions the field is made for"
    )]
    NotInField {
        /// The expression.
        expression: String,
    },
}

/// Limit of the trial division of radicands, and of Gauss sums, which are linear in the prime.
pub(crate) const TRIAL_LIMIT: u64 = 1_000_000;

/// `coef * product of sqrt(prime)`: the root of a rational.
#[derive(Debug, Clone)]
pub(crate) struct Radical {
    pub(crate) coef: BigRational,
    pub(crate) primes: Vec<u64>,
}

/// Returns the root of a nonnegative rational as a rational times roots of distinct primes. Prime factors up to 10^6
/// are found by division, and those of a cofactor below 2^64 by Pollard's rho. Beyond that only squares are recognised.
pub(crate) fn simplify_root(r: &BigRational) -> Result<Radical, ExactError> {
    let too_large = || ExactError::RadicandTooLarge {
        radicand: Expr::rational(r.clone()).to_string(),
    };
    if r.is_zero() {
        return Ok(Radical {
            coef: BigRational::zero(),
            primes: Vec::new(),
        });
    }
    if r.is_negative() || r.numer().bits() + r.denom().bits() > 1 << 12 {
        return Err(too_large());
    }
    let (a, mut primes) = split_square(r.numer()).ok_or_else(too_large)?;
    let (b, under) = split_square(r.denom()).ok_or_else(too_large)?;
    // sqrt(q)/q for the primes in the denominator, which are distinct from those in the numerator
    let below = under.iter().fold(b, |product, q| product * q);
    primes.extend(under);
    primes.sort_unstable();
    Ok(Radical {
        coef: BigRational::new(a, below),
        primes,
    })
}

/// Returns `x = s^2 * product of primes` as `(s, primes)`.
fn split_square(x: &BigInt) -> Option<(BigInt, Vec<u64>)> {
    let (mut rest, mut root, mut primes) = (x.clone(), BigInt::one(), Vec::new());
    let mut note = |q: u64, count: u32| {
        root *= BigInt::from(q).pow(count / 2);
        if count % 2 == 1 {
            primes.push(q);
        }
    };
    let mut q = 2u64;
    while rest.bits() > 64 && q <= TRIAL_LIMIT {
        let mut count = 0;
        while (&rest % q).is_zero() {
            rest /= q;
            count += 1;
        }
        note(q, count);
        q += if q == 2 { 1 } else { 2 };
    }
    if let Some(small) = rest.to_u64() {
        for (q, count) in prime_factors(small) {
            note(q, count);
        }
        return Some((root, primes));
    }
    let s = rest.sqrt();
    (&s * &s == rest).then(|| (root * s, primes))
}

/// Returns the prime factors of a number with their multiplicities, in increasing order.
pub(crate) fn prime_factors(mut n: u64) -> Vec<(u64, u32)> {
    let mut primes = Vec::new();
    let mut q = 2u64;
    while q <= 1000 && q * q <= n {
        while n.is_multiple_of(q) {
            n /= q;
            primes.push(q);
        }
        q += if q == 2 { 1 } else { 2 };
    }
    let mut stack = vec![n];
    while let Some(m) = stack.pop() {
        if m <= 1 {
            continue;
        }
        if is_prime(m) {
            primes.push(m);
            continue;
        }
        let d = find_divisor(m);
        stack.extend([d, m / d]);
    }
    primes.sort_unstable();
    let mut counted: Vec<(u64, u32)> = Vec::new();
    for q in primes {
        match counted.last_mut() {
            Some((last, count)) if *last == q => *count += 1,
            _ => counted.push((q, 1)),
        }
    }
    counted
}

/// Returns a proper divisor of a composite number (Pollard's rho).
fn find_divisor(n: u64) -> u64 {
    let root = n.isqrt();
    if root * root == n {
        return root;
    }
    for c in 1..n {
        let step =
            |x: u64| ((u128::from(x) * u128::from(x) + u128::from(c)) % u128::from(n)) as u64;
        let (mut x, mut y, mut d) = (2, 2, 1);
        while d == 1 {
            x = step(x);
            y = step(step(y));
            d = x.abs_diff(y).gcd(&n);
        }
        if d != n {
            return d;
        }
    }
    n
}
