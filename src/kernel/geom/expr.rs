//! Coordinates as the designer writes them, kept exact.
//!
//! An [`Expr`] is a tree over rationals, square roots and cosines of rational angles. Every node carries a rigorous
//! 256-bit enclosure of its value, so that signs, and an `f64` that survives cancellation, cost nothing extra.
//!
//! π is in none of the fields that these span. If a pitch needs it, it is replaced by its first [`PI_DIGITS`] decimals,
//! the same everywhere, so that ratios of pitches are exact. [`Expr::has_pi`] detects this, and results that depend on
//! it are not called exact.

mod enclosure;
mod error;
mod node;
mod operators;
mod parse;
mod rational;
mod write;
mod written;

pub use error::ExprError;
pub use node::Expr;
pub use node::{Digits, End, WrittenNumber};
pub(crate) use node::{Function, NodeKind};
pub use parse::WORDS;
pub use parse::{MAX_ANGLE_DENOMINATOR, MAX_EXPONENT, MAX_NESTING, MAX_POWER, MAX_TEXT};
pub use rational::PI_DIGITS;
use rational::{MAX_BITS, bit_size, rational_from_decimal};
pub(crate) use rational::{PI, rational_sqrt};
pub use written::half_of;

use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::collections::HashSet;
use std::sync::Arc;

impl Expr {
    /// Creates the expression of a rational number. O(1).
    #[must_use]
    pub fn rational(value: BigRational) -> Expr {
        Expr::new(NodeKind::Rational(value))
    }

    /// Converts the shortest decimal that reads back as `x`, taken exactly: `0.1` is one tenth, as the designer
    /// intended. It has that decimal's [`half_unit`](Expr::half_unit); a whole number has none.
    ///
    /// # Errors
    /// Returns [`ExprError::NonFiniteFloat`] for infinities and NaN.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// // One tenth, as the designer intended, and not the nearest double.
    /// assert!(Expr::from_f64(0.1)?.is_same(&"1/10".parse()?));
    /// assert!(Expr::from_f64(f64::NAN).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
        let value = rational_from_decimal(whole, fraction, exponent).ok_or_else(bad)?;
        let value = Expr::rational(if x < 0.0 { -value } else { value });
        let places = i64::try_from(fraction.len()).unwrap_or(i64::MAX) - exponent;
        let digits = (places > 0).then(|| Digits::from_decimal(whole, fraction, exponent, true));
        let written = digits
            .flatten()
            .map_or(WrittenNumber::No, WrittenNumber::Decimal);
        Ok(value.written_as(written))
    }

    /// Returns the nearest double, right to the last bit or nearly so even after cancellation. Values that vanish to
    /// all 256 bits give 0, and those beyond the range of `f64` an infinity. O(1).
    ///
    /// # Examples
    /// ```
    /// let x: ozols::geom::expr::Expr = "sqrt(3)/2".parse().unwrap();
    /// assert!((x.to_f64() - 0.866_025_4).abs() < 1e-7);
    /// ```
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        self.0.enclosure.to_f64()
    }

    /// Returns the rational that this expression was folded to, if any. O(size of the number).
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// let folded = "1/2 + 0.25".parse::<Expr>()?.as_rational();
    /// assert_eq!(folded.map(|r| r.to_string()).as_deref(), Some("3/4"));
    /// assert!("sqrt(2)".parse::<Expr>()?.as_rational().is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn as_rational(&self) -> Option<BigRational> {
        self.rational_ref().cloned()
    }

    /// Returns π to [`PI_DIGITS`] decimals.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// assert!((Expr::pi().to_f64() - std::f64::consts::PI).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn pi() -> Expr {
        Expr::new(NodeKind::Pi)
    }

    /// Returns true if the expression contains π as decimals.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// // Half a turn in an angle is exact; π as a number is not.
    /// assert!(!"cos(pi/5)".parse::<Expr>()?.has_pi());
    /// assert!(Expr::pi().has_pi());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn has_pi(&self) -> bool {
        let leaf = |e: &&Expr| matches!(e.kind(), NodeKind::Pi);
        self.rational_ref().is_none() && self.post_order().iter().any(leaf)
    }

    /// Returns true if the expression was folded to the rational 0. O(1).
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// assert!("3/4 - 0.75".parse::<Expr>()?.is_zero_rational());
    /// assert!(!"1e-30".parse::<Expr>()?.is_zero_rational());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn is_zero_rational(&self) -> bool {
        self.rational_ref().is_some_and(Zero::is_zero)
    }

    /// Returns true if two expressions are identical, or the same rational; `false` decides nothing. O(1).
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// let half: Expr = "0.5".parse()?;
    /// assert!(half.is_same(&"1/2".parse()?));
    /// assert!(!half.is_same(&"0.500001".parse()?));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_same(&self, other: &Expr) -> bool {
        let rationals = (self.rational_ref(), other.rational_ref());
        Arc::ptr_eq(&self.0, &other.0) || matches!(rationals, (Some(a), Some(b)) if a == b)
    }

    pub(crate) fn rational_ref(&self) -> Option<&BigRational> {
        match &self.0.kind {
            NodeKind::Rational(r) => Some(r),
            _ => None,
        }
    }

    pub(crate) fn kind(&self) -> &NodeKind {
        &self.0.kind
    }

    /// Returns an identifier of the shared node, for memo tables that live no longer than the expression.
    pub(crate) fn id(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// Returns every distinct node once, children before parents. This is iterative because trees built in loops are
    /// deep.
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

    /// Returns the square root, or `None` for a negative number.
    pub(crate) fn sqrt(&self) -> Option<Expr> {
        if self.0.enclosure.hi.is_negative() {
            return None;
        }
        if let Some(r) = self.rational_ref()
            && let Some(s) = rational_sqrt(r)
        {
            return Some(Expr::rational(s));
        }
        Some(Expr::new(NodeKind::Sqrt(self.clone())))
    }

    /// Returns the quotient, or `None` if the divisor cannot be distinguished from zero.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// let third = Expr::from(1).div(&Expr::from(3));
    /// assert!(third.is_some_and(|x| x.to_f64() == 1.0 / 3.0));
    /// assert!(Expr::from(1).div(&Expr::from(0)).is_none());
    /// ```
    pub fn div(&self, other: &Expr) -> Option<Expr> {
        if other.0.enclosure.has_zero() {
            return None;
        }
        if let (Some(a), Some(b)) = (self.rational_ref(), other.rational_ref())
            && bit_size(a) + bit_size(b) <= MAX_BITS
        {
            return Some(Expr::rational(a / b));
        }
        if self.is_zero_rational() || other.rational_ref().is_some_and(One::is_one) {
            return Some(self.clone());
        }
        Some(Expr::new(NodeKind::Div(self.clone(), other.clone())))
    }

    /// Returns the function of `k/n` turns (any integer `k`, `n > 0`), or `None` at a pole.
    pub(crate) fn trig_of_turns(function: Function, k: u64, n: u64) -> Option<Expr> {
        let n = n.max(1);
        let g = (k % n).gcd(&n);
        let (k, n) = (k % n / g, n / g);
        let int = |x: i64| Some(Expr::from(x));
        // By Niven's theorem these are all rational values.
        match (function, k, n) {
            (Function::Cos, 0, 1) => int(1),
            (Function::Cos, _, 2) => int(-1),
            (Function::Cos, _, 4) | (Function::Sin, _, 1 | 2) | (Function::Tan, _, 1 | 2) => int(0),
            (Function::Cos, _, 3) => Some(Expr::rational(BigRational::new((-1).into(), 2.into()))),
            (Function::Cos, _, 6) => Some(Expr::rational(BigRational::new(1.into(), 2.into()))),
            (Function::Sin, k, 4) => int(if k == 1 { 1 } else { -1 }),
            (Function::Sin, k, 12) => {
                let sign = if k < 6 { 1 } else { -1 };
                // k = 1, 5 is 30deg, 150deg; 7, 11 are opposite.
                Some(Expr::rational(BigRational::new(sign.into(), 2.into())))
            }
            (Function::Tan, _, 4) => None,
            (Function::Tan, k, 8) => int(if k % 4 == 1 { 1 } else { -1 }),
            _ => Some(Expr::new(NodeKind::Trig(function, k, n))),
        }
    }

    fn fold_rationals(
        a: &Expr,
        b: &Expr,
        fold: impl Fn(&BigRational, &BigRational) -> BigRational,
    ) -> Option<Expr> {
        let (x, y) = (a.rational_ref()?, b.rational_ref()?);
        (bit_size(x) + bit_size(y) <= MAX_BITS).then(|| Expr::rational(fold(x, y)))
    }
}

