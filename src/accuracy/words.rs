//! Numbers in sentences.

/// A time in the unit that suits it: 4.2 µs.
#[must_use]
pub fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-6 => (s * 1e9, "ns"),
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    if value < 9.95 {
        format!("{value:.1} {unit}")
    } else {
        format!("{value:.0} {unit}")
    }
}

/// A difference with its sign, a true minus: −3, +1.
#[must_use]
pub fn signed(x: i64) -> String {
    if x < 0 {
        format!("−{}", x.unsigned_abs())
    } else {
        format!("+{x}")
    }
}

/// A power of ten or a short decimal: 1e-9, 3e-10, 1.
#[must_use]
pub fn scientific(x: f64) -> String {
    if (1e-2..1e4).contains(&x) {
        return format!("{x}");
    }
    let text = format!("{x:.1e}");
    text.replace(".0e", "e").replace('-', "−")
}

/// "a", "a and b", "a, b and c".
#[must_use]
pub fn list(of: &[String]) -> String {
    match of {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(duration(4.21e-6), "4.2 µs");
        assert_eq!(duration(0.0123), "12 ms");
        assert_eq!(signed(-3), "−3");
        assert_eq!(scientific(1e-9), "1e−9");
        assert_eq!(scientific(1.0), "1");
        assert_eq!(scientific(3.2e-10), "3.2e−10");
        assert_eq!(list(&["a".into(), "b".into(), "c".into()]), "a, b and c");
    }
}
