//! Joint reactions of any mechanism, in a pose or over a stroke: one value from which text, JSON and CSV are made. Forces in
//! N, moments in N·m about the joints' points, each first link on second, in the joint's own frame.

pub(crate) mod chart;
pub(crate) mod couplings;
pub mod stroke;
pub mod text;

use crate::format::csv::table;
use crate::statics::reactions::contact::{ContactForce, Touch};
use crate::statics::reactions::drives::slides;
use crate::statics::reactions::{CouplingReaction, JointReaction, Solution, Uniqueness};
use crate::view::prelude::*;
use crate::view::reactions::couplings::{CouplingForces, couplings, unit};

/// Reactions in one pose.
#[derive(Debug, Serialize)]
pub struct Reactions<'a> {
    /// Name of the mechanism.
    pub mechanism: &'a str,
    /// Its state.
    pub state: &'a str,
    /// Whether these are the only reactions in equilibrium.
    pub unique: bool,
    /// `unique`, `minimum-norm` of a family, or `pushing`: of minimum norm where contacts only push.
    pub choice: &'static str,
    /// What moments are divided by in that norm `[m]`.
    pub size: f64,
    /// Greatest singular value over the smallest kept.
    pub condition: f64,
    /// Whether small errors of the geometry change the reactions much.
    pub nearly_singular: bool,
    /// What is left over on a link, by the greatest load.
    pub residual: f64,
    /// Freedoms left with the drives held.
    pub undriven: usize,
    /// What is asked of the faces on objects, in states that have any.
    pub contacts: Vec<ObjectContact<'a>>,
    /// By joint of the state.
    pub reactions: Vec<JointForces<'a>>,
    /// By coupling of the state.
    pub couplings: Vec<CouplingForces<'a>>,
    /// Those that load nothing from outside, one set for each redundant constraint.
    pub self_stresses: Vec<Vec<JointForces<'a>>>,
    /// What couplings pass of each of these.
    pub coupling_stresses: Vec<Vec<CouplingForces<'a>>>,
    /// How many there are in exact geometry, where singular values tell another number.
    pub exact_self_stresses: Option<usize>,
    /// Those of elastic joints, where stiffness is stated and it matters.
    pub elastic: Option<Vec<JointForces<'a>>>,
    /// What couplings, which are rigid, pass of those.
    pub elastic_couplings: Option<Vec<CouplingForces<'a>>>,
    /// The mechanism, for its loads.
    #[serde(skip)]
    pub of: &'a Mechanism,
}

/// What a joint passes on.
#[derive(Debug, Serialize)]
pub struct JointForces<'a> {
    /// The joint.
    pub joint: &'a str,
    /// Its type.
    #[serde(rename = "type")]
    pub kind: &'a str,
    /// First and second link.
    pub links: [&'a str; 2],
    /// Where it is now, its frame, and what it passes in that.
    #[serde(flatten)]
    pub reaction: JointReaction,
    /// `[N]`
    pub force_magnitude: f64,
    /// `[N·m]`
    pub moment_magnitude: f64,
    /// In global axes `[N]`.
    pub global_force: [f64; 3],
    /// In global axes `[N·m]`.
    pub global_moment: [f64; 3],
    /// What its drive does, part of force and moment.
    pub drive: Option<DriveEffort>,
    /// Components that differ within the family of reactions, `Fx` to `Mz`; all others are the same in all of it.
    pub open: Vec<&'static str>,
}

/// The force of a face on an object.
#[derive(Debug, Serialize)]
pub struct ObjectContact<'a> {
    /// The joint.
    pub contact: &'a str,
    /// `pushes`, `idle`, or what no such face can do: `pulls`, `slips`, `tilts`.
    pub touch: &'static str,
    /// The force.
    #[serde(flatten)]
    pub force: ContactForce,
}

impl<'a> ObjectContact<'a> {
    fn new(m: &'a Mechanism, c: &ContactForce) -> Self {
        ObjectContact {
            contact: &m.joints[c.joint].id,
            touch: match c.touch {
                Touch::Pushes => "pushes",
                Touch::Idle => "idle",
                Touch::Pulls => "pulls",
                Touch::Slips => "slips",
                Touch::Tilts => "tilts",
            },
            force: *c,
        }
    }

    /// Whether a face can do what is asked of it.
    #[must_use]
    pub fn holds(&self) -> bool {
        matches!(self.touch, "pushes" | "idle")
    }
}

/// What a drive does.
#[derive(Debug, Serialize)]
pub struct DriveEffort {
    /// The freedom it holds.
    pub freedom: &'static str,
    /// Force `[N]` or torque `[N·m]` along it.
    pub effort: f64,
    /// Whether that is a force.
    #[serde(skip)]
    pub slides: bool,
}

