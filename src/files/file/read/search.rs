//! The changes that a search may make: the options of each joint, and their costs.

pub(crate) mod ranking;

use crate::closure::mirror::Plane;
use crate::file::costs::costs;
use crate::file::problem::ProblemKind;
use crate::file::read::resolve::{contains, option};
use crate::file::read::value::LIMITS;
use crate::file::schema::{JointEntry, MechanismFile, OptionEntry};
use crate::file::{Findings, Place};
use crate::geom::extent::diagonal;
use crate::geom::vector::real;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Frame, JointId, JointOption, Mechanism, SearchSpec};
use itertools::Itertools;

/// Returns the options of a joint, the original one first. Options of the joint's own list must contain the original motion;
/// those of the common list that do not are skipped.
pub(crate) fn options(
    file: &MechanismFile,
    entry: &JointEntry,
    present: &JointOption,
    changeable: bool,
    states: &[String],
    at: &Place<'_>,
) -> Vec<JointOption> {
    let (list, from) = match &entry.options {
        Some(list) => (&list[..], at.clone()),
        None if changeable => (&file.search.options[..], at.out.key("search")),
        None => (&[][..], at.clone()),
    };
    let (mut options, mut listed) = (vec![present.clone()], false);
    for (at, item) in from.key("options").most(LIMITS.2, list, "options") {
        let Some(option) = allowed(entry, item, &present.frame, states, &at) else {
            continue;
        };
        let contained = contains(&option, present);
        if option.joint_type == present.joint_type && contained == Some(true) {
            // The present joint, listed: keep its name and cost.
            if !listed {
                options[0].name = option.name;
                options[0].cost_milli = option.cost_milli.or(options[0].cost_milli);
            }
            listed = true;
            continue;
        }
        let joint = entry.id.clone();
        match contained {
            Some(true) if options.iter().any(|o| o.name == option.name) => {
                at.add(format!(
                    "joint \"{joint}\" has two options named \"{}\"; rename one of them",
                    option.name
                ));
            }
            Some(true) => options.push(option),
            Some(false) if entry.options.is_some() => {
                let (option, present) = (option.name, present.name.clone());
                at.add(ProblemKind::LosesMotion {
                    joint,
                    option,
                    present,
                });
            }
            _ => {}
        }
    }
    options
}

/// Returns the option of an entry of a list; `None` if it is not valid or the joint forbids it.
fn allowed(
    entry: &JointEntry,
    item: &OptionEntry,
    present: &Frame,
    states: &[String],
    at: &Place<'_>,
) -> Option<JointOption> {
    // A bad entry of the common list would be reported once per joint.
    let before = at.out.count();
    let option = option(&entry.id, present, item, states, at)?;
    (at.out.count() == before
        && !entry
            .forbid
            .iter()
            .any(|f| *f == option.name || JointType::word(f) == option.name))
    .then_some(option)
}

/// Joints that are off by more than this, as an angle and as a fraction of the mechanism's size, are not mirror images,
/// regardless of the rounding of their coordinates.
const NO_IMAGE: f64 = 1e-3;

/// Reports pairs that are not mirror images.
fn images(mechanism: &Mechanism, pairs: &[(JointId, JointId)], at: &Place<'_>) {
    let planes = Plane::of_pairs(mechanism, pairs);
    let Some((_, misses)) = planes.first() else {
        return;
    };
    let points = mechanism.joints.iter().map(|j| real(&j.frame.point));
    let size = diagonal(points);
    for ((at, &(a, b)), miss) in at.entries(pairs).zip(misses) {
        if miss.angle > NO_IMAGE || miss.distance > NO_IMAGE * size {
            let [first, second] = [a, b].map(|j| &mechanism.joints[j].id);
            let off = miss.words(mechanism.length_unit.symbol);
            at.add(format!(
                "joints \"{first}\" and \"{second}\" are not mirror images: in the plane that fits most pairs the image of \"{first}\" is {off} from \"{second}\"; correct their points and axes, or remove the pair"
            ));
        }
    }
}

pub(crate) fn search(file: &MechanismFile, mechanism: &Mechanism, out: &Findings) -> SearchSpec {
    let at = out.key("search");
    let mut spec = SearchSpec {
        max_redundant: file.search.max_redundant.unwrap_or(0),
        max_mobility: file.search.max_mobility,
        symmetric: file.search.symmetric,
        ..SearchSpec::default()
    };
    let hold = at.key("hold");
    let held = hold.entries(&file.search.hold);
    spec.hold
        .extend(held.filter_map(|(at, id)| at.link(&mechanism.links, id)));
    let mut grouped = Vec::new();
    let mut joints = |ids: &[String], under, at: &Place<'_>| {
        let named = ids.iter().filter_map(|id| at.joint(mechanism, id));
        let mut named = named.collect_vec();
        // Whether images are so is asked of each joint once: thousands of mistaken pairs took minutes.
        named.retain(|&j| {
            let first = !grouped.contains(&j);
            if first {
                grouped.push(j);
            } else {
                let joint = &mechanism.joints[j].id;
                at.add(format!(
                    "joint \"{joint}\" has more than one image under {under}; name each joint once"
                ));
            }
            first
        });
        named
    };
    for (at, pair) in at.key("mirror").entries(&file.search.mirror) {
        if let [a, b] = joints(pair, "mirror", &at)[..] {
            spec.mirror.push((a, b));
        }
    }
    for (at, group) in at.key("turn").entries(&file.search.turn) {
        let found = joints(group, "turn", &at);
        let first = file.search.turn[0].len();
        if ![2, 3].contains(&group.len()) || group.len() != first {
            at.add(format!(
                "a group of {} joints under turn: write pairs for half a turn, or groups of three for a third, all of one kind",
                group.len()
            ));
        } else if !file.search.mirror.is_empty() {
            at.add("mirror and turn exclude each other; keep one of them");
        } else if found.len() == first {
            spec.turn.push(found);
        }
    }
    images(mechanism, &spec.mirror, &at.key("mirror"));
    spec.costs = costs(&file.search.costs, mechanism, &at.key("costs"));
    spec
}
