//! What a joint may become.

use crate::file::findings::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::resolve::{contains, option};
use crate::file::read::value::limits::LIMITS;
use crate::file::schema::{JointEntry, MechanismFile, OptionEntry};
use crate::model::mechanism::JointOption;

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
    let (list, from, own): (&[OptionEntry], Vec<DocumentStep>, bool) = match &entry.options {
        Some(list) => (list, key(at, "options"), true),
        None if changeable => (
            &file.search.options,
            key(&[DocumentStep::Key("search".to_owned())], "options"),
            false,
        ),
        None => (&[], Vec::new(), false),
    };
    let mut options = vec![present.clone()];
    if list.len() > LIMITS.2 {
        out.add(
            &from,
            ProblemKind::TooMany {
                what: "options",
                count: list.len(),
                limit: LIMITS.2,
            },
        );
        return options;
    }
    for (n, item) in list.iter().enumerate() {
        let path = index(&from, n);
        // A bad entry of the common list would be reported once per joint.
        let (before, Some(option)) = (
            out.count(),
            option(&entry.id, &present.frame, item, states, &path, out),
        ) else {
            continue;
        };
        if out.count() > before || entry.forbid.contains(&option.name) {
            continue;
        }
        let same =
            option.joint_type == present.joint_type && contains(&option, present) == Some(true);
        if same && options.len() == 1 + n {
            // The present joint, listed: keep its name and cost.
            options[0].name = option.name;
            options[0].cost_milli = option.cost_milli.or(options[0].cost_milli);
            continue;
        }
        if same {
            continue;
        }
        match contains(&option, present) {
            Some(true) => {}
            Some(false) if own => {
                let (joint, option, present) =
                    (entry.id.clone(), option.name, present.name.clone());
                out.add(
                    &path,
                    ProblemKind::LosesMotion {
                        joint,
                        option,
                        present,
                    },
                );
                continue;
            }
            _ => continue,
        }
        if options.iter().any(|o| o.name == option.name) {
            out.add(
                &path,
                ProblemKind::RepeatedOption {
                    joint: entry.id.clone(),
                    option: option.name,
                },
            );
            continue;
        }
        options.push(option);
    }
    options
}
