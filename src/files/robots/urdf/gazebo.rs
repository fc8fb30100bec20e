//! What `<gazebo>` elements of a URDF add to the model that Gazebo makes of it: joints of SDF, which may close loops, and plugins.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::length;
use crate::robots::additions::{leave_out, plugin};
use crate::robots::description::Robot;
use crate::robots::description::kinematics::{places, spanning_tree};
use crate::robots::sdf::joints::joint;
use crate::robots::sdf::named_place;
use crate::robots::sdf::scene::{Placed, SdfScene, end, insert, resolve};
use crate::robots::warning::Read;
use crate::robots::xml::element::Element;

/// Reads the additions of the `<gazebo>` elements below a root. All links and joints of the URDF are read before.
///
/// # Errors
/// Returns an error if SDF has no such joint.
pub(crate) fn read(root: Element<'_>, robot: &mut Robot) -> Read<()> {
    let inside = root
        .named("gazebo")
        .flat_map(|g| g.children().collect::<Vec<_>>());
    let (mut joints, mut plugins) = (Vec::new(), Vec::new());
    for e in inside {
        match e.name() {
            "joint" => joints.push(e),
            "plugin" => plugins.push(e),
            _ => leave_out(e, None, robot),
        }
    }
    if joints.is_empty() && plugins.is_empty() {
        return Ok(());
    }
    if robot.frame("world").is_none() && joints.iter().any(|j| names_world(*j)) {
        robot.link("world", RigidMotion::IDENTITY);
    }
    // SDF places joints where the links are drawn; places in the robot stay what they were.
    let tree = spanning_tree(robot, 0);
    let drawn = places(robot, &tree);
    let before = std::mem::replace(&mut robot.places, drawn);
    let done = placed(root, robot).and_then(|scene| add(scene, &joints, &plugins, robot));
    robot.places = before;
    done
}

fn names_world(joint: Element<'_>) -> bool {
    ["parent", "child"]
        .iter()
        .any(|t| end(joint, t).is_ok_and(|(_, name)| name == "world"))
}

/// Returns the links where they are drawn.
fn placed<'a>(root: Element<'a>, robot: &Robot) -> Read<SdfScene<'a>> {
    let mut scene = SdfScene::default();
    scene.world = robot.links.iter().position(|l| l == "world").unwrap_or(0);
    let model = Placed::new(
        root,
        "world".to_owned(),
        RigidMotion::IDENTITY,
        robot.links[0].clone(),
    );
    insert(&mut scene, "__model__".to_owned(), model)?;
    for (l, name) in robot
        .links
        .iter()
        .enumerate()
        .filter(|(_, n)| *n != "world")
    {
        let mut link = Placed::new(root, "world".to_owned(), robot.places[l], name.clone());
        link.link = Some(l);
        insert(&mut scene, name.clone(), link)?;
    }
    Ok(scene)
}

fn add<'a>(
    mut scene: SdfScene<'a>,
    joints: &[Element<'a>],
    plugins: &[Element<'a>],
    robot: &mut Robot,
) -> Read<()> {
    for &e in joints {
        let shared = e
            .attribute("name")
            .is_some_and(|n| robot.frame(n).is_some());
        named_place(e, "", "__model__", shared, &mut scene)?;
    }
    resolve(&mut scene)?;
    let far = robot.places.iter().map(|p| length(p.translation));
    let size = far.fold(1e-3, f64::max);
    for &e in joints {
        let first = robot.joints.len();
        joint(e, "", &scene, size, robot)?;
        // What holds a link to the world is no loop.
        let closes = !names_world(e);
        robot.joints[first..]
            .iter_mut()
            .for_each(|p| p.closes = closes);
    }
    for &e in plugins {
        plugin(e, "", &scene, robot)?;
    }
    Ok(())
}
