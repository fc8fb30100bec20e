//! Charts as self-contained SVG: lines on linear or log axes, bands of verdicts, and a page that gathers them.
//!
//! The SVG is written by a helper in this crate. plotters and charts-rs fix the colours, so that one picture cannot be
//! both light and dark. poloto has no log axis. charming runs V8. None of them keeps names at line ends apart. The
//! `svg` crate puts spaces before superscripts and lets control characters through.
//!
//! Every picture has its own style sheet with a light and a dark look, and needs no script and no font file. It is byte for byte the same
//! for the same input. A point that cannot be shown is omitted and breaks its line. Such points are not finite, beyond 1e300 on a linear
//! axis, or not positive on a log axis.

mod axes;
mod axis;
mod bands;
mod data;
mod drawn;
mod frame;
mod line;
mod page;
mod polygons;

pub use data::{Axis, Band, Bands, Chart, Scale, Series, Style, VerdictKind};
pub use page::page;
pub use polygons::{Panel, PanelPair, PlanArrow, Polygons};

mod style;
#[cfg(test)]
mod tests;
