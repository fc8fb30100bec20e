//! Faults of the drives, in words.

use crate::format::{plural, plural_of};
use crate::model::mechanism::Mechanism;
use crate::redundancy::drives;
use serde::Serialize;

/// A fault of the drives.
#[derive(Debug, Serialize)]
pub struct DriveFault<'a> {
    /// `immobile`, `surplus`, `dependent`, `locked` or `dead-point`.
    pub kind: &'static str,
    /// The joint of a locked drive.
    pub joint: Option<&'a str>,
    pub text: String,
}

impl<'a> DriveFault<'a> {
    pub(super) fn new(mechanism: &'a Mechanism, fault: &drives::DriveFault) -> DriveFault<'a> {
        let (kind, joint, text) = match *fault {
            drives::DriveFault::Immobile => (
                "immobile",
                None,
                "the mechanism is driven and cannot move".to_owned(),
            ),
            drives::DriveFault::Surplus { drives, mobility } => {
                let freedom = plural_of(&mobility.to_string(), "degree");
                let text = format!(
                    "{} for {freedom} of freedom: more drives than degrees of freedom work against each other",
                    plural(drives, "drive")
                );
                ("surplus", None, text)
            }
            drives::DriveFault::Dependent {
                drives,
                independent,
            } => {
                let text = format!(
                    "{drives} drives move and {independent} of their speeds can be chosen in this pose: the drives work against each other"
                );
                ("dependent", None, text)
            }
            drives::DriveFault::Locked(joint) => {
                let id = mechanism.joints[joint].id.as_str();
                let text = format!("drive {id} is locked: it cannot move in this pose");
                ("locked", Some(id), text)
            }
            drives::DriveFault::DeadPoint => (
                "dead-point",
                None,
                "dead point: the outputs stand still to first order while a drive moves".to_owned(),
            ),
        };
        DriveFault { kind, joint, text }
    }
}
