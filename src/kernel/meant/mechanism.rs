//! Conversion of a mechanism to a scene, and of a recovered scene back to a mechanism.

use super::MeantScene;
use super::number::{Rational3, is_same};
use super::resolve::resolve_scene;
use super::written::{Written, WrittenScene, WrittenSymmetry};
use crate::closure::contour::contour_basis;
use crate::geom::expr::Expr;
use crate::geom::vector::{cross, dot, length, sub, to_vector, unit};
use crate::meant::relations::RelationKind;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Frame, Joint, JointId, JointOption, Mechanism, Mode, are_same};
use crate::model::rounded::{FrameUncertainty, uncertainties};
use num_rational::BigRational;
use num_traits::Zero;

/// Maximum number of joints outside loops that take part in the scene. They do not affect the rank of J, and more of
/// them take long.
const OUTSIDE_LOOPS: usize = 16;

/// A recovered mechanism, exact.
#[derive(Debug, Clone)]
pub struct Meant {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The frames of its joints as written.
    pub written: Vec<Frame>,
    /// The recovered scene.
    pub scene: MeantScene,
    /// The joint of each point of the scene.
    pub points: Vec<JointId>,
    /// The joint of each direction of the scene, or `None` for the normal of the plane.
    pub rays: Vec<Option<JointId>>,
}

/// Indices of a frame's point, axis and reference in the scene, if present.
type Slots = [Option<usize>; 3];

/// A scene under construction.
#[derive(Default)]
struct Gathered {
    written: WrittenScene,
    points: Vec<JointId>,
    rays: Vec<Option<JointId>>,
}

impl Gathered {
    fn add_point(&mut self, v: &[Expr; 3], half: [f64; 3], of: JointId) -> usize {
        self.points.push(of);
        self.written.points.push(as_written(v, half));
        self.points.len() - 1
    }

    fn add_ray(&mut self, v: &[Expr; 3], half: [f64; 3], of: Option<JointId>) -> usize {
        self.rays.push(of);
        self.written.rays.push(as_written(v, half));
        self.rays.len() - 1
    }

    /// Adds the used parts of a frame that differ from the joint's own frame, if given with its slots.
    fn add_frame(
        &mut self,
        f: &Frame,
        half: &FrameUncertainty,
        of: JointId,
        used: [bool; 3],
        own: Option<(&Frame, Slots)>,
    ) -> Slots {
        [0, 1, 2].map(|k| {
            let (v, half) = (f.vectors()[k], half.vectors()[k]);
            match own {
                Some((own, slots)) if are_same(v, own.vectors()[k]) => slots[k],
                _ if !used[k] => None,
                _ if k == 0 => Some(self.add_point(v, half, of)),
                // Exact references are mostly the file's default axes, which say nothing about the scene.
                _ if k == 2 && half == [0.0; 3] => None,
                _ => Some(self.add_ray(v, half, Some(of))),
            }
        })
    }

    /// Adds the frame of a joint, with the directions used by it and by the options along its axis.
    fn add_joint(&mut self, joint: &Joint, half: &FrameUncertainty, j: JointId) -> Slots {
        let along = joint.offered_options();
        let along = along.filter(|o| are_same(&o.frame.axis, &joint.frame.axis));
        let used = along.fold(parts_used(&joint.joint_type), |used, o| {
            let also = parts_used(&o.joint_type);
            [0, 1, 2].map(|k| used[k] || also[k])
        });
        self.add_frame(&joint.frame, half, j, used, None)
    }
}

/// Returns whether the point, the axis and the reference of a frame matter to a joint type.
fn parts_used(joint_type: &JointType) -> [bool; 3] {
    [true, joint_type.is_directed(), joint_type.has_second_axis()]
}

fn as_written(v: &[Expr; 3], half: [f64; 3]) -> Written {
    Written {
        value: to_vector(v),
        exact: to_rationals(v),
        half,
    }
}

/// Returns an exact vector, to forty digits if it is irrational.
fn to_rationals(v: &[Expr; 3]) -> Rational3 {
    v.each_ref().map(|e| {
        e.as_rational()
            .or_else(|| BigRational::from_float(e.to_f64()))
            .unwrap_or_else(BigRational::zero)
    })
}

