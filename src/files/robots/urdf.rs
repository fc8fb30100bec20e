//! Reading, fixing and writing URDF: a tree of links and joints, with mimic joints, transmissions and the usual loop extensions.

pub(super) mod write;

use crate::robots::additions::{
    add_coupling, ball_constraint, leave_out, named_parts, read_gazebo,
};
use crate::robots::prelude::*;

/// The elements of a joint that are read.
const OF_JOINTS: [&str; 6] = ["origin", "parent", "child", "axis", "limit", "mimic"];
const TYPES: &str = "revolute, continuous, prismatic, fixed, planar, floating";
/// The types of Drake's own joints; its universal joint turns about x of the parent, then about y.
const DRAKE: &str = "ball, universal";
/// The types of joints that close loops.
const CLOSING: &str = "revolute, continuous, hinge, prismatic, slider, cylindrical, spherical, ball, point, fixed, weld";

/// Reads a `<robot>`.
pub(crate) fn read_urdf(input: Input<'_>) -> Read<Robot> {
    let root = input.document.element(input.root);
    let mut robot = Robot::new(root.attribute("name").unwrap_or("robot"));
    for e in root.children_named("link") {
        read_link(e, &mut robot)?;
    }
    // Every reader knows the world and treats it as fixed.
    let on_world = |j: Element<'_>| {
        let parent = j.first_child("parent");
        parent.is_some_and(|p| p.attribute("link") == Some("world"))
    };
    if robot.frame("world").is_none() && root.children_named("joint").any(on_world) {
        robot.add_link("world", RigidMotion::IDENTITY);
    }
    let mut unknown = Vec::new();
    for e in root.children() {
        e.check_room("joints", robot.joints.len())?;
        match e.name() {
            "link" => {}
            "joint" | "drake:joint" => read_joint(e, &mut robot)?,
            "loop_joint" => loop_joint(e, &mut robot)?,
            "drake:ball_constraint" => ball_constraint(e, &mut robot)?,
            "constraint" if has_ends(e) => read_constraint(e, &mut robot)?,
            "transmission" | "gazebo" | "ros2_control" => {}
            _ => unknown.push(e),
        }
    }
    read_gazebo(root, &mut robot)?;
    for e in root.children_named("ros2_control") {
        read_controlled(e, &mut robot)?;
    }
    for e in root.children_named("transmission") {
        read_transmission(e, &mut robot);
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

fn read_link(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let name = e.required_attribute("name")?;
    e.check_room("links", robot.links.len())?;
    if robot.frame(name).is_some() {
        return Err(e.duplicate_error());
    }
    let l = robot.add_link(name, RigidMotion::IDENTITY);
    if e.children().any(|c| c.is_one_of("visual collision")) {
        robot.shown.insert(l);
    }
    Ok(())
}

/// Records the joints that a transmission drives.
fn read_transmission(e: Element<'_>, robot: &mut Robot) {
    let driven = e.children_named("joint");
    for j in driven.filter_map(|j| j.attribute("name")) {
        let mut joints = robot.joints.iter_mut();
        if let Some(p) = joints.find(|p| p.id == j) {
            p.drive = true;
        }
    }
    // If there are more joints than actuators, they are coupled, unless they follow one another.
    let follows = |j: &String| robot.couplings.iter().any(|c| c.joints[1] == *j);
    let named = named_parts(e, None, robot).into_iter();
    let named = named.filter(|j| !follows(j));
    let joints = named.filter(|n| robot.joints.iter().any(|p| p.id == *n));
    let joints = joints.count();
    let actuators = e.children_named("actuator").count().max(1);
    for _ in actuators..joints {
        let what = format!(
            "it moves {joints} joints by {actuators}; the coupling (1 row) is omitted; write it as a <mimic>"
        );
        robot.report.leave_out(&e.label(), 1, what);
    }
}

/// Reads the joints that a controller makes follow others: `<param name="mimic">`.
fn read_controlled(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    for j in e.children_named("joint") {
        let param = |name: &str| {
            let mut all = j.children_named("param");
            all.find(|p| p.attribute("name") == Some(name))
        };
        if let (Some(leader), Some(follower)) = (param("mimic"), j.attribute("name")) {
            let ratio = param("multiplier").map(|m| m.text_numbers::<1>());
            let ratio = ratio.transpose()?.map_or(1.0, |[x]| x);
            add_coupling(j, [leader.text(), follower], ratio, robot);
        }
    }
    Ok(())
}

/// Returns true if an element names a parent and a child, like a joint.
fn has_ends(e: Element<'_>) -> bool {
    let link = |tag: &str| e.first_child(tag).and_then(|c| c.attribute("link"));
    link("parent").is_some() && link("child").is_some()
}

/// Reads `<constraint name type>` with a link, a place and an axis on either side: `parent`, `parent_origin`, `parent_axis`, and
/// those of the child.
fn read_constraint(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let links = [end_link(e, "parent", robot)?, end_link(e, "child", robot)?];
    let word = e.attribute("type").unwrap_or("");
    let Some(joint_type) = joint_of_word(word, CLOSING) else {
        leave_out(e, None, robot);
        return Ok(());
    };
    let mut sides = [RigidMotion::IDENTITY; 2];
    for (side, tag) in sides.iter_mut().zip(["parent", "child"]) {
        let axis = match e.first_child(&format!("{tag}_axis")) {
            Some(a) => read_direction(e, a)?,
            None => read_axis(e)?,
        };
        let at = e.first_child(&format!("{tag}_origin"));
        let at = at.map_or(Ok(RigidMotion::IDENTITY), read_place)?;
        *side = at.then(&RigidMotion::z_to(axis));
    }
    let [a, b] = links.map(|l| &robot.links[l]);
    let unnamed = || format!("constraint-{a}-{b}");
    let id = e.attribute("name").map_or_else(unnamed, str::to_owned);
    let ends = [(links[0], sides[0]), (links[1], sides[1])];
    robot.close_loop(e, &id, ends, joint_type)?;
    Ok(())
}

pub(crate) fn read_origin(e: Element<'_>) -> Read<RigidMotion> {
    let Some(o) = e.first_child("origin") else {
        return Ok(RigidMotion::IDENTITY);
    };
    read_place(o)
}

/// Returns the placement that an element with `xyz` and `rpy` gives.
fn read_place(o: Element<'_>) -> Read<RigidMotion> {
    let at = o.read_vector("xyz", [0.0; 3])?;
    if let Some(q) = o.read_numbers::<4>("quat_xyzw")? {
        let q = [q[3], q[0], q[1], q[2]];
        return Ok(RigidMotion::from_quaternion(at, q));
    }
    let turn = o.read_vector("rpy", [0.0; 3])?;
    Ok(RigidMotion::roll_pitch_yaw(at, turn))
}

/// Returns the link that a child element such as `<parent link="..."/>` names.
fn end_link(e: Element<'_>, tag: &str, robot: &Robot) -> Read<usize> {
    let missing = || e.missing_error(&format!("<{tag} link=\"...\"/>"));
    named_link(e, e.first_child(tag).ok_or_else(missing)?, robot)
}

/// Returns the link that `c`, a child of `e`, names.
fn named_link(e: Element<'_>, c: Element<'_>, robot: &Robot) -> Read<usize> {
    let name = c.required_attribute("link")?;
    let found = robot.link_named(&e.label(), name);
    found.map_err(|p| c.error_at(Some("link"), p))
}

fn read_axis(e: Element<'_>) -> Read<Vector> {
    e.first_child("axis")
        .map_or(Ok(X), |a| read_direction(e, a))
}

/// Returns the direction that an element of `e` gives; x by default.
fn read_direction(e: Element<'_>, a: Element<'_>) -> Read<Vector> {
    let v = a.read_vector("xyz", X)?;
    if length(v) < 1e-9 {
        let (found, want) = (a.attribute("xyz"), "give a direction such as 0 0 1");
        let problem = bad_value(&e.label(), "the axis", found.unwrap_or(""), want);
        return Err(a.error_at(Some("xyz"), problem));
    }
    Ok(v)
}

fn read_joint(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let name = e.required_attribute("name")?;
    if robot.joints.iter().any(|j| j.id == name) {
        return Err(e.duplicate_error());
    }
    let word = e.required_attribute("type")?;
    let links = [end_link(e, "parent", robot)?, end_link(e, "child", robot)?];
    if links[0] == links[1] {
        return Err(same_link(e));
    }
    let sides = [read_origin(e)?, RigidMotion::IDENTITY];
    let drake = joint_of_word(word, DRAKE).filter(|_| e.name() == "drake:joint");
    let joint_type = joint_of_word(word, TYPES).or(drake);
    let joint_type = joint_type.ok_or_else(|| e.unknown_word("type", word, TYPES))?;
    let mut part = Part::new(name, links, sides, joint_type).said_by(e);
    if matches!(word, "revolute" | "continuous" | "prismatic" | "planar") {
        part.set_axis(read_axis(e)?);
    }
    if part.joint_type == JointType::Universal {
        (part.axis, part.second) = (X, Y);
    }
    if let Some(l) = e.first_child("limit").filter(|_| word != "continuous") {
        part.limits = read_limits(l)?;
    }
    if let Some(m) = e.first_child("mimic") {
        let leader = m.required_attribute("joint")?;
        let ratio = m.read_numbers::<1>("multiplier")?.map_or(1.0, |[x]| x);
        m.read_numbers::<1>("offset")?;
        robot.couplings.push(Ratio {
            said_by: m.id,
            ..Ratio::new([leader, name], ratio, e)
        });
    }
    robot.joints.push(part);
    Ok(())
}

/// Returns the limits of a joint, if it has any.
fn read_limits(e: Element<'_>) -> Read<Option<(f64, f64)>> {
    // A number beyond the allowed range, such as 1e16, means no limit.
    let one = |k| match e.attribute(k).map(str::parse::<f64>) {
        Some(Ok(x)) if x.abs() > 1e9 => Ok(x.signum() * f64::INFINITY),
        _ => Ok(e.read_numbers::<1>(k)?.map_or(0.0, |[x]| x)),
    };
    let (low, high) = (one("lower")?, one("upper")?);
    let finite = low.is_finite() && high.is_finite();
    Ok((low < high && finite).then_some((low, high)))
}

/// Reads `<loop_joint name type><link1 link xyz rpy/><link2 link xyz rpy/><axis/></loop_joint>`.
fn loop_joint(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let name = e.required_attribute("name")?;
    // A vendor prints its sample with two <link1>: the second is meant to be <link2>.
    let is_end = |c: &Element<'_>| ["link1", "link2"].contains(&c.name());
    let mut ends: Vec<Element<'_>> = e.children().filter(is_end).collect();
    ends.sort_by_key(|c| c.name());
    let [first, second] = ends[..] else {
        let what = "<link1 link=\"...\"/> and <link2 link=\"...\"/>, one of each";
        return Err(e.missing_error(what));
    };
    let links = [named_link(e, first, robot)?, named_link(e, second, robot)?];
    let [one, two] = links;
    let ends = [(one, read_place(first)?), (two, read_place(second)?)];
    let word = e.required_attribute("type")?;
    let joint_type = joint_of_word(word, CLOSING);
    let joint_type = joint_type.ok_or_else(|| e.unknown_word("type", word, CLOSING))?;
    let axis = read_axis(e)?;
    let part = robot.close_loop(e, name, ends, joint_type)?;
    part.set_axis(axis);
    Ok(())
}
