//! Joint reactions of any mechanism, in a pose or over a stroke, as JSON and CSV. Forces in N, moments in N·m about the joints'
//! points, each first link on second, in the joint's own frame.

use crate::statics::reactions::contact::{ContactForce, Touch};
use crate::statics::reactions::{CouplingReaction, JointReaction, Solution, Uniqueness};
use crate::view::prelude::*;
use crate::view::reactions::couplings::{Coupled, effort_unit, state_couplings};

pub(crate) mod couplings;
pub mod misfit;
pub mod stroke;
pub mod text;

/// Reactions in one pose.
#[derive(Debug, Clone, Copy)]
pub struct Reactions<'a> {
    /// The mechanism.
    of: &'a Mechanism,
    state: StateId,
    /// The reactions.
    found: &'a Solution,
    /// How many self-stresses there are in exact geometry, if singular values tell another number.
    exact_self_stresses: Option<usize>,
}

/// Returns the state of a face: `pushes`, `idle`, or one that no such face can have: `pulls`, `slips`, `tilts`.
fn touch_word(c: &ContactForce) -> &'static str {
    match c.touch {
        Touch::Pushes => "pushes",
        Touch::Idle => "idle",
        Touch::Pulls => "pulls",
        Touch::Slips => "slips",
        Touch::Tilts => "tilts",
    }
}

/// Returns true if a face can do what is asked of it.
fn is_possible(c: &ContactForce) -> bool {
    matches!(c.touch, Touch::Pushes | Touch::Idle)
}

const COMPONENTS: [&str; 6] = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];

/// Returns the components that differ within the family of reactions; all others are the same in all of it.
fn open_components(open: &[bool; 6]) -> Vec<&'static str> {
    let named = COMPONENTS.into_iter().zip(open);
    named.filter(|(_, o)| **o).map(|(c, _)| c).collect()
}

impl<'a> Reactions<'a> {
    /// Describes the reactions of a state.
    pub fn new(of: &'a Mechanism, state: StateId, found: &'a Solution) -> Self {
        Reactions {
            of,
            state,
            found,
            exact_self_stresses: None,
        }
    }

