//! A linear condition on points.

use std::collections::BTreeMap;

/// Σ coefficient · normal · point = 0, the coefficients adding up to zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PointEquation {
    /// Points with their coefficients.
    pub(super) terms: Vec<(usize, i32)>,
    /// Which of the normals.
    pub(super) normal: usize,
}

impl PointEquation {
    /// One with the coefficients of each point added up, and without those that cancel.
    pub(super) fn sum(terms: &[(usize, i32)], normal: usize) -> PointEquation {
        let mut sum = BTreeMap::new();
        for &(point, c) in terms {
            *sum.entry(point).or_insert(0) += c;
        }
        PointEquation {
            terms: sum.into_iter().filter(|t| t.1 != 0).collect(),
            normal,
        }
    }
}
