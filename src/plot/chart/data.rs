//! What is drawn: finished numbers with their names.

/// Series over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What is shown.
    pub title: String,
    /// One sentence under the title, or nothing.
    pub subtitle: String,
    /// The axis across.
    pub x: Axis,
    /// The axis up.
    pub y: Axis,
    /// What is drawn, in the order of colours; up to fourteen can be told apart.
    pub series: Vec<Series>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The quantity, with its unit.
    pub label: String,
    /// How values are spaced.
    pub scale: Scale,
}

impl Axis {
    /// Returns an axis whose values are spaced evenly.
    pub fn linear(label: impl Into<String>) -> Axis {
        let (label, scale) = (label.into(), Scale::Linear);
        Axis { label, scale }
    }
}

/// How the values of an axis are spaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By decades.
    Log,
    /// By decades, and zero where ten to this would stand, which is labelled so: less than that cannot be told from it.
    LogAndZero(i32),
}

/// A named row of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The name written beside it.
    pub name: String,
    /// Pairs of x and y, in drawing order.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub style: Style,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashed,
    /// Points alone; the name stands beside the point where the series has one point.
    Points,
    /// A line that holds each y until the next x.
    Steps,
}

/// A verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VerdictKind {
    /// As it should be.
    Good,
    /// Wrong.
    Bad,
    /// Doubtful.
    Warn,
    /// No verdict.
    None,
}

impl VerdictKind {
    /// Returns the class of its colours in the style sheet.
    pub(super) fn class(self) -> &'static str {
        match self {
            VerdictKind::Good => "good",
            VerdictKind::Bad => "bad",
            VerdictKind::Warn => "warn",
            VerdictKind::None => "none",
        }
    }
}

/// A stretch of an axis: from, to, and the verdict between them.
pub type Band = (f64, f64, VerdictKind);

/// Regions of an axis, row by row: where each of several methods is right.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands {
    /// What is shown.
    pub title: String,
    /// One sentence under the title, or nothing.
    pub subtitle: String,
    /// The axis across.
    pub x: Axis,
    /// The name of each row with its bands.
    pub rows: Vec<(String, Vec<Band>)>,
}
