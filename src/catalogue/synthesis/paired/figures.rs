//! What a laid-out paired gripper does over its stroke.

use crate::synthesis::figures::{LayoutFigures, of_stroke};
use crate::synthesis::paired::forces::PairMotion;
use crate::synthesis::paired::layout::PairLayout;
use crate::synthesis::paired::sketch::PairSketch;
use crate::synthesis::paired::structure::PairedStructure;
use crate::synthesis::paired::threefold::{SIDES, ThreefoldStructure};
use crate::synthesis::stroke::judge::Judge;

/// Figures of a laid-out gripper; `None` where it is drawn in a singular pose.
///
/// # Complexity
/// Some dozen poses, each of O(n³) for n links.
#[must_use]
pub fn figures(paired: &PairedStructure, layout: &PairLayout) -> Option<LayoutFigures> {
    of_sides(paired, None, layout)
}

/// Those of a gripper of three jaws.
///
/// # Complexity
/// As [`figures`].
#[must_use]
pub(crate) fn of_three(
    structure: &ThreefoldStructure,
    layout: &PairLayout,
) -> Option<LayoutFigures> {
    let two = of_sides(&structure.two, Some(structure), layout)?;
    Some(LayoutFigures {
        jaws: vec![two.jaws[0]; SIDES],
        turns: vec![two.turns[0]; SIDES],
        ..two
    })
}

fn of_sides(
    paired: &PairedStructure,
    threefold: Option<&ThreefoldStructure>,
    layout: &PairLayout,
) -> Option<LayoutFigures> {
    let rules = layout.rules.clone();
    let sketch = PairSketch::thrice(paired, threefold, rules, layout.limits);
    of_stroke(&mut Judge::of(PairMotion::new(&sketch)), &layout.at)
}
