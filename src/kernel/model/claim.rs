//! Claims of a publication about the mechanism it shows, and whether they hold.

use serde::ser::{Serialize, SerializeStruct, Serializer};

/// Topic of a claim, which determines the command that reproduces it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// Mobility and redundant constraints: `ozols analyze`.
    Structure,
    /// Loads that a gripper can hold: `ozols grip`.
    Grip,
    /// A torsional drive: `ozols drive`.
    Drive,
    /// Reactions of joints: `ozols statics`.
    Statics,
}

impl Topic {
    /// All topics.
    pub const ALL: [Topic; 4] = [Topic::Structure, Topic::Grip, Topic::Drive, Topic::Statics];

    /// Returns the word in files.
    #[must_use]
    pub fn as_word(self) -> &'static str {
        match self {
            Topic::Structure => "structure",
            Topic::Grip => "grip",
            Topic::Drive => "drive",
            Topic::Statics => "statics",
        }
    }
}

/// A claim of a publication. It is in the file of the mechanism that the publication shows, so that it is never applied
/// to another mechanism.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The topic.
    pub topic: Topic,
    /// The publication and the place in it.
    pub source: String,
    /// The statement made there.
    pub says: String,
    /// The correct statement, or `None` if the claim holds.
    pub right: Option<String>,
    /// The part of a scanned text that a refutation depends on, if a misread letter would explain it; `None` otherwise.
    pub scan: Option<String>,
    /// The evidence for it.
    pub evidence: String,
}

impl Claim {
    /// Returns true if the claim holds.
    ///
    /// # Examples
    /// ```
    /// let gripper = ozols::built_in("gripper-10")?;
    /// // Of 21 claims of its publication 19 hold.
    /// assert_eq!((gripper.claims.len(), gripper.claims.iter().filter(|c| c.holds()).count()), (21, 19));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    #[must_use]
    pub fn holds(&self) -> bool {
        self.right.is_none()
    }
}

impl Serialize for Claim {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut out = serializer.serialize_struct("Claim", 6)?;
        out.serialize_field("source", &self.source)?;
        out.serialize_field("claim", &self.says)?;
        out.serialize_field("holds", &self.holds())?;
        out.serialize_field("right", &self.right)?;
        out.serialize_field("scan", &self.scan)?;
        out.serialize_field("evidence", &self.evidence)?;
        out.end()
    }
}
