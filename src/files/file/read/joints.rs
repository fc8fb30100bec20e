//! The joints: ends, type, place, the states they act in.

use crate::file::read::resolve::{frame, joint_type, lacks, motion_name, option, takes_no};
use crate::file::read::search::options;
use crate::file::read::value::LIMITS;
use crate::file::schema::{DriveWord, JointEntry, MechanismFile, Unloading};
use crate::file::{Findings, Place};
use crate::geom::expr::Expr;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Frame, Joint, JointOption, Link, LinkId, StateId};
use itertools::Itertools;

/// Most states of a mechanism.
const MOST_STATES: usize = 100;

/// Returns the names of the states, `free` first.
pub(crate) fn states(file: &MechanismFile, out: &Findings) -> Vec<String> {
    let named = file.joint.iter().filter_map(|j| j.state.as_ref());
    let named = named.flat_map(|w| w.list()).cloned();
    let mut states = std::iter::once("free".to_owned())
        .chain(named)
        .unique()
        .collect_vec();
    out.key("joint")
        .count_within(MOST_STATES, states.len(), "states");
    states.truncate(MOST_STATES);
    states
}

pub(crate) fn joints(
    file: &MechanismFile,
    links: &[Link],
    states: &[String],
    out: &Findings,
) -> Vec<Joint> {
    let all = out.key("joint").entries(&file.joint).enumerate();
    let all = all.filter_map(|(i, (at, entry))| {
        let twice = file.joint[..i].iter().any(|j| j.id == entry.id);
        at.check_id("joint", &entry.id, twice);
        joint(file, entry, links, states, &at)
    });
    all.collect()
}

fn joint(
    file: &MechanismFile,
    entry: &JointEntry,
    links: &[Link],
    states: &[String],
    at: &Place<'_>,
) -> Option<Joint> {
    let ends = ends(entry, links, &at.key("links"));
    let Some(joint_type) = joint_type(&entry.id, &entry.kind, entry.freedoms.as_ref(), at) else {
        // The rest depends on the type, but a bad point is worth telling in the same run.
        at.key("point").vector(&entry.point);
        return None;
    };
    let frame = place(entry, &joint_type, at);
    let present = JointOption {
        name: motion_name(&joint_type),
        joint_type: joint_type.clone(),
        frame: frame.clone(),
        cost_milli: None,
        state: None,
    };
    let state = |w: &String| states.iter().position(|s| s == w).map(StateId::new);
    let of = entry.state.as_ref();
    let of = of.map(|w| w.list().iter().filter_map(state).collect_vec());
    let in_free = of.as_ref().is_none_or(|s| s.contains(&StateId::FREE));
    let (drive, drive_freedom) = driven(&entry.drive, &joint_type, at);
    let changeable = in_free && !drive && joint_type != JointType::Fixed;
    let options = options(file, entry, &present, changeable, states, at);
    let unloading = unloading(file, entry, &frame, states, at);
    Some(Joint {
        id: entry.id.clone(),
        links: ends,
        joint_type,
        frame,
        drive,
        drive_freedom,
        states: of,
        options,
        unloading,
    })
}

/// Returns the links that a joint joins; an unknown link is replaced by the first of the file.
fn ends(entry: &JointEntry, links: &[Link], at: &Place<'_>) -> [LinkId; 2] {
    let end = |e: usize| {
        at.index(e)
            .link(links, &entry.links[e])
            .unwrap_or(LinkId::new(0))
    };
    let ends = [end(0), end(1)];
    if entry.links[0] == entry.links[1] {
        at.add(format!(
            "joint \"{}\" connects link \"{}\" to itself; name two different links",
            entry.id, entry.links[0]
        ));
    }
    ends
}

/// Returns whether a joint is driven, and in which freedom if the file names one.
fn driven(word: &DriveWord, joint_type: &JointType, at: &Place<'_>) -> (bool, Option<Freedom>) {
    let word = match word {
        DriveWord::Driven(drive) => return (*drive, None),
        DriveWord::Freedom(word) => word,
    };
    let own = joint_type.freedoms();
    let named = Freedom::from_name(word).filter(|f| own.contains(f));
    if named.is_none() {
        let known = own.iter().map(|f| f.name());
        at.key("drive").unknown("freedom to drive", word, known);
    }
    (true, named)
}

/// Returns the joints that may be inserted in series with a joint.
fn unloading(
    file: &MechanismFile,
    entry: &JointEntry,
    frame: &Frame,
    states: &[String],
    at: &Place<'_>,
) -> Vec<JointOption> {
    let (list, from) = match &entry.unloading {
        None | Some(Unloading::Allowed(false)) => return Vec::new(),
        Some(Unloading::Allowed(true)) => (&file.search.unloading, at.out.key("search")),
        Some(Unloading::List(list)) => (list, at.clone()),
    };
    let from = from.key("unloading");
    let list = from.most(LIMITS.2, list, "unloading joints in one place");
    list.filter_map(|(at, e)| option(&entry.id, frame, e, states, &at))
        .collect()
}

fn place(entry: &JointEntry, joint_type: &JointType, at: &Place<'_>) -> Frame {
    let (joint, kind) = (&entry.id, &entry.kind);
    let missing = |what| at.add(lacks(joint, kind, what));
    let point = at.key("point").vector(&entry.point);
    let axis = entry.axis.as_ref().map(|v| at.key("axis").direction(v));
    if axis.is_none() && !matches!(joint_type, JointType::Spherical | JointType::Fixed) {
        missing("an axis, such as axis = [0, 0, 1]");
    }
    let axis = axis.unwrap_or_else(|| [0, 0, 1].map(Expr::from));
    let reference = entry
        .reference
        .as_ref()
        .map(|v| at.key("reference").direction(v));
    let screws = joint_type.freedoms().contains(&Freedom::Screw);
    let stated = [("pitch", &entry.pitch), ("lead", &entry.lead)];
    match (stated.into_iter().find(|s| s.1.is_some()), screws) {
        (None, true) => {
            missing("a lead, the translation per turn, such as lead = 5 (or a pitch, per radian)")
        }
        (Some((what, _)), false) => {
            at.key(what).add(takes_no(joint, kind, what));
        }
        _ => {}
    }
    let pitch = at
        .pitch(&entry.pitch, &entry.lead)
        .unwrap_or_else(|| Expr::from(0));
    frame(joint, point, axis, reference, pitch, at)
}
