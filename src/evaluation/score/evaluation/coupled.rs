//! What couplings pass at the joints of a variant.
//!
//! A variant may have a joint that its gear's teeth push aside, or one more joint in series; then a coupling passes otherwise
//! than by teeth, or the table does not know how.

use crate::model::mechanism::JointId;
use crate::statics::reactions::geometry::{Geometry, Six};

/// A coupling at a joint's place.
#[derive(Debug, Clone)]
pub(in crate::score) struct PlacedCoupling {
    /// Its place among the couplings.
    pub(in crate::score) coupling: usize,
    /// The end that is the joint's.
    pub(in crate::score) end: usize,
    /// The load that bypasses the joint for a unit of its unknown, without teeth and with them.
    pub(in crate::score) beside: [Six; 2],
}

/// The effect of a choice on a coupling at its joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::score) enum CoupledChoice {
    /// It bears what the teeth push.
    BearsTeeth,
    /// It would give way to them, or there are none.
    AlongFreedom,
    /// Another joint in series bears what the coupling passes here.
    InSeries,
}

/// Returns the couplings at a joint.
pub(in crate::score) fn couplings_at(geometry: &Geometry, joint: JointId) -> Vec<PlacedCoupling> {
    let all = geometry.couplings.iter().enumerate();
    let here = all.filter_map(|(coupling, c)| {
        let end = c.ends.iter().position(|e| e.joint == joint)?;
        Some(PlacedCoupling {
            coupling,
            end,
            beside: [c.bypass_wrench(end, false), c.bypass_wrench(end, true)],
        })
    });
    here.collect()
}
