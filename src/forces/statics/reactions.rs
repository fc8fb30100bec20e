//! Joint reactions of any mechanism, planar or spatial, determinate or not.
//!
//! Every joint j passes a wrench w_j on to its second link, and every link but the frame is in equilibrium. Sending all
//! loads along a spanning tree to the frame gives one solution p; all others are p + Σ ± λ_c, a wrench λ_c round each
//! contour c. Joints do no work on their freedoms: t·w_j = 0 for each unit twist t of joint j, which is
//!
//!   Jᵀ λ = -(t·p)        one equation a freedom, six unknowns a contour,
//!
//! the transposed closure equations. A drive holds its freedom: that freedom's equation is left out, and t·w is the drive's
//! force or torque. A coupling has a row in J, so that it is one unknown more, which works on its two freedoms alone. With σ = 0 the solution is unique. Where redundant constraints are left, the solutions are a family:
//! that of minimum norm, Σ |f|² + |m|²/ℓ² over the joints about their own points (ℓ the mechanism's size), plus
//! self-stresses; and where joints are elastic and made askew, the one that fits. Where undriven motions are left under
//! which the loads do work, there is no equilibrium [Angeles 2014, ch. 6; Davies 1983].

pub mod contact;
pub(crate) mod couplings;
pub mod cycle;
pub mod drives;
mod equations;
pub mod follow;
pub mod geometry;
pub(crate) mod inertia;
pub mod loads;
pub(crate) mod solution;
pub mod solve;
mod unilateral;
pub(crate) mod unsolved;
pub(crate) mod wrench;

pub use contact::Contacts;
pub use cycle::{Cycle, cycle};
pub use solution::{
    CouplingReaction, JointReaction, NEARLY_SINGULAR, Solution, ToothForce, Uniqueness,
};
pub use solve::Reactions;
pub use unsolved::Unsolved;
