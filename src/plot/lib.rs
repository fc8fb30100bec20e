//! Charts of finished numbers, and the writer of SVG that they and the drawings share.

use ozols_kernel::{format, geom};

pub mod chart;
#[doc(hidden)]
pub mod svg;
