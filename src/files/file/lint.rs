//! Warnings about a file that can be used: likely mistakes, and entries without effect.

use crate::closure::contour::{Contour, contour_basis};
use crate::file::doubted::{find_doubtful, find_guessed, find_rounding};
use crate::file::locate::DocumentPath;
use crate::file::problem::ImportError;
use crate::file::problem::{Found, WarningKind, Warnings, first_of};
use crate::file::read::build_mechanism;
use crate::file::read::workload::workload_tables;
use crate::file::schema::{LinkEntry, MechanismFile, OptionEntry, Unloading};
use crate::file::text::{read_file, text_of};
use crate::format::four_digits;
use crate::format::plain::changes_direction;
use crate::geom::expr::Expr;
use crate::geom::extent::box_diagonal;
use crate::geom::vector::{length, sub, to_vector};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, JointId, Mechanism, Role, StateId};
use crate::model::ranking::Term;
use crate::model::rounded::looks_rounded;
use itertools::Itertools;

/// Metres across, without a stated unit, beyond which the unit was probably forgotten.
const FORGOTTEN_UNIT: f64 = 10.0;
/// Metres across that a mechanism is hardly smaller or larger than.
const SIZES: (f64, f64) = (1e-5, 1e2);
/// Places of joints on one link nearer than this fraction of the whole were probably meant to be one.
const SAME_PLACE: f64 = 1e-6;
/// Names shown of a list.
const SHOWN: usize = 8;

/// A file that can be used, and what is doubtful in it.
#[derive(Debug, Clone)]
pub struct Checked {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Which of `grip` and `drive` the workload has.
    pub tables: Vec<&'static str>,
    /// The warnings.
    pub warnings: Warnings,
}

/// Reads a mechanism and returns the warnings of its file; names that end in `.json` are JSON, all others TOML.
///
/// # Complexity
/// That of the contour bases of all states, and O(p²) for p joints.
///
/// # Errors
/// Returns every problem found, each with its place, if the file cannot be used.
///
/// # Examples
/// ```
/// use ozols::file::lint::check_file;
/// let text = ozols::builtin::text("four-bar").unwrap_or_default();
/// assert!(check_file("four-bar.toml", text.as_bytes())?.warnings.warnings.is_empty());
/// let unnamed = text.replace("name = \"four-bar\"", "name = \"\"");
/// let told = check_file("mine.toml", unnamed.as_bytes())?.warnings.render(false);
/// assert!(told.contains("the name is empty"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check_file(name: &str, bytes: &[u8]) -> Result<Checked, ImportError> {
    let text = text_of(name, bytes)?;
    read_file(name, text, |file| {
        let mechanism = build_mechanism(file)?;
        Ok(Checked {
            tables: workload_tables(file),
            warnings: Warnings::new(name, text, find_warnings(file, &mechanism)),
            mechanism,
        })
    })
}

fn find_warnings(file: &MechanismFile, m: &Mechanism) -> Found {
    let mut out = Found::new();
    if m.name.trim().is_empty() {
        let empty = "the name is empty; give one, because every answer begins with it";
        out.push((DocumentPath::root_key("name"), empty.into()));
    }
    check_ids(file, &mut out);
    check_drives(m, &mut out);
    check_lengths(file, m, &mut out);
    check_contours(m, &mut out);
    check_structure(file, m, &mut out);
    check_search(file, m, &mut out);
    out.extend(find_guessed(file, m));
    out.extend(find_doubtful(file, m));
    check_workload(file, m, &mut out);
    out
}

/// Finds ids that do not read as they are written.
fn check_ids(file: &MechanismFile, out: &mut Found) {
    let links = file.link.iter().map(|l| l.id.as_str()).enumerate();
    let joints = file.joint.iter().map(|j| j.id.as_str()).enumerate();
    let all = links
        .map(|(n, id)| ("link", n, id))
        .chain(joints.map(|(n, id)| ("joint", n, id)));
    for (list, n, id) in all.filter(|(_, _, id)| id.contains(changes_direction)) {
        let path = DocumentPath::root_key(list).entry_at(n).key("id");
        let message = format!(
            "the id \"{id}\" has characters that reverse the order of letters; answers spell them out; remove them to show the id as it is read"
        );
        out.push((path, message.into()));
    }
}

