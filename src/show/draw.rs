//! Drawings of a mechanism as self-contained SVG: the structural scheme, and the kinematic scheme from the coordinates.
//!
//! Both are for print and screen: light and dark by the reader's setting, no script, no font file, the same bytes for
//! the same input. Labels never touch each other or a symbol. A label without room next to its anchor is placed farther
//! away, with a leader.

mod kinematic;
mod naming;
mod place {
    pub(super) mod graph;
    pub(super) mod initial_layout;
    pub(super) mod layout;
    pub(super) mod layout_penalty;
    pub(super) mod projection;
}
#[cfg(feature = "png")]
pub mod png;
mod prelude;
mod scheme;
mod sheet;
mod subject;
mod symbol {
    pub(crate) mod ground;
    pub(crate) mod pieces;
    pub(crate) mod placed;
    pub(crate) mod symbols;
}

pub use crate::svg::plane::Rect;
pub(crate) use kinematic::kinematic_with;
pub use kinematic::moving::{Moving, kinematic_along, kinematic_moving};
pub use kinematic::scene::{Scene, kinematic_scene};
pub use kinematic::{kinematic, kinematic_seen};

pub use place::projection::Sight;
pub use scheme::scheme;
pub use sheet::STYLE as SHEET_STYLE;
pub use sheet::{Drawing, Label};
pub use subject::{Marks, Subject};
pub use symbol::placed::Swap;
pub use symbol::symbols::joint_symbol;
