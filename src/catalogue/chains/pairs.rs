//! Planar chains of hinges, slides, gear pairs and slots, and the grippers that their links make.
//!
//! A [`kind::PairKind`] leaves one freedom (hinge, slide) or two (gear pair or rack; pin in a slot, cam, wedge), so that a chain of
//! n links has the mobility W = 3(n - 1) - 2(R + P) - (G + S). A chain counts where in nearly all places of its joints W is 1
//! in truth and every two links move against each other. Between hinges and pairs of two freedoms a count of every part tells
//! that; with slides the rank decides (loops of slides alone, hinges locked by slides), see [`motion`].
//!
//! Conventions: two links have one pair at most and every link has two or more; no hinge joins three links; a gear pair needs
//! a carrier, a link that is hinged to both gears, or to the pinion and slides on the rack. The input is a hinge or a slide,
//! at the frame or between two moving links; a jaw is never the frame, and *driven* where it is a link of the input joint.

pub mod census;
pub mod chain;
pub mod classics;
pub(crate) mod graphs;
mod halves;
pub mod kind;
pub mod motion;
pub mod roles;
pub mod sharing;
mod smaller;
pub mod structure;
pub mod symmetric_census;