impl From<i64> for Expr {
    fn from(x: i64) -> Expr {
        Expr::rational(BigRational::from_integer(x.into()))
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

    /// Returns a text, its value in doubles, and the size to which the error of that value is relative. Terms that
    /// cancel leave their errors.
    fn text() -> impl Strategy<Value = (String, f64, f64)> {
        let leaf = prop_oneof![
            (1i64..50).prop_map(|x| (x.to_string(), x as f64)),
            (1i64..50, 2i64..9).prop_map(|(k, n)| (
                format!("cos({k}*pi/{n})"),
                (k as f64 * std::f64::consts::PI / n as f64).cos()
            )),
            (1i64..359).prop_map(|k| (format!("sin({k}deg)"), (k as f64).to_radians().sin())),
        ]
        .prop_map(|(text, value)| (text, value, 1.0 + value.abs()));
        leaf.prop_recursive(4, 24, 2, |inner| {
            prop_oneof![
                (inner.clone(), inner.clone()).prop_map(|((s, a, k), (t, b, l))| (
                    format!("({s})+({t})"),
                    a + b,
                    k + l
                )),
                (inner.clone(), inner.clone()).prop_map(|((s, a, k), (t, b, l))| (
                    format!("({s})*-({t})"),
                    a * -b,
                    k * l
                )),
                inner.clone().prop_map(|(s, a, k)| (
                    format!("sqrt(({s})^2+1)"),
                    (a * a + 1.0).sqrt(),
                    k
                )),
                inner.prop_map(|(s, a, k)| (
                    format!("3/(({s})^2+2)"),
                    3.0 / (a * a + 2.0),
                    2.0 * k
                )),
            ]
        })
    }

    proptest! {
        #[test]
        fn values_agree_with_doubles_and_survive_writing((text, value, size) in text()) {
            let e: Expr = text.parse().unwrap();
            prop_assert!((e.to_f64() - value).abs() <= 1e-12 * size, "{} vs {}", e.to_f64(), value);
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
