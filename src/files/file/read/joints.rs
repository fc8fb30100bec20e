//! The joints: ends, type, place, the states they act in.

use crate::closure::contour::closed_walk;
use crate::closure::tree::spanning_forest;
use crate::file::prelude::*;
use crate::file::read::resolve::{
    check_frame, joint_type, missing_message, motion_name, read_option, takes_no,
};
use crate::file::read::search::read_options;
use crate::file::read::value::LIMITS;
use crate::file::read::workload::loads::read_mass;

/// Maximum number of states of a mechanism.
const MOST_STATES: usize = 100;

/// Returns the names of the states, `free` first.
pub(crate) fn read_states(file: &MechanismFile, out: &Findings) -> Vec<String> {
    let named = file.joint.iter().filter_map(|j| j.state.as_ref());
    let named = named.flat_map(|w| w.word_list()).cloned();
    let states = std::iter::once("free".to_owned()).chain(named).unique();
    let mut states = states.collect_vec();
    out.key("joint")
        .count_within(MOST_STATES, states.len(), "states");
    states.truncate(MOST_STATES);
    states
}

pub(crate) fn read_joints(file: &MechanismFile, links: &[Link], out: &Findings) -> Vec<Joint> {
    let all = out.key("joint").each_entry(&file.joint).enumerate();
    let all = all.filter_map(|(i, (at, entry))| {
        let twice = file.joint[..i].iter().any(|j| j.id == entry.id);
        at.check_id("joint", &entry.id, twice);
        read_joint(file, entry, links, &at)
    });
    all.collect()
}

