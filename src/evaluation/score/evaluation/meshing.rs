//! Whether the teeth of couplings mesh, in one variant and in all.

use crate::score::evaluation::coupled::CoupledChoice;
use crate::score::evaluation::pose_tables::{Cell, PlacedJoint, PoseTable};

impl PoseTable {
    /// Returns for each coupling whether its teeth mesh in a variant, given the cell at each place. `None` if a joint in
    /// series has another load than the coupled joint.
    pub(in crate::score) fn teeth_mesh<'c>(
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

    /// Returns for each coupling whether its teeth mesh in every variant or in none. `None` if that depends on the variant.
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
