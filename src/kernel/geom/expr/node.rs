//! The nodes of the tree.

use super::enclosure::Enclosure;
use super::rational::PI;
use num_rational::BigRational;
use std::sync::Arc;

/// An exact real number: rationals, square roots, cosines of rational angles; and pi to [`PI_DIGITS`](super::PI_DIGITS)
/// digits. Clones share the tree.
#[derive(Clone)]
pub struct Expr(pub(super) Arc<Node>);

pub(super) struct Node {
    pub(super) kind: NodeKind,
    pub(super) enclosure: Enclosure,
    /// Number of leaves of the fully written tree, saturating.
    pub(super) size: u64,
    /// The written form, which does not affect the value.
    pub(super) written: WrittenNumber,
}

/// A trigonometric function of an angle in turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Function {
    Cos,
    Sin,
    Tan,
}

#[derive(Debug, Clone)]
pub(crate) enum NodeKind {
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
    /// π, which has no exact value here. It is replaced by its first digits, and the tree records this.
    Pi,
}

impl Expr {
    pub(super) fn new(kind: NodeKind) -> Expr {
        let enclosure = match &kind {
            NodeKind::Rational(r) => Enclosure::rational(r),
            NodeKind::Pi => Enclosure::rational(&PI),
            NodeKind::Add(a, b) => a.0.enclosure.add(&b.0.enclosure),
            NodeKind::Sub(a, b) => a.0.enclosure.add(&b.0.enclosure.neg()),
            NodeKind::Mul(a, b) => a.0.enclosure.mul(&b.0.enclosure),
            NodeKind::Div(a, b) => a.0.enclosure.div(&b.0.enclosure),
            NodeKind::Neg(a) => a.0.enclosure.neg(),
            NodeKind::Pow(a, n) => a.0.enclosure.pow(*n),
            NodeKind::Sqrt(a) => a.0.enclosure.sqrt(),
            NodeKind::Trig(Function::Cos, k, n) => Enclosure::cos(*k, *n),
            NodeKind::Trig(Function::Sin, k, n) => Enclosure::sin(*k, *n),
            NodeKind::Trig(Function::Tan, k, n) => {
                Enclosure::sin(*k, *n).div(&Enclosure::cos(*k, *n))
            }
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
            written: WrittenNumber::No,
        }))
    }
}

impl NodeKind {
    pub(super) fn children(&self) -> [Option<&Expr>; 2] {
        match self {
            NodeKind::Rational(_) | NodeKind::Trig(..) | NodeKind::Pi => [None, None],
            NodeKind::Add(a, b)
            | NodeKind::Sub(a, b)
            | NodeKind::Mul(a, b)
            | NodeKind::Div(a, b) => [Some(a), Some(b)],
            NodeKind::Neg(a) | NodeKind::Pow(a, _) | NodeKind::Sqrt(a) => [Some(a), None],
        }
    }

    /// Moves the children out, leaving a leaf.
    fn take_children(&mut self, into: &mut Vec<Expr>) {
        into.extend(self.children().into_iter().flatten().cloned());
        *self = NodeKind::Trig(Function::Cos, 0, 1);
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

/// The written form of a number. Results of arithmetic have none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum WrittenNumber {
    /// Written as an expression, or not at all: exact.
    #[default]
    No,
    /// Written as a whole number, without a point.
    Whole,
    /// Written as a decimal.
    Decimal(Digits),
    /// Written in any form, with a stated deviation from the intended value, or exact if that is 0.
    Stated(f64),
}

/// The digits of a decimal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Digits {
    /// Half a unit of the last digit, times the factor that the decimal was multiplied by.
    pub half: f64,
    /// Digits after the point, less the power of ten; negative if the last digit is worth more than one.
    pub places: i32,
    /// Significant digits, including trailing zeros; 0 for zero.
    pub significant: usize,
    /// Kind of its last digits.
    pub end: End,
}

/// The end of a decimal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// A nonzero digit.
    Digit,
    /// A 0 that is written only if all digits are written: 0.50, 12.00.
    Zero,
    /// The `.0` that programs append to whole numbers.
    Float,
}
