//! What a two-lever gripper can hold: its arms, contacts and drive moments, what a grip does to its mechanism, and how firmly the
//! contacts of any clamped mechanism hold the part.
//!
//! [`gripping::grip`] studies a gripper over its diameters; [`clamped::clamped`] solves for the joints of a mechanism round
//! a part; [`force_closure::closure`] asks what its contacts resist.

pub mod arm_curves;
pub mod clamped;
pub mod clamped_part;
pub mod clamping;
pub mod contact;
pub mod faces;
pub mod force_closure;
pub mod gripping;
pub mod holding;
pub mod jaw_loads;
pub mod lever_arm;
pub mod motion;
mod resisted_load;
pub mod tolerance_samples;
