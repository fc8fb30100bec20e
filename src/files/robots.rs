//! Robot descriptions (URDF, MJCF, SDF) and CAD assemblies (FreeCAD, OndselSolver) read as mechanisms, and mechanisms written for other programs.

mod additions;
mod asmt;
mod cad;
mod description;
mod edit;
mod fcstd;
mod fix;
mod foreign;
pub mod formats;
mod graph;
mod import;
mod mechanism;
mod mjcf;
mod options;
mod problem;
mod releases;
mod sdf;
mod urdf;
mod warning;
mod xml;

pub use description::origin::{ElementPlace, Origin};
pub use fix::fix;
pub use foreign::refuse as refuse_foreign;
pub use formats::{begins_description, is_description};
pub use import::{Imported, import};
pub use options::{Options, Reader};
pub use problem::ExportError;
pub use releases::releases;
pub use warning::{CadCount, Kept, Note, Report};
