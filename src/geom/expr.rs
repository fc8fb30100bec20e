//! Coordinates as the designer writes them, kept exact.
//!
//! An [`Expr`] is a tree over rationals, square roots and cosines of rational angles. Every node carries a rigorous
//! 256-bit enclosure of its value, so that signs, and an `f64` that survives cancellation, come for free.

use std::collections::HashSet;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};
use std::str::FromStr;
use std::sync::{Arc, LazyLock};

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// The longest text [`Expr`] is read from, in bytes.
pub const MAX_TEXT: usize = 1000;
/// The deepest nesting of parentheses and functions in a text.
pub const MAX_NESTING: usize = 64;
/// The largest decimal exponent (`1e400`), either sign.
pub const MAX_EXPONENT: i64 = 400;
/// The largest power (`x^64`), either sign.
pub const MAX_POWER: i64 = 64;
/// The largest denominator of an angle in turns; finer angles leave no primes of 61 bits to compute with.
pub const MAX_ANGLE_DENOMINATOR: u64 = 1 << 44;

/// Rationals wider than this stay unevaluated, so that repeated squaring cannot exhaust memory.
const MAX_BITS: u64 = 1 << 14;
/// Trees with more leaves than this are displayed as decimals: shared nodes make the full text exponentially long.
const MAX_SHOWN: u64 = 4096;

/// Why a text or a float is not an exact number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExprError {
    /// The text has no content.
    #[error("the expression is empty; write a number such as `1.5` or `sqrt(3)/2`")]
    Empty,
    /// The text exceeds [`MAX_TEXT`] bytes.
    #[error("the expression is {len} bytes long, over the limit of 1000; shorten it")]
    TooLong {
        /// The length of the text in bytes.
        len: usize,
    },
    /// Parentheses are nested over [`MAX_NESTING`] deep.
    #[error("the parentheses at byte {at} are nested more than 64 deep; simplify the expression")]
    TooDeep {
        /// Byte offset.
        at: usize,
    },
    /// A character that cannot stand here.
    #[error(
        "found {found} at byte {at} where {expected} should stand; correct the expression there"
    )]
    Unexpected {
        /// Byte offset.
        at: usize,
        /// What stands there.
        found: String,
        /// What may stand there.
        expected: &'static str,
    },
    /// A word that is no function, constant or unit.
    #[error(
        "unknown word `{word}` at byte {at}; known are the functions sqrt, cos, sin, tan and cot, and within their \
         angles the constant pi and the suffix deg"
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
    /// A decimal exponent beyond [`MAX_EXPONENT`].
    #[error("the decimal exponent at byte {at} is beyond 400; choose other units")]
    ExponentOutOfRange {
        /// Byte offset.
        at: usize,
    },
    /// A power beyond [`MAX_POWER`].
    #[error("the power at byte {at} is beyond 64; keep the integer after `^` between -64 and 64")]
    PowerOutOfRange {
        /// Byte offset.
        at: usize,
    },
    /// A divisor that is zero.
    #[error(
        "division by zero at byte {at}: the divisor vanishes (to 60 digits at least); correct the divisor"
    )]
    DivisionByZero {
        /// Byte offset.
        at: usize,
    },
    /// The square root of a negative number.
    #[error(
        "square root of a negative number at byte {at}; coordinates are real, check the sign of the radicand"
    )]
    NegativeRoot {
        /// Byte offset.
        at: usize,
    },
    /// A trigonometric argument that is no angle.
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
        "the angle at byte {at} is used as a plain number; `pi` and `deg` may only stand inside cos, sin, tan or cot, \
         and angles may only be added to angles and scaled by rationals"
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
    /// An angle with a denominator beyond [`MAX_ANGLE_DENOMINATOR`].
    #[error(
        "the angle at byte {at} is too finely divided to be kept exact; write it with at most ten decimals"
    )]
    AngleTooFine {
        /// Byte offset.
        at: usize,
    },
    /// The value exceeds the range of `f64`.
    #[error(
        "the value at byte {at} exceeds the range of floating-point numbers; choose other units"
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

/// An exact real number: rationals, square roots, cosines of rational angles. Clones share the tree.
#[derive(Clone)]
pub struct Expr(Arc<Node>);

struct Node {
    kind: Kind,
    enclosure: Enclosure,
    /// Leaves of the tree as written out, saturating.
    size: u64,
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
    fn children(&self) -> [Option<&Expr>; 2] {
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

fn bits(r: &BigRational) -> u64 {
    r.numer().bits() + r.denom().bits()
}

impl Expr {
    fn new(kind: Kind) -> Expr {
        let enclosure = match &kind {
            Kind::Rational(r) => Enclosure::rational(r),
            Kind::Add(a, b) => a.0.enclosure.add(&b.0.enclosure),
            Kind::Sub(a, b) => a.0.enclosure.add(&b.0.enclosure.neg()),
            Kind::Mul(a, b) => a.0.enclosure.mul(&b.0.enclosure),
            Kind::Div(a, b) => a.0.enclosure.div(&b.0.enclosure),
            Kind::Neg(a) => a.0.enclosure.neg(),
            Kind::Pow(a, n) => a.0.enclosure.pow(*n),
            Kind::Sqrt(a) => a.0.enclosure.sqrt(),
            Kind::Trig(Function::Cos, k, n) => Enclosure::cos(*k, *n),
            Kind::Trig(Function::Sin, k, n) => Enclosure::sin(*k, *n),
            Kind::Trig(Function::Tan, k, n) => Enclosure::sin(*k, *n).div(&Enclosure::cos(*k, *n)),
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
        }))
    }

