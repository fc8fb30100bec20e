//! Counting formulas of links, joints and freedoms, without geometry.

use crate::closure::Closure;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::finite::displacement_group::{GroupKind, whole_group};
use crate::rank::method::{About, Answer, Certainty, MobilityMethod, NoAnswer, Quantity, RankOfJ};

/// W = 6(n - 1) - Σ constraints.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spatial;

/// W = 3(n - 1) - Σ constraints in the plane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Planar;

/// Returns `dim`·(n - 1) - Σ (`dim` - f_i) over the joints of a state, less one for each coupling. `freedoms` is Σ f_i.
fn count(mechanism: &Mechanism, state: StateId, dim: i64, freedoms: usize) -> i64 {
    let mut links: Vec<_> = mechanism
        .joints_in(state)
        .flat_map(|j| mechanism.joints[j].links)
        .collect();
    links.sort_unstable();
    links.dedup();
    let int = |n: usize| i64::try_from(n).unwrap_or(i64::MAX);
    let constraints = dim * int(mechanism.joints_in(state).count()) - int(freedoms);
    dim * (int(links.len()).max(1) - 1) - constraints - int(mechanism.couplings_in(state).count())
}

fn counted(mobility: i64) -> Answer {
    Answer {
        mobility,
        quantity: Quantity::Count,
        certainty: Certainty::Counted,
    }
}

impl MobilityMethod for Spatial {
    fn about(&self) -> &'static About {
        &About {
            name: "count",
            title: "spatial counting",
            help: "Counting formula in space, 6(n-1) minus the constraints",
            guarantee: "right if no constraint is redundant (σ = 0); otherwise too small by σ",
            complexity: "O(n + p)",
            source: "Chebychev 1869, Grübler 1917, Kutzbach 1929; Malyshev 1923",
            rank: RankOfJ::NotFound,
        }
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        if matches!(mechanism.mode, crate::model::mechanism::Mode::Planar { .. }) {
            return Err(NoAnswer::DoesNotApply("the file is in planar mode"));
        }
        let joints = mechanism.joints_in(state);
        let freedoms = joints.map(|j| mechanism.joints[j].joint_type.freedoms().len());
        Ok(counted(count(mechanism, state, 6, freedoms.sum())))
    }
}

impl MobilityMethod for Planar {
    fn about(&self) -> &'static About {
        &About {
            name: "count-planar",
            title: "planar counting",
            help: "Counting formula in the plane, 3(n-1) minus the constraints",
            guarantee: "right if every joint moves in one plane and no constraint in it is redundant",
            complexity: "O(n + p)",
            source: "Chebychev 1869, Grübler 1883",
            rank: RankOfJ::NotFound,
        }
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let exact = field_of(mechanism, state, 0)?;
        match whole_group(&exact, mechanism, state)?.kind() {
            // Freedoms out of the plane, which planar mode omits, do not count here.
            GroupKind::Planar | GroupKind::Rotation => {
                let freedoms = Closure::new(&exact, mechanism, state)?.columns.len();
                Ok(counted(count(mechanism, state, 3, freedoms)))
            }
            _ => Err(NoAnswer::DoesNotApply(
                "not every joint moves in one plane; use the planar mode, which omits motions out of the plane",
            )),
        }
    }
}
