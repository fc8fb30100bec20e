//! The written form of a number, whose last digit determines its accuracy.

use super::node::{Digits, End, Expr, Node, WrittenNumber};
use std::sync::Arc;

/// Returns half of one unit at this number of places.
pub fn half_of(places: i32) -> f64 {
    // Division gives the nearest double of 0.000005; multiplication gives a neighbouring one.
    match places {
        ..0 => 0.5 * 10f64.powi(places.saturating_neg().min(400)),
        _ => 0.5 / 10f64.powi(places.min(320)),
    }
}

impl Digits {
    /// Returns the factor that the decimal was multiplied by.
    pub fn factor(&self) -> f64 {
        self.half / half_of(self.places)
    }

    /// Returns the digits of `whole.fraction * 10^exponent`, or `None` for a whole number without a point.
    pub(super) fn from_decimal(
        whole: &str,
        fraction: &str,
        exponent: i64,
        point: bool,
    ) -> Option<Digits> {
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
    /// Returns half a unit of the last written digit of a decimal, or the value given by [`Expr::with_half_unit`].
    /// Returns `None` for exact numbers: expressions, roots, fractions, whole numbers, and all calculated values. O(1).
    ///
    /// Trailing zeros count: `0.494` has 5e-4, `0.49400` 5e-6, `1.5e-3` 5e-5.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// let half = |text: &str| text.parse().map(|x: Expr| x.half_unit());
    /// assert_eq!(half("0.494")?, Some(5e-4));
    /// assert_eq!(half("0.49400")?, Some(5e-6)); // Trailing zeros count.
    /// assert_eq!(half("1/3")?, None); // A fraction is exact.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// let measured = "0.5".parse::<Expr>()?.with_half_unit(0.01);
    /// assert_eq!(measured.half_unit(), Some(0.01));
    /// assert_eq!(measured.with_half_unit(0.0).half_unit(), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
