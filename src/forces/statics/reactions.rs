//! Joint reactions of any mechanism, planar or spatial, determinate or not.
//!
//! Every joint j transmits a wrench w_j to its second link, and every link except the frame is in equilibrium. Sending
//! all loads along a spanning tree to the frame gives one solution p. All others are p + Σ ± λ_c, with a wrench λ_c
//! around each contour c. Joints do no work on their freedoms: t·w_j = 0 for each unit twist t of joint j, which is
//!
//!   Jᵀ λ = -(t·p)        one equation per freedom, six unknowns per contour,
//!
//! the transposed closure equations. A drive holds its freedom: that freedom's equation is omitted, and t·w is the
//! drive's force or torque. A coupling has a row in J. So it is one more unknown, which does work only on its two
//! freedoms.
//!
//! With σ = 0 the solution is unique. If redundant constraints remain, the solutions are a family. Its members are the
//! solution of minimum norm plus self-stresses. The norm is Σ |f|² + |m|²/ℓ² over the joints about their own points (ℓ
//! the mechanism's size). If joints are elastic and inaccurate, the compatible solution is chosen. If undriven motions
//! remain under which the loads do work, there is no equilibrium [Angeles 2014, ch. 6; Davies 1983].

pub mod contact;
pub(crate) mod couplings;
pub mod cycle;
mod equations;
pub mod geometry;
pub(crate) mod inertia;
pub mod loads;
pub mod misfit;
pub(crate) mod solution;
pub mod solve;
mod unilateral;
pub(crate) mod unsolved;
pub(crate) mod wrench;

pub use contact::Contacts;
pub use cycle::{Cycle, solve_cycle};
pub use solution::{
    CouplingReaction, JointReaction, NEARLY_SINGULAR, Solution, ToothForce, Uniqueness,
};
pub use solve::Reactions;
pub use unsolved::Unsolved;
