//! Joint types and the freedoms each leaves, in the joint's own frame.

use std::fmt;

/// One freedom of a joint in its own frame (z = axis, x = reference made perpendicular to it, y = z × x).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Freedom {
    /// Rotation about x.
    Rx,
    /// Rotation about y.
    Ry,
    /// Rotation about z.
    Rz,
    /// Translation along x.
    Tx,
    /// Translation along y.
    Ty,
    /// Translation along z.
    Tz,
    /// Rotation about z with a translation of `pitch` per radian along z.
    Screw,
}

impl Freedom {
    /// Every freedom with the word used for it in files.
    pub const ALL: [(Freedom, &'static str); 7] = [
        (Freedom::Rx, "rx"),
        (Freedom::Ry, "ry"),
        (Freedom::Rz, "rz"),
        (Freedom::Tx, "tx"),
        (Freedom::Ty, "ty"),
        (Freedom::Tz, "tz"),
        (Freedom::Screw, "screw"),
    ];

    /// The word used for this freedom in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        Freedom::ALL[self as usize].1
    }

    /// Whether it is a turn; a screw is neither a turn nor a slide.
    #[must_use]
    pub fn turns(self) -> bool {
        matches!(self, Freedom::Rx | Freedom::Ry | Freedom::Rz)
    }

    /// Whether it is a slide.
    #[must_use]
    pub fn slides(self) -> bool {
        matches!(self, Freedom::Tx | Freedom::Ty | Freedom::Tz)
    }

    /// The freedom a word names, if any.
    #[must_use]
    pub fn from_name(word: &str) -> Option<Freedom> {
        Freedom::ALL
            .iter()
            .find(|(_, w)| *w == word)
            .map(|(f, _)| *f)
    }
}

/// The type of a joint.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum JointType {
    /// rz
    Revolute,
    /// tz
    Prismatic,
    /// rz + pitch·tz
    Helical,
    /// rz, tz
    Cylindrical,
    /// rz, rx
    Universal,
    /// rz, tx: a pin in a slot
    Slotted,
    /// rx, ry, rz
    Spherical,
    /// rz, tx, ty
    Planar,
    /// rz, rx, tz
    CylindricalUniversal,
    /// rx, ry, rz, tz
    SphereInCylinder,
    /// rz, rx, tx, ty: z is the plane's normal, x the cylinder's axis
    CylinderOnPlane,
    /// rx, ry, rz, tx, ty
    SphereOnPlane,
    /// none: class VI
    Fixed,
    /// Any list of freedoms.
    Custom(Vec<Freedom>),
}

impl JointType {
    /// The types with a name of their own, in the order of the documentation.
    pub const NAMED: [JointType; 13] = [
        JointType::Revolute,
        JointType::Prismatic,
        JointType::Helical,
        JointType::Cylindrical,
        JointType::Universal,
        JointType::Slotted,
        JointType::Spherical,
        JointType::Planar,
        JointType::CylindricalUniversal,
        JointType::SphereInCylinder,
        JointType::CylinderOnPlane,
        JointType::SphereOnPlane,
        JointType::Fixed,
    ];

    /// The word used for this type in files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            JointType::Revolute => "revolute",
            JointType::Prismatic => "prismatic",
            JointType::Helical => "helical",
            JointType::Cylindrical => "cylindrical",
            JointType::Universal => "universal",
            JointType::Slotted => "slotted",
            JointType::Spherical => "spherical",
            JointType::Planar => "planar",
            JointType::CylindricalUniversal => "cylindrical-universal",
            JointType::SphereInCylinder => "sphere-in-cylinder",
            JointType::CylinderOnPlane => "cylinder-on-plane",
            JointType::SphereOnPlane => "sphere-on-plane",
            JointType::Fixed => "fixed",
            JointType::Custom(_) => "custom",
        }
    }

    /// The named type a word stands for, if any (`custom` needs its freedoms and is not found here).
    #[must_use]
    pub fn from_name(word: &str) -> Option<JointType> {
        JointType::NAMED.iter().find(|t| t.name() == word).cloned()
    }

    /// The freedoms of the type, in the joint's frame.
    #[must_use]
    pub fn freedoms(&self) -> &[Freedom] {
        use Freedom::{Rx, Ry, Rz, Screw, Tx, Ty, Tz};
        match self {
            JointType::Revolute => &[Rz],
            JointType::Prismatic => &[Tz],
            JointType::Helical => &[Screw],
            JointType::Cylindrical => &[Rz, Tz],
            JointType::Universal => &[Rz, Rx],
            JointType::Slotted => &[Rz, Tx],
            JointType::Spherical => &[Rx, Ry, Rz],
            JointType::Planar => &[Rz, Tx, Ty],
            JointType::CylindricalUniversal => &[Rz, Rx, Tz],
            JointType::SphereInCylinder => &[Rx, Ry, Rz, Tz],
            JointType::CylinderOnPlane => &[Rz, Rx, Tx, Ty],
            JointType::SphereOnPlane => &[Rx, Ry, Rz, Tx, Ty],
            JointType::Fixed => &[],
            JointType::Custom(list) => list,
        }
    }

    /// The class of the joint, its number of constraints (6 - freedoms), in Roman numerals as the field writes it.
    #[must_use]
    pub fn class(&self) -> &'static str {
        ["VI", "V", "IV", "III", "II", "I", "0"][self.freedoms().len().min(6)]
    }
}

impl fmt::Display for JointType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
