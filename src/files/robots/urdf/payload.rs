//! What the links and joints of a URDF carry.

use crate::file::problem::ImportError;
use crate::robots::convert::payload::{
    Actuator, Command, Dynamics, LinkShape, Payload, Solid, Use, Weight, Words,
};
use crate::robots::description::parts::Robot;
use crate::robots::urdf::read::origin;
use crate::robots::xml::Element;
use std::collections::BTreeMap;

/// What is more than this is a bound in name only.
const ENDLESS: f64 = 1e9;

/// Colours of materials by name.
type Materials<'a> = BTreeMap<&'a str, [f64; 4]>;

/// Reads it; the robot is that of the same document.
pub(crate) fn read(root: Element<'_>, robot: &Robot) -> Result<Payload, ImportError> {
    let mut out = Payload::default();
    let mut materials = Materials::new();
    let inside = root
        .named("link")
        .flat_map(|l| l.named("visual").collect::<Vec<_>>());
    let inside = inside.filter_map(|v| v.child("material"));
    for m in root.named("material").chain(inside) {
        if let (Some(name), Some(colour)) = (m.attribute("name"), colour(m)?) {
            materials.insert(name, colour);
        }
    }
    for e in root.children() {
        match e.name() {
            "link" => {
                if let Some(&l) = robot.said.get(&e.id) {
                    link(e, l, &materials, &mut out)?;
                }
            }
            "joint" | "drake:joint" => joint(e, robot, &mut out)?,
            "transmission" => transmission(e, robot, &mut out)?,
            "loop_joint" | "drake:ball_constraint" | "material" => {}
            other => out
                .lost
                .not_read(other, e.attribute("name").or(e.attribute("reference"))),
        }
    }
    Ok(out)
}

fn colour(m: Element<'_>) -> Result<Option<[f64; 4]>, ImportError> {
    m.child("color")
        .map_or(Ok(None), |c| c.numbers::<4>("rgba"))
}

fn link(
    e: Element<'_>,
    l: usize,
    materials: &Materials<'_>,
    out: &mut Payload,
) -> Result<(), ImportError> {
    let name = e.attribute("name");
    for c in e.children() {
        match c.name() {
            "inertial" => {
                if let Some(w) = inertial(c)? {
                    out.weights.insert(l, w);
                }
            }
            "visual" | "collision" => match shape(c, materials)? {
                Some(s) => {
                    if c.child("material")
                        .is_some_and(|m| m.child("texture").is_some())
                    {
                        out.lost.not_read("texture", name);
                    }
                    out.shape(l, s);
                }
                None => out.lost.not_read("geometry of an unknown kind", name),
            },
            other => out.lost.not_read(other, name),
        }
    }
    Ok(())
}

fn inertial(e: Element<'_>) -> Result<Option<Weight>, ImportError> {
    let mass = match e.child("mass") {
        Some(m) => m.numbers::<1>("value")?.map_or(0.0, |[x]| x),
        None => 0.0,
    };
    let mut tensor = [0.0; 6];
    if let Some(i) = e.child("inertia") {
        for (t, key) in tensor
            .iter_mut()
            .zip(["ixx", "iyy", "izz", "ixy", "ixz", "iyz"])
        {
            *t = i.numbers::<1>(key)?.map_or(0.0, |[x]| x);
        }
    }
    let place = origin(e)?;
    let weight = Weight {
        mass,
        place,
        tensor,
    };
    Ok((mass > 0.0 || tensor != [0.0; 6]).then_some(weight))
}

