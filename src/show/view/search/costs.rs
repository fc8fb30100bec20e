//! The table of costs, as a file that a search takes.

use crate::format::format_cost;
use crate::model::joint_type::JointType;
use crate::model::mechanism::CostSpec;
use crate::search::question::cost::CostTable;
use crate::terms::PairWords;

const HEAD: &str = "\
# What a redesign costs, in revolute joints: the default costs, orders of
# magnitude for machined parts. For each joint that it changes, a search adds
# the cost of the new type less that of the original one, and `change`, and
# `driven` where a drive holds the joint; for each joint that it puts in series,
# the cost of its type, `link` and `change`.
#
#   ozols show costs > costs.toml
# A search takes this file as its costs; `report`, `draw`, `export` and
# `fix` take it, too. If a line is missing, [search.costs] of FILE holds, or the default. The cost at one
# option of FILE stays. A custom joint costs a revolute joint, and
# CUSTOM for each freedom beyond the first. Names of FILE's options may be
# here, too, and classes of the sets of the option `any`: CLASSES.
";

/// Returns the default costs as TOML.
///
/// # Examples
/// ```
/// use ozols::{file::costs::costs_from_str, view::search::costs::costs_toml};
/// // The default costs are a file that can be changed and read back.
/// let four_bar = ozols::built_in("four-bar")?;
/// assert!(costs_from_str("costs.toml", &costs_toml(), &four_bar).is_ok());
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn costs_toml() -> String {
    let table = CostTable::new(&CostSpec::default());
    let line = |name: &str, milli: i64, what: &str| {
        format!("\n# {what}\n{name} = {}\n", format_cost(milli))
    };
    let words = PairWords::builtin();
    let types = JointType::NAMED.iter().map(|t| {
        let about = words.get(t.name()).map_or("", |w| w.about.as_str());
        let short = about.split([':', '.']).next().unwrap_or(about);
        let what = format!("class {}: {short}", t.class_numeral());
        line(t.name(), t.default_cost_milli(), &what)
    });
    let others = [
        ("change", table.change, "changing a joint at all"),
        (
            "driven",
            table.driven,
            "changing a driven joint, in addition: the motor needs a new mount and guide",
        ),
        ("link", table.link, "the extra link of a joint in series"),
        (
            "harmful",
            table.harmful,
            "each redundant constraint that loads clamping faces in a searched state",
        ),
    ];
    let others = others.map(|(name, milli, what)| line(name, milli, what));
    let classes = JointType::CLASSES.chunks(4).map(|c| c.join(", "));
    let head = HEAD
        .replace("CUSTOM", &format_cost(JointType::CUSTOM_FREEDOM))
        .replace(
            "CLASSES",
            &format!("\n# {}", classes.collect::<Vec<_>>().join(",\n# ")),
        );
    head + &others.concat() + &types.collect::<String>()
}
