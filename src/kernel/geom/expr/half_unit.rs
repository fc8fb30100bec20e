//! Accuracy of a number, from its written form or a stated uncertainty.

use super::node::{Expr, Node};
use super::written::{Digits, WrittenNumber};
use std::sync::Arc;

impl Expr {
    /// Returns half a unit of the last written digit of a decimal, or the value given by [`Expr::with_half_unit`].
    /// Returns `None` for exact numbers: expressions, roots, fractions, whole numbers, and all calculated values. O(1).
    ///
    /// Trailing zeros count: `0.494` has 5e-4, `0.49400` 5e-6, `1.5e-3` 5e-5.
    #[must_use]
    pub fn half_unit(&self) -> Option<f64> {
        match self.0.written {
            WrittenNumber::Decimal(digits) => Some(digits.half),
            WrittenNumber::Stated(half) if half > 0.0 => Some(half),
            _ => None,
        }
    }

    /// Returns the number with an accuracy of `half`, regardless of its digits. It is exact if `half` is 0. O(size of
    /// the number).
    #[must_use]
    pub fn with_half_unit(self, half: f64) -> Expr {
        self.written_as(WrittenNumber::Stated(half))
    }

    /// Returns true if it was written as a whole number, without a point. O(1).
    #[must_use]
    pub fn is_written_whole(&self) -> bool {
        self.0.written == WrittenNumber::Whole
    }

    /// Returns the form in which the number was written.
    #[must_use]
    pub fn written(&self) -> WrittenNumber {
        self.0.written
    }

    /// Returns the number with another written form.
    pub fn written_as(mut self, written: WrittenNumber) -> Expr {
        if self.0.written == written {
            return self;
        }
        if let Some(node) = Arc::get_mut(&mut self.0) {
            node.written = written;
            return self;
        }
        Expr(Arc::new(Node {
            kind: self.0.kind.clone(),
            enclosure: self.0.enclosure.clone(),
            size: self.0.size,
            written,
        }))
    }

    /// Returns the number times an exact factor, with the accuracy of its digits multiplied accordingly.
    pub fn scaled_as_written(&self, value: Expr, factor: f64) -> Expr {
        let written = match self.0.written {
            WrittenNumber::Decimal(digits) => WrittenNumber::Decimal(Digits {
                half: digits.half * factor.abs(),
                ..digits
            }),
            WrittenNumber::Stated(half) => WrittenNumber::Stated(half * factor.abs()),
            WrittenNumber::No | WrittenNumber::Whole => WrittenNumber::No,
        };
        value.written_as(written)
    }
}
