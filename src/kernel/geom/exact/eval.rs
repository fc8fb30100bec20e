//! The value of an expression in any ring with its angles and roots.

use std::collections::{BTreeMap, HashMap};

use num_rational::BigRational;

use super::quadratic::denest_root;
use super::radical::ExactError;
use super::radical::{Radical, simplify_root};
use crate::geom::Scalars;
use crate::geom::expr::{Expr, Function, NodeKind, PI};

/// A ring with the angles and roots of some expressions, under one consistent choice of roots.
pub(crate) trait Target: Scalars {
    /// Converts a rational number. Returns `None` if its denominator has no inverse.
    fn rational(&self, r: &BigRational) -> Option<Self::Number>;
    /// Returns the inverse, or `None` if there is none.
    fn inverse(&self, a: &Self::Number) -> Option<Self::Number>;
    /// Returns twice the cosine and the sine of `k/n` turns, or `None` for an unsupported angle.
    fn twice_cos_sin(&self, k: u64, n: u64) -> Option<[Self::Number; 2]>;
    /// Returns the root of a prime, if supported.
    fn prime_root(&self, q: u64) -> Option<Self::Number>;
    /// Returns the root of a nested radicand, if supported.
    fn nested_root(&self, radicand: &Self::Number) -> Option<Self::Number>;
    /// Returns the factored roots of rationals.
    fn radicals(&self) -> &BTreeMap<BigRational, Radical>;

    fn power(&self, a: &Self::Number, n: u64) -> Option<Self::Number> {
        let mut out = self.rational(&BigRational::from_integer(1.into()))?;
        for bit in (0..u64::BITS - n.leading_zeros()).rev() {
            out = self.mul(out.clone(), out);
            if n >> bit & 1 == 1 {
                out = self.mul(out, a.clone());
            }
        }
        Some(out)
    }
}

/// Returns the value of an expression. O(nodes), each shared node once.
pub(crate) fn eval_in<T: Target>(target: &T, expr: &Expr) -> Result<T::Number, ExactError> {
    let divides = || ExactError::DivisionByZero {
        expression: expr.to_string(),
    };
    if let Some(r) = expr.rational_ref() {
        return target.rational(r).ok_or_else(divides);
    }
    let mut memo: HashMap<usize, T::Number> = HashMap::new();
    let zero = T::Number::default();
    for e in expr.post_order() {
        let at = |c: &Expr| memo.get(&c.id()).unwrap_or(&zero).clone();
        let inverse = |x: &T::Number| target.inverse(x).ok_or_else(divides);
        let value = match e.kind() {
            NodeKind::Rational(r) => target.rational(r).ok_or_else(divides)?,
            NodeKind::Pi => target.rational(&PI).ok_or_else(divides)?,
            NodeKind::Add(a, b) => target.add(at(a), at(b)),
            NodeKind::Sub(a, b) => target.sub(at(a), at(b)),
            NodeKind::Mul(a, b) => target.mul(at(a), at(b)),
            NodeKind::Div(a, b) => target.mul(at(a), inverse(&at(b))?),
            NodeKind::Neg(a) => target.sub(zero.clone(), at(a)),
            NodeKind::Pow(a, n) => {
                let power = target.power(&at(a), n.unsigned_abs()).ok_or_else(divides)?;
                if *n < 0 { inverse(&power)? } else { power }
            }
            NodeKind::Sqrt(a) => eval_sqrt(target, a, &at(a))?,
            NodeKind::Trig(function, k, n) => {
                let [c, s] = target
                    .twice_cos_sin(*k, *n)
                    .ok_or_else(|| not_in_field(e))?;
                let half = || {
                    let half = BigRational::new(1.into(), 2.into());
                    target.rational(&half).ok_or_else(divides)
                };
                match function {
                    Function::Cos => target.mul(c, half()?),
                    Function::Sin => target.mul(s, half()?),
                    Function::Tan => target.mul(s, inverse(&c)?),
                }
            }
        };
        memo.insert(e.id(), value);
    }
    Ok(memo.remove(&expr.id()).unwrap_or_default())
}

/// Returns the root of `inner`, whose value is `value`.
fn eval_sqrt<T: Target>(
    target: &T,
    inner: &Expr,
    value: &T::Number,
) -> Result<T::Number, ExactError> {
    if let Some(r) = inner.rational_ref() {
        let made;
        let radical = match target.radicals().get(r) {
            Some(radical) => radical,
            None => {
                made = simplify_root(r)?;
                &made
            }
        };
        let coef = target
            .rational(&radical.coef)
            .ok_or_else(|| ExactError::DivisionByZero {
                expression: inner.to_string(),
            })?;
        return radical.primes.iter().try_fold(coef, |product, &q| {
            let root = target.prime_root(q).ok_or_else(|| not_in_field(inner))?;
            Ok(target.mul(product, root))
        });
    }
    // Rewritten roots have rational radicands only, so this recursion ends at depth one.
    if let Some(flat) = denest_root(inner) {
        return eval_in(target, &flat);
    }
    if *value == T::Number::default() {
        return Ok(T::Number::default());
    }
    // Equal radicands have equal values, regardless of how they are written.
    target.nested_root(value).ok_or_else(|| not_in_field(inner))
}

fn not_in_field(e: &Expr) -> ExactError {
    ExactError::NotInField {
        expression: e.to_string(),
    }
}
