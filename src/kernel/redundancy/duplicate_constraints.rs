//! The redundant constraints of a mechanism: each by name, whether it holds over the motion, and the releases that
//! remove it.

use crate::closure::tree::spanning_tree;
use crate::geom::vector::{Vector, cross, length, to_vector, unit};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, Mechanism, Role, StateId};
use crate::motion::pose::Pose;
use crate::motion::{move_mechanism, turned_back};
use crate::rank::method::Certainty;
use crate::rank::rounded::verdict::{Meant, RankVerdict, rank_verdict};
use crate::redundancy::AnalysisError;
use crate::redundancy::analysis::{Method, StateAnalysis, analyse_states};
use crate::redundancy::other_poses::{Where, redundant_where};
use crate::redundancy::release::{Duplicate, Release};
use crate::redundancy::stressed::Stressed;

/// Relative singular values below this count as zero if no rounding is known.
const FLAT: f64 = 1e-9;

/// The redundant constraints of a free state.
#[derive(Debug)]
pub struct HeldTwice {
    /// Its analysis.
    pub analysis: StateAnalysis,
    /// Poses in which σ holds, or `None` if nothing is redundant.
    pub over: Option<Where>,
    /// Number of constraints that are redundant over the motion, as far as is known. The others are redundant at this
    /// pose only, and have no releases. If undecided, this is the number of all.
    pub lasting: usize,
    /// Each redundant constraint, those over the motion first. Empty if they cannot be identified.
    pub list: Vec<Duplicate>,
    /// Releases that were examined, with their costs in thousandths.
    pub releases: Vec<(i64, Release)>,
    /// Indices of the cheapest set of releases that removes all lasting redundant constraints and adds no mobility.
    /// Fewer if there is no such set.
    pub cheapest: Vec<usize>,
}

impl HeldTwice {
    /// Returns the smallest and largest number of redundant constraints. They are equal unless rounded coordinates
    /// leave it open.
    #[must_use]
    pub fn range(&self) -> (usize, usize) {
        let least = self.analysis.redundant;
        (
            least,
            self.analysis.at_most().map_or(least, |(_, most)| most),
        )
    }

    /// Determines where σ holds. If fewer constraints are redundant at a further pose, those are the lasting ones, and
    /// the pose is returned.
    fn look_elsewhere(
        &mut self,
        geometry: &Mechanism,
        errors: [f64; 2],
        inside: &dyn Fn(&Pose) -> bool,
    ) -> Result<Option<Pose>, AnalysisError> {
        let (_, most) = self.range();
        let finite = match self.analysis.certainty {
            Certainty::Undecided { .. } => self.analysis.finite.by_numeric_rank(),
            _ => self.analysis.finite,
        };
        let (over, pose) = redundant_where(geometry, StateId::FREE, &finite, most, errors, inside)?;
        self.over = Some(over);
        if let Where::Pose { elsewhere, .. } = over {
            self.lasting = elsewhere;
        }
        Ok(pose)
    }

