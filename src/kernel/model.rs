//! The mechanism: links, joints with their types and frames, named states, contours, and what a search may change.
//!
//! Values here are validated: a [`Mechanism`](mechanism::Mechanism) is connected in every state, its ids are unique, its axes are nonzero.
//! Text formats live in `import`; nothing here reads a file.

pub mod claim;
pub mod coupling;
#[cfg(test)]
pub(crate) mod drawn;
pub mod drive;
mod driven;
pub mod grip;
pub mod id;
pub mod joint_type;
pub mod loads;
pub mod mechanism;
pub mod ranking;
pub mod rounded;
