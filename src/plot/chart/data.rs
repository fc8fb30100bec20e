//! The data of a chart: finished numbers with their names.

use crate::format;

/// Series over two axes.
///
/// # Examples
/// ```
/// use ozols::chart::{Axis, Chart, Series, Style};
/// let points = vec![(0.0, 0.0), (1.0, 1.0), (2.0, 4.0)];
/// let chart = Chart {
///     title: "Squares".into(),
///     subtitle: String::new(),
///     x: Axis::linear("x"),
///     y: Axis::linear("y"),
///     series: vec![Series { name: "x²".into(), points, style: Style::Line }],
/// };
/// assert!(chart.svg().starts_with("<svg") && chart.svg().contains("Squares"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// The title.
    pub title: String,
    /// One sentence under the title, or empty.
    pub subtitle: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The series, in the order of colours; up to fourteen can be distinguished.
    pub series: Vec<Series>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The quantity, with its unit.
    pub label: String,
    /// Spacing of the values.
    pub scale: Scale,
}

impl Axis {
    /// Returns an axis whose values are spaced evenly.
    ///
    /// # Examples
    /// ```
    /// use ozols::chart::{Axis, Scale};
    /// assert_eq!(Axis::linear("force, N").scale, Scale::Linear);
    /// ```
    pub fn linear(label: impl Into<String>) -> Axis {
        let (label, scale) = (label.into(), Scale::Linear);
        Axis { label, scale }
    }
}

/// Spacing of the values of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By decades.
    Log,
    /// By decades, with zero at the position of ten to this power, labelled 0. Smaller values cannot be distinguished
    /// from it.
    LogAndZero(i32),
}

/// A named row of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The name written next to it.
    pub name: String,
    /// Pairs of x and y, in drawing order.
    pub points: Vec<(f64, f64)>,
    /// Style of drawing.
    pub style: Style,
}

/// Style of drawing of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashed,
    /// Points only. If the series has one point, the name is next to it.
    Points,
    /// A line that holds each y until the next x.
    Steps,
}

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
    format::group_thousands(whole).replace(',', "\u{202f}") + rest
}
