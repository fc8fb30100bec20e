//! The conditions that variants must meet, and a search made ready for them.

use crate::geom::exact::ExactError;
pub use crate::model::mechanism::Drives;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::search::question::rounded_rank::Digits;
use crate::search::question::symmetry::MirrorError;
use serde::Deserialize;
use std::sync::Arc;
use thiserror::Error;

/// Which variants of a mirror-symmetric mechanism are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Symmetry {
    /// All.
    #[default]
    All,
    /// Only those that are their own mirror image.
    #[serde(rename = "symmetric")]
    SymmetricOnly,
    /// One of each variant and its mirror image.
    OnePerOrbit,
}

/// A state that takes part, and what variants must be like in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InState {
    /// The state, not the free one; its additional joints take part.
    pub state: StateId,
    /// Maximum number of redundant constraints that it may add, if limited.
    pub max_external: Option<u32>,
    /// Maximum number of harmful ones among them, if limited.
    pub max_harmful: Option<u32>,
    /// Whether the objects must be held.
    pub hold_objects: bool,
}

impl InState {
    /// Creates conditions on a state without limits, in which objects are held.
    #[must_use]
    pub fn holding(state: StateId) -> InState {
        InState {
            state,
            max_external: None,
            max_harmful: None,
            hold_objects: true,
        }
    }
}

/// The conditions on variants of one mechanism, with its state by number.
///
/// # Examples
/// ```
/// use ozols::{rank::exact::field::exact_field, search::{Search, diagram::Control, question::conditions::Conditions}};
/// let four_bar = ozols::built_in("four-bar")?;
/// let few = Conditions { max_changes: Some(1), ..Conditions::default() };
/// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, few)?;
/// let diagrams = search.build_diagrams(Control::NONE);
/// assert_eq!(search.cheapest_variants(&diagrams, 9).count(), 0); // σ = 3 needs more changes.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Conditions {
    /// Redundant constraints allowed within the mechanism.
    pub max_redundant: u32,
    /// The state that takes part besides the free one.
    pub state: Option<InState>,
    /// Largest mobility W allowed.
    pub max_mobility: Option<i64>,
    /// Most changes allowed.
    pub max_changes: Option<u32>,
    /// Whether the outputs, and the links the file holds, must keep exactly their present motions.
    pub keep_output: bool,
    /// The condition on the drives, if the outputs must keep their motions.
    pub drives: Drives,
    /// Mirror symmetry.
    pub symmetry: Symmetry,
    /// Whether it is also asked which variants keep the motion beyond the drawn pose, throughout the motion of the mechanism.
    pub throughout: bool,
    /// Whether variants are counted; where they are not, the diagrams of all are cut down at once.
    pub counted: bool,
    /// How many of the cheapest are to be found even where the diagram of all does not fit the budgets.
    pub cheapest: usize,
    /// The seed of estimates, where counts that do not fit the budgets are estimated.
    pub estimate: Option<u64>,
    /// Node budget of each diagram.
    pub nodes: usize,
    /// Bytes that the search and what is counted on it may hold.
    pub memory: usize,
    /// Second opinions take singular values below this fraction of the largest for zero.
    pub tolerance: f64,
    /// The accuracy of ranks, if exact arithmetic does not have the intended mechanism.
    pub numeric: Option<Digits>,
    /// The mechanism as its file writes it, where coordinates look rounded and exact arithmetic searches all the same.
    pub written: Option<Written>,
}

impl Default for Conditions {
    fn default() -> Self {
        Conditions {
            max_redundant: 0,
            state: None,
            max_mobility: None,
            max_changes: None,
            keep_output: true,
            drives: Drives::Kept,
            symmetry: Symmetry::All,
            throughout: false,
            counted: true,
            cheapest: 0,
            estimate: None,
            nodes: 1_000_000,
            memory: 4 << 30,
            tolerance: DEFAULT_TOLERANCE,
            numeric: None,
            written: None,
        }
    }
}

/// Maximum number of joints in no contour: each adds a link that moves independently, and every step examines all of them.
pub(in crate::search) const OPEN: usize = 200;

/// Why a search could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SearchError {
    /// The geometry has no image in the field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// Symmetry of a mechanism that is not its own mirror image.
    #[error(transparent)]
    Mirror(#[from] MirrorError),
    /// Independent drives are required, but nothing is driven.
    #[error(
        "no joint of the free state is driven, or the outputs may move in other ways: there are no drives to be independent"
    )]
    NoDrives,
    /// Independent drives with what they are not counted with.
    #[error(
        "independent drives are searched in the free state alone, and without redundant constraints left"
    )]
    DrivesBeside,
    /// Outputs that the drives do not decide.
    #[error(
        "the drives do not decide the outputs: with all drives locked the outputs have {motions} of their motions left, and no redesign \
         takes a motion away"
    )]
    UndecidedOutputs {
        /// How many independent motions are left.
        motions: usize,
    },
    /// A choice that lacks a motion of the original joint.
    #[error(
        "{option} at {joint} lacks a motion of the joint as built, and a redesign only adds motions: choose an option that has them all"
    )]
    LosesMotion {
        /// The joint.
        joint: String,
        /// The option.
        option: String,
    },
    /// Chains that close nowhere.
    #[error(
        "{open} joints are in no contour, and a search takes at most {OPEN} of them: they cannot be redundant, so leave such \
         chains out"
    )]
    Open {
        /// How many.
        open: usize,
    },
}

/// A mechanism with its coordinates as a file writes them.
#[derive(Debug, Clone)]
pub struct Written {
    /// It, with the links, joints and options of the one that is searched.
    pub mechanism: Arc<Mechanism>,
    /// What its digits tell.
    pub digits: Digits,
    /// True if each option allows every motion of the original joint.
    pub only_adds: bool,
}
