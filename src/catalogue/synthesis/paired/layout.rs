//! A place for every joint of a paired structure, looked for from seeds that follow from its name; and what a laid-out gripper does over
//! its stroke. Well-known schemes have the forms that they are laid out in.

use crate::chains::layout_symmetry::Symmetry;
use crate::chains::pairs::classics::{Classic, classics};
use crate::chains::pairs::structure::PairStructure;
use crate::synthesis::annealing::{FoundPlaces, STARTS, best_of_starts};
use crate::synthesis::figures::{LayoutFigures, of_stroke};
use crate::synthesis::layout::NoLayout;
use crate::synthesis::layout_quality::Looks;
use crate::synthesis::paired::PairPlaces;
use crate::synthesis::paired::forces::PairMotion;
use crate::synthesis::paired::rules::{NoRules, PairRules};
use crate::synthesis::paired::sketch::PairSketch;
use crate::synthesis::paired::structure::{Lay, PairedForm, PairedStructure};
use crate::synthesis::paired::threefold::{SIDES, ThreefoldStructure};
use crate::synthesis::place::third;
use crate::synthesis::stroke::judge::Judge;
use crate::synthesis::task::Limits;
use itertools::Itertools;

/// The well-known schemes that are structures, each once.
#[must_use]
pub(crate) fn known_schemes() -> Vec<PairedStructure> {
    let all = classics().iter();
    let all = all.unique_by(|c| (c.structure.key(), c.made_as));
    let made = |c: &Classic| {
        let plain = most_symmetric(&c.structure)?;
        let others = plain.with_flat_faces().into_iter();
        let others = others.chain(plain.with_threads());
        let mut all = plain.clone().with_one_pins().chain(others);
        all.find(|p| p.made_as() == c.made_as)
    };
    all.filter_map(made).collect()
}

/// A structure in the most symmetric form in which it lies somewhere; `None` where it does so in none.
///
/// # Complexity
/// As [`PairedStructure::lays`], for each form.
#[must_use]
pub fn most_symmetric(structure: &PairStructure) -> Option<PairedStructure> {
    let symmetric = [Symmetry::Mirror, Symmetry::HalfTurn];
    let forms = [false, true].into_iter().cartesian_product(symmetric);
    let forms = forms.map(|(one_sided, symmetry)| PairedForm {
        one_sided,
        ..PairedForm::of(symmetry)
    });
    let structure = PairStructure::of_key(&structure.key());
    let mut all = forms.chain([PairedForm::of(Symmetry::Generic)]);
    let found = all.find_map(|form| {
        let structure = structure.clone();
        let paired = PairedStructure { structure, form };
        let mut lays = paired.lays().into_iter();
        lays.any(|lay| PairRules::new(&paired, &lay).is_ok())
            .then_some(paired)
    });
    found.map(PairedStructure::on_parallelograms_if_any)
}

/// A paired structure with a place for every joint.
#[derive(Debug, Clone)]
pub struct PairLayout {
    /// The joints with their rules.
    pub rules: PairRules,
    /// Their places.
    pub at: PairPlaces,
    /// The figures it was taken for.
    pub looks: Looks,
    /// What it was made for.
    pub limits: Limits,
    /// The start it was found from.
    pub start: u32,
}

/// Lays a structure out; the same for the same seed.
///
/// # Errors
/// Why there is none.
///
/// # Complexity
/// Some thousand looks at places, of which some hundred are at a whole stroke, for each of the ways it may lie on itself.
pub fn layout(
    paired: &PairedStructure,
    limits: &Limits,
    seed: u64,
) -> Result<PairLayout, NoLayout> {
    layout_as(paired, None, &paired.name(), limits, seed)
}

/// The same of a structure that may stand for three sides, under its own name.
fn layout_as(
    paired: &PairedStructure,
    threefold: Option<&ThreefoldStructure>,
    name: &str,
    limits: &Limits,
    seed: u64,
) -> Result<PairLayout, NoLayout> {
    let mut best: Option<(FoundPlaces<PairPlaces>, PairRules)> = None;
    let mut why = NoLayout::Pairs(NoRules::Still);
    let mut start = 0;
    // Three sides are those that one way of lying has.
    let suits = |lay: &Lay| threefold.is_none_or(|t| t.lay == *lay);
    for lay in paired.lays().into_iter().filter(suits) {
        let rules = match PairRules::new(paired, &lay) {
            Ok(rules) => rules,
            Err(e) => {
                why = NoLayout::Pairs(e);
                continue;
            }
        };
        why = NoLayout::NotRegular;
        let sketch = PairSketch::thrice(paired, threefold, rules, *limits);
        let mut judge = Judge::of(PairMotion::new(&sketch));
        let found = best_of_starts(&sketch, &mut judge, name, seed, start);
        start += STARTS;
        let Some(found) = found else { continue };
        let good = found.are_good(&sketch);
        if found.is_better_than(best.as_ref().map(|b| &b.0)) {
            best = Some((found, sketch.rules));
        }
        if good {
            break;
        }
    }
    let (found, rules) = best.ok_or(why)?;
    let looks = found.looks;
    if !found.within {
        return Err(NoLayout::limits(&looks));
    }
    Ok(PairLayout {
        at: found.at,
        limits: *limits,
        start: found.start,
        rules,
        looks,
    })
}

/// Lays a structure of three jaws out; the same for the same seed.
///
/// # Errors
/// Why there is none.
///
/// # Complexity
/// As [`layout`].
pub(crate) fn layout_of_three(
    structure: &ThreefoldStructure,
    limits: &Limits,
    seed: u64,
) -> Result<PairLayout, NoLayout> {
    let mut limits = *limits;
    // Sides in planes of their own meet where they come to the middle.
    limits.task.own_sides |= structure.is_axial();
    let (two, name) = (&structure.two, structure.name());
    let mut out = layout_as(two, Some(structure), &name, &limits, seed)?;
    let tip = out.looks.tips[0];
    out.looks.tips = if structure.is_axial() {
        vec![tip; SIDES]
    } else {
        vec![tip, third(tip), third(third(tip))]
    };
    Ok(out)
}

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
