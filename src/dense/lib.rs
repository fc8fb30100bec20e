//! Dense matrices in floating point: a matrix, and its decompositions by plain functions.
//!
//! The decompositions are those of faer, which is generic: each crate that calls it compiles what it calls anew, in each of
//! its builds. Here that is done once, and `ozols` itself stays quick to compile.

mod decompose;
mod format;
mod matrix;

pub use decompose::{
    Svd, determinant, least_squares, least_squares_pivoted, singular_values, solve, solve_positive,
    svd, symmetric_eigen, thin_svd,
};
pub use format::Format;
pub use matrix::Matrix;
