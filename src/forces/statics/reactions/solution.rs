//! Joint reactions and their reliability.

use crate::closure::drive::Driven;
use crate::geom::vector::{add, length, sub};
use crate::model::joint_type::{CoupledFreedom, Freedom};
use crate::model::mechanism::{JointId, Mechanism};
use crate::statics::reactions::contact::ContactForce;
use crate::statics::reactions::couplings::CouplingEquation;
use crate::statics::reactions::geometry::{Geometry, Six, dot, shift_wrench, wrench_power};
use crate::statics::{drop_rounding, greatest_abs};
use serde::{Serialize, Serializer};

/// The wrench of a joint from its first link to its second, without the parts of couplings that bypass it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointReaction {
    /// The joint.
    #[serde(skip)]
    pub joint: JointId,
    /// Its current position `[m]`, global axes.
    pub point: [f64; 3],
    /// Current unit vectors x, y, z of its frame.
    #[serde(serialize_with = "serialize_axes")]
    pub axes: [[f64; 3]; 3],
    /// The force in its own frame `[N]`.
    pub force: [f64; 3],
    /// The moment about its point in its own frame `[N·m]`.
    pub moment: [f64; 3],
    /// Force `[N]` or torque `[N·m]` of its drive, along the freedom it holds; part of force and moment.
    #[serde(skip)]
    pub effort: Option<(Freedom, f64)>,
    /// Size up to which forces are rounding errors `[N]`; for moments this times the size of the mechanism `[m]`.
    #[serde(skip)]
    pub rounding: [f64; 2],
}

fn serialize_axes<S: Serializer>(axes: &[[f64; 3]; 3], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(["x", "y", "z"].into_iter().zip(axes))
}

/// The reaction of a coupling, in addition to the reactions of the joints.
#[derive(Debug, Clone, PartialEq)]
pub struct CouplingReaction {
    /// The coupled freedoms.
    pub ends: [CoupledFreedom; 2],
    /// Its effort on each joint's second link along the freedom: torque `[N·m]` of a turn, force `[N]` of a slide. The
    /// teeth of gears exert the opposite on the link on the other side of the joint.
    pub efforts: [f64; 2],
    /// The teeth, if the file states their existence and place, and if the joints carry their forces.
    pub teeth: Option<ToothForce>,
}

/// The force of teeth, along the pitch circles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ToothForce {
    /// Current contact point `[m]`, global axes.
    pub point: [f64; 3],
    /// Force on the gear or rack of the first joint, global axes `[N]`.
    pub force: [f64; 3],
}

impl ToothForce {
    /// Returns the magnitude of the force `[N]`.
    #[must_use]
    pub fn tooth_force_size(&self) -> f64 {
        length(self.force)
    }
}

impl JointReaction {
    /// Returns the magnitude of the force `[N]`.
    #[must_use]
    pub fn force_size(&self) -> f64 {
        length(self.force)
    }

    /// Returns the magnitude of the moment `[N·m]`.
    #[must_use]
    pub fn moment_size(&self) -> f64 {
        length(self.moment)
    }

    fn to_global(&self, own: [f64; 3], rounding: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| drop_rounding(rounding, (0..3).map(|k| own[k] * self.axes[k][i]).sum()))
    }

    /// Returns the force in global axes `[N]`.
    #[must_use]
    pub fn global_force(&self) -> [f64; 3] {
        self.to_global(self.force, self.rounding[0])
    }

    /// Returns the moment about the joint's point in global axes `[N·m]`.
    #[must_use]
    pub fn global_moment(&self) -> [f64; 3] {
        self.to_global(self.moment, self.rounding[1])
    }
}

/// Condition number above which a mechanism is nearly singular: figures have few correct digits, and reactions are
/// large.
pub const NEARLY_SINGULAR: f64 = 1e4;

/// Uniqueness of reactions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Uniqueness {
    /// The reactions are unique, because the mechanism is determinate.
    Unique,
    /// The reactions are those of minimum norm in a family.
    MinimumNorm,
    /// The reactions are those of minimum norm in a family, among those in which contacts only push.
    Pushing,
}

/// Reactions of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The reactions by joint of the state, in file order.
    pub reactions: Vec<JointReaction>,
    /// The reactions by coupling of the state, in file order.
    pub couplings: Vec<CouplingReaction>,
    /// Uniqueness of the reactions.
    pub choice: Uniqueness,
    /// Reactions without external loads, one set for each redundant constraint (with drives held), scaled to a largest
    /// force, or moment divided by size, of 1 N.
    pub self_stresses: Vec<Vec<JointReaction>>,
    /// The reactions of couplings in each of these.
    pub coupling_stresses: Vec<Vec<CouplingReaction>>,
    /// For each coupling, whether these change its reaction.
    pub couplings_open: Vec<bool>,
    /// For each joint, the components that these change: forces along x, y, z of its frame and moments about them. All
    /// others are the same in every reaction of the family.
    pub open: Vec<[bool; 6]>,
    /// The reactions compatible with the stated stiffness and misalignments, if stiffness is stated and it matters.
    pub elastic: Option<Vec<JointReaction>>,
    /// The reactions of the rigid couplings in these.
    pub elastic_couplings: Option<Vec<CouplingReaction>>,
    /// The requirements on the contacts with clamped parts.
    pub contacts: Vec<ContactForce>,
    /// Number of freedoms left with the drives held; the loads do no work on them.
    pub undriven: usize,
    /// Ratio of the largest to the smallest singular value kept.
    pub condition: f64,
    /// Largest residual force, or moment divided by size, on a link, over the largest load.
    pub residual: f64,
    /// The size by which moments are divided `[m]`.
    pub size: f64,
}

