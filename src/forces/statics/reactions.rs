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
mod family;
pub mod follow;
pub mod geometry;
pub(crate) mod inertia;
pub(crate) mod solution;
pub(crate) mod solve;
pub(crate) mod teeth;
mod transmitted;
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

use crate::geom::expr::Expr;
use crate::model::loads::{ExternalForce, Loads, acts_at, acts_in};
use crate::model::mechanism::{LinkId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::geometry::{Geometry, Six, wrench};

fn real(v: &[Expr; 3]) -> [f64; 3] {
    [v[0].to_f64(), v[1].to_f64(), v[2].to_f64()]
}

/// Weights, forces and moments from outside, by link, about the geometry's middle; those on the frame, on links absent
/// from the state and of other states are left out, and in planar mode what is across the plane. `drive` is the first drive's position since the pose of the file `[rad]` or in the
/// file's unit, for forces that act in a range of it; ranges come again after `period`.
#[must_use]
pub fn link_loads(
    m: &Mechanism,
    loads: &Loads,
    geometry: &Geometry,
    pose: &Pose,
    drive: f64,
    period: Option<f64>,
) -> Vec<Six> {
    let mut out = vec![[0.0; 6]; m.links.len()];
    let mut there = vec![false; m.links.len()];
    geometry.tree.iter().for_each(|s| there[s.link] = true);
    let mut add = |link: LinkId, w: Six| {
        if there[link] {
            for (o, x) in out[link].iter_mut().zip(geometry.within(&w)) {
                *o += x;
            }
        }
    };
    if let Some(g) = &loads.gravity {
        let g = real(g);
        for (l, link) in m.links_with_ids() {
            if let Some(mass) = &link.mass {
                let at = geometry.place(pose, l, real(&mass.centre));
                add(l, wrench(at, g.map(|x| x * mass.mass), [0.0; 3]));
            }
        }
    }
    let here = |states: Option<&Vec<StateId>>| acts_in(states, geometry.state);
    let now = |f: &&ExternalForce| here(f.states.as_ref()) && acts_at(f.range, drive, period);
    for f in loads.forces.iter().filter(now) {
        let at = geometry.place(pose, f.link, real(&f.point));
        add(f.link, wrench(at, real(&f.force), [0.0; 3]));
    }
    for x in loads.moments.iter().filter(|x| here(x.states.as_ref())) {
        let moment = real(&x.moment).map(|v| v / geometry.size);
        add(x.link, wrench([0.0; 3], [0.0; 3], moment));
    }
    out
}