fn shape(e: Element<'_>, materials: &Materials<'_>) -> Result<Option<LinkShape>, ImportError> {
    let Some(g) = e.child("geometry").and_then(|g| g.children().next()) else {
        return Ok(None);
    };
    let one = |key: &str| Ok::<_, ImportError>(g.numbers::<1>(key)?.map_or(0.0, |[x]| x));
    let solid = match g.name() {
        "box" => Solid::Box(g.vector("size", [0.0; 3])?),
        "sphere" => Solid::Sphere(one("radius")?),
        "cylinder" => Solid::Cylinder(one("radius")?, one("length")?),
        "capsule" | "drake:capsule" => Solid::Capsule(one("radius")?, one("length")?),
        "drake:ellipsoid" => Solid::Ellipsoid([one("a")?, one("b")?, one("c")?]),
        "mesh" => Solid::Mesh(
            g.required("filename")?.to_owned(),
            g.vector("scale", [1.0; 3])?,
        ),
        _ => return Ok(None),
    };
    let colour = match e.child("material") {
        Some(m) => colour(m)?.or_else(|| materials.get(m.attribute("name")?).copied()),
        None => None,
    };
    Ok(Some(LinkShape {
        name: e.attribute("name").map(str::to_owned),
        solid,
        place: origin(e)?,
        colour,
        use_: match e.name() {
            "visual" => Use::Seen,
            _ => Use::Touched,
        },
        words: Words::new(),
    }))
}

fn joint(e: Element<'_>, robot: &Robot, out: &mut Payload) -> Result<(), ImportError> {
    let Some(j) = robot.joints.iter().position(|p| p.element == Some(e.id)) else {
        return Ok(());
    };
    let mut d = Dynamics::default();
    for c in e.children() {
        let one = |key: &str| Ok::<_, ImportError>(c.numbers::<1>(key)?.map(|[x]| x));
        match c.name() {
            "dynamics" => {
                d.damping = one("damping")?.unwrap_or(0.0);
                d.friction = one("friction")?.unwrap_or(0.0);
            }
            "limit" => {
                // What is beyond all numbers that are read is no bound, nor is what would hold the joint still.
                let bound = |key: &str| {
                    let x = c.attribute(key).and_then(|t| t.trim().parse::<f64>().ok());
                    x.filter(|x| *x > 0.0 && *x < ENDLESS)
                        .unwrap_or(f64::INFINITY)
                };
                (d.effort, d.velocity) = (bound("effort"), bound("velocity"));
            }
            "mimic" => {
                if let Some(x) = one("offset")?.filter(|x| *x != 0.0) {
                    out.offsets.insert(c.id, x);
                }
            }
            "origin" | "parent" | "child" | "axis" => {}
            other => out
                .lost
                .not_read(&format!("{other} of a joint"), e.attribute("name")),
        }
    }
    out.dynamics.insert(j, vec![d]);
    Ok(())
}

fn transmission(e: Element<'_>, robot: &Robot, out: &mut Payload) -> Result<(), ImportError> {
    let actuator = e.child("actuator");
    let named = |a: Element<'_>| a.attribute("name").map(str::to_owned);
    let text = |of: Option<Element<'_>>, tag: &str| {
        of.and_then(|x| x.child(tag)).map(|t| t.text().to_owned())
    };
    for c in e.named("joint") {
        let found = c
            .attribute("name")
            .and_then(|n| robot.joints.iter().position(|p| p.id == n));
        let Some(joint) = found else {
            out.lost
                .not_read("transmission of no joint", e.attribute("name"));
            continue;
        };
        let interface = text(Some(c), "hardwareInterface").or(text(actuator, "hardwareInterface"));
        let interface = interface.unwrap_or_default();
        let command = match interface {
            i if i.contains("Position") => Command::Position,
            i if i.contains("Velocity") => Command::Velocity,
            _ => Command::Effort,
        };
        let gear = text(actuator, "mechanicalReduction").and_then(|t| t.parse().ok());
        let name = actuator.and_then(named).or(named(e));
        out.actuators.push(Actuator {
            name,
            joint,
            command,
            gear: gear
                .filter(|g: &f64| g.is_finite() && *g != 0.0)
                .unwrap_or(1.0),
            tag: None,
            words: Words::new(),
        });
        if let Some(rotor) = actuator.and_then(|a| a.child("drake:rotor_inertia")) {
            let [x] = rotor.numbers::<1>("value")?.unwrap_or([0.0]);
            let ratio = match actuator.and_then(|a| a.child("drake:gear_ratio")) {
                Some(g) => g.numbers::<1>("value")?.map_or(1.0, |[x]| x),
                None => 1.0,
            };
            let own = out
                .dynamics
                .entry(joint)
                .or_insert_with(|| vec![Dynamics::default()]);
            own.iter_mut().for_each(|d| d.armature = x * ratio * ratio);
        }
    }
    Ok(())
}
