//! Workload models: what a gripper must hold and what drives it. They know geometry and statics, and nothing of files,
//! searches or reports.

pub mod contact;
pub mod holding;
pub mod lever_arm;
