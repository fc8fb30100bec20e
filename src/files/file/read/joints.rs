//! The joints: ends, type, place, the states they act in.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::resolve::{frame, joint_type, motion_name, option};
use crate::file::read::search::options;
use crate::file::read::value::LIMITS;
use crate::file::read::value::names::{check_id, link_by_id};
use crate::file::read::value::number::{direction, pitch, vector};
use crate::file::schema::{DriveWord, JointEntry, MechanismFile, Unloading, Words};
use crate::geom::expr::Expr;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Frame, Joint, JointOption, Link, LinkId, StateId};
use itertools::Itertools;

/// Most states of a mechanism.
const MOST_STATES: usize = 100;

/// The names of the states, `free` first.
pub(crate) fn states(file: &MechanismFile, out: &mut Findings) -> Vec<String> {
    let named = file.joint.iter().flat_map(|j| words(j.state.as_ref()));
    let mut states: Vec<String> = ["free".to_owned()]
        .into_iter()
        .chain(named)
        .unique()
        .collect();
    if states.len() > MOST_STATES {
        out.add(
            &[DocumentStep::Key("joint".to_owned())],
            ProblemKind::TooMany {
                what: "states",
                count: states.len(),
                limit: MOST_STATES,
            },
        );
        states.truncate(MOST_STATES);
    }
    states
}

pub(crate) fn joints(
    file: &MechanismFile,
    links: &[Link],
    states: &[String],
    out: &mut Findings,
) -> Vec<Joint> {
    (0..file.joint.len())
        .filter_map(|i| joint(file, i, links, states, out))
        .collect()
}

fn words(w: Option<&Words>) -> Vec<String> {
    match w {
        None => Vec::new(),
        Some(Words::One(s)) => vec![s.clone()],
        Some(Words::Many(v)) => v.clone(),
    }
}

fn joint(
    file: &MechanismFile,
    i: usize,
    links: &[Link],
    states: &[String],
    out: &mut Findings,
) -> Option<Joint> {
    let entry = &file.joint[i];
    let at = [
        DocumentStep::Key("joint".to_owned()),
        DocumentStep::Index(i),
    ];
    check_id(
        "joint",
        &entry.id,
        file.joint[..i].iter().any(|j| j.id == entry.id),
        &key(&at, "id"),
        out,
    );
    let ends = ends(entry, links, &key(&at, "links"), out);
    let found = joint_type(&entry.id, &entry.kind, entry.freedoms.as_ref(), &at, out);
    let Some(joint_type) = found else {
        // The rest depends on the type, but a bad point is worth telling in the same run.
        vector(&entry.point, &key(&at, "point"), out);
        return None;
    };
    let frame = place(entry, &joint_type, &at, out);
    let present = JointOption {
        name: motion_name(&joint_type),
        joint_type: joint_type.clone(),
        frame: frame.clone(),
        cost_milli: None,
        state: None,
    };
    let states_of = entry.state.as_ref().map(|w| {
        words(Some(w))
            .iter()
            .filter_map(|w| states.iter().position(|s| s == w).map(StateId::new))
            .collect::<Vec<_>>()
    });
    let in_free = states_of
        .as_ref()
        .is_none_or(|s| s.contains(&StateId::FREE));
    let (drive, drive_freedom) = driven(&entry.drive, &joint_type, &at, out);
    let changeable = in_free && !drive && joint_type != JointType::Fixed;
    let options = options(file, entry, &present, changeable, states, &at, out);
    let unloading = unloading(file, entry, &frame, states, &at, out);
    Some(Joint {
        id: entry.id.clone(),
        links: ends,
        joint_type,
        frame,
        drive,
        drive_freedom,
        states: states_of,
        options,
        unloading,
    })
}