/// Recovers the mechanism intended by rounded coordinates. `None` if nothing is rounded, or if no scene is found within the
/// digits.
///
/// # Guarantee
/// No number is moved by more than half a unit of its last digit, or its stated uncertainty. Intermediate rounding adds a
/// third. Exact numbers stay unchanged. The structure does not depend on the orientation of the file, except for second axes
/// left to the default.
///
/// # Complexity
/// As [`resolve_scene`].
#[must_use]
pub fn recover_mechanism(mechanism: &Mechanism) -> Option<Meant> {
    let half = uncertainties(mechanism)?;
    let mut all = Gathered::default();
    let mut own: Vec<Slots> = Vec::new();
    let mut offered: Vec<Vec<Slots>> = Vec::new();
    let takes_part = taking_part(mechanism);
    for (j, joint) in mechanism.joints_with_ids() {
        if !takes_part[j.index()] {
            own.push(Slots::default());
            offered.push(joint.offered_options().map(|_| Slots::default()).collect());
            continue;
        }
        let slots = all.add_joint(joint, &half.frames[j.index()], j);
        own.push(slots);
        let halves = &half.option_frames[j.index()];
        let of_option = |(o, half): (&JointOption, &FrameUncertainty)| {
            let used = parts_used(&o.joint_type);
            all.add_frame(&o.frame, half, j, used, Some((&joint.frame, slots)))
        };
        offered.push(joint.offered_options().zip(halves).map(of_option).collect());
    }
    let normal = match &mechanism.mode {
        Mode::Spatial => None,
        Mode::Planar { normal } => Some(all.add_ray(normal, half.normal, None)),
    };
    if all.points.is_empty() {
        return None;
    }
    all.written.symmetry = stated_symmetry(mechanism, &own, &offered);
    let scene = resolve_scene(&all.written)?;
    let places = Places {
        own,
        offered,
        normal,
    };
    Some(Meant {
        mechanism: places.apply_scene(mechanism, &scene),
        written: mechanism.joints.iter().map(|j| j.frame.clone()).collect(),
        scene,
        points: all.points,
        rays: all.rays,
    })
}

/// Returns which joints take part in the scene: all, or only those in a contour or a coupling of some state if many are
/// in none. In a plane, all must be perpendicular to it.
fn taking_part(mechanism: &Mechanism) -> Vec<bool> {
    let mut tied = vec![false; mechanism.joints.len()];
    for state in mechanism.state_ids() {
        let contours = contour_basis(mechanism, state);
        let joints = contours.iter().flat_map(|c| &c.joints);
        joints.for_each(|(j, _)| tied[j.index()] = true);
    }
    let ends = mechanism.couplings.iter().flat_map(|c| &c.ends);
    ends.for_each(|e| tied[e.joint.index()] = true);
    let outside = tied.iter().filter(|t| !**t).count();
    if outside <= OUTSIDE_LOOPS || matches!(mechanism.mode, Mode::Planar { .. }) {
        tied.fill(true);
    }
    tied
}

/// Returns the images stated in the file, or `None` for a third of a turn, which is rational only in special frames.
fn stated_symmetry(
    mechanism: &Mechanism,
    own: &[Slots],
    offered: &[Vec<Slots>],
) -> Option<WrittenSymmetry> {
    let search = &mechanism.search;
    if search.symmetry_order() != 2 {
        return None;
    }
    let mut out = WrittenSymmetry {
        turned: search.mirror.is_empty(),
        points: Vec::new(),
        rays: Vec::new(),
    };
    for (j, _) in mechanism.joints_with_ids() {
        let (a, b) = (j.index(), search.image_of_joint(j).index());
        if b < a {
            continue;
        }
        let pairs = offered[a].iter().zip(&offered[b]);
        for (s, t) in std::iter::once((&own[a], &own[b])).chain(pairs) {
            let pair = |k: usize| Some([s[k]?, t[k]?]);
            out.points.extend(pair(0));
            out.rays.extend([1, 2].into_iter().filter_map(pair));
        }
    }
    out.points.sort_unstable();
    out.points.dedup();
    Some(out)
}

/// Indices of a mechanism's frames in a scene.
struct Places {
    own: Vec<Slots>,
    offered: Vec<Vec<Slots>>,
    normal: Option<usize>,
}

