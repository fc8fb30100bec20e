//! The image of exact expressions in a prime field, under one consistent choice of roots.
//!
//! With N a multiple of 4 and of every angle's denominator (in turns), all cosines live in Q(zeta_N); a prime
//! `p = 1 mod N` carries that field into F_p. Square roots of primes that divide N already lie in Q(zeta_N), so they
//! have to be the Gauss sums; all other square roots are independent of it, and either root in F_p will do. The result
//! is a true ring homomorphism: whatever vanishes stays zero, and a nonzero number becomes zero only for the rare
//! primes that divide its norm.
//!
//! # Sources
//! Ireland & Rosen, "A Classical Introduction to Modern Number Theory", ch. 6 (quadratic Gauss sums).

use std::collections::{BTreeMap, HashMap};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::expr::{Expr, Function, Kind, MAX_ANGLE_DENOMINATOR, rational_sqrt};
use crate::linalg::modp::{Field, Residue, is_prime};

/// Trial division of radicands stops here; Gauss sums, linear in the prime, do too.
const TRIAL_LIMIT: u64 = 1_000_000;
/// Free square roots (of primes, or nested) whose primes are found by rejection, each halving the supply.
const MAX_FREE: usize = 14;
/// Nested roots that may be adjoined.
const MAX_NESTED: usize = 6;
/// Primes on which a radicand is tested for being a square.
const WITNESSES: usize = 24;
/// Candidates tried before the search for primes is given up.
const MAX_CANDIDATES: u64 = 1 << 23;
/// Primes lost to a vanishing divisor before the divisor is taken to be zero.
const MAX_FAILURES: usize = 32;

