//! The verdict on the rank of a state: as written, as intended if coordinates are rounded, or undecided.
//!
//! Rounding raises ranks. A singular value above the rounding bound is nonzero. If this holds for all values that the
//! exact rank counts, the exact rank is valid. If not, those below the bound may be zero. They are treated as zero only
//! if there is a clear gap and a geometry with that rank exists within the digits. That geometry is the recovered
//! scene, exactly, or otherwise one found by Newton's method.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::meant::mechanism::{
    Meant as Scene, describe_relations, moved_joints, recover_mechanism as scene_of,
};
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::model::rounded::{Rounded, Uncertainties, looks_rounded, uncertainties};
use crate::rank::exact::field::closure_of;
use crate::rank::exact::modular;
use crate::rank::method::NoAnswer;
use crate::rank::numeric::scaling::NumericRank;
use crate::rank::numeric::values::{ROUND_OFF, Values, relative_values, rounding_bound};
use crate::rank::reduce::sufficient_rows::LeastRows;
use crate::rank::rounded::mechanism_size;
use crate::rank::rounded::nearest_lower_rank::{Nearest, nearest_of_rank};

/// Minimum gap that is significant among values that rounding can have made.
const CLEAR: f64 = 30.0;
/// Limit of double precision, relative to the largest singular value.
const LEAST: f64 = 1e-13;
/// Maximum move of a number in the intended scene, in halves of its last digit.
const FURTHEST: f64 = 1.2;
/// Probability of a chance coincidence above which a nearby geometry is not significant.
const CHANCE: f64 = 1e-3;
/// Width, in units relative to the size, of the geometries near one condition.
const WIDE: f64 = 20.0;

/// The mechanism that a verdict refers to.
#[derive(Debug, Clone)]
pub enum Meant {
    /// The mechanism as written: no rounding of its digits lowers the rank.
    AsWritten,
    /// The mechanism with its near-coincidences made exact.
    Snapped {
        /// The mechanism.
        mechanism: Box<Mechanism>,
        /// Rank of its J, exact.
        rank: usize,
        /// Number of joints moved.
        moved: usize,
        /// Description of the recovered relations.
        understood: String,
    },
    /// The nearest mechanism whose J has a smaller rank.
    Near {
        /// The mechanism, in doubles.
        mechanism: Box<Mechanism>,
        /// Rank of its J, numeric.
        rank: usize,
        /// The largest move of a coordinate, in units of its last digit.
        moved: f64,
    },
    /// Not decided.
    Undecided {
        /// The rank that may be intended.
        near: usize,
    },
}

/// The verdict on a state.
#[derive(Debug, Clone)]
pub struct RankVerdict {
    /// Name of the state.
    pub state: String,
    /// f, the number of freedoms.
    pub freedoms: usize,
    /// Rows of J.
    pub rows: usize,
    /// The reason why coordinates look rounded, if they do.
    pub rounded: Option<Rounded>,
    /// Rank of J with every digit taken exactly as written, by one prime.
    pub as_written: usize,
    /// Singular values of J as written, at the intended rank; `None` if every digit is exact.
    pub numeric: Option<NumericRank>,
    /// The possible effect of rounding on a singular value, relative to the largest.
    pub tolerance: f64,
    /// The intended mechanism.
    pub meant: Meant,
    /// The rows of J, as written, that are enough for its rank. Empty if all are used.
    pub needed: String,
}

impl RankVerdict {
    /// Returns the rank of J. If undecided, this is the rank as written, which is then an upper bound.
    #[must_use]
    pub fn rank(&self) -> usize {
        match self.meant {
            Meant::AsWritten | Meant::Undecided { .. } => self.as_written,
            Meant::Snapped { rank, .. } | Meant::Near { rank, .. } => rank,
        }
    }

    /// Returns the lower bound of the rank: if undecided, that of the mechanism that may be intended.
    #[must_use]
    pub fn at_least(&self) -> usize {
        match self.meant {
            Meant::Undecided { near } => near,
            _ => self.rank(),
        }
    }

    /// Returns (W, σ) at a rank.
    #[must_use]
    pub fn figures_at(&self, rank: usize) -> (usize, usize) {
        (
            self.freedoms.saturating_sub(rank),
            self.rows.saturating_sub(rank),
        )
    }