    /// The expression of a rational number. O(1).
    #[must_use]
    pub fn rational(value: BigRational) -> Expr {
        Expr::new(Kind::Rational(value))
    }

    /// The shortest decimal that reads back as `x`, taken exactly: `0.1` is one tenth, as the designer meant.
    ///
    /// # Errors
    /// [`ExprError::NonFiniteFloat`] for infinities and NaN.
    pub fn from_f64(x: f64) -> Result<Expr, ExprError> {
        let bad = || ExprError::NonFiniteFloat {
            value: x.to_string(),
        };
        if !x.is_finite() {
            return Err(bad());
        }
        let text = format!("{:e}", x.abs());
        let (mantissa, exponent) = text.split_once('e').ok_or_else(bad)?;
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let exponent: i64 = exponent.parse().map_err(|_| bad())?;
        let value = decimal(whole, fraction, exponent).ok_or_else(bad)?;
        Ok(Expr::rational(if x < 0.0 { -value } else { value }))
    }

    /// The nearest double, right to the last bit or nearly so even after cancellation; values that vanish to all 256
    /// bits give 0, and those beyond the range of `f64` an infinity. O(1).
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        self.0.enclosure.to_f64()
    }

    /// The rational this expression has been folded to, if it has. O(size of the number).
    #[must_use]
    pub fn as_rational(&self) -> Option<BigRational> {
        self.rational_ref().cloned()
    }

    /// Whether the expression has been folded to the rational 0. O(1).
    #[must_use]
    pub fn is_zero_rational(&self) -> bool {
        self.rational_ref().is_some_and(Zero::is_zero)
    }

    pub(crate) fn rational_ref(&self) -> Option<&BigRational> {
        match &self.0.kind {
            Kind::Rational(r) => Some(r),
            _ => None,
        }
    }

    pub(crate) fn kind(&self) -> &Kind {
        &self.0.kind
    }

    /// Identifies the shared node, for memo tables that live no longer than the expression.
    pub(crate) fn id(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// Every distinct node once, children before parents; iterative because trees built in loops are deep.
    pub(crate) fn post_order(&self) -> Vec<&Expr> {
        let (mut order, mut seen, mut stack) = (Vec::new(), HashSet::new(), vec![(self, false)]);
        while let Some((e, expanded)) = stack.pop() {
            if expanded {
                order.push(e);
            } else if seen.insert(e.id()) {
                stack.push((e, true));
                for c in e.0.kind.children().into_iter().flatten() {
                    stack.push((c, false));
                }
            }
        }
        order
    }

    /// The square root, or `None` for a negative number.
    pub(crate) fn sqrt(&self) -> Option<Expr> {
        if self.0.enclosure.hi.is_negative() {
            return None;
        }
        if let Some(r) = self.rational_ref()
            && let Some(s) = rational_sqrt(r)
        {
            return Some(Expr::rational(s));
        }
        Some(Expr::new(Kind::Sqrt(self.clone())))
    }

    /// The quotient, or `None` where the divisor cannot be told from zero.
    fn div(&self, other: &Expr) -> Option<Expr> {
        if other.0.enclosure.has_zero() {
            return None;
        }
        if let (Some(a), Some(b)) = (self.rational_ref(), other.rational_ref())
            && bits(a) + bits(b) <= MAX_BITS
        {
            return Some(Expr::rational(a / b));
        }
        if self.is_zero_rational() || other.rational_ref().is_some_and(One::is_one) {
            return Some(self.clone());
        }
        Some(Expr::new(Kind::Div(self.clone(), other.clone())))
    }

    /// The function of `k/n` turns (any integer `k`, `n > 0`), or `None` at a pole.
    pub(crate) fn trig(function: Function, k: u64, n: u64) -> Option<Expr> {
        let n = n.max(1);
        let g = (k % n).gcd(&n);
        let (k, n) = (k % n / g, n / g);
        let int = |x: i64| Some(Expr::from(x));
        // By Niven's theorem these are all the rational values.
        match (function, k, n) {
            (Function::Cos, 0, 1) => int(1),
            (Function::Cos, _, 2) => int(-1),
            (Function::Cos, _, 4) | (Function::Sin, _, 1 | 2) | (Function::Tan, _, 1 | 2) => int(0),
            (Function::Cos, _, 3) => Some(Expr::rational(BigRational::new((-1).into(), 2.into()))),
            (Function::Cos, _, 6) => Some(Expr::rational(BigRational::new(1.into(), 2.into()))),
            (Function::Sin, k, 4) => int(if k == 1 { 1 } else { -1 }),
            (Function::Sin, k, 12) => {
                let sign = if k < 6 { 1 } else { -1 };
                // k = 1, 5 is 30deg, 150deg; 7, 11 their opposites.
                Some(Expr::rational(BigRational::new(sign.into(), 2.into())))
            }
            (Function::Tan, _, 4) => None,
            (Function::Tan, k, 8) => int(if k % 4 == 1 { 1 } else { -1 }),
            _ => Some(Expr::new(Kind::Trig(function, k, n))),
        }
    }

    fn combine(
        a: &Expr,
        b: &Expr,
        fold: impl Fn(&BigRational, &BigRational) -> BigRational,
    ) -> Option<Expr> {
        let (x, y) = (a.rational_ref()?, b.rational_ref()?);
        (bits(x) + bits(y) <= MAX_BITS).then(|| Expr::rational(fold(x, y)))
    }
}

