//! The additive cost of a redesign.
//!
//! cost(variant) = Σ over changed joints (cost of the new type - cost of the present type + change)
//!               + Σ over unloading joints (cost of their type + link + change)
//!
//! The default table is a plain order of magnitude for machined parts, relative to a revolute joint; a file replaces
//! any entry under `[search.costs]`, and an option may state a cost of its own.

use crate::model::joint_type::JointType;
use crate::model::mechanism::{CostSpec, JointOption};

/// Default costs in thousandths of a revolute joint's.
pub const DEFAULTS: [(&str, i64); 13] = [
    ("revolute", 1000),
    ("prismatic", 2000),
    ("helical", 3000),
    ("cylindrical", 1500),
    ("universal", 2500),
    ("slotted", 1500),
    ("spherical", 2000),
    ("planar", 2500),
    ("cylindrical-universal", 3500),
    ("sphere-in-cylinder", 2500),
    ("cylinder-on-plane", 2000),
    ("sphere-on-plane", 1500),
    ("fixed", 500),
];
/// Default cost of changing a joint at all, in thousandths.
pub const CHANGE: i64 = 1000;
/// Default cost of the extra link of an unloading joint, in thousandths.
pub const LINK: i64 = 1000;
/// A custom joint costs a revolute joint plus this for each freedom beyond the first, in thousandths.
pub const CUSTOM_FREEDOM: i64 = 750;

/// The costs in force for one mechanism, in thousandths.
#[derive(Debug, Clone)]
pub struct CostTable {
    by_type: Vec<(String, i64)>,
    /// Cost of changing a joint at all.
    pub change: i64,
    /// Cost of an extra link.
    pub link: i64,
}

impl CostTable {
    /// The defaults with what the file replaces.
    #[must_use]
    pub fn new(spec: &CostSpec) -> Self {
        let mut by_type = spec.by_type_milli.clone();
        by_type.extend(DEFAULTS.iter().map(|(n, c)| ((*n).to_owned(), *c)));
        CostTable {
            by_type,
            change: spec.change_milli.unwrap_or(CHANGE),
            link: spec.link_milli.unwrap_or(LINK),
        }
    }

    /// The cost of a change above that of the present joint: another joint in its place, an unloading joint with its link
    /// beside it, or both.
    #[must_use]
    pub fn change(
        &self,
        present: &JointOption,
        to: Option<&JointOption>,
        unloading: Option<&JointOption>,
    ) -> i64 {
        let replaced = to.map_or(0, |o| self.option(o) - self.option(present) + self.change);
        let inserted = unloading.map_or(0, |u| self.option(u) + self.link + self.change);
        replaced + inserted
    }

    /// The cost of a joint: the option's own, its name's, its type's, or by freedoms for a custom type.
    #[must_use]
    pub fn option(&self, option: &JointOption) -> i64 {
        let named = |n: &str| {
            self.by_type
                .iter()
                .find(|(name, _)| name == n)
                .map(|(_, c)| *c)
        };
        option
            .cost_milli
            .or_else(|| named(&option.name))
            .unwrap_or_else(|| match &option.joint_type {
                JointType::Custom(list) => {
                    let more = i64::try_from(list.len()).unwrap_or(0) - 1;
                    named("revolute").unwrap_or(1000) + CUSTOM_FREEDOM * more
                }
                other => named(other.name()).unwrap_or(1000),
            })
    }
}