    /// Returns true if the rank is decided.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        !matches!(self.meant, Meant::Undecided { .. })
    }

    /// Returns the mechanism of the verdict, if it is not the one as written.
    #[must_use]
    pub fn intended_mechanism(&self) -> Option<&Mechanism> {
        match &self.meant {
            Meant::AsWritten | Meant::Undecided { .. } => None,
            Meant::Snapped { mechanism, .. } | Meant::Near { mechanism, .. } => Some(mechanism),
        }
    }

    /// Returns one word for programs.
    #[must_use]
    pub fn as_word(&self) -> &'static str {
        match self.meant {
            Meant::AsWritten => "as written",
            Meant::Snapped { .. } => "snapped",
            Meant::Near { .. } => "near",
            Meant::Undecided { .. } => "undecided",
        }
    }

    /// Returns true if the verdict is about the mechanism as written.
    #[must_use]
    pub fn is_as_written(&self) -> bool {
        matches!(self.meant, Meant::AsWritten)
    }

    /// Returns true if the written and the intended mechanism have the same figures.
    #[must_use]
    pub fn agrees_as_written(&self) -> bool {
        self.is_decided() && self.rank() == self.as_written
    }

    /// Explains why the rank is undecided, and what to do.
    #[must_use]
    pub fn explain_undecided(&self) -> String {
        let ((w, sigma), (near_w, near_sigma)) = (
            self.figures_at(self.as_written),
            self.figures_at(self.at_least()),
        );
        let gap = self.numeric.map_or_else(String::new, |n| {
            format!(
                "; singular values: {:.1e} above the gap, {:.1e} below it",
                n.kept, n.dropped
            )
        });
        format!(
            "undecided: W = {w}, σ = {sigma} as written, W = {near_w}, σ = {near_sigma} if the \
            last digits are rounding errors{gap}. Write roots or expressions such as \
            \"sqrt(3)/2\", give more digits, or give their uncertainty in a [tolerance] table"
        )
    }
}

/// Returns the exact rank, by the rows that are enough for it.
fn exact_rank(mechanism: &Mechanism, state: StateId) -> Result<(usize, String), NoAnswer> {
    let (exact, closure) = closure_of(mechanism, state, 0)?;
    let least = LeastRows::new(&exact, mechanism, &closure)?;
    let words = least.describe_rows(mechanism, |c| closure.contours[c].name(mechanism));
    Ok((least.rank(), words))
}

/// Returns the exact rank of J of a snapped mechanism, by one prime.
fn rank_of(mechanism: &Mechanism, state: StateId) -> Result<usize, NoAnswer> {
    let (exact, closure) = closure_of(mechanism, state, 0)?;
    Ok(modular::rank_modulo(&exact, &closure))
}

/// Returns the verdict on a state.
///
/// # Errors
/// Returns an error if the geometry has no image in a prime field. Also if the singular values do not converge.
///
/// # Guarantee
/// As written if Weyl's bound protects the exact rank against any rounding of the last digits. As intended if a geometry
/// within the digits has the rank of the values above the bound. This is likely, not proven. Undecided otherwise.
///
/// # Complexity
/// The recovery of the intended scene and one modular rank. With decimals also one singular value decomposition, and
/// [`nearest_of_rank`] only if the ranks disagree.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::rounded::verdict::rank_verdict};
/// let verdict = rank_verdict(&ozols::built_in("bennett")?, StateId::FREE)?;
/// assert!(verdict.is_decided() && verdict.is_as_written());
/// assert_eq!(verdict.rank(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rank_verdict(mechanism: &Mechanism, state: StateId) -> Result<RankVerdict, NoAnswer> {
    let scene = intended_scene(mechanism);
    verdict_on(mechanism, state, scene.as_ref())
}

/// Returns the intended scene, if the digits determine one.
fn intended_scene(mechanism: &Mechanism) -> Option<Scene> {
    scene_of(mechanism).filter(|s| s.scene.moved <= FURTHEST)
}

/// Works as [`verdict`], with the intended scene known.
fn verdict_on(
    mechanism: &Mechanism,
    state: StateId,
    scene: Option<&Scene>,
) -> Result<RankVerdict, NoAnswer> {
    let file = mechanism;
    // In a plane, joints must stay perpendicular to it. As written they have no freedom there.
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
    let Some(half) = allowed_uncertainty(file, found.rounded.as_ref()) else {
        return Ok(found);
    };
    let Some(values) = relative_values(&real)? else {
        return Ok(found);
    };
    found.tolerance = (rounding_bound(mechanism, &real, &half) / values.largest).max(LEAST);
    let above = values.count_above(found.tolerance);
    let scene = match scene.filter(|s| s.scene.moved > 0.0) {
        Some(s) => Some((s, rank_of(&s.mechanism, state)?)),
        None => None,
    };
    let rank = scene.map_or(as_written, |s| s.1);
    if above >= rank {
        let (at, meant) = verdict_if_counted(&values, above, rank, scene);
        (found.numeric, found.meant) = (Some(values.rank_at(at)), meant);
        return Ok(found);
    }
    // A value below the tolerance may be zero, for any exact rank.
    found.numeric = Some(values.rank_at(above));
    found.meant = if values.gap_at(above, ROUND_OFF) < CLEAR {
        // The gaps there are too similar to choose one.
        Meant::Undecided {
            near: values.left_over(above).unwrap_or(above),
        }
    } else {
        verdict_near(mechanism, state, above, &half)
    };
    Ok(found)
}

