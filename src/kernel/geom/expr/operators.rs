//! Sums, differences, products and negatives, folded if they are rational.

use super::Expr;
use super::node::NodeKind;
use super::node::WrittenNumber;
use num_traits::{One, Zero};
use std::ops::{Add, Mul, Neg, Sub};

impl Add for &Expr {
    type Output = Expr;
    fn add(self, other: &Expr) -> Expr {
        if let Some(e) = Expr::fold_rationals(self, other, |a, b| a + b) {
            return e;
        }
        match (self.is_zero_rational(), other.is_zero_rational()) {
            (true, _) => other.clone(),
            (_, true) => self.clone(),
            _ => Expr::new(NodeKind::Add(self.clone(), other.clone())),
        }
    }
}

impl Sub for &Expr {
    type Output = Expr;
    fn sub(self, other: &Expr) -> Expr {
        if let Some(e) = Expr::fold_rationals(self, other, |a, b| a - b) {
            return e;
        }
        match (self.is_zero_rational(), other.is_zero_rational()) {
            (true, _) => -other,
            (_, true) => self.clone(),
            _ => Expr::new(NodeKind::Sub(self.clone(), other.clone())),
        }
    }
}

impl Mul for &Expr {
    type Output = Expr;
    fn mul(self, other: &Expr) -> Expr {
        if let Some(e) = Expr::fold_rationals(self, other, |a, b| a * b) {
            return e;
        }
        for (a, b) in [(self, other), (other, self)] {
            if let Some(r) = a.rational_ref() {
                if r.is_zero() {
                    return a.clone();
                }
                if r.is_one() {
                    return b.clone();
                }
                if (-r).is_one() {
                    return -b;
                }
            }
        }
        Expr::new(NodeKind::Mul(self.clone(), other.clone()))
    }
}

impl Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        let negative = match &self.0.kind {
            NodeKind::Rational(r) => Expr::rational(-r),
            NodeKind::Neg(a) => a.clone(),
            _ => Expr::new(NodeKind::Neg(self.clone())),
        };
        match self.written() {
            WrittenNumber::No => negative,
            written => negative.written_as(written),
        }
    }
}

impl Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        -&self
    }
}

macro_rules! owned_operators {
    ($($trait:ident $method:ident),*) => {$(
        impl $trait for Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                $trait::$method(&self, &other)
            }
        }
        impl $trait<&Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                $trait::$method(&self, other)
            }
        }
        impl $trait<Expr> for &Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                $trait::$method(self, &other)
            }
        }
    )*};
}
owned_operators!(Add add, Sub sub, Mul mul);
