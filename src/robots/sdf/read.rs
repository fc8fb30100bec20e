//! SDF: models with links, frames and joints, places relative to each other, loops closed by joints as they stand.

use crate::file::problem::ImportError;
use crate::geom::rigid::Motion;
use crate::geom::vector::{length, scale};
use crate::model::joint_type::JointType;
use crate::robots::options::{Options, Reader};
use crate::robots::parts::{Part, Robot};
use crate::robots::problem::RobotProblem;
use crate::robots::sdf::gearbox::gearbox;
use crate::robots::sdf::include::{self, Expanded};
use crate::robots::sdf::joints::{joint, weld};
use crate::robots::sdf::scene::{
    BESIDE, Placed, Scene, absolute, end, insert, moves_with, resolve,
};
use crate::robots::urdf::read::ball_constraint;
use crate::robots::xml::{Document, Element};

/// Reads an `<sdf>`.
pub(crate) fn read(
    document: &mut Document,
    root: usize,
    inner: Reader<'_>,
    options: &Options,
) -> Result<Robot, ImportError> {
    let Expanded { old, scenery } = include::expand(document, root, inner)?;
    let (root, assemble) = (document.element(root), options.assemble);
    let mut models: Vec<(Element<'_>, bool)> = root.named("model").map(|m| (m, false)).collect();
    let mut robot = Robot::new("robot");
    for uri in &scenery {
        robot.report.drop("include of a light or floor", Some(uri));
    }
    let mut among = Vec::new();
    for w in root.named("world") {
        models.extend(w.named("model").map(|m| (m, false)));
        for e in w
            .children()
            .filter(|e| !["model", "joint", "frame"].contains(&e.name()))
        {
            robot.report.drop(e.name(), e.attribute("name"));
        }
        among.extend(
            w.children()
                .filter(|e| ["joint", "frame"].contains(&e.name())),
        );
    }
    let Some(first) = models.first() else {
        let what = "<model>".to_owned();
        return Err(root.fail(
            None,
            RobotProblem::Missing {
                element: root.label(),
                what,
            },
        ));
    };
    first
        .0
        .attribute("name")
        .unwrap_or("robot")
        .clone_into(&mut robot.name);
    robot.world = Some(robot.link("world", Motion::IDENTITY));
    robot.floats = true;
    let mut scene = Scene {
        old_axes: old,
        assemble,
        ..Scene::default()
    };
    let alone = models.len() == 1 && among.is_empty();
    models.reverse();
    let mut stack: Vec<(Element<'_>, String, bool)> = models
        .into_iter()
        .map(|(m, inner)| (m, String::new(), inner))
        .collect();
    while let Some((m, outer, inner)) = stack.pop() {
        let own = m.required("name")?;
        // The one model's names stand as they are; others are prefixed, as SDF does it for nested models.
        let scope = if inner || !alone {
            format!("{outer}{own}::")
        } else {
            String::new()
        };
        model(m, &outer, &scope, &mut scene, &mut robot)?;
        let nested: Vec<_> = m.named("model").map(|n| (n, scope.clone(), true)).collect();
        stack.extend(nested.into_iter().rev());
    }
    // Those of the world name what is in its models by the models' names.
    for e in among {
        named_place(e, "", "world", false, &mut scene)?;
    }
    resolve(&mut scene)?;
    for p in scene.placed.values() {
        if let (Some(l), Some(w)) = (p.link, p.world) {
            robot.places[l] = w;
        }
    }
    for &link in &scene.fixed {
        let id = format!("static-{}", robot.links[link]);
        let sides = [robot.places[link], Motion::IDENTITY];
        robot
            .joints
            .push(Part::new(&id, [0, link], sides, JointType::Fixed));
    }
    let names: Vec<String> = scene.placed.keys().cloned().collect();
    for name in names {
        if let Ok((link, world)) = moves_with(&scene, &name) {
            let on = robot.places[link].inverse().then(&world);
            robot.frames.insert(name, (link, on));
        }
    }
    let size = scene
        .placed
        .values()
        .map(|p| length(p.raw.translation))
        .fold(1e-3, f64::max);
    let is_gearbox = |e: &Element<'_>| e.attribute("type") == Some("gearbox");
    let joints = std::mem::take(&mut scene.joints).into_iter();
    let (gearboxes, joints): (Vec<_>, Vec<_>) = joints.partition(|(e, _)| is_gearbox(e));
    for (e, scope) in joints {
        joint(e, &scope, &scene, size, &mut robot)?;
    }
    // These couple joints that are read by now.
    for (e, scope) in gearboxes {
        gearbox(e, &scope, &scene, &mut robot)?;
    }
    for (e, scope) in std::mem::take(&mut scene.constraints) {
        match e.name() {
            "drake:weld_constraint" => weld(e, &scope, &scene, &mut robot)?,
            _ => ball_constraint(e, &mut robot)?,
        }
    }
    Ok(robot)
}

/// The pose child: numbers, what it is relative to, and in which unit.
pub(crate) fn pose(e: Element<'_>) -> Result<(Motion, Option<&str>), ImportError> {
    let Some(p) = e.child("pose") else {
        return Ok((Motion::IDENTITY, None));
    };
    let relative = p
        .attribute("relative_to")
        .or(p.attribute("frame"))
        .filter(|r| !r.is_empty());
    if p.text().is_empty() {
        return Ok((Motion::IDENTITY, relative));
    }
    if p.attribute("rotation_format") == Some("quat_xyzw") {
        let [a, b, c, x, y, z, w] = p.text_numbers::<7>()?;
        return Ok((Motion::quaternion([a, b, c], [w, x, y, z]), relative));
    }
    let [x, y, z, roll, pitch, yaw] = p.text_numbers::<6>()?;
    let degrees = p
        .attribute("degrees")
        .is_some_and(|d| ["true", "1"].contains(&d));
    let turn = scale(
        [roll, pitch, yaw],
        if degrees {
            std::f64::consts::PI / 180.0
        } else {
            1.0
        },
    );
    Ok((Motion::roll_pitch_yaw([x, y, z], turn), relative))
}

/// Takes in what a model holds; places are worked out afterwards.
fn model<'a>(
    m: Element<'a>,
    outer: &str,
    scope: &str,
    scene: &mut Scene<'a>,
    robot: &mut Robot,
) -> Result<(), ImportError> {
    let static_model = m
        .child("static")
        .is_some_and(|s| ["true", "1"].contains(&s.text()));
    let (raw, relative) = pose(m)?;
    // The model's own frame is called __model__ within it; nested models are also known by name.
    let own = format!("{scope}__model__");
    let relative_to = match relative {
        Some(r) => format!("{outer}{r}"),
        None if outer.is_empty() => "world".to_owned(),
        None => format!("{outer}__model__"),
    };
    let canonical = m
        .attribute("canonical_link")
        .or_else(|| m.child("link").and_then(|l| l.attribute("name")));
    let attached_to = canonical.map_or_else(|| "world".to_owned(), |c| format!("{scope}{c}"));
    let placed = |element, relative_to, raw, attached_to: String, link| Placed {
        element,
        relative_to,
        raw,
        attached_to,
        world: None,
        link,
    };
    insert(
        scene,
        own.clone(),
        placed(m, relative_to, raw, attached_to, None),
    )?;
    if !scope.is_empty() {
        let alias = scope.trim_end_matches("::").to_owned();
        insert(
            scene,
            alias,
            placed(m, own.clone(), Motion::IDENTITY, own.clone(), None),
        )?;
    }
    for e in m.children() {
        let named =
            |e: Element<'a>| Ok::<_, ImportError>(format!("{scope}{}", e.required("name")?));
        match e.name() {
            "link" => {
                e.room("links", robot.links.len())?;
                let name = named(e)?;
                let (raw, relative) = pose(e)?;
                if name == "world" {
                    // Joints that name it mean the world.
                    if raw != Motion::IDENTITY {
                        let why = "a link that is the world is not in its place";
                        return Err(e.unsupported(why, "remove its pose, or give it another name"));
                    }
                    robot.report.map("link that is the world");
                    robot.said_by(0, e);
                    continue;
                }
                let link = robot.link(&name, Motion::IDENTITY);
                robot.said_by(link, e);
                let to = relative.map_or_else(|| own.clone(), |r| absolute(scope, r));
                insert(scene, name.clone(), placed(e, to, raw, name, Some(link)))?;
                for c in e.children().filter(|c| c.name() != "pose") {
                    if ["visual", "collision"].contains(&c.name()) {
                        robot.shown.insert(link);
                    }
                    robot.report.drop(c.name(), None);
                }
                if static_model {
                    scene.fixed.push(link);
                }
            }
            "frame" => named_place(e, scope, &own, false, scene)?,
            "joint" => {
                let wanted = e.attribute("name");
                let others = ["link", "frame", "model"].into_iter();
                let shared = others
                    .flat_map(|tag| m.named(tag).collect::<Vec<_>>())
                    .any(|o| o.attribute("name") == wanted);
                named_place(e, scope, &own, shared, scene)?;
            }
            "drake:joint" => {
                let what = "a joint of Drake's own, which is not read: what it holds is loose here";
                robot.report.approximate(&e.label(), what);
            }
            "drake:weld_constraint" | "drake:ball_constraint" => {
                e.room("constraints", scene.constraints.len())?;
                scene.constraints.push((e, scope.to_owned()));
            }
            "gripper" | "plugin" | "self_collide" | "allow_auto_disable" | "enable_wind" => {
                robot.report.drop(e.name(), e.attribute("name"));
            }
            "model" | "pose" | "static" => {}
            other => robot.report.drop(other, e.attribute("name")),
        }
    }
    Ok(())
}

/// Takes in a frame or joint, whose place is relative to `own` where nothing is said; a joint that shares its name has its
/// frame beside it.
fn named_place<'a>(
    e: Element<'a>,
    scope: &str,
    own: &str,
    shared: bool,
    scene: &mut Scene<'a>,
) -> Result<(), ImportError> {
    let mut name = format!("{scope}{}", e.required("name")?);
    let (raw, relative) = pose(e)?;
    let attached_to = if e.name() == "joint" {
        e.room("joints", scene.joints.len())?;
        scene.joints.push((e, scope.to_owned()));
        if shared {
            name += BESIDE;
        }
        absolute(scope, end(e, "child")?.1)
    } else {
        let to = e.attribute("attached_to").filter(|a| !a.is_empty());
        to.map_or_else(|| own.to_owned(), |a| absolute(scope, a))
    };
    let relative_to = relative.map_or_else(|| attached_to.clone(), |r| absolute(scope, r));
    let placed = Placed {
        element: e,
        relative_to,
        raw,
        attached_to,
        world: None,
        link: None,
    };
    insert(scene, name, placed)
}
