//! The image of exact expressions in a prime field, under one consistent choice of roots.
//!
//! With N a multiple of 4 and of every angle's denominator (in turns), all cosines lie in Q(zeta_N). A prime `p = 1 mod
//! N` maps that field into F_p. Square roots of primes that divide N already lie in Q(zeta_N), so they have to be the
//! Gauss sums. All other square roots are independent of it, and either root in F_p is valid.
//!
//! The result is a true ring homomorphism: zero maps to zero, and a nonzero number maps to zero only for the rare
//! primes that divide its norm.
//!
//! # Sources
//! Ireland & Rosen, "A Classical Introduction to Modern Number Theory", ch. 6 (quadratic Gauss sums).

pub(crate) mod eval;
mod field;
pub(crate) mod plan;
pub(crate) mod quadratic;
pub(crate) mod radical;

pub use field::ExactField;
pub use radical::ExactError;

use self::plan::{MAX_FAILURES, PrimePlan};
use super::expr::Expr;
use crate::linalg::modp::{Field, Residue};
use std::collections::BTreeMap;

impl ExactField {
    /// Creates the homomorphism into the `nth` suitable prime field above 2^61. The same expressions give the same
    /// field, others most likely a different one.
    ///
    /// Costs O(`nth`) prime searches, each of 2^k candidates for k independent roots, and O(q) for every prime q both
    /// under a root and in an angle.
    ///
    /// # Errors
    /// Returns an [`ExactError`] if a divisor is zero, a nested root is ambiguous, or a limit on roots is exceeded.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::exact::ExactField;
    /// use ozols::geom::expr::Expr;
    /// let zero: Expr = "cos(36deg) - (1 + sqrt(5))/4".parse()?;
    /// let field = ExactField::for_expressions([&zero], 0)?;
    /// assert_eq!(field.eval(&zero)?, 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn for_expressions<'a>(
        exprs: impl IntoIterator<Item = &'a Expr>,
        nth: usize,
    ) -> Result<ExactField, ExactError> {
        let exprs: Vec<&Expr> = exprs.into_iter().collect();
        let plan = PrimePlan::new(&exprs)?;
        let (mut found, mut failures) = (0, 0);
        for field in plan.suitable_fields() {
            let mut zero = None;
            for e in &exprs {
                match field.eval(e) {
                    Ok(_) => {}
                    Err(error @ ExactError::DivisionByZero { .. }) => {
                        zero = Some(error);
                        break;
                    }
                    Err(error) => return Err(error),
                }
            }
            if let Some(error) = zero {
                failures += 1;
                if failures == MAX_FAILURES {
                    return Err(error);
                }
                continue;
            }
            if found == nth {
                return Ok(field);
            }
            found += 1;
        }
        Err(ExactError::NoPrime { nth })
    }

    /// Creates the homomorphism of the rational numbers into the field of a prime. Expressions with roots or angles
    /// have no value there.
    ///
    /// # Panics
    /// Panics in the same cases as [`Field::new`].
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::exact::ExactField;
    /// let modulo = ExactField::of_prime(101);
    /// let half = modulo.eval(&"1/2".parse()?)?;
    /// assert_eq!(modulo.field().to_u64(half), 51); // 2 · 51 = 1 modulo 101
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn of_prime(p: u64) -> ExactField {
        let field = Field::new(p);
        ExactField {
            field,
            order: 1,
            zeta: field.one(),
            roots: BTreeMap::new(),
            radicals: BTreeMap::new(),
            nested: Vec::new(),
        }
    }

    /// Returns the field of residues. O(1).
    #[must_use]
    pub fn field(&self) -> Field {
        self.field
    }

    /// Returns the image of an expression. O(nodes), each shared node once.
    ///
    /// # Errors
    /// Returns [`ExactError::NotInField`] for roots or angles beyond those the field was made for, and
    /// [`ExactError::DivisionByZero`] if a divisor vanishes in F_p.
    pub fn eval(&self, expr: &Expr) -> Result<Residue, ExactError> {
        eval::eval_in(self, expr)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(text: &str, nth: usize) -> bool {
        let e: Expr = text.parse().unwrap();
        let field = ExactField::for_expressions([&e], nth).unwrap();
        assert!((1 << 60..1 << 62).contains(&field.field().modulus()));
        field.eval(&e).unwrap() == 0
    }

    #[test]
    fn identities_vanish_and_near_misses_do_not() {
        let pairs = [
            ("cos(36deg)-(1+sqrt(5))/4", "cos(36deg)-(1-sqrt(5))/4"),
            ("sqrt(2)*sqrt(3)-sqrt(6)", "sqrt(2)*sqrt(3)+sqrt(6)"),
            ("cos(pi/8)^2-(2+sqrt(2))/4", "cos(pi/8)^2-(2-sqrt(2))/4"),
            ("sin(60deg)-sqrt(3)/2", "sin(60deg)+sqrt(3)/2"),
            ("tan(15deg)-(2-sqrt(3))", "tan(15deg)-(2+sqrt(3))"),
            ("cot(75deg)-(2-sqrt(3))", "cot(75deg)+(2-sqrt(3))"),
            ("sqrt(7)*sqrt(7)-7", "sqrt(7)*sqrt(7)+7"),
            (
                "cos(360deg/7)+cos(720deg/7)+cos(1080deg/7)+1/2",
                "cos(360deg/7)+cos(720deg/7)-cos(1080deg/7)+1/2",
            ),
            ("sqrt(3+2*sqrt(2))-1-sqrt(2)", "sqrt(3+2*sqrt(2))-1+sqrt(2)"),
            ("sqrt(3-2*sqrt(2))+1-sqrt(2)", "sqrt(3-2*sqrt(2))-1+sqrt(2)"),
            ("4*sin(18deg)+1-sqrt(5)", "4*sin(18deg)+1+sqrt(5)"),
            (
                "0*cos(360deg/7)+cos(360deg/7)*(sqrt(21)-sqrt(3)*sqrt(7))",
                "cos(360deg/7)*(sqrt(21)+sqrt(3)*sqrt(7))",
            ),
            (
                "sqrt(10-2*sqrt(5))-4*sin(36deg)",
                "sqrt(10-2*sqrt(5))+4*sin(36deg)",
            ),
            (
                "sqrt(2+sqrt(2))*sqrt(2-sqrt(2))-sqrt(2)",
                "sqrt(2+sqrt(2))*sqrt(2-sqrt(2))+sqrt(2)",
            ),
            ("sqrt(1+sqrt(3))^2-1-sqrt(3)", "sqrt(1+sqrt(3))^2-1+sqrt(3)"),
            (
                "sqrt(1+sqrt(3))-sqrt(sqrt(3)+1)",
                "sqrt(1+sqrt(3))+sqrt(sqrt(3)+1)",
            ),
            ("sqrt(0.75)-sin(120deg)", "sqrt(0.75)-sin(240deg)"),
            (
                "2*sin(360deg/7)+2*sin(720deg/7)-2*sin(1080deg/7)-sqrt(7)+4*sin(1080deg/7)*0",
                "2*sin(360deg/7)+2*sin(720deg/7)-2*sin(1080deg/7)+sqrt(7)",
            ),
        ];
        for nth in [0, 1, 5] {
            for (zero, nonzero) in pairs {
                let value = zero.parse::<Expr>().unwrap().to_f64();
                assert_eq!(
                    value == 0.0,
                    at(zero, nth),
                    "{zero}, nth {nth}, f64 {value}"
                );
                let value = nonzero.parse::<Expr>().unwrap().to_f64();
                assert!(
                    value != 0.0 && !at(nonzero, nth),
                    "{nonzero}, nth {nth}, f64 {value}"
                );
            }
        }
    }

    #[test]
    fn limits_are_errors() {
        let make = |text: &str| ExactField::for_expressions([&text.parse::<Expr>().unwrap()], 0);
        assert!(matches!(
            make("sqrt(3+sqrt(3))*sqrt(3-sqrt(3))-sqrt(6)"),
            Err(ExactError::AmbiguousNestedRoot { .. })
        ));
        assert!(make("sqrt(0.7853981633974483)+sqrt(18446744073709551557)").is_ok());
        assert!(matches!(
            make("sqrt(1234567890123456789012345678901234567891)"),
            Err(ExactError::RadicandTooLarge { .. })
        ));
        let roots: Vec<String> = (2..60).map(|q| format!("sqrt({q})")).collect();
        assert!(make(&roots.join("+")).is_ok());
        let field = make("sqrt(2)").unwrap();
        assert!(matches!(
            field.eval(&"sqrt(3)".parse().unwrap()),
            Err(ExactError::NotInField { .. })
        ));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn sums_of_products_vanish_exactly_where_the_doubles_do(
            a in -4i64..5, b in -4i64..5, c in -4i64..5, n in 3i64..13, q in 2i64..30, nth in 0usize..3,
        ) {
            // (a + b sqrt q)(c + cos) expanded, with one term off by one
            let exact: Expr = format!(
                "({a}+({b})*sqrt({q}))*({c}+cos(360deg/{n}))-(({a})*({c})+({a})*cos(360deg/{n})+({b})*({c})*sqrt({q})\
                 +({b})*sqrt({q})*cos(360deg/{n}))"
            ).parse().unwrap();
            let off = &exact + &format!("({b})*sqrt({q})-({c})*cos(360deg/{n})").parse::<Expr>().unwrap();
            let field = ExactField::for_expressions([&exact, &off], nth).unwrap();
            prop_assert_eq!(field.eval(&exact).unwrap(), 0);
            prop_assert_eq!(exact.to_f64(), 0.0);
            prop_assert_eq!(field.eval(&off).unwrap() == 0, off.to_f64() == 0.0);
        }
    }
}
