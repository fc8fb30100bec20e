//! Elements of quadratic fields, and the nested roots that they resolve.

use std::collections::HashMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::radical::simplify_root;
use crate::geom::expr::{Expr, Function, NodeKind, rational_sqrt};

/// `u + v sqrt(d)` with `d` squarefree, or `d = 1` and `v = 0`.
#[derive(Debug, Clone)]
struct Quadratic {
    u: BigRational,
    v: BigRational,
    d: BigInt,
}

impl Quadratic {
    fn new(u: BigRational, v: BigRational, d: BigInt) -> Option<Quadratic> {
        // Denesting is useful for numbers that a designer writes, not for towers of digits.
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

    fn rational(r: BigRational) -> Option<Quadratic> {
        Quadratic::new(r, BigRational::zero(), BigInt::one())
    }

    fn from_root(r: &BigRational) -> Option<Quadratic> {
        let radical = simplify_root(r).ok()?;
        let d = radical
            .primes
            .iter()
            .fold(BigInt::one(), |product, q| product * q);
        Quadratic::new(BigRational::zero(), radical.coef, d)
    }

    fn common_radicand(&self, other: &Quadratic) -> Option<BigInt> {
        match (self.d.is_one(), other.d.is_one()) {
            (true, _) => Some(other.d.clone()),
            (_, true) => Some(self.d.clone()),
            _ => (self.d == other.d).then(|| self.d.clone()),
        }
    }

    fn add(&self, other: &Quadratic) -> Option<Quadratic> {
        Quadratic::new(
            &self.u + &other.u,
            &self.v + &other.v,
            self.common_radicand(other)?,
        )
    }

    fn neg(&self) -> Quadratic {
        Quadratic {
            u: -&self.u,
            v: -&self.v,
            d: self.d.clone(),
        }
    }

    fn mul(&self, other: &Quadratic) -> Option<Quadratic> {
        let d = self.common_radicand(other)?;
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

    /// Returns rationals a, b and a sign with `sqrt(self) = sqrt(a) + sign sqrt(b)`.
    fn denest_roots(&self) -> Option<(BigRational, BigRational, bool)> {
        let w = rational_sqrt(&self.norm())?;
        let half = BigRational::new(1.into(), 2.into());
        let (a, b) = ((&self.u + &w) * &half, (&self.u - &w) * &half);
        (!a.is_negative() && !b.is_negative()).then(|| (a, b, self.v.is_negative()))
    }

    fn denested_expr(&self) -> Option<Expr> {
        let (a, b, minus) = self.denest_roots()?;
        let (a, b) = (Expr::rational(a).sqrt()?, Expr::rational(b).sqrt()?);
        Some(if minus { a - b } else { a + b })
    }

    /// Returns the cosine of `k/n` turns if it is quadratic.
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

/// Returns the expression as an element of a quadratic field, if every part of it is one.
fn as_quadratic(expr: &Expr) -> Option<Quadratic> {
    let mut memo: HashMap<usize, Quadratic> = HashMap::new();
    for e in expr.post_order() {
        let at = |c: &Expr| memo.get(&c.id());
        let value = match e.kind() {
            NodeKind::Rational(r) => Quadratic::rational(r.clone())?,
            NodeKind::Add(a, b) => at(a)?.add(at(b)?)?,
            NodeKind::Sub(a, b) => at(a)?.add(&at(b)?.neg())?,
            NodeKind::Mul(a, b) => at(a)?.mul(at(b)?)?,
            NodeKind::Div(a, b) => at(a)?.mul(&at(b)?.inverse()?)?,
            NodeKind::Neg(a) => at(a)?.neg(),
            NodeKind::Pow(a, n) => {
                let base = if *n < 0 {
                    at(a)?.inverse()?
                } else {
                    at(a)?.clone()
                };
                let mut product = Quadratic::rational(BigRational::one())?;
                for _ in 0..n.unsigned_abs() {
                    product = product.mul(&base)?;
                }
                product
            }
            NodeKind::Sqrt(a) => {
                let (a, b, minus) = at(a)?.denest_roots()?;
                let (a, b) = (Quadratic::from_root(&a)?, Quadratic::from_root(&b)?);
                a.add(&if minus { b.neg() } else { b })?
            }
            NodeKind::Trig(Function::Cos, k, n) => Quadratic::cos(*k, *n)?,
            // sin x = cos(x - 1/4 turn)
            NodeKind::Trig(Function::Sin, k, n) => {
                let (k, n) = ((4 * k + 3 * n) % (4 * n), 4 * n);
                let g = k.gcd(&n);
                Quadratic::cos(k / g, n / g)?
            }
            NodeKind::Trig(Function::Tan, ..) | NodeKind::Pi => return None,
        };
        memo.insert(e.id(), value);
    }
    memo.remove(&expr.id())
}

/// Returns the positive root of `inner` in terms of roots of rationals. The half-angle cosines that a designer may
/// write instead are also used, such as `sqrt(10-2*sqrt(5)) = 4 sin 36deg`.
pub(crate) fn denest_root(inner: &Expr) -> Option<Expr> {
    let a = as_quadratic(inner)?;
    if let Some(flat) = a.denested_expr() {
        return Some(flat);
    }
    [(1, 16), (3, 16), (1, 20), (3, 20)]
        .into_iter()
        .find_map(|(k, n)| {
            // cos^2 x = (1 + cos 2x) / 2
            let one = Quadratic::rational(BigRational::one())?;
            let half = Quadratic::rational(BigRational::new(1.into(), 2.into()))?;
            let square = one.add(&Quadratic::cos(k, n / 2)?)?.mul(&half)?;
            Some(
                Expr::trig_of_turns(Function::Cos, k, n)?
                    * a.mul(&square.inverse()?)?.denested_expr()?,
            )
        })
}
