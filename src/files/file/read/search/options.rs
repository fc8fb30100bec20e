//! What a joint may become.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::resolve::{contains, option};
use crate::file::read::value::LIMITS;
use crate::file::schema::{JointEntry, MechanismFile, OptionEntry};
use crate::model::mechanism::{Frame, JointOption};

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
