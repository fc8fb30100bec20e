//! What couplings pass at the joints of a variant.
//!
//! A variant may have a joint that its gear's teeth push aside, or one more joint in series; then a coupling passes otherwise
//! than by teeth, or the table does not know how.

use crate::model::mechanism::JointId;
use crate::score::evaluation::pose_tables::{Cell, PlacedJoint, PoseTable};
use crate::statics::reactions::geometry::{Geometry, Six};

/// A coupling at a joint's place.
#[derive(Debug, Clone)]
pub(in crate::score) struct PlacedCoupling {
    /// Its place among the couplings.
    pub(in crate::score) coupling: usize,
    /// The end that is the joint's.
    pub(in crate::score) end: usize,
    /// What it passes beside the joint, for 1 of its unknown: without teeth, and with them.
    pub(in crate::score) beside: [Six; 2],
}

/// What a choice makes of a coupling at its joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::score) enum CoupledChoice {
    /// It bears what the teeth push.
    BearsTeeth,
    /// It would give way to them, or there are none.
    AlongFreedom,
    /// Another joint in series bears what the coupling passes here.
    InSeries,
}

/// The couplings at a joint.
pub(in crate::score) fn couplings_at(geometry: &Geometry, joint: JointId) -> Vec<PlacedCoupling> {
    let all = geometry.couplings.iter().enumerate();
    let here = all.filter_map(|(coupling, c)| {
        let end = c.ends.iter().position(|e| e.joint == joint)?;
        Some(PlacedCoupling {
            coupling,
            end,
            beside: [c.beside(end, false), c.beside(end, true)],
        })
    });
    here.collect()
}

impl PoseTable {
    /// By coupling, whether its teeth mesh in a variant, given the cell at each place; `None` where a joint in series is not
    /// loaded as the one that is coupled.
    pub(in crate::score) fn meshing<'c>(
        &self,
        cell: impl Fn(&PlacedJoint) -> &'c Cell,
    ) -> Option<Vec<bool>> {
        let mut out = vec![true; self.couplings];
        for place in self.places.iter().filter(|p| !p.couplings.is_empty()) {
            for (at, choice) in place.couplings.iter().zip(&cell(place).coupled) {
                match choice {
                    CoupledChoice::BearsTeeth => {}
                    CoupledChoice::AlongFreedom => out[at.coupling] = false,
                    CoupledChoice::InSeries => return None,
                }
            }
        }
        Some(out)
    }

    /// By coupling, whether its teeth mesh in every variant or in none; `None` where that depends on the variant.
    pub(in crate::score) fn meshing_of_all(&self) -> Vec<Option<bool>> {
        let mut seen: Vec<Vec<CoupledChoice>> = vec![Vec::new(); self.couplings];
        for place in &self.places {
            for (n, at) in place.couplings.iter().enumerate() {
                let choices = self.cells[place.variable].iter();
                seen[at.coupling].extend(choices.map(|c| c[place.slot].coupled[n]));
            }
        }
        let alike = |seen: &Vec<CoupledChoice>| {
            let all = |wanted| seen.iter().all(|c| *c == wanted);
            if all(CoupledChoice::BearsTeeth) {
                Some(true)
            } else {
                all(CoupledChoice::AlongFreedom).then_some(false)
            }
        };
        seen.iter().map(alike).collect()
    }
}
