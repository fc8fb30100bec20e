//! The verdict on the rank of a state: as written, or as meant where coordinates are rounded, or undecided.
//!
//! Rounding raises ranks. A singular value above the rounding bound is real; if all that the exact rank counts are, the
//! exact rank holds. If not, those below the bound may be zero, and are taken for it only if a gap says so and there is such a
//! geometry within the digits: the scene that is meant, exactly, or else by Newton's method.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::meant::mechanism::{Meant as Scene, meant as scene_of};
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::model::rounded::{Rounded, Uncertainties, looks_rounded, uncertainties};
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::rank::method::NoAnswer;
use crate::rank::numeric::rounding_bound::bound;
use crate::rank::numeric::scaling::NumericRank;
use crate::rank::numeric::values::{ROUND_OFF, Values, relative_values};
use crate::rank::reduce::sufficient_rows::LeastRows;
use crate::rank::rounded::moves::{moved_joints, understood};
use crate::rank::rounded::nearest_lower_rank::{Nearest, nearest};
use crate::rank::rounded::size;

/// A gap narrower than this among what rounding can have made says nothing.
const CLEAR: f64 = 30.0;
/// Nothing is known better in double precision, relative to the largest singular value.
const LEAST: f64 = 1e-13;
/// A scene whose numbers would have to move by more halves of their last digit is not the one that is meant.
const FURTHEST: f64 = 1.2;
/// A geometry that is near by chance more often than this says nothing.
const CHANCE: f64 = 1e-3;
/// How many units, relative to the size, the geometries are wide that one condition lets be near.
const WIDE: f64 = 20.0;

/// Which mechanism a verdict is about.
#[derive(Debug, Clone)]
pub enum Meant {
    /// The one that is written: no rounding of its digits lowers the rank.
    AsWritten,
    /// The one with its near-coincidences exact.
    Snapped {
        /// It.
        mechanism: Box<Mechanism>,
        /// Rank of its J, exact.
        rank: usize,
        /// How many joints were moved.
        moved: usize,
        /// What was understood.
        understood: String,
    },
    /// The nearest one whose J has a smaller rank.
    Near {
        /// It, in doubles.
        mechanism: Box<Mechanism>,
        /// Rank of its J, numeric.
        rank: usize,
        /// The largest move of a coordinate, in units of its last digit.
        moved: f64,
    },
    /// Not decided.
    Undecided {
        /// The rank that may be meant.
        near: usize,
    },
}

/// The verdict on a state.
#[derive(Debug, Clone)]
pub struct RankVerdict {
    /// Name of the state.
    pub state: String,
    /// f.
    pub freedoms: usize,
    /// Rows of J.
    pub rows: usize,
    /// Why coordinates look rounded, where they do.
    pub rounded: Option<Rounded>,
    /// Rank of J with every digit taken at its word, by one prime.
    pub as_written: usize,
    /// Singular values of the J that is written, at the rank meant; none where every digit is exact.
    pub numeric: Option<NumericRank>,
    /// What rounding can do to a singular value, relative to the largest.
    pub tolerance: f64,
    /// What is meant.
    pub meant: Meant,
    /// What rows of J, as it is written, are enough for its rank; empty where all are taken.
    pub needed: String,
}

impl RankVerdict {
    /// The rank of J; as written where that is not decided, which then is the most it can be.
    #[must_use]
    pub fn rank(&self) -> usize {
        match self.meant {
            Meant::AsWritten | Meant::Undecided { .. } => self.as_written,
            Meant::Snapped { rank, .. } | Meant::Near { rank, .. } => rank,
        }
    }

    /// The least rank it can be: that of the mechanism that may be meant where it is not decided.
    #[must_use]
    pub fn at_least(&self) -> usize {
        match self.meant {
            Meant::Undecided { near } => near,
            _ => self.rank(),
        }
    }

    /// (W, σ) of a rank.
    #[must_use]
    pub fn figures(&self, rank: usize) -> (usize, usize) {
        (
            self.freedoms.saturating_sub(rank),
            self.rows.saturating_sub(rank),
        )
    }

