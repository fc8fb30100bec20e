//! Self-stresses: the wrenches in an overconstrained mechanism without any load, once a part is slightly inaccurate.
//!
//! They are the left null vectors of the closure matrix. Each row block is the wrench that a contour transmits. The
//! entry of a coupling's row is the force or moment that it transmits from one joint to the other.
//!
//! The module also counts self-stresses with the freedoms of drives held, in exact geometry. The singular values used
//! for reactions treat nearly dependent rows as dependent.

use crate::closure::contour::Contour;
use crate::closure::{Closure, Column};
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{Echelon, linear_combination, linear_relations};
use crate::linalg::modp::Residue;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{JointId, Mechanism, Mode, StateId};
use crate::model::rounded::looks_rounded;
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::redundancy::stress_loads::JointWrenches;
use crate::redundancy::stress_loads::{Borne, Faces, Shares};
use itertools::Itertools;

/// Effect of a self-stress on the parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressVerdict {
    /// Only friction at the faces of shared-load contacts: tangential forces, or a moment about their normal.
    Harmless,
    /// Moments that faces or bearings must carry, or forces that press parts together.
    Harmful,
}

/// Components of a wrench at a joint, as moments and forces along the global axes.
#[derive(Debug, Clone, PartialEq)]
pub struct JointWrench {
    /// The joint.
    pub joint: JointId,
    /// Whether the moments about x, y, z through the joint's point are nonzero.
    pub moments: [bool; 3],
    /// Whether the forces along x, y, z are nonzero.
    pub forces: [bool; 3],
    /// The wrench in numbers, or `None` if it is not computed, see [`Shares`].
    pub borne: Option<Borne>,
}

/// One self-stress of a basis.
#[derive(Debug, Clone)]
pub struct SelfStress {
    /// Indices of the contours that transmit a wrench.
    pub contours: Vec<usize>,
    /// Indices of the couplings that transmit a force or moment from joint to joint, among those of the state.
    pub couplings: Vec<usize>,
    /// The wrench on each joint of those contours, including its couplings.
    pub joints: Vec<JointWrench>,
    /// Whether the self-stress exists only with the state's additional joints.
    pub external: bool,
    /// Harmless or harmful.
    pub verdict: StressVerdict,
    /// ℓ, the size of the mechanism by which moments are divided, in the file's unit.
    pub size: f64,
    /// It as the numbers of the closure's rows; empty if these are not computed.
    numbers: Vec<f64>,
}

impl SelfStress {
    /// Returns the load on each joint in other poses; each pose is a mechanism with its joints moved. Each pose has the self-stress that
    /// is nearest to that of the pose before it, beginning with this one at `start`. The list is empty for a pose without any. `count`
    /// is the number of independent self-stresses, and `contours` are those of the analysis.
    ///
    /// # Complexity
    /// One singular value decomposition of J for each pose.
    #[must_use]
    pub fn loads_along(
        &self,
        (poses, start): (&[Mechanism], usize),
        (state, contours): (StateId, &[Contour]),
        count: usize,
    ) -> Vec<Vec<Borne>> {
        let mut out = vec![Vec::new(); poses.len()];
        for walk in [
            (start..poses.len()).collect_vec(),
            (0..start).rev().collect(),
        ] {
            let mut numbers = self.numbers.clone();
            for i in walk {
                let Ok(shares) = Shares::new(&poses[i], state, contours) else {
                    continue;
                };
                numbers = shares.nearest_to(&numbers, count).unwrap_or(numbers);
                out[i] = shares.loads_under(&numbers).unwrap_or_default();
            }
        }
        out
    }
}

/// Returns the left kernel of J in the echelon form that uses the earliest possible contours. Each vector ends in a one
/// at which no other vector has an entry, and they are sorted by their ends.
///
/// # Complexity
/// One elimination of J.
#[must_use]
pub(crate) fn stress_basis(exact: &ExactField, closure: &Closure<Residue>) -> Vec<Vec<Residue>> {
    Echelon::from_vectors(exact.field(), closure.dense_columns(exact)).null_space(closure.rows())
}

