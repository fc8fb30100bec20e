//! Equality constraints: the loops and couplings of MJCF.

use crate::file::problem::ImportError;
use crate::geom::rigid::RigidMotion;
use crate::model::joint_type::JointType;
use crate::robots::description::kinematics::displacement;
use crate::robots::description::parts::{Part, Ratio, Robot};
use crate::robots::mjcf::context::Context;
use crate::robots::problem::{RobotProblem, known};
use crate::robots::urdf::read::same_link;
use crate::robots::xml::Element;

pub(crate) fn read(
    section: Element<'_>,
    context: &Context<'_>,
    robot: &mut Robot,
) -> Result<(), ImportError> {
    for (i, e) in section.children().enumerate() {
        e.room("joints", robot.joints.len())?;
        let look = context.defaults.of(e, "equality", None)?;
        let id = match e.attribute("name") {
            Some(n) => n.to_owned(),
            None => format!("{}-{}", e.name(), i + 1),
        };
        if look.attribute("active").is_some_and(|(_, v)| v == "false") {
            robot.report.drop("inactive equality", Some(&id));
            continue;
        }
        match e.name() {
            "connect" => {
                let ends = ends(e, context, robot)?;
                closing(e, &id, ends, JointType::Spherical, robot)?;
            }
            "weld" => {
                let ends = ends(e, context, robot)?;
                let scale = look.numbers::<1>("torquescale")?;
                if scale == Some([0.0]) {
                    // Nothing holds its turns: a ball at its anchor, which is given in the second body.
                    let at = RigidMotion::shift(look.vector("anchor", [0.0; 3])?);
                    let [(one, first), (two, second)] = ends;
                    let ends = match e.attribute("site1") {
                        Some(_) => ends,
                        None => [(one, first.then(&second.inverse()).then(&at)), (two, at)],
                    };
                    closing(e, &id, ends, JointType::Spherical, robot)?;
                } else {
                    closing(e, &id, ends, JointType::Fixed, robot)?;
                }
            }
            "joint" => coupling(e, robot)?,
            "tendon" => {
                robot.report.coupling_rows += 1;
                robot.report.approximate(
                    &e.label(),
                    "an equality of tendon lengths (1 row) is left out",
                );
            }
            "flex" | "flexvert" | "flexstrain" => {
                let what = "it holds a deformable body, which is left out";
                robot.report.approximate(&e.label(), what);
            }
            "distance" => {
                return Err(e.unsupported("it is not a joint", "remove it"));
            }
            other => robot.report.drop(other, e.attribute("name")),
        }
    }
    Ok(())
}

type End = (usize, RigidMotion);

fn ends(e: Element<'_>, context: &Context<'_>, robot: &Robot) -> Result<[End; 2], ImportError> {
    if e.attribute("site1").is_some() || e.attribute("site2").is_some() {
        let site = |key: &'static str| {
            let name = e.required(key)?;
            context.sites.get(name).copied().ok_or_else(|| {
                let known = known("sites", context.sites.keys().map(String::as_str));
                unknown(e, key, "site", name, known)
            })
        };
        return Ok([site("site1")?, site("site2")?]);
    }
    let body = |key: &'static str| {
        let name = if key == "body2" {
            e.attribute(key).unwrap_or("world")
        } else {
            e.required(key)?
        };
        robot.links.iter().position(|l| l == name).ok_or_else(|| {
            let known = known("bodies", robot.links.iter().map(String::as_str));
            unknown(e, key, "body", name, known)
        })
    };
    let (one, two) = (body("body1")?, body("body2")?);
    let as_drawn = |at: RigidMotion| {
        robot.places[two]
            .inverse()
            .then(&robot.places[one].then(&at))
    };
    if e.name() == "connect" {
        e.required("anchor")?;
        let at = RigidMotion::shift(e.vector("anchor", [0.0; 3])?);
        return Ok([(one, at), (two, as_drawn(at))]);
    }
    // The place of body 2 in body 1; a zero quaternion stands for that of the model as drawn.
    match e.numbers::<7>("relpose")? {
        Some([x, y, z, quat @ ..]) if quat != [0.0; 4] => Ok([
            (one, RigidMotion::quaternion([x, y, z], quat)),
            (two, RigidMotion::IDENTITY),
        ]),
        _ => Ok([
            (one, RigidMotion::IDENTITY),
            (two, as_drawn(RigidMotion::IDENTITY)),
        ]),
    }
}

