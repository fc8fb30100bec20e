//! The changes of a file, and why one cannot be made.

use serde::Deserialize;
use serde_json::Value;
use std::fmt;
use thiserror::Error;

/// An item of a file that has an id.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Thing {
    /// A rigid body.
    Link,
    /// A joint.
    Joint,
    /// A point of interest.
    Point,
}

impl Thing {
    /// Returns the name of its tables.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Thing::Link => "link",
            Thing::Joint => "joint",
            Thing::Point => "point",
        }
    }
}

impl fmt::Display for Thing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// A change.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Edit {
    /// Another text of the whole file.
    Text {
        /// The whole text.
        text: String,
    },
    /// A key of an item gets a value; null removes it.
    Set {
        /// The kind of item.
        what: Thing,
        /// Its id.
        id: String,
        /// The key.
        key: String,
        /// The value.
        value: Value,
    },
    /// A key of the file itself, or of a table in it: `["search", "options"]`.
    Put {
        /// The path of keys.
        path: Vec<String>,
        /// The value; null removes it.
        value: Value,
    },
    /// A further item, after the last of its kind.
    Add {
        /// The kind of item.
        what: Thing,
        /// Its keys.
        entry: serde_json::Map<String, Value>,
    },
    /// Another id, in every place that names it.
    Rename {
        /// The kind of item.
        what: Thing,
        /// Its id.
        id: String,
        /// Its new name.
        to: String,
    },
    /// Items are removed, with the items that name them: joints of a link; pairs, couplings and contours of a joint.
    Remove {
        /// The items.
        items: Vec<(Thing, String)>,
    },
}

/// Why a change cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[allow(
    missing_docs,
    reason = "the wording of each variant says what its fields are"
)]
pub enum EditError {
    #[error("the text is not valid TOML ({why}); fix it or undo")]
    NoToml { why: String },
    #[error("the file has no {what} \"{id}\" any more")]
    Gone { what: Thing, id: String },
    #[error("{what} \"{id}\" already exists; choose another name")]
    Taken { what: Thing, id: String },
    #[error("{what} cannot be written to a file: {why}")]
    NoValue { what: String, why: &'static str },
    #[error(
        "{what} is written as a list of tables within brackets; write each as a separate [[{what}]] to change it here"
    )]
    Inline { what: Thing },
}