impl From<i64> for Expr {
    fn from(x: i64) -> Expr {
        Expr::rational(BigRational::from_integer(x.into()))
    }
}

impl Add for &Expr {
    type Output = Expr;
    fn add(self, other: &Expr) -> Expr {
        if let Some(e) = Expr::combine(self, other, |a, b| a + b) {
            return e;
        }
        match (self.is_zero_rational(), other.is_zero_rational()) {
            (true, _) => other.clone(),
            (_, true) => self.clone(),
            _ => Expr::new(Kind::Add(self.clone(), other.clone())),
        }
    }
}

impl Sub for &Expr {
    type Output = Expr;
    fn sub(self, other: &Expr) -> Expr {
        if let Some(e) = Expr::combine(self, other, |a, b| a - b) {
            return e;
        }
        match (self.is_zero_rational(), other.is_zero_rational()) {
            (true, _) => -other,
            (_, true) => self.clone(),
            _ => Expr::new(Kind::Sub(self.clone(), other.clone())),
        }
    }
}

impl Mul for &Expr {
    type Output = Expr;
    fn mul(self, other: &Expr) -> Expr {
        if let Some(e) = Expr::combine(self, other, |a, b| a * b) {
            return e;
        }
        for (a, b) in [(self, other), (other, self)] {
            if let Some(r) = a.rational_ref() {
                if r.is_zero() {
                    return a.clone();
                }
                if r.is_one() {
                    return b.clone();
                }
                if (-r).is_one() {
                    return -b;
                }
            }
        }
        Expr::new(Kind::Mul(self.clone(), other.clone()))
    }
}

impl Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        match &self.0.kind {
            Kind::Rational(r) => Expr::rational(-r),
            Kind::Neg(a) => a.clone(),
            _ => Expr::new(Kind::Neg(self.clone())),
        }
    }
}

impl Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        -&self
    }
}

macro_rules! owned_operators {
    ($($trait:ident $method:ident),*) => {$(
        impl $trait for Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                $trait::$method(&self, &other)
            }
        }
        impl $trait<&Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                $trait::$method(&self, other)
            }
        }
        impl $trait<Expr> for &Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                $trait::$method(self, &other)
            }
        }
    )*};
}
owned_operators!(Add add, Sub sub, Mul mul);

/// The root of a rational that is the square of a rational.
pub(crate) fn rational_sqrt(r: &BigRational) -> Option<BigRational> {
    if r.is_negative() {
        return None;
    }
    let (n, d) = (r.numer().sqrt(), r.denom().sqrt());
    (&n * &n == *r.numer() && &d * &d == *r.denom()).then(|| BigRational::new(n, d))
}

/// `whole.fraction * 10^exponent` exactly; `None` unless both parts are digits.
fn decimal(whole: &str, fraction: &str, exponent: i64) -> Option<BigRational> {
    let digits = BigInt::parse_bytes(format!("0{whole}{fraction}").as_bytes(), 10)?;
    let exponent = exponent.checked_sub(i64::try_from(fraction.len()).ok()?)?;
    let scale = BigInt::from(10).pow(u32::try_from(exponent.unsigned_abs()).ok()?);
    Some(if exponent < 0 {
        BigRational::new(digits, scale)
    } else {
        BigRational::from_integer(digits * scale)
    })
}

// Binding strengths in the written form.
const SUM: u8 = 1;
const PRODUCT: u8 = 2;
const UNARY: u8 = 3;
const ATOM: u8 = 5;

/// A rational as text, a terminating decimal where that is short, with its binding strength.
fn show_rational(r: &BigRational) -> (String, u8) {
    let sign = if r.is_negative() { "-" } else { "" };
    let strength = if r.is_negative() { UNARY } else { ATOM };
    let (n, d) = (r.numer().abs(), r.denom());
    if d.is_one() {
        return (format!("{sign}{n}"), strength);
    }
    let (twos, mut rest) = (
        d.trailing_zeros().unwrap_or(0),
        d >> d.trailing_zeros().unwrap_or(0),
    );
    let mut fives = 0u64;
    let five = BigInt::from(5);
    while fives <= 20 && rest.is_multiple_of(&five) {
        rest /= &five;
        fives += 1;
    }
    let places = twos.max(fives) as usize;
    if !rest.is_one() || places > 20 {
        return (format!("{sign}{n}/{d}"), PRODUCT);
    }
    let scaled = n * BigInt::from(10).pow(places as u32) / d;
    let digits = format!(
        "{scaled:0>width$}",
        scaled = scaled.to_string(),
        width = places + 1
    );
    let (whole, fraction) = digits.split_at(digits.len() - places);
    (format!("{sign}{whole}.{fraction}"), strength)
}

