//! Joints of a CAD assembly that need another type, found by the search.

use crate::cli::option::variant;
use crate::cli::prelude::*;
use crate::robots::{Origin, find_releases};
use crate::score::run::Event;
use crate::view::group_by_key;
use crate::view::lint::TypeChange;
use anyhow::anyhow;

/// Maximum number of joints, and of nodes, that are searched without being asked; larger searches may take too long.
const JOINTS: usize = 40;
const NODES: usize = 100_000;
/// Maximum number of variants with numeric ranks, because each of them is analysed separately.
const NUMERIC: usize = 2000;

/// The changes to make, and the W and σ that they should give.
pub(crate) struct TypePlan {
    pub(crate) releases: Vec<Release>,
    pub(crate) mobility: usize,
    pub(crate) redundant: usize,
}

impl TypePlan {
    /// Returns the plan that changes nothing.
    pub(crate) fn unchanged(mobility: usize) -> TypePlan {
        TypePlan {
            releases: Vec::new(),
            mobility,
            redundant: 0,
        }
    }
}

/// Returns the changes of variant `k` of a search.
pub(crate) fn plan_variant(
    m: &Mechanism,
    request: Request,
    k: usize,
    tell: fn(Event),
) -> anyhow::Result<TypePlan> {
    // What is added is told against the mechanism as it is meant, which is the one that was searched.
    let one = request.noun_of_one();
    let (before_it, changed, w, sigma) =
        variant::kth_telling(m.clone(), request, k, &mut { tell }, |v| {
            let searched = v.outcome().search.mechanism.clone();
            (searched, v.as_mechanism(), v.mobility(), v.redundant())
        })?;
    let releases = find_releases(&before_it, &changed).map_err(|why| anyhow!("{one} {k} {why}"))?;
    Ok(TypePlan {
        releases,
        mobility: usize::try_from(w)?,
        redundant: usize::try_from(sigma)?,
    })
}

/// Returns the first idea of the search, or `None` if it finds none.
pub(crate) fn plan_first_idea(
    m: &Mechanism,
    request: Request,
    tell: fn(Event),
) -> Option<TypePlan> {
    let request = Request {
        distinct: true,
        ..request
    };
    // With no variant there is no first.
    plan_variant(m, request, 1, tell).ok()
}

/// Returns the joints to change so that no constraint is redundant, and W after that. `None` if no choice of types achieves it,
/// or the assembly is large. `exact` is true if ranks are exact.
pub(crate) fn find_changes(
    m: &Mechanism,
    origin: &Origin,
    exact: bool,
) -> Option<(Vec<TypeChange>, usize)> {
    let options = m.joints.iter().map(|j| j.options.len().max(1));
    let variants = options.fold(1, usize::saturating_mul);
    if m.joints.len() > JOINTS || (!exact && variants > NUMERIC) {
        return None;
    }
    let request = Request {
        nodes: NODES,
        ..Request::default()
    };
    let plan = plan_first_idea(m, request, |_| ())?;
    Some((name_changes(m, origin, &plan.releases)?, plan.mobility))
}

/// Returns the joint types of an assembly after releases. `None` if the mechanism is not an assembly, or has no such types.
pub(crate) fn name_changes(
    m: &Mechanism,
    origin: &Origin,
    releases: &[Release],
) -> Option<Vec<TypeChange>> {
    if !origin.is_assembly() {
        return None;
    }
    let added = releases.iter().map(|release| {
        let (joint, slides, direction) = release.added_freedom()?;
        Some((joint, (slides, direction)))
    });
    let all = group_by_key(added.collect::<Option<Vec<_>>>()?);
    let change = |(j, more): &(_, Vec<_>)| TypeChange::at_joint(m, origin, *j, more);
    all.iter().map(change).collect()
}
