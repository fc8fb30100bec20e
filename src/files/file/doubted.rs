//! Doubtful values of a file: ratios and pitches that are written as decimals and are nearly fractions. Also directions of options that are
//! omitted and default to the joint's own, if they have another meaning there.

use crate::file::prelude::*;
use crate::format::{first_of, four_digits};
use crate::geom::vector::{across, unit};
use crate::model::rounded::ratio::{doubt_of, doubt_ratio};
use crate::model::rounded::{looks_rounded, uncertainties};
use crate::rank::rounded::mechanism_size;
use crate::rank::rounded::nearly_special::{
    NearJoint, Reach, Relation, nearly_special, rounding_reach,
};
use crate::rank::rounded::verdict::{Meant, RankVerdict, rank_verdict};

/// Warns of doubtful values of the couplings and screws of a mechanism.
pub(super) fn find_doubtful(file: &MechanismFile, m: &Mechanism, out: &Findings) {
    for (at, c) in out.key("coupling").each_entry(&m.couplings) {
        if let Some(doubt) = doubt_of(c) {
            at.key("ratio").warn(format!(
                "the ratio {} of {} is a decimal, known to within {}; write ratio = \"{}\" if that is intended, or another fraction",
                c.ratio, c.name(m), four_digits(doubt.half), doubt.fraction
            ));
        }
    }
    let turn = Expr::from(2) * Expr::pi();
    let joints = out.key("joint").each_entry(&file.joint).zip(&m.joints);
    for ((at, _), joint) in joints.filter(|((_, entry), _)| entry.pitch.is_some()) {
        let pitch = &joint.frame.pitch;
        // Screws are specified by their lead.
        let lead = Expr::from_f64((pitch * &turn).to_f64()).ok();
        let lead = lead.and_then(|x| doubt_ratio(&pitch.scaled_as_written(x, turn.to_f64())));
        if let Some(lead) = lead.as_ref().and_then(|x| x.simple_fraction()) {
            at.key("pitch").warn(format!(
                "the pitch {pitch} of joint \"{}\" is a decimal close to that of a simple lead; write lead = \"{lead}\" instead if that is intended",
                joint.id
            ));
        }
    }
}

/// Number of joints named in a list.
const SHOWN: usize = 8;

