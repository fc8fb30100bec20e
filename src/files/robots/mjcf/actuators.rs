//! The actuators of MJCF.

use crate::file::problem::ImportError;
use crate::robots::convert::payload::{Actuator, Command, Payload};
use crate::robots::description::parts::Robot;
use crate::robots::mjcf::context::Context;
use crate::robots::xml::Element;

/// Words of actuators that MJCF has, but for the joint they move.
const ACTUATOR: [&str; 24] = [
    "name",
    "ctrllimited",
    "forcelimited",
    "actlimited",
    "ctrlrange",
    "forcerange",
    "actrange",
    "lengthrange",
    "gear",
    "kp",
    "kv",
    "dampratio",
    "timeconst",
    "inheritrange",
    "dyntype",
    "gaintype",
    "biastype",
    "dynprm",
    "gainprm",
    "biasprm",
    "actdim",
    "actearly",
    "area",
    "bias",
];

/// The joint that an actuator acts on, whichever frame it does so in.
pub(super) fn driven<'a>(actuator: Element<'a>) -> Option<&'a str> {
    let joint = actuator.attribute("joint");
    joint.or(actuator.attribute("jointinparent"))
}

/// Reads a section of actuators.
pub(super) fn actuators(
    section: Element<'_>,
    context: &Context<'_>,
    robot: &Robot,
    out: &mut Payload,
) -> Result<(), ImportError> {
    for e in section.children() {
        let name = e.attribute("name");
        let joint = driven(e).and_then(|n| robot.joints.iter().position(|p| p.id == n));
        let command = match e.name() {
            "position" | "intvelocity" => Command::Position,
            "velocity" | "damper" => Command::Velocity,
            "motor" | "general" | "cylinder" => Command::Effort,
            _ => {
                out.lost
                    .not_read(&format!("actuator of kind {}", e.name()), name);
                continue;
            }
        };
        let Some(joint) = joint else {
            out.lost.not_read("actuator of no joint", name);
            continue;
        };
        let look = context.defaults.of(e, e.name(), None)?;
        let gear = look
            .attribute("gear")
            .and_then(|(_, v)| v.split_whitespace().next()?.parse().ok());
        out.actuators.push(Actuator {
            name: name.map(str::to_owned),
            joint,
            command,
            gear: gear
                .filter(|g: &f64| g.is_finite() && *g != 0.0)
                .unwrap_or(1.0),
            tag: Some(e.name().to_owned()),
            words: look.words(&ACTUATOR),
        });
    }
    Ok(())
}
