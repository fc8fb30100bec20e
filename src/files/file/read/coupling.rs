//! Couplings of joints from their entries.

use crate::closure::coupling::{coefficient, in_plane, length_ratio};
use crate::closure::twist::{MotionSpace, joint_twists};
use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::number::number;
use crate::file::schema::MechanismFile;
use crate::geom::Scalars;
use crate::geom::exact::ExactField;
use crate::geom::expr::Expr;
use crate::linalg::echelon::Echelon;
use crate::model::joint_type::{CoupledFreedom, Coupling, Freedom, JointType};
use crate::model::mechanism::{Frame, JointId, JointOption, Mechanism};
use itertools::Itertools;

/// Reads the couplings, and takes from coupled joints the options that cannot be coupled alike.
pub(crate) fn couplings(file: &MechanismFile, mechanism: &mut Mechanism, out: &mut Findings) {
    for (i, entry) in file.coupling.iter().enumerate() {
        let at = [
            DocumentStep::Key("coupling".to_owned()),
            DocumentStep::Index(i),
        ];
        let joints = key(&at, "joints");
        let ends: Vec<CoupledFreedom> = entry
            .joints
            .iter()
            .enumerate()
            .filter_map(|(n, word)| end(mechanism, word, &index(&joints, n), out))
            .collect();
        let before = out.count();
        let ratio = number(&entry.ratio, &key(&at, "ratio"), out);
        if out.count() == before && ratio.to_f64() == 0.0 {
            out.add(&key(&at, "ratio"), ProblemKind::ZeroRatio);
        }
        let &[a, b] = ends.as_slice() else { continue };
        let names = || [a, b].map(|e| mechanism.joints[e.joint].id.clone());
        let [first, second] = names();
        if a.joint == b.joint {
            out.add(&joints, ProblemKind::CouplesItself { joint: first });
            continue;
        }
        if mechanism.joints[a.joint].states != mechanism.joints[b.joint].states {
            out.add(&joints, ProblemKind::CouplesStates { first, second });
            continue;
        }
        let twice = |c: &Coupling| c.ends == [a, b] || c.ends == [b, a];
        if mechanism.couplings.iter().any(twice) {
            out.add(&joints, ProblemKind::CoupledTwice { first, second });
            continue;
        }
        let coupling = Coupling {
            ends: [a, b],
            ratio,
            gear: entry.gear,
        };
        if ExactField::for_expressions([&coefficient(mechanism, &coupling)], 0).is_err() {
            out.add(&at, ProblemKind::CouplingInexact { first, second });
            continue;
        }
        mechanism.couplings.push(coupling);
    }
    offered(file, mechanism, out);
}

