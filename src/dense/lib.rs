//! Dense matrices in floating point: a matrix type, and its decompositions as simple functions.
//!
//! The decompositions come from faer, which is generic: each crate that calls it compiles the functions again, in each
//! of its builds. Here they are compiled once, so `ozols` itself compiles quickly.

mod decompose;
mod matrix;

pub use decompose::{
    Format, Svd, determinant, least_squares, least_squares_pivoted, singular_values, solve,
    solve_positive, svd, symmetric_eigen, thin_svd,
};
pub use matrix::{Matrix, add_scaled, difference, dot, largest_entry, norm};
