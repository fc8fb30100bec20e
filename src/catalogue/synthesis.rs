//! Synthesis: from a kinematic chain to grippers that have a place for every joint.
//!
//! A structure is a chain with its roles, the way its driver moves, and the symmetry it is to have. A layout gives its
//! pins places in the plane: symmetric exactly, regular, moving as a gripper does, and as well proportioned as a search
//! finds. Places are whole millimetres, thousandths beside them where those are special by chance, or what a third of a turn makes
//! of whole ones.

mod annealing;
pub(crate) mod beside;
pub(crate) mod bones;
mod coordinate;
pub(crate) mod elimination;
pub mod figures;
pub mod layout;
pub mod layout_quality;
pub mod limits;
mod link_side;
pub mod mechanism;
pub mod paired;
pub(crate) mod place;
pub mod point;
mod random;
pub mod recognize;
pub mod rules;
pub(crate) mod seen_sides;
pub mod skeleton;
pub mod sketch;
pub mod stroke;
pub mod structure;
pub mod task;
mod tips;
pub(crate) mod velocities;
pub mod workload;