/// Why expressions have no image in a prime field.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExactError {
    /// A nested root lies in the field already, and its sign could not be settled.
    #[error(
        "the nested root sqrt({radicand}) depends on the other roots and angles in a way that is not resolved exactly; \
         write it without nesting, or give a decimal"
    )]
    AmbiguousNestedRoot {
        /// What stands under the root.
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
        /// What stands under the root.
        radicand: String,
    },
    /// The angles have no small common denominator.
    #[error("the angles have no common denominator below 2^44; round them to fewer decimals")]
    AnglesTooFine,
    /// Too many independent square roots.
    #[error(
        "{count} independent square roots exceed the limit of {limit}; give some of them as decimals"
    )]
    TooManyRoots {
        /// How many there are.
        count: usize,
        /// How many may be.
        limit: usize,
    },
    /// No more primes of the size wanted.
    #[error(
        "no suitable prime number {nth} below 2^62; ask for fewer, or simplify roots and angles"
    )]
    NoPrime {
        /// Which prime was asked for.
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

/// `coef * product of sqrt(prime)`: the root of a rational.
#[derive(Debug, Clone)]
struct Radical {
    coef: BigRational,
    primes: Vec<u64>,
}

/// A homomorphism from the number field of some expressions into F_p.
#[derive(Debug, Clone)]
pub struct ExactField {
    field: Field,
    /// N
    order: u64,
    /// A primitive N-th root of unity.
    zeta: Residue,
    roots: BTreeMap<u64, Residue>,
    radicals: BTreeMap<BigRational, Radical>,
    /// Radicands of the nested roots with the root chosen.
    nested: Vec<(Residue, Residue)>,
}

impl ExactField {
    /// The homomorphism into the `nth` suitable prime field above 2^61; the same expressions give the same field.
    ///
    /// Costs O(`nth`) prime searches, each of 2^k candidates for k independent roots, and O(q) for every prime q both
    /// under a root and in an angle.
    ///
    /// # Errors
    /// An [`ExactError`] where a divisor is zero, a nested root is ambiguous, or a limit on roots is exceeded.
    pub fn for_expressions<'a>(
        exprs: impl IntoIterator<Item = &'a Expr>,
        nth: usize,
    ) -> Result<ExactField, ExactError> {
        let exprs: Vec<&Expr> = exprs.into_iter().collect();
        let mut plan = Plan {
            order: 4,
            ..Plan::default()
        };
        let mut candidates = Vec::new();
        for e in &exprs {
            plan.collect(e, &mut candidates)?;
        }
        plan.finish(candidates.is_empty())?;
        for inner in candidates {
            if plan.independent(&inner)? {
                plan.nested.push(inner);
            }
        }
        let (mut found, mut failures) = (0, 0);
        for field in plan.fields() {
            let mut zero = None;
            for e in &exprs {
                match field.eval(e) {
                    Ok(_) => {}
                    Err(error @ ExactError::DivisionByZero { .. }) => {
                        zero = Some(error);
                        break;
                    }
                    Err(error) => return Err(error),
                }
            }
            if let Some(error) = zero {
                failures += 1;
                if failures > MAX_FAILURES {
                    return Err(error);
                }
                continue;
            }
            if found == nth {
                return Ok(field);
            }
            found += 1;
        }
        Err(ExactError::NoPrime { nth })
    }

    /// The field of residues. O(1).
    #[must_use]
    pub fn field(&self) -> Field {
        self.field
    }

    /// The image of an expression. O(nodes), each shared node once.
    ///
    /// # Errors
    /// [`ExactError::NotInField`] for roots or angles beyond those the field was made for, and
    /// [`ExactError::DivisionByZero`] where a divisor vanishes in F_p.
    pub fn eval(&self, expr: &Expr) -> Result<Residue, ExactError> {
        let f = self.field;
        if let Some(r) = expr.rational_ref() {
            return f.from_rational(r).ok_or_else(|| division(expr));
        }
        let mut memo: HashMap<usize, Residue> = HashMap::new();
        for e in expr.post_order() {
            let at = |c: &Expr| memo.get(&c.id()).copied().unwrap_or(f.zero());
            let inverse = |x: Residue| {
                if x == 0 {
                    Err(division(expr))
                } else {
                    Ok(f.inv(x))
                }
            };
            let value = match e.kind() {
                Kind::Rational(r) => f.from_rational(r).ok_or_else(|| division(expr))?,
                Kind::Add(a, b) => f.add(at(a), at(b)),
                Kind::Sub(a, b) => f.sub(at(a), at(b)),
                Kind::Mul(a, b) => f.mul(at(a), at(b)),
                Kind::Div(a, b) => f.mul(at(a), inverse(at(b))?),
                Kind::Neg(a) => f.neg(at(a)),
                Kind::Pow(a, n) => {
                    let power = f.pow(at(a), n.unsigned_abs());
                    if *n < 0 { inverse(power)? } else { power }
                }
                Kind::Sqrt(a) => self.sqrt(a, at(a))?,
                Kind::Trig(function, k, n) => {
                    if !self.order.is_multiple_of(*n) {
                        return Err(outside(e));
                    }
                    let z = f.pow(self.zeta, self.order / n * k);
                    let w = inverse(z)?;
                    let i = f.pow(self.zeta, self.order / 4);
                    // 2 cos and 2 i sin
                    let (c, s) = (f.add(z, w), f.sub(z, w));
                    let two = f.from_i64(2);
                    match function {
                        Function::Cos => f.mul(c, inverse(two)?),
                        Function::Sin => f.mul(s, inverse(f.mul(two, i))?),
                        Function::Tan => f.mul(s, inverse(f.mul(c, i))?),
                    }
                }
            };
            memo.insert(e.id(), value);
        }
        Ok(memo.get(&expr.id()).copied().unwrap_or(f.zero()))
    }

    /// The root of `inner`, whose image is `value`.
    fn sqrt(&self, inner: &Expr, value: Residue) -> Result<Residue, ExactError> {
        let f = self.field;
        if let Some(r) = inner.rational_ref() {
            let made;
            let radical = match self.radicals.get(r) {
                Some(radical) => radical,
                None => {
                    made = radical(r)?;
                    &made
                }
            };
            let coef = f
                .from_rational(&radical.coef)
                .ok_or_else(|| division(inner))?;
            return radical.primes.iter().try_fold(coef, |product, q| {
                self.roots
                    .get(q)
                    .map(|&root| f.mul(product, root))
                    .ok_or_else(|| outside(inner))
            });
        }
        // Rewritten roots have rational radicands only, so this recursion ends at depth one.
        if let Some(flat) = denested(inner) {
            return self.eval(&flat);
        }
        if value == 0 {
            return Ok(0);
        }
        // Equal radicands have equal images, however they are written.
        self.nested
            .iter()
            .find(|(a, _)| *a == value)
            .map(|&(_, root)| root)
            .ok_or_else(|| outside(inner))
    }
}

