//! Reading, fixing and writing SDF: models with links, frames and joints, places relative to each other, loops closed by joints
//! as drawn.

pub(super) mod joints;
pub(super) mod scene;
pub(super) mod write;

use crate::robots::additions::{ball_constraint, leave_out, read_plugin};
use crate::robots::include::expand_models;
use crate::robots::prelude::*;
use crate::robots::sdf::joints::{read_gearbox, read_joint, read_weld};
use crate::robots::sdf::scene::{
    Placed, SdfScene, absolute_name, insert, moves_with, named_place, read_pose, resolve_places,
};

/// Reads an `<sdf>`.
pub(crate) fn read_sdf(mut input: Input<'_>) -> Read<Robot> {
    let included = expand_models(&mut input)?;
    let root = input.document.element(input.root);
    let mut robot = Robot::new("robot");
    robot.world = Some(robot.add_link("world", RigidMotion::IDENTITY));
    robot.floats = true;
    let mut scene = SdfScene {
        old_axes: included.old,
        assemble: input.options.assemble,
        ..SdfScene::default()
    };
    let among = of_worlds(root, &mut scene);
    read_models(root, among.is_empty(), &mut scene, &mut robot)?;
    // Joints and frames of the world name parts with the prefix of their model.
    for e in among {
        named_place(e, "", "world", false, &mut scene)?;
    }
    resolve_places(&mut scene)?;
    place_links(&scene, &mut robot);
    // Other elements of worlds are judged by the names that are known now.
    let worlds = root.children_named("world");
    let others = worlds.flat_map(|w| w.children().collect::<Vec<_>>());
    let others = others.filter(|e| !IN_WORLDS.contains(&e.name()));
    let others: Vec<Element<'_>> = others.collect();
    read_joints(scene, &mut robot)?;
    for e in others {
        leave_out(e, None, &mut robot);
    }
    Ok(robot)
}

/// The elements of worlds that are read.
const IN_WORLDS: [&str; 4] = ["model", "joint", "frame", "plugin"];

/// Returns joints and frames in worlds, next to their models; plugins there are stored in the scene.
fn of_worlds<'a>(root: Element<'a>, scene: &mut SdfScene<'a>) -> Vec<Element<'a>> {
    let mut among = Vec::new();
    for e in root.children_named("world").flat_map(|w| w.children()) {
        match e.name() {
            "joint" | "frame" => among.push(e),
            "plugin" => scene.plugins.push((e, String::new())),
            _ => {}
        }
    }
    among
}