/// A guessed direction of an option at a joint: the direction, what it is taken along, and the key that would set it.
type Guess = (&'static str, &'static str, &'static str);

/// Warns of each option with guessed directions once, with the joints that have it.
pub(crate) fn find_guessed(file: &MechanismFile, m: &Mechanism, out: &Findings) {
    let mut found: Vec<(Place<'_>, String, Guess, Vec<&str>)> = Vec::new();
    for ((at, entry), joint) in out.key("joint").each_entry(&file.joint).zip(&m.joints) {
        let (list, at) = match &entry.options {
            Some(list) => (list, at),
            None => (&file.search.options, out.key("search")),
        };
        for (at, item) in at.key("options").each_entry(list) {
            let Some((name, guess)) = of_option(&item.as_table(), entry, joint) else {
                continue;
            };
            let same = found
                .iter_mut()
                .find(|f| f.0.path == at.path && f.2 == guess);
            match same {
                Some(same) => same.3.push(&joint.id),
                None => found.push((at, name, guess, vec![&joint.id])),
            }
        }
    }
    for (at, option, (what, along, key), joints) in found {
        let joints = first_of(&joints, SHOWN);
        at.warn(format!(
            "the {what} of option \"{option}\" is not given and is taken along {along} at {joints}; write a table with `{key}` if another is intended: {{ type = \"{option}\", {key} = [...] }}"
        ));
    }
}

/// Returns the name of an option of a joint and its guessed direction there, or `None` if nothing is guessed.
fn of_option(table: &OptionTable, entry: &JointEntry, joint: &Joint) -> Option<(String, Guess)> {
    let kind = table.kind.as_deref()?;
    let option = JointType::from_name(kind)?;
    let name = table.name.as_deref().unwrap_or(option.name());
    if !joint.options.iter().skip(1).any(|o| o.name == name) {
        return None;
    }
    let present = &joint.joint_type;
    let line = match present {
        JointType::Slotted => "the pin",
        JointType::Spherical => "z",
        JointType::Universal => "the first pin",
        _ => "the joint's own axis",
    };
    use JointType::{CylinderOnPlane, Planar, SphereOnPlane};
    let has_plane = matches!(present, Planar | CylinderOnPlane | SphereOnPlane);
    let ball = *present == JointType::Spherical && entry.axis.is_none();
    let guess = match option {
        CylinderOnPlane | SphereOnPlane if table.axis.is_none() && !has_plane => {
            ("normal of the plane", line, "axis")
        }
        JointType::SphereInCylinder if table.axis.is_none() && ball => ("tube", line, "axis"),
        JointType::Slotted | JointType::CylinderOnPlane
            if table.reference.is_none() && entry.reference.is_none() =>
        {
            let what = if option == JointType::Slotted {
                "slot"
            } else {
                "axis of the roller"
            };
            let line = if table.axis.is_some() {
                "the reference of the joint"
            } else {
                "the first of the axes x, y, z that is not along the axis"
            };
            (what, line, "reference")
        }
        _ => return None,
    };
    Some((name.to_owned(), guess))
}

/// Joints nearer to special than this, in radians and sizes of the mechanism, were probably meant to be special.
const NEARLY: f64 = 1e-4;
/// Maximum number of pairs of joints reported.
const TOLD: usize = 5;

/// Returns the doubtful values.
pub(super) fn find_rounding(m: &Mechanism) -> Vec<ProblemKind> {
    let mut out = Vec::new();
    if let Some(rounded) = looks_rounded(m).filter(|r| r.digits.is_some() && !r.pi) {
        let message = format!(
            "coordinates look measured or rounded: {rounded}; if the exact values are known, write them in quotes, such as \"sqrt(3)/2\" or \"cos(36deg)\"; otherwise give their uncertainty in a [tolerance] table"
        );
        out.push(message.into());
    }
    for state in m.state_ids() {
        // `ozols analyze` reports why there is no verdict.
        let Ok(found) = rank_verdict(m, state) else {
            continue;
        };
        // Only figures that differ between the intended and the written geometry are doubtful.
        if !found.agrees_as_written() {
            out.push(of_verdict(&found));
        }
    }
    out.extend(by_default(m));
    let all = nearly_special_relations(m);
    if !all.is_empty() {
        let what = first_of(&all, TOLD);
        let message = format!(
            "nearly special: {what}; make them exact if this is intended, or give their uncertainty in a [tolerance] table"
        );
        out.push(message.into());
    }
    out
}

/// Returns a warning about second axes that use the default while other axes are rounded. They depend on the file's x, y and z,
/// so the same mechanism rotated in space has others.
fn by_default(m: &Mechanism) -> Option<ProblemKind> {
    let half = uncertainties(m)?;
    let left = |(j, joint): &(JointId, &Joint)| {
        let given = |e: &Expr| e.is_written_whole() || e.half_unit().is_some();
        let mut reference = joint.frame.reference.iter();
        let types = std::iter::once(&joint.joint_type)
            .chain(joint.offered_options().map(|o| &o.joint_type));
        half.frames[j.index()].axis != [0.0; 3]
            && types.into_iter().any(JointType::has_second_axis)
            && reference.all(|e| !given(e) && e.as_rational().is_some())
    };
    let all: Vec<(JointId, &Joint)> = m.joints_with_ids().filter(left).collect();
    let (_, first) = all.first()?;
    let axis = unit(to_vector(&first.frame.axis));
    let here = to_vector(&first.frame.point);
    let others = m.joints.iter();
    let others = others.map(|other| across(sub(to_vector(&other.frame.point), here), axis));
    let towards = others.max_by(|a, b| length(*a).total_cmp(&length(*b)))?;
    let [x, y, z] = Some(unit(towards)).filter(|_| length(towards) > 0.0)?;
    let ids: Vec<&str> = all.iter().map(|(_, j)| j.id.as_str()).collect();
    let message = format!(
        "the second axes of {} use the default, which depends on the file's x, y and z; the same mechanism rotated in space has other axes; write them out, such as reference = [{x:.6}, {y:.6}, {z:.6}] at {}",
        first_of(&ids, TOLD),
        first.id
    );
    Some(message.into())
}

fn of_verdict(found: &RankVerdict) -> ProblemKind {
    let figures = |rank: usize| {
        let (w, sigma) = found.figures_at(rank);
        format!("W = {w}, σ = {sigma}")
    };
    let state = &found.state;
    if !found.is_decided() {
        return format!("state {state}: {}", found.explain_undecided()).into();
    }
    let understood = match &found.meant {
        Meant::Snapped { understood, .. } => format!(". Understood: {understood}"),
        _ => String::new(),
    };
    let (meant, written) = (figures(found.rank()), figures(found.as_written));
    format!(
        "state {state}: the idealised geometry gives {meant}, and the rounded digits as written give {written}; write roots or expressions such as \"sqrt(3)/2\", or more digits{understood}"
    )
    .into()
}

/// Lists pairs of joints that are nearly parallel, perpendicular, coaxial or concurrent, and their distances from it.
fn nearly_special_relations(m: &Mechanism) -> Vec<String> {
    let least = Reach::relative(NEARLY, mechanism_size(m));
    let within = rounding_reach(m).map_or(least, |r| Reach {
        length: r.length.max(least.length),
        angle: r.angle.max(least.angle),
    });
    let all = nearly_special(m, within);
    all.iter()
        .filter_map(|x| describe_near_joint(m, x))
        .collect()
}

/// Describes a pair of joints, such as "LF and LR are 0.002 degrees from coaxial".
fn describe_near_joint(m: &Mechanism, x: &NearJoint) -> Option<String> {
    let strongest = x.relations.iter().max_by_key(|(r, of)| (*r, of.is_some()));
    let (relation, other) = strongest?;
    let (id, far) = (&m.joints[x.joint].id, x.describe_deviation(m));
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
