//! Warnings about a file that can be used: likely mistakes, and entries without effect.

use crate::closure::contour::{Contour, contour_basis};
use crate::file::doubted::{doubted, guessed};
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ImportError;
use crate::file::read::build;
use crate::file::read::workload::workload_tables;
use crate::file::rounding;
use crate::file::schema::{LinkEntry, MechanismFile, OptionEntry, Unloading};
use crate::file::text::{read, text_of};
use crate::file::warning::{WarningKind, Warnings, first_of};
use crate::format::plain::turns;
use crate::format::significant;
use crate::geom::expr::Expr;
use crate::geom::extent::diagonal;
use crate::geom::vector::{length, real, sub};
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
pub fn check(name: &str, bytes: &[u8]) -> Result<Checked, ImportError> {
    let text = text_of(name, bytes)?;
    read(name, text, |file| {
        let mechanism = build(file)?;
        let mut warnings = Warnings {
            file: name.to_owned(),
            text: text.to_owned(),
            warnings: Vec::new(),
        };
        for (path, kind) in find(file, &mechanism) {
            warnings.add(&path, kind);
        }
        Ok(Checked {
            mechanism,
            tables: workload_tables(file),
            warnings,
        })
    })
}

type Found = Vec<(Vec<DocumentStep>, WarningKind)>;

fn root(k: &str) -> Vec<DocumentStep> {
    vec![DocumentStep::Key(k.to_owned())]
}

fn find(file: &MechanismFile, m: &Mechanism) -> Found {
    let mut out = Found::new();
    if m.name.trim().is_empty() {
        out.push((root("name"), WarningKind::NoName));
    }
    ids(file, &mut out);
    drives(m, &mut out);
    lengths(file, m, &mut out);
    contours(m, &mut out);
    structure(file, m, &mut out);
    search(file, m, &mut out);
    out.extend(guessed(file, m));
    out.extend(doubted(file, m));
    workload(file, m, &mut out);
    out
}

/// Finds ids that do not read as they are written.
fn ids(file: &MechanismFile, out: &mut Found) {
    let links = file.link.iter().map(|l| l.id.as_str()).enumerate();
    let joints = file.joint.iter().map(|j| j.id.as_str()).enumerate();
    let all = links
        .map(|(n, id)| ("link", n, id))
        .chain(joints.map(|(n, id)| ("joint", n, id)));
    for (list, n, id) in all.filter(|(_, _, id)| id.contains(turns)) {
        let path = key(&index(&root(list), n), "id");
        out.push((path, WarningKind::TurnsLetters { id: id.to_owned() }));
    }
}

/// Finds driven joints with several freedoms for which the file does not name the driven one.
fn drives(m: &Mechanism, out: &mut Found) {
    for (at, joint) in m.joints.iter().enumerate() {
        let freedoms = joint.joint_type.freedoms();
        let Some(taken) = joint.driven_freedom() else {
            continue;
        };
        if freedoms.len() > 1 && joint.drive_freedom.is_none() {
            let kind = WarningKind::DriveUnnamed {
                joint: joint.id.clone(),
                freedoms: freedoms.iter().map(|f| f.name()).join(", "),
                taken: taken.name(),
            };
            out.push((key(&index(&root("joint"), at), "drive"), kind));
        }
    }
}

fn place(j: &Joint) -> [f64; 3] {
    real(&j.frame.point)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(sub(a, b))
}

/// Returns the diagonal of the box around the joints, in the file's unit.
#[must_use]
pub fn across(m: &Mechanism) -> f64 {
    diagonal(m.joints.iter().map(place))
}

fn lengths(file: &MechanismFile, m: &Mechanism, out: &mut Found) {
    let across = across(m);
    let metres = across * m.length_unit.metres;
    if file.length_unit.is_none() && metres > FORGOTTEN_UNIT {
        let across = significant(metres);
        out.push((root("name"), WarningKind::ForgottenUnit { across }));
    } else if across > 0.0 && !(SIZES.0..=SIZES.1).contains(&metres) {
        let (across, unit) = (significant(metres), m.length_unit.symbol);
        out.push((root("length_unit"), WarningKind::OddSize { across, unit }));
    }
    let before = out.len();
    places(m, across, out);
    // What is told of a pair with its line need not be told again.
    let told = out.len() > before;
    let rounded = rounding::doubts(m).into_iter();
    let rounded = rounded.filter(|k| !(told && matches!(k, WarningKind::NearlySpecial { .. })));
    out.extend(rounded.map(|kind| (root("joint"), kind)));
}

/// Finds joints of one link that are nearly in one place. If many digits show that coordinates were measured, reports that
/// instead.
fn places(m: &Mechanism, across: f64, out: &mut Found) {
    if looks_rounded(m).is_some_and(|r| r.digits.is_some()) {
        return;
    }
    for (a, b) in m.joint_ids().tuple_combinations() {
        let [i, j] = [a, b].map(|j| &m.joints[j]);
        let apart = distance(place(i), place(j));
        let near = apart > 0.0 && apart < SAME_PLACE * across;
        if near && i.links.iter().any(|l| j.links.contains(l)) {
            let kind = WarningKind::NearlyOnePlace {
                first: i.id.clone(),
                second: j.id.clone(),
                apart: significant(apart),
                across: significant(across),
                unit: m.length_unit.symbol,
            };
            out.push((key(&index(&root("joint"), b.index()), "point"), kind));
        }
    }
}

