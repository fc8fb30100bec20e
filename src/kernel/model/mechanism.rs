//! The validated mechanism and its parts.

use crate::format::four_digits;
use crate::geom::expr::Expr;
use crate::geom::extent::box_diagonal;
use crate::geom::vector::{Vector, across, cross, to_vector, unit};
use crate::model::claim::Claim;
use crate::model::joint_type::{Coupling, Freedom, JointType};
use crate::model::loads::{Loads, MassProperties};
use crate::model::ranking::{Ranking, TypeOverride};
use serde_json::Value;
use std::ops::Deref;
use std::sync::Arc;

pub use crate::model::search_spec::{CostSpec, Drives, Expected, SearchSpec};
pub use crate::model::{JointId, LinkId, StateId};

/// Purpose of a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// Fixed to the ground; exactly one link.
    Frame,
    /// Its motion is the working motion.
    Output,
    /// A body handled from outside, such as the clamped part.
    Object,
    /// Any other link.
    Inner,
}

/// A rigid body.
#[derive(Debug, Clone)]
pub struct Link {
    /// The name used in the file.
    pub id: String,
    /// Purpose of the link.
    pub role: Role,
    /// Its mass, if the file states one.
    pub mass: Option<MassProperties>,
}

/// A point fixed to a link that drawings show: the foot of a leg, the face of a jaw.
#[derive(Debug, Clone)]
pub struct PointOfInterest {
    /// The name used in the file.
    pub id: String,
    /// The link that it is fixed to.
    pub link: LinkId,
    /// Its position at the pose of the file, in the file's length unit.
    pub point: [Expr; 3],
}

/// Position and orientation of a joint: z = `axis`, x = `reference` made perpendicular to it, y = z × x.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Origin of the joint, in the file's length unit, global axes.
    pub point: [Expr; 3],
    /// Direction of z; nonzero, of any length.
    pub axis: [Expr; 3],
    /// Direction from which x is computed; nonzero and not parallel to the axis.
    pub reference: [Expr; 3],
    /// Translation along z per radian, for helical joints, in the file's length unit.
    pub pitch: Expr,
}

impl Frame {
    /// Returns its point, axis and reference.
    #[must_use]
    pub fn vectors(&self) -> [&[Expr; 3]; 3] {
        [&self.point, &self.axis, &self.reference]
    }

    /// Returns its point, axis and reference for a change.
    pub(crate) fn vectors_mut(&mut self) -> [&mut [Expr; 3]; 3] {
        [&mut self.point, &mut self.axis, &mut self.reference]
    }

    /// Returns true if two frames are written identically; `false` decides nothing.
    pub fn is_same(&self, other: &Frame) -> bool {
        self.has_same_axis(other)
            && are_same(&self.reference, &other.reference)
            && self.pitch.is_same(&other.pitch)
    }

    /// Returns the unit vectors x, y, z.
    #[must_use]
    pub fn unit_axes(&self) -> [Vector; 3] {
        let z = unit(to_vector(&self.axis));
        let x = unit(across(to_vector(&self.reference), z));
        [x, cross(z, x), z]
    }

    /// Returns true if the points and axes of two frames are written identically; `false` decides nothing.
    pub fn has_same_axis(&self, other: &Frame) -> bool {
        are_same(&self.point, &other.point) && are_same(&self.axis, &other.axis)
    }
}

/// Returns true if two vectors are written identically; `false` decides nothing.
pub(crate) fn are_same(a: &[Expr; 3], b: &[Expr; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.is_same(b))
}

/// A realizable joint that a search may use at a joint.
#[derive(Debug, Clone)]
pub struct JointOption {
    /// The word shown in results; unique among the options of one joint.
    pub name: String,
    /// The type.
    pub joint_type: JointType,
    /// The frame at this joint (its own `reference` or `pitch` may differ from the original joint's).
    pub frame: Frame,
    /// The option's own cost in thousandths, if the file states one.
    pub cost_milli: Option<i64>,
    /// The state whose search offers it, or `None` for any search.
    pub state: Option<StateId>,
}

