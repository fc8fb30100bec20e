//! Warnings about rounded coordinates: the idealised geometry, and joints that are nearly special.

use crate::file::warning::{WarningKind, first_of};
use crate::geom::expr::Expr;
use crate::geom::vector::{across, length, real, sub, unit};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, JointId, Mechanism};
use crate::model::rounded::{looks_rounded, uncertainties};
use crate::rank::rounded::nearly_special::{NearJoint, Reach, Relation, nearly_special, reach};
use crate::rank::rounded::size;
use crate::rank::rounded::verdict::{Meant, RankVerdict, verdict};

/// Joints nearer to special than this, in radians and sizes of the mechanism, were hardly meant to miss it.
const NEARLY: f64 = 1e-4;
/// Pairs of joints told of.
const TOLD: usize = 5;

/// Returns the doubtful values.
pub(super) fn doubts(m: &Mechanism) -> Vec<WarningKind> {
    let mut out = Vec::new();
    if let Some(rounded) = looks_rounded(m).filter(|r| r.digits.is_some() && !r.pi) {
        let what = rounded.to_string();
        out.push(WarningKind::Measured { what });
    }
    for state in m.state_ids() {
        // Why there is no verdict is for `ozols analyze` to say.
        let Ok(found) = verdict(m, state) else {
            continue;
        };
        // What is meant has mostly the figures of what is written; only others are doubtful.
        if !found.agrees() {
            out.push(of_verdict(&found));
        }
    }
    out.extend(by_default(m));
    let all = nearly(m);
    if !all.is_empty() {
        let what = first_of(&all, TOLD);
        out.push(WarningKind::NearlySpecial { what });
    }
    out
}

/// Returns a warning about second axes that use the default while other axes are rounded. They depend on the file's x, y and z,
/// so the same mechanism rotated in space has others.
fn by_default(m: &Mechanism) -> Option<WarningKind> {
    let half = uncertainties(m)?;
    let left = |(j, joint): &(JointId, &Joint)| {
        let given = |e: &Expr| e.is_written_whole() || e.half_unit().is_some();
        let types =
            std::iter::once(&joint.joint_type).chain(joint.offered().map(|o| &o.joint_type));
        half.frames[j.index()].axis != [0.0; 3]
            && types.into_iter().any(JointType::has_second_axis)
            && joint
                .frame
                .reference
                .iter()
                .all(|e| !given(e) && e.as_rational().is_some())
    };
    let all: Vec<(JointId, &Joint)> = m.joints_with_ids().filter(left).collect();
    let (_, first) = all.first()?;
    let axis = unit(real(&first.frame.axis));
    let here = real(&first.frame.point);
    let others = m
        .joints
        .iter()
        .map(|other| across(sub(real(&other.frame.point), here), axis));
    let towards = others.max_by(|a, b| length(*a).total_cmp(&length(*b)))?;
    let towards = if length(towards) > 0.0 {
        unit(towards)
    } else {
        return None;
    };
    let ids: Vec<&str> = all.iter().map(|(_, j)| j.id.as_str()).collect();
    let [x, y, z] = towards.map(|c| format!("{c:.6}"));
    Some(WarningKind::DefaultReference {
        joints: first_of(&ids, TOLD),
        first: first.id.clone(),
        reference: format!("[{x}, {y}, {z}]"),
    })
}

fn of_verdict(found: &RankVerdict) -> WarningKind {
    let figures = |rank: usize| {
        let (w, sigma) = found.figures(rank);
        format!("W = {w}, σ = {sigma}")
    };
    let state = found.state.clone();
    if found.is_decided() {
        let understood = match &found.meant {
            Meant::Snapped { understood, .. } => format!(". Understood: {understood}"),
            _ => String::new(),
        };
        WarningKind::Meant {
            understood,
            state,
            meant: figures(found.rank()),
            written: figures(found.as_written),
        }
    } else {
        let what = found.undecided();
        WarningKind::Undecided { state, what }
    }
}

/// Lists pairs of joints that are nearly parallel, perpendicular, coaxial or concurrent, and their distances from it.
fn nearly(m: &Mechanism) -> Vec<String> {
    let least = Reach::relative(NEARLY, size(m));
    let within = reach(m).map_or(least, |r| Reach {
        length: r.length.max(least.length),
        angle: r.angle.max(least.angle),
    });
    let all = nearly_special(m, within);
    all.iter().filter_map(|x| words(m, x)).collect()
}

/// Describes a pair of joints, such as "LF and LR are 0.002 degrees from coaxial".
fn words(m: &Mechanism, x: &NearJoint) -> Option<String> {
    let strongest = x.relations.iter().max_by_key(|(r, of)| (*r, of.is_some()));
    let (relation, other) = strongest?;
    let (id, far) = (&m.joints[x.joint].id, x.far(m));
    let special = match relation {
        Relation::Parallel => "parallel",
        Relation::Square => "square",
        Relation::InPlane => "one plane",
        Relation::Coaxial => "coaxial",
        Relation::Meeting => "meeting",
        Relation::Concentric => "concentric",
    };
    Some(match other {
        Some(j) => format!("{} and {id} are {far} from {special}", m.joints[*j].id),
        None => format!("{id} is {far} from {special} to a global axis"),
    })
}
