//! The whole stroke of places that are tried: from the narrowest part of the task to the widest, as fast as places are tried.
//!
//! The parameter is the part's width, so that every pose is one that the task asks for, and the rate of the drive by it is the
//! force of the jaws: work in is work out.

pub mod closure;
mod cost;
pub mod forces;
mod gathered;
pub mod judge;
pub mod motion;
pub mod planes;
pub mod pose;
pub mod shortfall;
pub mod walk;
