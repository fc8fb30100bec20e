//! URDF: a tree of links and joints, with mimic joints, transmissions and the loop extensions in use.

use crate::file::problem::ImportError;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, X, Y, length};
use crate::model::joint_type::JointType;
use crate::robots::description::parts::{Part, Ratio, Robot, free};
use crate::robots::options::{Options, Reader};
use crate::robots::problem::{RobotProblem, known};
use crate::robots::xml::{Document, Element};

const TYPES: &str = "revolute, continuous, prismatic, fixed, planar, floating";

/// Reads a `<robot>`.
pub(crate) fn read(
    document: &mut Document,
    root: usize,
    _: Reader<'_>,
    _: &Options,
) -> Result<Robot, ImportError> {
    let root = document.element(root);
    let mut robot = Robot::new(root.attribute("name").unwrap_or("robot"));
    for e in root.named("link") {
        link(e, &mut robot)?;
    }
    // Every reader knows the world, and takes what hangs on it for fixed.
    let on_world = |j: Element<'_>| {
        let parent = j.child("parent");
        parent.is_some_and(|p| p.attribute("link") == Some("world"))
    };
    if robot.frame("world").is_none() && root.named("joint").any(on_world) {
        robot.link("world", RigidMotion::IDENTITY);
        robot.report.map("world");
    }
    for e in root.children() {
        e.room("joints", robot.joints.len())?;
        match e.name() {
            "link" => {}
            "joint" | "drake:joint" => joint(e, &mut robot)?,
            "loop_joint" => loop_joint(e, &mut robot)?,
            "drake:ball_constraint" => ball_constraint(e, &mut robot)?,
            "transmission" => {}
            other if other.starts_with("xacro:") => {
                let what = "a macro that is not expanded, and whatever it stands for is missing; run `xacro FILE` first";
                robot.report.approximate(&e.label(), what);
            }
            other => robot.report.drop(other, e.attribute("name")),
        }
    }
    for e in root.named("transmission") {
        transmission(e, &mut robot);
    }
    // By convention a root of this name is the ground.
    let world = robot.links.iter().position(|l| l == "world");
    let held = |w: &usize| robot.joints.iter().any(|j| j.links[1] == *w);
    robot.world = world.filter(|w| !held(w));
    Ok(robot)
}

fn link(e: Element<'_>, robot: &mut Robot) -> Result<(), ImportError> {
    let name = e.required("name")?;
    e.room("links", robot.links.len())?;
    if robot.frame(name).is_some() {
        return Err(e.fail(Some("name"), RobotProblem::Duplicate { element: e.label() }));
    }
    let l = robot.link(name, RigidMotion::IDENTITY);
    robot.said_by(l, e);
    for c in e.children() {
        if ["visual", "collision"].contains(&c.name()) {
            robot.shown.insert(l);
        }
        robot.report.drop(c.name(), None);
    }
    Ok(())
}

/// Marks the joints that a transmission drives.
fn transmission(e: Element<'_>, robot: &mut Robot) {
    for j in e.named("joint").filter_map(|j| j.attribute("name")) {
        match robot.joints.iter_mut().find(|p| p.id == j) {
            Some(p) => {
                p.drive = true;
                robot.report.drop("data of a transmission", Some(j));
            }
            None => robot.report.drop("transmission", Some(j)),
        }
    }
}

pub(crate) fn origin(e: Element<'_>) -> Result<RigidMotion, ImportError> {
    let Some(o) = e.child("origin") else {
        return Ok(RigidMotion::IDENTITY);
    };
    if let Some(q) = o.numbers::<4>("quat_xyzw")? {
        return Ok(RigidMotion::quaternion(
            o.vector("xyz", [0.0; 3])?,
            [q[3], q[0], q[1], q[2]],
        ));
    }
    Ok(RigidMotion::roll_pitch_yaw(
        o.vector("xyz", [0.0; 3])?,
        o.vector("rpy", [0.0; 3])?,
    ))
}

