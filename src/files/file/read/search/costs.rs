//! Costs by name: of joint types, of options, of a change itself.

use crate::file::findings::Findings;
use crate::file::locate::{DocumentStep, key};
use crate::file::problem::ProblemKind;
use crate::file::read::resolve::cost;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{CostSpec, Joint, Mechanism};
use itertools::Itertools;
use std::collections::{BTreeMap, BTreeSet};

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
