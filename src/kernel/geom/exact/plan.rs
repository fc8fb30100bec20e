//! Roots and angles that a number field requires: those of the cyclotomic field, the free ones, and the nested ones.

use std::collections::{BTreeMap, HashMap};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use sha2::{Digest as _, Sha256};

use super::field::ExactField;
use super::quadratic::denest_root;
use super::radical::ExactError;
use super::radical::{Radical, TRIAL_LIMIT, prime_factors, simplify_root};
use crate::geom::expr::{Expr, MAX_ANGLE_DENOMINATOR, NodeKind};
use crate::linalg::modp::{Field, Residue, is_prime};
use crate::linalg::number_ring::Element;

/// Maximum number of free square roots (of primes, or nested) whose primes are found by rejection, each halving the
/// supply.
const MAX_FREE: usize = 14;
/// Maximum number of adjoined nested roots.
const MAX_NESTED: usize = 6;
/// Number of primes on which a radicand is tested for being a square.
const WITNESSES: usize = 24;
/// Maximum number of candidates in the search for primes.
const MAX_CANDIDATES: u64 = 1 << 23;
/// Maximum number of candidates in the search for primes with roots of unity.
const COSINE_CANDIDATES: u64 = 1 << 20;
/// Number of primes at which a divisor vanishes before it counts as zero. Otherwise it is a multiple of all of them.
pub(crate) const MAX_FAILURES: usize = 2;

/// Requirements on a prime.
#[derive(Debug, Default)]
pub(crate) struct PrimePlan {
    pub(crate) order: u64,
    /// Primes are 1 modulo this multiple of `order`.
    pub(crate) modulus: u64,
    pub(crate) order_primes: Vec<u64>,
    pub(crate) radicals: BTreeMap<BigRational, Radical>,
    /// Primes whose roots are required: within Q(zeta_N), and independent of it.
    pub(crate) inner_roots: Vec<u64>,
    pub(crate) free_roots: Vec<u64>,
    pub(crate) nested: Vec<Expr>,
    /// A hash of the expressions that determines where primes are sought.
    seed: u64,
}

impl PrimePlan {
    /// Classifies the roots and angles of some expressions.
    pub(crate) fn new(exprs: &[&Expr]) -> Result<PrimePlan, ExactError> {
        let mut plan = PrimePlan {
            order: 4,
            seed: hash_expressions(exprs),
            ..PrimePlan::default()
        };
        let mut candidates = Vec::new();
        for e in exprs {
            plan.collect_roots(e, &mut candidates)?;
        }
        plan.classify_roots(candidates.is_empty())?;
        for inner in candidates {
            if plan.is_independent(&inner)? {
                plan.nested.push(inner);
            }
        }
        Ok(plan)
    }

