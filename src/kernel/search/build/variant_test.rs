//! Whether single variants reach what is missing, by one rank each, without a diagram.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Field;
use crate::search::build::self_stress::space;
use crate::search::question::Question;
use crate::search::reduce::plane_split::Model;
use crate::search::reduce::self_stress_space::SelfStressSpace;

/// What variants of the free state are tested by.
pub(in crate::search) struct VariantTest {
    order: Vec<usize>,
    field: Field,
    pub(in crate::search) space: SelfStressSpace,
}

impl VariantTest {
    /// For the variables in an order; none where a choice lacks a motion of its present joint.
    pub(in crate::search) fn new(
        question: &Question,
        model: &Model,
        order: &[usize],
        keep_output: bool,
    ) -> Option<VariantTest> {
        Some(VariantTest {
            order: order.to_vec(),
            field: question.exact.field(),
            space: space(question, model, order, keep_output)?,
        })
    }

    /// Whether a variant has no redundant constraints but those that all have, and moves kept links as they move now.
    ///
    /// # Complexity
    /// O(n · s²) field operations for n added freedoms and s self-stresses.
    pub(in crate::search) fn passes(&self, choices: &[usize]) -> bool {
        let space = &self.space;
        let (contours, width) = (space.contours[0], space.contours[0] + space.kept);
        let mut whole = Echelon::new(self.field);
        for (t, &variable) in self.order.iter().enumerate() {
            for vector in &space.added[t][choices[variable]] {
                let mut row = vec![0; width - vector.len()];
                row.extend_from_slice(vector);
                whole.insert(&row);
            }
        }
        let pivots = whole.pivots();
        pivots.len() == contours && pivots.iter().all(|&p| p < contours)
    }
}
