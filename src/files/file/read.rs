//! Validation: from the file's entries to a mechanism, or every problem with them.

pub mod coupling;
mod joints;
#[doc(hidden)]
pub mod resolve;
pub mod search;
pub mod value;
pub mod workload;

use crate::file::prelude::*;
use crate::file::read::coupling::read_couplings;
use crate::file::read::joints::{
    check_connected, read_contours, read_joints, read_links, read_states,
};
use crate::file::read::resolve::zero_vector;
use crate::file::read::search::{joint_types, read_ranking, read_search};
use crate::file::read::value::quantity::read_tolerance;
use crate::file::read::value::{ENTRIES, LIMITS, length_unit, with_parameters};
use crate::file::read::workload::drive::read_drive;
use crate::file::read::workload::grip::read_grip;
use crate::file::read::workload::loads::read_loads;
use crate::format::join_or;
use crate::model::claim::{Claim, Topic};
use crate::model::loads::Loads;
use crate::model::mechanism::{Expected, Mode, PointOfInterest, SearchSpec};
use serde_json::Value;
use std::sync::Arc;

/// Returns the claims of a file; reports those of an unknown topic.
pub(crate) fn read_claims(file: &MechanismFile, out: &Findings) -> Vec<Claim> {
    let claim = |(at, c): (Place<'_>, &ClaimEntry)| {
        let topic = Topic::ALL.into_iter().find(|t| t.as_word() == c.topic);
        if topic.is_none() {
            let known = join_or(Topic::ALL.map(Topic::as_word));
            at.key("topic").add_unknown_word("topic", &c.topic, [known]);
        }
        Some(Claim {
            topic: topic?,
            source: c.source.clone(),
            says: c.says.clone(),
            right: c.right.clone(),
            scan: c.scan.clone(),
            evidence: c.evidence.clone(),
        })
    };
    let all = out.key("claim").each_entry(&file.claim);
    all.filter_map(claim).collect()
}

/// Returns true if no list of the file has too many entries; reports the first that has.
fn few_enough(file: &MechanismFile, out: &Findings) -> bool {
    let counts = [
        ("links", file.link.len(), LIMITS.0),
        ("joints", file.joint.len(), LIMITS.1),
        ("contours", file.contour.len(), LIMITS.1),
        ("couplings", file.coupling.len(), LIMITS.1),
        ("points", file.point.len(), LIMITS.1),
    ];
    counts.into_iter().all(|(what, count, limit)| {
        out.key(&what[..what.len() - 1])
            .count_within(limit, count, what)
    })
}

/// Builds a mechanism.
///
/// # Errors
/// Returns the first hundred problems found.
///
/// # Examples
/// ```
/// use ozols::file::{read::build_mechanism, schema::MechanismFile, write::mechanism_file};
/// let file = mechanism_file(&ozols::built_in("bennett")?);
/// assert!(build_mechanism(&file).is_ok_and(|m| m.joints.len() == 4));
/// assert!(build_mechanism(&MechanismFile::default()).is_err());
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn build_mechanism(file: &MechanismFile) -> Result<Mechanism, Vec<Finding>> {
    let mut out = with_parameters(file);
    if !few_enough(file, &out) {
        return Err(out.into_findings());
    }
    let length_unit = length_unit(file, &out);
    let mode = read_mode(file, &out);
    let links = read_links(file, &out);
    out.states = read_states(file, &out);
    let joints = read_joints(file, &links, &out);
    if out.problem_count() > 0 {
        return Err(out.into_findings());
    }
    let mut mechanism = Parts {
        name: file.name.clone(),
        description: file.description.clone(),
        sources: file.sources.clone(),
        length_unit,
        mode,
        links,
        joints,
        couplings: Vec::new(),
        states: out.states.clone(),
        contours: Vec::new(),
        search: SearchSpec::default(),
        loads: Loads::default(),
        ranking: None,
        joint_types: Vec::new(),
        points: Vec::new(),
        expected: Vec::new(),
        claims: Vec::new(),
        assumed: file.assumed.clone(),
        tables: Arc::default(),
    };
    check_connected(&mechanism, &out);
    if !check_matrix_size(&mechanism, &out) {
        return Err(out.into_findings());
    }
    read_couplings(file, &mut mechanism, &out);
    mechanism.contours = read_contours(file, &mechanism, &out);
    mechanism.search = read_search(file, &mechanism, &out);
    let before = out.used.take();
    read_tables(file, &mut mechanism, &out);
    mechanism.tables = Arc::new(keep_tables(file, &mechanism, &out.used.borrow()));
    out.used.borrow_mut().extend(before);
    let (joint_types, costs) = joint_types(file, &mechanism, &out);
    mechanism.joint_types = joint_types;
    let by_type = &mut mechanism.search.costs.by_type_milli;
    by_type.extend(costs);
    // [search.costs] come first and win.
    by_type.sort_by(|a, b| a.0.cmp(&b.0));
    by_type.dedup_by(|later, first| later.0 == first.0);
    mechanism.points = read_points(file, &mechanism, &out);
    read_tolerance(file, &mut mechanism, &out);
    mechanism.expected = read_expected(file, &mechanism, &out);
    mechanism.claims = read_claims(file, &out);
    if out.problem_count() > 0 {
        return Err(out.into_findings());
    }
    out.tell_unused();
    match Mechanism::new(mechanism) {
        Ok(mechanism) => out.finish(mechanism),
        Err(e) => {
            out.root_place().add_problem(e.to_string());
            Err(out.into_findings())
        }
    }
}

