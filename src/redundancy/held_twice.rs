//! What a mechanism holds twice: each redundant constraint by name, where it holds over the motion, and what removes it.

use crate::geom::vector::{Vector, cross, length, real, unit};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::method::Certainty;
use crate::rank::verdict::verdict;
use crate::redundancy::analysis::{AnalysisError, Method, StateAnalysis, analyse};
use crate::redundancy::over_motion::{Where, redundant_where};
use crate::redundancy::release::{Duplicate, Release, Stressed};

/// Further poses looked at where nothing else tells what holds over the motion.
const POSES: usize = 4;
/// Relative singular values that count as zero where no rounding is known of.
const FLAT: f64 = 1e-9;

/// The redundant constraints of a free state.
#[derive(Debug)]
pub struct HeldTwice {
    /// Its analysis.
    pub analysis: StateAnalysis,
    /// Where σ holds; none where nothing is redundant.
    pub over: Option<Where>,
    /// Each redundant constraint; none where they cannot be told apart.
    pub list: Vec<Duplicate>,
    /// Releases that were looked at, with their costs in thousandths.
    pub releases: Vec<(i64, Release)>,
    /// The places among them of the cheapest set that removes all and lets nothing move; fewer than σ where there is none.
    pub cheapest: Vec<usize>,
}

impl HeldTwice {
    /// Least and greatest number of redundant constraints: the same but where rounded coordinates leave it open.
    #[must_use]
    pub fn range(&self) -> (usize, usize) {
        let least = self.analysis.redundant;
        (
            least,
            self.analysis.at_most().map_or(least, |(_, most)| most),
        )
    }
}

/// Finds what is held twice. `closes` says which joints are there to close loops, `may` what may be let go.
///
/// # Guarantee
/// σ is as the analysis says. What is redundant of each loop is numeric; there are other choices of as many constraints.
///
/// # Errors
/// As [`analyse`].
///
/// # Complexity
/// That of an analysis, two decompositions of J and, where nothing is proven, four closings. An analysis alone where σ = 0.
pub fn held_twice(
    m: &Mechanism,
    closes: &dyn Fn(JointId) -> bool,
    may: &dyn Fn(&Release) -> bool,
) -> Result<HeldTwice, AnalysisError> {
    let state = StateId::FREE;
    let mut found = analyse(m, &[state], Method::Auto { tolerance: None })?;
    let analysis = found.remove(0);
    let mut out = HeldTwice {
        analysis,
        over: None,
        list: Vec::new(),
        releases: Vec::new(),
        cheapest: Vec::new(),
    };
    let (_, most) = out.range();
    if most == 0 {
        return Ok(out);
    }
    let meant = verdict(m, state, None)?;
    let geometry = meant.mechanism().unwrap_or(m);
    let rank = out.analysis.rows - most;
    let Some(stressed) = Stressed::new(geometry, state, rank)? else {
        return Ok(out);
    };
    let mut rows = Vec::new();
    for q in 0..stressed.closure.couplings.len() {
        let r = Release::Coupling(q);
        rows.push((0, r));
        if may(&r) {
            out.releases.push((COUPLING, r));
        }
    }
    for j in m.joints_in(state) {
        for r in stressed.at(j) {
            rows.push((if closes(j) { 1 } else { 2 }, r));
            if may(&r) {
                out.releases.push((cost(m, &r, closes(j)), r));
            }
        }
    }
    out.list = stressed.duplicates(&rows, &out.releases);
    out.cheapest = stressed.cheapest(&out.releases);
    let gap = meant
        .numeric
        .map_or(FLAT, |n| (n.kept * n.dropped.max(1e-13)).sqrt());
    // Between what is kept and what is dropped, where coordinates are rounded.
    let tolerance = gap.max(FLAT);
    let finite = match out.analysis.certainty {
        Certainty::Undecided { .. } => out.analysis.finite.by_numeric_rank(),
        _ => out.analysis.finite,
    };
    out.over = Some(redundant_where(
        geometry,
        state,
        &finite,
        (most, tolerance),
        POSES,
    )?);
    Ok(out)
}

/// Cost of taking a coupling away.
const COUPLING: i64 = 500;

/// What a release costs, in thousandths of a revolute joint: a pin that may slide is the cheapest.
fn cost(m: &Mechanism, release: &Release, closes: bool) -> i64 {
    let Release::Freedom {
        joint,
        slides,
        direction,
    } = *release
    else {
        return COUPLING;
    };
    let j = &m.joints[joint];
    let pin = j.joint_type == JointType::Revolute
        && slides
        && parallel(unit(real(&j.frame.axis)), direction);
    match (closes, pin, slides) {
        (false, true, _) => 1500,
        (true, _, true) => 1750,
        (_, _, false) => 2500,
        _ => 3000,
    }
}

fn parallel(a: Vector, b: Vector) -> bool {
    length(cross(a, b)) < 1e-6
}
