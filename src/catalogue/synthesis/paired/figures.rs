//! What a laid-out paired gripper does over its stroke.

use crate::synthesis::figures::{LayoutFigures, of_stroke};
use crate::synthesis::paired::forces::PairMotion;
use crate::synthesis::paired::layout::PairLayout;
use crate::synthesis::paired::sketch::PairSketch;
use crate::synthesis::paired::structure::PairedStructure;
use crate::synthesis::stroke::judge::Judge;

/// Figures of a laid-out gripper; `None` where it is drawn in a singular pose.
///
/// # Complexity
/// Some dozen poses, each of O(n³) for n links.
#[must_use]
pub fn figures(paired: &PairedStructure, layout: &PairLayout) -> Option<LayoutFigures> {
    let sketch = PairSketch::new(paired, layout.rules.clone(), layout.limits);
    of_stroke(&mut Judge::of(PairMotion::new(&sketch)), &layout.at)
}