/// Writes a text that [`FromStr`] reads back as the same number (as long as it stays within the limits on texts).
/// Trees of several thousand leaves are written as a decimal approximation instead.
impl fmt::Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        enum Task<'a> {
            Text(&'static str),
            Power(i64),
            Tree(&'a Expr, u8),
        }
        use Task::{Power, Text, Tree};
        if self.0.size > MAX_SHOWN {
            return write!(f, "{:?}", self.to_f64());
        }
        let mut tasks = vec![Tree(self, 0)];
        while let Some(task) = tasks.pop() {
            let (e, least) = match task {
                Text(t) => {
                    f.write_str(t)?;
                    continue;
                }
                Power(n) => {
                    write!(f, "^{n}")?;
                    continue;
                }
                Tree(e, least) => (e, least),
            };
            // In reverse: the stack is written from its end.
            let (strength, mut parts) = match &e.0.kind {
                Kind::Rational(r) => {
                    let (text, strength) = show_rational(r);
                    if strength < least {
                        write!(f, "({text})")?
                    } else {
                        f.write_str(&text)?
                    }
                    continue;
                }
                Kind::Trig(function, k, n) => {
                    let name = match function {
                        Function::Cos => "cos",
                        Function::Sin => "sin",
                        Function::Tan => "tan",
                    };
                    let (angle, strength) =
                        show_rational(&BigRational::new(BigInt::from(*k) * 360, (*n).into()));
                    if strength == ATOM {
                        write!(f, "{name}({angle}deg)")?
                    } else {
                        write!(f, "{name}(({angle})deg)")?
                    }
                    continue;
                }
                Kind::Add(a, b) => (SUM, vec![Tree(b, PRODUCT), Text("+"), Tree(a, SUM)]),
                Kind::Sub(a, b) => (SUM, vec![Tree(b, PRODUCT), Text("-"), Tree(a, SUM)]),
                Kind::Mul(a, b) => (PRODUCT, vec![Tree(b, UNARY), Text("*"), Tree(a, PRODUCT)]),
                Kind::Div(a, b) => (PRODUCT, vec![Tree(b, UNARY), Text("/"), Tree(a, PRODUCT)]),
                Kind::Neg(a) => (UNARY, vec![Tree(a, UNARY), Text("-")]),
                Kind::Pow(a, n) => (UNARY + 1, vec![Power(*n), Tree(a, ATOM)]),
                Kind::Sqrt(a) => (ATOM, vec![Text(")"), Tree(a, 0), Text("sqrt(")]),
            };
            if strength < least {
                tasks.push(Text(")"));
                tasks.append(&mut parts);
                tasks.push(Text("("));
            } else {
                tasks.append(&mut parts);
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Expr({self})")
    }
}

impl FromStr for Expr {
    type Err = ExprError;

    /// Reads decimals, `+ - * /`, `^integer`, parentheses, `sqrt`, and `cos sin tan cot` of rational angles.
    ///
    /// # Errors
    /// An [`ExprError`] naming the byte where the text is malformed, out of limits, or has no real value.
    fn from_str(text: &str) -> Result<Expr, ExprError> {
        if text.len() > MAX_TEXT {
            return Err(ExprError::TooLong { len: text.len() });
        }
        let mut parser = Parser {
            text,
            pos: 0,
            depth: 0,
        };
        if parser.peek().is_none() {
            return Err(ExprError::Empty);
        }
        let start = parser.pos;
        let value = parser.sum()?;
        if parser.peek().is_some() {
            return Err(parser.unexpected("an operator or the end"));
        }
        number(value, start)
    }
}

/// What a part of the text stands for.
enum Value {
    Number(Expr),
    /// An angle in turns.
    Angle(BigRational),
}

fn number(value: Value, at: usize) -> Result<Expr, ExprError> {
    match value {
        Value::Number(e) => finite(e, at),
        Value::Angle(_) => Err(ExprError::AngleOutside { at }),
    }
}

fn finite(e: Expr, at: usize) -> Result<Expr, ExprError> {
    if e.to_f64().is_finite() {
        Ok(e)
    } else {
        Err(ExprError::NotFinite { at })
    }
}

fn angle(turns: BigRational, at: usize) -> Result<Value, ExprError> {
    if bits(&turns) > MAX_BITS {
        Err(ExprError::TooManyDigits { at })
    } else {
        Ok(Value::Angle(turns))
    }
}

struct Parser<'a> {
    text: &'a str,
    /// Always on a character boundary: only ASCII is ever consumed.
    pos: usize,
    depth: usize,
}

impl<'a> Parser<'a> {
    /// The next byte that is not white space.
    fn peek(&mut self) -> Option<u8> {
        while self.here().is_some_and(|b| b.is_ascii_whitespace()) {
            self.pos += 1;
        }
        self.here()
    }

    fn here(&self) -> Option<u8> {
        self.text.as_bytes().get(self.pos).copied()
    }