/// Finds driven joints with several freedoms for which the file does not name the driven one.
fn check_drives(m: &Mechanism, out: &mut Found) {
    for (at, joint) in m.joints.iter().enumerate() {
        let freedoms = joint.joint_type.freedoms();
        let Some(taken) = joint.driven_freedom() else {
            continue;
        };
        if freedoms.len() > 1 && joint.drive_freedom.is_none() {
            let message = format!(
                "joint \"{}\" has the freedoms {}, and the file does not state which one is driven; write drive = \"{}\" if it is the one that redesigns keep now, or name another",
                joint.id,
                freedoms.iter().map(|f| f.name()).join(", "),
                taken.name()
            );
            let path = DocumentPath::root_key("joint").entry_at(at).key("drive");
            out.push((path, message.into()));
        }
    }
}

fn joint_point(j: &Joint) -> [f64; 3] {
    to_vector(&j.frame.point)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(sub(a, b))
}

/// Returns the diagonal of the box around the joints, in the file's unit.
///
/// # Examples
/// ```
/// use ozols::file::lint::mechanism_size;
/// // The joints are at (0, 0), (0, 30), (80, 90) and (120, 0), in mm.
/// assert_eq!(mechanism_size(&ozols::built_in("four-bar")?), 150.0);
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn mechanism_size(m: &Mechanism) -> f64 {
    box_diagonal(m.joints.iter().map(joint_point))
}

fn check_lengths(file: &MechanismFile, m: &Mechanism, out: &mut Found) {
    let across = mechanism_size(m);
    let metres = across * m.length_unit.metres;
    if file.length_unit.is_none() && metres > FORGOTTEN_UNIT {
        let message = format!(
            "the mechanism is {} m across, because lengths without a unit are in metres; add length_unit = \"mm\" if they are millimetres",
            four_digits(metres)
        );
        out.push((DocumentPath::root_key("name"), message.into()));
    } else if across > 0.0 && !(SIZES.0..=SIZES.1).contains(&metres) {
        let message = format!(
            "the mechanism is {} m across; check that length_unit = \"{}\" is correct",
            four_digits(metres),
            m.length_unit.symbol
        );
        out.push((DocumentPath::root_key("length_unit"), message.into()));
    }
    let before = out.len();
    check_places(m, across, out);
    // A pair reported with its line is not reported again.
    let told = out.len() > before;
    let rounded = find_rounding(m).into_iter();
    let rounded = rounded.filter(|k| !(told && matches!(k, WarningKind::NearlySpecial { .. })));
    out.extend(rounded.map(|kind| (DocumentPath::root_key("joint"), kind)));
}

/// Finds joints of one link that are nearly in one place. If many digits show that coordinates were measured, reports that
/// instead.
fn check_places(m: &Mechanism, across: f64, out: &mut Found) {
    if looks_rounded(m).is_some_and(|r| r.digits.is_some()) {
        return;
    }
    for (a, b) in m.joint_ids().tuple_combinations() {
        let [i, j] = [a, b].map(|j| &m.joints[j]);
        let apart = distance(joint_point(i), joint_point(j));
        let near = apart > 0.0 && apart < SAME_PLACE * across;
        if near && i.links.iter().any(|l| j.links.contains(l)) {
            let unit = m.length_unit.symbol;
            let message = format!(
                "joints \"{}\" and \"{}\" are {} {unit} apart in a mechanism of {} {unit}; give both the same point if they should coincide",
                i.id,
                j.id,
                four_digits(apart),
                four_digits(across)
            );
            let path = DocumentPath::root_key("joint")
                .entry_at(b.index())
                .key("point");
            out.push((path, message.into()));
        }
    }
}