impl Solution {
    /// Returns true if small errors of the geometry change the reactions strongly.
    #[must_use]
    pub fn nearly_singular(&self) -> bool {
        self.condition > NEARLY_SINGULAR
    }
}

/// Fraction of a self-stress's largest force below which a component counts as zero.
pub(crate) const NO_STRESS: f64 = 1e-9;

/// Returns the components of joints that are nonzero in some self-stress, with moments divided by the size.
pub(crate) fn open_components(
    joints: usize,
    size: f64,
    stresses: &[Vec<JointReaction>],
) -> Vec<[bool; 6]> {
    let mut out = vec![[false; 6]; joints];
    for stress in stresses {
        for (open, r) in out.iter_mut().zip(stress) {
            let components = r.force.into_iter().chain(r.moment.map(|x| x / size));
            for (open, x) in open.iter_mut().zip(components) {
                *open |= x.abs() > NO_STRESS;
            }
        }
    }
    out
}

/// Returns the couplings that some self-stress loads.
pub(crate) fn open_couplings<'x>(
    couplings: usize,
    stresses: impl Iterator<Item = &'x [f64]>,
) -> Vec<bool> {
    let mut out = vec![false; couplings];
    for stress in stresses {
        for (open, x) in out.iter_mut().zip(stress) {
            *open |= x.abs() > NO_STRESS;
        }
    }
    out
}

/// Returns the largest residual force, or moment divided by size, on a link `[N]`.
pub(crate) fn left_over(
    m: &Mechanism,
    geometry: &Geometry,
    wrenches: &[Six],
    loads: &[Six],
) -> f64 {
    let mut sums = loads.to_vec();
    for &j in &geometry.joints {
        let [a, b] = m.joints[j].links;
        sums[a] = sub(sums[a], wrenches[j]);
        sums[b] = add(sums[b], wrenches[j]);
    }
    sums[m.frame_link()] = [0.0; 6];
    greatest_abs(sums.iter().flatten())
}

/// Converts wrenches by joint to reactions in the joints' own frames, in SI. Values of at most `rounding` `[N]`, with
/// moments divided by the size, become 0.
pub(crate) fn present_reactions(
    m: &Mechanism,
    geometry: &Geometry,
    wrenches: &[Six],
    drives: &[Driven],
    rounding: f64,
) -> Vec<JointReaction> {
    let of_moments = rounding * geometry.size;
    let each = geometry.joints.iter().map(|&j| {
        let w = shift_wrench(&wrenches[j], geometry.points[j]);
        let axes = geometry.axes[j];
        let own = |v: [f64; 3]| axes.map(|a| dot(a, v));
        let held = drives.iter().find(|(d, _)| *d == j && m.joints[j].drive);
        let effort = held.and_then(|&(_, freedom)| {
            let column = geometry
                .columns
                .iter()
                .find(|c| c.joint == j && c.freedom == freedom)?;
            let turns = column.twist[..3] != [0.0; 3];
            let unit = if turns { geometry.size } else { 1.0 };
            let effort = drop_rounding(rounding, wrench_power(&column.twist, &wrenches[j]));
            Some((freedom, effort * unit))
        });
        JointReaction {
            joint: j,
            point: geometry.to_metres(geometry.points[j]),
            axes,
            force: own([w[3], w[4], w[5]]).map(|x| drop_rounding(rounding, x)),
            moment: own([w[0], w[1], w[2]]).map(|x| drop_rounding(of_moments, x * geometry.size)),
            effort,
            rounding: [rounding, of_moments],
        }
    });
    each.collect()
}

/// Returns the reactions of couplings for their unknowns, in SI. An unknown of at most `rounding` becomes 0.
pub(crate) fn passed_by_couplings(
    geometry: &Geometry,
    unknowns: &[f64],
    rounding: f64,
) -> Vec<CouplingReaction> {
    let one = |(c, x): (&CouplingEquation, &f64)| {
        let x = drop_rounding(rounding, *x);
        let effort = |n: usize| {
            let unit = if c.ends[n].freedom.is_slide() {
                1.0
            } else {
                geometry.size
            };
            // Subtracting from 0 avoids a signed zero.
            0.0 - c.entries[n] * x * unit
        };
        CouplingReaction {
            ends: c.ends,
            efforts: [effort(0), effort(1)],
            teeth: c.teeth.filter(|_| c.meshes).map(|t| ToothForce {
                point: geometry.to_metres(t.point),
                force: t.force.map(|f| drop_rounding(rounding, f * x)),
            }),
        }
    };
    geometry.couplings.iter().zip(unknowns).map(one).collect()
}
