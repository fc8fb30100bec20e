//! Elements in addition to links and joints: plugins that weld links or couple joints, and unknown elements. Those that could
//! close a loop or couple joints are reported and counted; the others (friction, colours, publishers) have no effect on the
//! kinematics.

use crate::robots::description::kinematics::{link_places, spanning_tree};
use crate::robots::prelude::*;
use crate::robots::sdf::joints::read_joint;
use crate::robots::sdf::scene::{
    Placed, Scoped, SdfScene, absolute_name, insert, joint_end, moves_with, named_place,
    resolve_places,
};

/// Rows that an element of unknown meaning may constrain: all freedoms between two links.
const MOST_ROWS: usize = 6;

/// Parts of words for elements that constrain links or couple joints.
const HOLDS: &str = "mimic constraint attach detach weld loop closed closing closure linkage \
    fourbar four_bar coupl gearbox grasp tendon equality bushing underactuated parallel pulley";

/// Parts of words for elements that may name many links and joints, and constrain none of them.
const HARMLESS: &str = "publish camera sensor imu lidar laser gps control drive odom contact \
    collision visual material light friction gravity wind thrust buoyan hydro battery logger \
    broadcast torque bumper sonar depth wheel scene physics steer vehicle track trajector group \
    effector state";

/// Returns the text of a child, or `None` if it has none.
fn child_text<'a>(e: Element<'a>, tag: &str) -> Option<&'a str> {
    let found = e.first_child(tag).map(Element::text);
    found.filter(|t| !t.is_empty())
}

/// Couples two joints, the leader first, unless another element couples them in the same way.
pub(crate) fn add_coupling(e: Element<'_>, joints: [&str; 2], ratio: f64, robot: &mut Robot) {
    let same = |c: &Ratio| {
        let [a, b] = c.joints.each_ref().map(String::as_str);
        (joints == [a, b] && c.ratio == ratio) || (joints == [b, a] && c.ratio * ratio == 1.0)
    };
    if !robot.couplings.iter().any(same) {
        robot.couplings.push(Ratio::new(joints, ratio, e));
    }
}

/// Reads a plugin. A plugin that makes a joint follow another couples them. One that joins links until they are detached welds them.
///
/// # Errors
/// Returns an error if a multiplier is not a number.
pub(crate) fn read_plugin(at: &Scoped<'_>, scene: &SdfScene<'_>, robot: &mut Robot) -> Read<()> {
    let (e, scope) = (at.0, at.1.as_str());
    if let (Some(leader), Some(follower)) = (child_text(e, "joint"), child_text(e, "mimicJoint")) {
        let ratio = e.child_number("multiplier")?.unwrap_or(1.0);
        let joints = [leader, follower].map(|j| absolute_name(scope, j));
        add_coupling(e, joints.each_ref().map(String::as_str), ratio, robot);
        return Ok(());
    }
    match (child_text(e, "parent_link"), child_text(e, "child_link")) {
        (Some(parent), Some(child)) => {
            let model = child_text(e, "child_model").unwrap_or("");
            let own = scope.trim_end_matches("::");
            let own = own.rsplit("::").next().unwrap_or("");
            let is_own = ["", "__self__", "__model__", own, &robot.name].contains(&model);
            let child = if is_own {
                absolute_name(scope, child)
            } else {
                format!("{model}::{child}")
            };
            weld_links(e, &[absolute_name(scope, parent), child], scene, robot)?;
        }
        _ => leave_out(e, None, robot),
    }
    Ok(())
}

/// Welds two links in their drawn places. A weld of a missing link is omitted and counted.
fn weld_links(
    e: Element<'_>,
    names: &[String; 2],
    scene: &SdfScene<'_>,
    robot: &mut Robot,
) -> Read<()> {
    let [Ok((a, at)), Ok((b, _))] = names.each_ref().map(|n| moves_with(scene, n)) else {
        let [a, b] = names;
        let what = format!("it welds {a} to {b}, which are not both in the file; omitted");
        robot.report.leave_out(&label_of(e), MOST_ROWS, what);
        return Ok(());
    };
    if a == b {
        return Ok(());
    }
    let ends = [a, b].map(|l| (l, robot.places[l].inverse().then(&at)));
    let id = format!("weld-{}-{}", names[0], names[1]);
    robot.close_loop(e, &id, ends, JointType::Fixed).map(drop)
}

/// Omits an element of unknown meaning. It is counted if its name suggests that it closes a loop or couples joints, or if it names several
/// links or joints of the robot. `own` is its parent joint, which it may name.
pub(crate) fn leave_out(e: Element<'_>, own: Option<&str>, robot: &mut Robot) {
    let kind = kind_of(e);
    let has = |words: &str| words.split(' ').any(|w| kind.contains(w));
    let named = named_parts(e, own, robot);
    let holds = match own {
        Some(_) => !named.is_empty(),
        None => has(HOLDS) || (!has(HARMLESS) && named.len() > 1),
    };
    if !holds {
        return;
    }
    let of = match named.iter().take(4).cloned().collect::<Vec<_>>().join(", ") {
        names if names.is_empty() => String::new(),
        names => format!(" of {names}"),
    };
    let what = format!(
        "it is not read, though it may close a loop or couple joints{of}; omitted; write it as a joint, a <mimic> or a file of loop closures"
    );
    robot.report.leave_out(&label_of(e), MOST_ROWS, what);
}