impl<'a> JointForces<'a> {
    fn new(m: &'a Mechanism, r: &JointReaction) -> Self {
        let joint = &m.joints[r.joint];
        JointForces {
            joint: &joint.id,
            kind: joint.joint_type.name(),
            links: joint.links.map(|l| m.links[l].id.as_str()),
            reaction: r.clone(),
            force_magnitude: r.force_size(),
            moment_magnitude: r.moment_size(),
            global_force: r.global_force(),
            global_moment: r.global_moment(),
            drive: r.effort.map(|(freedom, effort)| DriveEffort {
                freedom: freedom.name(),
                effort,
                slides: slides(freedom),
            }),
            open: Vec::new(),
        }
    }
}

impl<'a> Reactions<'a> {
    /// What was found of a state.
    #[must_use]
    pub fn new(m: &'a Mechanism, state: StateId, s: &Solution) -> Self {
        let joints = |list: &Vec<JointReaction>| -> Vec<JointForces<'a>> {
            list.iter().map(|r| JointForces::new(m, r)).collect()
        };
        let coupled = |list: &Vec<CouplingReaction>| couplings(m, state, list);
        Reactions {
            mechanism: &m.name,
            state: &m.states[state],
            unique: s.choice == Uniqueness::Unique,
            choice: match s.choice {
                Uniqueness::Unique => "unique",
                Uniqueness::MinimumNorm => "minimum-norm",
                Uniqueness::Pushing => "pushing",
            },
            size: s.size,
            condition: s.condition,
            nearly_singular: s.nearly_singular(),
            residual: s.residual,
            undriven: s.undriven,
            contacts: s
                .contacts
                .iter()
                .map(|c| ObjectContact::new(m, c))
                .collect(),
            reactions: joints(&s.reactions)
                .into_iter()
                .zip(&s.open)
                .map(|(joint, open)| JointForces {
                    open: COMPONENTS
                        .into_iter()
                        .zip(open)
                        .filter(|(_, o)| **o)
                        .map(|(c, _)| c)
                        .collect(),
                    ..joint
                })
                .collect(),
            couplings: coupled(&s.couplings)
                .into_iter()
                .zip(&s.couplings_open)
                .map(|(c, &open)| CouplingForces { open, ..c })
                .collect(),
            self_stresses: s.self_stresses.iter().map(joints).collect(),
            coupling_stresses: s.coupling_stresses.iter().map(coupled).collect(),
            elastic_couplings: s.elastic_couplings.as_ref().map(coupled),
            exact_self_stresses: None,
            elastic: s.elastic.as_ref().map(joints),
            of: m,
        }
    }

    /// Says how many self-stresses there are in exact geometry, where these are others.
    pub(super) fn compare_with(&mut self, exact: Option<usize>) {
        self.exact_self_stresses = exact.filter(|&n| n != self.self_stresses.len());
    }

    /// One joint a line, and one for each joint of a coupling.
    #[must_use]
    pub fn csv(&self) -> String {
        table(&HEADS, self.rows())
    }

    fn rows(&self) -> impl Iterator<Item = Vec<String>> {
        let lists = [
            (self.choice, Some(&self.reactions), Some(&self.couplings)),
            (
                "elastic",
                self.elastic.as_ref(),
                self.elastic_couplings.as_ref(),
            ),
        ];
        lists.into_iter().flat_map(|(kind, list, coupled)| {
            let coupled = coupled.into_iter().flatten().flat_map(move |c| {
                c.rows().map(move |mut row| {
                    row.insert(0, kind.to_owned());
                    row
                })
            });
            let joints = list.into_iter().flatten().map(move |r| {
                let mut row = [kind, r.joint, r.kind].map(str::to_owned).to_vec();
                let passed = &r.reaction;
                for (vector, size) in [
                    (passed.force, r.force_magnitude),
                    (passed.moment, r.moment_magnitude),
                ] {
                    row.extend(vector.map(|x| x.to_string()));
                    row.push(size.to_string());
                }
                let effort = r.drive.as_ref().map(|d| d.effort.to_string());
                row.push(effort.unwrap_or_default());
                let unit_of = r.drive.as_ref().map(|d| unit(d.slides));
                row.push(unit_of.unwrap_or_default().to_owned());
                row
            });
            joints.chain(coupled)
        })
    }
}

const COMPONENTS: [&str; 6] = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];

const HEADS: [&str; 13] = [
    "kind",
    "joint",
    "type",
    "Fx",
    "Fy",
    "Fz",
    "F",
    "Mx",
    "My",
    "Mz",
    "M",
    "effort",
    "effort_unit",
];
