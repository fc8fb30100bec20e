//! The nodes of the tree.

use super::enclosure::Enclosure;
use super::rational::PI;
use super::written::Written;
use num_rational::BigRational;
use std::sync::Arc;

/// An exact real number: rationals, square roots, cosines of rational angles; and pi to [`PI_DIGITS`](super::PI_DIGITS) digits.
/// Clones share the tree.
#[derive(Clone)]
pub struct Expr(pub(super) Arc<Node>);

pub(super) struct Node {
    pub(super) kind: Kind,
    pub(super) enclosure: Enclosure,
    /// Leaves of the tree as written out, saturating.
    pub(super) size: u64,
    /// How it was written, which no value depends on.
    pub(super) written: Written,
}

/// A trigonometric function of an angle in turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Function {
    Cos,
    Sin,
    Tan,
}

#[derive(Debug, Clone)]
pub(crate) enum Kind {
    Rational(BigRational),
    Add(Expr, Expr),
    Sub(Expr, Expr),
    Mul(Expr, Expr),
    Div(Expr, Expr),
    Neg(Expr),
    Pow(Expr, i64),
    Sqrt(Expr),
    /// The function of `k/n` turns, in lowest terms, `0 <= k < n`.
    Trig(Function, u64, u64),
    /// π, which no number here is: its first digits stand for it, and the tree remembers that they do.
    Pi,
}

impl Expr {
    pub(super) fn new(kind: Kind) -> Expr {
        let enclosure = match &kind {
            Kind::Rational(r) => Enclosure::rational(r),
            Kind::Pi => Enclosure::rational(&PI),
            Kind::Add(a, b) => a.0.enclosure.add(&b.0.enclosure),
            Kind::Sub(a, b) => a.0.enclosure.add(&b.0.enclosure.neg()),
            Kind::Mul(a, b) => a.0.enclosure.mul(&b.0.enclosure),
            Kind::Div(a, b) => a.0.enclosure.div(&b.0.enclosure),
            Kind::Neg(a) => a.0.enclosure.neg(),
            Kind::Pow(a, n) => a.0.enclosure.pow(*n),
            Kind::Sqrt(a) => a.0.enclosure.sqrt(),
            Kind::Trig(Function::Cos, k, n) => Enclosure::cos(*k, *n),
            Kind::Trig(Function::Sin, k, n) => Enclosure::sin(*k, *n),
            Kind::Trig(Function::Tan, k, n) => Enclosure::sin(*k, *n).div(&Enclosure::cos(*k, *n)),
        };
        let size = kind
            .children()
            .into_iter()
            .flatten()
            .fold(1u64, |s, c| s.saturating_add(c.0.size));
        Expr(Arc::new(Node {
            kind,
            enclosure,
            size,
            written: Written::No,
        }))
    }
}

impl Kind {
    pub(super) fn children(&self) -> [Option<&Expr>; 2] {
        match self {
            Kind::Rational(_) | Kind::Trig(..) | Kind::Pi => [None, None],
            Kind::Add(a, b) | Kind::Sub(a, b) | Kind::Mul(a, b) | Kind::Div(a, b) => {
                [Some(a), Some(b)]
            }
            Kind::Neg(a) | Kind::Pow(a, _) | Kind::Sqrt(a) => [Some(a), None],
        }
    }

    /// Moves the children out, leaving a leaf.
    fn take_children(&mut self, into: &mut Vec<Expr>) {
        if matches!(self, Kind::Rational(_) | Kind::Trig(..) | Kind::Pi) {
            return;
        }
        match std::mem::replace(self, Kind::Trig(Function::Cos, 0, 1)) {
            Kind::Rational(_) | Kind::Trig(..) | Kind::Pi => {}
            Kind::Add(a, b) | Kind::Sub(a, b) | Kind::Mul(a, b) | Kind::Div(a, b) => {
                into.extend([a, b])
            }
            Kind::Neg(a) | Kind::Pow(a, _) | Kind::Sqrt(a) => into.push(a),
        }
    }
}

// Long sums are deep trees, and dropping them recursively would overflow the stack.
impl Drop for Node {
    fn drop(&mut self) {
        let mut stack = Vec::new();
        self.kind.take_children(&mut stack);
        while let Some(Expr(arc)) = stack.pop() {
            if let Some(mut node) = Arc::into_inner(arc) {
                node.kind.take_children(&mut stack);
            }
        }
    }
}