fn contours(m: &Mechanism, out: &mut Found) {
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
        out.push((root("joint"), WarningKind::NoContour));
    } else {
        let open: Vec<JointId> = m.joint_ids().filter(|&j| !walked[j]).collect();
        if let Some(&first) = open.first() {
            let names = open.iter().map(|&j| m.joints[j].id.as_str()).collect_vec();
            let joints = first_of(&names, SHOWN);
            let at = index(&root("joint"), first.index());
            out.push((at, WarningKind::OpenChain { joints }));
        }
    }
    let named = m.contours.iter();
    let named = named.map(|c| c.iter().copied().sorted().collect_vec());
    let named = named.collect_vec();
    for (i, contour) in named.iter().enumerate() {
        if named[..i].contains(contour) || !bases.iter().flatten().contains(contour) {
            let at = key(&index(&root("contour"), i), "joints");
            out.push((at, WarningKind::DependentContour));
        }
    }
}

fn structure(file: &MechanismFile, m: &Mechanism, out: &mut Found) {
    let marked = |l: &LinkEntry| l.role.as_deref() == Some("output");
    if !file.link.iter().any(marked) {
        out.push((root("link"), WarningKind::NoOutput));
    }
    for (l, link) in m.links_with_ids() {
        if link.role != Role::Object {
            continue;
        }
        let at = key(&index(&root("link"), l.index()), "id");
        let here = |s: StateId| {
            let of = |&j: &JointId| m.joints[j].links.contains(&l);
            m.joints_in(s).filter(of).count()
        };
        if here(StateId::FREE) > 0 {
            let link = link.id.clone();
            out.push((at, WarningKind::ObjectAlwaysThere { link }));
            continue;
        }
        if let Some(s) = m.state_ids().find(|&s| here(s) == 1) {
            let (link, state) = (link.id.clone(), m.states[s].clone());
            out.push((at, WarningKind::Dangling { link, state }));
        }
    }
    for (i, j) in m.joints_with_ids() {
        let at = index(&root("joint"), i.index());
        if j.joint_type == JointType::Fixed && j.states.is_none() {
            let kind = WarningKind::AlwaysFixed {
                joint: j.id.clone(),
                first: m.links[j.links[0]].id.clone(),
                second: m.links[j.links[1]].id.clone(),
            };
            out.push((key(&at, "type"), kind));
        }
        let twin = m.joints[..i.index()].iter().find(|o| twins(o, j));
        if let Some(o) = twin {
            let (first, second) = (o.id.clone(), j.id.clone());
            out.push((key(&at, "links"), WarningKind::Twin { first, second }));
        }
    }
}

/// Returns true if two joints have the same links, type, place and axis, in the same states.
fn twins(a: &Joint, b: &Joint) -> bool {
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

fn search(file: &MechanismFile, m: &Mechanism, out: &mut Found) {
    let at = root("search");
    let changeable = m.joints.iter().any(|j| j.options.len() > 1);
    for (i, o) in file.search.options.iter().enumerate() {
        let Some(name) = option_name(o) else { continue };
        let taken = m
            .joints
            .iter()
            .any(|j| j.options.iter().any(|o| o.name == name));
        if changeable && !taken {
            let option = name.to_owned();
            let path = index(&key(&at, "options"), i);
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
            let joint = file.joint[j].id.clone();
            let path = key(&index(&root("joint"), j), "unloading");
            out.push((path, WarningKind::UnloadingOfNothing { joint }));
        }
    } else if !file.joint.iter().any(|j| asks(&j.unloading)) {
        out.push((key(&at, "unloading"), WarningKind::UnloadingNowhere));
    }
    for (i, j) in file.joint.iter().enumerate() {
        let list = j.options.as_ref().unwrap_or(&file.search.options);
        for (n, word) in j.forbid.iter().enumerate() {
            if !list.iter().any(|o| option_name(o) == Some(word)) {
                let (joint, option) = (j.id.clone(), word.clone());
                let path = index(&key(&index(&root("joint"), i), "forbid"), n);
                out.push((path, WarningKind::ForbidsNothing { joint, option }));
            }
        }
    }
}

fn workload(file: &MechanismFile, m: &Mechanism, out: &mut Found) {
    let at = root("workload");
    let loads = &m.loads;
    if !m.joints.iter().any(|j| j.drive) {
        let what = [
            (file.workload.stroke.is_some(), "stroke"),
            (file.workload.drive_speed.is_some(), "drive_speed"),
        ];
        if let Some((_, what)) = what.into_iter().find(|w| w.0) {
            out.push((key(&at, what), WarningKind::NoDrive { what }));
        }
    }
    let heavy = m
        .links
        .iter()
        .position(|l| l.mass.as_ref().is_some_and(|p| p.mass > 0.0));
    let moved = loads.drive_speeds.iter().any(|v| *v != 0.0);
    match (heavy, &loads.gravity) {
        (None, Some(_)) => out.push((key(&at, "gravity"), WarningKind::GravityAlone)),
        // A disc of a torsional drive takes its inertia from its link.
        (Some(l), None) if !moved && file.workload.drive.is_none() => {
            let path = key(&index(&root("link"), l), "mass");
            out.push((path, WarningKind::MassAlone));
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
        out.push((
            key(&root("ranking"), "terms"),
            WarningKind::RankingUnloaded { term },
        ));
    }
}