    /// Whether it is decided.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        !matches!(self.meant, Meant::Undecided { .. })
    }

    /// The mechanism that it is about, where that is not the one that is written.
    #[must_use]
    pub fn mechanism(&self) -> Option<&Mechanism> {
        match &self.meant {
            Meant::AsWritten | Meant::Undecided { .. } => None,
            Meant::Snapped { mechanism, .. } | Meant::Near { mechanism, .. } => Some(mechanism),
        }
    }

    /// One word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self.meant {
            Meant::AsWritten => "as written",
            Meant::Snapped { .. } => "snapped",
            Meant::Near { .. } => "near",
            Meant::Undecided { .. } => "undecided",
        }
    }

    /// Whether it is about the mechanism that is written.
    #[must_use]
    pub fn is_as_written(&self) -> bool {
        matches!(self.meant, Meant::AsWritten)
    }

    /// Whether what is written and what is meant have the same figures.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.is_decided() && self.rank() == self.as_written
    }

    /// Why it is not decided, and what to do.
    #[must_use]
    pub fn undecided(&self) -> String {
        let ((w, sigma), (near_w, near_sigma)) =
            (self.figures(self.as_written), self.figures(self.at_least()));
        let gap = self.numeric.map_or_else(String::new, |n| {
            format!(
                "; singular values: {:.1e} above the gap, {:.1e} below it",
                n.kept, n.dropped
            )
        });
        format!(
            "undecided: W = {w}, σ = {sigma} as written, W = {near_w}, σ = {near_sigma} if digits are left over from \
             rounding{gap}. Write roots or expressions such as \"sqrt(3)/2\", give more digits, or say how far they may be off in a [tolerance] table"
        )
    }
}

/// The exact rank, by the rows that are enough for it.
fn exact_rank(mechanism: &Mechanism, state: StateId) -> Result<(usize, String), NoAnswer> {
    let exact = field_of(mechanism, state, 0)?;
    let closure = Closure::new(&exact, mechanism, state)?;
    let least = LeastRows::new(&exact, mechanism, &closure)?;
    let words = least.words(mechanism, |c| closure.contours[c].name(mechanism));
    Ok((least.rank(), words))
}

/// The exact rank of J of a mechanism that is snapped, by one prime.
pub(in crate::rank) fn rank_of(mechanism: &Mechanism, state: StateId) -> Result<usize, NoAnswer> {
    let exact = field_of(mechanism, state, 0)?;
    Ok(modular::rank(
        &exact,
        &Closure::new(&exact, mechanism, state)?,
    ))
}

/// Returns the verdict on a state.
///
/// # Errors
/// Where the geometry has no image in a prime field, or the singular values do not converge.
///
/// # Guarantee
/// As written where Weyl's bound holds the exact rank against any rounding of the last digits. As meant where a geometry
/// within the digits has the rank of the values above the bound: likely, not proven. Undecided otherwise.
///
/// # Complexity
/// The scene that is meant; one modular rank; with decimals one singular value decomposition more, and only where they disagree
/// [`nearest`].
pub fn verdict(mechanism: &Mechanism, state: StateId) -> Result<RankVerdict, NoAnswer> {
    let scene = resolved(mechanism);
    verdict_on(mechanism, state, scene.as_ref())
}

/// Returns the scene that is meant, where digits say what is.
pub(in crate::rank) fn resolved(mechanism: &Mechanism) -> Option<Scene> {
    scene_of(mechanism).filter(|s| s.scene.moved <= FURTHEST)
}