/// The self-stresses of a state, with those that load none of its added joints separate from the others.
struct Stresses<'a> {
    wrenches: JointWrenches<'a, ExactField>,
    internal: Vec<Vec<Residue>>,
    /// Those with only friction at the contacts come first.
    external: Vec<Vec<Residue>>,
    /// The added joints that are faces.
    faces: Vec<JointId>,
    /// The face at which moments are evaluated.
    reference: Option<JointId>,
}

impl<'a> Stresses<'a> {
    fn new(
        exact: &'a ExactField,
        mechanism: &'a Mechanism,
        closure: &'a Closure<Residue>,
    ) -> Result<Stresses<'a>, ExactError> {
        let wrenches = JointWrenches::new(exact, mechanism, closure)?;
        let added: Vec<JointId> = mechanism.joints_added_in(closure.state).collect();
        let at_added = |s: &[Residue]| -> Vec<Residue> {
            added
                .iter()
                .flat_map(|&j| wrenches.wrench_at(s, j))
                .collect()
        };
        let (internal, external) =
            first_those_without(exact, stress_basis(exact, closure), &at_added);
        let faces: Vec<JointId> = added
            .iter()
            .copied()
            .filter(|&j| mechanism.joints[j].joint_type == JointType::Fixed)
            .collect();
        let mut out = Stresses {
            wrenches,
            internal,
            external,
            faces,
            reference: None,
        };
        // Forces along two separate faces form a couple that one of them must carry as a shift of pressure. So moments
        // are evaluated at one face: the one that shows the most friction.
        let friction = |reference: Option<JointId>| {
            let harm = |s: &Vec<Residue>| out.harm_at(s, reference);
            let images: Vec<Vec<Residue>> = out.external.iter().map(harm).collect();
            linear_relations(exact.field(), &images).len()
        };
        let faces = out.faces.iter().copied().rev();
        out.reference = faces.max_by_key(|&j| friction(Some(j)));
        if !out.faces.is_empty() {
            let stresses = std::mem::take(&mut out.external);
            let (friction, harmful) = first_those_without(exact, stresses, &|s| out.harm_of(s));
            out.external = [friction, harmful].concat();
        }
        Ok(out)
    }

    fn harm_at(&self, s: &[Residue], reference: Option<JointId>) -> Vec<Residue> {
        let part = |&j: &JointId| self.wrenches.harm_at_face(s, j, Some(j) == reference);
        self.faces.iter().flat_map(part).collect()
    }

    fn harm_of(&self, s: &[Residue]) -> Vec<Residue> {
        self.harm_at(s, self.reference)
    }

    /// Returns true if an external stress is only friction.
    fn is_friction(&self, s: &[Residue]) -> bool {
        !self.faces.is_empty() && self.harm_of(s).iter().all(|&x| x == 0)
    }
}

