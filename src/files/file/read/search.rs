//! What the search may change, what a joint may become, and what it costs.

pub(crate) mod ranking;

use crate::closure::mirror::Plane;
use crate::file::Findings;
use crate::file::costs::costs;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::resolve::{contains, option};
use crate::file::read::value::LIMITS;
use crate::file::read::value::names::{joint_by_id, link_by_id};
use crate::file::schema::{JointEntry, MechanismFile, OptionEntry};
use crate::geom::extent::diagonal;
use crate::geom::vector::real;
use crate::model::mechanism::{Frame, JointId, JointOption, Mechanism, SearchSpec};
use itertools::Itertools;

/// A list of options, and where it stands.
struct OptionList<'a> {
    entries: &'a [OptionEntry],
    at: Vec<DocumentStep>,
    /// Whether it is the joint's own rather than the common one.
    own: bool,
}

impl<'a> OptionList<'a> {
    /// The list that goes for a joint: its own, or the common one where it may change.
    fn of(
        file: &'a MechanismFile,
        entry: &'a JointEntry,
        changeable: bool,
        at: &[DocumentStep],
    ) -> OptionList<'a> {
        match &entry.options {
            Some(list) => OptionList {
                entries: list,
                at: key(at, "options"),
                own: true,
            },
            None if changeable => OptionList {
                entries: &file.search.options,
                at: key(&[DocumentStep::Key("search".to_owned())], "options"),
                own: false,
            },
            None => OptionList {
                entries: &[],
                at: Vec::new(),
                own: false,
            },
        }
    }
}

/// The options of a joint, the present one first. Options of its own list must contain the present motion; those of
/// the common list that do not are passed over.
pub(crate) fn options(
    file: &MechanismFile,
    entry: &JointEntry,
    present: &JointOption,
    changeable: bool,
    states: &[String],
    at: &[DocumentStep],
    out: &mut Findings,
) -> Vec<JointOption> {
    let list = OptionList::of(file, entry, changeable, at);
    let (mut options, mut listed) = (vec![present.clone()], false);
    let entries = out.at_most(LIMITS.2, list.entries, "options", &list.at);
    for (n, item) in entries.iter().enumerate() {
        let path = index(&list.at, n);
        let Some(option) = allowed(entry, item, &present.frame, states, &path, out) else {
            continue;
        };
        let same =
            option.joint_type == present.joint_type && contains(&option, present) == Some(true);
        if same {
            // The present joint, listed: keep its name and cost.
            if !listed {
                options[0].name = option.name;
                options[0].cost_milli = option.cost_milli.or(options[0].cost_milli);
            }
            listed = true;
            continue;
        }
        let joint = entry.id.clone();
        match contains(&option, present) {
            Some(true) if options.iter().any(|o| o.name == option.name) => {
                let option = option.name;
                out.add(&path, ProblemKind::RepeatedOption { joint, option });
            }
            Some(true) => options.push(option),
            Some(false) if list.own => {
                let (option, present) = (option.name, present.name.clone());
                let kind = ProblemKind::LosesMotion {
                    joint,
                    option,
                    present,
                };
                out.add(&path, kind);
            }
            _ => {}
        }
    }
    options
}

/// What an entry of a list stands for; none where it is bad or the joint forbids it.
fn allowed(
    entry: &JointEntry,
    item: &OptionEntry,
    present: &Frame,
    states: &[String],
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<JointOption> {
    // A bad entry of the common list would be reported once per joint.
    let before = out.count();
    let option = option(&entry.id, present, item, states, path, out)?;
    (out.count() == before && !entry.forbid.contains(&option.name)).then_some(option)
}

/// Off by more than this, as an angle and as a fraction of the mechanism's size, joints are no mirror images, however their
/// coordinates were rounded.
const NO_IMAGE: f64 = 1e-3;

/// Tells pairs that are no mirror images.
fn images(
    mechanism: &Mechanism,
    pairs: &[(JointId, JointId)],
    at: &[DocumentStep],
    out: &mut Findings,
) {
    let planes = Plane::of_pairs(mechanism, pairs);
    let Some((_, misses)) = planes.first() else {
        return;
    };
    let points = mechanism.joints.iter().map(|j| real(&j.frame.point));
    let size = diagonal(points.collect_vec().iter().copied());
    for (i, (&(a, b), miss)) in pairs.iter().zip(misses).enumerate() {
        if miss.angle > NO_IMAGE || miss.distance > NO_IMAGE * size {
            let [first, second] = [a, b].map(|j| mechanism.joints[j].id.clone());
            out.add(
                &index(&key(at, "mirror"), i),
                ProblemKind::NoMirrorImage {
                    first,
                    second,
                    off: miss.words(mechanism.length_unit.symbol),
                },
            );
        }
    }
}

pub(crate) fn search(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> SearchSpec {
    let at = [DocumentStep::Key("search".to_owned())];
    let mut spec = SearchSpec::default();
    for (i, id) in file.search.hold.iter().enumerate() {
        let path = index(&key(&at, "hold"), i);
        spec.hold
            .extend(link_by_id(&mechanism.links, id, &path, out));
    }
    let mut grouped = Vec::new();
    let mut joints = |ids: &[String], under, path: &[DocumentStep], out: &mut Findings| {
        let named = ids.iter();
        let named = named.filter_map(|id| joint_by_id(mechanism, id, path, out));
        let mut named = named.collect_vec();
        // Whether images are so is asked of each joint once: thousands of mistaken pairs took minutes.
        named.retain(|&j| {
            let first = !grouped.contains(&j);
            if first {
                grouped.push(j);
            } else {
                let joint = mechanism.joints[j].id.clone();
                out.add(path, ProblemKind::RepeatedImage { joint, under });
            }
            first
        });
        named
    };
    for (i, pair) in file.search.mirror.iter().enumerate() {
        if let [a, b] = joints(pair, "mirror", &index(&key(&at, "mirror"), i), out)[..] {
            spec.mirror.push((a, b));
        }
    }
    for (i, group) in file.search.turn.iter().enumerate() {
        let path = index(&key(&at, "turn"), i);
        let found = joints(group, "turn", &path, out);
        let first = file.search.turn[0].len();
        if ![2, 3].contains(&group.len()) || group.len() != first {
            out.add(&path, ProblemKind::TurnGroup { count: group.len() });
        } else if !file.search.mirror.is_empty() {
            out.add(&path, ProblemKind::TurnAndMirror);
        } else if found.len() == first {
            spec.turn.push(found);
        }
    }
    images(mechanism, &spec.mirror, &at, out);
    spec.costs = costs(&file.search.costs, mechanism, &key(&at, "costs"), out);
    spec
}
