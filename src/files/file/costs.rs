//! Costs by name: of joint types, of options, of a change itself; in a mechanism's file under `[search.costs]`, or in a file beside it.

use crate::file::Findings;
use crate::file::locate::{Document, DocumentStep, key};
use crate::file::problem::{ImportError, Problem, ProblemKind};
use crate::file::read::resolve::cost;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{CostSpec, Joint, Mechanism};
use itertools::Itertools;
use std::collections::{BTreeMap, BTreeSet};

/// Reads the costs of a mechanism's redesigns from TOML.
///
/// # Units
/// Costs are in revolute joints, from 0 to 1e6.
///
/// # Errors
/// Every problem found, each with its place: what is no TOML, no name of a joint type, of an option of the mechanism or of
/// `change`, `link` and `harmful`, or no cost.
pub fn costs_from_str(
    name: &str,
    text: &str,
    mechanism: &Mechanism,
) -> Result<CostSpec, ImportError> {
    let fail = |problems| ImportError {
        file: name.to_owned(),
        text: text.to_owned(),
        problems,
    };
    let stated: BTreeMap<String, f64> = toml::from_str(text).map_err(|e| {
        let why = e.message().trim().replace('\n', ", ");
        let message = format!(
            "{why}; each line is a name and a number, such as spherical = 2 (`ozols show costs` prints them all)"
        );
        fail(vec![Problem {
            kind: ProblemKind::Syntax { message },
            span: e.span(),
        }])
    })?;
    let mut out = Findings::default();
    let spec = costs(&stated, mechanism, &[], &mut out);
    out.unless(spec).map_err(|found| {
        let document = Document::new(text, false);
        let place = |path: &[_]| document.as_ref().and_then(|d| d.span(path));
        let problems = found.into_iter().map(|(path, kind)| {
            let span = place(&path);
            Problem { kind, span }
        });
        let mut problems: Vec<Problem> = problems.collect();
        problems.sort_by_key(|p| p.span.as_ref().map_or(usize::MAX, |s| s.start));
        fail(problems)
    })
}

/// What costs that are no joint's are called.
const OTHERS: [&str; 4] = ["change", "driven", "link", "harmful"];

pub(crate) fn costs(
    stated: &BTreeMap<String, f64>,
    mechanism: &Mechanism,
    at: &[DocumentStep],
    out: &mut Findings,
) -> CostSpec {
    let mut spec = CostSpec::default();
    let offered = mechanism.joints.iter().flat_map(Joint::offered);
    let offered: BTreeSet<String> = offered.map(|o| o.name.clone()).collect();
    for (name, &value) in stated {
        let path = key(at, name);
        let Some(milli) = cost(value, &path, out) else {
            continue;
        };
        match name.as_str() {
            "change" => spec.change_milli = Some(milli),
            "driven" => spec.driven_milli = Some(milli),
            "link" => spec.link_milli = Some(milli),
            "harmful" => spec.harmful_milli = Some(milli),
            n if JointType::from_name(n).is_some() || offered.contains(n) => {
                spec.by_type_milli.push((name.clone(), milli));
            }
            _ => {
                let types = JointType::NAMED.iter().map(JointType::name);
                let words = OTHERS.into_iter().chain(types).map(str::to_owned);
                out.add(
                    &path,
                    ProblemKind::UnknownWord {
                        what: "cost",
                        word: name.clone(),
                        known: words.chain(offered.iter().cloned()).unique().join(", "),
                    },
                );
            }
        }
    }
    spec
}
