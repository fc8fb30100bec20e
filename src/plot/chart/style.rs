//! The look: style sheet, text sizes, number formats.

/// The width of a chart, in pixels.
pub(super) const WIDTH: f64 = 760.0;
/// The space around everything.
pub(super) const PAD: f64 = 20.0;
/// The minimum space between neighbouring labels.
pub(super) const GAP: f64 = 10.0;
/// The size of ticks and names.
pub(super) const TICK: f64 = 12.0;
/// The size of a raised power.
pub(super) const RAISED: f64 = 9.0;
/// Number of colours. Further series repeat them with hollow marks.
pub(super) const COLOURS: usize = 7;

/// The style sheet of every picture. It states colours directly, because many file viewers do not support CSS
/// variables.
///
/// The colours of series lie at least 0.11 apart in Oklab, both unchanged and as simulated for protanopia, deuteranopia
/// and tritanopia.
pub(super) const STYLE: &str = include_str!("chart.css");

/// Formats digits with a narrow space between thousands, from five digits on.
pub(super) fn group_thousands(digits: &str) -> String {
    let (whole, rest) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    if whole.len() < 5 {
        return digits.to_owned();
    }
    let mut out = String::new();
    for (n, c) in whole.chars().enumerate() {
        if n > 0 && (whole.len() - n).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(c);
    }
    out + rest
}