/// Reads the loads and the ranking of a mechanism whose links and joints are known.
pub(crate) fn read_tables(file: &MechanismFile, m: &mut Parts, out: &Findings) {
    let metres = m.length_unit.metres;
    m.loads = read_loads(file, m, out);
    m.loads.grip = read_grip(file, metres, Some(m), out);
    m.loads.drive = read_drive(file, metres, Some(m), out);
    m.ranking = read_ranking(file, m, out);
}

/// Returns the tables that are written unchanged, with the parameters that they use.
fn keep_tables(file: &MechanismFile, m: &Parts, used: &BTreeSet<String>) -> Value {
    let parameters = file
        .parameter
        .iter()
        .filter(|(name, _)| used.contains(*name));
    let mut kept = MechanismFile {
        name: file.name.clone(),
        parameter: parameters.map(|(k, v)| (k.clone(), v.clone())).collect(),
        workload: file.workload.clone(),
        tolerances: file.tolerances.clone(),
        ranking: file.ranking.clone(),
        expected: file.expected.clone(),
        claim: file.claim.clone(),
        ..MechanismFile::default()
    };
    if let (Some(entry), Some(spec)) = (&mut kept.workload.drive, &m.loads.drive)
        && entry.disc_link.take().is_some()
    {
        // A redesign may have another joint at this link.
        entry.inertia = Some(Coordinate::Decimal(spec.inertias[0]));
    }
    kept.json()
}

fn read_points(file: &MechanismFile, mechanism: &Parts, out: &Findings) -> Vec<PointOfInterest> {
    let mut points = Vec::with_capacity(file.point.len());
    for (i, (at, entry)) in out.key("point").each_entry(&file.point).enumerate() {
        let twice = file.point[..i].iter().any(|p| p.id == entry.id);
        at.check_id("point", &entry.id, twice);
        let (id, point) = (entry.id.clone(), at.key("point").read_vector(&entry.point));
        let link = at.key("link").read_link(&mechanism.links, &entry.link);
        points.extend(link.map(|link| PointOfInterest { id, link, point }));
    }
    points
}

fn read_mode(file: &MechanismFile, out: &Findings) -> Mode {
    let words = [("spatial", false), ("planar", true)];
    if !out.root_place().read_word("mode", &file.mode, &words) {
        return Mode::Spatial;
    }
    let at = out.key("plane_normal");
    let given = file.plane_normal.as_ref().map(|v| at.read_direction(v));
    let normal = given.unwrap_or_else(|| [0, 0, 1].map(Expr::from));
    if normal.iter().all(|c| c.to_f64() == 0.0) {
        at.add_problem(zero_vector("normal", "of the plane"));
    }
    Mode::Planar { normal }
}

pub(crate) fn read_expected(
    file: &MechanismFile,
    mechanism: &Parts,
    out: &Findings,
) -> Vec<Expected> {
    let mut list = Vec::new();
    for (at, e) in out.key("expected").each_entry(&file.expected) {
        let state = e.state.clone().unwrap_or_else(|| "free".to_owned());
        if !mechanism.states.contains(&state) {
            at.key("state")
                .add_unknown_word("state", &state, &mechanism.states);
        }
        list.push(Expected {
            state,
            mobility: e.mobility,
            finite_mobility: e.finite_mobility,
            working_mobility: e.working_mobility,
            local_mobility: e.local_mobility,
            redundant: e.redundant,
            external_redundant: e.external_redundant,
            source: e.source.clone(),
        });
    }
    list
}

/// Returns true if no state's closure matrix is too large: a row for each constraint of a contour, a column for each freedom.
fn check_matrix_size(m: &Parts, out: &Findings) -> bool {
    let mut fits = true;
    let dim = match m.mode {
        Mode::Spatial => 6,
        Mode::Planar { .. } => 3,
    };
    for (state, name) in m.states_with_ids() {
        let joints = || m.joints_in(state).map(|j| &m.joints[j]);
        let touched = joints().flat_map(|j| j.links).unique().count();
        // The links of a state are connected.
        let contours = (joints().count() + 1).saturating_sub(touched);
        let columns: usize = joints().map(|j| j.joint_type.freedoms().len()).sum();
        if dim * contours * columns > ENTRIES {
            fits = false;
            out.root_place().add_problem(format!(
                "the closure matrix of state {name} would have {} rows and {columns} columns, more than {ENTRIES} entries; remove irrelevant parts, or move independent parts to separate files",
                dim * contours
            ));
        }
    }
    fits
}