    fn collect_roots(&mut self, e: &Expr, candidates: &mut Vec<Expr>) -> Result<(), ExactError> {
        if e.rational_ref().is_some() {
            return Ok(());
        }
        for node in e.post_order() {
            match node.kind() {
                NodeKind::Trig(_, _, n) => {
                    let lcm = u128::from(self.order).lcm(&u128::from(*n));
                    self.order = u64::try_from(lcm)
                        .ok()
                        .filter(|&l| l <= MAX_ANGLE_DENOMINATOR)
                        .ok_or(ExactError::AnglesTooFine)?;
                }
                NodeKind::Sqrt(inner) => {
                    if let Some(r) = inner.rational_ref() {
                        if !self.radicals.contains_key(r) {
                            self.radicals.insert(r.clone(), simplify_root(r)?);
                        }
                    } else if let Some(flat) = denest_root(inner) {
                        self.collect_roots(&flat, candidates)?;
                    } else {
                        candidates.push(inner.clone());
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Separates the roots into those of Q(zeta_N) and the free ones, once all angles are known.
    fn classify_roots(&mut self, flat: bool) -> Result<(), ExactError> {
        let mut primes: Vec<u64> = self
            .radicals
            .values()
            .flat_map(|r| r.primes.iter().copied())
            .collect();
        primes.sort_unstable();
        primes.dedup();
        self.order_primes = prime_factors(self.order)
            .into_iter()
            .map(|(q, _)| q)
            .collect();
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
            // By reciprocity q is a square modulo every p = 1 mod 4q. This does not apply with nested roots, which
            // would then be tested for squares in a larger field than this one.
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

    /// Returns true if the root of `inner` has to be adjoined, rather than being known already. On primes where all
    /// previous radicands are squares, a product of `inner` with some of them is a square if and only if `inner` is. So
    /// one test covers all products.
    fn is_independent(&self, inner: &Expr) -> Result<bool, ExactError> {
        let (mut squares, mut zeros, mut failures) = (0, 0, 0);
        for field in self.suitable_fields() {
            let value = match field.eval(inner) {
                Ok(value) => value,
                Err(ExactError::DivisionByZero { .. }) if failures + 1 < MAX_FAILURES => {
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

    /// Returns the suitable primes between 2^61 and 2^62, starting at a position given by the expressions' hash. A
    /// written number does not know its own hash, so coordinates contain these primes as factors only by a chance of
    /// about 2^-55.
    pub(crate) fn suitable_fields(&self) -> impl Iterator<Item = ExactField> + '_ {
        let modulus = self.modulus.max(4);
        let least = (1u64 << 61) / modulus + 1;
        let all = ((1u64 << 62) - 1) / modulus - least;
        (0..all.min(MAX_CANDIDATES))
            .map(move |i| least + (self.seed % all + i) % all)
            .filter_map(move |k| self.field_of_prime(k * modulus + 1))
    }

    fn field_of_prime(&self, p: u64) -> Option<ExactField> {
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
        let zeta = root_of_unity(f, self.order, &self.order_primes)?;
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

/// Returns a primitive root of unity of an order with these prime factors, which divides the number of units.
pub(crate) fn root_of_unity(f: Field, order: u64, primes: &[u64]) -> Option<Residue> {
    let each = (2..1 << 16).map(|g| f.pow(f.from_i64(g), (f.modulus() - 1) / order));
    let primitive = |z: &Residue| primes.iter().all(|q| f.pow(*z, order / q) != f.one());
    each.into_iter().find(primitive)
}

/// Returns a hash of some expressions that is the same on every machine: that of their trees, each shared node once.
fn hash_expressions(exprs: &[&Expr]) -> u64 {
    let mut hash = Sha256::new();
    for e in exprs {
        // Most are numbers.
        if let Some(r) = e.rational_ref() {
            hash.update(format!("{r};\n"));
            continue;
        }
        let mut places = HashMap::new();
        for (place, node) in e.post_order().into_iter().enumerate() {
            places.insert(node.id(), place);
            let of = |c: &Expr| places.get(&c.id()).copied().unwrap_or(0);
            let text = match node.kind() {
                NodeKind::Rational(r) => format!("{r}"),
                NodeKind::Pi => "pi".to_owned(),
                NodeKind::Add(a, b) => format!("{}+{}", of(a), of(b)),
                NodeKind::Sub(a, b) => format!("{}-{}", of(a), of(b)),
                NodeKind::Mul(a, b) => format!("{}*{}", of(a), of(b)),
                NodeKind::Div(a, b) => format!("{}:{}", of(a), of(b)),
                NodeKind::Neg(a) => format!("-{}.", of(a)),
                NodeKind::Pow(a, n) => format!("{}^{n}", of(a)),
                NodeKind::Sqrt(a) => format!("sqrt {}", of(a)),
                NodeKind::Trig(function, k, n) => format!("{function:?} {k}/{n}"),
            };
            hash.update(text);
            hash.update(";");
        }
        hash.update("\n");
    }
    let mut first = [0; 8];
    first.copy_from_slice(&hash.finalize()[..8]);
    u64::from_be_bytes(first)
}

/// Returns the images of 2 cos(2πk/n) for all k coprime to n, in a field with the roots of unity.
pub(in crate::geom) fn cosine_images(field: Field, n: u64) -> Option<Vec<Residue>> {
    let primes: Vec<u64> = prime_factors(n).into_iter().map(|(q, _)| q).collect();
    let zeta = root_of_unity(field, n, &primes)?;
    let inverse = field.inv(zeta);
    let coprime = (1..n / 2).filter(|k| k.gcd(&n) == 1);
    let image = |k| field.add(field.pow(zeta, k), field.pow(inverse, k));
    Some(coprime.map(image).collect())
}

/// Returns the minimal polynomial of 2 cos(2π/n) for n > 4, lowest coefficient first, without the leading 1: from its
/// roots modulo a prime that is larger than its coefficients. Whoever checks a certificate computes it in another way.
pub(in crate::geom) fn cosine_relation(n: u64) -> Option<Vec<Element>> {
    let field = fields_from(n).next()?;
    let mut product = vec![field.one()];
    for root in cosine_images(field, n)? {
        let mut next = vec![0; product.len() + 1];
        for (i, &c) in product.iter().enumerate() {
            next[i + 1] = field.add(next[i + 1], c);
            next[i] = field.sub(next[i], field.mul(c, root));
        }
        product = next;
    }
    product.pop();
    let integer = |c: Residue| match field.to_u64(c).cast_signed() {
        x if x > field.modulus().cast_signed() / 2 => x - field.modulus().cast_signed(),
        x => x,
    };
    let integers = product.into_iter().map(integer);
    Some(integers.map(Element::from_integer).collect())
}

/// Returns the fields of primes 1 modulo a number, from 2^61 on.
pub(in crate::geom) fn fields_from(modulus: u64) -> impl Iterator<Item = Field> {
    let start = (1u64 << 61) / modulus + 1;
    let end = ((1u64 << 62) - 1) / modulus;
    (start..end.min(start.saturating_add(COSINE_CANDIDATES)))
        .map(move |k| k * modulus + 1)
        .filter(|&p| is_prime(p))
        .map(Field::new)
}
