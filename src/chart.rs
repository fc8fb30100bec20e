//! Charts as self-contained SVG: lines on linear or log axes, verdict matrices, bands, and a page that gathers them.
//!
//! The SVG is written by a helper of our own ([`xml`]), since the charting crates looked at (plotters, charming, poloto,
//! charts-rs) fix colours in attributes or need a JavaScript engine, and none gives decades, gaps, tooltips, labels that
//! keep apart and light and dark looks at once; the `svg` crate puts spaces before superscripts and lets control
//! characters through.
//!
//! Every picture carries its own style sheet with a light and a dark look, needs no script and no font file, and comes
//! out byte for byte the same for the same input. A point that cannot be shown (not finite, beyond 1e300 on a linear
//! axis, not positive on a log axis) is left out and breaks its line.

mod axis;
mod drawn;
mod frame;
mod labels;
mod line;
mod look;
mod xml;

#[cfg(test)]
mod tests;

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

/// How the values of an axis are spaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By decades.
    Log,
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
