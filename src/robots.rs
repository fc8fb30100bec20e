//! Robot descriptions (URDF, MJCF, SDF) read as mechanisms, and mechanisms written for other programs.

mod build;
mod close;
mod coupling;
mod digits;
mod edit;
mod emit;
mod fix;
pub mod formats;
mod graph;
mod import;
mod kinematics;
mod light;
mod loops;
mod mimic;
mod mjcf;
mod offers;
mod options;
mod origin;
mod outputs;
mod parts;
mod physical;
mod problem;
mod sdf;
mod single_freedoms;
mod urdf;
mod warning;
mod xml;

pub use fix::fix;
pub use formats::is_description;
pub use import::{Imported, import};
pub use options::{Options, Reader};
pub use origin::{Origin, Place};
pub use problem::ExportError;
pub use warning::{Kept, Note, Report};