/// Returns the name of an element for messages, with the kind of its plugin.
fn label_of(e: Element<'_>) -> String {
    match e.attribute("filename") {
        Some(file) => format!("{} ({file})", e.label()),
        None => e.label(),
    }
}

/// Returns the texts that identify an element, in lower case: its name, and the file and class of a plugin.
fn kind_of(e: Element<'_>) -> String {
    let class = e.attribute("name").filter(|n| n.contains("::"));
    let file = e.attribute("filename");
    let own = e
        .attribute("name")
        .filter(|_| file.is_none() && e.name() == "plugin");
    let all = [Some(e.name()), e.attribute("type"), file, class, own];
    let all: Vec<&str> = all.into_iter().flatten().collect();
    all.join(" ").to_lowercase()
}

/// Returns the links and joints that an element and its descendants name, except `own`.
pub(crate) fn named_parts(e: Element<'_>, own: Option<&str>, robot: &Robot) -> BTreeSet<String> {
    let is_known = |word: &str| {
        robot.links.iter().any(|l| l == word) || robot.joints.iter().any(|j| j.id == word)
    };
    let mut out = BTreeSet::new();
    let mut stack = vec![e];
    while let Some(e) = stack.pop() {
        let words = e.attributes().map(|(_, value)| value).chain([e.text()]);
        let words = words.filter(|w| is_known(w) && Some(*w) != own);
        out.extend(words.map(str::to_owned));
        stack.extend(e.children());
    }
    out
}

/// Reads Drake's ball constraint, which fixes a point of one body to a point of another.
pub(crate) fn ball_constraint(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let mut ends = [(0, RigidMotion::IDENTITY); 2];
    for (end, (body, point)) in ends.iter_mut().zip([("A", "p_AP"), ("B", "p_BQ")]) {
        let part = |k: &str| {
            let tag = format!("drake:ball_constraint_{k}");
            let found = e.first_child(&tag);
            found.ok_or_else(|| e.missing_error(&format!("<{tag}>")))
        };
        let b = part(&format!("body_{body}"))?;
        let name = b.attribute("name").unwrap_or_else(|| b.text());
        let (link, frame) = robot.frame(name).ok_or_else(|| {
            let problem = unknown_name(&e.label(), ["link", "links"], name, &robot.links);
            b.error_at(Some("name"), problem)
        })?;
        let p = part(point)?;
        let at = match p.read_numbers::<3>("value")? {
            Some(v) => v,
            None => p.text_numbers()?,
        };
        *end = (link, frame.then(&RigidMotion::from_translation(at)));
    }
    let [a, b] = ends.map(|end| &robot.links[end.0]);
    let id = format!("ball-{a}-{b}");
    robot.close_loop(e, &id, ends, JointType::Spherical)?;
    Ok(())
}

/// Reads the additions of the `<gazebo>` elements below a root. All links and joints of the URDF are read before.
///
/// # Errors
/// Returns an error if SDF has no such joint.
pub(crate) fn read_gazebo(root: Element<'_>, robot: &mut Robot) -> Read<()> {
    let inside = root
        .children_named("gazebo")
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
        robot.add_link("world", RigidMotion::IDENTITY);
    }
    // SDF places joints where the links are drawn; places in the robot stay what they were.
    let tree = spanning_tree(robot, 0);
    let drawn = link_places(robot, &tree);
    let before = std::mem::replace(&mut robot.places, drawn);
    let done =
        place_links(root, robot).and_then(|scene| add_joints(scene, &joints, &plugins, robot));
    robot.places = before;
    done
}

fn names_world(joint: Element<'_>) -> bool {
    ["parent", "child"]
        .iter()
        .any(|t| joint_end(joint, t).is_ok_and(|(_, name)| name == "world"))
}

/// Returns the links in their drawn places.
fn place_links<'a>(root: Element<'a>, robot: &Robot) -> Read<SdfScene<'a>> {
    let mut scene = SdfScene::default();
    scene.world = robot.links.iter().position(|l| l == "world").unwrap_or(0);
    let (here, first) = (RigidMotion::IDENTITY, robot.links[0].clone());
    let model = Placed::new(root, "world".to_owned(), here, first);
    insert(&mut scene, "__model__".to_owned(), model)?;
    let links = robot.links.iter().enumerate();
    for (l, name) in links.filter(|(_, n)| *n != "world") {
        let mut link = Placed::new(root, "world".to_owned(), robot.places[l], name.clone());
        link.link = Some(l);
        insert(&mut scene, name.clone(), link)?;
    }
    Ok(scene)
}

fn add_joints<'a>(
    mut scene: SdfScene<'a>,
    joints: &[Element<'a>],
    plugins: &[Element<'a>],
    robot: &mut Robot,
) -> Read<()> {
    for &e in joints {
        let name = e.attribute("name");
        let shared = name.is_some_and(|n| robot.frame(n).is_some());
        named_place(e, "", "__model__", shared, &mut scene)?;
    }
    resolve_places(&mut scene)?;
    let far = robot.places.iter().map(|p| length(p.translation));
    let size = far.fold(1e-3, f64::max);
    for &e in joints {
        let first = robot.joints.len();
        read_joint(e, "", &scene, size, robot)?;
        // A joint between a link and the world closes no loop.
        let closes = !names_world(e);
        let new = robot.joints[first..].iter_mut();
        new.for_each(|p| p.closes = closes);
    }
    for &e in plugins {
        read_plugin(&(e, String::new()), &scene, robot)?;
    }
    Ok(())
}
