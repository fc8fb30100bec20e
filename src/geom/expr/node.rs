//! The nodes of the tree.

use super::Expr;
use super::enclosure::Enclosure;
use num_rational::BigRational;
use std::sync::Arc;

pub(super) struct Node {
    pub(super) kind: Kind,
    pub(super) enclosure: Enclosure,
    /// Leaves of the tree as written out, saturating.
    pub(super) size: u64,
}

/// A trigonometric function of an angle in turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Function {
    Cos,
    Sin,
    Tan,
}

#[derive(Debug)]
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
}

impl Kind {
    pub(super) fn children(&self) -> [Option<&Expr>; 2] {
        match self {
            Kind::Rational(_) | Kind::Trig(..) => [None, None],
            Kind::Add(a, b) | Kind::Sub(a, b) | Kind::Mul(a, b) | Kind::Div(a, b) => {
                [Some(a), Some(b)]
            }
            Kind::Neg(a) | Kind::Pow(a, _) | Kind::Sqrt(a) => [Some(a), None],
        }
    }

    /// Moves the children out, leaving a leaf.
    fn take_children(&mut self, into: &mut Vec<Expr>) {
        if matches!(self, Kind::Rational(_) | Kind::Trig(..)) {
            return;
        }
        match std::mem::replace(self, Kind::Trig(Function::Cos, 0, 1)) {
            Kind::Rational(_) | Kind::Trig(..) => {}
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
