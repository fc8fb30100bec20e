//! Reading, fixing and writing URDF: a tree of links and joints, with mimic joints, transmissions and the usual loop extensions.

pub(super) mod write;

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, X, Y, length};
use crate::model::joint_type::JointType;
use crate::robots::additions::{ball_constraint, couple, leave_out, named, read_gazebo};
use crate::robots::description::{Part, Ratio, Robot, free, same_link};
use crate::robots::warning::{Options, Reader};
use crate::robots::warning::{Read, bad_value, known, unknown_name};
use crate::robots::xml::Document;
use crate::robots::xml::element::Element;

/// The elements of a joint that are read.
const OF_JOINTS: [&str; 6] = ["origin", "parent", "child", "axis", "limit", "mimic"];
const TYPES: &str = "revolute, continuous, prismatic, fixed, planar, floating";

/// Reads a `<robot>`.
pub(crate) fn read(
    document: &mut Document,
    root: usize,
    _: Reader<'_>,
    _: &Options,
) -> Read<Robot> {
    let root = document.element(root);
    let mut robot = Robot::new(root.attribute("name").unwrap_or("robot"));
    for e in root.named("link") {
        link(e, &mut robot)?;
    }
    // Every reader knows the world and treats it as fixed.
    let on_world = |j: Element<'_>| {
        let parent = j.child("parent");
        parent.is_some_and(|p| p.attribute("link") == Some("world"))
    };
    if robot.frame("world").is_none() && root.named("joint").any(on_world) {
        robot.link("world", RigidMotion::IDENTITY);
        robot.report.map("world");
    }
    let mut unknown = Vec::new();
    for e in root.children() {
        e.room("joints", robot.joints.len())?;
        match e.name() {
            "link" => {}
            "joint" | "drake:joint" => joint(e, &mut robot)?,
            "loop_joint" => loop_joint(e, &mut robot)?,
            "drake:ball_constraint" => ball_constraint(e, &mut robot)?,
            "constraint" if has_ends(e) => constraint(e, &mut robot)?,
            "transmission" | "gazebo" | "ros2_control" => {}
            _ => unknown.push(e),
        }
    }
    read_gazebo(root, &mut robot)?;
    for e in root.named("ros2_control") {
        controlled(e, &mut robot)?;
    }
    for e in root.named("transmission") {
        transmission(e, &mut robot);
    }
    // The names of all links and joints decide whether they could constrain anything.
    for e in unknown {
        leave_out(e, None, &mut robot);
    }
    for e in root.children().filter(|e| e.name() == "joint") {
        let inside = e.children().filter(|c| !OF_JOINTS.contains(&c.name()));
        inside.for_each(|c| leave_out(c, e.attribute("name"), &mut robot));
    }
    // By convention a root of this name is the ground.
    let world = robot.links.iter().position(|l| l == "world");
    let held = |w: &usize| robot.joints.iter().any(|j| j.links[1] == *w);
    robot.world = world.filter(|w| !held(w));
    Ok(robot)
}

