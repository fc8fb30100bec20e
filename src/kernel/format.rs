//! Numbers, phrases and tables as text, for everything that writes for people or for other programs.
//!
//! Every measured figure has one of these styles:
//!
//! | style | digits | 1234.5678 | 2 | 0.00001 | for |
//! |---|---|---|---|---|---|
//! | [`four_digits`] | at most 4 | 1235 | 2 | 1e-5 | sentences and tables |
//! | [`five_digits`] | 5, the same in every row | 1234.6 | 2.0000 | 1.0000e-5 | columns of forces |
//! | [`three_digits`] | 3 | 1235 | 2.00 | 1.00e-5 | a difference mentioned briefly |
//! | [`two_digits`] | at most 2 | 1235 | 2 | 1e−5 | tolerances and noise in captions |
//! | [`six_digits`] | at most 6 | 1234.57 | 2 | 1e−5 | points of a chart |
//! | [`decimals`] | to a given decimal | 1234.57 | 2 | 0 | coordinates |
//!
//! Whole numbers that may be large use [`group_thousands`], costs use [`format_cost`], and times use [`format_duration`].

pub mod csv;
pub mod did_you_mean;
pub mod plain;

use std::fmt::Display;
use std::ops::Range;

/// Formats a count with its noun: "1 redundant constraint", "2 redundant constraints".
pub fn count_noun(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// Formats a count that is already text with its noun: "1 variant", "25,761,436 variants".
pub fn plural_of(n: &str, what: &str) -> String {
    format!("{n} {what}{}", if n == "1" { "" } else { "s" })
}

/// Formats a list of alternatives: "a, b or c".
pub fn join_or<'a>(of: impl IntoIterator<Item = &'a str>) -> String {
    let mut all: Vec<&str> = of.into_iter().collect();
    match (all.pop(), all.is_empty()) {
        (Some(last), false) => format!("{} or {last}", all.join(", ")),
        (last, _) => last.unwrap_or_default().to_owned(),
    }
}

/// Formats a list: "a", "a and b", "a, b and c".
pub fn join_and<T: AsRef<str>>(of: &[T]) -> String {
    match of {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [most @ .., last] => {
            let most: Vec<&str> = most.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", most.join(", "), last.as_ref())
        }
    }
}

/// Formats the first `most` items of a list and the number of further items: "a, b and 3 more".
pub fn first_of(all: &[impl Display], most: usize) -> String {
    let shown: Vec<String> = all.iter().take(most).map(ToString::to_string).collect();
    let more = match all.len().saturating_sub(most) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    shown.join(", ") + &more
}

/// Formats a number of any size with these significant digits. Those whose first digit has one of the `plain` powers of
/// ten have no exponent. Trailing zeros are kept if the number is `padded`.
fn format_styled(x: f64, digits: i32, plain: Range<i32>, padded: bool) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{x:.0$e}", digits.max(1) as usize - 1);
    let Some((mantissa, power)) = text.split_once('e') else {
        return text;
    };
    let trim = |text| if padded { text } else { trim_zeros(text) };
    match power.parse() {
        Ok(power) if plain.contains(&power) => {
            let decimals = (digits - 1 - power).max(0) as usize;
            trim(&format!("{x:.decimals$}")).to_owned()
        }
        _ => format!("{}e{power}", trim(mantissa)),
    }
}