    /// Returns true if these are the only reactions in equilibrium.
    ///
    /// # Examples
    /// ```
    /// use ozols::statics::reactions::solve::Reactions as Solved;
    /// use ozols::{model::mechanism::StateId, view::reactions::Reactions};
    /// let loaded = ozols::built_in("gripper-10-loaded")?;
    /// let found = Solved::solve_at_home(&loaded, StateId::FREE, &loaded.loads)?;
    /// // With 11 redundant constraints, the loads alone do not say what each joint bears.
    /// assert!(!Reactions::new(&loaded, StateId::FREE, &found).is_unique());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_unique(&self) -> bool {
        self.found.choice == Uniqueness::Unique
    }

    /// Returns `unique`, `minimum-norm` of a family, or `pushing`: of minimum norm where contacts only push.
    fn choice_word(&self) -> &'static str {
        match self.found.choice {
            Uniqueness::Unique => "unique",
            Uniqueness::MinimumNorm => "minimum-norm",
            Uniqueness::Pushing => "pushing",
        }
    }

    /// Compares the number of self-stresses with that in exact geometry.
    pub(super) fn compare_with(&mut self, exact: Option<usize>) {
        self.exact_self_stresses = exact.filter(|&n| n != self.found.self_stresses.len());
    }

    fn joint_name(&self, joint: JointId) -> &'a str {
        &self.of.joints[joint].id
    }

    /// Returns the name of a joint and its type.
    fn joint_and_type(&self, joint: JointId) -> [String; 2] {
        let kind = self.of.joints[joint].joint_type.name();
        [self.joint_name(joint), kind].map(str::to_owned)
    }

    fn couplings(&self) -> Vec<Coupled<'a>> {
        state_couplings(self.of, self.state, &self.found.couplings)
    }

    /// Returns all of it as data.
    pub fn json(&self) -> Value {
        let s = self.found;
        let joints = |list: &Vec<JointReaction>| -> Value {
            list.iter()
                .map(|r| self.joint_json(r, &[false; 6]))
                .collect()
        };
        let coupled = |list: &Vec<CouplingReaction>| -> Value {
            let all = state_couplings(self.of, self.state, list);
            all.iter().map(|c| c.json(false)).collect()
        };
        let contact = |c: &ContactForce| {
            let head = json!({ "contact": self.joint_name(c.joint), "touch": touch_word(c) });
            join_objects([head, json!(c)])
        };
        let reactions = s.reactions.iter().zip(&s.open);
        let all = self.couplings().into_iter().zip(&s.couplings_open);
        json!({
            "mechanism": self.of.name,
            "state": self.of.states[self.state],
            "unique": self.is_unique(),
            "choice": self.choice_word(),
            // What moments are divided by in that norm `[m]`.
            "size": s.size,
            "condition": s.condition,
            "nearly_singular": s.nearly_singular(),
            "residual": s.residual,
            "undriven": s.undriven,
            "contacts": s.contacts.iter().map(contact).collect::<Value>(),
            "reactions": reactions.map(|(r, open)| self.joint_json(r, open)).collect::<Value>(),
            "couplings": all.map(|(c, open)| c.json(*open)).collect::<Value>(),
            // Those that load nothing from outside, one set for each redundant constraint.
            "self_stresses": s.self_stresses.iter().map(joints).collect::<Value>(),
            "coupling_stresses": s.coupling_stresses.iter().map(coupled).collect::<Value>(),
            "exact_self_stresses": self.exact_self_stresses,
            // Those of elastic joints, where stiffness is stated and it matters.
            "elastic": s.elastic.as_ref().map(joints),
            "elastic_couplings": s.elastic_couplings.as_ref().map(coupled),
        })
    }

    fn joint_json(&self, r: &JointReaction, open: &[bool; 6]) -> Value {
        let joint = &self.of.joints[r.joint];
        let drive = r
            .effort
            .map(|(freedom, effort)| json!({ "freedom": freedom.name(), "effort": effort }));
        join_objects([
            json!({
                "joint": joint.id,
                "type": joint.joint_type.name(),
                "links": joint.links.map(|l| &self.of.links[l].id),
            }),
            json!(r),
            json!({
                "force_magnitude": r.force_size(),
                "moment_magnitude": r.moment_size(),
                "global_force": r.global_force(),
                "global_moment": r.global_moment(),
                // Part of force and moment.
                "drive": drive,
                "open": open_components(open),
            }),
        ])
    }

    /// Returns one joint a line, and one for each joint of a coupling.
    pub fn csv(&self) -> String {
        write_table(&HEADS.split(',').collect_vec(), self.csv_rows())
    }

    fn csv_rows(&self) -> impl Iterator<Item = Vec<String>> {
        let s = self.found;
        let given = self.rows_of(self.choice_word(), &s.reactions, self.couplings());
        let coupled = s.elastic_couplings.iter();
        let coupled = coupled.flat_map(|list| state_couplings(self.of, self.state, list));
        let elastic = s.elastic.as_deref().unwrap_or_default();
        given
            .into_iter()
            .chain(self.rows_of("elastic", elastic, coupled.collect()))
    }

    fn rows_of(
        &self,
        kind: &str,
        list: &[JointReaction],
        coupled: Vec<Coupled<'_>>,
    ) -> Vec<Vec<String>> {
        let joint = |r: &JointReaction| {
            let mut row = self.joint_and_type(r.joint).to_vec();
            for (vector, size) in [(r.force, r.force_size()), (r.moment, r.moment_size())] {
                row.extend(vector.map(|x| x.to_string()));
                row.push(size.to_string());
            }
            let effort = r
                .effort
                .map(|(of, x)| [x.to_string(), effort_unit(of).to_owned()]);
            row.extend(effort.unwrap_or_default());
            row
        };
        let rows = list.iter().map(joint);
        let rows = rows.chain(coupled.iter().flat_map(Coupled::csv_rows));
        rows.map(|row| [vec![kind.to_owned()], row].concat())
            .collect()
    }
}

const HEADS: &str = "kind,joint,type,Fx,Fy,Fz,F,Mx,My,Mz,M,effort,effort_unit";
