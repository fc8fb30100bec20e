//! The written form of a number, whose last digit determines its accuracy.

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