fn division(e: &Expr) -> ExactError {
    ExactError::DivisionByZero {
        expression: e.to_string(),
    }
}

fn outside(e: &Expr) -> ExactError {
    ExactError::NotInField {
        expression: e.to_string(),
    }
}

/// What a prime has to provide.
#[derive(Debug, Default)]
struct Plan {
    order: u64,
    /// Primes are taken 1 modulo this multiple of `order`.
    modulus: u64,
    order_primes: Vec<u64>,
    radicals: BTreeMap<BigRational, Radical>,
    /// Primes whose roots are needed: within Q(zeta_N), and independent of it.
    inner_roots: Vec<u64>,
    free_roots: Vec<u64>,
    nested: Vec<Expr>,
}

impl Plan {
    fn collect(&mut self, e: &Expr, candidates: &mut Vec<Expr>) -> Result<(), ExactError> {
        for node in e.post_order() {
            match node.kind() {
                Kind::Trig(_, _, n) => {
                    let lcm = u128::from(self.order).lcm(&u128::from(*n));
                    self.order = u64::try_from(lcm)
                        .ok()
                        .filter(|&l| l <= MAX_ANGLE_DENOMINATOR)
                        .ok_or(ExactError::AnglesTooFine)?;
                }
                Kind::Sqrt(inner) => {
                    if let Some(r) = inner.rational_ref() {
                        if !self.radicals.contains_key(r) {
                            self.radicals.insert(r.clone(), radical(r)?);
                        }
                    } else if let Some(flat) = denested(inner) {
                        self.collect(&flat, candidates)?;
                    } else {
                        candidates.push(inner.clone());
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Sorts the roots into those of Q(zeta_N) and the free ones, once all angles are known.
    fn finish(&mut self, flat: bool) -> Result<(), ExactError> {
        let mut primes: Vec<u64> = self
            .radicals
            .values()
            .flat_map(|r| r.primes.iter().copied())
            .collect();
        primes.sort_unstable();
        primes.dedup();
        self.order_primes = factor(self.order).into_iter().map(|(q, _)| q).collect();
        self.modulus = self.order;
        let mut rejected = 0;
        for q in primes {
            let inside = if q == 2 {
                self.order.is_multiple_of(8)
            } else {
                self.order.is_multiple_of(q)
            };
            if inside {
                if q > TRIAL_LIMIT {
                    return Err(ExactError::RadicandTooLarge {
                        radicand: q.to_string(),
                    });
                }
                self.inner_roots.push(q);
                continue;
            }
            self.free_roots.push(q);
            // By reciprocity q is a square modulo every p = 1 mod 4q. Not with nested roots about, though: those
            // would then be tested for squares in a larger field than the one at hand.
            let wanted = u128::from(self.modulus) * u128::from(if q == 2 { 2 } else { q });
            match u64::try_from(wanted) {
                Ok(m) if flat && m <= MAX_ANGLE_DENOMINATOR => self.modulus = m,
                _ => rejected += 1,
            }
        }
        if rejected > MAX_FREE {
            return Err(ExactError::TooManyRoots {
                count: rejected,
                limit: MAX_FREE,
            });
        }
        Ok(())
    }

    /// Whether the root of `inner` has to be adjoined, rather than being known already. On primes where all previous radicands are squares, a
    /// product of `inner` with some of them is a square exactly when `inner` is: one test covers all products.
    fn independent(&self, inner: &Expr) -> Result<bool, ExactError> {
        let (mut squares, mut zeros, mut failures) = (0, 0, 0);
        for field in self.fields() {
            let value = match field.eval(inner) {
                Ok(value) => value,
                Err(ExactError::DivisionByZero { .. }) if failures < MAX_FAILURES => {
                    failures += 1;
                    continue;
                }
                Err(error) => return Err(error),
            };
            if value == 0 {
                zeros += 1;
            } else if field.nested.iter().any(|&(a, _)| a == value) {
                return Ok(false);
            } else if field.field.sqrt(value).is_none() {
                if self.nested.len() == MAX_NESTED {
                    return Err(ExactError::TooManyRoots {
                        count: MAX_NESTED + 1,
                        limit: MAX_NESTED,
                    });
                }
                return Ok(true);
            } else {
                squares += 1;
            }
            if zeros >= 2 {
                return Ok(false);
            }
            if squares >= WITNESSES {
                return Err(ExactError::AmbiguousNestedRoot {
                    radicand: inner.to_string(),
                });
            }
        }
        Err(ExactError::NoPrime { nth: 0 })
    }

    /// The suitable primes in increasing order.
    fn fields(&self) -> impl Iterator<Item = ExactField> + '_ {
        let modulus = self.modulus.max(4);
        let start = (1u64 << 61) / modulus + 1;
        let end = ((1u64 << 62) - 1) / modulus;
        (start..end.min(start.saturating_add(MAX_CANDIDATES)))
            .filter_map(move |k| self.at(k * modulus + 1))
    }

    fn at(&self, p: u64) -> Option<ExactField> {
        if !is_prime(p) {
            return None;
        }
        let f = Field::new(p);
        let mut roots = BTreeMap::new();
        for &q in &self.free_roots {
            let root = f.sqrt(f.from_bigint(&BigInt::from(q)))?;
            if root == 0 {
                return None;
            }
            roots.insert(q, root);
        }
        let zeta = (2..)
            .take(1 << 16)
            .map(|g| f.pow(f.from_i64(g), (p - 1) / self.order))
            .find(|&z| {
                self.order_primes
                    .iter()
                    .all(|r| f.pow(z, self.order / r) != f.one())
            })?;
        let inverse_i = f.pow(zeta, self.order / 4 * 3);
        for &q in &self.inner_roots {
            let root = if q == 2 {
                let z = f.pow(zeta, self.order / 8);
                f.add(z, f.inv(z))
            } else {
                // The sum of zeta_q^(x^2), which is sqrt(q) or i sqrt(q); x^2 steps by 2x + 1.
                let z = f.pow(zeta, self.order / q);
                let square = f.mul(z, z);
                let (mut sum, mut term, mut step) = (f.zero(), f.one(), z);
                for _ in 0..q {
                    sum = f.add(sum, term);
                    term = f.mul(term, step);
                    step = f.mul(step, square);
                }
                if q % 4 == 1 {
                    sum
                } else {
                    f.mul(sum, inverse_i)
                }
            };
            roots.insert(q, root);
        }
        let radicals = self.radicals.clone();
        let mut field = ExactField {
            field: f,
            order: self.order,
            zeta,
            roots,
            radicals,
            nested: Vec::new(),
        };
        for inner in &self.nested {
            let value = field.eval(inner).ok().filter(|&v| v != 0)?;
            let root = f.sqrt(value)?;
            field.nested.push((value, root));
        }
        Some(field)
    }
}

/// The root of a nonnegative rational as a rational times roots of distinct primes. Prime factors up to 10^6 are found
/// by division, and those of a cofactor below 2^64 by Pollard's rho; beyond that only squares are recognised.
fn radical(r: &BigRational) -> Result<Radical, ExactError> {
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
    let (a, mut primes) = squarefree(r.numer()).ok_or_else(too_large)?;
    let (b, under) = squarefree(r.denom()).ok_or_else(too_large)?;
    // sqrt(q)/q for the primes below the line, which are distinct from those above it
    let below = under.iter().fold(b, |product, q| product * q);
    primes.extend(under);
    primes.sort_unstable();
    Ok(Radical {
        coef: BigRational::new(a, below),
        primes,
    })
}

/// `x = s^2 * product of primes` as `(s, primes)`.
fn squarefree(x: &BigInt) -> Option<(BigInt, Vec<u64>)> {
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
        for (q, count) in factor(small) {
            note(q, count);
        }
        return Some((root, primes));
    }
    let s = rest.sqrt();
    (&s * &s == rest).then(|| (root * s, primes))
}

/// The prime factors of a number with their multiplicities, in increasing order.
fn factor(mut n: u64) -> Vec<(u64, u32)> {
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
        let d = split(m);
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

/// A proper divisor of a composite number (Pollard's rho).
fn split(n: u64) -> u64 {
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

/// `u + v sqrt(d)` with `d` squarefree, or `d = 1` and `v = 0`.
#[derive(Debug, Clone)]
struct Quadratic {
    u: BigRational,
    v: BigRational,
    d: BigInt,
}

impl Quadratic {
    fn new(u: BigRational, v: BigRational, d: BigInt) -> Option<Quadratic> {
        // Denesting is worth a try for what a designer writes, not for towers of digits.
        if u.numer().bits().max(v.numer().bits()) > 2048
            || u.denom().bits().max(v.denom().bits()) > 2048
        {
            return None;
        }
        if d.is_one() {
            return Some(Quadratic {
                u: u + v,
                v: BigRational::zero(),
                d,
            });
        }
        let d = if v.is_zero() { BigInt::one() } else { d };
        Some(Quadratic { u, v, d })
    }

    fn root(r: &BigRational) -> Option<Quadratic> {
        let radical = radical(r).ok()?;
        let d = radical
            .primes
            .iter()
            .fold(BigInt::one(), |product, q| product * q);
        Quadratic::new(BigRational::zero(), radical.coef, d)
    }

    fn common(&self, other: &Quadratic) -> Option<BigInt> {
        match (self.d.is_one(), other.d.is_one()) {
            (true, _) => Some(other.d.clone()),
            (_, true) => Some(self.d.clone()),
            _ => (self.d == other.d).then(|| self.d.clone()),
        }
    }

    fn add(&self, other: &Quadratic) -> Option<Quadratic> {
        Quadratic::new(&self.u + &other.u, &self.v + &other.v, self.common(other)?)
    }

    fn neg(&self) -> Quadratic {
        Quadratic {
            u: -&self.u,
            v: -&self.v,
            d: self.d.clone(),
        }
    }

    fn mul(&self, other: &Quadratic) -> Option<Quadratic> {
        let d = self.common(other)?;
        let u = &self.u * &other.u + &self.v * &other.v * &d;
        Quadratic::new(u, &self.u * &other.v + &self.v * &other.u, d)
    }

    fn norm(&self) -> BigRational {
        &self.u * &self.u - &self.v * &self.v * &self.d
    }

    fn inverse(&self) -> Option<Quadratic> {
        let norm = self.norm();
        if norm.is_zero() {
            return None;
        }
        Quadratic::new(&self.u / &norm, -&self.v / &norm, self.d.clone())
    }

    /// Rationals a, b and a sign with `sqrt(self) = sqrt(a) + sign sqrt(b)`.
    fn denest(&self) -> Option<(BigRational, BigRational, bool)> {
        let w = rational_sqrt(&self.norm())?;
        let half = BigRational::new(1.into(), 2.into());
        let (a, b) = ((&self.u + &w) * &half, (&self.u - &w) * &half);
        (!a.is_negative() && !b.is_negative()).then(|| (a, b, self.v.is_negative()))
    }

    fn denested(&self) -> Option<Expr> {
        let (a, b, minus) = self.denest()?;
        let (a, b) = (Expr::rational(a).sqrt()?, Expr::rational(b).sqrt()?);
        Some(if minus { a - b } else { a + b })
    }

    /// The cosine of `k/n` turns where it is quadratic.
    fn cos(k: u64, n: u64) -> Option<Quadratic> {
        let ratio = |a: i64, b: i64| BigRational::new(a.into(), b.into());
        let k = k.min(n.checked_sub(k)?);
        let (u, v, d) = match (n, k) {
            (5, 1) => (ratio(-1, 4), ratio(1, 4), 5),
            (5, 2) => (ratio(-1, 4), ratio(-1, 4), 5),
            (10, 1) => (ratio(1, 4), ratio(1, 4), 5),
            (10, 3) => (ratio(1, 4), ratio(-1, 4), 5),
            (8, 1) => (ratio(0, 1), ratio(1, 2), 2),
            (8, 3) => (ratio(0, 1), ratio(-1, 2), 2),
            (12, 1) => (ratio(0, 1), ratio(1, 2), 3),
            (12, 5) => (ratio(0, 1), ratio(-1, 2), 3),
            _ => return None,
        };
        Quadratic::new(u, v, d.into())
    }
}

/// The expression as an element of a quadratic field, where every part of it is one.
fn quadratic(expr: &Expr) -> Option<Quadratic> {
    let mut memo: HashMap<usize, Quadratic> = HashMap::new();
    for e in expr.post_order() {
        let at = |c: &Expr| memo.get(&c.id());
        let value = match e.kind() {
            Kind::Rational(r) => Quadratic::new(r.clone(), BigRational::zero(), BigInt::one())?,
            Kind::Add(a, b) => at(a)?.add(at(b)?)?,
            Kind::Sub(a, b) => at(a)?.add(&at(b)?.neg())?,
            Kind::Mul(a, b) => at(a)?.mul(at(b)?)?,
            Kind::Div(a, b) => at(a)?.mul(&at(b)?.inverse()?)?,
            Kind::Neg(a) => at(a)?.neg(),
            Kind::Pow(a, n) => {
                let base = if *n < 0 {
                    at(a)?.inverse()?
                } else {
                    at(a)?.clone()
                };
                let mut product =
                    Quadratic::new(BigRational::one(), BigRational::zero(), BigInt::one())?;
                for _ in 0..n.unsigned_abs() {
                    product = product.mul(&base)?;
                }
                product
            }
            Kind::Sqrt(a) => {
                let (a, b, minus) = at(a)?.denest()?;
                let (a, b) = (Quadratic::root(&a)?, Quadratic::root(&b)?);
                a.add(&if minus { b.neg() } else { b })?
            }
            Kind::Trig(Function::Cos, k, n) => Quadratic::cos(*k, *n)?,
            // sin x = cos(x - 1/4 turn)
            Kind::Trig(Function::Sin, k, n) => {
                let (k, n) = ((4 * k + 3 * n) % (4 * n), 4 * n);
                let g = k.gcd(&n);
                Quadratic::cos(k / g, n / g)?
            }
            Kind::Trig(Function::Tan, ..) => return None,
        };
        memo.insert(e.id(), value);
    }
    memo.remove(&expr.id())
}

/// The positive root of `inner` in terms of roots of rationals, and of the half-angle cosines a designer may write
/// instead, such as `sqrt(10-2*sqrt(5)) = 4 sin 36deg`.
fn denested(inner: &Expr) -> Option<Expr> {
    let a = quadratic(inner)?;
    if let Some(flat) = a.denested() {
        return Some(flat);
    }
    [(1, 16), (3, 16), (1, 20), (3, 20)]
        .into_iter()
        .find_map(|(k, n)| {
            // cos^2 x = (1 + cos 2x) / 2
            let one = Quadratic::new(BigRational::one(), BigRational::zero(), BigInt::one())?;
            let half = Quadratic::new(
                BigRational::new(1.into(), 2.into()),
                BigRational::zero(),
                BigInt::one(),
            )?;
            let square = one.add(&Quadratic::cos(k, n / 2)?)?.mul(&half)?;
            Some(Expr::trig(Function::Cos, k, n)? * a.mul(&square.inverse()?)?.denested()?)
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(text: &str, nth: usize) -> bool {
        let e: Expr = text.parse().unwrap();
        let field = ExactField::for_expressions([&e], nth).unwrap();
        assert!((1 << 60..1 << 62).contains(&field.field().modulus()));
        field.eval(&e).unwrap() == 0
    }

    #[test]
    fn identities_vanish_and_near_misses_do_not() {
        let pairs = [
            ("cos(36deg)-(1+sqrt(5))/4", "cos(36deg)-(1-sqrt(5))/4"),
            ("sqrt(2)*sqrt(3)-sqrt(6)", "sqrt(2)*sqrt(3)+sqrt(6)"),
            ("cos(pi/8)^2-(2+sqrt(2))/4", "cos(pi/8)^2-(2-sqrt(2))/4"),
            ("sin(60deg)-sqrt(3)/2", "sin(60deg)+sqrt(3)/2"),
            ("tan(15deg)-(2-sqrt(3))", "tan(15deg)-(2+sqrt(3))"),
            ("cot(75deg)-(2-sqrt(3))", "cot(75deg)+(2-sqrt(3))"),
            ("sqrt(7)*sqrt(7)-7", "sqrt(7)*sqrt(7)+7"),
            (
                "cos(360deg/7)+cos(720deg/7)+cos(1080deg/7)+1/2",
                "cos(360deg/7)+cos(720deg/7)-cos(1080deg/7)+1/2",
            ),
            ("sqrt(3+2*sqrt(2))-1-sqrt(2)", "sqrt(3+2*sqrt(2))-1+sqrt(2)"),
            ("sqrt(3-2*sqrt(2))+1-sqrt(2)", "sqrt(3-2*sqrt(2))-1+sqrt(2)"),
            ("4*sin(18deg)+1-sqrt(5)", "4*sin(18deg)+1+sqrt(5)"),
            (
                "0*cos(360deg/7)+cos(360deg/7)*(sqrt(21)-sqrt(3)*sqrt(7))",
                "cos(360deg/7)*(sqrt(21)+sqrt(3)*sqrt(7))",
            ),
            (
                "sqrt(10-2*sqrt(5))-4*sin(36deg)",
                "sqrt(10-2*sqrt(5))+4*sin(36deg)",
            ),
            (
                "sqrt(2+sqrt(2))*sqrt(2-sqrt(2))-sqrt(2)",
                "sqrt(2+sqrt(2))*sqrt(2-sqrt(2))+sqrt(2)",
            ),
            ("sqrt(1+sqrt(3))^2-1-sqrt(3)", "sqrt(1+sqrt(3))^2-1+sqrt(3)"),
            (
                "sqrt(1+sqrt(3))-sqrt(sqrt(3)+1)",
                "sqrt(1+sqrt(3))+sqrt(sqrt(3)+1)",
            ),
            ("sqrt(0.75)-sin(120deg)", "sqrt(0.75)-sin(240deg)"),
            (
                "2*sin(360deg/7)+2*sin(720deg/7)-2*sin(1080deg/7)-sqrt(7)+4*sin(1080deg/7)*0",
                "2*sin(360deg/7)+2*sin(720deg/7)-2*sin(1080deg/7)+sqrt(7)",
            ),
        ];
        for nth in [0, 1, 5] {
            for (zero, nonzero) in pairs {
                let value = zero.parse::<Expr>().unwrap().to_f64();
                assert_eq!(
                    value == 0.0,
                    at(zero, nth),
                    "{zero}, nth {nth}, f64 {value}"
                );
                let value = nonzero.parse::<Expr>().unwrap().to_f64();
                assert!(
                    value != 0.0 && !at(nonzero, nth),
                    "{nonzero}, nth {nth}, f64 {value}"
                );
            }
        }
    }

    #[test]
    fn limits_are_errors() {
        let make = |text: &str| ExactField::for_expressions([&text.parse::<Expr>().unwrap()], 0);
        assert!(matches!(
            make("sqrt(3+sqrt(3))*sqrt(3-sqrt(3))-sqrt(6)"),
            Err(ExactError::AmbiguousNestedRoot { .. })
        ));
        assert!(make("sqrt(0.7853981633974483)+sqrt(18446744073709551557)").is_ok());
        assert!(matches!(
            make("sqrt(1234567890123456789012345678901234567891)"),
            Err(ExactError::RadicandTooLarge { .. })
        ));
        let roots: Vec<String> = (2..60).map(|q| format!("sqrt({q})")).collect();
        assert!(make(&roots.join("+")).is_ok());
        let field = make("sqrt(2)").unwrap();
        assert!(matches!(
            field.eval(&"sqrt(3)".parse().unwrap()),
            Err(ExactError::NotInField { .. })
        ));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn sums_of_products_vanish_exactly_where_the_doubles_do(
            a in -4i64..5, b in -4i64..5, c in -4i64..5, n in 3i64..13, q in 2i64..30, nth in 0usize..3,
        ) {
            // (a + b sqrt q)(c + cos) expanded, and off by one term
            let exact: Expr = format!(
                "({a}+({b})*sqrt({q}))*({c}+cos(360deg/{n}))-(({a})*({c})+({a})*cos(360deg/{n})+({b})*({c})*sqrt({q})\
                 +({b})*sqrt({q})*cos(360deg/{n}))"
            ).parse().unwrap();
            let off = &exact + &format!("({b})*sqrt({q})-({c})*cos(360deg/{n})").parse::<Expr>().unwrap();
            let field = ExactField::for_expressions([&exact, &off], nth).unwrap();
            prop_assert_eq!(field.eval(&exact).unwrap(), 0);
            prop_assert_eq!(exact.to_f64(), 0.0);
            prop_assert_eq!(field.eval(&off).unwrap() == 0, off.to_f64() == 0.0);
        }
    }
}
