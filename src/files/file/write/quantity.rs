//! Numbers in the units of a file, such that they read back as the very numbers they were.

use crate::file::schema::Coordinate;

/// The shortest decimal that times `unit` is `value`.
fn shortest(value: f64, unit: f64) -> Option<f64> {
    let near = value / unit;
    // A product rounds, so a quotient may be off by a digit in the last place.
    let digits = (0..17).filter_map(|n| format!("{near:.n$e}").parse::<f64>().ok());
    let beside = [near, near.next_up(), near.next_down()];
    // Equal to the last bit, or it is not the same number.
    digits
        .chain(beside)
        .find(|x| (x * unit).to_bits() == value.to_bits())
}

/// A value in SI units, in a file whose unit is `unit` of it.
pub(crate) fn number(value: f64, unit: f64) -> Coordinate {
    plain(shortest(value, unit).unwrap_or(value / unit))
}

/// Three of them.
pub(crate) fn numbers(values: [f64; 3], unit: f64) -> [Coordinate; 3] {
    values.map(|x| number(x, unit))
}

/// An angle: in degrees where that is exact, else in radians.
pub(crate) fn angle(radians: f64) -> Coordinate {
    match shortest(radians, 1f64.to_radians()) {
        Some(degrees) => plain(degrees),
        None => Coordinate::Expression(format!("{radians}rad")),
    }
}

/// A number as people write it.
fn plain(x: f64) -> Coordinate {
    #[allow(clippy::cast_possible_truncation, reason = "whole and within 2^53")]
    if x.fract() == 0.0 && x.abs() < 2f64.powi(53) {
        return Coordinate::Integer(x as i64);
    }
    Coordinate::Decimal(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn value(c: &Coordinate) -> f64 {
        match c {
            #[allow(clippy::cast_precision_loss, reason = "whole and within 2^53")]
            Coordinate::Integer(x) => *x as f64,
            Coordinate::Decimal(x) => *x,
            Coordinate::Expression(t) => t.trim_end_matches("rad").parse().unwrap(),
        }
    }

    #[test]
    fn what_people_write_comes_back() {
        for (x, unit) in [(40.0, 1e-3), (0.1, 1e-3), (23.09, 0.0254), (7.0, 1.0)] {
            assert_eq!(value(&number(x * unit, unit)), x);
        }
        for x in [120.0, 30.5, 0.0, 33.3] {
            assert_eq!(value(&angle(f64::to_radians(1.0) * x)), x);
        }
    }

    proptest! {
        #[test]
        fn numbers_read_back_exactly(x in -1e6..1e6f64, unit in prop::sample::select(vec![1.0, 1e-2, 1e-3, 1e-6, 0.0254])) {
            let value_si = x * unit;
            prop_assert_eq!(value(&number(value_si, unit)) * unit, value_si);
        }

        #[test]
        fn angles_read_back_exactly(x in 0.0..7.0f64) {
            let read = match angle(x) {
                Coordinate::Expression(t) => t.trim_end_matches("rad").parse::<f64>().unwrap(),
                c => value(&c) * 1f64.to_radians(),
            };
            prop_assert_eq!(read, x);
        }
    }
}