impl JointOption {
    /// Creates a type in the frame of a joint, by the name of the type, for any search.
    #[must_use]
    pub fn in_frame_of(joint: &Joint, joint_type: &JointType) -> JointOption {
        JointOption {
            name: joint_type.name().to_owned(),
            joint_type: joint_type.clone(),
            frame: joint.frame.clone(),
            cost_milli: None,
            state: None,
        }
    }
}

/// A joint between two links. Its twist is the motion of `links[1]` relative to `links[0]`.
#[derive(Debug, Clone)]
pub struct Joint {
    /// The name used in the file.
    pub id: String,
    /// The two links.
    pub links: [LinkId; 2],
    /// The original type.
    pub joint_type: JointType,
    /// Position and orientation.
    pub frame: Frame,
    /// Whether the mechanism is driven here.
    pub drive: bool,
    /// The driven freedom of a driven joint, if the file names it.
    pub drive_freedom: Option<Freedom>,
    /// The states the joint is present in; `None` for all of them.
    pub states: Option<Vec<StateId>>,
    /// Joint types the search may use here, the original first. Contains only the original if the joint must not
    /// change.
    pub options: Vec<JointOption>,
    /// Unloading joints that a search may insert in series here, with an extra link. Empty if not allowed.
    pub unloading: Vec<JointOption>,
}

impl Joint {
    /// Returns true if it is present in a state.
    #[must_use]
    pub fn is_in(&self, state: StateId) -> bool {
        self.states.as_ref().is_none_or(|s| s.contains(&state))
    }

    /// Returns the options that a search may use or insert here.
    pub fn offered_options(&self) -> impl Iterator<Item = &JointOption> {
        self.options.iter().chain(&self.unloading)
    }
}

/// Whether motions are spatial or confined to a plane.
#[derive(Debug, Clone)]
pub enum Mode {
    /// Six rows per contour.
    Spatial,
    /// Three rows per contour: rotation about `normal` and the two translations perpendicular to it.
    Planar {
        /// Normal of the plane of motion.
        normal: [Expr; 3],
    },
}

/// A unit of length, for labels; calculations are done in the file's own unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LengthUnit {
    /// The symbol, such as `mm`.
    pub symbol: &'static str,
    /// Metres in one unit.
    pub metres: f64,
}

impl LengthUnit {
    /// Returns a length in metres in this unit, with its symbol: "12.5 mm".
    #[must_use]
    pub fn format_metres(&self, metres: f64) -> String {
        format!("{} {}", four_digits(metres / self.metres), self.symbol)
    }
}

/// The parts of a mechanism, which may contradict each other until [`Mechanism::new`] has checked them.
#[derive(Debug, Clone)]
pub struct Parts {
    /// Short name.
    pub name: String,
    /// One or two sentences for display.
    pub description: String,
    /// Sources of the mechanism and its figures.
    pub sources: Vec<String>,
    /// Unit of all lengths.
    pub length_unit: LengthUnit,
    /// Spatial or planar.
    pub mode: Mode,
    /// The links.
    pub links: Vec<Link>,
    /// The joints.
    pub joints: Vec<Joint>,
    /// Joints that move in a fixed ratio, in file order.
    pub couplings: Vec<Coupling>,
    /// Names of the states; the first is `free`.
    pub states: Vec<String>,
    /// The contour basis named in the file, as lists of joints, if any.
    pub contours: Vec<Vec<JointId>>,
    /// Search settings of the file.
    pub search: SearchSpec,
    /// Loads and drive.
    pub loads: Loads,
    /// Ranking of variants, if the file states one.
    pub ranking: Option<Ranking>,
    /// Properties of joint types stated in the file.
    pub joint_types: Vec<TypeOverride>,
    /// Points of interest.
    pub points: Vec<PointOfInterest>,
    /// Known figures.
    pub expected: Vec<Expected>,
    /// Claims of publications about it, correct or not.
    pub claims: Vec<Claim>,
    /// Assumptions and omissions of the reader of another format, one sentence each. The figures are those of the file
    /// as read.
    pub assumed: Vec<String>,
    /// Workload, ranking, figures and claims as the tables of the file, which are written back. Null if it has no file.
    pub tables: Arc<Value>,
}

