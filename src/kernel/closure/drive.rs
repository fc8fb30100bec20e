//! The freedoms that drives move, and the rate of a driven freedom, as a linear function of the twist between the links of its joint.
//!
//! The rate is defined for every joint type that may replace the driven one. The rate of a turn is the angular velocity
//! along the driven axis. The rate of a slide is the velocity along it of the point at the joint. The rate of a thread
//! is that of its turn.

use crate::closure::coupling::{in_plane, squared_axis_length};
use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::exact::ExactError;
use crate::geom::expr::Expr;
use crate::geom::vector::{cross, dot, length};
use crate::geom::{Reals, Scalars};
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Frame, JointId, Mechanism, StateId};

/// A driven joint and the freedom its drive moves.
pub type Driven = (JointId, Freedom);

/// Returns the freedoms that the drives of a state move, one for each driven joint that moves in the mechanism's space. That
/// is [`Joint::driven_freedom`](crate::model::mechanism::Joint::driven_freedom). In a plane that excludes it, it is the first freedom of the
/// joint that stays in the plane, unless the file names one. The list omits drives that cannot move there.
///
/// # Examples
/// ```
/// use ozols::{closure::drive::driven_freedoms, model::{joint_type::Freedom, mechanism::StateId}};
/// let four_bar = ozols::built_in("four-bar")?;
/// assert_eq!(driven_freedoms(&four_bar, StateId::FREE)[0].1, Freedom::Rz);
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn driven_freedoms(mechanism: &Mechanism, state: StateId) -> Vec<Driven> {
    let driven = |j: JointId| {
        let joint = &mechanism.joints[j];
        let others = joint.joint_type.freedoms().iter().copied();
        let others = others.filter(|_| joint.drive_freedom.is_none());
        let mut all = std::iter::once(joint.driven_freedom()?).chain(others);
        Some((j, all.find(|&f| in_plane(mechanism, j, f))?))
    };
    mechanism.joints_in(state).filter_map(driven).collect()
}

/// Returns the rate of a drive as coefficients of the twist of a joint in the frame `at`, up to a factor. The factor is
/// the same for all joint types that may be there. Returns `None` if the search follows no drive at the joint.
///
/// # Errors
/// Returns an error if a coordinate has no value in the number system.
pub(crate) fn rate_row<S: Scalars>(
    s: &S,
    space: &MotionSpace<S::Number>,
    mechanism: &Mechanism,
    joint: JointId,
    at: &Frame,
) -> Result<Option<Vec<S::Number>>, ExactError> {
    let Some(drive) = mechanism.drive_at(joint) else {
        return Ok(None);
    };
    let freedom = mechanism.search.drives[drive].freedom;
    let present = &mechanism.joints[joint].frame;
    let size = Expr::from(1).div(&squared_axis_length(present, freedom));
    let size = s.eval(&size.unwrap_or_else(|| Expr::from(1)))?;
    let axis = FrameValues::new(s, present)?.axis(freedom);
    let point = s.eval3(&at.point)?;
    let product3 = |a: &[S::Number; 3], b: &[S::Number; 3]| s.dot(a.clone(), b.clone());
    // (ω × p)·a = ω·(p × a)
    let arm = s.cross(point, axis.clone());
    let row = match (space, freedom.is_slide()) {
        (MotionSpace::Spatial, false) => {
            let [a, b, c] = axis;
            let zero = S::Number::default;
            vec![a, b, c, zero(), zero(), zero()]
        }
        (MotionSpace::Spatial, true) => arm.into_iter().chain(axis).collect(),
        (MotionSpace::Planar { axes: [n, ..] }, false) => {
            vec![
                product3(&axis, n),
                S::Number::default(),
                S::Number::default(),
            ]
        }
        // v = (v·e1) e1/|e1|² + (v·e2) e2/|e2|² and ω = (ω·n) n/|n|², all multiplied by |n|²|e1|²|e2|².
        (MotionSpace::Planar { axes: [n, e1, e2] }, true) => {
            let [nn, aa, bb] = [product3(n, n), product3(e1, e1), product3(e2, e2)];
            let product =
                |a: &S::Number, b: &S::Number, c: S::Number| s.mul(s.mul(a.clone(), b.clone()), c);
            vec![
                product(&aa, &bb, product3(&arm, n)),
                product(&nn, &bb, product3(&axis, e1)),
                product(&nn, &aa, product3(&axis, e2)),
            ]
        }
    };
    Ok(Some(
        row.into_iter().map(|x| s.mul(size.clone(), x)).collect(),
    ))
}

/// Returns the value of a row of coefficients at a twist.
pub(crate) fn rate_of_twist<S: Scalars>(
    s: &S,
    row: &[S::Number],
    twist: &[S::Number],
) -> S::Number {
    let products = row.iter().zip(twist);
    products.fold(S::Number::default(), |sum, (a, b)| {
        s.add(sum, s.mul(a.clone(), b.clone()))
    })
}

/// Returns the freedom of `joint_type` in the frame `at` whose speed is the rate of a driven freedom: the one about or
/// along the driven axis. Returns `None` if there is none, or if another freedom has a share in that rate.
#[must_use]
pub(crate) fn driven_in(
    (present, driven): (&Frame, Freedom),
    (at, joint_type): (&Frame, &JointType),
) -> Option<Freedom> {
    /// Sine or cosine below which axes count as parallel or perpendicular.
    const SQUARE: f64 = 1e-9;
    let axis = |frame: &Frame, freedom: Freedom| {
        let values = FrameValues::new(&Reals, frame).ok()?;
        let axis = values.axis(freedom);
        let size = length(axis);
        Some(axis.map(|x| x / size))
    };
    let along = axis(present, driven)?;
    let mut found = None;
    for &freedom in joint_type.freedoms() {
        // A thread slides when it turns.
        if freedom.is_slide() != driven.is_slide()
            && !(driven.is_slide() && freedom == Freedom::Screw)
        {
            continue;
        }
        let own = axis(at, freedom)?;
        if length(cross(own, along)) < SQUARE && freedom.is_slide() == driven.is_slide() {
            found = Some(freedom);
        } else if dot(own, along).abs() > SQUARE {
            return None;
        }
    }
    found
}
