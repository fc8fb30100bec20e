//! What a two-lever gripper can hold: its arms, contacts and drive moments, and what a grip does to its mechanism.

pub mod arm_charts;
pub mod clamping;
pub mod contact;
pub mod holding;
pub mod jaw_loads;
pub mod lever_arm;
