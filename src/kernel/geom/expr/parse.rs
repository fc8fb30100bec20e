//! Parser of expressions: a recursive descent with limits on size and depth.

use super::error::ExprError;
use super::node::{Digits, WrittenNumber};
use super::node::{Expr, Function, NodeKind};
use super::rational::{MAX_BITS, bit_size, parse_fraction, rational_from_decimal};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};
use std::str::FromStr;

/// Maximum length of a text that [`Expr`] is read from, in bytes.
pub const MAX_TEXT: usize = 1000;
/// Maximum nesting depth of parentheses and functions in a text.
pub const MAX_NESTING: usize = 64;
/// Maximum decimal exponent (`1e400`), either sign.
pub const MAX_EXPONENT: i64 = 400;
/// Maximum power (`x^64`), either sign.
pub const MAX_POWER: i64 = 64;
/// Maximum denominator of an angle in turns. Finer angles leave no primes of 61 bits to compute with.
pub const MAX_ANGLE_DENOMINATOR: u64 = 1 << 44;

/// Values of names: the number of a word that is not part of the expression syntax, if it has one.
pub(crate) type Names<'n> = &'n mut dyn FnMut(&str) -> Option<Expr>;

/// The words of expressions, which cannot be names of numbers.
pub const WORDS: [&str; 7] = ["pi", "deg", "sqrt", "cos", "sin", "tan", "cot"];

impl FromStr for Expr {
    type Err = ExprError;

    /// Reads decimals, `+ - * /`, `^integer`, parentheses, `sqrt`, and `cos sin tan cot` of rational angles.
    ///
    /// # Errors
    /// Returns an [`ExprError`] with the byte where the text is malformed, exceeds a limit, or has no real value.
    fn from_str(text: &str) -> Result<Expr, ExprError> {
        Expr::with_names(text, false, &mut |_| None)
    }
}

impl Expr {
    /// Reads an expression in which words may be names of numbers, and `pi` may be a number outside angles ([`Expr::pi`]): `5/(2*pi)`.
    ///
    /// # Errors
    /// Returns an error in the same cases as [`Expr::from_str`].
    pub fn with_names(
        text: &str,
        pi_is_a_number: bool,
        names: Names<'_>,
    ) -> Result<Expr, ExprError> {
        if text.len() > MAX_TEXT / 5
            && let Some(e) = parse_fraction(text)
                .map(Expr::rational)
                .filter(|e| e.to_f64().is_finite())
        {
            return Ok(e);
        }
        if text.len() > MAX_TEXT {
            return Err(ExprError::TooLong { len: text.len() });
        }
        let mut named = false;
        let mut parser = Parser {
            text,
            pos: 0,
            depth: 0,
            pi_is_a_number,
            names: &mut |word| names(word).inspect(|_| named = true),
        };
        if parser.peek_byte().is_none() {
            return Err(ExprError::Empty);
        }
        let start = parser.pos;
        let value = parser.sum()?;
        if parser.peek_byte().is_some() {
            return Err(parser.unexpected_text("an operator or the end"));
        }
        let read = expect_number(value, start)?;
        // Short texts without powers do not become much longer when written.
        if !named && (text.len() > MAX_TEXT / 5 || text.contains(['e', 'E', '^'])) {
            match read.to_string().len() {
                len if len > MAX_TEXT => return Err(ExprError::WrittenTooLong { len }),
                _ => {}
            }
        }
        Ok(read)
    }
}

/// The value of a part of the text.
enum Value {
    Number(Expr),
    /// An angle in turns.
    Angle(BigRational),
}

fn expect_number(value: Value, at: usize) -> Result<Expr, ExprError> {
    match value {
        Value::Number(e) => check_finite(e, at),
        Value::Angle(_) => Err(ExprError::AngleOutside { at }),
    }
}

