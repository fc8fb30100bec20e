//! Single changes: how many redundant constraints each removes alone, before any search.
//!
//! A change appends columns to J for the freedoms it adds. Its gain is their rank modulo the image of J, and W grows by the number of new
//! columns less the gain. If the gain is the number of its columns, the change removes that many redundant constraints and alters no
//! motion. The gain follows from the self-stresses. It is the rank of the power of the wrenches in the joint on the new freedoms, a matrix
//! of at most six rows.

use crate::closure::Closure;
use crate::closure::twist::{MotionSpace, joint_twists};
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, JointId, JointOption, Mechanism, StateId};
use crate::redundancy::analysis::exact_field;
use crate::redundancy::stress::stress_basis;
use crate::redundancy::stress_loads::JointWrenches;
use crate::search::question::cost::CostTable;
use crate::search::reduce::self_stress_space::is_contained;
use std::cmp::Reverse;

/// Joint types that are tried in place of the mechanism's joints if the file offers nothing.
pub const USUAL: [JointType; 5] = [
    JointType::Cylindrical,
    JointType::Universal,
    JointType::Spherical,
    JointType::CylindricalUniversal,
    JointType::SphereInCylinder,
];
/// And in series with the joints that a state adds.
pub const USUAL_UNLOADING: JointType = JointType::Spherical;

/// One change.
#[derive(Debug, Clone)]
pub struct Suggestion {
    /// The joint.
    pub joint: JointId,
    /// The new joint, if the original one is replaced.
    pub to: Option<JointOption>,
    /// The unloading joint inserted in series, where one is.
    pub unloading: Option<JointOption>,
    /// Redundant constraints that go: as many as the change adds freedoms.
    pub removes: usize,
    /// Cost of the change in thousandths.
    pub cost_milli: i64,
}

/// The single changes of a state that remove redundant constraints and nothing else.
#[derive(Debug, Clone)]
pub struct Suggestions {
    /// The state: of the free one all joints are tried, of another those that it adds.
    pub state: StateId,
    /// σ of the state, modulo a prime.
    pub redundant: usize,
    /// Whether the file offered nothing here, so that the usual joints were tried.
    pub usual: bool,
    /// Number of changes tried.
    pub tried: usize,
    /// The changes, those that remove most first, then the cheaper, then in file order.
    pub list: Vec<Suggestion>,
}

/// Tries every single change.
///
/// # Guarantee
/// Ranks modulo a prime near 2^61, as in the search.
///
/// # Complexity
/// One elimination of J. For each change, an elimination of six by six numbers.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, search::answer::single_changes::single_changes};
/// let found = single_changes(&ozols::built_in("four-bar")?, StateId::FREE)?;
/// assert_eq!((found.redundant, found.list[0].removes), (3, 2)); // A ball joint removes two.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn single_changes(mechanism: &Mechanism, state: StateId) -> Result<Suggestions, ExactError> {
    let exact = &exact_field(mechanism, 0)?;
    let motion = MotionSpace::new(exact, &mechanism.mode)?;
    let closure = Closure::new(exact, mechanism, state)?;
    let stresses = stress_basis(exact, &closure);
    let costs = CostTable::new(&mechanism.search.costs);
    let joints: Vec<JointId> = match state {
        StateId::FREE => mechanism.joints_in(state).collect(),
        _ => mechanism.joints_added_in(state).collect(),
    };
    let offered = |j: &JointId| {
        let joint = &mechanism.joints[*j];
        !possible_changes(joint, &present_option(joint), state, false).is_empty()
    };
    let usual = !joints.iter().any(offered);
    let twists = |o: &JointOption| -> Result<Vec<Vec<Residue>>, ExactError> {
        let all = joint_twists(exact, &motion, &o.frame, &o.joint_type)?;
        Ok(all.into_iter().map(|(_, t)| t).collect())
    };
    let borne = JointWrenches::new(exact, mechanism, &closure)?;
    let (mut tried, mut list) = (0, Vec::new());
    for j in joints {
        let joint = &mechanism.joints[j];
        let present = present_option(joint);
        let own = twists(&present)?;
        let borne = stresses.iter().map(|s| borne.coordinates_at(s, j));
        let wrenches = Echelon::from_vectors(exact.field(), borne).reduced_rows();
        for (to, unloading) in possible_changes(joint, &present, state, usual) {
            let mut columns = twists(to.as_ref().unwrap_or(&present))?;
            if !is_contained(exact.field(), &[&own, &columns]) {
                continue;
            }
            if let Some(u) = &unloading {
                columns.extend(twists(u)?);
            }
            tried += 1;
            let removes = columns.len() - own.len();
            if removes > 0 && power_rank(exact, &wrenches, &columns) == removes {
                let cost_milli =
                    costs.change_cost(&present, joint.drive, to.as_ref(), unloading.as_ref());
                list.push(Suggestion {
                    joint: j,
                    to,
                    unloading,
                    removes,
                    cost_milli,
                });
            }
        }
    }
    // The sort is stable: what is alike stays in file order.
    list.sort_by_key(|s| (Reverse(s.removes), s.cost_milli));
    Ok(Suggestions {
        state,
        redundant: stresses.len(),
        usual,
        tried,
        list,
    })
}

/// Returns the original joint as an option.
fn present_option(joint: &Joint) -> JointOption {
    let own = || JointOption::in_frame_of(joint, &joint.joint_type);
    joint.options.first().cloned().unwrap_or_else(own)
}

type Change = (Option<JointOption>, Option<JointOption>);

/// Returns the possible changes of a joint: another joint, an unloading joint, or both.
fn possible_changes(
    joint: &Joint,
    present: &JointOption,
    state: StateId,
    usual: bool,
) -> Vec<Change> {
    if usual {
        let option = |t: &JointType| JointOption::in_frame_of(joint, t);
        return match (state, joint.drive, &joint.joint_type) {
            (StateId::FREE, true, _) | (StateId::FREE, _, JointType::Fixed) => Vec::new(),
            (StateId::FREE, ..) => {
                let others = USUAL.iter().filter(|t| **t != present.joint_type);
                others.map(|t| (Some(option(t)), None)).collect()
            }
            _ => vec![(None, Some(option(&USUAL_UNLOADING)))],
        };
    }
    let offered = |o: &&JointOption| o.state.is_none_or(|s| s == state);
    let inserted = joint.unloading.iter().filter(offered).cloned().map(Some);
    let inserted = std::iter::once(None).chain(inserted);
    inserted
        .flat_map(|u| {
            let others = joint.options.iter().skip(1).filter(offered);
            let others = others.cloned().map(Some);
            let kept = std::iter::once(None);
            kept.chain(others).map(move |to| (to, u.clone()))
        })
        .filter(|(to, u)| to.is_some() || u.is_some())
        .collect()
}

/// Returns the rank of the matrix of powers of the wrenches on some twists.
fn power_rank(exact: &ExactField, wrenches: &[Vec<Residue>], twists: &[Vec<Residue>]) -> usize {
    let f = exact.field();
    let powers = |t: &Vec<Residue>| wrenches.iter().map(|w| f.dot(w, t)).collect::<Vec<_>>();
    Echelon::from_vectors(f, twists.iter().map(powers)).rank()
}
