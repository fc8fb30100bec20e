//! Mobility and redundant constraints: of the whole, contour by contour, and of the clamped object; which links idle;
//! what an over-constrained assembly is stressed with.

pub mod analysis;
pub mod contour_shares;
pub mod drives;
pub mod duplicate_constraints;
pub(crate) mod external;
pub mod figures;
pub mod idle_animation;
mod joint_wrench;
pub mod local_mobility;
pub mod measured;
pub mod motion;
pub mod moved;
pub mod other_poses;
pub mod release;
pub mod stress;
pub mod stress_loads;
pub mod stressed;
pub mod with_drives_held;
pub mod working_mobility;
