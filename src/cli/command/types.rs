//! Which joints of a CAD assembly to give another type, as the search has it.

use crate::cli::option::variant;
use crate::geom::vector::Vector;
use crate::model::mechanism::{JointId, Mechanism};
use crate::redundancy::release::Release;
use crate::robots::{Origin, releases};
use crate::score::request::Request;
use crate::score::run::Event;
use crate::view::lint::TypeChange;
use anyhow::anyhow;

/// Most joints, and nodes, that are searched unasked: beyond them it may take longer than one waits for.
const JOINTS: usize = 40;
const NODES: usize = 100_000;
/// Most variants where ranks are numeric: each of them is looked at by itself then.
const NUMERIC: usize = 2000;

/// What is to be done, and the W and σ that are to come of it.
pub(in crate::cli) struct TypePlan {
    pub(in crate::cli) releases: Vec<Release>,
    pub(in crate::cli) mobility: usize,
    pub(in crate::cli) redundant: usize,
}

/// What variant `k` of a search changes.
pub(in crate::cli) fn changed(
    m: &Mechanism,
    request: Request,
    k: usize,
    tell: fn(Event),
) -> anyhow::Result<TypePlan> {
    // What is added is told against the mechanism as it is meant, which is the one that was searched.
    let one = request.one();
    let (before_it, changed, w, sigma) =
        variant::kth_telling(m.clone(), request, k, &mut { tell }, |v| {
            let searched = v.outcome().search.mechanism.clone();
            (searched, v.mechanism(), v.mobility(), v.redundant())
        })?;
    let releases = releases(&before_it, &changed).map_err(|why| anyhow!("{one} {k} {why}"))?;
    let plan = TypePlan {
        releases,
        mobility: usize::try_from(w)?,
        redundant: usize::try_from(sigma)?,
    };
    Ok(plan)
}

/// The first idea of the search; none where it finds none.
pub(in crate::cli) fn first(m: &Mechanism, request: Request, tell: fn(Event)) -> Option<TypePlan> {
    let request = Request {
        distinct: true,
        ..request
    };
    // With no variant there is no first.
    changed(m, request, 1, tell).ok()
}

/// The joints to change for all that is redundant to go, and W then; none where no choice of types does, or the assembly is
/// large. `exact` says whether ranks are.
pub(in crate::cli) fn changes(
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
    let plan = first(m, request, |_| ())?;
    Some((named(m, origin, &plan.releases)?, plan.mobility))
}

/// What releases make of the joints of an assembly; none where it is no assembly, or has no such types.
pub(in crate::cli) fn named(
    m: &Mechanism,
    origin: &Origin,
    releases: &[Release],
) -> Option<Vec<TypeChange>> {
    if !origin.is_assembly() {
        return None;
    }
    let mut all: Vec<(JointId, Vec<(bool, Vector)>)> = Vec::new();
    for release in releases {
        let Release::Freedom {
            joint,
            slides,
            direction,
        } = *release
        else {
            return None;
        };
        match all.iter_mut().find(|(j, _)| *j == joint) {
            Some((_, more)) => more.push((slides, direction)),
            None => all.push((joint, vec![(slides, direction)])),
        }
    }
    let change = |(j, more): &(JointId, Vec<(bool, Vector)>)| TypeChange::at(m, origin, *j, more);
    all.iter().map(change).collect()
}