/// A validated mechanism: parts that cannot be changed, with the guarantees of [`Mechanism::new`].
///
/// The fields of [`Parts`] are read as its own. To change a mechanism, take it apart with [`Mechanism::into_parts`].
///
/// # Examples
/// ```
/// let gripper = ozols::built_in("gripper-10")?;
/// assert_eq!(gripper.joints_in(gripper.state_ids().next().unwrap()).count(), 13);
/// assert_eq!(gripper.links[gripper.frame_link()].id, "0");
/// # Ok::<(), ozols::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mechanism(pub(in crate::model) Parts);

impl Deref for Mechanism {
    type Target = Parts;

    fn deref(&self) -> &Parts {
        &self.0
    }
}

impl Mechanism {
    /// Returns the parts, to change them.
    #[must_use]
    pub fn into_parts(self) -> Parts {
        self.0
    }

    /// Creates a mechanism of parts that have the guarantees of [`Mechanism::new`].
    pub(crate) fn of_valid(parts: Parts) -> Mechanism {
        Mechanism(parts)
    }

    /// Returns the parts for a change that keeps the guarantees of [`Mechanism::new`].
    pub(crate) fn parts_mut(&mut self) -> &mut Parts {
        &mut self.0
    }
}

impl From<&Mechanism> for Arc<Mechanism> {
    fn from(mechanism: &Mechanism) -> Self {
        Arc::new(mechanism.clone())
    }
}

impl Parts {
    /// Returns the ids of the links, in file order.
    pub fn link_ids(
        &self,
    ) -> impl DoubleEndedIterator<Item = LinkId> + ExactSizeIterator + Clone + use<> {
        LinkId::first(self.links.len())
    }

    /// Returns the ids of the joints, in file order.
    pub fn joint_ids(
        &self,
    ) -> impl DoubleEndedIterator<Item = JointId> + ExactSizeIterator + Clone + use<> {
        JointId::first(self.joints.len())
    }

    /// Returns the ids of the states, the free one first.
    pub fn state_ids(
        &self,
    ) -> impl DoubleEndedIterator<Item = StateId> + ExactSizeIterator + Clone + use<> {
        StateId::first(self.states.len())
    }

    /// Returns the links with their ids, in file order.
    pub fn links_with_ids(&self) -> impl Iterator<Item = (LinkId, &Link)> {
        self.link_ids().zip(&self.links)
    }

    /// Returns the joints with their ids, in file order.
    pub fn joints_with_ids(&self) -> impl Iterator<Item = (JointId, &Joint)> {
        self.joint_ids().zip(&self.joints)
    }

    /// Returns the first option of a name that a search may use or insert at any joint.
    #[must_use]
    pub fn option_named(&self, name: &str) -> Option<&JointOption> {
        let mut all = self.joints.iter().flat_map(Joint::offered_options);
        all.find(|o| o.name == name)
    }

    /// Returns the diagonal of the box around the joints, in the file's unit.
    ///
    /// # Examples
    /// ```
    /// // The joints are at (0, 0), (0, 30), (80, 90) and (120, 0), in mm.
    /// assert_eq!(ozols::built_in("four-bar")?.distance_across(), 150.0);
    /// # Ok::<(), ozols::Error>(())
    /// ```
    #[must_use]
    pub fn distance_across(&self) -> f64 {
        box_diagonal(self.joints.iter().map(|j| to_vector(&j.frame.point)))
    }

    /// Returns the states' names with their ids, the free one first.
    pub fn states_with_ids(&self) -> impl Iterator<Item = (StateId, &String)> {
        self.state_ids().zip(&self.states)
    }