/// [`verdict`] with the scene that is meant known.
pub(in crate::rank) fn verdict_on(
    mechanism: &Mechanism,
    state: StateId,
    scene: Option<&Scene>,
) -> Result<RankVerdict, NoAnswer> {
    let file = mechanism;
    // In a plane joints must stay square to it: as they are written they have no freedom there.
    let planar = |_: &&Scene| matches!(file.mode, Mode::Planar { .. });
    let mechanism = scene.filter(planar).map_or(file, |s| &s.mechanism);
    let (as_written, needed) = exact_rank(mechanism, state)?;
    let real = Closure::new(&Reals, mechanism, state)?;
    let rounded = looks_rounded(file);
    let mut found = RankVerdict {
        state: mechanism.states[state].clone(),
        freedoms: real.columns.len(),
        rows: real.rows(),
        as_written,
        numeric: None,
        tolerance: 0.0,
        meant: Meant::AsWritten,
        needed,
        rounded,
    };
    let Some(half) = allowed(file, found.rounded.as_ref()) else {
        return Ok(found);
    };
    let Some(values) = relative_values(&real)? else {
        return Ok(found);
    };
    found.tolerance = (bound(mechanism, &real, &half) / values.largest).max(LEAST);
    let above = values.above(found.tolerance);
    let scene = match scene.filter(|s| s.scene.moved > 0.0) {
        Some(s) => Some((s, rank_of(&s.mechanism, state)?)),
        None => None,
    };
    let rank = scene.map_or(as_written, |s| s.1);
    if above >= rank {
        let (at, meant) = counted(&values, above, rank, scene);
        (found.numeric, found.meant) = (Some(values.at(at)), meant);
        return Ok(found);
    }
    // A value below the tolerance may be zero, whatever the exact rank makes of it.
    found.numeric = Some(values.at(above));
    found.meant = if values.gap(above, ROUND_OFF) < CLEAR {
        // One gap is much like another there.
        Meant::Undecided {
            near: values.left_over(above).unwrap_or(above),
        }
    } else {
        meant(mechanism, state, above, &half)
    };
    Ok(found)
}

/// Returns what coordinates may be off by: half the units of their last digits; none where every digit is exact.
pub(in crate::rank) fn allowed(
    file: &Mechanism,
    rounded: Option<&Rounded>,
) -> Option<Uncertainties> {
    let units = rounded?.units;
    let [length, direction] = [units.length, units.direction].map(|u| u / 2.0);
    Some(uncertainties(file).unwrap_or_else(|| Uncertainties::uniform(file, length, direction)))
}

/// The verdict where no rounding can have made the singular values that the rank counts, and the rank to show them at.
fn counted(
    values: &Values,
    above: usize,
    rank: usize,
    scene: Option<(&Scene, usize)>,
) -> (usize, Meant) {
    match (values.left_over(rank), scene) {
        (Some(near), _) => (near, Meant::Undecided { near }),
        // No rounding can have made what the digits say is there in truth.
        (_, Some(_)) if above > rank => (rank, Meant::Undecided { near: rank }),
        (_, Some((s, _))) => (rank, snapped(s, rank)),
        _ => (rank, Meant::AsWritten),
    }
}

/// The verdict that a scene is meant.
fn snapped(scene: &Scene, rank: usize) -> Meant {
    Meant::Snapped {
        mechanism: Box::new(scene.mechanism.clone()),
        rank,
        moved: moved_joints(scene).len(),
        understood: understood(scene),
    }
}

/// Returns the mechanism that is meant if J is to have a rank.
fn meant(mechanism: &Mechanism, state: StateId, rank: usize, half: &Uncertainties) -> Meant {
    // With few digits a geometry of that rank is near by chance, unless it asks for several conditions at once.
    let [length, direction] = half.largest(mechanism);
    let share = (WIDE * 2.0 * direction.max(length / size(mechanism))).min(1.0);
    let chance = |n: &Nearest| {
        let conditions = i32::try_from(n.conditions).unwrap_or(i32::MAX);
        share.powi(conditions.max(1))
    };
    match nearest(mechanism, state, rank, half).filter(|n| chance(n) <= CHANCE) {
        Some(Nearest {
            mechanism: m,
            moved,
            ..
        }) => Meant::Near {
            mechanism: Box::new(m),
            rank,
            moved,
        },
        None => Meant::Undecided { near: rank },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{X, drawn, hinges};

    /// Two hinges of a door half a last digit apart are meant to be on one line, unless digits are so few that any two would be.
    #[test]
    fn of_few_digits_a_geometry_that_is_near_says_nothing() {
        for (unit, near) in [(1e-6, true), (1e-3, false)] {
            let apart = [0.345_678 * unit, 0.0, 0.0];
            let door = hinges(&[([0, 1], [0.0; 3]), ([0, 1], apart), ([0, 2], X)]);
            let m = drawn(&door, &[]);
            let half = Uncertainties::uniform(&m, unit / 2.0, unit / 2.0);
            let found = meant(&m, StateId::FREE, 2, &half);
            assert_eq!(
                matches!(found, Meant::Near { .. }),
                near,
                "{unit} {found:?}"
            );
            assert_eq!(matches!(found, Meant::Undecided { .. }), !near, "{unit}");
        }
    }
}
