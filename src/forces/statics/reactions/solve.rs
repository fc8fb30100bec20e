//! Reactions of a mechanism in one pose.

use crate::closure::drive::{Driven, driven_freedoms};
use crate::model::loads::Loads;
use crate::model::mechanism::{LinkId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::contact::{Contacts, find_contacts};
use crate::statics::reactions::equations::{self, System, Transmitted};
use crate::statics::reactions::geometry::{Geometry, Six, wrench_power};
use crate::statics::reactions::loads::{Borne, link_loads, range_period};
use crate::statics::reactions::solution::{
    NO_STRESS, Solution, Uniqueness, left_over, open_components, open_couplings,
    passed_by_couplings, present_reactions,
};
use crate::statics::reactions::unilateral::{TOLERANCE, push_only};
use crate::statics::reactions::unsolved::Unsolved;
use crate::statics::{greatest_abs, over_load, rounding_size};

/// Fraction of the loads below which work on undriven motions counts as zero.
const NO_WORK: f64 = 1e-8;

/// Solves for reactions.
#[derive(Debug)]
pub struct Reactions;

impl Borne {
    /// Returns the reactions to these loads, with the requested treatment of contacts.
    ///
    /// # Errors
    /// Returns an [`Unsolved`].
    pub(crate) fn solve_loads(
        &self,
        m: &Mechanism,
        drives: &[Driven],
        contacts: Contacts,
    ) -> Result<Solution, Unsolved> {
        Reactions::solve_wrenches(m, &m.loads, &self.geometry, &self.sums, drives, contacts)
    }
}

impl Reactions {
    /// Returns the reactions at the pose of the file.
    ///
    /// # Errors
    /// Returns an [`Unsolved`].
    ///
    /// # Complexity
    /// O((6k)²·f) for k contours and f freedoms.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, statics::reactions::solve::Reactions};
    /// let loaded = ozols::built_in("gripper-10-loaded")?;
    /// let found = Reactions::solve_at_home(&loaded, StateId::FREE, &loaded.loads)?;
    /// assert_eq!(found.reactions.len(), loaded.joints_in(StateId::FREE).count());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn solve_at_home(
        m: &Mechanism,
        state: StateId,
        loads: &Loads,
    ) -> Result<Solution, Unsolved> {
        let pose = Pose::of_file(m, state)?;
        let drives = driven_freedoms(m, state);
        Self::solve_at(m, state, loads, &pose, 0.0, &drives)
    }

    /// Returns the reactions at any pose, with the freedoms that the drives hold. The first drive is `drive` `[rad]` or file units away
    /// from the pose of the file.
    ///
    /// # Errors
    /// Returns an [`Unsolved`].
    pub fn solve_at(
        m: &Mechanism,
        state: StateId,
        loads: &Loads,
        pose: &Pose,
        drive: f64,
        drives: &[Driven],
    ) -> Result<Solution, Unsolved> {
        let geometry = Geometry::new(m, state, pose)?;
        let of_links = link_loads(m, loads, &geometry, pose, drive, range_period(drives));
        Self::solve_wrenches(m, loads, &geometry, &of_links, drives, Contacts::AsJoints)
    }

    /// Returns the reactions to one wrench per link.
    pub(crate) fn solve_wrenches(
        m: &Mechanism,
        loads: &Loads,
        geometry: &Geometry,
        loads_of_links: &[Six],
        drives: &[Driven],
        of_contacts: Contacts,
    ) -> Result<Solution, Unsolved> {
        let system = System::new(geometry, drives)?;
        let particular = geometry.along_tree(m.joints.len(), loads_of_links);
        let mut of = Transmitted::of_joints(geometry, particular.clone());
        let left = system.balance_work(&mut of);
        let scale = greatest_abs(particular.iter().flatten());
        let work = greatest_abs(&left);
        if work > NO_WORK * scale {
            return Err(Unsolved::Moves {
                link: carried_most(m, geometry, &system, &left, loads_of_links),
                mobility: system.undriven_freedoms(),
            });
        }
        let stresses = system.self_stresses(m.joints.len());
        let rigid = of.clone();
        equations::least_norm(geometry, &mut of, &stresses);
        let faces = match of_contacts {
            Contacts::Pushing => find_contacts(m, geometry)?,
            // If the side is unknown, pulling cannot be detected.
            Contacts::AsJoints => find_contacts(m, geometry).unwrap_or_default(),
        };
        if of_contacts == Contacts::Pushing {
            push_only(geometry, &faces, &mut of, &stresses)?;
        }
        // Elastic joints are only solved with contacts as joints.
        let elastic = match of_contacts {
            Contacts::AsJoints => {
                equations::elastic_reactions(m, geometry, loads, rigid, &stresses)
            }
            Contacts::Pushing => None,
        };
        // Wrenches start as those of the loads along the tree, so their rounding is relative to these.
        let rounding = |t: &Transmitted, beside: f64| {
            let left_over = left_over(m, geometry, &t.joints, loads_of_links);
            let all = greatest_abs(t.joints.iter().flatten().chain(&t.couplings));
            rounding_size(left_over, all.max(beside), 6 * geometry.joints.len())
        };
        let mut least = rounding(&of, scale);
        if of_contacts == Contacts::Pushing {
            least = least.max(TOLERANCE * greatest_abs(of.joints.iter().flatten()));
        }
        let elastic = elastic.map(|(t, strained)| {
            let least = rounding(&t, scale.max(strained));
            (t, least)
        });
        let load = greatest_abs(loads_of_links.iter().flatten());
        let left_over = left_over(m, geometry, &of.joints, loads_of_links);
        let present = |t: &Transmitted, rounding: f64| {
            present_reactions(m, geometry, &t.own_wrenches(geometry), drives, rounding)
        };
        let passed =
            |t: &Transmitted, rounding: f64| passed_by_couplings(geometry, &t.couplings, rounding);
        let self_stresses: Vec<_> = stresses.iter().map(|t| present(t, NO_STRESS)).collect();
        let of_couplings = stresses.iter().map(|t| &t.couplings[..]);
        Ok(Solution {
            choice: reaction_choice(of_contacts, stresses.is_empty()),
            contacts: {
                let own = of.own_wrenches(geometry);
                let forces = faces.iter().map(|c| c.contact_force(geometry, &own));
                forces
                    .map(|f| f.drop_rounding(least, geometry.size))
                    .collect()
            },
            reactions: present(&of, least),
            couplings: passed(&of, least),
            couplings_open: open_couplings(geometry.couplings.len(), of_couplings),
            coupling_stresses: stresses.iter().map(|t| passed(t, NO_STRESS)).collect(),
            open: open_components(geometry.joints.len(), geometry.size, &self_stresses),
            self_stresses,
            elastic_couplings: elastic.as_ref().map(|(t, least)| passed(t, *least)),
            elastic: elastic.as_ref().map(|(t, least)| present(t, *least)),
            undriven: system.undriven_freedoms(),
            condition: system.condition_number(),
            residual: over_load(left_over, load),
            size: geometry.size,
        })
    }
}

/// Returns the loaded link that the motion moves most, or otherwise the fastest one, by the remaining work in the
/// equations.
fn carried_most(
    m: &Mechanism,
    geometry: &Geometry,
    system: &System,
    left: &[f64],
    loads: &[Six],
) -> String {
    let mut speeds = vec![0.0; geometry.columns.len()];
    for (&c, x) in system.equations.iter().zip(left) {
        speeds[c] = *x;
    }
    let twists = geometry.link_twists(m.links.len(), &speeds);
    let gain = |l: LinkId| -wrench_power(&twists[l], &loads[l]).abs();
    let most = m.link_ids().min_by(|&a, &b| gain(a).total_cmp(&gain(b)));
    most.map_or_else(String::new, |l| m.links[l].id.clone())
}

/// Returns how the reactions are chosen if self-stresses leave them open.
fn reaction_choice(of_contacts: Contacts, is_unique: bool) -> Uniqueness {
    match of_contacts {
        _ if is_unique => Uniqueness::Unique,
        Contacts::AsJoints => Uniqueness::MinimumNorm,
        Contacts::Pushing => Uniqueness::Pushing,
    }
}