    /// Returns the joints present in a state, in file order.
    pub fn joints_in(&self, state: StateId) -> impl Iterator<Item = JointId> + '_ {
        self.joint_ids()
            .filter(move |&j| self.joints[j].is_in(state))
    }

    /// Returns the joints of a link that are present in a state, in file order.
    pub fn joints_at(&self, link: LinkId, state: StateId) -> impl Iterator<Item = JointId> + '_ {
        self.joints_in(state)
            .filter(move |&j| self.joints[j].links.contains(&link))
    }

    /// Returns the joints that a state has and the free one does not, in file order.
    pub fn joints_added_in(&self, state: StateId) -> impl Iterator<Item = JointId> + '_ {
        let only_here = |j: &JointId| !self.joints[*j].is_in(StateId::FREE);
        self.joints_in(state).filter(only_here)
    }

    /// Returns the links that have a joint in a state, in file order.
    pub fn links_in(&self, state: StateId) -> impl Iterator<Item = LinkId> + '_ {
        let mut present = vec![false; self.links.len()];
        let ends = self.joints_in(state).flat_map(|j| self.joints[j].links);
        ends.for_each(|l| present[l.index()] = true);
        self.link_ids().filter(move |l| present[l.index()])
    }

    /// Returns the couplings of a state, those whose joints are present in it, in file order.
    pub fn couplings_in(&self, state: StateId) -> impl Iterator<Item = &Coupling> + '_ {
        let present = move |j: JointId| self.joints[j].is_in(state);
        self.couplings
            .iter()
            .filter(move |c| c.ends.iter().all(|e| present(e.joint)))
    }

    /// Returns the couplings of a joint, by index, each with the end at this joint.
    pub fn couplings_of(&self, joint: JointId) -> impl Iterator<Item = (usize, usize)> + '_ {
        let of = move |(q, c): (usize, &Coupling)| Some((q, c.end_at(joint)?));
        self.couplings.iter().enumerate().filter_map(of)
    }

    /// Returns the frame link.
    ///
    /// # Panics
    /// Never panics, because a validated mechanism has a frame.
    #[must_use]
    pub fn frame_link(&self) -> LinkId {
        self.link_ids()
            .find(|&l| self.links[l].role == Role::Frame)
            .expect("a validated mechanism has a frame")
    }

    /// Returns true if the pitch of a screw contains π as decimals, so that nothing about the mechanism is exact.
    #[must_use]
    pub fn has_pi(&self) -> bool {
        self.joints.iter().any(|j| j.frame.pitch.has_pi())
    }

    /// Returns "frame 0", for display. A link with the id "frame" is not named twice.
    #[must_use]
    pub fn frame_words(&self) -> String {
        match self.links[self.frame_link()].id.as_str() {
            "frame" => "frame".to_owned(),
            id => format!("frame {id}"),
        }
    }

    /// Returns the link with this id.
    #[must_use]
    pub fn link_named(&self, id: &str) -> Option<LinkId> {
        self.link_ids().find(|&l| self.links[l].id == id)
    }

    /// Returns the state with this name.
    #[must_use]
    pub fn state_named(&self, name: &str) -> Option<StateId> {
        self.state_ids().find(|&s| self.states[s] == name)
    }

    /// Returns the joint with this id.
    #[must_use]
    pub fn joint_named(&self, id: &str) -> Option<JointId> {
        self.joint_ids().find(|&j| self.joints[j].id == id)
    }
}

impl Coupling {
    /// Returns its name for display: the two joints, each with its freedom if it has several.
    #[must_use]
    pub fn name(&self, mechanism: &Parts) -> String {
        let [a, b] = self.ends.map(|e| {
            let joint = &mechanism.joints[e.joint];
            match joint.joint_type.freedoms() {
                [_] => joint.id.clone(),
                _ => format!("{}:{}", joint.id, e.freedom.name()),
            }
        });
        format!("{a} ~ {b}")
    }
}
