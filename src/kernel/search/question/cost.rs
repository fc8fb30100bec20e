//! The additive cost of a redesign.
//!
//! cost(variant) = Σ over changed joints (cost of the new type - cost of the original type + change, and driven where a drive holds it)
//!               + Σ over unloading joints (cost of their type + link + change)
//!               + harmful redundant constraints that a searched state adds · harmful, 0 by default
//!
//! The cost of a change is never negative: a plain bush is cheaper than a lead screw, but removing a screw saves nothing.
//!
//! Joint types have default costs ([`JointType::default_cost_milli`]). A file can replace them under `[search.costs]`, and an option can
//! have its own cost.

use crate::model::joint_type::JointType;
use crate::model::mechanism::{CostSpec, JointOption};

/// Default cost of changing a joint at all, in thousandths.
pub(crate) const CHANGE: i64 = 1000;
/// Default additional cost of changing a driven joint, in thousandths: its motor is mounted and guided again.
pub(crate) const DRIVEN: i64 = 2000;
/// Returns the class of a piece of hardware along an axis, such as `wire-flexure` for `wire-flexure-x`.
fn hardware_class(name: &str) -> Option<&str> {
    let (class, axis) = name.rsplit_once('-')?;
    (JointType::CLASSES.contains(&class) && ["x", "y", "z"].contains(&axis)).then_some(class)
}

/// The costs in force for one mechanism, in thousandths.
#[derive(Debug, Clone)]
pub struct CostTable {
    /// The costs in the file.
    by_type: Vec<(String, i64)>,
    /// Cost of changing a joint at all.
    pub change: i64,
    /// Additional cost of changing a driven joint.
    pub driven: i64,
    /// Cost of an extra link.
    pub link: i64,
    /// Cost of a harmful redundant constraint that the searched state adds.
    pub harmful: i64,
}

impl CostTable {
    /// Creates the default costs, with the replacements of the file.
    #[must_use]
    pub fn new(spec: &CostSpec) -> Self {
        CostTable {
            by_type: spec.by_type_milli.clone(),
            change: spec.change_milli.unwrap_or(CHANGE),
            driven: spec.driven_milli.unwrap_or(DRIVEN),
            link: spec.link_milli.unwrap_or(CostSpec::LINK_MILLI),
            harmful: spec.harmful_milli.unwrap_or(0),
        }
    }

    /// Returns the cost of a change above that of the original joint: another joint in its place, an unloading joint with
    /// its link, or both. `drive` means that the joint is driven.
    #[must_use]
    pub fn change_cost(
        &self,
        present: &JointOption,
        drive: bool,
        to: Option<&JointOption>,
        unloading: Option<&JointOption>,
    ) -> i64 {
        let change = self.change + if drive { self.driven } else { 0 };
        let replaced = to.map_or(0, |o| {
            self.option_cost(o) - self.option_cost(present) + change
        });
        let inserted = unloading.map_or(0, |u| self.option_cost(u) + self.link + self.change);
        replaced.max(0) + inserted
    }

    /// Returns the cost of a joint: that of the option, of its name, of its class, or of its type. A custom type costs by freedoms.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::CostSpec, search::question::cost::CostTable};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let table = CostTable::new(&CostSpec::default());
    /// assert_eq!(table.option_cost(&four_bar.joints[ozols::model::JointId::new(0)].options[0]), 1000);
    /// # Ok::<(), ozols::Error>(())
    /// ```
    #[must_use]
    pub fn option_cost(&self, option: &JointOption) -> i64 {
        let named = |n: &str| {
            let stated = self.by_type.iter().find(|(name, _)| name == n);
            let default = || JointType::from_name(n).map(|t| t.default_cost_milli());
            stated.map(|(_, c)| *c).or_else(default)
        };
        let class = || named(hardware_class(&option.name)?);
        let of_type = |t: &JointType| named(t.name()).unwrap_or(t.default_cost_milli());
        option
            .cost_milli
            .or_else(|| named(&option.name))
            .or_else(class)
            .unwrap_or_else(|| match &option.joint_type {
                // Its class, or a revolute joint, at the file's price, and the freedoms beyond its one.
                custom @ JointType::Custom(set) => {
                    if let Some(stated) = named(&format!("freedoms-{}", set.len())) {
                        return stated;
                    }
                    let revolute = &JointType::Revolute;
                    of_type(revolute) + custom.default_cost_milli() - revolute.default_cost_milli()
                }
                other => of_type(other),
            })
    }
}