    fn take_while(&mut self, keep: impl Fn(u8) -> bool) -> &'a str {
        let start = self.pos;
        while self.here().is_some_and(&keep) {
            self.pos += 1;
        }
        self.text.get(start..self.pos).unwrap_or("")
    }

    fn unexpected(&self, expected: &'static str) -> ExprError {
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

    fn expect(&mut self, byte: u8, expected: &'static str) -> Result<(), ExprError> {
        if self.peek() == Some(byte) {
            self.pos += 1;
            Ok(())
        } else {
            Err(self.unexpected(expected))
        }
    }

    fn sum(&mut self) -> Result<Value, ExprError> {
        let mut left = self.product()?;
        while let Some(op @ (b'+' | b'-')) = self.peek() {
            let at = self.pos;
            self.pos += 1;
            let right = self.product()?;
            left = match (left, right) {
                (Value::Number(a), Value::Number(b)) => {
                    Value::Number(finite(if op == b'+' { a + b } else { a - b }, at)?)
                }
                (Value::Angle(a), Value::Angle(b)) => {
                    angle(if op == b'+' { a + b } else { a - b }, at)?
                }
                _ => return Err(ExprError::AngleOutside { at }),
            };
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Value, ExprError> {
        let mut left = self.unary()?;
        while let Some(op @ (b'*' | b'/')) = self.peek() {
            let at = self.pos;
            self.pos += 1;
            let right = self.unary()?;
            let outside = || ExprError::AngleOutside { at };
            left = if op == b'*' {
                match (left, right) {
                    (Value::Number(a), Value::Number(b)) => Value::Number(finite(a * b, at)?),
                    (Value::Angle(a), Value::Number(b)) | (Value::Number(b), Value::Angle(a)) => {
                        angle(a * b.rational_ref().ok_or_else(outside)?, at)?
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
                    Value::Number(a) => Value::Number(finite(
                        a.div(&b).ok_or(ExprError::DivisionByZero { at })?,
                        at,
                    )?),
                    Value::Angle(a) => angle(a / b.rational_ref().ok_or_else(outside)?, at)?,
                }
            };
        }
        Ok(left)
    }

    fn unary(&mut self) -> Result<Value, ExprError> {
        let mut negative = false;
        while let Some(sign @ (b'-' | b'+')) = self.peek() {
            negative ^= sign == b'-';
            self.pos += 1;
        }
        let value = self.power()?;
        Ok(match value {
            Value::Number(e) if negative => Value::Number(-e),
            Value::Angle(t) if negative => Value::Angle(-t),
            other => other,
        })
    }

    fn power(&mut self) -> Result<Value, ExprError> {
        let base = self.atom()?;
        if self.peek() != Some(b'^') {
            return Ok(base);
        }
        let at = self.pos;
        self.pos += 1;
        let base = number(base, at)?;
        let sign = match self.peek() {
            Some(b'-') => -1,
            _ => 1,
        };
        if matches!(self.here(), Some(b'-' | b'+')) {
            self.pos += 1;
        }
        if !self.peek().is_some_and(|b| b.is_ascii_digit()) {
            return Err(self.unexpected("an integer power"));
        }
        let out_of_range = ExprError::PowerOutOfRange { at };
        let n: i64 = self
            .take_while(|b| b.is_ascii_digit())
            .parse()
            .map_err(|_| out_of_range.clone())?;
        if n > MAX_POWER {
            return Err(out_of_range);
        }
        if matches!(self.peek(), Some(b'^' | b'.')) {
            return Err(self.unexpected("parentheses around the power, or an integer power"));
        }
        let n = sign * n;
        if n < 0 && base.0.enclosure.has_zero() {
            return Err(ExprError::DivisionByZero { at });
        }
        let result = match base.rational_ref() {
            _ if n == 0 => Expr::from(1),
            _ if n == 1 => base,
            Some(r) => {
                // Checked on the enclosure first: the exact power of a large number is the costly part.
                finite(Expr::new(Kind::Pow(base.clone(), n)), at)?;
                if bits(r).saturating_mul(n.unsigned_abs()) > MAX_BITS {
                    return Err(ExprError::TooManyDigits { at });
                }
                Expr::rational(num_traits::Pow::pow(r, n as i32))
            }
            None => Expr::new(Kind::Pow(base, n)),
        };
        Ok(Value::Number(finite(result, at)?))
    }

    fn atom(&mut self) -> Result<Value, ExprError> {
        match self.peek() {
            Some(b'0'..=b'9' | b'.') => {
                let value = self.decimal()?;
                self.degrees(value)
            }
            Some(b'(') => {
                let at = self.pos;
                let value = self.parentheses()?;
                match value {
                    Value::Number(e) => match e.rational_ref() {
                        Some(_) => self.degrees(e),
                        None if self.word_is_deg() => Err(ExprError::NotAnAngle {
                            at,
                            function: "deg",
                        }),
                        None => Ok(Value::Number(e)),
                    },
                    other => Ok(other),
                }
            }
            Some(b) if b.is_ascii_alphabetic() => self.word(),
            _ => Err(self.unexpected("a number, a function or `(`")),
        }
    }

    fn parentheses(&mut self) -> Result<Value, ExprError> {
        if self.depth >= MAX_NESTING {
            return Err(ExprError::TooDeep { at: self.pos });
        }
        self.depth += 1;
        self.expect(b'(', "`(`")?;
        let value = self.sum()?;
        self.expect(b')', "an operator or `)`")?;
        self.depth -= 1;
        Ok(value)
    }

    fn word_is_deg(&mut self) -> bool {
        let _ = self.peek();
        let rest = self.text.get(self.pos..).unwrap_or("");
        rest.starts_with("deg")
            && !rest
                .as_bytes()
                .get(3)
                .is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_')
    }

    /// Turns a rational into an angle where the suffix `deg` follows.
    fn degrees(&mut self, e: Expr) -> Result<Value, ExprError> {
        if !self.word_is_deg() {
            return Ok(Value::Number(e));
        }
        let at = self.pos;
        self.pos += 3;
        match e.rational_ref() {
            Some(r) => angle(r / BigInt::from(360), at),
            None => Err(ExprError::NotAnAngle {
                at,
                function: "deg",
            }),
        }
    }

    fn decimal(&mut self) -> Result<Expr, ExprError> {
        let at = self.pos;
        let whole = self.take_while(|b| b.is_ascii_digit());
        let mut fraction = "";
        if self.here() == Some(b'.') {
            self.pos += 1;
            fraction = self.take_while(|b| b.is_ascii_digit());
        }
        if whole.is_empty() && fraction.is_empty() {
            return Err(ExprError::BadNumber { at });
        }
        let mut exponent = 0i64;
        if let Some(b'e' | b'E') = self.here() {
            self.pos += 1;
            let negative = self.here() == Some(b'-');
            if let Some(b'-' | b'+') = self.here() {
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
        let value = decimal(whole, fraction, exponent).ok_or(ExprError::BadNumber { at })?;
        finite(Expr::rational(value), at)
    }

    fn word(&mut self) -> Result<Value, ExprError> {
        let at = self.pos;
        let word = self.take_while(|b| b.is_ascii_alphanumeric() || b == b'_');
        let (function, name) = match word {
            "pi" => return Ok(Value::Angle(BigRational::new(1.into(), 2.into()))),
            "sqrt" => {
                let inner = number(self.parentheses()?, at)?;
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
                return Err(ExprError::UnknownWord {
                    at,
                    word: word.to_owned(),
                });
            }
        };
        let turns = match self.parentheses()? {
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
        Expr::trig(function, k, n)
            .map(Value::Number)
            .ok_or(ExprError::Pole { at, function: name })
    }
}

/// Bits of precision of an enclosure.
const PRECISION: u64 = 256;
/// Scale of the fixed-point cosine series; the spare bits absorb the rounding of its terms.
const FIXED: u64 = 320;
/// Binary exponents saturate here, far beyond the range of `f64`.
const EXPONENT_LIMIT: i64 = 1 << 40;

/// A closed interval `[lo, hi] * 2^e` that contains a real number.
struct Enclosure {
    lo: BigInt,
    hi: BigInt,
    e: i64,
}

fn floor_shift(x: &BigInt, s: i64) -> BigInt {
    if s >= 0 {
        x >> s
    } else {
        x << s.unsigned_abs()
    }
}

fn ceil_shift(x: &BigInt, s: i64) -> BigInt {
    -floor_shift(&-x, s)
}

fn ceil_div(a: &BigInt, b: &BigInt) -> BigInt {
    -(-a).div_floor(b)
}

impl Enclosure {
    fn new(lo: BigInt, hi: BigInt, e: i64) -> Enclosure {
        let excess = lo.bits().max(hi.bits()).saturating_sub(PRECISION) as i64;
        let (lo, hi) = if excess > 0 {
            (floor_shift(&lo, excess), ceil_shift(&hi, excess))
        } else {
            (lo, hi)
        };
        Enclosure {
            lo,
            hi,
            e: e.saturating_add(excess)
                .clamp(-EXPONENT_LIMIT, EXPONENT_LIMIT),
        }
    }

    fn rational(r: &BigRational) -> Enclosure {
        let shift = if r.is_integer() {
            0
        } else {
            (PRECISION + r.denom().bits()).saturating_sub(r.numer().bits())
        };
        let n = r.numer() << shift;
        Enclosure::new(
            n.div_floor(r.denom()),
            ceil_div(&n, r.denom()),
            -(shift as i64),
        )
    }

    fn has_zero(&self) -> bool {
        !self.lo.is_positive() && !self.hi.is_negative()
    }

    fn is_zero(&self) -> bool {
        self.lo.is_zero() && self.hi.is_zero()
    }

    fn neg(&self) -> Enclosure {
        Enclosure {
            lo: -&self.hi,
            hi: -&self.lo,
            e: self.e,
        }
    }

    fn add(&self, other: &Enclosure) -> Enclosure {
        if self.is_zero() || other.is_zero() {
            let x = if self.is_zero() { other } else { self };
            return Enclosure {
                lo: x.lo.clone(),
                hi: x.hi.clone(),
                e: x.e,
            };
        }
        // A term that lies far below the other is rounded away rather than aligned, whatever the exponents.
        let e = self
            .e
            .min(other.e)
            .max(self.e.max(other.e) - 2 * PRECISION as i64);
        let lo = floor_shift(&self.lo, e - self.e) + floor_shift(&other.lo, e - other.e);
        let hi = ceil_shift(&self.hi, e - self.e) + ceil_shift(&other.hi, e - other.e);
        Enclosure::new(lo, hi, e)
    }

    fn mul(&self, other: &Enclosure) -> Enclosure {
        let products = [
            &self.lo * &other.lo,
            &self.lo * &other.hi,
            &self.hi * &other.lo,
            &self.hi * &other.hi,
        ];
        Enclosure::hull(products.iter(), products.iter(), self.e + other.e)
    }

    fn hull<'a>(
        lows: impl Iterator<Item = &'a BigInt>,
        highs: impl Iterator<Item = &'a BigInt>,
        e: i64,
    ) -> Enclosure {
        Enclosure::new(
            lows.min().cloned().unwrap_or_default(),
            highs.max().cloned().unwrap_or_default(),
            e,
        )
    }

    /// Quotient; a divisor that contains zero (which callers exclude) yields zero.
    fn div(&self, other: &Enclosure) -> Enclosure {
        if other.has_zero() {
            return Enclosure::new(BigInt::zero(), BigInt::zero(), 0);
        }
        let shift = PRECISION + other.lo.bits().max(other.hi.bits());
        let (lo, hi) = (&self.lo << shift, &self.hi << shift);
        let pairs = [
            (&lo, &other.lo),
            (&lo, &other.hi),
            (&hi, &other.lo),
            (&hi, &other.hi),
        ];
        let (lows, highs) = (
            pairs.map(|(a, b)| a.div_floor(b)),
            pairs.map(|(a, b)| ceil_div(a, b)),
        );
        Enclosure::hull(lows.iter(), highs.iter(), self.e - other.e - shift as i64)
    }

    fn pow(&self, n: i64) -> Enclosure {
        let mut result = Enclosure::new(BigInt::one(), BigInt::one(), 0);
        for bit in (0..64 - n.unsigned_abs().leading_zeros()).rev() {
            result = result.mul(&result);
            if n.unsigned_abs() >> bit & 1 == 1 {
                result = result.mul(self);
            }
        }
        if n < 0 {
            Enclosure::new(BigInt::one(), BigInt::one(), 0).div(&result)
        } else {
            result
        }
    }

    fn sqrt(&self) -> Enclosure {
        let mut shift = (2 * PRECISION).saturating_sub(self.hi.bits());
        if (self.e - shift as i64).rem_euclid(2) == 1 {
            shift += 1;
        }
        let positive = |x: &BigInt| {
            if x.is_negative() {
                BigInt::zero()
            } else {
                x << shift
            }
        };
        let (lo, hi) = (positive(&self.lo), positive(&self.hi));
        let root = hi.sqrt();
        let root = if &root * &root == hi { root } else { root + 1 };
        Enclosure::new(lo.sqrt(), root, (self.e - shift as i64) / 2)
    }

    fn sin(k: u64, n: u64) -> Enclosure {
        // sin x = cos(x - 1/4 turn); the parser's bound on n keeps 4n in range.
        let (k, n) = (u128::from(k) * 4 + 3 * u128::from(n), u128::from(n) * 4);
        Enclosure::cos_turns(k % n, n)
    }

    fn cos(k: u64, n: u64) -> Enclosure {
        Enclosure::cos_turns(u128::from(k), u128::from(n))
    }

    fn cos_turns(k: u128, n: u128) -> Enclosure {
        let k = k.min(n.saturating_sub(k));
        if 4 * k > n {
            // cos x = -cos(1/2 turn - x)
            return Enclosure::cos_turns(n - 2 * k, 2 * n).neg();
        }
        static PI: LazyLock<BigInt> = LazyLock::new(|| {
            // Machin: pi = 16 atan(1/5) - 4 atan(1/239)
            let atan = |x: u32| {
                let mut power = (BigInt::one() << FIXED) / x;
                let (mut sum, mut j) = (BigInt::zero(), 0u32);
                while !power.is_zero() {
                    let term = &power / (2 * j + 1);
                    sum = if j % 2 == 0 { sum + term } else { sum - term };
                    power /= x * x;
                    j += 1;
                }
                sum
            };
            atan(5) * 16 - atan(239) * 4
        });
        let x: BigInt = &*PI * 2 * BigInt::from(k) / BigInt::from(n.max(1));
        let square: BigInt = (&x * &x) >> FIXED;
        let mut term = BigInt::one() << FIXED;
        let (mut sum, mut j) = (BigInt::zero(), 0u32);
        while !term.is_zero() {
            sum = if j % 2 == 0 { sum + &term } else { sum - &term };
            term = ((term * &square) >> FIXED) / ((2 * j + 1) * (2 * j + 2));
            j += 1;
        }
        // Some 80 terms of an ulp or two each, times a few for pi.
        let slack = BigInt::from(1 << 14);
        Enclosure::new(&sum - &slack, sum + slack, -(FIXED as i64))
    }

    /// The midpoint rounded to nearest even.
    fn to_f64(&self) -> f64 {
        if self.lo.is_negative() && self.hi.is_positive() {
            return 0.0;
        }
        let (mid, e) = (&self.lo + &self.hi, self.e - 1);
        let magnitude = mid.magnitude();
        if magnitude.is_zero() {
            return 0.0;
        }
        let top = e + magnitude.bits() as i64;
        if top > 1030 {
            return if mid.sign() == Sign::Minus {
                f64::NEG_INFINITY
            } else {
                f64::INFINITY
            };
        }
        // Below all subnormals; aligning such a number would take memory in proportion to its exponent.
        if top < -1080 {
            return 0.0;
        }
        // The last bit a double of this size has; subnormals stop at -1074.
        let last = (top - 53).max(-1074);
        let shift = last - e;
        let rounded = if shift <= 0 {
            magnitude << shift.unsigned_abs()
        } else {
            let kept = magnitude >> shift;
            let rest = magnitude - (&kept << shift);
            let half = num_bigint::BigUint::one() << (shift - 1);
            if rest > half || (rest == half && kept.is_odd()) {
                kept + 1u32
            } else {
                kept
            }
        };
        // In two steps, because 2^-1074 alone is subnormal and 2^1023 the largest power.
        let m = rounded.to_u64().unwrap_or(0) as f64;
        let half = (last / 2) as i32;
        let value = m * 2f64.powi(half) * 2f64.powi(last as i32 - half);
        if mid.sign() == Sign::Minus {
            -value
        } else {
            value
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn rational(text: &str) -> Option<BigRational> {
        text.parse::<Expr>().unwrap().as_rational()
    }

    #[test]
    fn rational_values_are_folded() {
        for (text, n, d) in [
            ("sqrt(4)", 2, 1),
            ("cos(60deg)", 1, 2),
            ("sin(30deg)", 1, 2),
            ("sin(210deg)", -1, 2),
            ("1/3+1/6", 1, 2),
            ("tan(135deg)", -1, 1),
            ("cot(-45deg)", -1, 1),
            ("cos(2*pi/3)", -1, 2),
            ("1.5e-3", 3, 2000),
            ("-2^2", -4, 1),
            ("2^-3", 1, 8),
            ("cos(0)", 1, 1),
            ("sqrt(0.25)*-8/2", -2, 1),
        ] {
            assert_eq!(
                rational(text),
                Some(BigRational::new(n.into(), d.into())),
                "{text}"
            );
        }
        assert_eq!(rational("sqrt(2)"), None);
    }

    #[test]
    fn mistakes_are_told() {
        for text in [
            "",
            "pi",
            "sin(1)",
            "foo(1)",
            "1/0",
            "sqrt(-1)",
            "tan(90deg)",
            "cot(0)",
            "1e401",
            "2^65",
            "10^64^2",
            "1e400",
            "(",
            "2pi",
            "36deg",
            "1/(sqrt(2)*sqrt(3)-sqrt(6))",
            "cos(60deg",
            "sqrt(1-sqrt(2))",
            "1e",
            ".",
            "cos(pi*sqrt(2))",
        ] {
            let error = text.parse::<Expr>().unwrap_err();
            assert!(!error.to_string().is_empty(), "{text}");
        }
        assert!("(".repeat(900).parse::<Expr>().is_err());
        assert!(Expr::from_f64(f64::NAN).is_err());
    }

    #[test]
    fn deep_trees_are_safe() {
        let root: Expr = "sqrt(2)".parse().unwrap();
        let sum = (0..20_000).fold(root.clone(), |s, _| s + &root);
        assert!((sum.to_f64() - 20_001.0 * 2f64.sqrt()).abs() < 1e-9);
        let _ = sum.to_string();
        let square = (0..80).fold(root, |s, _| &s * &s);
        let _ = square.to_string();
        let tiny: Expr = "((((((sqrt(2)*1e-300)^64)^64)^64)^64)^64)^64"
            .parse()
            .unwrap();
        assert_eq!(tiny.to_f64(), 0.0);
        assert_eq!((&tiny + &Expr::from(1)).to_f64(), 1.0);
    }

    fn text() -> impl Strategy<Value = (String, f64)> {
        let leaf = prop_oneof![
            (1i64..50).prop_map(|x| (x.to_string(), x as f64)),
            (1i64..50, 2i64..9).prop_map(|(k, n)| (
                format!("cos({k}*pi/{n})"),
                (k as f64 * std::f64::consts::PI / n as f64).cos()
            )),
            (1i64..359).prop_map(|k| (format!("sin({k}deg)"), (k as f64).to_radians().sin())),
        ];
        leaf.prop_recursive(4, 24, 2, |inner| {
            prop_oneof![
                (inner.clone(), inner.clone())
                    .prop_map(|((s, a), (t, b))| (format!("({s})+({t})"), a + b)),
                (inner.clone(), inner.clone())
                    .prop_map(|((s, a), (t, b))| (format!("({s})*-({t})"), a * -b)),
                inner
                    .clone()
                    .prop_map(|(s, a)| (format!("sqrt(({s})^2+1)"), (a * a + 1.0).sqrt())),
                inner.prop_map(|(s, a)| (format!("3/(({s})^2+2)"), 3.0 / (a * a + 2.0))),
            ]
        })
    }

    proptest! {
        #[test]
        fn values_agree_with_doubles_and_survive_writing((text, value) in text()) {
            let e: Expr = text.parse().unwrap();
            prop_assert!((e.to_f64() - value).abs() <= 1e-9 * (1.0 + value.abs()), "{} vs {}", e.to_f64(), value);
            let again: Expr = e.to_string().parse().unwrap();
            prop_assert_eq!(again.to_f64(), e.to_f64());
            prop_assert_eq!(again.to_string(), e.to_string());
            prop_assert_eq!(again.as_rational(), e.as_rational());
        }

        #[test]
        fn floats_round_trip(x in any::<f64>().prop_filter("finite", |x| x.is_finite())) {
            prop_assert_eq!(Expr::from_f64(x).unwrap().to_f64(), x);
        }

        #[test]
        fn no_text_panics(text in "[0-9.e+*/^() -]{0,40}|(sqrt\\(|cos\\(|tan\\(|pi|deg|[0-9]|[-+*/^()]|e|é| ){0,24}|\\PC{0,40}") {
            let _ = text.parse::<Expr>();
        }
    }
}
