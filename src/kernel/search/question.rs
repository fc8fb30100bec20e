//! The question of a search: the space of variants, their conditions and costs, and the prepared mechanism.

pub mod conditions;
pub mod cost;
pub mod grasp;
pub mod kept;
pub(crate) mod own_images;
pub mod rounded_rank;
mod second_axes;
pub mod space;
pub(crate) mod symmetry;
pub mod throughout;

use crate::closure::contour::{Contour, contour_basis};
use crate::geom::exact::{ExactError, ExactField};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::redundancy::motion::joint_motion;
use crate::search::answer::keys::{Key, Steps};
use crate::search::question::conditions::{Conditions, OPEN, SearchError, Symmetry};
use crate::search::question::cost::CostTable;
use crate::search::question::grasp::{Grasp, find_grasps, is_free, loose_bodies};
use crate::search::question::kept::{Followed, Kept};
use crate::search::question::own_images::{Carried, OwnSymmetry};
use crate::search::question::space::{Space, Variable, choice_name};
use crate::search::question::throughout::{PoseOnly, Throughout};
use crate::search::reduce::biconnected::{Block, find_blocks};
use crate::search::reduce::self_stress_space::is_contained;
use itertools::Itertools;
use num_bigint::BigUint;
use std::sync::Arc;

/// A prepared question: the space of variants, its costs, and the data of its diagrams.
///
/// # Examples
/// ```
/// use ozols::{rank::exact::field::exact_field, search::{Search, diagram::Control, question::conditions::Conditions}};
/// let gripper = ozols::built_in("gripper-10")?;
/// let search = Search::new(exact_field(&gripper, 0)?, &gripper, Conditions::default())?;
/// let diagrams = search.build_diagrams(Control::NONE);
/// let counts = search.count_variants(&diagrams.admissible, true);
/// assert_eq!(counts.to_string(), "25761436"); // In the drawn pose.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Question {
    /// The mechanism.
    pub mechanism: Arc<Mechanism>,
    /// The conditions on variants.
    pub conditions: Conditions,
    /// The space (with images of each other as one variable where only symmetric variants are wanted).
    pub space: Space,
    /// Its costs.
    pub steps: Steps,
    /// The field in which it is answered, with all numbers of the mechanism.
    pub exact: ExactField,
    /// The contours of the free state, and the rows of J in it.
    pub(in crate::search) contours: Vec<Contour>,
    pub(in crate::search) rows: i64,
    /// The links and drives that must keep their motion.
    pub(in crate::search) kept: Kept,
    /// The choices along the motion, or why only the drawn pose is asked about.
    pub(in crate::search) throughout: throughout::Followed,
    /// Dimension of that motion by singular values, where exact arithmetic has another mechanism than the one meant.
    pub(in crate::search) present: Option<usize>,
    /// The bodies that must be held in the searched state.
    pub(in crate::search) grasps: Vec<Grasp>,
    /// The blocks of the diagram of determinate variants, and of the other.
    pub(in crate::search) blocks: [Vec<Block>; 2],
}

/// Returns the links whose motion may be kept: outputs and the bodies to hold, if they are in the free state.
fn kept_links(mechanism: &Mechanism) -> Vec<LinkId> {
    let outputs = mechanism
        .link_ids()
        .filter(|&l| mechanism.links[l].role == Role::Output);
    let mut kept: Vec<LinkId> = outputs
        .chain(mechanism.search.hold.iter().copied())
        .filter(|&l| is_free(mechanism, l))
        .collect();
    kept.sort_unstable();
    kept.dedup();
    kept
}

/// Returns the number of joints of the free state that are in none of its contours.
fn count_open_joints(mechanism: &Mechanism, contours: &[Contour]) -> usize {
    let joints = contours.iter().flat_map(|c| &c.joints);
    let closed = joints.map(|(j, _)| j).unique();
    mechanism.joints_in(StateId::FREE).count() - closed.count()
}

/// Checks that every choice in the free state has the motions of the original joint, which are divided out of the diagrams.
fn check_options(
    exact: &ExactField,
    mechanism: &Mechanism,
    space: &Space,
) -> Result<(), SearchError> {
    let free = space.variables.iter().filter(|v| !v.external);
    for (variable, choice) in free.flat_map(|v| v.choices.iter().map(move |c| (v, c))) {
        let spans = variable.choices[0].spans.iter().zip(&choice.spans);
        for (&joint, (present, span)) in variable.joints.iter().zip(spans) {
            if !is_contained(exact.field(), &[present, span]) {
                return Err(SearchError::LosesMotion {
                    joint: mechanism.joints[joint].id.clone(),
                    option: choice_name(mechanism, joint, choice),
                });
            }
        }
    }
    Ok(())
}

/// Returns the frame, the links that are kept to the end, and the links of joints that follow the common ones.
fn pinned_links(mechanism: &Mechanism, space: &Space, to_end: &[LinkId]) -> Vec<LinkId> {
    let mut pinned = vec![mechanism.frame_link()];
    pinned.extend(to_end);
    let later = space.variables.iter().filter(|v| v.alone || v.external);
    let later = later.flat_map(|v| &v.joints);
    pinned.extend(later.flat_map(|&j| mechanism.joints[j].links));
    pinned.sort_unstable();
    pinned.dedup();
    pinned
}

