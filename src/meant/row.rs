//! A linear condition on points.

/// Σ coefficient · normal · point = 0, the coefficients adding up to zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Points with their coefficients.
    pub(super) terms: Vec<(usize, i32)>,
    /// Which of the normals.
    pub(super) normal: usize,
}
