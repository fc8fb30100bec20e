//! Statics of a planar mechanism: one value from which text, JSON, CSV and charts are made. SI units; the keys are a stable
//! contract, and numbers that do not exist are null.

pub mod charts;
pub mod csv;
pub mod force_plans;
pub mod text;
pub mod told;

use crate::model::claim::{Claim, Topic};
use crate::statics::assur::{self, Decomposition};
use crate::statics::contour_group::delta_point::DeltaSteps;
use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::contour_group::solutions::{GroupMethod, GroupSolutions};
use crate::statics::cycle::{self, Moment};
use crate::statics::kinetostatics::{self, LinkInertia, Worth};
use crate::statics::planar::{BodyId, PairId, PlanarMechanism};
use crate::view::claims::about;
use crate::view::prelude::*;

/// A mechanism's reactions over its cycle.
#[derive(Debug, Serialize)]
pub struct StaticsData<'a> {
    /// Its name.
    pub mechanism: &'a str,
    /// The driven joints.
    pub drives: Vec<&'a str>,
    /// Links that the drives alone place.
    pub driven: Vec<&'a str>,
    /// The highest class among the groups.
    pub class: usize,
    /// The Assur groups, in the order they are placed.
    pub groups: Vec<GroupData<'a>>,
    /// By position of the first drive.
    pub positions: Vec<Position<'a>>,
    /// Where the motion ended early, if it did.
    pub stopped: Option<Stopped<'a>>,
    /// What publications say of its reactions.
    pub claims: Vec<&'a Claim>,
    /// The mechanism.
    #[serde(skip)]
    pub of: &'a Mechanism,
    /// What was found.
    #[serde(skip)]
    pub found: &'a cycle::Statics,
    /// The methods asked for.
    #[serde(skip)]
    pub methods: &'a [GroupMethod],
}

/// An Assur group.
#[derive(Debug, Serialize)]
pub struct GroupData<'a> {
    /// Its links.
    pub links: Vec<&'a str>,
    /// By Assur and Artobolevsky.
    pub class: usize,
    /// Number of outer joints.
    pub order: usize,
    /// Class, order and kind in words.
    pub kind: String,
    /// Joints within it.
    pub inner: Vec<&'a str>,
    /// Joints to links placed earlier.
    pub outer: Vec<&'a str>,
    /// Drives and rigid joints within its blocks.
    pub locked: Vec<&'a str>,
    /// 3n - 2p, nothing for every group.
    pub mobility: isize,
    /// Condition of its equations at the pose of the file.
    pub condition: Option<f64>,
}

/// Reactions at one position.
#[derive(Debug, Serialize)]
pub struct Position<'a> {
    /// Of the first drive since the pose of the file, `[rad]` or `[m]`.
    pub drive: f64,
    /// By the equilibrium of all links at once.
    pub reactions: Vec<Reaction<'a>>,
    /// What those equations are worth.
    #[serde(flatten)]
    pub worth: Worth,
    /// Worth of the equations group by group, drives last.
    pub by_groups: Vec<Worth>,
    /// Of the drives `[W]`.
    pub drive_power: f64,
    /// Of loads and inertia `[W]`.
    pub load_power: f64,
    /// The four-link groups with a closed contour.
    pub contour_groups: Vec<ContourGroup>,
    /// How the links with mass move, and their inertia forces.
    pub links: Vec<LinkMotion<'a>>,
}

/// What a joint passes on.
#[derive(Debug, Serialize)]
pub struct Reaction<'a> {
    /// The joint.
    pub joint: &'a str,
    /// The link that acts.
    pub from: &'a str,
    /// The link acted on.
    pub on: &'a str,
    /// What it passes.
    #[serde(flatten)]
    pub passed: kinetostatics::Reaction,
}

/// Acceleration and inertia of a link.
#[derive(Debug, Serialize)]
pub struct LinkMotion<'a> {
    /// The link.
    pub link: &'a str,
    /// How it moves, and its inertia force.
    #[serde(flatten)]
    pub inertia: LinkInertia,
    /// How far aside of the centre the force alone does both `[m]`.
    pub offset: f64,
}

