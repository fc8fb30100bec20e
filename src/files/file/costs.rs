//! Costs by name: of joint types, of options, and of a change itself. They are given in a mechanism's file under
//! `[search.costs]`, or in a separate file.

use crate::file::prelude::*;
use crate::file::problem::ImportError;
use crate::model::mechanism::CostSpec;

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
/// use ozols::file::costs::costs_from_str;
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

/// The names of costs that do not belong to a joint type.
const OTHERS: [&str; 4] = ["change", "driven", "link", "harmful"];

pub(crate) fn read_costs(stated: &BTreeMap<String, f64>, m: &Parts, at: &Place<'_>) -> CostSpec {
    let mut spec = CostSpec::default();
    let offered = m.joints.iter().flat_map(Joint::offered_options);
    let offered: BTreeSet<&str> = offered.map(|o| o.name.as_str()).collect();
    for (name, &value) in stated {
        let at = at.key(name);
        let Some(milli) = at.read_cost(value) else {
            continue;
        };
        match name.as_str() {
            "change" => spec.change_milli = Some(milli),
            "driven" => spec.driven_milli = Some(milli),
            "link" => spec.link_milli = Some(milli),
            "harmful" => spec.harmful_milli = Some(milli),
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
                let known = OTHERS.into_iter().chain(types).chain(JointType::CLASSES);
                let mut known: Vec<&str> = known.collect();
                known.extend(&offered);
                at.add_unknown_word("cost", name, known.iter().unique());
            }
        }
    }
    spec
}