/// Returns an error for numbers beyond the range of doubles, and for fractions of such numbers. A number that is read must be readable
/// after it is written again.
fn check_finite(e: Expr, at: usize) -> Result<Expr, ExprError> {
    let holds = |n: &BigInt| n.bits() < 1024 || n.to_f64().is_some_and(f64::is_finite);
    let rational = e.rational_ref();
    if e.to_f64().is_finite() && rational.is_none_or(|r| holds(r.numer()) && holds(r.denom())) {
        Ok(e)
    } else {
        Err(ExprError::NotFinite { at })
    }
}

fn check_angle(turns: BigRational, at: usize) -> Result<Value, ExprError> {
    if bit_size(&turns) > MAX_BITS {
        Err(ExprError::TooManyDigits { at })
    } else {
        Ok(Value::Angle(turns))
    }
}

struct Parser<'a, 'n> {
    text: &'a str,
    /// Always on a character boundary: only ASCII is ever consumed.
    pos: usize,
    depth: usize,
    /// Outside angles.
    pi_is_a_number: bool,
    names: Names<'n>,
}

impl<'a> Parser<'a, '_> {
    /// Returns the next byte that is not white space.
    fn peek_byte(&mut self) -> Option<u8> {
        while self.byte_here().is_some_and(|b| b.is_ascii_whitespace()) {
            self.pos += 1;
        }
        self.byte_here()
    }

    fn byte_here(&self) -> Option<u8> {
        self.text.as_bytes().get(self.pos).copied()
    }

    fn take_while(&mut self, keep: impl Fn(u8) -> bool) -> &'a str {
        let start = self.pos;
        while self.byte_here().is_some_and(&keep) {
            self.pos += 1;
        }
        self.text.get(start..self.pos).unwrap_or("")
    }

    fn unexpected_text(&self, expected: &'static str) -> ExprError {
        let found = match self.text.get(self.pos..).and_then(|t| t.chars().next()) {
            Some(c) => format!("`{}`", c.escape_debug()),
            None => "the end of the text".to_owned(),
        };
        ExprError::Unexpected {
            at: self.pos,
            found,
            expected,
        }
    }

    fn expect_byte(&mut self, byte: u8, expected: &'static str) -> Result<(), ExprError> {
        if self.peek_byte() == Some(byte) {
            self.pos += 1;
            Ok(())
        } else {
            Err(self.unexpected_text(expected))
        }
    }

    fn sum(&mut self) -> Result<Value, ExprError> {
        let mut left = self.product()?;
        while let Some(op @ (b'+' | b'-')) = self.peek_byte() {
            let at = self.pos;
            self.pos += 1;
            let right = self.product()?;
            left = match (left, right) {
                (Value::Number(a), Value::Number(b)) => {
                    Value::Number(check_finite(if op == b'+' { a + b } else { a - b }, at)?)
                }
                (Value::Angle(a), Value::Angle(b)) => {
                    check_angle(if op == b'+' { a + b } else { a - b }, at)?
                }
                _ => return Err(ExprError::AngleOutside { at }),
            };
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Value, ExprError> {
        let mut left = self.parse_unary()?;
        while let Some(op @ (b'*' | b'/')) = self.peek_byte() {
            let at = self.pos;
            self.pos += 1;
            let right = self.parse_unary()?;
            let outside = || ExprError::AngleOutside { at };
            left = if op == b'*' {
                match (left, right) {
                    (Value::Number(a), Value::Number(b)) => Value::Number(check_finite(a * b, at)?),
                    (Value::Angle(a), Value::Number(b)) | (Value::Number(b), Value::Angle(a)) => {
                        check_angle(a * b.rational_ref().ok_or_else(outside)?, at)?
                    }
                    (Value::Angle(_), Value::Angle(_)) => return Err(outside()),
                }
            } else {
                let Value::Number(b) = right else {
                    return Err(outside());
                };
                if b.0.enclosure.has_zero() {
                    return Err(ExprError::DivisionByZero { at });
                }
                match left {
                    Value::Number(a) => Value::Number(check_finite(
                        a.div(&b).ok_or(ExprError::DivisionByZero { at })?,
                        at,
                    )?),
                    Value::Angle(a) => check_angle(a / b.rational_ref().ok_or_else(outside)?, at)?,
                }
            };
        }
        Ok(left)
    }

    fn parse_unary(&mut self) -> Result<Value, ExprError> {
        let mut negative = false;
        while let Some(sign @ (b'-' | b'+')) = self.peek_byte() {
            negative ^= sign == b'-';
            self.pos += 1;
        }
        let value = self.parse_power()?;
        Ok(match value {
            Value::Number(e) if negative => Value::Number(-e),
            Value::Angle(t) if negative => Value::Angle(-t),
            other => other,
        })
    }

    fn parse_power(&mut self) -> Result<Value, ExprError> {
        let base = self.parse_atom()?;
        if self.peek_byte() != Some(b'^') {
            return Ok(base);
        }
        let at = self.pos;
        self.pos += 1;
        let base = expect_number(base, at)?;
        let sign = match self.peek_byte() {
            Some(b'-') => -1,
            _ => 1,
        };
        if matches!(self.byte_here(), Some(b'-' | b'+')) {
            self.pos += 1;
        }
        if !self.peek_byte().is_some_and(|b| b.is_ascii_digit()) {
            return Err(self.unexpected_text("an integer power"));
        }
        let out_of_range = ExprError::PowerOutOfRange { at };
        let n: i64 = self
            .take_while(|b| b.is_ascii_digit())
            .parse()
            .map_err(|_| out_of_range.clone())?;
        if n > MAX_POWER {
            return Err(out_of_range);
        }
        if matches!(self.peek_byte(), Some(b'^' | b'.')) {
            return Err(self.unexpected_text("parentheses around the power, or an integer power"));
        }
        let n = sign * n;
        if n < 0 && base.0.enclosure.has_zero() {
            return Err(ExprError::DivisionByZero { at });
        }
        let result = match base.rational_ref() {
            _ if n == 0 => Expr::from(1),
            _ if n == 1 => base,
            Some(r) => {
                // The enclosure is checked first, because the exact power of a large number is expensive.
                check_finite(Expr::new(NodeKind::Pow(base.clone(), n)), at)?;
                if bit_size(r).saturating_mul(n.unsigned_abs()) > MAX_BITS {
                    return Err(ExprError::TooManyDigits { at });
                }
                Expr::rational(num_traits::Pow::pow(r, n as i32))
            }
            None => Expr::new(NodeKind::Pow(base, n)),
        };
        Ok(Value::Number(check_finite(result, at)?))
    }

    fn parse_atom(&mut self) -> Result<Value, ExprError> {
        match self.peek_byte() {
            Some(b'0'..=b'9' | b'.') => {
                let value = self.parse_decimal()?;
                self.parse_degrees(value)
            }
            Some(b'(') => {
                let at = self.pos;
                let value = self.parse_parentheses()?;
                match value {
                    Value::Number(e) => match e.rational_ref() {
                        Some(_) => self.parse_degrees(e),
                        None if self.word_is_deg() => Err(ExprError::NotAnAngle {
                            at,
                            function: "deg",
                        }),
                        None => Ok(Value::Number(e)),
                    },
                    other => Ok(other),
                }
            }
            Some(b) if b.is_ascii_alphabetic() => self.parse_word(),
            _ => Err(self.unexpected_text("a number, a function or `(`")),
        }
    }

    fn parse_parentheses(&mut self) -> Result<Value, ExprError> {
        if self.depth >= MAX_NESTING {
            return Err(ExprError::TooDeep { at: self.pos });
        }
        self.depth += 1;
        self.expect_byte(b'(', "`(`")?;
        let value = self.sum()?;
        self.expect_byte(b')', "an operator or `)`")?;
        self.depth -= 1;
        Ok(value)
    }

    fn word_is_deg(&mut self) -> bool {
        let _ = self.peek_byte();
        let rest = self.text.get(self.pos..).unwrap_or("");
        rest.starts_with("deg")
            && !rest
                .as_bytes()
                .get(3)
                .is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_')
    }

    /// Converts a rational to an angle if the suffix `deg` follows.
    fn parse_degrees(&mut self, e: Expr) -> Result<Value, ExprError> {
        if !self.word_is_deg() {
            return Ok(Value::Number(e));
        }
        let at = self.pos;
        self.pos += 3;
        match e.rational_ref() {
            Some(r) => check_angle(r / BigInt::from(360), at),
            None => Err(ExprError::NotAnAngle {
                at,
                function: "deg",
            }),
        }
    }

    fn parse_decimal(&mut self) -> Result<Expr, ExprError> {
        let at = self.pos;
        let whole = self.take_while(|b| b.is_ascii_digit());
        let mut fraction = "";
        let point = self.byte_here() == Some(b'.');
        if point {
            self.pos += 1;
            fraction = self.take_while(|b| b.is_ascii_digit());
        }
        if whole.is_empty() && fraction.is_empty() {
            return Err(ExprError::BadNumber { at });
        }
        let mut exponent = 0i64;
        if let Some(b'e' | b'E') = self.byte_here() {
            self.pos += 1;
            let negative = self.byte_here() == Some(b'-');
            if let Some(b'-' | b'+') = self.byte_here() {
                self.pos += 1;
            }
            let digits = self.take_while(|b| b.is_ascii_digit());
            if digits.is_empty() {
                return Err(ExprError::BadNumber { at });
            }
            exponent = digits.parse().unwrap_or(i64::MAX);
            if exponent > MAX_EXPONENT {
                return Err(ExprError::ExponentOutOfRange { at });
            }
            if negative {
                exponent = -exponent;
            }
        }
        let value =
            rational_from_decimal(whole, fraction, exponent).ok_or(ExprError::BadNumber { at })?;
        let digits = Digits::from_decimal(whole, fraction, exponent, point);
        let written = digits.map_or(WrittenNumber::Whole, WrittenNumber::Decimal);
        check_finite(Expr::rational(value).written_as(written), at)
    }

    fn parse_word(&mut self) -> Result<Value, ExprError> {
        let at = self.pos;
        let word = self.take_while(|b| b.is_ascii_alphanumeric() || b == b'_');
        let (function, name) = match word {
            "pi" if self.pi_is_a_number => return Ok(Value::Number(Expr::pi())),
            "pi" => return Ok(Value::Angle(BigRational::new(1.into(), 2.into()))),
            "sqrt" => {
                let inner = expect_number(self.parse_parentheses()?, at)?;
                return inner
                    .sqrt()
                    .map(Value::Number)
                    .ok_or(ExprError::NegativeRoot { at });
            }
            "cos" => (Function::Cos, "cos"),
            "sin" => (Function::Sin, "sin"),
            "tan" => (Function::Tan, "tan"),
            "cot" => (Function::Tan, "cot"),
            _ => {
                let unknown = || ExprError::UnknownWord {
                    at,
                    word: word.to_owned(),
                };
                let named = (self.names)(word).ok_or_else(unknown)?;
                return match named.rational_ref() {
                    Some(_) => self.parse_degrees(named),
                    None => Ok(Value::Number(named)),
                };
            }
        };
        let outside = std::mem::replace(&mut self.pi_is_a_number, false);
        let argument = self.parse_parentheses()?;
        self.pi_is_a_number = outside;
        let turns = match argument {
            Value::Angle(t) => t,
            Value::Number(e) if e.is_zero_rational() => BigRational::zero(),
            Value::Number(_) => return Err(ExprError::NotAnAngle { at, function: name }),
        };
        // cot a = tan(90deg - a)
        let turns = if name == "cot" {
            BigRational::new(1.into(), 4.into()) - turns
        } else {
            turns
        };
        let turns = &turns - turns.floor();
        let (Some(k), Some(n)) = (turns.numer().to_u64(), turns.denom().to_u64()) else {
            return Err(ExprError::AngleTooFine { at });
        };
        if n > MAX_ANGLE_DENOMINATOR {
            return Err(ExprError::AngleTooFine { at });
        }
        Expr::trig_of_turns(function, k, n)
            .map(Value::Number)
            .ok_or(ExprError::Pole { at, function: name })
    }
}
