//! What a two-lever gripper can hold: its arms, contacts and drive moments, and what a grip does to its mechanism.
//!
//! [`gripping::grip`] studies a gripper over its diameters; [`clamped::clamped`] solves for the joints of a mechanism round
//! a part.

pub mod arm_curves;
pub mod clamped;
pub mod clamping;
pub mod contact;
pub mod gripping;
pub mod holding;
pub mod jaw_loads;
pub mod lever_arm;
pub mod motion;
