//! Expressions for coordinates, such as `sqrt(3)/2` and `cos(36deg)`.

use super::readers::expressions::read;
use super::runs;
use crate::common::*;
use ozols::geom::expr::ExprError;

/// Found by spoiling: short as it is, it was written at a length that cannot be read.
#[test]
fn numbers_too_long_to_be_written_are_refused() {
    let long = "sqrt(3)/1e301--92101--921/1e301--921/1e301--9211---921/1e301--921/1e3";
    let said = long.parse::<Expr>().unwrap_err().to_string();
    has(&said, "1000; use numbers of fewer digits");
    read("sqrt(3)/1e301");
}

/// Expressions that are well-formed, though some have no value.
fn formed() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        (0u32..400).prop_map(|n| n.to_string()),
        (0u32..100, 1u32..1000).prop_map(|(a, b)| format!("{a}.{b}")),
        (1u32..720).prop_map(|n| format!("cos({n}deg)")),
        (1u32..12, 1u32..12).prop_map(|(k, n)| format!("tan({k}*pi/{n})")),
    ];
    leaf.prop_recursive(4, 24, 2, |inner| {
        prop_oneof![
            (
                inner.clone(),
                select(&["+", "-", "*", "/"][..]),
                inner.clone()
            )
                .prop_map(|(a, op, b)| format!("({a}{op}{b})")),
            inner.clone().prop_map(|a| format!("sqrt({a})")),
            inner.clone().prop_map(|a| format!("-{a}")),
            (inner, 0u32..5).prop_map(|(a, n)| format!("({a})^{n}")),
        ]
    })
}

/// A number too small for a double was read, and written as a fraction that is not.
#[test]
fn numbers_too_small_for_a_double_are_refused() {
    read("1e-92^9");
    assert!("1e-92^9".parse::<Expr>().is_err());
    assert!("1e-300".parse::<Expr>().is_ok());
}

/// A fraction with nothing below the line has no value, and that is said of it, however nothing is written.
#[test]
fn nothing_divides_by_zero() {
    for nothing in split_words("0 (1-1) (sqrt(2)-sqrt(2)) (cos(60deg)-1/2) sin(pi)") {
        for text in [
            format!("1/{nothing}"),
            format!("{nothing}^-1"),
            format!("{nothing}^-2"),
            format!("2*({nothing})^-3"),
        ] {
            let said = text.parse::<Expr>().unwrap_err();
            assert!(
                matches!(said, ExprError::DivisionByZero { .. }),
                "{text}: {said}"
            );
        }
        assert_eq!(
            format!("{nothing}^0").parse::<Expr>().unwrap().to_f64(),
            1.0
        );
        assert_eq!(
            format!("{nothing}^2").parse::<Expr>().unwrap().to_f64(),
            0.0
        );
    }
}

proptest! {
    #![proptest_config(runs(1024))]
    #[test]
    fn well_formed(text in formed()) {
        read(&text);
    }

    #[test]
    fn nested_far(open in select(&["(", "-", "sqrt(", "2^", "1/(", "cos("][..]), depth in 0usize..2000) {
        read(&format!("{}1{}", open.repeat(depth), ")".repeat(if open.ends_with('(') { depth } else { 0 })));
    }
}
