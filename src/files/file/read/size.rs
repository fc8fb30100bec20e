//! Whether the closure matrix of a file can be worked with at all.

use crate::file::findings::Findings;
use crate::file::problem::ProblemKind;
use crate::file::read::value::limits::ENTRIES;
use crate::model::mechanism::{Mechanism, Mode};

/// Whether no state's closure matrix is too large: a row for each constraint of a contour, a column for each freedom.
pub(super) fn size(m: &Mechanism, out: &mut Findings) -> bool {
    let mut fits = true;
    let dim = match m.mode {
        Mode::Spatial => 6,
        Mode::Planar { .. } => 3,
    };
    for (state, name) in m.states_with_ids() {
        let joints = || m.joints_in(state).map(|j| &m.joints[j]);
        let mut touched: Vec<_> = joints().flat_map(|j| j.links).collect();
        touched.sort_unstable();
        touched.dedup();
        // The links of a state hang together.
        let contours = (joints().count() + 1).saturating_sub(touched.len());
        let columns: usize = joints().map(|j| j.joint_type.freedoms().len()).sum();
        if dim * contours * columns > ENTRIES {
            fits = false;
            out.add(
                &[],
                ProblemKind::TooEntangled {
                    state: name.clone(),
                    rows: dim * contours,
                    columns,
                    limit: ENTRIES,
                },
            );
        }
    }
    fits
}
