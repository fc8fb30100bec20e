//! Scores of variants under the workload, fast and in plain ways, and bounds on them.

pub(in crate::score) mod beginnings;
mod coupled;
pub mod elimination;
pub mod evaluate;
pub mod joint_loads;
pub mod load_cases;
mod load_limits;
pub mod lower_bound;
pub(crate) mod pose_tables;
mod reference_scores;
mod solution_space;
pub mod spectrum;
pub mod terms;