fn link(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let name = e.required("name")?;
    e.room("links", robot.links.len())?;
    if robot.frame(name).is_some() {
        return Err(e.duplicate());
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

/// Records the joints that a transmission drives.
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
    // If there are more joints than actuators, they are coupled, unless they follow one another.
    let follows = |j: &String| robot.couplings.iter().any(|c| c.joints[1] == *j);
    let named = named(e, None, robot).into_iter().filter(|j| !follows(j));
    let joints = named
        .filter(|n| robot.joints.iter().any(|p| p.id == *n))
        .count();
    let actuators = e.named("actuator").count().max(1);
    for _ in actuators..joints {
        let what = format!(
            "it moves {joints} joints by {actuators}; the coupling (1 row) is omitted; write it as a <mimic>"
        );
        robot.report.leave_out_coupling(&e.label(), what);
    }
}

/// Reads the joints that a controller makes follow others: `<param name="mimic">`.
fn controlled(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    for j in e.named("joint") {
        let param = |name: &str| {
            let mut all = j.named("param");
            all.find(|p| p.attribute("name") == Some(name))
        };
        if let (Some(leader), Some(follower)) = (param("mimic"), j.attribute("name")) {
            let ratio = param("multiplier").map(|m| m.text_numbers::<1>());
            let ratio = ratio.transpose()?.map_or(1.0, |[x]| x);
            couple(j, [leader.text(), follower], ratio, robot);
        }
    }
    robot.report.drop(e.name(), e.attribute("name"));
    Ok(())
}

/// Returns true if an element names a parent and a child, like a joint.
fn has_ends(e: Element<'_>) -> bool {
    let link = |tag: &str| e.child(tag).and_then(|c| c.attribute("link"));
    link("parent").is_some() && link("child").is_some()
}

/// Reads `<constraint name type>` with a link, a place and an axis on either side: `parent`, `parent_origin`, `parent_axis`, and
/// those of the child.
fn constraint(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let links = [end(e, "parent", robot)?, end(e, "child", robot)?];
    if links[0] == links[1] {
        return Err(same_link(e));
    }
    let word = e.attribute("type").unwrap_or("");
    let Some(joint_type) = closing_type(word) else {
        leave_out(e, None, robot);
        return Ok(());
    };
    let mut sides = [RigidMotion::IDENTITY; 2];
    for (side, tag) in sides.iter_mut().zip(["parent", "child"]) {
        let axis = match e.child(&format!("{tag}_axis")) {
            Some(a) => direction(e, a)?,
            None => axis(e)?,
        };
        let at = e.child(&format!("{tag}_origin"));
        let at = at.map_or(Ok(RigidMotion::IDENTITY), place)?;
        *side = at.then(&RigidMotion::z_to(axis));
    }
    let id = match e.attribute("name") {
        Some(name) => name.to_owned(),
        None => format!(
            "constraint-{}-{}",
            robot.links[links[0]], robot.links[links[1]]
        ),
    };
    let ends = [(links[0], sides[0]), (links[1], sides[1])];
    let part = Part::closing(e, &id, ends, joint_type)?;
    robot.report.map("constraint");
    robot.joints.push(part);
    Ok(())
}

/// Returns the joint that closes a loop, by its word.
fn closing_type(word: &str) -> Option<JointType> {
    Some(match word {
        "revolute" | "continuous" | "hinge" => JointType::Revolute,
        "prismatic" | "slider" => JointType::Prismatic,
        "cylindrical" => JointType::Cylindrical,
        "spherical" | "ball" | "point" => JointType::Spherical,
        "fixed" | "weld" => JointType::Fixed,
        _ => return None,
    })
}

pub(crate) fn origin(e: Element<'_>) -> Read<RigidMotion> {
    let Some(o) = e.child("origin") else {
        return Ok(RigidMotion::IDENTITY);
    };
    place(o)
}

/// Returns the placement that an element with `xyz` and `rpy` gives.
fn place(o: Element<'_>) -> Read<RigidMotion> {
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

/// Returns the link that a child element such as `<parent link="..."/>` names.
fn end(e: Element<'_>, tag: &str, robot: &Robot) -> Read<usize> {
    let missing = || e.missing(&format!("<{tag} link=\"...\"/>"));
    named_link(e, e.child(tag).ok_or_else(missing)?, robot)
}

/// Returns the link that `c`, a child of `e`, names.
fn named_link(e: Element<'_>, c: Element<'_>, robot: &Robot) -> Read<usize> {
    let name = c.required("link")?;
    robot.links.iter().position(|l| l == name).ok_or_else(|| {
        let known = known("links", &robot.links);
        c.fail(Some("link"), unknown_name(&e.label(), "link", name, &known))
    })
}

fn axis(e: Element<'_>) -> Read<Vector> {
    e.child("axis").map_or(Ok(X), |a| direction(e, a))
}

/// Returns the direction that an element of `e` gives; x by default.
fn direction(e: Element<'_>, a: Element<'_>) -> Read<Vector> {
    let v = a.vector("xyz", X)?;
    if length(v) < 1e-9 {
        let (found, want) = (
            a.attribute("xyz").unwrap_or(""),
            "give a direction such as 0 0 1",
        );
        return Err(a.fail(Some("xyz"), bad_value(&e.label(), "the axis", found, want)));
    }
    Ok(v)
}

fn joint(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let name = e.required("name")?;
    if robot.joints.iter().any(|j| j.id == name) {
        return Err(e.duplicate());
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
        _ => return Err(e.unknown_word("type", word, TYPES)),
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
            said_by: m.id,
            ..Ratio::new([leader, name], ratio, e)
        });
    }
    robot.joints.push(part);
    Ok(())
}

/// Returns the limits of a joint, if it has any.
fn limits(e: Element<'_>) -> Read<Option<(f64, f64)>> {
    // A number beyond the allowed range, such as 1e16, means no limit.
    let one = |k| match e.attribute(k).map(str::parse::<f64>) {
        Some(Ok(x)) if x.abs() > 1e9 => Ok(x.signum() * f64::INFINITY),
        _ => Ok(e.numbers::<1>(k)?.map_or(0.0, |[x]| x)),
    };
    let (low, high) = (one("lower")?, one("upper")?);
    let finite = low.is_finite() && high.is_finite();
    Ok((low < high && finite).then_some((low, high)))
}

/// Reads `<loop_joint name type><link1 link xyz rpy/><link2 link xyz rpy/><axis/></loop_joint>`.
fn loop_joint(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let name = e.required("name")?;
    // A vendor prints its sample with two <link1>: the second is meant to be <link2>.
    let ends = e
        .children()
        .filter(|c| ["link1", "link2"].contains(&c.name()));
    let mut ends: Vec<Element<'_>> = ends.collect();
    ends.sort_by_key(|c| c.name());
    let [first, second] = ends[..] else {
        let what = "<link1 link=\"...\"/> and <link2 link=\"...\"/>, one of each";
        return Err(e.missing(what));
    };
    let links = [named_link(e, first, robot)?, named_link(e, second, robot)?];
    let ends = [(links[0], place(first)?), (links[1], place(second)?)];
    let word = e.required("type")?;
    let joint_type = closing_type(word).ok_or_else(|| {
        let known = "revolute, continuous, prismatic, cylindrical, spherical, fixed";
        e.unknown_word("type", word, known)
    })?;
    let part = Part::closing(e, name, ends, joint_type)?.about(axis(e)?);
    robot.report.map("loop_joint");
    robot.joints.push(part);
    Ok(())
}
