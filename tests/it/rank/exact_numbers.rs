//! Numbers written with roots and angles are exactly what they are: modulo primes, and in number fields.

use crate::common::*;
use ozols::geom::Scalars;
use ozols::geom::number_field::NumberField;

/// Expressions that are nothing: regular polygons, half angles, Gauss sums and roots of roots, as textbooks have them.
// The last but one: (3 - √5) / 4 is the square of (√5 - 1) / (2 √2).
const NOTHING: &str = "
    cos(36deg)-(1+sqrt(5))/4 cos(144deg)-(0-1-sqrt(5))/4 cos(108deg)+(sqrt(5)-1)/4
    sin(18deg)-(sqrt(5)-1)/4 sin(72deg)-sqrt(10+2*sqrt(5))/4 cos(45deg)-sqrt(2)/2
    sin(45deg)-sqrt(2)/2 sin(60deg)-sqrt(3)/2 cos(30deg)-sqrt(3)/2 cos(15deg)-(sqrt(6)+sqrt(2))/4
    sin(15deg)-(sqrt(6)-sqrt(2))/4 tan(15deg)-2+sqrt(3) cos(22.5deg)-sqrt(2+sqrt(2))/2
    sin(360deg/7)+sin(720deg/7)-sin(1080deg/7)-sqrt(7)/2 2*cos(360deg/5)-2*cos(720deg/5)-sqrt(5)
    sqrt(8)-2*sqrt(2) sqrt(72)-6*sqrt(2) sqrt(7/3)-sqrt(21)/3 sqrt(3/8)-sqrt(6)/4
    sqrt(3+2*sqrt(2))-1-sqrt(2) sqrt(3-2*sqrt(2))+1-sqrt(2)
    sqrt((1+sqrt(2))*(1+sqrt(2)))-1-sqrt(2) sqrt(1+cos(144deg))-(sqrt(5)-1)/(2*sqrt(2))
    1/(sqrt(2)-1)-sqrt(2)-1";

/// Where a sign is the other one, it is something, and in every field.
#[test]
fn what_is_nothing_and_nothing_else_vanishes_in_every_field() {
    for nothing in split_words(NOTHING) {
        for (text, vanishes) in [
            (nothing.to_owned(), true),
            (nothing.replacen('-', "+", 1), false),
        ] {
            let e: Expr = text.parse().unwrap();
            assert_eq!(
                e.to_f64().abs() < 1e-12,
                vanishes,
                "{text} is {}",
                e.to_f64()
            );
            for nth in 0..3 {
                let field = ExactField::for_expressions([&e], nth).unwrap();
                assert_eq!(
                    field.eval(&e).unwrap() == 0,
                    vanishes,
                    "{text} modulo prime {nth}"
                );
            }
            let field = NumberField::for_expressions([&e]).unwrap();
            let exact = Scalars::eval(&field, &e).unwrap();
            assert_eq!(exact.is_zero(), vanishes, "{text} in its number field");
        }
    }
}