/// The link that a child element such as `<parent link="..."/>` names.
fn end(e: Element<'_>, tag: &str, robot: &Robot) -> Result<usize, ImportError> {
    let missing = || RobotProblem::Missing {
        element: e.label(),
        what: format!("<{tag} link=\"...\"/>"),
    };
    let c = e.child(tag).ok_or_else(|| e.fail(None, missing()))?;
    let name = c.required("link")?;
    robot
        .links
        .iter()
        .position(|l| l == name)
        .ok_or_else(|| c.fail(Some("link"), unknown_link(e, name, robot)))
}

fn unknown_link(e: Element<'_>, name: &str, robot: &Robot) -> RobotProblem {
    RobotProblem::UnknownName {
        element: e.label(),
        what: "link",
        name: name.to_owned(),
        known: known("links", robot.links.iter().map(String::as_str)),
    }
}

fn axis(e: Element<'_>) -> Result<Vector, ImportError> {
    let Some(a) = e.child("axis") else {
        return Ok(X);
    };
    let v = a.vector("xyz", X)?;
    if length(v) < 1e-9 {
        return Err(a.fail(
            Some("xyz"),
            RobotProblem::BadValue {
                element: e.label(),
                what: "the axis".to_owned(),
                found: a.attribute("xyz").unwrap_or("").to_owned(),
                want: "give a direction such as 0 0 1".to_owned(),
            },
        ));
    }
    Ok(v)
}

fn joint(e: Element<'_>, robot: &mut Robot) -> Result<(), ImportError> {
    let name = e.required("name")?;
    if robot.joints.iter().any(|j| j.id == name) {
        return Err(e.fail(Some("name"), RobotProblem::Duplicate { element: e.label() }));
    }
    let word = e.required("type")?;
    let links = [end(e, "parent", robot)?, end(e, "child", robot)?];
    if links[0] == links[1] {
        return Err(same_link(e));
    }
    let sides = [origin(e)?, RigidMotion::IDENTITY];
    let joint_type = match word {
        "revolute" | "continuous" => JointType::Revolute,
        "prismatic" => JointType::Prismatic,
        "fixed" => JointType::Fixed,
        "planar" => JointType::Planar,
        "floating" => free(),
        // Drake's own; its universal joint turns about x of the parent, then about y.
        "ball" if e.name() == "drake:joint" => JointType::Spherical,
        "universal" if e.name() == "drake:joint" => JointType::Universal,
        _ => return Err(unknown_type(e, word, TYPES)),
    };
    let mut part = Part::new(name, links, sides, joint_type).said_by(e);
    if matches!(word, "revolute" | "continuous" | "prismatic" | "planar") {
        part = part.about(axis(e)?);
    }
    if part.joint_type == JointType::Universal {
        (part.axis, part.second) = (X, Y);
    }
    if let Some(l) = e.child("limit").filter(|_| word != "continuous") {
        part.limits = limits(l)?;
    }
    robot.report.map(word);
    if let Some(m) = e.child("mimic") {
        let leader = m.required("joint")?;
        let ratio = m.numbers::<1>("multiplier")?.map_or(1.0, |[x]| x);
        m.numbers::<1>("offset")?;
        part.comment = Some(format!("mimics {leader} times {ratio}"));
        robot.couplings.push(Ratio {
            joints: [leader.to_owned(), name.to_owned()],
            ratio,
            element: e.label(),
            said_by: m.id,
            gear: false,
            higher: [0.0; 3],
        });
    }
    for c in e.children() {
        if !["origin", "parent", "child", "axis", "limit", "mimic"].contains(&c.name()) {
            robot.report.drop(c.name(), None);
        }
    }
    robot.joints.push(part);
    Ok(())
}

