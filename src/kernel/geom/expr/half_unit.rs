//! How well a number is known, by how it was written or by what is said of it.

use super::node::{Expr, Node};
use super::written::{Digits, WrittenNumber};
use std::sync::Arc;

impl Expr {
    /// Half a unit of the last digit that was written, of a decimal; or what [`Expr::with_half_unit`] says. `None` for what
    /// is exact: expressions, roots, fractions, whole numbers, and all that is calculated. O(1).
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

    /// The same number, known to within `half` whatever its digits say; exact where `half` is 0. O(size of the number).
    #[must_use]
    pub fn with_half_unit(self, half: f64) -> Expr {
        self.written_as(WrittenNumber::Stated(half))
    }

    /// Whether it was written as a whole number, without a point. O(1).
    #[must_use]
    pub fn is_written_whole(&self) -> bool {
        self.0.written == WrittenNumber::Whole
    }

    /// What kind of number it is written as.
    #[must_use]
    pub fn written(&self) -> WrittenNumber {
        self.0.written
    }

    /// The same number, written so.
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

    /// The number times a factor that is exact, its digits worth that much more or less.
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
