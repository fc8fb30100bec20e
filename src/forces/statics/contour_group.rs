//! The four-link group with a closed contour, as a problem of its own.
//!
//! Letters are those of the shears in `[Bychkov, Dvornikov & Zhukov 2018]`: the ternary link 4 hangs on D and carries rods 6
//! (F to M) and 7 (K to L), which carry the slider 10 on its guide. In any other mechanism 4, 6, 7 and 10 are the links in
//! those places. Three methods solve it ([`solutions`]): the published [`delta_point`], its form in homogeneous coordinates
//! ([`projective`]), and the twelve [`equilibrium`] equations, in doubles and exactly.

pub mod delta_point;
pub mod equilibrium;
pub mod force_plan;
pub mod letters;
pub mod pose;
pub mod projective;
pub mod solutions;
pub mod stability;
