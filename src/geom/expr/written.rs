//! How a number was written: what its last digit says of how well it is known.

use super::node::{Expr, Node};
use std::sync::Arc;

/// How a number was written; arithmetic makes numbers that were not.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) enum Written {
    /// As an expression, or not at all: exact.
    #[default]
    No,
    /// As a whole number, without a point.
    Whole,
    /// As a decimal.
    Decimal(Digits),
    /// However it was: somebody says that it is within so much of what is meant, or exact where that is 0.
    Stated(f64),
}

/// The digits of a decimal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Digits {
    /// Half a unit of the last one, times what the decimal was multiplied by.
    pub(crate) half: f64,
    /// Digits after the point, less the power of ten; negative where the last digit is worth more than one.
    pub(crate) places: i32,
    /// Significant digits, trailing zeros among them; 0 of zero.
    pub(crate) significant: usize,
    /// What its last digits are.
    pub(crate) end: End,
}

/// The end of a decimal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// A digit that is not 0.
    Digit,
    /// A 0 that only a writer of all digits writes: 0.50, 12.00.
    Zero,
    /// The `.0` that programs put behind whole numbers.
    Float,
}

/// Half of one unit of so many places.
pub(crate) fn half_of(places: i32) -> f64 {
    // Divided, the nearest double of 0.000005; multiplied, one beside it.
    match places {
        ..0 => 0.5 * 10f64.powi(places.saturating_neg().min(400)),
        _ => 0.5 / 10f64.powi(places.min(320)),
    }
}

impl Digits {
    /// What the decimal was multiplied by.
    pub(crate) fn factor(&self) -> f64 {
        self.half / half_of(self.places)
    }

    /// Of `whole.fraction * 10^exponent`; `None` for a whole number without a point.
    pub(super) fn of(whole: &str, fraction: &str, exponent: i64, point: bool) -> Option<Digits> {
        if !point && exponent >= 0 {
            return None;
        }
        let length = i64::try_from(fraction.len()).unwrap_or(i64::MAX);
        let places = length.saturating_sub(exponent).clamp(-1000, 100_000);
        let places = i32::try_from(places).ok()?;
        let all = whole.bytes().chain(fraction.bytes());
        let significant = all.skip_while(|b| *b == b'0').count();
        let end = match fraction {
            "" | "0" if exponent == 0 => End::Float,
            f if f.ends_with('0') => End::Zero,
            _ => End::Digit,
        };
        Some(Digits {
            half: half_of(places),
            places,
            significant,
            end,
        })
    }
}

impl Expr {
    /// Half a unit of the last digit that was written, of a decimal; or what [`Expr::with_half_unit`] says. `None` for what
    /// is exact: expressions, roots, fractions, whole numbers, and all that is calculated. O(1).
    ///
    /// Trailing zeros count: `0.494` has 5e-4, `0.49400` 5e-6, `1.5e-3` 5e-5.
    #[must_use]
    pub fn half_unit(&self) -> Option<f64> {
        match self.0.written {
            Written::Decimal(digits) => Some(digits.half),
            Written::Stated(half) if half > 0.0 => Some(half),
            _ => None,
        }
    }

    /// The same number, known to within `half` whatever its digits say; exact where `half` is 0. O(size of the number).
    #[must_use]
    pub fn with_half_unit(self, half: f64) -> Expr {
        self.written_as(Written::Stated(half))
    }

    /// Whether it was written as a whole number, without a point. O(1).
    #[must_use]
    pub fn is_written_whole(&self) -> bool {
        self.0.written == Written::Whole
    }

    pub(crate) fn written(&self) -> Written {
        self.0.written
    }

    /// The same number, written so.
    pub(crate) fn written_as(mut self, written: Written) -> Expr {
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
    pub(crate) fn scaled_as_written(&self, value: Expr, factor: f64) -> Expr {
        let written = match self.0.written {
            Written::Decimal(digits) => Written::Decimal(Digits {
                half: digits.half * factor.abs(),
                ..digits
            }),
            Written::Stated(half) => Written::Stated(half * factor.abs()),
            Written::No | Written::Whole => Written::No,
        };
        value.written_as(written)
    }
}