fn read_joint(
    file: &MechanismFile,
    entry: &JointEntry,
    links: &[Link],
    at: &Place<'_>,
) -> Option<Joint> {
    let ends = read_ends(entry, links, &at.key("links"));
    let Some(joint_type) = joint_type(&entry.id, &entry.kind, entry.freedoms.as_ref(), at) else {
        // The rest depends on the type, but a wrong point is worth reporting in the same run.
        at.key("point").read_vector(&entry.point);
        return None;
    };
    let frame = read_place(entry, &joint_type, at);
    let present = JointOption {
        name: motion_name(&joint_type),
        joint_type: joint_type.clone(),
        frame: frame.clone(),
        cost_milli: None,
        state: None,
    };
    let of = at.key("state").find_states(entry.state.as_ref());
    let in_free = of.as_ref().is_none_or(|s| s.contains(&StateId::FREE));
    let (drive, drive_freedom) = read_drive(&entry.drive, &joint_type, at);
    let changeable = in_free && !drive && joint_type != JointType::Fixed;
    let options = read_options(file, entry, &present, changeable, at);
    let unloading = read_unloading(file, entry, &frame, at);
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
fn read_ends(entry: &JointEntry, links: &[Link], at: &Place<'_>) -> [LinkId; 2] {
    let end = |e: usize| {
        at.entry_at(e)
            .read_link(links, &entry.links[e])
            .unwrap_or(LinkId::new(0))
    };
    let ends = [end(0), end(1)];
    if entry.links[0] == entry.links[1] {
        at.add_problem(format!(
            "joint \"{}\" connects link \"{}\" to itself; name two different links",
            entry.id, entry.links[0]
        ));
    }
    ends
}

/// Returns whether a joint is driven, and in which freedom if the file names one.
fn read_drive(word: &DriveWord, joint_type: &JointType, at: &Place<'_>) -> (bool, Option<Freedom>) {
    let word = match word {
        DriveWord::Driven(drive) => return (*drive, None),
        DriveWord::Freedom(word) => word,
    };
    let own = joint_type.freedoms();
    let named = Freedom::from_name(word).filter(|f| own.contains(f));
    if named.is_none() {
        let known = own.iter().map(|f| f.name());
        at.key("drive")
            .add_unknown_word("freedom to drive", word, known);
    }
    (true, named)
}

/// Returns the joints that may be inserted in series with a joint.
fn read_unloading(
    file: &MechanismFile,
    entry: &JointEntry,
    frame: &Frame,
    at: &Place<'_>,
) -> Vec<JointOption> {
    let (list, from) = match &entry.unloading {
        None | Some(Unloading::Allowed(false)) => return Vec::new(),
        Some(Unloading::Allowed(true)) => (&file.search.unloading, at.out.key("search")),
        Some(Unloading::List(list)) => (list, at.clone()),
    };
    let from = from.key("unloading");
    let list = from.first_entries(LIMITS.2, list, "unloading joints in one place");
    list.filter_map(|(at, e)| read_option(&entry.id, frame, e, &at))
        .collect()
}

fn read_place(entry: &JointEntry, joint_type: &JointType, at: &Place<'_>) -> Frame {
    let (joint, kind) = (&entry.id, &entry.kind);
    let missing = |what| at.add_problem(missing_message(joint, kind, what));
    let point = at.key("point").read_vector(&entry.point);
    let axis = at.read_given("axis", entry.axis.as_ref(), Place::read_direction);
    if axis.is_none() && !matches!(joint_type, JointType::Spherical | JointType::Fixed) {
        missing("an axis, such as axis = [0, 0, 1]");
    }
    let axis = axis.unwrap_or_else(|| [0, 0, 1].map(Expr::from));
    let reference = at.read_given("reference", entry.reference.as_ref(), Place::read_direction);
    let screws = joint_type.freedoms().contains(&Freedom::Screw);
    let stated = [("pitch", &entry.pitch), ("lead", &entry.lead)];
    match (stated.into_iter().find(|s| s.1.is_some()), screws) {
        (None, true) => {
            missing("a lead, the translation per turn, such as lead = 5 (or a pitch, per radian)")
        }
        (Some((what, _)), false) => {
            at.key(what).add_problem(takes_no(joint, kind, what));
        }
        _ => {}
    }
    let pitch = at
        .read_pitch(&entry.pitch, &entry.lead)
        .unwrap_or_else(|| Expr::from(0));
    check_frame(joint, point, axis, reference, pitch, at)
}

pub(crate) fn read_links(file: &MechanismFile, out: &Findings) -> Vec<Link> {
    let mut links: Vec<Link> = Vec::new();
    for (at, entry) in out.key("link").each_entry(&file.link) {
        at.check_id("link", &entry.id, links.iter().any(|l| l.id == entry.id));
        let role = match entry.role.as_deref() {
            None => Role::Inner,
            Some("frame" | "ground") => Role::Frame,
            Some("output") => Role::Output,
            Some("object" | "part") => Role::Object,
            Some(word) => {
                at.key("role")
                    .add_unknown_word("role", word, ["frame", "output", "object"]);
                Role::Inner
            }
        };
        if let (Role::Frame, Some(first)) = (role, links.iter().find(|l| l.role == Role::Frame)) {
            at.key("role").add_problem(format!(
                "link \"{}\" is a second frame after \"{}\"; keep only one role = \"frame\"",
                entry.id, first.id
            ));
        }
        let (id, mass) = (entry.id.clone(), read_mass(entry, &at));
        links.push(Link { id, role, mass });
    }
    let has = |role| links.iter().any(|l| l.role == role);
    if !has(Role::Frame) {
        out.key("link").add_problem(
            "no link has the role \"frame\"; mark the fixed link with role = \"frame\"",
        );
    }
    if !has(Role::Output) {
        mark_outputs(file, &mut links);
    }
    links
}

/// Makes all links that move in the free state outputs if no link is marked as one. Then no motion is idle, and a search keeps
/// all motions.
fn mark_outputs(file: &MechanismFile, links: &mut [Link]) {
    let is_free = |w: &Words| w.word_list().iter().any(|s| s == "free");
    let free = file.joint.iter();
    let free = free.filter(|j| j.state.as_ref().is_none_or(is_free));
    let there: BTreeSet<&String> = free.flat_map(|j| &j.links).collect();
    for link in links {
        if link.role == Role::Inner && there.contains(&link.id) {
            link.role = Role::Output;
        }
    }
}

/// Checks that every link is connected to the frame in each state in which it has joints.
pub(crate) fn check_connected(mechanism: &Parts, out: &Findings) {
    let at = |l: usize| out.key("link").entry_at(l).key("id");
    for (l, link) in mechanism.links_with_ids() {
        if !mechanism.joints.iter().any(|j| j.links.contains(&l)) {
            let link = link.id.clone();
            at(l.index()).add_problem(ProblemKind::Unused { link });
        }
    }
    for (s, state) in mechanism.states_with_ids() {
        let joints: Vec<JointId> = mechanism.joints_in(s).collect();
        let ends = joints
            .iter()
            .map(|&j| mechanism.joints[j].links.map(LinkId::index));
        let (count, frame) = (mechanism.links.len(), mechanism.frame_link());
        let (_, steps) = spanning_forest(count, ends, |_| false, [frame.index()]);
        let reached: BTreeSet<usize> = steps.iter().map(|s| s.link).collect();
        let all = mechanism.links_with_ids();
        for (l, link) in all.filter(|(l, _)| *l != frame && !reached.contains(&l.index())) {
            let here = joints
                .iter()
                .any(|&j| mechanism.joints[j].links.contains(&l));
            if here || (s == StateId::FREE && link.role == Role::Output) {
                let (link, state) = (link.id.clone(), state.clone());
                at(l.index()).add_problem(ProblemKind::Disconnected { link, state });
            }
        }
    }
}

pub(crate) fn read_contours(file: &MechanismFile, m: &Parts, out: &Findings) -> Vec<Vec<JointId>> {
    let contour = |joints: &[String], at: Place<'_>| {
        let named = at
            .each_entry(joints)
            .filter_map(|(at, id)| at.find_joint(m, id));
        let named: Vec<JointId> = named.collect();
        if named.len() == joints.len() && closed_walk(m, &named).is_none() {
            at.add_problem("the joints of this contour do not form one closed loop; list them in order around the loop");
        }
        named
    };
    let all = out.key("contour").each_entry(&file.contour);
    all.map(|(at, entry)| contour(&entry.joints, at.key("joints")))
        .collect()
}