/// Returns the blocks of the variables of the free state, and those of the common ones between links that are `pinned`.
fn both_blocks(
    mechanism: &Mechanism,
    space: &Space,
    pinned: &[LinkId],
    contours: &[Contour],
) -> [Vec<Block>; 2] {
    let variables = |wanted: fn(&Variable) -> bool| -> Vec<usize> {
        let all = 0..space.variables.len();
        all.filter(|&v| wanted(&space.variables[v])).collect()
    };
    let free = variables(|v| !v.external);
    let common = variables(|v| !v.external && !v.alone);
    [(free, &[][..]), (common, pinned)]
        .map(|(of, pinned)| find_blocks(mechanism, space, &of, pinned, contours))
}

/// Returns each symmetry of these orders that the geometry has, where the file states none. `loosely` is as in
/// [`OwnSymmetry::find_symmetry`].
fn find_symmetries<'a>(
    exact: &'a ExactField,
    mechanism: &'a Mechanism,
    state: Option<StateId>,
    orders: &'a [usize],
    loosely: Option<&'a Mechanism>,
) -> impl Iterator<Item = Carried> + 'a {
    let unstated = orders
        .iter()
        .filter(|_| mechanism.search.symmetry_order() == 1);
    unstated.filter_map(move |&order| {
        OwnSymmetry::find_symmetry(exact, mechanism, state, order, loosely)
    })
}

impl Question {
    /// Makes a question ready; a mechanism given by reference is copied.
    ///
    /// # Errors
    /// Returns an error if the geometry has no exact image, or if symmetry is required of an unsymmetric file.
    pub fn new(
        exact: ExactField,
        mechanism: impl Into<Arc<Mechanism>>,
        mut conditions: Conditions,
    ) -> Result<Self, SearchError> {
        let mut mechanism: Arc<Mechanism> = mechanism.into();
        let followed = Followed::new(&mechanism, &conditions)?;
        if let Some(written) = &mut conditions.written {
            followed.enter_drives(&mut written.mechanism);
        }
        followed.enter_drives(&mut mechanism);
        let searched = conditions.state.map(|s| s.state);
        // What is chosen alike at three legs is more symmetric than what is at two.
        let orders: &[usize] = match conditions.symmetry {
            Symmetry::All => &[],
            Symmetry::SymmetricOnly => &[3, 2],
            Symmetry::OnePerOrbit => &[2, 3],
        };
        let as_written = conditions.written.as_ref().map(|w| w.mechanism.clone());
        let as_written = as_written.unwrap_or_else(|| mechanism.clone());
        let loosely = (conditions.symmetry == Symmetry::SymmetricOnly).then_some(&*as_written);
        let found = find_symmetries(&exact, &mechanism, searched, orders, loosely).next();
        if let Some(found) = found {
            found.apply_to(Arc::make_mut(&mut mechanism));
            if let Some(written) = &mut conditions.written {
                found.apply_to(Arc::make_mut(&mut written.mechanism));
            }
        }
        if conditions.symmetry != Symmetry::All && !mechanism.search.nearly_symmetric {
            symmetry::check_images(&exact, &mechanism, searched)?;
        }
        if conditions.symmetry == Symmetry::OnePerOrbit {
            symmetry::check_drives(&mechanism)?;
        }
        let costs = CostTable::new(&mechanism.search.costs);
        let symmetric = conditions.symmetry == Symmetry::SymmetricOnly;
        let space = Space::new(&exact, &mechanism, searched, symmetric, &costs)?;
        check_options(&exact, &mechanism, &space)?;
        let steps = Steps::new(&space, &costs);
        let links = kept_links(&mechanism);
        let motion = joint_motion(&exact, &mechanism, StateId::FREE, &links)?;
        if mechanism.search.locks_drives && !motion.is_empty() {
            return Err(SearchError::UndecidedOutputs {
                motions: motion.len(),
            });
        }
        let kept = Kept { links, motion };
        let contours = contour_basis(&mechanism, StateId::FREE);
        let open = count_open_joints(&mechanism, &contours);
        if open > OPEN {
            return Err(SearchError::Open { open });
        }
        let rows = space.dim * contours.len() + mechanism.couplings_in(StateId::FREE).count();
        let rows = i64::try_from(rows).unwrap_or(i64::MAX);
        let searched = conditions.state.iter();
        let grasps = searched.flat_map(|s| find_grasps(&mechanism, s.state, s.hold_objects));
        let to_end = if conditions.keep_output {
            kept.kept_bodies(&mechanism)
        } else {
            Vec::new()
        };
        let pinned = pinned_links(&mechanism, &space, &to_end);
        let throughout =
            Throughout::new(&exact, &mechanism, &conditions, &space, &contours, &kept)?;
        Ok(Question {
            throughout,
            grasps: grasps.collect(),
            blocks: both_blocks(&mechanism, &space, &pinned, &contours),
            contours,
            mechanism,
            conditions,
            space,
            steps,
            exact,
            rows,
            kept,
            present: None,
        })
    }