/// The links that a joint joins; the first of the file in place of one that is not known.
fn ends(
    entry: &JointEntry,
    links: &[Link],
    at: &[DocumentStep],
    out: &mut Findings,
) -> [LinkId; 2] {
    let mut ends = [LinkId::new(0); 2];
    for (e, id) in entry.links.iter().enumerate() {
        ends[e] = link_by_id(links, id, &index(at, e), out).unwrap_or(ends[e]);
    }
    if entry.links[0] == entry.links[1] {
        let (joint, link) = (entry.id.clone(), entry.links[0].clone());
        out.add(at, ProblemKind::SelfLoop { joint, link });
    }
    ends
}

/// Whether a joint is driven, and in which freedom where the file names one.
fn driven(
    word: &DriveWord,
    joint_type: &JointType,
    at: &[DocumentStep],
    out: &mut Findings,
) -> (bool, Option<Freedom>) {
    let word = match word {
        DriveWord::Driven(drive) => return (*drive, None),
        DriveWord::Freedom(word) => word,
    };
    let own = joint_type.freedoms();
    let named = Freedom::from_name(word).filter(|f| own.contains(f));
    if named.is_none() {
        let known = own.iter().map(|f| f.name()).join(", ");
        out.add(
            &key(at, "drive"),
            ProblemKind::UnknownWord {
                what: "freedom to drive",
                word: word.clone(),
                known,
            },
        );
    }
    (true, named)
}

/// What may be inserted in series with a joint.
fn unloading(
    file: &MechanismFile,
    entry: &JointEntry,
    frame: &Frame,
    states: &[String],
    at: &[DocumentStep],
    out: &mut Findings,
) -> Vec<JointOption> {
    let (list, from) = match &entry.unloading {
        None | Some(Unloading::Allowed(false)) => return Vec::new(),
        Some(Unloading::Allowed(true)) => {
            let from = key(&[DocumentStep::Key("search".to_owned())], "unloading");
            (&file.search.unloading, from)
        }
        Some(Unloading::List(list)) => (list, key(at, "unloading")),
    };
    let list = out.at_most(LIMITS.2, list, "unloading joints in one place", &from);
    list.iter()
        .enumerate()
        .filter_map(|(n, e)| option(&entry.id, frame, e, states, &index(&from, n), out))
        .collect()
}

fn place(
    entry: &JointEntry,
    joint_type: &JointType,
    at: &[DocumentStep],
    out: &mut Findings,
) -> Frame {
    let point = vector(&entry.point, &key(at, "point"), out);
    let axis = match (&entry.axis, joint_type) {
        (Some(v), _) => direction(v, &key(at, "axis"), out),
        (None, JointType::Spherical | JointType::Fixed) => [0, 0, 1].map(Expr::from),
        (None, _) => {
            let what = "an axis, such as axis = [0, 0, 1]";
            out.add(
                at,
                ProblemKind::Missing {
                    joint: entry.id.clone(),
                    kind: entry.kind.clone(),
                    what,
                },
            );
            [0, 0, 1].map(Expr::from)
        }
    };
    let reference = entry
        .reference
        .as_ref()
        .map(|v| direction(v, &key(at, "reference"), out));
    let screws = joint_type.freedoms().contains(&Freedom::Screw);
    let stated = [
        ("pitch", entry.pitch.is_some()),
        ("lead", entry.lead.is_some()),
    ];
    match (stated.into_iter().find(|s| s.1), screws) {
        (None, true) => {
            let what =
                "a lead, the translation per turn, such as lead = 5 (or a pitch, per radian)";
            out.add(
                at,
                ProblemKind::Missing {
                    joint: entry.id.clone(),
                    kind: entry.kind.clone(),
                    what,
                },
            );
        }
        (Some((what, _)), false) => {
            let (joint, kind) = (entry.id.clone(), entry.kind.clone());
            out.add(
                &key(at, what),
                ProblemKind::Superfluous { joint, kind, what },
            );
        }
        _ => {}
    }
    let pitch = pitch([entry.pitch.as_ref(), entry.lead.as_ref()], at, out);
    let pitch = pitch.unwrap_or_else(|| Expr::from(0));
    frame(&entry.id, point, axis, reference, pitch, at, out)
}