fn unknown(
    e: Element<'_>,
    key: &str,
    what: &'static str,
    name: &str,
    known: String,
) -> ImportError {
    let (element, name) = (e.label(), name.to_owned());
    e.fail(
        Some(key),
        RobotProblem::UnknownName {
            element,
            what,
            name,
            known,
        },
    )
}

fn closing(
    e: Element<'_>,
    id: &str,
    ends: [End; 2],
    joint_type: JointType,
    robot: &mut Robot,
) -> Result<(), ImportError> {
    let links = ends.map(|x| x.0);
    if links[0] == links[1] {
        return Err(same_link(e));
    }
    let mut part = Part::new(id, links, ends.map(|x| x.1), joint_type).said_by(e);
    part.closes = true;
    part.comment = Some(format!("closes a loop: <{}>", e.name()));
    robot.report.map(e.name());
    robot.joints.push(part);
    Ok(())
}

fn coupling(e: Element<'_>, robot: &mut Robot) -> Result<(), ImportError> {
    let mut names = vec![e.required("joint1")?];
    names.extend(e.attribute("joint2"));
    for (name, key) in names.iter().zip(["joint1", "joint2"]) {
        if !robot.joints.iter().any(|j| j.id == *name) {
            let known = known("joints", robot.joints.iter().map(|j| j.id.as_str()));
            return Err(unknown(e, key, "joint", name, known));
        }
    }
    let element = e.label();
    let left_out = |robot: &mut Robot, what: String| {
        robot.report.coupling_rows += 1;
        robot.report.approximate(&element, what);
    };
    let [a, b] = names[..] else {
        // The joint stands at a constant: it is rigid.
        let [value, ..] = polynomial(e)?;
        let one = |j: &&mut Part| j.id == names[0] && j.values.len() == 1;
        match robot.joints.iter_mut().find(one) {
            Some(j) => {
                j.values = vec![value];
                j.sides[0] = j.sides[0].then(&displacement(j));
                (j.joint_type, j.values, j.limits) = (JointType::Fixed, Vec::new(), None);
                j.comment = Some("held at a constant by an equality".to_owned());
                robot.report.map("joint held at a constant");
            }
            None => {
                let what = format!("{} can move; its equality is left out", names[0]);
                left_out(robot, what);
            }
        }
        return Ok(());
    };
    // Value of joint 1 less its reference, as a polynomial of that of joint 2 less its own.
    let [_, ratio, higher @ ..] = polynomial(e)?;
    if higher != [0.0; 3] {
        comment(a, &format!("coupled to {b} by a polynomial"), robot);
    } else {
        comment(a, &format!("coupled to {b} times {ratio}"), robot);
    }
    robot.couplings.push(Ratio {
        joints: [b.to_owned(), a.to_owned()],
        ratio,
        element,
        said_by: e.id,
        gear: false,
        higher,
    });
    Ok(())
}

fn comment(joint: &str, what: &str, robot: &mut Robot) {
    if let Some(j) = robot.joints.iter_mut().find(|j| j.id == joint) {
        j.comment = Some(what.to_owned());
    }
}

/// The five coefficients of `polycoef`, lowest first; those left out are as MuJoCo has them, 0 1 0 0 0.
fn polynomial(e: Element<'_>) -> Result<[f64; 5], ImportError> {
    let mut out = [0.0, 1.0, 0.0, 0.0, 0.0];
    let Some(text) = e.attribute("polycoef") else {
        return Ok(out);
    };
    let words: Vec<&str> = text.split_whitespace().collect();
    let read: Option<Vec<f64>> = words
        .iter()
        .map(|w| w.parse::<f64>().ok().filter(|x| x.abs() <= 1e9))
        .collect();
    match read {
        Some(read) if read.len() <= out.len() => {
            out[..read.len()].copy_from_slice(&read);
            Ok(out)
        }
        _ => Err(e.fail(
            Some("polycoef"),
            RobotProblem::BadValue {
                element: e.label(),
                what: "polycoef".to_owned(),
                found: text.to_owned(),
                want: "give at most 5 finite numbers".to_owned(),
            },
        )),
    }
}
