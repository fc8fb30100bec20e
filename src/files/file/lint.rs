//! Warnings about a file that can be used: likely mistakes, and entries without effect.

use crate::closure::contour::{Contour, contour_basis};
use crate::file::doubted::{find_doubtful, find_guessed, find_rounding};
use crate::file::prelude::*;
use crate::file::problem::{ImportError, Warnings};
use crate::file::read::build_mechanism;
use crate::file::read::workload::workload_tables;
use crate::file::text::{read_file, text_of};
use crate::format::{first_of, four_digits};
use crate::model::ranking::Term;

/// Metres across, without a stated unit, beyond which the unit was probably forgotten.
const FORGOTTEN_UNIT: f64 = 10.0;
/// Metres across that a mechanism is hardly smaller or larger than.
const SIZES: (f64, f64) = (1e-5, 1e2);
/// Names shown of a list.
const SHOWN: usize = 8;

/// A file that can be used, and its doubtful values.
#[derive(Debug, Clone)]
pub struct Checked {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The tables of the workload, `grip` and `drive`, that exist.
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
        let mut warnings = Warnings {
            file: name.to_owned(),
            text: text.to_owned(),
            warnings: Vec::new(),
        };
        warnings.add(find_warnings(file, &mechanism));
        Ok(Checked {
            tables: workload_tables(file),
            warnings,
            mechanism,
        })
    })
}

fn find_warnings(file: &MechanismFile, m: &Mechanism) -> Vec<Finding> {
    let out = &Findings::default();
    if m.name.trim().is_empty() {
        let empty = "the name is empty; give one, because every answer begins with it";
        out.key("name").warn(empty);
    }
    check_drives(m, out);
    check_lengths(file, m, out);
    check_contours(m, out);
    check_structure(file, m, out);
    check_search(file, m, out);
    find_guessed(file, m, out);
    find_doubtful(file, m, out);
    check_workload(file, m, out);
    out.warned.take()
}

/// Finds driven joints with several freedoms for which the file does not name the driven one.
fn check_drives(m: &Mechanism, out: &Findings) {
    for (at, joint) in out.key("joint").each_entry(&m.joints) {
        let freedoms = joint.joint_type.freedoms();
        let Some(taken) = joint.driven_freedom() else {
            continue;
        };
        if freedoms.len() > 1 && joint.drive_freedom.is_none() {
            at.key("drive").warn(format!(
                "joint \"{}\" has the freedoms {}, and the file does not state which one is driven; write drive = \"{}\" if it is the one that redesigns keep now, or name another",
                joint.id, freedoms.iter().map(|f| f.name()).join(", "), taken.name()
            ));
        }
    }
}

fn check_lengths(file: &MechanismFile, m: &Mechanism, out: &Findings) {
    let across = m.distance_across();
    let metres = across * m.length_unit.metres;
    if file.length_unit.is_none() && metres > FORGOTTEN_UNIT {
        out.key("name").warn(format!(
            "the mechanism is {} m across, because lengths without a unit are in metres; add length_unit = \"mm\" if they are millimetres",
            four_digits(metres)
        ));
    } else if across > 0.0 && !(SIZES.0..=SIZES.1).contains(&metres) {
        out.key("length_unit").warn(format!(
            "the mechanism is {} m across; check that length_unit = \"{}\" is correct",
            four_digits(metres),
            m.length_unit.symbol
        ));
    }
    let rounded = find_rounding(m).into_iter();
    rounded.for_each(|kind| out.key("joint").warn(kind));
}

fn joint_place(out: &Findings, j: JointId) -> Place<'_> {
    out.key("joint").entry_at(j.index())
}

fn check_contours(m: &Mechanism, out: &Findings) {
    let joints = |c: &Contour| c.joints.iter().map(|&(j, _)| j).sorted().collect_vec();
    let basis = |s: StateId| contour_basis(m, s).iter().map(joints).collect();
    let bases: Vec<Vec<Vec<JointId>>> = m.state_ids().map(basis).collect();
    let walked: Vec<bool> = m
        .joint_ids()
        .map(|j| {
            let coupled = m.couplings.iter().flat_map(|c| &c.ends);
            bases.iter().flatten().any(|c| c.contains(&j))
                || coupled.into_iter().any(|e| e.joint == j)
        })
        .collect();
    let open: Vec<JointId> = m.joint_ids().filter(|&j| !walked[j]).collect();
    if !walked.contains(&true) {
        out.key("joint").warn(ProblemKind::NoContour);
    } else if let Some(&first) = open.first() {
        let names = open.iter().map(|&j| m.joints[j].id.as_str()).collect_vec();
        let joints = first_of(&names, SHOWN);
        joint_place(out, first).warn(ProblemKind::OpenChain { joints });
    }
    let named = m.contours.iter();
    let named = named.map(|c| c.iter().copied().sorted().collect_vec());
    let named = named.collect_vec();
    for (i, (at, contour)) in out.key("contour").each_entry(&named).enumerate() {
        if named[..i].contains(contour) || !bases.iter().flatten().contains(contour) {
            at.key("joints").warn("this contour follows from the others of its state and is ignored; remove it or give another");
        }
    }
}

