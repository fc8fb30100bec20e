//! Search settings and known figures.

use crate::model::joint_type::CoupledFreedom;
use crate::model::{JointId, LinkId};
use serde::Deserialize;

/// Stated figures of a mechanism, with their source.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Expected {
    /// Name of the state.
    pub state: String,
    /// W at the pose of the file.
    pub mobility: Option<i64>,
    /// Finite mobility; smaller than at the pose if the pose is singular or shaky.
    pub finite_mobility: Option<i64>,
    /// Dimension of the output links' motion.
    pub working_mobility: Option<i64>,
    /// W less the working mobility.
    pub local_mobility: Option<i64>,
    /// σ of the whole mechanism.
    pub redundant: Option<i64>,
    /// σ that the state adds to the free one.
    pub external_redundant: Option<i64>,
    /// Publication or derivation.
    pub source: String,
}

/// Costs that the search adds up, in thousandths; see `score::cost` for the defaults.
#[derive(Debug, Clone, Default)]
pub struct CostSpec {
    /// Cost of a joint type by its name.
    pub by_type_milli: Vec<(String, i64)>,
    /// Cost of changing a joint at all.
    pub change_milli: Option<i64>,
    /// Cost of the extra link of an unloading joint.
    pub link_milli: Option<i64>,
    /// Additional cost of changing a driven joint.
    pub driven_milli: Option<i64>,
    /// Cost of a harmful redundant constraint that a searched state adds.
    pub harmful_milli: Option<i64>,
}

impl CostSpec {
    /// Default cost of a link, in thousandths of a revolute joint.
    pub const LINK_MILLI: i64 = 1000;

    /// Returns the costs that do not belong to a joint type, by the names that a file gives them.
    pub fn other_costs(&mut self) -> [(&'static str, &mut Option<i64>); 4] {
        [
            ("change", &mut self.change_milli),
            ("driven", &mut self.driven_milli),
            ("link", &mut self.link_milli),
            ("harmful", &mut self.harmful_milli),
        ]
    }
}

/// The condition on the drives of a redesign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Drives {
    /// Outputs and drives move together as in the mechanism as built.
    #[default]
    Kept,
    /// The outputs alone must keep their motion.
    Free,
    /// There are as many motions of the outputs as drives, and the drives decide them: each drive moves freely, and with all of them
    /// locked the outputs rest.
    Independent,
}

impl Drives {
    /// All, the default first.
    pub const ALL: [Drives; 3] = [Drives::Kept, Drives::Free, Drives::Independent];

    /// Returns the word in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Drives::Kept => "kept",
            Drives::Free => "free",
            Drives::Independent => "independent",
        }
    }
}

/// Search settings of the file.
#[derive(Debug, Clone, Default)]
pub struct SearchSpec {
    /// Links, in addition to the outputs, that must not gain a motion.
    pub hold: Vec<LinkId>,
    /// Pairs of joints that are mirror images of each other.
    pub mirror: Vec<(JointId, JointId)>,
    /// Joints that map to each other when the mechanism is turned, each to the next and the last to the first: two by
    /// half a turn, three by a third. Not allowed together with mirror images.
    pub turn: Vec<Vec<JointId>>,
    /// Whether the images are off by no more than the digits of rounded coordinates. It is set by a search, not by a file.
    pub nearly_symmetric: bool,
    /// Largest number of redundant constraints that may be left within the mechanism.
    pub max_redundant: u32,
    /// Largest mobility W allowed.
    pub max_mobility: Option<i64>,
    /// Whether only variants are wanted that are their own mirror image.
    pub symmetric: bool,
    /// Condition on the drives.
    pub drive_rule: Drives,
    /// Whether variants need to keep the motion in the drawn pose only.
    pub pose_only: bool,
    /// Costs.
    pub costs: CostSpec,
    /// The driven freedoms that a search follows, in addition to the motions of outputs. They are set by a search, not
    /// by a file.
    pub drives: Vec<CoupledFreedom>,
    /// Whether the search locks these freedoms, so that their rates are further closure equations. Otherwise it keeps
    /// their motion.
    pub locks_drives: bool,
}

impl SearchSpec {
    /// Returns the joint that another maps to by the mechanism's symmetry, or the joint itself if none is stated.
    #[must_use]
    pub fn image_of_joint(&self, j: JointId) -> JointId {
        let pairs = self.mirror.iter().flat_map(|&(a, b)| [(a, b), (b, a)]);
        let next = |g: &Vec<JointId>| {
            let at = g.iter().position(|&x| x == j)?;
            Some(g[(at + 1) % g.len()])
        };
        let by_turn = self.turn.iter().find_map(next);
        let by_mirror = pairs.into_iter().find(|p| p.0 == j).map(|p| p.1);
        by_mirror.or(by_turn).unwrap_or(j)
    }

    /// Returns the order of the symmetry, after which all joints are back in place; 1 if there is none.
    #[must_use]
    pub fn symmetry_order(&self) -> usize {
        match (self.mirror.is_empty(), self.turn.first()) {
            (false, _) => 2,
            (true, Some(group)) => group.len(),
            (true, None) => 1,
        }
    }
}
