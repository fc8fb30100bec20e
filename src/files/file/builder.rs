//! A mechanism built in code.

use crate::file::prelude::*;
use crate::file::problem::ImportError;
use crate::file::text::mechanism_from_str;
use crate::file::write::{freedom_names, role_word};

/// Builds a mechanism joint by joint, with the rules and the messages of a mechanism file.
///
/// Points and axes are whole numbers, decimals, or exact expressions such as `"sqrt(3)/2"`. A link that no call of
/// [`link`](Builder::link) names is an inner link.
///
/// # Examples
/// ```
/// use ozols::{Builder, model::{joint_type::JointType::Revolute, mechanism::Role}};
/// let z = [0, 0, 1];
/// let four_bar = Builder::new("four-bar", "mm")
///     .link("ground", Role::Frame)
///     .link("rocker", Role::Output)
///     .joint("A", ["ground", "crank"], Revolute, [0, 0, 0], z).driven()
///     .joint("B", ["crank", "coupler"], Revolute, [0, 10, 0], z)
///     .joint("C", ["coupler", "rocker"], Revolute, ["30", "10*sqrt(5)", "0"], z)
///     .joint("D", ["rocker", "ground"], Revolute, [30, 0, 0], z)
///     .build()?;
/// assert_eq!(ozols::analyze(&four_bar)?[0].redundant, 3);
///
/// let torn = Builder::new("torn", "m").link("ground", Role::Frame).build();
/// assert!(torn.unwrap_err().to_string().contains("joint"));
/// # Ok::<(), ozols::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Builder {
    file: MechanismFile,
}

impl Builder {
    /// Returns a builder of a mechanism in space with its name and its unit of length: m, mm, cm, um or in.
    #[must_use]
    pub fn new(name: &str, length_unit: &str) -> Builder {
        Builder {
            file: MechanismFile {
                name: name.to_owned(),
                length_unit: Some(length_unit.to_owned()),
                ..MechanismFile::default()
            },
        }
    }

    /// Adds a link.
    #[must_use]
    pub fn link(mut self, id: &str, role: Role) -> Builder {
        self.file.link.push(LinkEntry {
            id: id.to_owned(),
            role: role_word(role).map(str::to_owned),
            ..LinkEntry::default()
        });
        self
    }

    /// Adds a joint between two links, at a point and along an axis.
    #[must_use]
    pub fn joint(
        mut self,
        id: &str,
        links: [&str; 2],
        joint_type: JointType,
        point: [impl Into<Coordinate>; 3],
        axis: [impl Into<Coordinate>; 3],
    ) -> Builder {
        for link in links {
            if !self.file.link.iter().any(|l| l.id == link) {
                self = self.link(link, Role::Inner);
            }
        }
        self.file.joint.push(JointEntry {
            id: id.to_owned(),
            links: links.map(str::to_owned),
            kind: joint_type.name().to_owned(),
            freedoms: freedom_names(&joint_type),
            point: point.map(Into::into),
            axis: Some(axis.map(Into::into)),
            ..JointEntry::default()
        });
        self
    }

    /// Makes the last joint a drive.
    #[must_use]
    pub fn driven(mut self) -> Builder {
        if let Some(joint) = self.file.joint.last_mut() {
            joint.drive = DriveWord::Driven(true);
        }
        self
    }

    /// Sets the joint types that a search may put at every joint except drives.
    #[must_use]
    pub fn options(mut self, types: &[JointType]) -> Builder {
        let word = |t: &JointType| OptionEntry::Word(t.name().to_owned());
        self.file.search.options = types.iter().map(word).collect();
        self
    }

    /// Returns the builder with changes of other keys of the mechanism file: couplings, loads, states, a ranking.
    #[must_use]
    pub fn with(mut self, change: impl FnOnce(&mut MechanismFile)) -> Builder {
        change(&mut self.file);
        self
    }

    /// Returns the mechanism.
    ///
    /// # Errors
    /// Returns every problem of the mechanism, each with its item.
    pub fn build(&self) -> Result<Mechanism, ImportError> {
        let name = format!("{}.json", self.file.name);
        mechanism_from_str(&name, &format!("{:#}", self.file.json()))
    }
}