/// Returns the number of self-stresses that load the joints added by a state with more than friction.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// One elimination of J, O((6k)² f). A few eliminations of the stresses.
pub(crate) fn harmful_count(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Result<usize, ExactError> {
    let stresses = Stresses::new(exact, mechanism, closure)?;
    let harmful = stresses
        .external
        .iter()
        .filter(|s| !stresses.is_friction(s));
    Ok(harmful.count())
}

/// Returns a sparse basis of the self-stresses of a state: first those of the free state's contours, then those that
/// need the additional ones. Among the latter, those with only friction at the contacts come first.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// One elimination of J, O((6k)² f), and one per joint and stress.
pub(crate) fn self_stresses(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Result<Vec<SelfStress>, ExactError> {
    let stresses = Stresses::new(exact, mechanism, closure)?;
    let wrenches = &stresses.wrenches;
    let mut shares = Shares::new(mechanism, closure.state, &closure.contours)?;
    let size = shares.size();
    let at_faces = Faces {
        joints: &stresses.faces,
        reference: stresses.reference,
    };
    let mut describe = |s: &Vec<Residue>, is_external: bool| {
        let contours = (0..closure.contours.len())
            .filter(|i| {
                s[i * closure.dim..(i + 1) * closure.dim]
                    .iter()
                    .any(|&x| x != 0)
            })
            .collect_vec();
        let couplings = (0..closure.couplings.len())
            .filter(|q| s[closure.contour_rows() + q] != 0)
            .collect();
        let friction = is_external && stresses.is_friction(s);
        let numbers = shares.numbers_of(s, friction.then_some(at_faces));
        let borne = numbers.as_ref().and_then(|n| shares.loads_under(n));
        let joints = mechanism.joints_in(closure.state).filter_map(|j| {
            let w = wrenches.wrench_at(s, j);
            let nonzero = |v: [Residue; 3]| v.map(|x| x != 0);
            w.iter().any(|&x| x != 0).then(|| JointWrench {
                joint: j,
                moments: nonzero(wrenches.moment_at(j, &w)),
                forces: nonzero([w[3], w[4], w[5]]),
                borne: borne.as_ref().map(|b| b[j]),
            })
        });
        SelfStress {
            contours,
            couplings,
            joints: joints.collect(),
            external: is_external,
            size,
            numbers: numbers.unwrap_or_default(),
            verdict: if friction {
                StressVerdict::Harmless
            } else {
                StressVerdict::Harmful
            },
        }
    };
    let internal = stresses.internal.iter().map(|s| (s, false));
    let all = internal.chain(stresses.external.iter().map(|s| (s, true)));
    Ok(all
        .map(|(s, is_external)| describe(s, is_external))
        .collect())
}

/// Returns a basis of the stresses whose linear `part` is zero, and its completion to a basis of all. It uses unchanged
/// stresses of the list if possible.
fn first_those_without(
    exact: &ExactField,
    stresses: Vec<Vec<Residue>>,
    part: &dyn Fn(&[Residue]) -> Vec<Residue>,
) -> (Vec<Vec<Residue>>, Vec<Vec<Residue>>) {
    let f = exact.field();
    let (mut with, mut without) = (Vec::new(), Vec::new());
    for s in stresses {
        let image = part(&s);
        if image.iter().all(|&x| x == 0) {
            without.push(s)
        } else {
            with.push((s, image))
        }
    }
    let (with, images): (Vec<_>, Vec<_>) = with.into_iter().unzip();
    let vanishing = linear_relations(f, &images);
    without.extend(
        vanishing
            .iter()
            .map(|factors| linear_combination(f, &with, factors)),
    );
    let mut span = Echelon::from_vectors(f, &without);
    let rest = with.into_iter().filter(|s| span.insert(s)).collect();
    (without, rest)
}

/// Returns the number of self-stresses of a state in the pose of the file, with the freedoms that drives hold, by one
/// prime. Returns `None` for planar mechanisms, whose equations differ, and if coordinates look rounded, so that the
/// result would mean nothing.
///
/// # Complexity
/// That of [`modular::rank_modulo`].
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, redundancy::stress::exact_self_stresses};
/// let four_bar = ozols::built_in("four-bar")?;
/// assert_eq!(exact_self_stresses(&four_bar, StateId::FREE, &[]), Some(3));
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn exact_self_stresses(
    m: &Mechanism,
    state: StateId,
    drives: &[(JointId, Freedom)],
) -> Option<usize> {
    if matches!(m.mode, Mode::Planar { .. }) || looks_rounded(m).is_some() {
        return None;
    }
    let exact = field_of(m, state, 0).ok()?;
    let mut closure = Closure::new(&exact, m, state).ok()?;
    let held = |c: &Column<Residue>| drives.contains(&(c.joint, c.freedom));
    // Held freedoms stay as zero columns, because the rows of couplings refer to columns by index.
    for (i, column) in closure
        .columns
        .iter_mut()
        .enumerate()
        .filter(|(_, c)| held(c))
    {
        column.twist.fill(0);
        let entries = closure.couplings.iter_mut().flat_map(|q| &mut q.entries);
        entries.filter(|(c, _)| *c == i).for_each(|(_, x)| *x = 0);
    }
    Some(closure.rows() - modular::rank_modulo(&exact, &closure))
}