    /// Returns the mechanism with each of its symmetries: that of its file, or else those of its geometry, a third of a turn first.
    #[must_use]
    pub fn symmetric_mechanisms(&self) -> Vec<Arc<Mechanism>> {
        if self.mechanism.search.symmetry_order() > 1 {
            return vec![self.mechanism.clone()];
        }
        let state = self.conditions.state.map(|s| s.state);
        let written = self.conditions.written.as_ref().map(|w| &*w.mechanism);
        let loosely = Some(written.unwrap_or(&self.mechanism));
        let found = find_symmetries(&self.exact, &self.mechanism, state, &[3, 2], loosely);
        let with = |found: Carried| {
            let mut mechanism = Mechanism::clone(&self.mechanism);
            found.apply_to(&mut mechanism);
            Arc::new(mechanism)
        };
        found.map(with).collect()
    }

    /// Returns the bodies that must be held in the searched state.
    pub fn held_bodies(&self) -> impl Iterator<Item = LinkId> + '_ {
        self.grasps.iter().map(|g| g.body)
    }

    /// Returns a warning for each body that must be held and is loose in the present mechanism. No option removes a motion, so no variant
    /// holds such a body.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    pub fn already_loose(&self) -> Result<Vec<String>, ExactError> {
        let Some(s) = self.conditions.state else {
            return Ok(Vec::new());
        };
        let m = &self.mechanism;
        let said = |l: LinkId| {
            let (body, state) = (&m.links[l].id, &m.states[s.state]);
            format!(
                "warning: {body} is loose in state {state} of the mechanism as built, so no variant can hold it; allow loose objects to search anyway"
            )
        };
        let loose = loose_bodies(&self.exact, m, s.state, &self.grasps)?;
        Ok(loose.into_iter().map(said).collect())
    }

    /// Returns whether the searched state joins only kept links and links that it adds. The redundant constraints that it adds then
    /// depend on the joints that it adds and on the motion of the kept links, which is the original one in every admissible variant.
    pub(in crate::search) fn state_joins_kept_links(&self) -> bool {
        let m = &self.mechanism;
        let is_known =
            |l: LinkId| l == m.frame_link() || self.kept.links.contains(&l) || !is_free(m, l);
        let is_coupled = |j: JointId| m.couplings_of(j).next().is_some();
        self.conditions.keep_output
            && self.space.variables.iter().all(|v| {
                let mut joints = v.joints.iter();
                !v.alone
                    && (!v.external
                        || joints.all(|&j| {
                            !is_coupled(j) && m.joints[j].links.into_iter().all(is_known)
                        }))
            })
    }

    /// Returns the dimension of the kept links' original motion.
    #[must_use]
    pub(crate) fn present_motion(&self) -> usize {
        self.present.unwrap_or(self.kept.motion.len())
    }

    /// Returns why only the drawn pose is asked about; `None` where the motion of the mechanism is followed.
    #[must_use]
    pub fn pose_only(&self) -> Option<&PoseOnly> {
        self.throughout.as_ref().err()
    }

    /// Returns the prime field of the search.
    #[must_use]
    pub fn field(&self) -> &ExactField {
        &self.exact
    }

    /// Returns the number of variants in the question. Counts orbits if one of each is wanted.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// assert_eq!(search.size().to_string(), "64"); // Four types at each joint that is not driven.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn size(&self) -> BigUint {
        self.space.size()
    }

    /// Returns W of a variant from its key: f - rank = f - 6k + σ.
    #[must_use]
    pub fn mobility(&self, key: Key) -> i64 {
        i64::from(key.freedoms()) - self.rows + i64::from(key.internal())
    }

    /// Returns the sort key of variants: cost, then W, then changes, then the other properties.
    #[must_use]
    pub fn sort_rank(&self, key: Key) -> (u64, i64, u32, Key) {
        (key.cost(), self.mobility(key), key.changes(), key)
    }

    /// Returns true if a variant's key meets the conditions on mobility and changes.
    #[must_use]
    pub fn is_wanted(&self, key: Key) -> bool {
        self.conditions
            .max_mobility
            .is_none_or(|m| self.mobility(key) <= m)
            && self
                .conditions
                .max_changes
                .is_none_or(|c| key.changes() <= c)
    }

    /// Returns the choices of a variant's image.
    #[must_use]
    pub fn image_of(&self, choices: &[usize]) -> Vec<usize> {
        let mut out = choices.to_vec();
        let variables = &self.space.variables;
        let of = |j: JointId| variables.iter().position(|v| v.joints == [j]);
        for (v, &choice) in variables.iter().zip(choices) {
            let [j] = v.joints[..] else { continue };
            if let Some(to) = of(self.mechanism.search.image_of_joint(j)) {
                out[to] = choice;
            }
        }
        out
    }
}