/// Takes in all models, those within others after them.
fn read_models<'a>(
    root: Element<'a>,
    nothing_else: bool,
    scene: &mut SdfScene<'a>,
    robot: &mut Robot,
) -> Read<()> {
    let worlds = root.children_named("world");
    let of_worlds = worlds.flat_map(|w| w.children_named("model"));
    let models: Vec<Element<'_>> = root.children_named("model").chain(of_worlds).collect();
    let Some(first) = models.first() else {
        return Err(root.missing_error("<model>"));
    };
    let name = first.attribute("name").unwrap_or("robot");
    name.clone_into(&mut robot.name);
    let alone = models.len() == 1 && nothing_else;
    let outermost = models.into_iter().rev();
    let mut stack: Vec<(Element<'_>, String, bool)> =
        outermost.map(|m| (m, String::new(), false)).collect();
    while let Some((m, outer, inner)) = stack.pop() {
        let own = m.required_attribute("name")?;
        // The names of a single model are kept; others get a prefix, as SDF does for nested models.
        let scope = if inner || !alone {
            format!("{outer}{own}::")
        } else {
            String::new()
        };
        read_model(m, &outer, &scope, scene, robot)?;
        let nested = m.children_named("model").map(|n| (n, scope.clone(), true));
        let nested: Vec<_> = nested.collect();
        stack.extend(nested.into_iter().rev());
    }
    Ok(())
}

/// Computes the places of links and frames in the world, and adds a fixed joint for each link of a static model.
fn place_links(scene: &SdfScene<'_>, robot: &mut Robot) {
    for p in scene.placed.values() {
        if let (Some(l), Some(w)) = (p.link, p.world) {
            robot.places[l] = w;
        }
    }
    for &link in &scene.fixed {
        let id = format!("static-{}", robot.links[link]);
        let sides = [robot.places[link], RigidMotion::IDENTITY];
        let fixed = Part::new(&id, [0, link], sides, JointType::Fixed);
        robot.joints.push(fixed);
    }
    for name in scene.placed.keys() {
        if let Ok((link, world)) = moves_with(scene, name) {
            let on = robot.places[link].inverse().then(&world);
            robot.frames.insert(name.clone(), (link, on));
        }
    }
}

/// Reads all joints, their couplings, and Drake's constraints.
fn read_joints(mut scene: SdfScene<'_>, robot: &mut Robot) -> Read<()> {
    let far = |p: &Placed<'_>| length(p.raw.translation);
    let size = scene.placed.values().map(far).fold(1e-3, f64::max);
    let is_gearbox = |e: &Element<'_>| e.attribute("type") == Some("gearbox");
    let all = std::mem::take(&mut scene.joints).into_iter();
    let (gearboxes, joints): (Vec<_>, Vec<_>) = all.partition(|(e, _)| is_gearbox(e));
    for (e, scope) in joints {
        read_joint(e, &scope, &scene, size, robot)?;
    }
    // These couple joints that are read by now.
    for e in gearboxes {
        read_gearbox(&e, &scene, robot)?;
    }
    for at in std::mem::take(&mut scene.constraints) {
        match at.0.name() {
            "drake:weld_constraint" => read_weld(&at, &scene, robot)?,
            _ => ball_constraint(at.0, robot)?,
        }
    }
    for at in std::mem::take(&mut scene.plugins) {
        read_plugin(&at, &scene, robot)?;
    }
    for e in std::mem::take(&mut scene.unknown) {
        leave_out(e, None, robot);
    }
    Ok(())
}

/// Takes in what a model holds; places are worked out afterwards.
fn read_model<'a>(
    m: Element<'a>,
    outer: &str,
    scope: &str,
    scene: &mut SdfScene<'a>,
    robot: &mut Robot,
) -> Read<()> {
    let own = own_frame(m, outer, scope, scene)?;
    let is_static = m.first_child("static");
    let is_static = is_static.is_some_and(|s| ["true", "1"].contains(&s.text()));
    for e in m.children() {
        match e.name() {
            "link" => read_link(e, scope, &own, is_static, scene, robot)?,
            "frame" => named_place(e, scope, &own, false, scene)?,
            "joint" => {
                let wanted = e.attribute("name");
                let others = ["link", "frame", "model"].into_iter();
                let mut others = others.flat_map(|tag| m.children_named(tag).collect::<Vec<_>>());
                let shared = others.any(|o| o.attribute("name") == wanted);
                named_place(e, scope, &own, shared, scene)?;
            }
            "drake:joint" => {
                let what = "a joint type of Drake that is not read; its constraints are omitted";
                robot.report.leave_out_joint(&e.label(), 6, what);
            }
            "drake:weld_constraint" | "drake:ball_constraint" => {
                e.check_room("constraints", scene.constraints.len())?;
                scene.constraints.push((e, scope.to_owned()));
            }
            "plugin" => scene.plugins.push((e, scope.to_owned())),
            "model" | "pose" | "static" | "gripper" => {}
            _ => scene.unknown.push(e),
        }
    }
    Ok(())
}

/// Adds the model's own frame, which is called `__model__` within it; nested models are also known by name.
fn own_frame<'a>(
    m: Element<'a>,
    outer: &str,
    scope: &str,
    scene: &mut SdfScene<'a>,
) -> Read<String> {
    let (raw, relative) = read_pose(m)?;
    let own = format!("{scope}__model__");
    let relative_to = match relative {
        Some(r) => format!("{outer}{r}"),
        None if outer.is_empty() => "world".to_owned(),
        None => format!("{outer}__model__"),
    };
    let first = || m.first_child("link").and_then(|l| l.attribute("name"));
    let canonical = m.attribute("canonical_link").or_else(first);
    let attached_to = canonical.map_or_else(|| "world".to_owned(), |c| format!("{scope}{c}"));
    let frame = Placed::new(m, relative_to, raw, attached_to);
    insert(scene, own.clone(), frame)?;
    if !scope.is_empty() {
        let alias = scope.trim_end_matches("::").to_owned();
        let frame = Placed::new(m, own.clone(), RigidMotion::IDENTITY, own.clone());
        insert(scene, alias, frame)?;
    }
    Ok(own)
}

/// Reads a link of a model whose own frame is `own`.
fn read_link<'a>(
    e: Element<'a>,
    scope: &str,
    own: &str,
    is_static: bool,
    scene: &mut SdfScene<'a>,
    robot: &mut Robot,
) -> Read<()> {
    e.check_room("links", robot.links.len())?;
    let name = format!("{scope}{}", e.required_attribute("name")?);
    let (raw, relative) = read_pose(e)?;
    if name == "world" {
        // Joints that name it mean the world.
        if raw != RigidMotion::IDENTITY {
            let why = "a link named world is not in its place";
            return Err(e.unsupported_error(why, "remove its pose, or give it another name"));
        }
        return Ok(());
    }
    let link = robot.add_link(&name, RigidMotion::IDENTITY);
    let to = relative.map_or_else(|| own.to_owned(), |r| absolute_name(scope, r));
    let mut placed = Placed::new(e, to, raw, name.clone());
    placed.link = Some(link);
    insert(scene, name, placed)?;
    if e.children().any(|c| c.is_one_of("visual collision")) {
        robot.shown.insert(link);
    }
    if is_static {
        scene.fixed.push(link);
    }
    Ok(())
}