/// Returns the uncertainty of coordinates: half the units of their last digits, or `None` if every digit is exact. The
/// digits of π are finer than any rank can tell.
pub(in crate::rank) fn allowed_uncertainty(
    file: &Mechanism,
    rounded: Option<&Rounded>,
) -> Option<Uncertainties> {
    let exact = || Uncertainties::uniform(file, 0.0, 0.0);
    rounded.map(|_| uncertainties(file).unwrap_or_else(exact))
}

/// Returns the verdict if no rounding can have made the singular values that the rank counts, and the rank at which to
/// show them.
fn verdict_if_counted(
    values: &Values,
    above: usize,
    rank: usize,
    scene: Option<(&Scene, usize)>,
) -> (usize, Meant) {
    match (values.left_over(rank), scene) {
        (Some(near), _) => (near, Meant::Undecided { near }),
        // No rounding can have made a relation that the digits establish.
        (_, Some(_)) if above > rank => (rank, Meant::Undecided { near: rank }),
        (_, Some((s, _))) => (rank, verdict_snapped(s, rank)),
        _ => (rank, Meant::AsWritten),
    }
}

/// Returns the verdict that a scene is intended.
fn verdict_snapped(scene: &Scene, rank: usize) -> Meant {
    Meant::Snapped {
        mechanism: Box::new(scene.mechanism.clone()),
        rank,
        moved: moved_joints(scene).len(),
        understood: describe_relations(scene),
    }
}

/// Returns the intended mechanism if J is to have a rank.
fn verdict_near(mechanism: &Mechanism, state: StateId, rank: usize, half: &Uncertainties) -> Meant {
    // With few digits, a geometry of that rank is close by chance, unless it requires several conditions at once.
    let [length, direction] = half.largest_half_units(mechanism);
    let share = (WIDE * 2.0 * direction.max(length / mechanism_size(mechanism))).min(1.0);
    let chance = |n: &Nearest| {
        let conditions = i32::try_from(n.conditions).unwrap_or(i32::MAX);
        share.powi(conditions.max(1))
    };
    match nearest_of_rank(mechanism, state, rank, half).filter(|n| chance(n) <= CHANCE) {
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

/// The intended mechanism, for exact arithmetic.
#[derive(Debug, Clone, Default)]
pub struct Settled {
    /// The snapped mechanism if it is the intended one; `None` if the file is used as written.
    pub snapped: Option<Mechanism>,
    /// Description of the recovered relations, if the mechanism was snapped.
    pub understood: Option<String>,
    /// The verdicts on the states. Empty if every digit is exact, so that there is nothing to decide.
    pub verdicts: Vec<RankVerdict>,
    /// Index of the first verdict whose rank differs from that of the mechanism.
    pub open: Option<usize>,
}

/// Determines which mechanism is intended in some states.
///
/// # Errors
/// Returns an error in the same cases as [`rank_verdict`].
///
/// # Guarantee
/// If no verdict is open, the exact rank of J in each state is that of its verdict.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::rounded::verdict::settle_states};
/// let settled = settle_states(&ozols::built_in("bennett")?, &[StateId::FREE])?;
/// assert!(settled.verdicts.is_empty()); // Every digit is exact: there is nothing to decide.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn settle_states(mechanism: &Mechanism, states: &[StateId]) -> Result<Settled, NoAnswer> {
    let mut out = Settled::default();
    if looks_rounded(mechanism).is_none() {
        return Ok(out);
    }
    let scene = intended_scene(mechanism);
    let each = |&s: &StateId| verdict_on(mechanism, s, scene.as_ref());
    out.verdicts = states.iter().map(each).collect::<Result<_, _>>()?;
    let snapped = scene.as_ref().filter(|s| s.scene.moved > 0.0);
    let found = snapped.map_or(mechanism, |s| &s.mechanism);
    for (i, (v, &state)) in out.verdicts.iter().zip(states).enumerate() {
        if !v.is_decided() || rank_of(found, state)? != v.rank() {
            out.open = Some(i);
            return Ok(out);
        }
    }
    if let Some(s) = snapped.filter(|s| !moved_joints(s).is_empty()) {
        out.understood = Some(describe_relations(s));
        out.snapped = Some(s.mechanism.clone());
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{X, draw_mechanism, hinges};

    /// Two hinges of a door half a last digit apart are intended to be on one line, unless there are so few digits that
    /// any two would be.
    #[test]
    fn of_few_digits_a_geometry_that_is_near_says_nothing() {
        for (unit, near) in [(1e-6, true), (1e-3, false)] {
            let apart = [0.345_678 * unit, 0.0, 0.0];
            let door = hinges(&[([0, 1], [0.0; 3]), ([0, 1], apart), ([0, 2], X)]);
            let m = draw_mechanism(&door, &[]);
            let half = Uncertainties::uniform(&m, unit / 2.0, unit / 2.0);
            let found = verdict_near(&m, StateId::FREE, 2, &half);
            assert_eq!(
                matches!(found, Meant::Near { .. }),
                near,
                "{unit} {found:?}"
            );
            assert_eq!(matches!(found, Meant::Undecided { .. }), !near, "{unit}");
        }
    }
}
