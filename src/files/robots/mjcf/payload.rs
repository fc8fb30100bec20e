//! What an MJCF file carries besides kinematics: its bodies, loops, couplings and actuators.

use crate::file::problem::ImportError;
use crate::robots::convert::payload::{Actuator, Command, Payload};
use crate::robots::description::parts::Robot;
use crate::robots::mjcf::bodies::{BodyReader, settings};
use crate::robots::mjcf::context::{Context, compiler};
use crate::robots::mjcf::defaults::Defaults;
use crate::robots::mjcf::geoms::Geoms;
use crate::robots::xml::Element;
use std::collections::BTreeMap;

/// Words of an equality that only MuJoCo's solver knows.
const EQUALITY: [&str; 3] = ["solref", "solimp", "torquescale"];
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

/// Reads it; the robot is that of the same document.
pub(crate) fn read(root: Element<'_>, robot: &Robot) -> Result<Payload, ImportError> {
    let context = Context {
        compiler: compiler(root)?,
        defaults: Defaults::read(root)?,
        sites: BTreeMap::new(),
    };
    let mut out = Payload::default();
    let settings = settings(root, &mut out)?;
    let geoms = Geoms::of(root)?;
    let joints: BTreeMap<usize, usize> = robot
        .joints
        .iter()
        .enumerate()
        .filter_map(|(j, p)| Some((p.element?, j)))
        .collect();
    let bodies = BodyReader {
        robot,
        context: &context,
        settings: &settings,
        geoms: &geoms,
        joints: &joints,
    };
    for w in root.named("worldbody") {
        bodies.read(w, &mut out)?;
    }
    for section in root.children() {
        match section.name() {
            "worldbody" | "default" | "compiler" => {}
            "option" => {
                for a in section.attributes() {
                    out.option.push((a.0.to_owned(), a.1.to_owned()));
                }
                section
                    .children()
                    .for_each(|c| out.lost.not_read(c.name(), None));
            }
            "equality" => equalities(section, &context, &joints, &mut out)?,
            "actuator" => actuators(section, &context, robot, &mut out)?,
            "asset" => {
                for a in section
                    .children()
                    .filter(|a| !["mesh", "material"].contains(&a.name()))
                {
                    out.lost
                        .not_read(a.name(), a.attribute("name").or(a.attribute("file")));
                }
            }
            "sensor" | "tendon" | "contact" | "keyframe" | "deformable" | "custom" => {
                for c in section.children() {
                    out.lost.not_read(
                        &format!("{} of <{}>", c.name(), section.name()),
                        c.attribute("name"),
                    );
                }
            }
            other => out.lost.not_read(other, section.attribute("name")),
        }
    }
    Ok(out)
}

fn equalities(
    section: Element<'_>,
    context: &Context<'_>,
    joints: &BTreeMap<usize, usize>,
    out: &mut Payload,
) -> Result<(), ImportError> {
    for e in section.children() {
        let look = context.defaults.of(e, "equality", None)?;
        let own = look.words(&EQUALITY);
        if look.attribute("active").is_some_and(|(_, v)| v == "false") {
            out.lost.not_read("inactive equality", e.attribute("name"));
            continue;
        }
        match (e.name(), joints.get(&e.id)) {
            ("connect" | "weld", Some(&j)) => {
                // A weld that holds no turns is read as a ball.
                let ball = look
                    .attribute("torquescale")
                    .is_some_and(|(_, v)| v.trim() == "0");
                let own = own.into_iter().filter(|(k, _)| k != "torquescale" || !ball);
                out.closures.insert(j, own.collect());
            }
            ("joint", _) => {
                out.couplings.insert(
                    e.id,
                    own.into_iter()
                        .filter(|(k, _)| k != "torquescale")
                        .collect(),
                );
                let offset = e
                    .attribute("polycoef")
                    .and_then(|t| t.split_whitespace().next()?.parse::<f64>().ok());
                match (e.attribute("joint2"), offset) {
                    (Some(_), Some(x)) if x != 0.0 => {
                        out.offsets.insert(e.id, x);
                    }
                    _ => {}
                }
            }
            (other, _) => out
                .lost
                .not_read(&format!("{other} of <equality>"), e.attribute("name")),
        }
    }
    Ok(())
}

fn actuators(
    section: Element<'_>,
    context: &Context<'_>,
    robot: &Robot,
    out: &mut Payload,
) -> Result<(), ImportError> {
    for e in section.children() {
        let name = e.attribute("name");
        let joint = e
            .attribute("joint")
            .and_then(|n| robot.joints.iter().position(|p| p.id == n));
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
