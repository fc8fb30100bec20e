//! Validation: from the file's entries to a mechanism, or every problem with them.

pub mod coupling;
mod joints;
mod links;
#[doc(hidden)]
pub mod resolve;
pub(crate) mod search;
pub mod value;
pub mod workload;

use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::coupling::couplings;
use crate::file::read::search::ranking::{joint_types, ranking};
use crate::file::read::value::names::{check_id, link_by_id};
use crate::file::read::value::number::{direction, vector};
use crate::file::read::value::{ENTRIES, knowing, length_unit, unused};
use crate::file::read::workload::drive::drive;
use crate::file::read::workload::grip::grip;
use crate::file::read::workload::loads::loads;
use crate::file::schema::MechanismFile;
use crate::file::{Finding, Findings};
use crate::format::disjunction;
use crate::geom::expr::Expr;
use crate::model::claim::{Claim, Topic};
use crate::model::loads::Loads;
use crate::model::mechanism::{Expected, Mechanism, Mode, PointOfInterest, SearchSpec};
use joints::{joints, states};
use links::{connected, contours, links};
use search::search;
use value::LIMITS;
use value::tolerance::tolerance;

/// The claims of a file; one of an unknown topic is a problem.
pub(crate) fn claims(file: &MechanismFile, out: &mut Findings) -> Vec<Claim> {
    let mut list = Vec::new();
    for (i, c) in file.claim.iter().enumerate() {
        let Some(topic) = Topic::ALL.into_iter().find(|t| t.word() == c.topic) else {
            let key = |k: &str| DocumentStep::Key(k.to_owned());
            let path = [key("claim"), DocumentStep::Index(i), key("topic")];
            let known = disjunction(Topic::ALL.map(Topic::word));
            let (what, word) = ("topic", c.topic.clone());
            out.add(&path, ProblemKind::UnknownWord { what, word, known });
            continue;
        };
        list.push(Claim {
            topic,
            source: c.source.clone(),
            says: c.says.clone(),
            right: c.right.clone(),
            scan: c.scan.clone(),
            evidence: c.evidence.clone(),
        });
    }
    list
}

/// Refuses a file of too many entries before any of them is read.
fn few_enough(file: &MechanismFile) -> Result<(), Vec<Finding>> {
    for (what, count, limit) in [
        ("links", file.link.len(), LIMITS.0),
        ("joints", file.joint.len(), LIMITS.1),
        ("contours", file.contour.len(), LIMITS.1),
        ("couplings", file.coupling.len(), LIMITS.1),
        ("points", file.point.len(), LIMITS.1),
    ] {
        if count > limit {
            return Err(vec![(
                vec![DocumentStep::Key(what[..what.len() - 1].to_owned())],
                ProblemKind::TooMany { what, count, limit },
            )]);
        }
    }
    Ok(())
}