/// A four-link group with a closed contour, by every method asked for.
#[derive(Debug, Serialize)]
pub struct ContourGroup {
    /// Its place among the groups, from 0.
    pub group: usize,
    /// On the way of the δ-point method.
    #[serde(flatten)]
    pub steps: DeltaSteps,
    /// Condition of the twelve equilibrium equations.
    pub condition: Option<f64>,
    /// What they leave over, by the greatest load.
    pub residual: Option<f64>,
    /// Reactions by method.
    #[serde(serialize_with = "in_order")]
    pub methods: Vec<(&'static str, GroupForces)>,
}

/// Reactions of a four-link group; forces `[N]`.
#[derive(Debug, Serialize)]
pub struct GroupForces {
    /// The reactions.
    #[serde(flatten)]
    pub reactions: GroupReactions,
    /// Where the guide's acts along it, from the joint's point `[m]`.
    pub guide_offset: f64,
}

/// Where a motion ended early.
#[derive(Debug, Serialize)]
pub struct Stopped<'a> {
    /// Position of the first drive `[rad]` or `[m]`.
    pub drive: f64,
    /// The group at a dead point, from 0; nothing for the drives themselves.
    pub group: Option<usize>,
    /// Condition of its equations there.
    pub condition: f64,
    /// The last pose reached.
    pub pose: Vec<Placed<'a>>,
}

/// A link and where it is.
#[derive(Debug, Serialize)]
pub struct Placed<'a> {
    /// The link.
    pub link: &'a str,
    /// (x `[m]`, y `[m]`, turn `[rad]`) of its origin.
    pub placement: [f64; 3],
}

/// The structure of a mechanism under every possible drive.
#[derive(Debug, Serialize)]
pub struct Structures<'a> {
    /// Its name.
    pub mechanism: &'a str,
    /// By drive, those at the frame first.
    pub drives: Vec<DrivenStructureData<'a>>,
}

/// The structure under one drive.
#[derive(Debug, Serialize)]
pub struct DrivenStructureData<'a> {
    /// The joint driven in place of the first drive.
    pub drive: &'a str,
    /// The groups, or why there are none.
    #[serde(flatten)]
    pub found: Decomposed<'a>,
}

/// A mechanism as Assur groups, or why not.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Decomposed<'a> {
    /// Its groups.
    Groups {
        /// The highest class among them.
        class: usize,
        /// In the order they are placed.
        groups: Vec<GroupData<'a>>,
    },
    /// Why there are none.
    Not {
        /// In words.
        error: String,
    },
}

fn in_order<S: serde::Serializer>(
    methods: &[(&'static str, GroupForces)],
    to: S,
) -> Result<S::Ok, S::Error> {
    to.collect_map(methods.iter().map(|(name, found)| (name, found)))
}

fn links<'a>(m: &'a PlanarMechanism, list: &[BodyId]) -> Vec<&'a str> {
    list.iter().map(|&b| m.bodies[b].name.as_str()).collect()
}

fn joints<'a>(m: &'a PlanarMechanism, list: &[PairId]) -> Vec<&'a str> {
    list.iter().map(|&p| m.pairs[p].name.as_str()).collect()
}

fn groups<'a>(m: &'a PlanarMechanism, d: &Decomposition, conditions: &[f64]) -> Vec<GroupData<'a>> {
    let one = |(i, g): (usize, &assur::Group)| GroupData {
        links: links(m, &g.bodies),
        class: g.class.class,
        order: g.class.order,
        kind: g.class.to_string(),
        inner: joints(m, &g.inner),
        outer: joints(m, &g.outer),
        locked: joints(m, &g.locked),
        mobility: g.mobility(),
        condition: conditions.get(i).copied(),
    };
    d.groups.iter().enumerate().map(one).collect()
}

impl GroupData<'_> {
    /// A short name: "4-6-7-10".
    #[must_use]
    pub fn name(&self) -> String {
        self.links.iter().map(|l| l.replace(' ', "-")).join("-")
    }
}

impl<'a> Structures<'a> {
    /// The structures of a mechanism.
    #[must_use]
    pub fn new(name: &'a str, m: &'a PlanarMechanism, found: &[cycle::DrivenStructure]) -> Self {
        let one = |x: &cycle::DrivenStructure| DrivenStructureData {
            drive: &m.pairs[x.drive].name,
            found: match &x.found {
                Ok((d, conditions)) => Decomposed::Groups {
                    class: d.class(),
                    groups: groups(m, d, conditions),
                },
                Err(e) => Decomposed::Not {
                    error: e.to_string(),
                },
            },
        };
        Structures {
            mechanism: name,
            drives: found.iter().map(one).collect(),
        }
    }
}

