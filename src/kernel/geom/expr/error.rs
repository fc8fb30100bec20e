//! Reasons why a text or a float is not an exact number.

/// Reason why a text or a float is not an exact number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExprError {
    /// The text has no content.
    #[error("the expression is empty; write a number such as `1.5` or `sqrt(3)/2`")]
    Empty,
    /// The text exceeds [`MAX_TEXT`](super::MAX_TEXT) bytes.
    #[error("the expression is {len} bytes long, over the limit of 1000; shorten it")]
    TooLong {
        /// The length of the text in bytes.
        len: usize,
    },
    /// With its numbers written out, the text exceeds [`MAX_TEXT`](super::MAX_TEXT) bytes, so that it could not be read
    /// again.
    #[error(
        "the expression takes {len} bytes with its numbers written out, over the limit of 1000; use numbers of fewer digits"
    )]
    WrittenTooLong {
        /// The length in bytes.
        len: usize,
    },
    /// Parentheses are nested more than [`MAX_NESTING`](super::MAX_NESTING) deep.
    #[error("the parentheses at byte {at} are nested more than 64 deep; simplify the expression")]
    TooDeep {
        /// Byte offset.
        at: usize,
    },
    /// A character that is not allowed here.
    #[error("found {found} at byte {at}, but expected {expected}; correct the expression there")]
    Unexpected {
        /// Byte offset.
        at: usize,
        /// The text found.
        found: String,
        /// The text expected.
        expected: &'static str,
    },
    /// A word that is not a function, constant or unit.
    #[error(
        "unknown word `{word}` at byte {at}; known are the functions sqrt, cos, sin, tan and cot, \
        and inside their arguments the constant pi and the suffix deg"
    )]
    UnknownWord {
        /// Byte offset.
        at: usize,
        /// The word.
        word: String,
    },
    /// A decimal without digits.
    #[error("malformed number at byte {at}; write decimals like `12`, `0.5` or `1.5e-3`")]
    BadNumber {
        /// Byte offset.
        at: usize,
    },
    /// A decimal exponent beyond [`MAX_EXPONENT`](super::MAX_EXPONENT).
    #[error("the decimal exponent at byte {at} exceeds 400; choose other units")]
    ExponentOutOfRange {
        /// Byte offset.
        at: usize,
    },
    /// A power beyond [`MAX_POWER`](super::MAX_POWER).
    #[error("the power at byte {at} exceeds 64; keep the integer after `^` between -64 and 64")]
    PowerOutOfRange {
        /// Byte offset.
        at: usize,
    },
    /// A divisor of zero.
    #[error(
        "division by zero at byte {at} (the divisor is zero to at least 60 digits); use a divisor that is not zero"
    )]
    DivisionByZero {
        /// Byte offset.
        at: usize,
    },
    /// The square root of a negative number.
    #[error(
        "square root of a negative number at byte {at}; coordinates are real, so check the sign of the radicand"
    )]
    NegativeRoot {
        /// Byte offset.
        at: usize,
    },
    /// A trigonometric argument that is not an angle.
    #[error(
        "the argument of {function} at byte {at} is not a rational angle; give degrees (`36deg`, `360deg/7`) or a \
         rational multiple of pi (`pi/8`)"
    )]
    NotAnAngle {
        /// Byte offset.
        at: usize,
        /// The function.
        function: &'static str,
    },
    /// An angle (`pi`, `36deg`) used as a number.
    #[error(
        "the angle at byte {at} is used as a plain number; `pi` and `deg` are allowed only inside \
        cos, sin, tan or cot; angles may only be added to angles and scaled by rationals, and of \
        all lengths only a pitch may have pi"
    )]
    AngleOutside {
        /// Byte offset.
        at: usize,
    },
    /// A tangent or cotangent at its pole.
    #[error("{function} at byte {at} is infinite at this angle; choose another angle")]
    Pole {
        /// Byte offset.
        at: usize,
        /// The function.
        function: &'static str,
    },
    /// An angle with a denominator beyond [`MAX_ANGLE_DENOMINATOR`](super::MAX_ANGLE_DENOMINATOR).
    #[error(
        "the angle at byte {at} is too finely divided to be kept exact; write it with at most ten decimals"
    )]
    AngleTooFine {
        /// Byte offset.
        at: usize,
    },
    /// The value exceeds the range of `f64`.
    #[error(
        "the value at byte {at} is out of range for floating-point numbers; choose other units"
    )]
    NotFinite {
        /// Byte offset.
        at: usize,
    },
    /// An exact rational with too many digits.
    #[error(
        "the exact value at byte {at} has thousands of digits; lower the powers or round the numbers"
    )]
    TooManyDigits {
        /// Byte offset.
        at: usize,
    },
    /// A float that is infinite or not a number.
    #[error("the number {value} is not finite; give a finite coordinate")]
    NonFiniteFloat {
        /// The float as text.
        value: String,
    },
}
