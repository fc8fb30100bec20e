//! A place for every pin, looked for from seeds that follow from the structure's name.
//!
//! Moves go to whole millimetres, so that what is found is exact as it stands.

use crate::chains::layout_symmetry::{NoGripper, working_swap};
use crate::chains::roles::Subject;
use crate::synthesis::annealing::best_of_starts;
use crate::synthesis::bones::Bones;
use crate::synthesis::layout_quality::Looks;
use crate::synthesis::paired::rules::NoRules;
use crate::synthesis::place::{Place, Point};
use crate::synthesis::rules::{Rule, Rules};
use crate::synthesis::skeleton::Skeleton;
use crate::synthesis::sketch::LayoutSketch;
use crate::synthesis::stroke::judge::Judge;
use crate::synthesis::structure::Structure;
use crate::synthesis::task::Limits;
use crate::synthesis::velocities::Velocity;
use crate::synthesis::{bell, below};
use chacha20::ChaCha8Rng;
use thiserror::Error;

/// A layout that costs less than this is taken without looking for a better one.
const GOOD: f64 = 3.0;

/// A structure with a place for every joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// The links of each pin, by canonical numbers; the input joint is among them.
    pub pins: Vec<(usize, usize)>,
    /// Their places, in millimetres.
    pub at: Vec<Place>,
    /// Joints that are images of each other, by their places in the list.
    pub images: Vec<(usize, usize)>,
    /// Where the tips of the jaws are.
    pub tips: Vec<Place>,
    /// The figures it was taken for.
    pub looks: Looks,
    /// What it was made for.
    pub limits: Limits,
    /// The start it was found from.
    pub start: u32,
}

impl Layout {
    /// The points of a link: its pins, and of a jaw its tip.
    #[must_use]
    pub fn points(&self, structure: &Structure, link: usize) -> Vec<Point> {
        let jaw = structure.roles.jaws.iter().position(|&j| j == link);
        let pins = self.pins.iter().zip(&self.at);
        pins.filter(|((u, v), _)| [*u, *v].contains(&link))
            .map(|(_, at)| at)
            .chain(jaw.map(|n| &self.tips[n]))
            .map(|p| p.real())
            .collect()
    }
}

/// Why a structure has no layout.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum NoLayout {
    /// In nearly all places it moves otherwise, or not at all.
    #[error("{0}")]
    Motion(#[from] NoGripper),
    /// The parallelograms of the jaws ask for what the symmetry does not give.
    #[error("the parallelograms do not go with the symmetry")]
    Parallelograms,
    /// It has pairs that lie in no symmetric places.
    #[error("{0}")]
    Pairs(#[from] NoRules),
    /// The pose is not proven to be a regular one of mobility 1.
    #[error("the places found are not proven to leave one finite motion")]
    NotRegular,
    /// No places were found that keep the limits; those of the best are told.
    #[error(
        "no places found within the limits: the best have links of 1 : {ratio:.1}, a transmission angle of \
         {transmission:.0}°, {crossings} crossings, and {straightness:.0} % of the jaws' motion closes them"
    )]
    Limits {
        /// The longest link over the shortest.
        ratio: f64,
        /// The worst transmission angle.
        transmission: f64,
        /// Crossings.
        crossings: usize,
        /// Share of the jaws' motion that closes them, in per cent.
        straightness: f64,
    },
}

impl NoLayout {
    /// That places have these figures at best.
    pub(super) fn limits(looks: &Looks) -> NoLayout {
        NoLayout::Limits {
            ratio: looks.ratio,
            transmission: looks.transmission,
            crossings: looks.crossings,
            straightness: 100.0 * looks.straightness,
        }
    }
}

/// Lays a structure out; the same for the same seed.
///
/// # Errors
/// Why there is none.
///
/// # Complexity
/// Some thousand looks at places, of which some hundred are at a whole stroke.
pub fn layout(
    subject: &Subject<'_>,
    structure: &Structure,
    limits: &Limits,
    seed: u64,
) -> Result<Layout, NoLayout> {
    let (symmetry, input) = (structure.form.symmetry, structure.form.input);
    let swap = working_swap(subject, &structure.roles, symmetry, input)?;
    let rules = Rules::new(structure, &swap).ok_or(NoLayout::Parallelograms)?;
    let skeleton = Skeleton::new(structure, rules, *limits);
    let mut judge = Judge::new(&skeleton);
    let name = structure.name();
    let found = best_of_starts(&skeleton, &mut judge, &name, seed, 0);
    let found = found.ok_or(NoLayout::Motion(NoGripper::DeadDrive))?;
    let looks = found.looks;
    if !found.within {
        return Err(NoLayout::limits(&looks));
    }
    let rules = &skeleton.rules;
    Ok(Layout {
        pins: rules.pins.clone(),
        at: rules.places(&found.at),
        tips: structure.tips(&limits.task),
        limits: *limits,
        images: rules.images().collect(),
        looks,
        start: found.start,
    })
}

impl LayoutSketch for Skeleton<'_> {
    type JointPlaces = Vec<Point>;

    fn bones(&self) -> &Bones {
        &self.bones
    }

    fn limits(&self) -> &Limits {
        &self.limits
    }

    fn good(&self) -> f64 {
        GOOD
    }

    fn points<'p>(&self, at: &'p Vec<Point>) -> &'p [Point] {
        at
    }

    fn first_places(&self, random: &mut ChaCha8Rng) -> Vec<Point> {
        let joints = self.rules.pins.iter().map(|&(u, v)| [u, v]).collect();
        let mut at = self.bones.first_places(joints, random);
        self.rules.settle(&mut at);
        at
    }

    fn change(&self, at: &mut Vec<Point>, warmth: f64, random: &mut ChaCha8Rng) {
        let reach = 2.0 + 18.0 * warmth;
        let movable = self.rules.movable().count();
        let Some(pin) = self.rules.movable().nth(below(movable, random)) else {
            return;
        };
        let [x, y] = at[pin];
        at[pin] = match self.rules.rules[pin] {
            Rule::OnLine => [x + reach * bell(random), 0.0],
            _ => [x + reach * bell(random), y + reach * bell(random)],
        }
        .map(f64::round);
        self.rules.settle(at);
    }

    fn velocities(&self, at: &Vec<Point>) -> Option<Vec<Velocity>> {
        self.contours.velocities(at)
    }
}