/// A freedom by the name of its joint, or joint:freedom.
fn end(
    mechanism: &Mechanism,
    word: &str,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<CoupledFreedom> {
    let whole = mechanism.joint(word).map(|j| (j, None));
    let parts = || {
        let (id, freedom) = word.rsplit_once(':')?;
        Some((mechanism.joint(id)?, Some(freedom)))
    };
    let Some((joint, freedom)) = whole.or_else(parts) else {
        let ids = mechanism.joints.iter().take(30).map(|j| j.id.as_str());
        let (id, known) = (word.to_owned(), ids.collect_vec().join(", "));
        out.add(path, ProblemKind::UnknownJoint { id, known });
        return None;
    };
    let found = freedom_of(mechanism, joint, freedom);
    found.map_err(|problem| out.add(path, problem)).ok()
}

/// The freedom that a word names, or the only one of its joint.
fn freedom_of(
    mechanism: &Mechanism,
    joint: JointId,
    word: Option<&str>,
) -> Result<CoupledFreedom, ProblemKind> {
    let (id, t) = (
        mechanism.joints[joint].id.clone(),
        &mechanism.joints[joint].joint_type,
    );
    let coupled: Vec<Freedom> = t
        .freedoms()
        .iter()
        .copied()
        .filter(|&f| definite(t, f) && in_plane(mechanism, joint, f))
        .collect();
    let known = || {
        coupled
            .iter()
            .map(|f| format!("{id}:{}", f.name()))
            .join(", ")
    };
    let freedom = match (word, t.freedoms(), coupled.as_slice()) {
        (_, _, []) => {
            let kind = t.name().to_owned();
            return Err(ProblemKind::NothingToCouple { joint: id, kind });
        }
        (None, [only], _) => *only,
        (None, ..) => {
            let known = known();
            return Err(ProblemKind::WhichFreedom { joint: id, known });
        }
        (Some(word), ..) => match coupled.iter().find(|f| f.name() == word) {
            Some(f) => *f,
            None => {
                return Err(ProblemKind::UnknownWord {
                    what: "freedom to couple",
                    word: format!("{id}:{word}"),
                    known: known(),
                });
            }
        },
    };
    Ok(CoupledFreedom { joint, freedom })
}

/// Whether a freedom has a coordinate of its own: a ball's turn about one of its axes has none, for the three turns do
/// not commute.
fn definite(t: &JointType, freedom: Freedom) -> bool {
    let turns = [Freedom::Rx, Freedom::Ry, Freedom::Rz];
    !turns.contains(&freedom) || !turns.iter().all(|f| t.freedoms().contains(f))
}

/// Takes options away that lack the coupled freedom, or have it about another axis. In a joint's own list that is a
/// problem.
fn offered(file: &MechanismFile, mechanism: &mut Mechanism, out: &mut Findings) {
    for j in mechanism.joint_ids() {
        let coupled = coupled_freedoms(mechanism, j);
        if coupled.is_empty() {
            continue;
        }
        let joint = &mechanism.joints[j];
        let keeps: Vec<bool> = joint
            .options
            .iter()
            .map(|o| keeps_coupled(o, &joint.options[0], &coupled))
            .collect();
        for (option, _) in joint.options.iter().zip(&keeps).filter(|(_, k)| !**k) {
            if file.joint[j].options.is_some() {
                let path = [
                    DocumentStep::Key("joint".to_owned()),
                    DocumentStep::Index(j.index()),
                ];
                let (joint, option) = (joint.id.clone(), option.name.clone());
                let problem = ProblemKind::LosesCoupling { joint, option };
                out.add(&key(&path, "options"), problem);
            }
        }
        let mut keeps = keeps.into_iter();
        mechanism.joints[j]
            .options
            .retain(|_| keeps.next().unwrap_or(true));
    }
}

/// Returns the freedoms of a joint that are coupled.
#[must_use]
pub fn coupled_freedoms(mechanism: &Mechanism, j: JointId) -> Vec<Freedom> {
    let couplings = mechanism.couplings.iter();
    let own = couplings.filter_map(|c| c.end_at(j).map(|e| c.ends[e].freedom));
    own.unique().collect()
}

/// Returns whether an option allows every motion of the present joint with the same rates of the coupled freedoms; always so where
/// none is coupled.
#[must_use]
pub fn keeps_coupled(option: &JointOption, present: &JointOption, coupled: &[Freedom]) -> bool {
    if coupled.is_empty() {
        return true;
    }
    let has =
        |f: &Freedom| option.joint_type.freedoms().contains(f) && definite(&option.joint_type, *f);
    coupled.iter().all(has) && contains_rates(option, present, coupled).unwrap_or(false)
}

/// Twists with the rates of the coupled freedoms behind them: those of the option span those of the present joint.
fn contains_rates(
    option: &JointOption,
    present: &JointOption,
    coupled: &[Freedom],
) -> Option<bool> {
    let length = |frame: &Frame, f: Freedom| length_ratio((frame, f), (&present.frame, f));
    let coordinates = |f: &Frame| {
        let all = f.point.iter().chain(&f.axis).chain(&f.reference);
        all.chain([&f.pitch]).cloned().collect_vec()
    };
    let mut all: Vec<Expr> = coordinates(&option.frame);
    all.extend(coordinates(&present.frame));
    all.extend(coupled.iter().map(|&f| length(&option.frame, f)));
    let exact = ExactField::for_expressions(&all, 0).ok()?;
    let rows = |o: &JointOption| {
        let twists = joint_twists(&exact, &MotionSpace::Spatial, &o.frame, &o.joint_type).ok()?;
        let row = |(f, mut t): (Freedom, Vec<_>)| {
            for &c in coupled {
                let rate = if c == f {
                    length(&o.frame, f)
                } else {
                    Expr::from(0)
                };
                t.push(Scalars::eval(&exact, &rate).ok()?);
            }
            Some(t)
        };
        twists.into_iter().map(row).collect::<Option<Vec<_>>>()
    };
    let mut span = Echelon::new(exact.field());
    rows(option)?.iter().for_each(|t| {
        span.insert(t);
    });
    Some(rows(present)?.iter().all(|t| span.contains(t)))
}