fn check_structure(file: &MechanismFile, m: &Mechanism, out: &Findings) {
    let marked = |l: &LinkEntry| l.role.as_deref() == Some("output");
    if !file.link.iter().any(marked) {
        out.key("link").warn(ProblemKind::NoOutput);
    }
    let objects = m.links_with_ids().filter(|(_, l)| l.role == Role::Object);
    for (l, link) in objects {
        let at = out.key("link").entry_at(l.index()).key("id");
        let here = |s: StateId| {
            let of = |&j: &JointId| m.joints[j].links.contains(&l);
            m.joints_in(s).filter(of).count()
        };
        if here(StateId::FREE) > 0 {
            at.warn(format!(
                "clamped part \"{}\" is present in the free state; give its joints a state, such as state = \"clamped\"",
                link.id
            ));
        } else if let Some(s) = m.state_ids().find(|&s| here(s) == 1) {
            at.warn(format!(
                "clamped part \"{}\" has a single joint in state {}; add the other contact that clamps it",
                link.id, m.states[s]
            ));
        }
    }
    for (i, j) in m.joints_with_ids() {
        let at = joint_place(out, i);
        if j.joint_type == JointType::Fixed && j.states.is_none() {
            let [first, second] = j.links.map(|l| &m.links[l].id);
            at.key("type").warn(format!(
                "joint \"{}\" is fixed in every state; merge the links \"{first}\" and \"{second}\", or give the joint a state",
                j.id
            ));
        }
        let twin = m.joints[..i.index()].iter().find(|o| are_identical(o, j));
        if let Some(o) = twin {
            at.key("links").warn(format!(
                "joints \"{}\" and \"{}\" are identical; remove one",
                o.id, j.id
            ));
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

fn check_search(file: &MechanismFile, m: &Mechanism, out: &Findings) {
    let at = out.key("search");
    let changeable = m.joints.iter().any(|j| j.options.len() > 1);
    for (at, o) in at.key("options").each_entry(&file.search.options) {
        let Some(name) = option_name(o) else { continue };
        let mut offered = m.joints.iter().flat_map(|j| &j.options);
        if changeable && !offered.any(|o| o.name == name) {
            let option = name.to_owned();
            at.warn(ProblemKind::UselessOption { option });
        }
    }
    let lists_none = file.search.unloading.is_empty();
    let mut wants = out.key("joint").each_entry(&file.joint);
    let wants = wants.find(|(_, j)| matches!(j.unloading, Some(Unloading::Allowed(true))));
    let own = |j: &JointEntry| matches!(j.unloading, Some(Unloading::List(_)));
    match wants {
        Some((at, joint)) if lists_none => at.key("unloading").warn(format!(
            "joint \"{}\" allows unloading joints, but [search] lists none; add unloading = [\"spherical\"] there",
            joint.id
        )),
        None if !lists_none && !file.joint.iter().any(own) => at.key("unloading").warn(
            "no joint allows an unloading joint, so this list has no effect; write unloading = true at a joint",
        ),
        _ => {}
    }
    for (at, j) in out.key("joint").each_entry(&file.joint) {
        let list = j.options.as_ref().unwrap_or(&file.search.options);
        for (at, word) in at.key("forbid").each_entry(&j.forbid) {
            if !list.iter().any(|o| option_name(o) == Some(word)) {
                at.warn(format!(
                    "joint \"{}\" forbids \"{word}\", which is not an option of that joint; remove it, or correct the name",
                    j.id
                ));
            }
        }
    }
}

fn check_workload(file: &MechanismFile, m: &Mechanism, out: &Findings) {
    let at = out.key("workload");
    let loads = &m.loads;
    let what = [
        (file.workload.stroke.is_some(), "stroke"),
        (file.workload.drive_speed.is_some(), "drive_speed"),
    ];
    let driven = m.joints.iter().any(|j| j.drive);
    if let Some((_, what)) = what.into_iter().find(|w| w.0 && !driven) {
        at.key(what).warn(format!(
            "no joint is a drive, so {what} has nothing to move; mark one with drive = true"
        ));
    }
    let mut links = m.links.iter();
    let heavy = links.position(|l| l.mass.as_ref().is_some_and(|p| p.mass > 0.0));
    let moved = loads.drive_speeds.iter().any(|v| *v != 0.0);
    match (heavy, &loads.gravity) {
        (None, Some(_)) => at
            .key("gravity")
            .warn("no link has a mass, so gravity has no effect; add mass and centre to the links"),
        // A disc of a torsional drive takes its inertia from its link.
        (Some(l), None) if !moved && file.workload.drive.is_none() => {
            out.key("link").entry_at(l).key("mass").warn(
                "masses have no effect without gravity or drive_speed; add gravity = [0, 0, -9.81] to [workload]",
            );
        }
        _ => {}
    }
    let loaded = !loads.forces.is_empty()
        || !loads.moments.is_empty()
        || !loads.misalignments.is_empty()
        || loads.grip.as_ref().is_some_and(|g| g.contacts.is_some())
        || (heavy.is_some() && (loads.gravity.is_some() || moved));
    let mut terms = m.ranking.iter().flat_map(|r| &r.terms);
    let asked = terms.find(|(t, _)| matches!(t, Term::PeakForce | Term::PeakMoment));
    if let Some(term) = asked.filter(|_| !loaded).map(|(t, _)| t.name()) {
        out.key("ranking").key("terms").warn(format!(
            "the ranking uses {term}, but nothing loads the mechanism; add forces, moments, or masses with gravity"
        ));
    }
}
