//! The group of displacements of each contour, and when it proves a finite motion.
//!
//! The displacement around a contour is a product of its joints' displacements. So it stays in the group whose Lie
//! algebra the joints' twists generate under the bracket. This group has 1 dimension for coaxial hinges, 3 for a planar
//! or spherical contour, 4 for a Schoenflies one, and 6 in general [Hervé 1978]. Closing all contours is a map into the
//! product of these groups.
//!
//! If J has the full rank of that product, the map is a submersion. The closed poses near this one then form a manifold
//! of dimension f - rank J. So the instantaneous mobility is proven to be the finite one, for any σ. Couplings are
//! additional linear maps of the joints' coordinates, and the rank of their rows is added to the product.

use crate::closure::Closure;
use crate::closure::contour::Contour;
use crate::closure::twist::{FrameValues, MotionSpace, joint_twists};
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::rigid::{join_twist, split_twist};
use crate::linalg::echelon::{Echelon, linear_combination, linear_relations};
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism, Mode, StateId};
use itertools::Itertools;

/// Returns the bracket of two twists, [ω1 × ω2; ω1 × v2 + v1 × ω2].
pub(in crate::rank) fn lie_bracket(
    exact: &ExactField,
    a: &[Residue],
    b: &[Residue],
) -> Vec<Residue> {
    let ((wa, va), (wb, vb)) = (split_twist(a), split_twist(b));
    let w = exact.cross(wa, wb);
    let (p, q) = (exact.cross(wa, vb), exact.cross(va, wb));
    let field = exact.field();
    let v = [0, 1, 2].map(|i| field.add(p[i], q[i]));
    join_twist(w, v).to_vec()
}

/// Returns true if the successive displacements of some independent twists are all those of a group.
pub(in crate::rank) fn is_group<T: AsRef<[Residue]>>(exact: &ExactField, twists: &[T]) -> bool {
    let mut span = Echelon::new(exact.field());
    let mut pairs = twists.iter().tuple_combinations();
    twists.iter().all(|t| span.insert(t.as_ref()))
        && pairs.all(|(a, b)| span.contains(&lie_bracket(exact, a.as_ref(), b.as_ref())))
}

/// Returns the six-component twists of a joint's freedoms, restricted to those that planar mode keeps.
pub(in crate::rank) fn spatial_twists(
    exact: &ExactField,
    mechanism: &Mechanism,
    joint: JointId,
) -> Result<Vec<Vec<Residue>>, ExactError> {
    let joint = &mechanism.joints[joint];
    let twists = joint_twists(
        exact,
        &MotionSpace::Spatial,
        &joint.frame,
        &joint.joint_type,
    )?;
    Ok(twists.into_iter().map(|(_, t)| t).collect())
}

/// Returns the freedoms of a joint with their twists, in the order of passage from its first link.
pub(in crate::rank) fn passed_twists(
    exact: &ExactField,
    mechanism: &Mechanism,
    joint: JointId,
) -> Result<Vec<(Freedom, Vec<Residue>)>, ExactError> {
    let joint = &mechanism.joints[joint];
    let frame = FrameValues::new(exact, &joint.frame)?;
    let freedoms = joint.joint_type.freedoms();
    let passed = frame.motions_in_series(exact, &MotionSpace::Spatial, freedoms);
    Ok(passed.into_iter().map(|(f, t)| (f, t.to_vec())).collect())
}

/// Returns the dimension of the group that a contour's displacements generate. It is at most 3 in planar mode.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// At most 15 brackets of at most 6 independent twists.
pub(crate) fn group_dimension(
    exact: &ExactField,
    mechanism: &Mechanism,
    contour: &Contour,
) -> Result<usize, ExactError> {
    if let Mode::Planar { .. } = &mechanism.mode {
        // There are three rows: turning about the normal and sliding across it. Slides commute with each other.
        let space = MotionSpace::new(exact, &mechanism.mode)?;
        let mut algebra = Echelon::new(exact.field());
        let mut turning = false;
        for &(j, _) in &contour.joints {
            let joint = &mechanism.joints[j];
            for (_, t) in joint_twists(exact, &space, &joint.frame, &joint.joint_type)? {
                turning |= t[0] != 0;
                algebra.insert(&t);
            }
        }
        // The bracket of two turns about different points is a slide. The bracket of a turn and a slide is the
        // perpendicular slide.
        return Ok(match (turning, algebra.rank()) {
            (true, r) if r > 1 => 3,
            (_, r) => r,
        });
    }
    Ok(generated_algebra(exact, mechanism, contour.joints.iter().map(|&(j, _)| j))?.len())
}

/// Returns a basis of the Lie algebra that the twists of some joints generate.
fn generated_algebra(
    exact: &ExactField,
    mechanism: &Mechanism,
    joints: impl IntoIterator<Item = JointId>,
) -> Result<Vec<Vec<Residue>>, ExactError> {
    let mut span = Echelon::new(exact.field());
    let mut basis: Vec<Vec<Residue>> = Vec::new();
    for j in joints {
        if basis.len() == 6 {
            break;
        }
        for t in spatial_twists(exact, mechanism, j)? {
            if span.insert(&t) {
                basis.push(t);
            }
        }
    }
    let mut next = 0;
    while next < basis.len() && basis.len() < 6 {
        for other in 0..next {
            let t = lie_bracket(exact, &basis[next], &basis[other]);
            if span.insert(&t) {
                basis.push(t);
            }
        }
        next += 1;
    }
    Ok(basis)
}

