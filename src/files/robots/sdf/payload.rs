//! What the links and joints of an SDF file carry.

use crate::file::problem::ImportError;
use crate::geom::rigid::RigidMotion;
use crate::robots::convert::payload::{Dynamics, LinkShape, Payload, Solid, Use, Weight, Words};
use crate::robots::description::parts::Robot;
use crate::robots::sdf::read::pose;
use crate::robots::xml::Element;

/// What is more than this is a bound in name only.
const ENDLESS: f64 = 1e9;

/// Reads it; the robot is that of the same document.
pub(crate) fn read(root: Element<'_>, robot: &Robot) -> Result<Payload, ImportError> {
    let mut out = Payload::default();
    let mut stack: Vec<(Element<'_>, String)> = Vec::new();
    let mut models: Vec<Element<'_>> = root.named("model").collect();
    for w in root.named("world") {
        models.extend(w.named("model"));
        for e in w.children() {
            match e.name() {
                "joint" => joint(e, robot, &mut out)?,
                "model" | "frame" => {}
                other => out.lost.not_read(other, e.attribute("name")),
            }
        }
    }
    // The one model's names stand as they are.
    let alone = models.len() == 1
        && root
            .named("world")
            .all(|w| w.child("joint").or(w.child("frame")).is_none());
    for m in models {
        let scope = match (alone, m.attribute("name")) {
            (false, Some(n)) => format!("{n}::"),
            _ => String::new(),
        };
        stack.push((m, scope));
    }
    while let Some((m, scope)) = stack.pop() {
        for e in m.children() {
            match e.name() {
                "link" => {
                    if let Some(&l) = robot.said.get(&e.id) {
                        link(e, l, &scope, robot, &mut out)?;
                    }
                }
                "joint" => joint(e, robot, &mut out)?,
                "frame" => {
                    let name = format!("{scope}{}", e.attribute("name").unwrap_or(""));
                    if let Some((l, at)) = robot.frame(&name) {
                        out.frames.push((name, l, at));
                    }
                }
                "model" => {
                    stack.push((e, format!("{scope}{}::", e.attribute("name").unwrap_or(""))))
                }
                "pose" | "static" | "drake:weld_constraint" | "drake:ball_constraint" => {}
                other => out.lost.not_read(other, e.attribute("name")),
            }
        }
    }
    Ok(out)
}

/// A number between tags.
fn number(e: Option<Element<'_>>, tag: &str, default: f64) -> Result<f64, ImportError> {
    match e.and_then(|e| e.child(tag)) {
        Some(c) => {
            let endless = c.text().parse::<f64>().is_ok_and(|x| x.abs() > ENDLESS);
            if endless || c.text().is_empty() {
                Ok(default)
            } else {
                Ok(c.text_numbers::<1>()?[0])
            }
        }
        None => Ok(default),
    }
}

/// The place of something on its link; none where it is given in a frame that is not on it.
fn on_link(
    e: Element<'_>,
    l: usize,
    scope: &str,
    robot: &Robot,
) -> Result<Option<RigidMotion>, ImportError> {
    let (at, relative) = pose(e)?;
    Ok(match relative {
        None => Some(at),
        Some(r) => robot
            .frame(&format!("{scope}{r}"))
            .filter(|f| f.0 == l)
            .map(|f| f.1.then(&at)),
    })
}

fn link(
    e: Element<'_>,
    l: usize,
    scope: &str,
    robot: &Robot,
    out: &mut Payload,
) -> Result<(), ImportError> {
    let name = e.attribute("name");
    // Without a word a link weighs 1 kg.
    let mut weight = Weight {
        mass: 1.0,
        place: RigidMotion::IDENTITY,
        tensor: [1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
    };
    for c in e.children() {
        match c.name() {
            "inertial" => {
                weight.mass = number(Some(c), "mass", 1.0)?;
                match on_link(c, l, scope, robot)? {
                    Some(at) => weight.place = at,
                    None => out
                        .lost
                        .not_read("place of a mass in a frame of another link", name),
                }
                let keys = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
                for (i, (t, key)) in weight.tensor.iter_mut().zip(keys).enumerate() {
                    *t = number(c.child("inertia"), key, if i < 3 { 1.0 } else { 0.0 })?;
                }
            }
            "visual" | "collision" => {
                let place = on_link(c, l, scope, robot)?;
                match (place, solid(c)?) {
                    (Some(place), Some(solid)) => {
                        let shape = shape(c, place, solid)?;
                        out.shape(l, shape);
                    }
                    _ => out.lost.not_read("geometry of an unknown kind", name),
                }
            }
            "pose" | "must_be_base_link" => {}
            other => out
                .lost
                .not_read(&format!("{other} of a link"), c.attribute("name").or(name)),
        }
    }
    if l != 0 {
        out.weights.insert(l, weight);
    }
    Ok(())
}

fn solid(e: Element<'_>) -> Result<Option<Solid>, ImportError> {
    let Some(g) = e.child("geometry").and_then(|g| g.children().next()) else {
        return Ok(None);
    };
    let one = |tag: &str, d: f64| number(Some(g), tag, d);
    let vector = |tag: &str, d: f64| match g.child(tag) {
        Some(c) => c.text_numbers::<3>(),
        None => Ok([d; 3]),
    };
    Ok(Some(match g.name() {
        "box" => Solid::Box(vector("size", 1.0)?),
        "sphere" => Solid::Sphere(one("radius", 1.0)?),
        "cylinder" => Solid::Cylinder(one("radius", 1.0)?, one("length", 1.0)?),
        "capsule" => Solid::Capsule(one("radius", 0.5)?, one("length", 1.0)?),
        "ellipsoid" => Solid::Ellipsoid(vector("radii", 1.0)?),
        "plane" => match g.child("size") {
            Some(c) => Solid::Plane(c.text_numbers::<2>()?),
            None => Solid::Plane([1.0; 2]),
        },
        "mesh" => {
            let uri = g.child("uri").map_or("", |u| u.text());
            Solid::Mesh(uri.to_owned(), vector("scale", 1.0)?)
        }
        _ => return Ok(None),
    }))
}

fn shape(e: Element<'_>, mut place: RigidMotion, solid: Solid) -> Result<LinkShape, ImportError> {
    let colour = e.child("material").and_then(|m| m.child("diffuse"));
    let normal = e
        .child("geometry")
        .and_then(|g| g.child("plane"))
        .and_then(|p| p.child("normal"));
    if let Some(n) = normal {
        place = place.then(&RigidMotion::z_to(n.text_numbers::<3>()?));
    }
    Ok(LinkShape {
        name: e.attribute("name").map(str::to_owned),
        solid,
        place,
        colour: match colour {
            Some(c) => {
                let words: Vec<f64> = c
                    .text()
                    .split_whitespace()
                    .filter_map(|w| w.parse().ok())
                    .collect();
                match words[..] {
                    [r, g, b] => Some([r, g, b, 1.0]),
                    [r, g, b, a] => Some([r, g, b, a]),
                    _ => None,
                }
            }
            None => None,
        },
        use_: match e.name() {
            "visual" => Use::Seen,
            _ => Use::Touched,
        },
        words: Words::new(),
    })
}

fn joint(e: Element<'_>, robot: &Robot, out: &mut Payload) -> Result<(), ImportError> {
    let name = e.attribute("name");
    let own: Vec<usize> = (0..robot.joints.len())
        .filter(|&j| robot.joints[j].element == Some(e.id))
        .collect();
    let mut all = Vec::new();
    for a in ["axis", "axis2"].iter().filter_map(|tag| e.child(tag)) {
        let (dynamics, limit) = (a.child("dynamics"), a.child("limit"));
        let bound = |tag: &str| {
            let x = number(limit, tag, f64::INFINITY)?;
            Ok::<_, ImportError>(if x > 0.0 { x } else { f64::INFINITY })
        };
        all.push(Dynamics {
            damping: number(dynamics, "damping", 0.0)?,
            friction: number(dynamics, "friction", 0.0)?,
            stiffness: number(dynamics, "spring_stiffness", 0.0)?,
            rest: number(dynamics, "spring_reference", 0.0)?,
            effort: bound("effort")?,
            velocity: bound("velocity")?,
            ..Dynamics::default()
        });
        if let Some(m) = a.child("mimic") {
            let multiplier = number(Some(m), "multiplier", 1.0)?;
            let offset =
                number(Some(m), "offset", 0.0)? - multiplier * number(Some(m), "reference", 0.0)?;
            if offset != 0.0 {
                out.offsets.insert(m.id, offset);
            }
        }
    }
    for c in e
        .children()
        .filter(|c| ["physics", "sensor"].contains(&c.name()))
    {
        out.lost.not_read(&format!("{} of a joint", c.name()), name);
    }
    match own[..] {
        // Two hinges in series stand for oblique axes.
        [one, two] if all.len() == 2 => {
            out.dynamics.insert(one, vec![all[0].clone()]);
            out.dynamics.insert(two, vec![all[1].clone()]);
        }
        [one] if !all.is_empty() => {
            out.dynamics.insert(one, all);
        }
        _ => {}
    }
    Ok(())
}