    /// Adds the redundant constraints of a part: the lasting ones, and those of this pose only. `elsewhere` is another
    /// pose with fewer of them, and the same part there. It is `None` for the part if it has no redundant constraints
    /// there.
    fn add(
        &mut self,
        m: &Mechanism,
        part: &Stressed<'_>,
        elsewhere: Option<(&Pose, Option<&Stressed<'_>>)>,
        find: &dyn Fn(&Stressed<'_>) -> [Costed; 2],
    ) -> [Vec<Duplicate>; 2] {
        let [mut rows, here] = find(part);
        let (lasting, releases, built) = match elsewhere {
            None => {
                let built = as_built(m, part, &here);
                (part.count_redundant(), here, built)
            }
            Some((_, None)) => (0, Vec::new(), Vec::new()),
            // Lasting constraints are identified in the other pose, which has no others, and converted back to this
            // pose.
            Some((pose, Some(there))) => {
                let [theirs, releases] = find(there);
                let built = as_built(m, there, &releases);
                let back = |r: &Release| taken_back(m, pose, r);
                let chosen = there.cheapest_releases(&theirs);
                let first = chosen.iter().map(|&i| (FIRST, back(&theirs[i].1)));
                rows.splice(0..0, first);
                let releases = releases.iter().map(|(c, r)| (*c, back(r))).collect();
                (there.count_redundant(), releases, built)
            }
        };
        let before = self.releases.len();
        let mut list = part.find_duplicates(&rows, &releases);
        for d in &mut list {
            d.remedies.iter_mut().for_each(|i| *i += before);
        }
        self.cheapest.extend(built.iter().map(|i| i + before));
        self.releases.extend(releases);
        let passing = list.split_off(lasting.min(list.len()));
        [list, passing]
    }
}

/// Finds the redundant constraints. `closes` says which joints exist to close loops, `may` which releases are allowed,
/// and `inside` which poses are within the limits of the joints. Without `inside`, only this pose is examined.
///
/// # Guarantee
/// σ is as the analysis says. The choice of redundant constraints of each loop is numeric, and there are other choices of as
/// many constraints. If nothing is proven, a few further poses show which are redundant at this pose only.
///
/// # Errors
/// Returns an error in the same cases as [`analyse_states`].
///
/// # Complexity
/// That of an analysis and two decompositions of J. If nothing is proven, also a few tens of closures. Only an analysis if σ
/// = 0.
///
/// # Examples
/// ```
/// use ozols::redundancy::duplicate_constraints::held_twice;
/// let four_bar = ozols::built_in("four-bar")?;
/// let found = held_twice(&four_bar, &|_| false, &|_| true, None)?;
/// assert_eq!((found.range(), found.list.len()), ((3, 3), 3));
/// assert_eq!(found.cheapest.len(), 3); // Three releases remove the three.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn held_twice(
    m: &Mechanism,
    closes: &dyn Fn(JointId) -> bool,
    may: &dyn Fn(&Release) -> bool,
    inside: Option<&dyn Fn(&Pose) -> bool>,
) -> Result<HeldTwice, AnalysisError> {
    let state = StateId::FREE;
    let mut found = analyse_states(m, &[state], Method::Auto)?;
    let analysis = found.remove(0);
    let mut out = HeldTwice {
        analysis,
        over: None,
        lasting: 0,
        list: Vec::new(),
        releases: Vec::new(),
        cheapest: Vec::new(),
    };
    let (_, most) = out.range();
    out.lasting = most;
    if most == 0 {
        return Ok(out);
    }
    let meant = rank_verdict(m, state)?;
    let geometry = meant.intended_mechanism().unwrap_or(m);
    let elsewhere = match inside {
        Some(inside) => out.look_elsewhere(geometry, value_errors(&meant), inside)?,
        None => None,
    };
    let there = match &elsewhere {
        Some(pose) => match move_mechanism(geometry, pose) {
            Some(there) => Some((pose, there)),
            None => return Ok(out),
        },
        None => None,
    };
    let rows = out.analysis.rows;
    let parts = |m, redundant| Stressed::stressed_parts(m, state, rows - redundant);
    let lasting = match &there {
        Some((pose, there)) => parts(there, out.lasting)?.map(|parts| Some((*pose, parts))),
        None => Some(None),
    };
    let (Some(here), Some(lasting)) = (parts(geometry, most)?, lasting) else {
        return Ok(out);
    };
    let find = |part: &Stressed<'_>| find_candidates(m, part, closes, may);
    let mut lists = [Vec::new(), Vec::new()];
    for part in &here {
        let elsewhere = lasting.as_ref().map(|(pose, parts)| {
            let same = parts.iter().find(|p| p.joints == part.joints);
            (*pose, same)
        });
        let found = out.add(m, part, elsewhere, &find);
        lists.iter_mut().zip(found).for_each(|(l, f)| l.extend(f));
    }
    out.list = lists.concat();
    if out.list.len() < most {
        out.list.clear();
    }
    Ok(out)
}

/// Returns the share of the largest singular value below which values count as zero, and the relative error of
/// coordinates, 0 if they are exact.
fn value_errors(meant: &RankVerdict) -> [f64; 2] {
    let accuracy = match meant.meant {
        Meant::AsWritten | Meant::Snapped { .. } => 0.0,
        Meant::Near { .. } | Meant::Undecided { .. } => meant.tolerance,
    };
    [value_tolerance(meant), accuracy]
}

/// Returns the relative singular value below which values count as zero: between the kept and the dropped ones, if
/// coordinates are rounded.
fn value_tolerance(meant: &RankVerdict) -> f64 {
    let gap = meant
        .numeric
        .map_or(FLAT, |n| (n.kept * n.dropped.max(1e-13)).sqrt());
    gap.max(FLAT)
}

/// Converts a release at a moved pose to the pose of the file.
fn taken_back(m: &Mechanism, pose: &Pose, release: &Release) -> Release {
    match *release {
        Release::Coupling(q) => Release::Coupling(q),
        Release::Freedom {
            joint,
            slides,
            direction,
        } => Release::Freedom {
            joint,
            slides,
            direction: settled_back(m, pose, joint, direction),
        },
    }
}

/// Converts a direction of a moved pose to the pose of the file, as a multiple of 1e-9, which removes rounding errors.
fn settled_back(m: &Mechanism, pose: &Pose, joint: JointId, direction: Vector) -> Vector {
    let d = turned_back(pose, m.joints[joint].links[0], direction);
    unit(d.map(|x| (x * 1e9).round() / 1e9 + 0.0))
}

/// Cost rank before all others.
const FIRST: i64 = -1;

type Costed = Vec<(i64, Release)>;

/// Returns the constraints that self-stresses load, in the order of the report, and the allowed releases with their
/// costs.
fn find_candidates(
    m: &Mechanism,
    stressed: &Stressed<'_>,
    closes: &dyn Fn(JointId) -> bool,
    may: &dyn Fn(&Release) -> bool,
) -> [Costed; 2] {
    let (mut rows, mut releases) = (Vec::new(), Vec::new());
    for &q in &stressed.couplings {
        let r = Release::Coupling(q);
        rows.push((0, r));
        if may(&r) {
            releases.push((COUPLING, r));
        }
    }
    for &j in &stressed.joints {
        for r in stressed.releases_at(j) {
            rows.push((if closes(j) { 1 } else { 2 }, r));
            if may(&r) {
                releases.push((release_cost(m, &r, closes(j)), r));
            }
        }
    }
    [rows, releases]
}

/// Additional cost of each further slide at a joint: a ball on three slides constrains nothing.
const SLIDES: i64 = 3000;
/// Cost reduction of a turn at a hinge that already has one: it becomes a ball, and no second joint changes.
const BALL: i64 = -500;
/// Additional cost of a slide at a joint with a new turn, and vice versa: a ball and a cylindrical joint are two
/// joints.
const BOTH: i64 = 500;
/// Additional cost at the joint that supports a link with a wanted motion, such as a wheel or a hand: it would yield
/// under load.
const BEARING: i64 = 1500;

/// Returns the practical releases: of those with about the same cost, one cylindrical joint and one ball per loop, in
/// its middle.
fn as_built(m: &Mechanism, stressed: &Stressed<'_>, candidates: &[(i64, Release)]) -> Vec<usize> {
    let tree = spanning_tree(m, StateId::FREE);
    let bears = |j: JointId| {
        let mut steps = tree.iter();
        steps.any(|s| s.joint == j && m.links[s.link].role == Role::Output)
    };
    stressed.choose_releases(candidates, &|i, chosen| {
        let (cost, release) = &candidates[i];
        let Some((joint, slides, _)) = release.added_freedom() else {
            return *cost;
        };
        let here = chosen.iter().filter_map(|&c| match candidates[c].1 {
            Release::Freedom {
                joint: j, slides, ..
            } if j == joint => Some(slides),
            _ => None,
        });
        let (before, others): (Vec<bool>, Vec<bool>) = here.partition(|s| *s == slides);
        let hinge = m.joints[joint].joint_type == JointType::Revolute;
        let again = match slides {
            true => SLIDES * i64::try_from(before.len()).unwrap_or(0),
            false if hinge && !before.is_empty() => BALL,
            false => 0,
        };
        let both = if others.is_empty() { 0 } else { BOTH };
        cost + again + both + if bears(joint) { BEARING } else { 0 }
    })
}

/// Cost of removing a coupling.
const COUPLING: i64 = 500;

/// Returns the cost of a release, in thousandths of a revolute joint. A pin that may slide is the cheapest.
fn release_cost(m: &Mechanism, release: &Release, closes: bool) -> i64 {
    let Some((joint, slides, direction)) = release.added_freedom() else {
        return COUPLING;
    };
    let j = &m.joints[joint];
    let pin = j.joint_type == JointType::Revolute
        && slides
        && is_parallel(unit(to_vector(&j.frame.axis)), direction);
    match (closes, pin, slides) {
        (false, true, _) => 1500,
        (true, _, true) => 1750,
        (_, _, false) => 2500,
        _ => 3000,
    }
}

fn is_parallel(a: Vector, b: Vector) -> bool {
    length(cross(a, b)) < 1e-6
}