impl<'a> StaticsData<'a> {
    /// What was found of a mechanism, the four-link groups by `methods`.
    #[must_use]
    pub fn new(
        mechanism: &'a Mechanism,
        s: &'a cycle::Statics,
        methods: &'a [GroupMethod],
    ) -> Self {
        let (m, d) = (&s.linkage.mechanism, &s.decomposition);
        let stopped = s.dead.as_ref().map(|dead| Stopped {
            drive: dead.drive,
            group: dead.group,
            condition: dead.condition,
            pose: m
                .bodies
                .iter()
                .zip(&dead.pose)
                .map(|(b, p)| Placed {
                    link: &b.name,
                    placement: *p,
                })
                .collect(),
        });
        StaticsData {
            mechanism: &mechanism.name,
            drives: joints(m, &d.drives),
            driven: links(m, &d.driven),
            class: d.class(),
            groups: groups(m, d, &s.conditions),
            positions: s
                .moments
                .iter()
                .map(|x| Position::new(s, x, methods))
                .collect(),
            stopped,
            claims: about(&mechanism.claims, Topic::Statics),
            of: mechanism,
            found: s,
            methods,
        }
    }

    /// Position of the first drive for people: degrees, or the file's length unit.
    fn shown(&self, drive: f64) -> f64 {
        if self.found.drive_slides() {
            drive / self.found.linkage.mechanism.metres
        } else {
            drive.to_degrees()
        }
    }

    /// Degrees, or the file's length unit.
    fn unit(&self) -> &'static str {
        if self.found.drive_slides() {
            self.found.linkage.mechanism.unit
        } else {
            "deg"
        }
    }
}

impl<'a> Position<'a> {
    fn new(s: &'a cycle::Statics, x: &'a Moment, methods: &[GroupMethod]) -> Self {
        let m = &s.linkage.mechanism;
        let reactions = x.reactions.iter().map(|r| {
            let pair = &m.pairs[r.pair];
            let [from, on] = pair.bodies.map(|b| m.bodies[b].name.as_str());
            Reaction {
                joint: &pair.name,
                from,
                on,
                passed: *r,
            }
        });
        Position {
            drive: x.drive,
            reactions: reactions.collect(),
            worth: x.worth,
            by_groups: x.by_groups.clone(),
            drive_power: x.drive_power,
            load_power: x.load_power,
            contour_groups: x
                .groups
                .iter()
                .zip(&s.contour_groups)
                .map(|(g, (_, letters))| {
                    let guide = s.linkage.place(&x.pose, letters.guide);
                    ContourGroup::new(g, guide, methods)
                })
                .collect(),
            links: x
                .links
                .iter()
                .map(|i| LinkMotion {
                    link: &m.bodies[i.body].name,
                    inertia: *i,
                    offset: i.offset(),
                })
                .collect(),
        }
    }
}

impl ContourGroup {
    fn new(g: &GroupSolutions, guide: [f64; 2], methods: &[GroupMethod]) -> Self {
        let forces = |r: GroupReactions| GroupForces {
            reactions: r,
            guide_offset: r.guide_offset(&g.pose, guide),
        };
        let by = |k: &GroupMethod| Some((k.name(), forces(g.by(*k)?)));
        ContourGroup {
            group: g.group,
            steps: g.steps,
            condition: g.equilibrium.map(|e| e.1.condition),
            residual: g.equilibrium.map(|e| e.1.residual),
            methods: methods.iter().filter_map(by).collect(),
        }
    }
}

/// The six reactions of a group by name, as magnitudes, the guide's with its sign.
fn magnitudes(r: &GroupReactions, pose: &GroupPose) -> [(&'static str, f64); 6] {
    let [d, f, k, m, l, _] = r.forces(pose).map(|v| v[0].hypot(v[1]));
    [
        ("D", d),
        ("F", f),
        ("K", k),
        ("M", m),
        ("L", l),
        ("guide", r.guide),
    ]
}
