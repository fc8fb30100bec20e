//! Charts of finished numbers, and the SVG writer that they share with the drawings.

use ozols_kernel::{format, geom};

pub mod chart;
#[doc(hidden)]
pub mod svg {
    pub mod labels;
    pub mod plane;
    pub mod text;
    pub mod xml;
}
