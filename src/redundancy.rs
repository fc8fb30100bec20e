//! Mobility and redundant constraints: of the whole, contour by contour, and of the clamped object; which links idle;
//! what an over-constrained assembly is stressed with.

pub mod analysis;
pub mod borne;
pub mod external;
pub mod figures;
pub mod held_twice;
pub mod idle;
mod joint_wrench;
pub mod measured;
pub mod motion;
pub mod moved;
pub mod over_motion;
pub mod release;
pub mod share;
pub mod stress;
pub mod wiggle;
pub mod with_drives_held;