/// Kind of a displacement group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GroupKind {
    /// Nothing, or slides only.
    Translation,
    /// Turns about one axis, possibly with slides along it.
    Rotation,
    /// Turns about one direction and slides across it.
    Planar,
    /// Turns about one point.
    Spherical,
    /// Turns about one direction and every slide.
    Schoenflies,
    /// Anything else; all displacements if the dimension is 6.
    Other,
}

/// The group in which all joints of a state move together.
#[derive(Debug, Clone)]
pub struct DisplacementGroup {
    dimension: usize,
    turns: usize,
    slides: usize,
    across: bool,
    /// Whether each turn is coupled to a slide along its axis.
    screws: bool,
    /// Components of a twist that determine the others: pivots of the algebra.
    pivots: Vec<usize>,
}

impl DisplacementGroup {
    /// Returns J with one row per dimension of the group and contour. The other components of its twists are
    /// combinations of these, the same for every column, so the rank is unchanged.
    #[must_use]
    pub fn rows_of(&self, closure: &Closure<Residue>) -> Closure<Residue> {
        closure.with_twists(self.dimension, |c| {
            let twist = &closure.columns[c].twist;
            self.pivots.iter().map(|&p| twist[p]).collect()
        })
    }

    /// Returns the dimension, at most 6.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Returns the kind.
    #[must_use]
    pub fn kind(&self) -> GroupKind {
        match (self.turns, self.slides) {
            (0, _) => GroupKind::Translation,
            (1, 0) if !self.screws => GroupKind::Rotation,
            (1, 2) if self.across && !self.screws => GroupKind::Planar,
            (1, 3) => GroupKind::Schoenflies,
            (3, 0) => GroupKind::Spherical,
            _ => GroupKind::Other,
        }
    }

    /// Returns the name with the dimension, for display.
    #[must_use]
    pub fn name(&self) -> String {
        match self.kind() {
            GroupKind::Translation if self.slides == 0 => "no motion (0)".to_owned(),
            GroupKind::Translation if self.slides == 3 => {
                "the group of translations (3)".to_owned()
            }
            GroupKind::Translation => format!("a group of translations ({})", self.dimension),
            GroupKind::Rotation => "the turns about one axis (1)".to_owned(),
            GroupKind::Planar => "one plane (3)".to_owned(),
            GroupKind::Spherical => "the turns about one point (3)".to_owned(),
            GroupKind::Schoenflies => "a Schoenflies group (4)".to_owned(),
            GroupKind::Other if self.screws && self.slides == 0 => "one screw (1)".to_owned(),
            GroupKind::Other if self.screws => {
                format!(
                    "screws of one pitch and slides across them ({})",
                    self.dimension
                )
            }
            GroupKind::Other => format!("a group of dimension {}", self.dimension),
        }
    }
}

/// Returns the group generated by all joints of a state together. If it has fewer than 6 dimensions, that many rows per
/// contour are enough.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::exact::field::field_of};
/// use ozols::rank::finite::displacement_group::whole_group;
/// // Three rows per loop are enough where everything moves in a plane.
/// let four_bar = ozols::built_in("four-bar")?;
/// let exact = field_of(&four_bar, StateId::FREE, 0)?;
/// assert_eq!(whole_group(&exact, &four_bar, StateId::FREE)?.dimension(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn whole_group(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
) -> Result<DisplacementGroup, ExactError> {
    if let Mode::Planar { .. } = &mechanism.mode {
        return Ok(DisplacementGroup {
            dimension: 3,
            turns: 1,
            slides: 2,
            across: true,
            screws: false,
            pivots: vec![0, 1, 2],
        });
    }
    group_of(exact, mechanism, mechanism.joints_in(state))
}

/// Returns the group generated by some joints together, in space.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
pub(in crate::rank) fn group_of(
    exact: &ExactField,
    mechanism: &Mechanism,
    joints: impl IntoIterator<Item = JointId>,
) -> Result<DisplacementGroup, ExactError> {
    let basis = generated_algebra(exact, mechanism, joints)?;
    let field = exact.field();
    let turns = Echelon::from_vectors(field, basis.iter().map(|t| &t[..3]));
    // Combinations without a turn are the slides.
    let parts: Vec<Vec<Residue>> = basis.iter().map(|t| t[..3].to_vec()).collect();
    let slides: Vec<[Residue; 3]> = linear_relations(field, &parts)
        .iter()
        .map(|factors| linear_combination(field, &basis, factors))
        .map(|t| split_twist(&t).1)
        .collect();
    let axis = turns
        .reduced_rows()
        .first()
        .map_or([0; 3], |t| [t[0], t[1], t[2]]);
    let whole = Echelon::from_vectors(field, &basis);
    let across = slides.iter().all(|&v| exact.dot(v, axis) == 0);
    // Slides across the axis do not affect the slide coupled to a turn. An independent slide along the axis allows a
    // turn with any pitch.
    let along = |t: &Vec<Residue>| {
        let (w, v) = split_twist(t);
        exact.dot(w, v)
    };
    let screws = turns.rank() == 1 && across && basis.iter().any(|t| along(t) != 0);
    Ok(DisplacementGroup {
        dimension: basis.len(),
        turns: turns.rank(),
        slides: slides.len(),
        across,
        screws,
        pivots: whole.pivots(),
    })
}
