//! The joints and constraints of an SDF file.

use crate::robots::prelude::*;
use crate::robots::sdf::scene::{
    Scoped, SdfScene, absolute_name, joint_end, locate_name, of_joint,
};

pub(crate) const TYPES: &str = "revolute, continuous, hinge, prismatic, screw, universal, revolute2, ball, fixed, floating, gearbox";
/// Distance of a parent frame from the joint, as a fraction of the lengths in the file, beyond which the joint moves to it.
pub(crate) const APART: f64 = 1e-6;

/// Returns the direction of `<axis>` or `<axis2>` in the world.
pub(crate) fn read_axis(
    e: Element<'_>,
    tag: &str,
    scope: &str,
    scene: &SdfScene<'_>,
    at: &RigidMotion,
) -> Read<Vector> {
    let Some(a) = e.first_child(tag) else {
        return Err(e.missing_error(&format!("<{tag}>")));
    };
    let Some(xyz) = a.first_child("xyz") else {
        return Ok(at.map_direction(Z));
    };
    let v = xyz.text_numbers::<3>()?;
    if length(v) < 1e-9 {
        let want = "give a direction such as 0 0 1";
        return Err(xyz.error_at(None, bad_value(&e.label(), tag, xyz.text(), want)));
    }
    let in_model = a
        .first_child("use_parent_model_frame")
        .is_some_and(|u| ["true", "1"].contains(&u.text()))
        || scene.old_axes.get(e.node().source) == Some(&true);
    match xyz.attribute("expressed_in").filter(|f| !f.is_empty()) {
        Some("world") => Ok(v),
        Some(f) => Ok(locate_name(xyz, &absolute_name(scope, f), scene)?
            .1
            .map_direction(v)),
        // A joint between models is of the world.
        None if in_model && scope.is_empty() && !scene.placed.contains_key("__model__") => Ok(v),
        None if in_model => Ok(locate_name(xyz, &format!("{scope}__model__"), scene)?
            .1
            .map_direction(v)),
        None => Ok(at.map_direction(v)),
    }
}

pub(crate) fn read_joint(
    e: Element<'_>,
    scope: &str,
    scene: &SdfScene<'_>,
    size: f64,
    robot: &mut Robot,
) -> Read<()> {
    let name = format!("{scope}{}", e.required_attribute("name")?);
    let word = e.required_attribute("type")?;
    let (parent_tag, parent_name) = joint_end(e, "parent")?;
    let (child_tag, child_name) = joint_end(e, "child")?;
    let (parent, parent_world) =
        locate_name(parent_tag, &absolute_name(scope, parent_name), scene)?;
    let (child, _) = locate_name(child_tag, &absolute_name(scope, child_name), scene)?;
    if parent == child {
        return Err(same_link(e));
    }
    let world = of_joint(scene, e, &name).unwrap_or(RigidMotion::IDENTITY);
    let local = |d: Vector| world.inverse().map_direction(d);
    let joint_type = joint_of_word(word, TYPES);
    let joint_type = joint_type.ok_or_else(|| e.unknown_word("type", word, TYPES))?;
    let far = length(sub(parent_world.translation, world.translation));
    let apart = is_frame(&absolute_name(scope, parent_name), scene) && far > APART * size;
    let mut on_parent = world;
    if apart && scene.assemble {
        on_parent.translation = parent_world.translation;
    }
    let on = |link: usize, at: &RigidMotion| robot.places[link].inverse().then(at);
    let sides = [on(parent, &on_parent), on(child, &world)];
    let mut part = Part::new(&name, [parent, child], sides, joint_type).said_by(e);
    match word {
        "ball" | "fixed" | "floating" => {}
        "universal" | "revolute2" => {
            read_mimic(e, &name, scope, robot)?;
            let first = read_axis(e, "axis", scope, scene, &world)?;
            let second = read_axis(e, "axis2", scope, scene, &world)?;
            return two_axes(e, part, [local(first), local(second)], robot);
        }
        _ => part.set_axis(local(read_axis(e, "axis", scope, scene, &world)?)),
    }
    if word == "screw" {
        part.pitch = screw_pitch(e)?;
    }
    part.limits = read_limits(e)?.filter(|_| ["revolute", "prismatic"].contains(&word));
    if apart {
        told_apart(e, far, scene.assemble, robot);
    }
    read_mimic(e, &name, scope, robot)?;
    robot.joints.push(part);
    Ok(())
}

