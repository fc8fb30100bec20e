//! Which ranks singular values leave open, by what rounding can have done to them.

use ozols::search::question::rounded_rank::{Digits, RankRange};

/// The ranks that values leave open, and the same of values a thousand times as large or as small: by the largest alone.
fn range(values: &[f64], tolerance: f64, undecided: bool) -> (usize, usize) {
    let digits = Digits {
        tolerance,
        undecided,
    };
    let of = |by: f64| {
        let values: Vec<f64> = values.iter().map(|v| v * by).collect();
        let r = RankRange::from_values(&values, digits);
        assert_eq!(r.is_decided(), r.least == r.most);
        (r.least, r.most)
    };
    let found = of(1.0);
    assert_eq!((of(1e3), of(1e-3)), (found, found), "{values:?}");
    found
}

/// Rounding moves a value by the tolerance at most, and a variant's by some times that.
#[test]
fn what_rounding_cannot_have_made_is_there() {
    assert_eq!(range(&[1.0, 1e-4, 0.0], 1e-5, false), (2, 2));
    // Twice the tolerance: there in the present mechanism, and perhaps not in a variant.
    assert_eq!(range(&[1.0, 2e-5, 0.0], 1e-5, false), (1, 2));
}

/// What is below the tolerance may be zero, and a wide gap says that it is: but not where it is open what the digits mean.
#[test]
fn a_wide_gap_says_what_is_zero_where_the_digits_are_known() {
    assert_eq!(range(&[2.0, 0.1, 1e-6, 3e-7], 1e-5, false), (2, 2));
    assert_eq!(range(&[2.0, 0.1, 0.002, 0.0], 0.01, false), (2, 3));
    assert_eq!(range(&[1.0, 0.5, 1e-6], 1e-5, true), (2, 3));
    assert_eq!(range(&[1.0, 0.5, 1e-6], 1e-9, true), (2, 3));
}
