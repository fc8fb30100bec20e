//! Why a catalogue cannot be as it is specified.

use thiserror::Error;

/// Most links of a structure: with more there are millions of structures.
pub(crate) const MOST_LINKS: usize = 12;

/// Most links of a structure with pairs.
pub(crate) const MOST_PAIRED: usize = 8;

/// What is wrong with a specification.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SpecError {
    /// A word that means nothing here.
    #[error("{what}: {word:?} is none of {}", known.join(", "))]
    Word {
        /// The key.
        what: &'static str,
        /// The word.
        word: String,
        /// The words there are.
        known: Vec<String>,
    },
    /// Links that are no range.
    #[error(
        "links: {0:?} is not a range of even numbers from 4 to {MOST_LINKS}, such as 4..8: chains of mobility 1 have an even number of links; \
         with gears and slots any number from 3 to {MOST_PAIRED}"
    )]
    Links(String),
    /// Too many links for pairs.
    #[error(
        "links: structures with pairs, or hinges on one pin, have {MOST_PAIRED} links at most: there are too many beyond; with three jaws \
         leave generic_pairs (--generic-pairs) out for more"
    )]
    PairedLinks,
    /// Pairs in a form that they are not laid out in.
    #[error(
        "pairs: structures with pairs are symmetric: ask for mirror or half-turn among the symmetries, for \
         generic with generic_pairs (--generic-pairs), or with three jaws for threefold"
    )]
    PairedForms,
    /// Free layouts that no symmetry asked for allows.
    #[error(
        "generic_pairs: nothing is laid out freely without generic among the symmetries: add it (--symmetry generic), or leave \
         generic_pairs (--generic-pairs) out"
    )]
    Freely,
    /// A number out of its range.
    #[error("{what} must be from {from} to {to}")]
    Range {
        /// The key.
        what: &'static str,
        /// The least.
        from: i64,
        /// The greatest.
        to: i64,
    },
    /// Nothing to score ideas under.
    #[error(
        "workload: nothing acts on the gripper; give closing, or gravity with part or link_mass"
    )]
    NoLoad,
    /// What structures of three jaws do not have.
    #[error("{0}: of structures with two jaws alone: leave it out, or ask for two (--jaws 2)")]
    TwoJaws(&'static str),
    /// A part that is wider than the widest.
    #[error("narrowest must be less than widest by a millimetre at least")]
    Widths,
    /// No form is left.
    #[error(
        "no layout is asked for: with two jaws a mirror image needs a slide and half a turn a turning input; three jaws are \
         generic or threefold, and stand on parallelograms where each side is in a plane of its own, threefold with a slide"
    )]
    Nothing,
}

impl SpecError {
    /// The key that is wrong, where it is one.
    #[must_use]
    pub fn key(&self) -> Option<&'static str> {
        match self {
            SpecError::Word { what, .. }
            | SpecError::Range { what, .. }
            | SpecError::TwoJaws(what) => Some(what),
            SpecError::Links(_) | SpecError::PairedLinks => Some("links"),
            SpecError::PairedForms => Some("pairs"),
            SpecError::Freely => Some("generic_pairs"),
            SpecError::NoLoad => Some("closing"),
            SpecError::Nothing => Some("symmetries"),
            SpecError::Widths => Some("narrowest"),
        }
    }
}