/// Builds a mechanism.
///
/// # Errors
/// The problems found, the first hundred of them.
pub fn build(file: &MechanismFile) -> Result<Mechanism, Vec<Finding>> {
    let mut out = knowing(file);
    few_enough(file)?;
    let length_unit = length_unit(file, &mut out);
    let mode = mode(file, &mut out);
    let links = links(file, &mut out);
    let states = states(file, &mut out);
    let joints = joints(file, &links, &states, &mut out);
    if out.count() > 0 {
        return Err(out.told());
    }
    let mut mechanism = Mechanism {
        name: file.name.clone(),
        description: file.description.clone(),
        sources: file.sources.clone(),
        length_unit,
        mode,
        links,
        joints,
        couplings: Vec::new(),
        states,
        contours: Vec::new(),
        search: SearchSpec::default(),
        loads: Loads::default(),
        ranking: None,
        joint_types: Vec::new(),
        points: Vec::new(),
        expected: Vec::new(),
        claims: Vec::new(),
        assumed: file.assumed.clone(),
    };
    connected(&mechanism, &mut out);
    if !size(&mechanism, &mut out) {
        return Err(out.told());
    }
    couplings(file, &mut mechanism, &mut out);
    mechanism.contours = contours(file, &mechanism, &mut out);
    mechanism.search = search(file, &mechanism, &mut out);
    mechanism.loads = loads(file, &mechanism, &mut out);
    mechanism.loads.grip = grip(file, length_unit.metres, Some(&mechanism), &mut out);
    mechanism.loads.drive = drive(file, length_unit.metres, Some(&mechanism), &mut out);
    mechanism.ranking = ranking(file, &mechanism, &mut out);
    let (joint_types, costs) = joint_types(file, &mechanism, &mut out);
    mechanism.joint_types = joint_types;
    let by_type = &mut mechanism.search.costs.by_type_milli;
    by_type.extend(costs);
    // [search.costs] come first and win.
    by_type.sort_by(|a, b| a.0.cmp(&b.0));
    by_type.dedup_by(|later, first| later.0 == first.0);
    mechanism.points = points(file, &mechanism, &mut out);
    tolerance(file, &mut mechanism, &mut out);
    mechanism.expected = expected(file, &mechanism, &mut out);
    mechanism.claims = claims(file, &mut out);
    if out.count() == 0 {
        unused(&mut out);
    }
    out.unless(mechanism)
}

pub(crate) fn points(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> Vec<PointOfInterest> {
    let mut points = Vec::with_capacity(file.point.len());
    for (i, entry) in file.point.iter().enumerate() {
        let at = index(&[DocumentStep::Key("point".to_owned())], i);
        let twice = file.point[..i].iter().any(|p| p.id == entry.id);
        check_id("point", &entry.id, twice, &key(&at, "id"), out);
        let place = vector(&entry.point, &key(&at, "point"), out);
        if let Some(link) = link_by_id(&mechanism.links, &entry.link, &key(&at, "link"), out) {
            points.push(PointOfInterest {
                id: entry.id.clone(),
                link,
                point: place,
            });
        }
    }
    points
}

pub(crate) fn mode(file: &MechanismFile, out: &mut Findings) -> Mode {
    let root = |k: &str| vec![DocumentStep::Key(k.to_owned())];
    match file.mode.as_deref().unwrap_or("spatial") {
        "planar" => {
            let at = root("plane_normal");
            let given = file.plane_normal.as_ref().map(|v| direction(v, &at, out));
            let normal = given.unwrap_or_else(|| [0, 0, 1].map(Expr::from));
            if normal.iter().all(|c| c.to_f64() == 0.0) {
                out.add(
                    &at,
                    ProblemKind::ZeroVector {
                        joint: "of the plane".to_owned(),
                        what: "normal",
                    },
                );
            }
            Mode::Planar { normal }
        }
        other => {
            if other != "spatial" {
                let known = "spatial, planar".to_owned();
                out.add(
                    &root("mode"),
                    ProblemKind::UnknownWord {
                        what: "mode",
                        word: other.to_owned(),
                        known,
                    },
                );
            }
            Mode::Spatial
        }
    }
}

pub(crate) fn expected(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> Vec<Expected> {
    let mut list = Vec::new();
    for (i, e) in file.expected.iter().enumerate() {
        let state = e.state.clone().unwrap_or_else(|| "free".to_owned());
        if !mechanism.states.contains(&state) {
            let path = [
                DocumentStep::Key("expected".to_owned()),
                DocumentStep::Index(i),
                DocumentStep::Key("state".to_owned()),
            ];
            let known = mechanism.states.join(", ");
            out.add(
                &path,
                ProblemKind::UnknownWord {
                    what: "state",
                    word: state.clone(),
                    known,
                },
            );
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

/// Whether no state's closure matrix is too large: a row for each constraint of a contour, a column for each freedom.
pub(crate) fn size(m: &Mechanism, out: &mut Findings) -> bool {
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