impl Places {
    /// Returns the mechanism with the geometry of a scene.
    fn apply_scene(&self, mechanism: &Mechanism, scene: &MeantScene) -> Mechanism {
        let mut out = mechanism.clone();
        let put = |f: &mut Frame, s: &Slots| {
            let of = [&scene.points, &scene.rays, &scene.rays];
            for ((v, slot), of) in f.vectors_mut().into_iter().zip(s).zip(of) {
                match slot {
                    Some(k) => write(v, &of[*k]),
                    None => make_exact(v),
                }
            }
        };
        let parts = out.parts_mut();
        for ((joint, slots), offered) in parts.joints.iter_mut().zip(&self.own).zip(&self.offered) {
            put(&mut joint.frame, slots);
            let options = joint.options.iter_mut().chain(&mut joint.unloading);
            for (option, slots) in options.zip(offered) {
                put(&mut option.frame, slots);
            }
        }
        if let (Mode::Planar { normal }, Some(k)) = (&mut parts.mode, self.normal) {
            write(normal, &scene.rays[k]);
        }
        for p in &mut parts.points {
            make_exact(&mut p.point);
        }
        out
    }
}

/// Makes a vector that no relation depends on exact as written.
fn make_exact(v: &mut [Expr; 3]) {
    for e in v {
        if let (true, Some(x)) = (e.half_unit().is_some(), e.as_rational()) {
            *e = Expr::rational(x);
        }
    }
}

/// Writes a vector over another. Equal values stay as written, because they may be irrational.
fn write(v: &mut [Expr; 3], x: &Rational3) {
    let before = to_rationals(v);
    for k in 0..3 {
        if !is_same(&before[k], &x[k]) {
            v[k] = Expr::rational(x[k].clone());
        }
    }
    make_exact(v);
}

/// Returns the joints that a scene has moved, in file order.
#[must_use]
pub fn moved_joints(meant: &Meant) -> Vec<JointId> {
    let moved = |(j, joint): &(JointId, &Joint)| {
        let before = &meant.written[j.index()];
        let shift = length(sub(to_vector(&joint.frame.point), to_vector(&before.point)));
        shift != 0.0 || turn_angle(before, &joint.frame) != 0.0
    };
    let joints = meant.mechanism.joints_with_ids();
    joints.filter(moved).map(|(j, _)| j).collect()
}

/// Returns the angle by which the axes of a frame have turned `[rad]`.
fn turn_angle(before: &Frame, now: &Frame) -> f64 {
    let angle = |a: [f64; 3], b: [f64; 3]| {
        let (a, b) = (unit(a), unit(b));
        length(cross(a, b)).atan2(dot(a, b).abs())
    };
    // Differences at the level of rounding errors are not reported.
    let told = |x: f64| if x > 1e-15 { x } else { 0.0 };
    let of = |a: &[_; 3], b: &[_; 3]| told(angle(to_vector(a), to_vector(b)));
    of(&before.axis, &now.axis).max(of(&before.reference, &now.reference))
}

/// Describes the recovered relations: "13 axes parallel, 14 centres in planes, 4 equal vectors" and a largest move such
/// as 0.9 halves of a unit of the last digit.
#[must_use]
pub fn describe_relations(meant: &Meant) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut groups: Vec<usize> = Vec::new();
    for (of, &cluster) in meant.rays.iter().zip(&meant.scene.cluster) {
        groups.resize(groups.len().max(cluster + 1), 0);
        groups[cluster] += usize::from(of.is_some());
    }
    groups.retain(|n| *n > 1);
    groups.sort_unstable_by(|a, b| b.cmp(a));
    if !groups.is_empty() {
        let all: Vec<String> = groups.iter().map(usize::to_string).collect();
        parts.push(format!("{} axes parallel", all.join(" + ")));
    }
    for (kind, what) in [
        (RelationKind::Coincident, "coincident centres"),
        (RelationKind::InPlane, "in a plane with another"),
        (RelationKind::OnLine, "on a line with another"),
        (RelationKind::EqualVectors, "equal vectors"),
        (RelationKind::Mirrored, "mirrored"),
    ] {
        let n = meant.scene.relations.iter().filter(|r| r.0 == kind).count();
        if n > 0 {
            parts.push(format!("{n} {what}"));
        }
    }
    if parts.is_empty() {
        parts.push("no two joints related".to_owned());
    }
    format!(
        "{}; every number moved by at most {:.2} units of its last digit",
        parts.join(", "),
        meant.scene.moved / 2.0
    )
}
