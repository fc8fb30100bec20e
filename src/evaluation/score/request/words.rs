//! Words of a request that are more than a name or a number, as typed and in JSON.

use crate::model::ranking::Term;
use serde::{Deserialize, Deserializer, de};
use thiserror::Error;

/// An error in a word.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum WordError {
    /// No such term.
    #[error("unknown term \"{0}\"; known: {known}", known = Term::ALL.map(Term::name).join(", "))]
    NoTerm(String),
    /// A weight that is none.
    #[error("{word}: give a weight from 0 to 1e12, such as {term}=1")]
    NoWeight {
        /// All that was typed.
        word: String,
        /// The term.
        term: &'static str,
    },
}

/// Parses a ranking term with its weight: `cost`, or `cost=0.5`.
///
/// ```
/// use ozols_evaluation::score::request::words::weighted_term;
/// assert_eq!(weighted_term("cost=0.5").unwrap().1, 0.5);
/// assert!(weighted_term("speed").is_err());
/// ```
///
/// # Errors
/// Returns an error if there is no such term, or if the weight is not from 0 to 1e12.
pub fn weighted_term(word: &str) -> Result<(Term, f64), WordError> {
    let (name, weight) = match word.split_once('=') {
        Some((name, weight)) => (name, weight.parse().ok()),
        None => (word, Some(1.0)),
    };
    let term = Term::from_name(name).ok_or_else(|| WordError::NoTerm(name.to_owned()))?;
    let weight = weight.filter(|w| (0.0..=1e12).contains(w));
    let weight = weight.ok_or_else(|| WordError::NoWeight {
        word: word.to_owned(),
        term: term.name(),
    })?;
    Ok((term, weight))
}

/// Reads terms with their weights from a list of words.
pub(super) fn weighted_terms<'de, D>(from: D) -> Result<Vec<(Term, f64)>, D::Error>
where
    D: Deserializer<'de>,
{
    let words = Vec::<String>::deserialize(from)?;
    let terms = words.iter().map(|w| weighted_term(w));
    terms.collect::<Result<_, _>>().map_err(de::Error::custom)
}
