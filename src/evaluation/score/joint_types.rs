//! Capacities and clearances of joint types.

use crate::model::mechanism::{JointOption, Mechanism};
use serde::Deserialize;
use std::collections::BTreeMap;

const TEXT: &str = include_str!("joint_types.toml");

/// The capacities and the clearance of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointType {
    /// Force `[N]`.
    pub capacity_force: f64,
    /// Moment `[N·m]`; `None` where it bears none and need not.
    #[serde(default)]
    pub capacity_moment: Option<f64>,
    /// Half its play `[m]`.
    pub clearance: f64,
}

impl JointType {
    /// A joint of which nothing is known: its share is the force itself, and it has no play.
    pub(in crate::score) const UNLIMITED: JointType = JointType {
        capacity_force: 1.0,
        capacity_moment: None,
        clearance: 0.0,
    };
}

/// Joint types by name.
#[derive(Debug, Clone)]
pub struct JointTypes {
    by_name: BTreeMap<String, JointType>,
}

impl JointTypes {
    /// Returns the built-in catalogue.
    ///
    /// # Panics
    /// Never: the text is part of the program, and a test reads it.
    ///
    /// # Examples
    /// ```
    /// use ozols::score::joint_types::JointTypes;
    /// let types = JointTypes::built_in();
    /// // A ball bears forces and no moments.
    /// assert!(types.get("spherical").is_some_and(|t| t.capacity_force > 0.0 && t.capacity_moment.is_none()));
    /// ```
    pub fn built_in() -> JointTypes {
        JointTypes {
            by_name: toml::from_str(TEXT).expect("the built-in catalogue is valid"),
        }
    }

    /// Returns the catalogue with the replacements in a mechanism's file.
    pub fn of(mechanism: &Mechanism) -> JointTypes {
        let mut all = JointTypes::built_in();
        for o in &mechanism.joint_types {
            // An option by its own name starts from its type.
            let of_option = || all.get(mechanism.option_named(&o.name)?.joint_type.name());
            let Some(mut t) = all.get(&o.name).or_else(of_option).copied() else {
                continue;
            };
            t.capacity_force = o.capacity_force.unwrap_or(t.capacity_force);
            t.capacity_moment = o.capacity_moment.or(t.capacity_moment);
            t.clearance = o.clearance.unwrap_or(t.clearance);
            all.by_name.insert(o.name.clone(), t);
        }
        all
    }

    /// Returns a type by its name.
    pub fn get(&self, name: &str) -> Option<&JointType> {
        self.by_name.get(name)
    }

    /// Returns the values of an option by its own name, or by that of its type.
    pub fn option_type(&self, option: &JointOption) -> JointType {
        self.get(&option.name)
            .or_else(|| self.get(option.joint_type.name()))
            .copied()
            .unwrap_or(JointType::UNLIMITED)
    }
}
