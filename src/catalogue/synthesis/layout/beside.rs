//! Places near those of a layout: whole millimetres are coarse, so that pins are often in special places by chance.

use crate::chains::Input;
use crate::synthesis::figures::{LayoutFigures, figures_at, layout_figures};
use crate::synthesis::layout::Layout;
use crate::synthesis::place::{FINE, Place};
use crate::synthesis::random_of;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::stroke::judge::Judge;
use crate::synthesis::structure::Structure;
use chacha20::rand_core::Rng;

/// Returns the layout with its pins moved by less than half a millimetre each, to thousandths, and its figures. A greater number gives smaller
/// moves. The result is the same for the same seed and number. Pins keep the rules of the structure: sliding pins stay on their line, and images stay
/// images.
///
/// `None` if the new layout breaks the limits, loses the task that the old one fulfils, or loses its assignment of layers.
///
/// # Complexity
/// At most twice that of the figures of a stroke.
#[must_use]
pub(crate) fn nearby_layout(
    structure: &Structure,
    layout: &Layout,
    seed: u64,
    number: u32,
) -> Option<(Layout, LayoutFigures)> {
    let mut random = random_of(&format!("{} {seed} beside {number}", structure.name()));
    // Layouts at the very edge of a limit lose the task by large moves. From -499 to 499 at first, from -15 to 15 at last.
    let reach = (FINE / 2 - 1) >> (number / 4).min(5);
    let range = 2 * reach.cast_unsigned() + 1;
    let mut off = || (random.next_u32() % range).cast_signed() - reach;
    let sketch = Sketch::new(structure, layout.rules.clone(), layout.limits);
    let slides = structure.drive_input() == Input::Slide;
    let mut at = layout.at.clone();
    let movable = sketch.movable.iter().copied();
    for pin in movable.filter(|&pin| pin != sketch.input || !slides) {
        let place = layout.rules.exact_place(&layout.at.points, pin);
        let fine = [off(), off()];
        at.points[pin] = Place { fine, ..place }.real();
    }
    layout.rules.settle_joints(&mut at);
    for pin in 0..layout.rules.joints.len() {
        at.points[pin] = layout.rules.exact_place(&at.points, pin).real();
    }
    let mut judge = Judge::new(&sketch);
    let looks = judge.drawn_figures(&at)?;
    let moved = Layout {
        at,
        looks,
        ..layout.clone()
    };
    let now = figures_at(&mut judge, &moved.at)?;
    let (does, passes) = (now.shortfall.is_none(), now.stacking.is_known());
    // Faults that the original layout has are accepted.
    let no_less = || {
        layout_figures(structure, layout).is_some_and(|before| {
            (does || before.shortfall.is_some()) && (passes || !before.stacking.is_known())
        })
    };
    let kept = moved.looks.keep_limits(&moved.limits, passes) && (does && passes || no_less());
    kept.then_some((moved, now))
}
