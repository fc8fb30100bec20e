//! The changes that a search may make: the options of each joint, and their costs.

use crate::closure::isometry::Isometry;
use crate::file::prelude::*;
use crate::file::problem::ImportError;
use crate::file::read::resolve::{contains_option, read_option};
use crate::file::read::value::{LIMITS, used_twice};
use crate::model::mechanism::{CostSpec, Drives, SearchSpec};
use crate::model::ranking::{ClearanceSum, Limit, Ranking, Term, TypeOverride};

/// Returns the options of a joint, the original one first. Options of the joint's own list must contain the original motion;
/// those of the common list that do not are skipped.
pub(crate) fn read_options(
    file: &MechanismFile,
    entry: &JointEntry,
    present: &JointOption,
    changeable: bool,
    at: &Place<'_>,
) -> Vec<JointOption> {
    let (list, from) = match &entry.options {
        Some(list) => (&list[..], at.clone()),
        None if changeable => (&file.search.options[..], at.out.key("search")),
        None => (&[][..], at.clone()),
    };
    let (mut options, mut listed) = (vec![present.clone()], false);
    for (at, item) in from.key("options").first_entries(LIMITS.2, list, "options") {
        let Some(option) = read_allowed_option(entry, item, &present.frame, &at) else {
            continue;
        };
        let contained = contains_option(&option, present);
        if option.joint_type == present.joint_type && contained == Some(true) {
            // The original joint is listed: keep its name and cost.
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
                at.add_problem(format!(
                    "joint \"{joint}\" has two options named \"{}\"; rename one of them",
                    option.name
                ));
            }
            Some(true) => options.push(option),
            Some(false) if entry.options.is_some() => {
                let (option, present) = (option.name, present.name.clone());
                at.add_problem(ProblemKind::LosesMotion {
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
fn read_allowed_option(
    entry: &JointEntry,
    item: &OptionEntry,
    present: &Frame,
    at: &Place<'_>,
) -> Option<JointOption> {
    // A bad entry of the common list would be reported once per joint.
    let before = at.out.problem_count();
    let option = read_option(&entry.id, present, item, at)?;
    let is_it = |f: &String| *f == option.name || JointType::word_of_trade(f) == option.name;
    let allowed = !entry.forbid.iter().any(is_it);
    (at.out.problem_count() == before && allowed).then_some(option)
}

/// Joints that differ by more than this are not mirror images, regardless of the rounding of their coordinates. As an angle in radians, and
/// as a fraction of the mechanism's size.
const NO_IMAGE: f64 = 1e-3;

/// Reports pairs that are not mirror images.
fn check_images(mechanism: &Parts, pairs: &[(JointId, JointId)], at: &Place<'_>) {
    let planes = Isometry::find_mirrors(mechanism, pairs);
    let Some((_, misses)) = planes.first() else {
        return;
    };
    let size = mechanism.distance_across();
    for ((at, &(a, b)), miss) in at.each_entry(pairs).zip(misses) {
        if miss.angle > NO_IMAGE || miss.distance > NO_IMAGE * size {
            let [first, second] = [a, b].map(|j| &mechanism.joints[j].id);
            let off = miss.describe_miss(mechanism.length_unit.symbol);
            at.add_problem(format!(
                "joints \"{first}\" and \"{second}\" are not mirror images: in the plane that fits most pairs the image of \"{first}\" is {off} from \"{second}\"; correct their points and axes, or remove the pair"
            ));
        }
    }
}

pub(crate) fn read_search(file: &MechanismFile, mechanism: &Parts, out: &Findings) -> SearchSpec {
    let at = out.key("search");
    let mut spec = SearchSpec {
        max_redundant: file.search.max_redundant.unwrap_or(0),
        max_mobility: file.search.max_mobility,
        symmetric: file.search.symmetric,
        drive_rule: at.read_word(
            "drives",
            &file.search.drives,
            &Drives::ALL.map(|d| (d.word(), d)),
        ),
        pose_only: file.search.pose_only,
        ..SearchSpec::default()
    };
    let hold = at.key("hold");
    let held = hold.each_entry(&file.search.hold);
    spec.hold
        .extend(held.filter_map(|(at, id)| at.read_link(&mechanism.links, id)));
    let mut grouped = Vec::new();
    let mut joints = |ids: &[String], under, at: &Place<'_>| {
        let named = ids.iter().filter_map(|id| at.find_joint(mechanism, id));
        let mut named = named.collect_vec();
        // Each joint is checked once, because thousands of wrong pairs took minutes.
        named.retain(|&j| {
            let first = !grouped.contains(&j);
            if first {
                grouped.push(j);
            } else {
                let joint = &mechanism.joints[j].id;
                at.add_problem(format!(
                    "joint \"{joint}\" has more than one image under {under}; name each joint once"
                ));
            }
            first
        });
        named
    };
    for (at, pair) in at.key("mirror").each_entry(&file.search.mirror) {
        if let [a, b] = joints(pair, "mirror", &at)[..] {
            spec.mirror.push((a, b));
        }
    }
    for (at, group) in at.key("turn").each_entry(&file.search.turn) {
        let found = joints(group, "turn", &at);
        let first = file.search.turn[0].len();
        if ![2, 3].contains(&group.len()) || group.len() != first {
            at.add_problem(format!(
                "a group of {} joints under turn: write pairs for half a turn, or groups of three for a third, all of one kind",
                group.len()
            ));
        } else if !file.search.mirror.is_empty() {
            at.add_problem("mirror and turn exclude each other; keep one of them");
        } else if found.len() == first {
            spec.turn.push(found);
        }
    }
    check_images(mechanism, &spec.mirror, &at.key("mirror"));
    spec.costs = read_costs(&file.search.costs, mechanism, &at.key("costs"));
    spec
}

/// Maximum number of terms, and of limits.
const MOST: usize = 100;

fn read_term(word: &str, at: &Place<'_>) -> Option<Term> {
    let found = Term::from_name(word);
    if found.is_none() {
        let at = at.key("term");
        at.add_unknown_word("term", word, Term::ALL.map(Term::name));
    }
    found
}

/// Returns the ranking that a file asks for, if any.
pub(crate) fn read_ranking(file: &MechanismFile, m: &Parts, out: &Findings) -> Option<Ranking> {
    let entry = file.ranking.as_ref()?;
    let at = &out.key("ranking");
    let sums = [("worst", ClearanceSum::Worst), ("rms", ClearanceSum::Rms)];
    // Files of earlier versions name it.
    at.read_word("order", &entry.order, &[("weighted", ())]);
    Some(Ranking {
        clearance: at.read_word("clearance", &entry.clearance, &sums),
        terms: read_terms(entry, &at.key("terms")),
        limits: read_limits(entry, &at.key("limits")),
        states: ranked_states(entry, m, &at.key("states")),
    })
}

/// Returns the terms with their weights.
fn read_terms(entry: &RankingEntry, at: &Place<'_>) -> Vec<(Term, f64)> {
    let mut terms: Vec<(Term, f64)> = Vec::new();
    for (at, t) in at.first_entries(MOST, &entry.terms, "terms") {
        let weight = t.weight.unwrap_or(1.0);
        if !(0.0..=1e12).contains(&weight) {
            at.key("weight")
                .add_bad_value("weight", weight, "a number from 0 to 1e12");
        }
        let Some(term) = read_term(&t.term, &at) else {
            continue;
        };
        if terms.iter().any(|(other, _)| *other == term) {
            at.key("term").add_problem(used_twice("[ranking]", &t.term));
        }
        terms.push((term, weight));
    }
    if entry.terms.is_empty() {
        at.add_unknown_word("list of terms", "[]", Term::ALL.map(Term::name));
    }
    terms
}

/// Returns the bounds that variants must meet.
fn read_limits(entry: &RankingEntry, at: &Place<'_>) -> Vec<Limit> {
    let mut limits = Vec::new();
    for (at, l) in at.first_entries(MOST, &entry.limits, "limits") {
        let (min, max) = (l.min, l.max);
        for (k, bound) in [("min", min), ("max", max)] {
            if let Some(x) = bound.filter(|x| !x.is_finite()) {
                at.key(k).add_bad_value("limit", x, "a finite number");
            }
        }
        limits.extend(read_term(&l.term, &at).map(|term| Limit { term, min, max }));
    }
    limits
}

/// Returns the states that count in the ranking: free, and those in which the gripper holds its part.
fn ranked_states(entry: &RankingEntry, m: &Parts, at: &Place<'_>) -> Vec<StateId> {
    let grip = m.loads.grip.as_ref().and_then(|g| g.contacts);
    let of_grip = grip.and_then(|c| m.joints[c[0]].states.as_ref());
    let counts = |s: &StateId| *s == StateId::FREE || of_grip.is_some_and(|all| all.contains(s));
    let mut states = Vec::new();
    for (at, word) in at.first_entries(MOST, &entry.states, "states") {
        let found = m.state_named(word).filter(counts);
        if found.is_none() {
            let what = "state to rank in (free, or one with the contacts of [workload.grip])";
            let known = m.state_ids().filter(counts).map(|s| &m.states[s]);
            at.add_unknown_word(what, word, known);
        }
        states.extend(found);
    }
    states
}

/// Returns the figures of joint types in a file: their capacities, and their costs in thousandths.
pub(crate) fn joint_types(
    file: &MechanismFile,
    mechanism: &Parts,
    out: &Findings,
) -> (Vec<TypeOverride>, Vec<(String, i64)>) {
    let (mut found, mut costs) = (Vec::new(), Vec::new());
    let offered = |name: &str| mechanism.option_named(name).is_some();
    for (name, entry) in &file.joint_types {
        let at = out.key("joint_types").key(name);
        let name = if offered(name) {
            name
        } else {
            JointType::word_of_trade(name)
        };
        if name != "custom" && JointType::from_name(name).is_none() && !offered(name) {
            let known = JointType::NAMED.iter().map(JointType::name);
            at.add_unknown_word("joint type", name, known.chain(["custom"]));
        }
        check_figures(entry, &at);
        let milli = entry.cost.and_then(|c| at.key("cost").read_cost(c));
        costs.extend(milli.map(|milli| (name.to_owned(), milli)));
        let says = [entry.capacity_force, entry.capacity_moment, entry.clearance];
        // An entry with only a cost does not change the capacity of the type.
        if says.iter().any(Option::is_some) {
            let [capacity_force, capacity_moment, clearance] = says;
            found.push(TypeOverride {
                name: name.to_owned(),
                capacity_force,
                capacity_moment,
                clearance,
            });
        }
    }
    (found, costs)
}

/// Checks that the capacities of a type are in range.
fn check_figures(entry: &JointTypeEntry, at: &Place<'_>) {
    let above = (f64::MIN_POSITIVE, "a number above 0, up to 1e12");
    let from_zero = (0.0, "a number from 0 to 1e12");
    for (k, what, value, (least, allowed)) in [
        ("capacity_force", "capacity", entry.capacity_force, above),
        ("capacity_moment", "capacity", entry.capacity_moment, above),
        ("clearance", "clearance", entry.clearance, from_zero),
    ] {
        if let Some(x) = value.filter(|x| !(least..=1e12).contains(x)) {
            at.key(k).add_bad_value(what, x, allowed);
        }
    }
}

/// Reads the costs of a mechanism's redesigns from TOML.
///
/// # Units
/// Costs are in revolute joints, from 0 to 1e6.
///
/// # Errors
/// Returns every problem found, each with its place: invalid TOML, an unknown name, or an invalid cost. Names are joint types, classes of other
/// sets of freedoms, options of the mechanism, `change`, `link` and `harmful`.
///
/// # Examples
/// ```
/// use ozols::file::read::search::costs_from_str;
/// let four_bar = ozols::built_in("four-bar")?;
/// let costs = costs_from_str("costs.toml", "spherical = 1.5\nchange = 2", &four_bar)?;
/// assert_eq!(costs.change_milli, Some(2000)); // In thousandths.
/// assert!(costs_from_str("costs.toml", "bearing = 1", &four_bar).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn costs_from_str(name: &str, text: &str, mechanism: &Parts) -> Result<CostSpec, ImportError> {
    let stated: BTreeMap<String, f64> = toml::from_str(text).map_err(|e| {
        let why = e.message().trim().replace('\n', ", ");
        let message = format!(
            "{why}; each line is a name and a number, such as spherical = 2 (`ozols show costs` prints them all)"
        );
        ProblemKind::from(message).in_file(name, text, e.span())
    })?;
    let out = Findings::default();
    let spec = read_costs(&stated, mechanism, &out.root_place());
    let located = |found| ImportError::with_places(name, text, false, found);
    out.finish(spec).map_err(located)
}

pub(crate) fn read_costs(stated: &BTreeMap<String, f64>, m: &Parts, at: &Place<'_>) -> CostSpec {
    let mut spec = CostSpec::default();
    let offered = m.joints.iter().flat_map(Joint::offered_options);
    let offered: BTreeSet<&str> = offered.map(|o| o.name.as_str()).collect();
    for (name, &value) in stated {
        let at = at.key(name);
        let Some(milli) = at.read_cost(value) else {
            continue;
        };
        let other = spec.other_costs().into_iter().find(|(n, _)| n == name);
        if let Some((_, cost)) = other {
            *cost = Some(milli);
            continue;
        }
        match name.as_str() {
            class if JointType::CLASSES.contains(&class) => {
                spec.by_type_milli.push((class.to_owned(), milli))
            }
            n if JointType::from_name(n).is_some() || offered.contains(n) => {
                let own = offered.contains(n);
                let name = if own { n } else { JointType::word_of_trade(n) };
                spec.by_type_milli.push((name.to_owned(), milli));
            }
            _ => {
                let types = JointType::NAMED.iter().map(JointType::name);
                let others = CostSpec::default().other_costs().map(|(n, _)| n);
                let known = others.into_iter().chain(types).chain(JointType::CLASSES);
                let mut known: Vec<&str> = known.collect();
                known.extend(&offered);
                at.add_unknown_word("cost", name, known.iter().unique());
            }
        }
    }
    spec
}
