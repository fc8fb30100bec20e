//! The places of the parts of a mechanism in its description.

use crate::file::problem::line_and_column;
use crate::format::three_digits;
use crate::motion::follow::column_unit;
use crate::motion::pose::Pose;
use crate::robots::cad;
use crate::robots::cad::archive::Archive;
use crate::robots::prelude::*;

/// The description that a mechanism was read from, and the elements of the mechanism's parts.
#[derive(Debug, Clone)]
pub struct Origin {
    pub(in crate::robots) document: Document,
    /// The archive that it is a member of.
    pub(in crate::robots) archive: Option<Archive>,
    /// The root element.
    pub(in crate::robots) root: usize,
    pub(in crate::robots) robot: Robot,
    /// Places of the robot's links in the pose found.
    pub(in crate::robots) places: Vec<RigidMotion>,
    /// The robot's joints, by joints of the mechanism.
    pub(in crate::robots) joints: Vec<usize>,
    /// The elements of the mechanism's couplings.
    pub(in crate::robots) couplings: Vec<usize>,
}

/// The place of an element.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ElementPlace {
    /// Name of the file.
    pub file: String,
    /// Line and column, from 1.
    pub at: [usize; 2],
    /// Its tag.
    pub tag: String,
}

impl Origin {
    pub(in crate::robots) fn part_of(&self, joint: JointId) -> &Part {
        &self.robot.joints[self.joints[joint.index()]]
    }

    pub(in crate::robots) fn element(&self, id: usize) -> Element<'_> {
        self.document.element(id)
    }

    /// Returns the element of a joint. `None` if it is defined in a separate file.
    #[must_use]
    pub fn joint_place(&self, joint: JointId) -> Option<ElementPlace> {
        self.part_of(joint).element.map(|e| self.element_place(e))
    }

    /// Returns the element of a coupling, given by its index in the mechanism.
    #[must_use]
    pub fn coupling_place(&self, coupling: usize) -> Option<ElementPlace> {
        self.couplings.get(coupling).map(|&e| self.element_place(e))
    }

    /// Returns true if a joint closes a loop according to the description.
    #[must_use]
    pub fn closes(&self, joint: JointId) -> bool {
        self.part_of(joint).closes
    }

    /// Returns true if an actuator moves a joint, directly or through a tendon; such a joint should not be changed.
    #[must_use]
    pub fn is_actuated(&self, joint: JointId) -> bool {
        self.part_of(joint).drive || self.part_of(joint).pulled
    }

    /// Returns true if all joints of one freedom are within their limits in a pose.
    #[must_use]
    pub fn is_inside(&self, pose: &Pose) -> bool {
        pose.columns.iter().enumerate().all(|(at, c)| {
            let part = self.part_of(c.joint);
            part.exceeded_limits(c.moved * column_unit(pose, at))
                .is_none()
        })
    }

    /// Returns the joints that are outside their limits in the pose of the mechanism, in words: angles in radians, slides in
    /// the unit of the description.
    #[must_use]
    pub fn outside_limits(&self) -> Vec<String> {
        let words = |p: &Part| {
            let [value, low, high] = p.exceeded_limits(0.0)?.map(|x| three_digits(x + p.zero));
            let slides = p.joint_type.freedoms().iter().any(|f| f.is_slide());
            let unit = if slides { self.robot.unit } else { "rad" };
            Some(format!(
                "{} is at {value} {unit}, outside its limits {low} to {high}",
                p.id
            ))
        };
        self.robot.joints.iter().filter_map(words).collect()
    }

    /// Returns true for an assembly of a CAD program, whose joints are changed to one of its types, not by one freedom.
    #[must_use]
    pub fn is_assembly(&self) -> bool {
        self.robot.assembly
    }

    /// Returns true if the mechanism is valid in this pose only: joints are open, or have freedoms that no joint type has.
    #[must_use]
    pub fn is_of_this_pose(&self) -> bool {
        self.robot.here_only
    }

    /// Returns the distance between the two frames of a joint of an assembly in its constrained directions: a length in the
    /// mechanism's unit, and radians. `None` if the file places one frame only.
    #[must_use]
    pub fn misfit(&self, joint: JointId) -> Option<[f64; 2]> {
        self.part_of(joint).misfit
    }

    /// Returns the same in words, if it is more than rounding.
    #[must_use]
    pub fn open_by(&self, joint: JointId) -> Option<String> {
        let misfit = self.misfit(joint)?;
        let told = misfit.iter().any(|x| *x > 1e-6);
        told.then(|| cad::describe_misfit(misfit, self.robot.unit))
    }

    /// Returns true if more joints can be added in series with a joint.
    pub(in crate::robots) fn takes_joints(&self, joint: JointId) -> bool {
        let Some(id) = self.part_of(joint).element else {
            return false;
        };
        let (name, root) = (self.element(id).name(), self.element(self.root));
        // A joint of SDF within <gazebo> of a URDF is Gazebo's own.
        let of_gazebo = root.name() == "robot" && !root.node().children.contains(&id);
        ["joint", "connect", "weld", "loop_joint"].contains(&name) && !of_gazebo
    }

    fn element_place(&self, id: usize) -> ElementPlace {
        let node = self.element(id).node();
        let source = &self.document.sources[node.source];
        ElementPlace {
            file: source.name.clone(),
            at: line_and_column(&source.text, node.span.start),
            tag: self.element(id).name().to_owned(),
        }
    }
}