fn check_contours(m: &Mechanism, out: &mut Found) {
    let joints = |c: &Contour| c.joints.iter().map(|&(j, _)| j).sorted().collect_vec();
    let bases: Vec<Vec<Vec<JointId>>> = m
        .state_ids()
        .map(|s| contour_basis(m, s).iter().map(joints).collect())
        .collect();
    let walked: Vec<bool> = m
        .joint_ids()
        .map(|j| {
            let coupled = m.couplings.iter().flat_map(|c| &c.ends);
            bases.iter().flatten().any(|c| c.contains(&j))
                || coupled.into_iter().any(|e| e.joint == j)
        })
        .collect();
    if !walked.contains(&true) {
        out.push((DocumentPath::root_key("joint"), WarningKind::NoContour));
    } else {
        let open: Vec<JointId> = m.joint_ids().filter(|&j| !walked[j]).collect();
        if let Some(&first) = open.first() {
            let names = open.iter().map(|&j| m.joints[j].id.as_str()).collect_vec();
            let joints = first_of(&names, SHOWN);
            let at = DocumentPath::root_key("joint").entry_at(first.index());
            out.push((at, WarningKind::OpenChain { joints }));
        }
    }
    let named = m.contours.iter();
    let named = named.map(|c| c.iter().copied().sorted().collect_vec());
    let named = named.collect_vec();
    for (i, contour) in named.iter().enumerate() {
        if named[..i].contains(contour) || !bases.iter().flatten().contains(contour) {
            let at = DocumentPath::root_key("contour").entry_at(i).key("joints");
            let message = "this contour follows from the others of its state and is ignored; remove it or give another";
            out.push((at, message.into()));
        }
    }
}

fn check_structure(file: &MechanismFile, m: &Mechanism, out: &mut Found) {
    let marked = |l: &LinkEntry| l.role.as_deref() == Some("output");
    if !file.link.iter().any(marked) {
        out.push((DocumentPath::root_key("link"), WarningKind::NoOutput));
    }
    for (l, link) in m.links_with_ids() {
        if link.role != Role::Object {
            continue;
        }
        let at = DocumentPath::root_key("link").entry_at(l.index()).key("id");
        let here = |s: StateId| {
            let of = |&j: &JointId| m.joints[j].links.contains(&l);
            m.joints_in(s).filter(of).count()
        };
        if here(StateId::FREE) > 0 {
            let message = format!(
                "clamped part \"{}\" is present in the free state; give its joints a state, such as state = \"clamped\"",
                link.id
            );
            out.push((at, message.into()));
            continue;
        }
        if let Some(s) = m.state_ids().find(|&s| here(s) == 1) {
            let message = format!(
                "clamped part \"{}\" has a single joint in state {}; add the other contact that clamps it",
                link.id, m.states[s]
            );
            out.push((at, message.into()));
        }
    }
    for (i, j) in m.joints_with_ids() {
        let at = DocumentPath::root_key("joint").entry_at(i.index());
        if j.joint_type == JointType::Fixed && j.states.is_none() {
            let [first, second] = j.links.map(|l| &m.links[l].id);
            let message = format!(
                "joint \"{}\" is fixed in every state; merge the links \"{first}\" and \"{second}\", or give the joint a state",
                j.id
            );
            out.push((at.key("type"), message.into()));
        }
        let twin = m.joints[..i.index()].iter().find(|o| are_identical(o, j));
        if let Some(o) = twin {
            let message = format!(
                "joints \"{}\" and \"{}\" are identical; remove one",
                o.id, j.id
            );
            out.push((at.key("links"), message.into()));
        }
    }
}

/// Returns true if two joints have the same links, type, place and axis, in the same states.
fn are_identical(a: &Joint, b: &Joint) -> bool {
    let same = |x: &[Expr; 3], y: &[Expr; 3]| (0..3).all(|i| x[i].to_f64() == y[i].to_f64());
    a.links.iter().sorted().eq(b.links.iter().sorted())
        && a.joint_type == b.joint_type
        && a.states == b.states
        && same(&a.frame.point, &b.frame.point)
        && same(&a.frame.axis, &b.frame.axis)
        && same(&a.frame.reference, &b.frame.reference)
}

fn option_name(o: &OptionEntry) -> Option<&str> {
    match o {
        OptionEntry::Word(w) => Some(w),
        OptionEntry::Table(t) => t.name.as_deref().or(t.kind.as_deref()),
    }
}

