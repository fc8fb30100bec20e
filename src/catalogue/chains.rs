//! Kinematic chains: which links may be joined to which, before anything has a place. Links are vertices, joints edges.
//!
//! A planar chain of n links and e hinges has the mobility W = 3(n - 1) - 2e; it has no rigid part if every part of two
//! links or more has a mobility of at least 1. Chains are listed without two that differ only in numbering.

pub mod canonical;
pub mod census;
pub mod chain;
pub(crate) mod contracted;
pub mod enumerate;
pub mod graph6;
pub mod layout_symmetry;
pub mod pairs;
pub mod roles;
mod strings;
