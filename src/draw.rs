//! Drawings of a mechanism as self-contained SVG: the structural scheme, and the kinematic scheme from the coordinates.
//!
//! Both are for printing as well as for the screen: light and dark by the reader's setting, no script, no font file, the
//! same bytes for the same input. Labels never touch each other or a symbol; where there is no room beside what they
//! name, they stand farther away on a leader.

mod couplings;
mod dice;
mod graph;
mod ground;
mod initial_layout;
mod kinematic;
mod labels;
mod layout;
mod layout_penalty;
pub mod marks;
mod mirror;
mod pairs;
mod piece;
#[cfg(feature = "png")]
pub mod png;
mod projection;
mod scheme;
mod shapes;
mod sheet;
mod sight;
mod subject;
mod swap;
mod symbols;

pub use crate::svg::plane::Rect;
pub use kinematic::moving::{Moved, RATE, kinematic_along, kinematic_moving};
pub use kinematic::scene::{Scene, Shown, kinematic_scene};
pub use kinematic::{kinematic, kinematic_seen, kinematic_stressed, kinematic_with};

pub use pairs::joint_type;
pub use scheme::{scheme, scheme_with};
pub use sheet::{Drawing, Label};
pub use sight::Sight;
pub use subject::{Marks, Subject};
pub use swap::Swap;

/// How large a picture of a drawing is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Size {
    /// Pixels for each of the drawing's.
    Scale(f64),
    /// Its width in pixels.
    Width(u32),
}