/// Returns true if a name is that of a frame rather than a link. If the parent is a frame away from the joint, the frame only
/// names its link by the specification, and the model is as drawn. If it is drawn in parts, the joint moves the child onto the
/// frame.
fn is_frame(name: &str, scene: &SdfScene<'_>) -> bool {
    scene.placed.get(name).is_some_and(|p| p.link.is_none())
}

/// Reports the distance, in metres, of a joint from its parent frame.
fn told_apart(e: Element<'_>, far: f64, assembled: bool, robot: &mut Robot) {
    let done = if assembled {
        "assembled"
    } else {
        "used as drawn, as SDF defines it (the option `assemble` moves the parts)"
    };
    let what = format!("its parent frame and the joint are {far:.3} m apart in the file; {done}");
    robot.report.add_approximation(&e.label(), what);
}

/// Records the coupling of a joint whose axis follows that of another.
fn read_mimic(e: Element<'_>, name: &str, scope: &str, robot: &mut Robot) -> Read<()> {
    // Drake's own has its numbers as attributes.
    let mimics = ["mimic", "drake:mimic"];
    let inside = e.children().flat_map(Element::children);
    let Some(m) = inside.into_iter().find(|m| mimics.contains(&m.name())) else {
        return Ok(());
    };
    let leader = absolute_name(scope, m.required_attribute("joint")?);
    let ratio = m.read_numbers::<1>("multiplier")?.map_or(1.0, |[x]| x);
    let ratio = m.child_number("multiplier")?.unwrap_or(ratio);
    robot.couplings.push(Ratio {
        said_by: m.id,
        ..Ratio::new([&leader, name], ratio, e)
    });
    Ok(())
}

pub(crate) fn read_limits(e: Element<'_>) -> Read<Option<(f64, f64)>> {
    let Some(l) = e.first_child("axis").and_then(|a| a.first_child("limit")) else {
        return Ok(None);
    };
    let one = |tag: &str| match l.first_child(tag) {
        // SDF writes 1e16 or infinity for no limit.
        Some(c) if ["inf", "-inf"].contains(&c.text()) => Ok(None),
        Some(c) => match c.text().parse::<f64>() {
            Ok(x) if x.abs() > 1e9 => Ok(None),
            _ => c.text_numbers::<1>().map(|[x]| Some(x)),
        },
        None => Ok(None),
    };
    Ok(one("lower")?
        .zip(one("upper")?)
        .filter(|(low, high)| low < high))
}

/// Metres per radian: `screw_thread_pitch` is metres per turn, `thread_pitch` minus radians per metre.
pub(crate) fn screw_pitch(e: Element<'_>) -> Read<f64> {
    if let Some(lead) = e.child_number("screw_thread_pitch")? {
        return Ok(lead / std::f64::consts::TAU);
    }
    let Some(p) = e.first_child("thread_pitch") else {
        return Err(e.missing_error("<screw_thread_pitch>"));
    };
    let [radians] = p.text_numbers::<1>()?;
    if radians.abs() < 1e-9 {
        let want = "give <screw_thread_pitch>, metres per turn";
        let problem = bad_value(&e.label(), "<thread_pitch>", p.text(), want);
        return Err(p.error_at(None, problem));
    }
    Ok(-1.0 / radians)
}