fn check_search(file: &MechanismFile, m: &Mechanism, out: &mut Found) {
    let at = DocumentPath::root_key("search");
    let changeable = m.joints.iter().any(|j| j.options.len() > 1);
    for (i, o) in file.search.options.iter().enumerate() {
        let Some(name) = option_name(o) else { continue };
        let taken = m
            .joints
            .iter()
            .any(|j| j.options.iter().any(|o| o.name == name));
        if changeable && !taken {
            let option = name.to_owned();
            let path = at.key("options").entry_at(i);
            out.push((path, WarningKind::UselessOption { option }));
        }
    }
    let asks =
        |u: &Option<Unloading>| matches!(u, Some(Unloading::Allowed(true) | Unloading::List(_)));
    let wants = file
        .joint
        .iter()
        .position(|j| matches!(j.unloading, Some(Unloading::Allowed(true))));
    if file.search.unloading.is_empty() {
        if let Some(j) = wants {
            let message = format!(
                "joint \"{}\" allows unloading joints, but [search] lists none; add unloading = [\"spherical\"] there",
                file.joint[j].id
            );
            let path = DocumentPath::root_key("joint").entry_at(j).key("unloading");
            out.push((path, message.into()));
        }
    } else if !file.joint.iter().any(|j| asks(&j.unloading)) {
        let message = "no joint allows an unloading joint, so this list has no effect; write unloading = true at a joint";
        out.push((at.key("unloading"), message.into()));
    }
    for (i, j) in file.joint.iter().enumerate() {
        let list = j.options.as_ref().unwrap_or(&file.search.options);
        for (n, word) in j.forbid.iter().enumerate() {
            if !list.iter().any(|o| option_name(o) == Some(word)) {
                let message = format!(
                    "joint \"{}\" forbids \"{word}\", which is not an option of that joint; remove it, or correct the name",
                    j.id
                );
                let path = DocumentPath::root_key("joint")
                    .entry_at(i)
                    .key("forbid")
                    .entry_at(n);
                out.push((path, message.into()));
            }
        }
    }
}

fn check_workload(file: &MechanismFile, m: &Mechanism, out: &mut Found) {
    let at = DocumentPath::root_key("workload");
    let loads = &m.loads;
    if !m.joints.iter().any(|j| j.drive) {
        let what = [
            (file.workload.stroke.is_some(), "stroke"),
            (file.workload.drive_speed.is_some(), "drive_speed"),
        ];
        if let Some((_, what)) = what.into_iter().find(|w| w.0) {
            let message = format!(
                "no joint is a drive, so {what} has nothing to move; mark one with drive = true"
            );
            out.push((at.key(what), message.into()));
        }
    }
    let heavy = m
        .links
        .iter()
        .position(|l| l.mass.as_ref().is_some_and(|p| p.mass > 0.0));
    let moved = loads.drive_speeds.iter().any(|v| *v != 0.0);
    match (heavy, &loads.gravity) {
        (None, Some(_)) => {
            let message =
                "no link has a mass, so gravity has no effect; add mass and centre to the links";
            out.push((at.key("gravity"), message.into()));
        }
        // A disc of a torsional drive takes its inertia from its link.
        (Some(l), None) if !moved && file.workload.drive.is_none() => {
            let message = "masses have no effect without gravity or drive_speed; add gravity = [0, 0, -9.81] to [workload]";
            let path = DocumentPath::root_key("link").entry_at(l).key("mass");
            out.push((path, message.into()));
        }
        _ => {}
    }
    let loaded = !loads.forces.is_empty()
        || !loads.moments.is_empty()
        || !loads.misalignments.is_empty()
        || loads.grip.as_ref().is_some_and(|g| g.contacts.is_some())
        || (heavy.is_some() && (loads.gravity.is_some() || moved));
    let asked = m
        .ranking
        .iter()
        .flat_map(|r| &r.terms)
        .find_map(|(t, _)| matches!(t, Term::PeakForce | Term::PeakMoment).then(|| t.name()));
    if let Some(term) = asked.filter(|_| !loaded) {
        let message = format!(
            "the ranking uses {term}, but nothing loads the mechanism; add forces, moments, or masses with gravity"
        );
        out.push((
            DocumentPath::root_key("ranking").key("terms"),
            message.into(),
        ));
    }
}
