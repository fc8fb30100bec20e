//! Places beside those of a layout: whole millimetres are few, so that pins are often in special places by chance.

use crate::chains::layout_symmetry::Input;
use crate::synthesis::figures::figures;
use crate::synthesis::layout::Layout;
use crate::synthesis::place::{FINE, Place, Point};
use crate::synthesis::rules::Rules;
use crate::synthesis::skeleton::Skeleton;
use crate::synthesis::sketch::LayoutSketch;
use crate::synthesis::structure::Structure;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};

/// The layout with its pins moved by less than half a millimetre each, to thousandths; the same for the same seed and number.
/// `None` where it no longer keeps the limits, does not do the task that it did, or has no planes where it had. What slides stays on its
/// line.
///
/// # Complexity
/// That of the figures of a stroke, twice at most.
#[must_use]
pub(crate) fn beside(
    structure: &Structure,
    layout: &Layout,
    seed: u64,
    number: u32,
) -> Option<Layout> {
    let rules = Rules::free(structure)?;
    let digest = Sha256::digest(format!("{} {seed} beside {number}", structure.name()));
    let mut key = [0; 32];
    key.copy_from_slice(&digest);
    let mut random = ChaCha8Rng::from_seed(key);
    // From -499 to 499.
    let mut off = || (random.next_u32() % (FINE - 1).cast_unsigned()).cast_signed() + 1 - FINE / 2;
    let slides = structure.form.input == Input::Slide;
    let moved = |(pin, place): (usize, &Place)| Place {
        fine: if pin == rules.input && slides {
            place.fine
        } else {
            [off(), off()]
        },
        ..*place
    };
    let at: Vec<Place> = layout.at.iter().enumerate().map(moved).collect();
    let points: Vec<Point> = at.iter().chain(&layout.tips).map(|p| p.real()).collect();
    let looks = Skeleton::new(structure, rules, layout.limits).looks(&points)?;
    let moved = Layout {
        at,
        looks,
        ..layout.clone()
    };
    let now = figures(structure, &moved)?;
    let (does, passes) = (now.shortfall.is_none(), now.stacking.is_known());
    // What it does not it may not have done before.
    let no_less = || {
        figures(structure, layout).is_some_and(|before| {
            (does || before.shortfall.is_some()) && (passes || !before.stacking.is_known())
        })
    };
    let kept = moved.looks.keep(&moved.limits, passes) && (does && passes || no_less());
    kept.then_some(moved)
}
