//! Counting formulas of links, joints and freedoms, and the sum of the ranks of separate contours.

use crate::linalg::echelon::Echelon;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::rank::exact::field::closure_of;
use crate::rank::finite::displacement_group::{GroupKind, whole_group};
use crate::rank::method::{Answer, Certainty, MobilityMethod, NoAnswer, RankOfJ, to_i64};

/// Returns `dim`·(n - 1) - Σ (`dim` - f_i) over the joints of a state, less one for each coupling. `freedoms` is Σ f_i.
pub(crate) fn count_mobility(
    mechanism: &Mechanism,
    state: StateId,
    dim: i64,
    freedoms: usize,
) -> i64 {
    let links = mechanism.links_in(state).count();
    let constraints = dim * to_i64(mechanism.joints_in(state).count()) - to_i64(freedoms);
    dim * (to_i64(links).max(1) - 1) - constraints - to_i64(mechanism.couplings_in(state).count())
}

/// W = 6(n - 1) - Σ constraints.
pub(crate) const SPATIAL: MobilityMethod = MobilityMethod {
    name: "count",
    title: "spatial counting",
    help: "Counting formula in space, 6(n-1) minus the constraints",
    guarantee: "right if no constraint is redundant (σ = 0); otherwise too small by σ",
    complexity: "O(n + p)",
    source: "Chebychev 1869, Grübler 1917, Kutzbach 1929; Malyshev 1923",
    rank: RankOfJ::NotFound,
    answer: count_in_space,
};

fn count_in_space(mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
    if matches!(mechanism.mode, Mode::Planar { .. }) {
        return Err(NoAnswer::DoesNotApply("the file is in planar mode"));
    }
    let joints = mechanism.joints_in(state);
    let freedoms = joints.map(|j| mechanism.joints[j].joint_type.freedoms().len());
    let mobility = count_mobility(mechanism, state, 6, freedoms.sum());
    Ok(Answer::from_count(mobility, Certainty::Counted))
}

/// W = 3(n - 1) - Σ constraints in the plane.
pub(crate) const PLANAR: MobilityMethod = MobilityMethod {
    name: "count-planar",
    title: "planar counting",
    help: "Counting formula in the plane, 3(n-1) minus the constraints",
    guarantee: "right if every joint moves in one plane and no constraint in it is redundant",
    complexity: "O(n + p)",
    source: "Chebychev 1869, Grübler 1883",
    rank: RankOfJ::NotFound,
    answer: count_in_plane,
};

fn count_in_plane(mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
    let (exact, closure) = closure_of(mechanism, state, 0)?;
    match whole_group(&exact, mechanism, state)?.kind() {
        // Freedoms out of the plane, which planar mode omits, do not count here.
        GroupKind::Planar | GroupKind::Rotation => {
            let mobility = count_mobility(mechanism, state, 3, closure.columns.len());
            Ok(Answer::from_count(mobility, Certainty::Counted))
        }
        _ => Err(NoAnswer::DoesNotApply(
            "not every joint moves in one plane; use the planar mode, which omits motions out of the plane",
        )),
    }
}

/// W = f - Σ rank of contour i, over a minimum cycle basis.
pub(crate) const LOOPS: MobilityMethod = MobilityMethod {
    name: "loops",
    title: "sum of contour ranks",
    help: "Freedoms minus the ranks of the separate contours",
    guarantee: "right if contours do not share redundant constraints; otherwise too small, and dependent on the cycle basis [Gogu 2005]",
    complexity: "O(f) eliminations of six rows",
    source: "Voinea & Atanasiu 1959; Gogu 2005",
    rank: RankOfJ::NotFound,
    answer: sum_contours,
};

fn sum_contours(mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
    let (exact, closure) = closure_of(mechanism, state, 0)?;
    let mut mobility = to_i64(closure.columns.len());
    for k in 0..closure.contours.len() {
        let passes = |c: &usize| {
            let joint = closure.columns[*c].joint;
            closure.contours[k].direction_of(joint).is_some()
        };
        let columns = (0..closure.columns.len()).filter(passes);
        let columns = columns.map(|c| closure.dense_column(&exact, c, &[k]));
        mobility -= to_i64(Echelon::from_vectors(exact.field(), columns).rank());
    }
    // A coupling is a separate row, of rank 1.
    mobility -= to_i64(closure.couplings.len());
    Ok(Answer::from_count(mobility, Certainty::Exact))
}
