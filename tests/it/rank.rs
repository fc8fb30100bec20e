//! How far mechanisms move, and how that is known.

mod by_numbers;
mod certificates;
mod definite_forms;
mod exact_numbers;
mod finite_traps;
mod groups;
mod least_rows;
mod link_motion;
mod mobility;
mod poses;
mod primes;
mod releases;
pub(crate) mod rounded;
mod screws;
mod series;
mod stroke;
mod stroke_ends;
mod stroke_poses;
mod unit_of_length;
