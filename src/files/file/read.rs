//! Validation: from the file's entries to a mechanism, or every problem with them.

mod claims;
mod connected;
mod contours;
pub mod coupling;
mod expected;
mod joints;
mod links;
mod mode;
mod points;
#[doc(hidden)]
pub mod resolve;
pub(crate) mod search;
mod size;
pub mod value;
pub mod workload;

use crate::file::findings::Finding;
use crate::file::locate::DocumentStep;
use crate::file::problem::ProblemKind;
use crate::file::read::coupling::couplings;
use crate::file::read::search::ranking::{joint_types, ranking};
use crate::file::read::value::parameters::{knowing, unused};
use crate::file::read::value::unit::length_unit;
use crate::file::read::workload::drive::drive;
use crate::file::read::workload::grip::grip;
use crate::file::read::workload::loads::loads;
use crate::file::schema::MechanismFile;
use crate::model::loads::Loads;
use crate::model::mechanism::{Mechanism, SearchSpec};
use claims::claims;
use connected::connected;
use contours::contours;
use expected::expected;
use joints::{joints, states};
use links::links;
use mode::mode;
use points::points;
use search::search;
use size::size;
use value::limits::LIMITS;
use value::tolerance::tolerance;

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
