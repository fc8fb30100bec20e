//! How far mechanisms move, and how that is known.

mod certificates;
mod exact_numbers;
mod finite_traps;
mod least_rows;
mod mobility;
mod poses;
pub(crate) mod rounded;
mod screws;
mod stroke;
mod stroke_ends;
mod stroke_poses;
