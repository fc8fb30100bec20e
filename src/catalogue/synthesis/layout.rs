//! Layouts: a place for every joint of a structure, searched from seeds that follow from its name. Moves go to whole millimetres, so the
//! places found are exact. Well-known schemes are laid out in their most symmetric forms.

mod annealing;
pub(crate) mod beside;

use crate::chains::Symmetry;
use crate::chains::classics::{Classic, known_classics};
use crate::chains::layout_symmetry::NoGripper;
use crate::chains::structure::PairStructure;
use crate::synthesis::layout::annealing::{FoundPlaces, STARTS, best_of_starts};
use crate::synthesis::place::{Place, third};
use crate::synthesis::places::Places;
use crate::synthesis::rules::{NoRules, Rules};
use crate::synthesis::sketch::Sketch;
use crate::synthesis::sketch::layout_quality::Looks;
use crate::synthesis::stroke::judge::Judge;
use crate::synthesis::structure::threefold::SIDES;
use crate::synthesis::structure::{Form, Structure};
use crate::synthesis::task::Limits;
use itertools::Itertools;
use thiserror::Error;

/// Returns the well-known schemes as structures. Schemes with the same structure that are made in the same way are listed once.
#[must_use]
pub(crate) fn known_schemes() -> Vec<Structure> {
    let all = known_classics().iter();
    let all = all.unique_by(|c| (c.structure.canonical_key(), c.made_as));
    let made = |c: &Classic| {
        let plain = most_symmetric(&c.structure)?;
        let others = plain.with_flat_faces().into_iter();
        let others = others.chain(plain.with_threads());
        let mut all = plain.clone().with_one_pins().chain(others);
        all.find(|p| p.made_as() == c.made_as)
    };
    all.filter_map(made).collect()
}

/// Returns a structure in the most symmetric form that it can have; `None` if it can have no form.
///
/// # Complexity
/// As [`Structure::symmetry_lays`], for each form.
///
/// # Examples
/// ```
/// use ozols::synthesis::{layout::most_symmetric, recognize::recognize_structure};
/// let found = recognize_structure(&ozols::built_in("gripper-10")?)?;
/// assert!(most_symmetric(&found.structure).is_some_and(|s| s.is_graph_symmetric()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn most_symmetric(structure: &PairStructure) -> Option<Structure> {
    let symmetric = [Symmetry::Mirror, Symmetry::HalfTurn];
    let forms = [false, true].into_iter().cartesian_product(symmetric);
    let forms = forms.map(|(one_sided, symmetry)| Form {
        one_sided,
        ..Form::of_symmetry(symmetry)
    });
    let structure = PairStructure::of_key(&structure.canonical_key());
    let mut all = forms.chain([Form::of_symmetry(Symmetry::Generic)]);
    let found = all.find_map(|form| {
        let structure = structure.clone();
        let paired = Structure::new(structure, form);
        let mut lays = paired.symmetry_lays().into_iter();
        lays.any(|lay| Rules::new(&paired, &lay).is_ok())
            .then_some(paired)
    });
    found.map(Structure::on_parallelograms_if_any)
}

/// A structure with a place for every joint.
#[derive(Debug, Clone)]
pub struct Layout {
    /// The joints with their rules.
    pub rules: Rules,
    /// Their places.
    pub at: Places,
    /// The figures of the drawn pose for which it was chosen.
    pub looks: Looks,
    /// The limits that it was made for.
    pub limits: Limits,
    /// The start in which it was found.
    pub start: u32,
}

impl Layout {
    /// Returns the exact places of the joints.
    #[must_use]
    pub fn places(&self) -> Vec<Place> {
        let joints = 0..self.rules.joints.len();
        joints
            .map(|i| self.rules.exact_place(&self.at.points, i))
            .collect()
    }
}

/// Why a structure has no layout.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum NoLayout {
    /// In nearly all places it moves in another way, or not at all.
    #[error("{0}")]
    Motion(#[from] NoGripper),
    /// No places of its joints have the symmetry and the form.
    #[error("{0}")]
    Pairs(#[from] NoRules),
    /// The pose is not proven to be a regular one of mobility 1.
    #[error("the places found are not proven to leave one finite motion")]
    NotRegular,
    /// No places were found that keep the limits. The error holds the figures of the best.
    #[error(
        "no places found within the limits: the best have links of 1 : {ratio:.1} and {crossings} crossings"
    )]
    Limits {
        /// The longest link over the shortest.
        ratio: f64,
        /// Crossings.
        crossings: usize,
    },
}

impl NoLayout {
    /// Creates the error for the figures of the best places.
    fn limits(looks: &Looks) -> NoLayout {
        NoLayout::Limits {
            ratio: looks.ratio,
            crossings: looks.crossings,
        }
    }
}

/// Lays a structure out; the layout is the same for the same seed.
///
/// A structure with three sides is laid out as one with two. If all sides are in one plane, the other sides are obstacles. Otherwise the
/// pins of each side keep to its side of the driver.
///
/// # Errors
/// Returns an error if there is no layout.
///
/// # Complexity
/// Some thousand evaluations of places for each lay. Some hundred of these evaluate a whole stroke.
pub fn lay_out(structure: &Structure, limits: &Limits, seed: u64) -> Result<Layout, NoLayout> {
    let mut best: Option<(FoundPlaces, Rules)> = None;
    let mut why = NoLayout::Pairs(NoRules::Still);
    let mut start = 0;
    let name = structure.name();
    let mut limits = *limits;
    limits.task.own_sides |= structure.is_axial();
    let lays = match &structure.sides {
        Some(sides) => vec![sides.lay.clone()],
        None if structure.form.hinges => vec![structure.hinged_lay()?],
        None => structure.symmetry_lays(),
    };
    for lay in lays {
        let rules = match Rules::new(structure, &lay) {
            Ok(rules) => rules,
            Err(e) => {
                why = NoLayout::Pairs(e);
                continue;
            }
        };
        why = if structure.form.hinges {
            NoLayout::Motion(NoGripper::DeadDrive)
        } else {
            NoLayout::NotRegular
        };
        let sketch = Sketch::new(structure, rules, limits);
        let mut judge = Judge::new(&sketch);
        let found = best_of_starts(&sketch, &mut judge, &name, seed, start);
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
    let mut looks = found.looks;
    if !found.within {
        return Err(NoLayout::limits(&looks));
    }
    if structure.sides.is_some() {
        let tip = looks.tips[0];
        looks.tips = if structure.is_axial() {
            vec![tip; SIDES]
        } else {
            vec![tip, third(tip), third(third(tip))]
        };
    }
    Ok(Layout {
        at: found.at,
        start: found.start,
        limits,
        rules,
        looks,
    })
}