/// The limits of a joint, where it has any.
fn limits(e: Element<'_>) -> Result<Option<(f64, f64)>, ImportError> {
    // What is beyond all numbers that are read, 1e16 say, is no limit.
    let one = |k| match e.attribute(k).map(str::parse::<f64>) {
        Some(Ok(x)) if x.abs() > 1e9 => Ok(x.signum() * f64::INFINITY),
        _ => Ok(e.numbers::<1>(k)?.map_or(0.0, |[x]| x)),
    };
    let (low, high) = (one("lower")?, one("upper")?);
    let finite = low.is_finite() && high.is_finite();
    Ok((low < high && finite).then_some((low, high)))
}

pub(crate) fn same_link(e: Element<'_>) -> ImportError {
    e.fail(
        None,
        RobotProblem::Unsupported {
            element: e.label(),
            why: "it connects a link to itself".to_owned(),
            remedy: "name two different links".to_owned(),
        },
    )
}

pub(crate) fn unknown_type(e: Element<'_>, word: &str, types: &str) -> ImportError {
    e.fail(
        Some("type"),
        RobotProblem::UnknownWord {
            element: e.label(),
            what: "type",
            word: word.to_owned(),
            known: types.to_owned(),
        },
    )
}

/// `<loop_joint name type><link1 link xyz rpy/><link2 link xyz rpy/><axis/></loop_joint>`.
fn loop_joint(e: Element<'_>, robot: &mut Robot) -> Result<(), ImportError> {
    let name = e.required("name")?;
    let links = [end(e, "link1", robot)?, end(e, "link2", robot)?];
    if links[0] == links[1] {
        return Err(same_link(e));
    }
    let mut sides = [RigidMotion::IDENTITY; 2];
    for (side, tag) in sides.iter_mut().zip(["link1", "link2"]) {
        if let Some(c) = e.child(tag) {
            *side =
                RigidMotion::roll_pitch_yaw(c.vector("xyz", [0.0; 3])?, c.vector("rpy", [0.0; 3])?);
        }
    }
    let word = e.required("type")?;
    let joint_type = match word {
        "revolute" | "continuous" => JointType::Revolute,
        "prismatic" => JointType::Prismatic,
        "spherical" => JointType::Spherical,
        "fixed" => JointType::Fixed,
        _ => {
            return Err(unknown_type(
                e,
                word,
                "revolute, continuous, prismatic, spherical, fixed",
            ));
        }
    };
    let mut part = Part::new(name, links, sides, joint_type)
        .about(axis(e)?)
        .said_by(e);
    part.closes = true;
    robot.report.map("loop_joint");
    robot.joints.push(part);
    Ok(())
}

/// Drake's ball constraint: a point of one body held to a point of another.
pub(crate) fn ball_constraint(e: Element<'_>, robot: &mut Robot) -> Result<(), ImportError> {
    let (mut links, mut sides) = ([0; 2], [RigidMotion::IDENTITY; 2]);
    for (i, (body, point)) in [("A", "p_AP"), ("B", "p_BQ")].into_iter().enumerate() {
        let part = |k: &str| {
            let tag = format!("drake:ball_constraint_{k}");
            let missing = RobotProblem::Missing {
                element: e.label(),
                what: format!("<{tag}>"),
            };
            e.child(&tag).ok_or_else(|| e.fail(None, missing))
        };
        let b = part(&format!("body_{body}"))?;
        let name = b.attribute("name").unwrap_or_else(|| b.text());
        let (link, frame) = robot
            .frame(name)
            .ok_or_else(|| b.fail(Some("name"), unknown_link(e, name, robot)))?;
        let p = part(point)?;
        let at = match p.numbers::<3>("value")? {
            Some(v) => v,
            None => p.text_numbers()?,
        };
        links[i] = link;
        sides[i] = frame.then(&RigidMotion::shift(at));
    }
    if links[0] == links[1] {
        return Err(same_link(e));
    }
    let id = format!("ball-{}-{}", robot.links[links[0]], robot.links[links[1]]);
    let mut part = Part::new(&id, links, sides, JointType::Spherical).said_by(e);
    part.closes = true;
    robot.report.map("ball constraint");
    robot.joints.push(part);
    Ok(())
}
