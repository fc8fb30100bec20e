//! What is known, or why it is not.

use serde::{Deserialize, Serialize};

/// Something that is known, or why it is not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Known<T> {
    /// Why not.
    Not {
        /// In words.
        unknown: String,
    },
    /// It.
    Yes(T),
}

impl<T> Known<T> {
    /// It, where it is known.
    pub fn get(&self) -> Option<&T> {
        match self {
            Known::Yes(found) => Some(found),
            Known::Not { .. } => None,
        }
    }

    /// Why it is not.
    pub fn why(&self) -> Option<&str> {
        match self {
            Known::Yes(_) => None,
            Known::Not { unknown } => Some(unknown),
        }
    }

    pub(super) fn of<E: ToString>(found: Result<T, E>) -> Known<T> {
        match found {
            Ok(found) => Known::Yes(found),
            Err(why) => Known::Not {
                unknown: why.to_string(),
            },
        }
    }
}
