//! OndselSolver's assemblies: `.asmt`.

pub(crate) mod read;
