//! What a publication says of the mechanism it shows, and whether that is so.

use serde::ser::{Serialize, SerializeStruct, Serializer};

/// What a claim is about, and so which command repeats it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// Mobility and redundant constraints: `ozols analyze`.
    Structure,
    /// What a gripper can hold: `ozols grip`.
    Grip,
    /// A torsional drive: `ozols drive`.
    Drive,
    /// Reactions of joints: `ozols statics`.
    Statics,
}

impl Topic {
    /// All of them.
    pub const ALL: [Topic; 4] = [Topic::Structure, Topic::Grip, Topic::Drive, Topic::Statics];

    /// The word in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Topic::Structure => "structure",
            Topic::Grip => "grip",
            Topic::Drive => "drive",
            Topic::Statics => "statics",
        }
    }
}

/// A claim of a publication. It stands in the file of the mechanism that the publication shows, so that nothing of it is told
/// of any other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// What it is about.
    pub topic: Topic,
    /// The publication and the place in it.
    pub source: String,
    /// What is said there.
    pub says: String,
    /// What is right instead; `None` where the claim holds.
    pub right: Option<String>,
    /// The part of a scanned text that a refutation rests on, where a misread letter would explain it; `None` elsewhere.
    pub scan: Option<String>,
    /// What that rests on.
    pub evidence: String,
}

impl Claim {
    /// Whether it is so.
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