/// Reads a universal joint, or two revolute ones if the axes are not perpendicular.
fn two_axes(e: Element<'_>, mut part: Part, axes: [Vector; 2], robot: &mut Robot) -> Read<()> {
    let [first, second] = axes;
    let (a, b) = (unit_or_z(first), unit_or_z(second));
    if length(cross(a, b)) < 1e-9 {
        return Err(e.unsupported_error("its two axes are parallel", "give two directions"));
    }
    if dot(a, b).abs() < 1e-9 {
        (part.axis, part.second) = (first, second);
        robot.joints.push(part);
        return Ok(());
    }
    let between = robot.add_link(&format!("{}~1", part.id), RigidMotion::IDENTITY);
    let [parent, child] = part.links;
    // Axes that are not square: two hinges in series are the same.
    let [near, far] = part.sides;
    let mut hinge = |id: &str, links, sides, axis| {
        let mut part = Part::new(id, links, sides, JointType::Revolute).said_by(e);
        part.set_axis(axis);
        robot.joints.push(part);
    };
    let here = RigidMotion::IDENTITY;
    hinge(&part.id, [parent, between], [near, here], first);
    let second_id = format!("{}~2", part.id);
    hinge(&second_id, [between, child], [here, far], second);
    Ok(())
}

/// Reads Drake's weld of two frames.
pub(crate) fn read_weld(at: &Scoped<'_>, scene: &SdfScene<'_>, robot: &mut Robot) -> Read<()> {
    let (e, scope) = (at.0, at.1.as_str());
    let mut ends = [(0, RigidMotion::IDENTITY); 2];
    for (x, tag) in ends.iter_mut().zip(["parent", "child"]) {
        let (c, name) = joint_end(e, tag)?;
        let (link, world) = locate_name(c, &absolute_name(scope, name), scene)?;
        *x = (link, robot.places[link].inverse().then(&world));
    }
    let id = format!(
        "weld-{}-{}",
        joint_end(e, "parent")?.1,
        joint_end(e, "child")?.1
    );
    robot.close_loop(e, &id, ends, JointType::Fixed)?;
    Ok(())
}

/// Couples the hinges of the parent and of the child on the reference body: the child turns the other way, faster by the gear
/// ratio. If there are no such hinges, the gearbox is omitted and reported.
pub(crate) fn read_gearbox(at: &Scoped<'_>, scene: &SdfScene<'_>, robot: &mut Robot) -> Read<()> {
    let (e, scope) = (at.0, at.1.as_str());
    let name = format!("{scope}{}", e.required_attribute("name")?);
    let world = of_joint(scene, e, &name).unwrap_or(RigidMotion::IDENTITY);
    let times = e.child_number("gearbox_ratio")?.unwrap_or(1.0);
    let (_, on) = joint_end(e, "gearbox_reference_body")?;
    let (on, _) = locate_name(e, &absolute_name(scope, on), scene)?;
    let mut found = Vec::new();
    for (tag, way) in [("parent", "axis"), ("child", "axis2")] {
        let (c, link) = joint_end(e, tag)?;
        let (link, _) = locate_name(c, &absolute_name(scope, link), scene)?;
        let stated = e.first_child(way).is_some();
        let way = if stated { way } else { "axis" };
        let about = read_axis(e, way, scope, scene, &world)?;
        found.extend(find_hinge(robot, [on, link], about));
    }
    let [(leader, first), (follower, second)] = found[..] else {
        let what = "it needs a hinge of its parent and one of its child on its reference body, about its axes; its coupling (1 row) is omitted";
        robot.report.leave_out_coupling(&e.label(), what);
        return Ok(());
    };
    let id = |j: usize| robot.joints[j].id.clone();
    let [leads, follows] = [id(leader), id(follower)];
    robot.couplings.push(Ratio {
        gear: true,
        ..Ratio::new([&leads, &follows], -times * first * second, e)
    });
    Ok(())
}

/// Returns the hinge of a link on another about a direction, and the sign of its rotation about it.
fn find_hinge(robot: &Robot, [on, link]: [usize; 2], about: [f64; 3]) -> Option<(usize, f64)> {
    robot.joints.iter().enumerate().find_map(|(j, p)| {
        let sense = match p.links {
            ends if ends == [on, link] => 1.0,
            ends if ends == [link, on] => -1.0,
            _ => return None,
        };
        let own = robot.places[p.links[0]]
            .then(&p.sides[0])
            .map_direction(p.axis);
        let along = dot(own, about);
        let parallel = length(cross(own, about)) < 1e-6 * along.abs();
        let fits = p.joint_type == JointType::Revolute && parallel;
        fits.then_some((j, sense * along.signum()))
    })
}
