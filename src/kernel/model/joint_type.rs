//! Joint types and the freedoms each leaves, in the joint's own frame. Also couplings: joints that move in a fixed
//! ratio, such as gears, belts, racks and mimic joints.

use crate::geom::expr::Expr;
use crate::model::JointId;
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

    /// Returns the word used for this freedom in files.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::Freedom;
    /// assert_eq!(Freedom::Rz.name(), "rz");
    /// assert_eq!(Freedom::from_name("screw"), Some(Freedom::Screw));
    /// assert!(Freedom::Rz.is_turn() && Freedom::Tx.is_slide());
    /// ```
    #[must_use]
    pub fn name(self) -> &'static str {
        Freedom::ALL[self as usize].1
    }

    /// Returns true if it is a turn; a screw is neither a turn nor a slide.
    #[must_use]
    pub fn is_turn(self) -> bool {
        matches!(self, Freedom::Rx | Freedom::Ry | Freedom::Rz)
    }

    /// Returns true if it is a slide.
    #[must_use]
    pub fn is_slide(self) -> bool {
        matches!(self, Freedom::Tx | Freedom::Ty | Freedom::Tz)
    }

    /// Returns the place, among the axes x, y, z of the joint's frame, of the axis that it turns about or slides along.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::Freedom;
    /// assert_eq!([Freedom::Tx, Freedom::Ry, Freedom::Screw].map(Freedom::axis), [0, 1, 2]);
    /// ```
    #[must_use]
    pub fn axis(self) -> usize {
        match self {
            Freedom::Rx | Freedom::Tx => 0,
            Freedom::Ry | Freedom::Ty => 1,
            Freedom::Rz | Freedom::Tz | Freedom::Screw => 2,
        }
    }

    /// Returns the freedom that a word names, if any.
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
    /// Returns true if the direction of its axis matters, which is not so for a ball.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::JointType;
    /// assert!(JointType::Revolute.is_directed());
    /// assert!(!JointType::Spherical.is_directed()); // A ball has no axis.
    /// ```
    #[must_use]
    pub fn is_directed(&self) -> bool {
        let freedoms = self.freedoms();
        let turns = freedoms.iter().filter(|f| f.is_turn()).count();
        !freedoms.is_empty() && (turns < 3 || freedoms.len() > 3)
    }

    /// Returns true if its second axis matters. Turns about both transverse axes, or slides along both, are the same
    /// for any direction of x.
    #[must_use]
    pub fn has_second_axis(&self) -> bool {
        let across =
            |f: &Freedom| matches!(f, Freedom::Rx | Freedom::Ry | Freedom::Tx | Freedom::Ty);
        let freedoms = self.freedoms();
        let pair = |a, b| freedoms.contains(&a) == freedoms.contains(&b);
        self.is_directed()
            && freedoms.iter().any(across)
            && !(pair(Freedom::Rx, Freedom::Ry) && pair(Freedom::Tx, Freedom::Ty))
    }

    /// The types with their own names, in the order of the documentation.
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

    /// Returns the words of all types in files.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::JointType;
    /// assert_eq!(JointType::all_words().count(), 14); // 13 named types and `custom`
    /// ```
    pub fn all_words() -> impl Iterator<Item = &'static str> {
        let custom = JointType::Custom(Vec::new()).properties_of().0;
        let named = JointType::NAMED.iter().map(JointType::name);
        named.chain([custom])
    }

    /// Returns the properties of each type: its word, its freedoms in the joint's frame, and its default cost.
    fn properties_of(&self) -> (&'static str, &[Freedom], i64) {
        use Freedom::{Rx, Ry, Rz, Screw, Tx, Ty, Tz};
        match self {
            JointType::Revolute => ("revolute", &[Rz], 1000),
            JointType::Prismatic => ("prismatic", &[Tz], 2000),
            JointType::Helical => ("helical", &[Screw], 3000),
            JointType::Cylindrical => ("cylindrical", &[Rz, Tz], 1500),
            JointType::Universal => ("universal", &[Rz, Rx], 2500),
            JointType::Slotted => ("slotted", &[Rz, Tx], 1500),
            JointType::Spherical => ("spherical", &[Rx, Ry, Rz], 2000),
            JointType::Planar => ("planar", &[Rz, Tx, Ty], 2500),
            JointType::CylindricalUniversal => ("cylindrical-universal", &[Rz, Rx, Tz], 3500),
            JointType::SphereInCylinder => ("sphere-in-cylinder", &[Rx, Ry, Rz, Tz], 4000),
            JointType::CylinderOnPlane => ("cylinder-on-plane", &[Rz, Rx, Tx, Ty], 2000),
            JointType::SphereOnPlane => ("sphere-on-plane", &[Rx, Ry, Rz, Tx, Ty], 1500),
            JointType::Fixed => ("fixed", &[], 500),
            // The cost of a revolute joint, and more for each freedom beyond the first.
            JointType::Custom(list) => {
                let more = i64::try_from(list.len()).unwrap_or(0) - 1;
                ("custom", list, 1000 + JointType::CUSTOM_FREEDOM * more)
            }
        }
    }

    /// Default cost of each freedom of a custom joint beyond the first, in thousandths of a revolute joint's.
    pub const CUSTOM_FREEDOM: i64 = 750;

    /// Returns the word used for this type in files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.properties_of().0
    }

    /// Returns the default cost in thousandths of a revolute joint's: an order of magnitude for machined parts.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::JointType;
    /// // A ball joint costs as much as two hinges.
    /// assert_eq!(JointType::Spherical.default_cost_milli(), 2 * JointType::Revolute.default_cost_milli());
    /// ```
    #[must_use]
    pub fn default_cost_milli(&self) -> i64 {
        self.properties_of().2
    }

    /// Classes of sets of freedoms that are not a joint type: hardware along any axis of the joint's frame, and the number of freedoms.
    pub const CLASSES: [&str; 9] = [
        "wire-flexure",
        "blade-flexure",
        "floating-nut",
        "ball-in-v-groove",
        "freedoms-1",
        "freedoms-2",
        "freedoms-3",
        "freedoms-4",
        "freedoms-5",
    ];

    /// Names of the trade, each with the word of the one type that it means.
    pub const TRADE_NAMES: [(&str, &str); 21] = [
        ("hinge", "revolute"),
        ("pin", "revolute"),
        ("slider", "prismatic"),
        ("slide", "prismatic"),
        ("rail", "prismatic"),
        ("screw", "helical"),
        ("lead-screw", "helical"),
        ("bush", "cylindrical"),
        ("sliding-pin", "cylindrical"),
        ("cardan", "universal"),
        ("hooke", "universal"),
        ("gimbal", "universal"),
        ("ball", "spherical"),
        ("rod-end", "spherical"),
        ("pin-in-slot", "slotted"),
        ("flat", "planar"),
        ("ball-in-tube", "sphere-in-cylinder"),
        ("roller-on-plane", "cylinder-on-plane"),
        ("ball-on-plane", "sphere-on-plane"),
        ("weld", "fixed"),
        ("rigid", "fixed"),
    ];

    /// Returns the names of the trade that mean this type.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::JointType;
    /// let names: Vec<&str> = JointType::Revolute.trade_names().collect();
    /// assert_eq!(names, ["hinge", "pin"]);
    /// ```
    pub fn trade_names(&self) -> impl Iterator<Item = &'static str> {
        let own = self.name();
        let all = JointType::TRADE_NAMES.into_iter();
        all.filter(move |(_, word)| *word == own)
            .map(|(name, _)| name)
    }

    /// Returns the word of the type that a trade name means; any other name unchanged.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::JointType;
    /// assert_eq!(JointType::word_of_trade("cardan"), "universal");
    /// assert_eq!(JointType::word_of_trade("revolute"), "revolute");
    /// ```
    #[must_use]
    pub fn word_of_trade(name: &str) -> &str {
        let meant = JointType::TRADE_NAMES
            .iter()
            .find(|(trade, _)| *trade == name);
        meant.map_or(name, |(_, word)| word)
    }

    /// Returns the named type with this word or trade name, if any (`custom` needs its freedoms and is not found here).
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::JointType;
    /// assert_eq!(JointType::from_name("ball"), Some(JointType::Spherical));
    /// ```
    #[must_use]
    pub fn from_name(name: &str) -> Option<JointType> {
        let word = JointType::word_of_trade(name);
        JointType::NAMED.iter().find(|t| t.name() == word).cloned()
    }

    /// Returns the freedoms of the type, in the joint's frame.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::{Freedom, JointType};
    /// let pin = JointType::from_name("cylindrical").unwrap();
    /// assert_eq!(pin.freedoms(), [Freedom::Rz, Freedom::Tz]);
    /// ```
    #[must_use]
    pub fn freedoms(&self) -> &[Freedom] {
        self.properties_of().1
    }

    /// Returns the freedoms in the order of passage from the first link to the second, as in `motion::pose`. Slides
    /// come first, but a slot (a slide along x and none along y) comes after its pin.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::{Freedom, JointType};
    /// // The pin of a slotted joint turns in what slides.
    /// assert_eq!(JointType::Cylindrical.freedoms_in_series(), [Freedom::Tz, Freedom::Rz]);
    /// assert_eq!(JointType::Slotted.freedoms_in_series(), [Freedom::Rz, Freedom::Tx]);
    /// ```
    #[must_use]
    pub fn freedoms_in_series(&self) -> Vec<Freedom> {
        let mut passed = self.freedoms().to_vec();
        let slot = passed.contains(&Freedom::Tx) && !passed.contains(&Freedom::Ty);
        passed.sort_by_key(|f| f.is_slide() == slot);
        passed
    }

    /// Returns the class of the joint, its number of constraints (6 - freedoms), in Roman numerals as is usual in the
    /// field.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::joint_type::JointType;
    /// // The class is the number of constraints: five of a hinge, three of a ball.
    /// assert_eq!(JointType::Revolute.class_numeral(), "V");
    /// assert_eq!(JointType::Spherical.class_numeral(), "III");
    /// ```
    #[must_use]
    pub fn class_numeral(&self) -> &'static str {
        ["VI", "V", "IV", "III", "II", "I", "0"][self.freedoms().len().min(6)]
    }
}

impl fmt::Display for JointType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One of the two freedoms that a coupling connects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CoupledFreedom {
    /// The joint.
    pub joint: JointId,
    /// Its freedom, in the joint's frame.
    pub freedom: Freedom,
}

/// Two freedoms of two joints that move in a fixed ratio: rate of the second = ratio · rate of the first.
///
/// Rates are in radians and in the file's length unit, independent of the length of the axis in the file. So the ratio
/// of a rack and its pinion is a length per radian. The ratio also holds for positions and does not change along the
/// motion.
#[derive(Debug, Clone)]
pub struct Coupling {
    /// The two freedoms, of different joints that are present in the same states.
    pub ends: [CoupledFreedom; 2],
    /// The nonzero ratio.
    pub ratio: Expr,
    /// Whether it is a pair of gears, or a rack and pinion, so that it can be drawn as pitch circles.
    pub gear: bool,
}

impl Coupling {
    /// Returns the index of the end at a joint, if there is one.
    #[must_use]
    pub fn end_at(&self, joint: JointId) -> Option<usize> {
        self.ends.iter().position(|e| e.joint == joint)
    }
}
