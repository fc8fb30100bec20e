//! How a number was written: what its last digit says of how well it is known.

/// How a number was written; arithmetic makes numbers that were not.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum WrittenNumber {
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
pub struct Digits {
    /// Half a unit of the last one, times what the decimal was multiplied by.
    pub half: f64,
    /// Digits after the point, less the power of ten; negative where the last digit is worth more than one.
    pub places: i32,
    /// Significant digits, trailing zeros among them; 0 of zero.
    pub significant: usize,
    /// What its last digits are.
    pub end: End,
}

/// The end of a decimal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// A digit that is not 0.
    Digit,
    /// A 0 that only a writer of all digits writes: 0.50, 12.00.
    Zero,
    /// The `.0` that programs put behind whole numbers.
    Float,
}

/// Half of one unit of so many places.
pub fn half_of(places: i32) -> f64 {
    // Divided, the nearest double of 0.000005; multiplied, one beside it.
    match places {
        ..0 => 0.5 * 10f64.powi(places.saturating_neg().min(400)),
        _ => 0.5 / 10f64.powi(places.min(320)),
    }
}

impl Digits {
    /// What the decimal was multiplied by.
    pub fn factor(&self) -> f64 {
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
