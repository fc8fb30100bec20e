//! Assemblies of CAD programs: parts placed by the file, and joints that say what of two frames must meet.

pub(crate) mod archive;
pub(crate) mod assembly;
mod coupled;
pub(crate) mod holds;
mod meet;
pub(crate) mod outline;
pub(crate) mod retype;