/// Removes the trailing zeros of a decimal.
fn trim_zeros(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// Formats a measured number to four significant digits: 12.35, 0.001235, 1.235e-7. Rounding noise is written as 0.
pub fn four_digits(x: f64) -> String {
    format_styled(if x.abs() < 1e-9 { 0.0 } else { x }, 4, -4..7, false)
}

/// Formats a value of a column with five significant figures, or a dash if there is none.
pub fn five_digits(x: f64) -> String {
    if !x.is_finite() {
        return "-".to_owned();
    }
    format_styled(x, 5, -4..7, true)
}

/// Formats a number mentioned briefly, with three figures.
pub fn three_digits(x: f64) -> String {
    format_styled(x, 3, -3..6, true)
}

/// Formats a power of ten or a short decimal, with a true minus: 1e−9, 3.2e−10, 1.
pub fn two_digits(x: f64) -> String {
    with_minus_sign(&format_styled(x, 2, -2..4, false))
}

/// Formats a value to six digits, with a true minus.
pub fn six_digits(x: f64) -> String {
    with_minus_sign(&format_styled(x, 6, -4..6, false))
}

/// Rounds a figure to `digits` digits, for files whose bytes must not depend on the last bits.
pub fn round_digits(x: f64, digits: i32) -> f64 {
    format_styled(x, digits, -4..6, false).parse().unwrap_or(x)
}

/// Formats a number with at most `most` decimals, without trailing zeros and without a negative zero.
pub fn decimals(x: f64, most: usize) -> String {
    let text = format!("{x:.most$}");
    match trim_zeros(&text) {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}

/// Formats a whole number in groups of three: 13,841,287,201.
pub fn group_thousands(number: impl ToString) -> String {
    let number = number.to_string();
    let first = usize::from(number.starts_with('-'));
    let mut out = String::new();
    for (i, digit) in number.char_indices() {
        if i > first && (number.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// Formats a cost in thousandths as a decimal: 11.5.
pub fn format_cost(milli: i64) -> String {
    let (sign, size) = (if milli < 0 { "-" } else { "" }, milli.unsigned_abs());
    let text = format!("{sign}{}.{:03}", size / 1000, size % 1000);
    trim_zeros(&text).to_owned()
}

/// Formats a time in a suitable unit: 4.2 µs, 30 h.
pub fn format_duration(seconds: f64) -> String {
    const HOUR: f64 = 3600.0;
    let (value, unit) = match seconds {
        s if s < 1e-6 => (s * 1e9, "ns"),
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s if s < 120.0 => (s, "s"),
        s if s < 2.0 * HOUR => (s / 60.0, "min"),
        s if s < 48.0 * HOUR => (s / HOUR, "h"),
        s if s < 17_532.0 * HOUR => (s / (24.0 * HOUR), "days"),
        s => (s / (8766.0 * HOUR), "years"),
    };
    let decimals = usize::from(value < 9.95);
    format!("{value:.decimals$} {unit}")
}

/// Replaces the minus in a number's text by a true minus sign.
pub fn with_minus_sign(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_end_with_and() {
        assert_eq!(join_and(&["a", "b", "c"]), "a, b and c");
        assert_eq!(join_and(&["a"]), "a");
        assert_eq!(
            count_noun(1, "way") + ", " + &count_noun(2, "way"),
            "1 way, 2 ways"
        );
    }

    #[test]
    fn long_times_are_told_as_people_do() {
        let told = [4.2e-6, 0.5, 119.0, 7000.0, 90_000.0, 8.6e5, 8e7].map(format_duration);
        let said = [
            "4.2 µs",
            "500 ms",
            "119 s",
            "117 min",
            "25 h",
            "10 days",
            "2.5 years",
        ];
        assert_eq!(told, said);
    }

    #[test]
    fn every_style_is_as_its_table_says() {
        type Style = fn(f64) -> String;
        let styles: [(Style, [&str; 6]); 5] = [
            (four_digits, ["1235", "2", "1e-5", "1.235e7", "-0.25", "0"]),
            (
                five_digits,
                ["1234.6", "2.0000", "1.0000e-5", "1.2346e7", "-0.25000", "0"],
            ),
            (
                three_digits,
                ["1235", "2.00", "1.00e-5", "1.23e7", "-0.250", "0"],
            ),
            (two_digits, ["1235", "2", "1e−5", "1.2e7", "−0.25", "0"]),
            (
                six_digits,
                ["1234.57", "2", "1e−5", "1.23457e7", "−0.25", "0"],
            ),
        ];
        for (style, expected) in styles {
            let values = [1234.5678, 2.0, 0.000_01, 12_345_678.0, -0.25, -0.0];
            assert_eq!(values.map(style), expected);
        }
        assert_eq!(
            [1234.5678, 2.0, -0.000_01].map(|x| decimals(x, 2)),
            ["1234.57", "2", "0"]
        );
    }

    #[test]
    fn digits_are_counted_after_rounding_and_nothing_is_no_number() {
        assert_eq!(five_digits(9.999_99), "10.000");
        assert_eq!(four_digits(1e-12), "0");
        assert_eq!(
            [f64::NAN, f64::INFINITY].map(five_digits),
            ["-".to_owned(), "-".to_owned()]
        );
        assert_eq!(six_digits(f64::NEG_INFINITY), "−inf");
    }

    #[test]
    fn whole_numbers_costs_and_times_read_well() {
        assert_eq!(group_thousands("13841287201"), "13,841,287,201");
        assert_eq!(
            ["-123", "-1234", "999"].map(group_thousands),
            ["-123", "-1,234", "999"]
        );
        assert_eq!(
            [11_500, -2_000, 7].map(format_cost),
            ["11.5", "-2", "0.007"]
        );
        assert_eq!([4.21e-6, 0.0123].map(format_duration), ["4.2 µs", "12 ms"]);
    }
}
