//! Reading, fixing and writing MJCF: bodies with joints in series, sites, equality constraints, default classes and includes.

mod context;
mod equality;
pub(super) mod fix;
pub(super) mod write;

use crate::robots::additions::leave_out;
use crate::robots::include::expand_files;
use crate::robots::mjcf::context::{Context, Defaults, read_compiler};
use crate::robots::prelude::*;

/// Sections without constraints; equalities look up in them what they use.
const SECTIONS: &str = "asset contact custom extension keyframe option sensor size statistic \
    tendon visual";

const TYPES: &str = "hinge, slide, ball, free";

/// An element still to be read: a body, frame or joint, its link, its place there, and the class of its children.
#[derive(Clone, Copy)]
struct Waiting<'a> {
    element: Element<'a>,
    link: usize,
    place: RigidMotion,
    class: Option<&'a str>,
}

impl<'a> Waiting<'a> {
    /// Returns an element within this one, which a link holds at the given place.
    fn at_element(&self, element: Element<'a>, link: usize, place: RigidMotion) -> Waiting<'a> {
        let class = element.attribute("childclass").or(self.class);
        Waiting {
            element,
            link,
            place,
            class,
        }
    }
}

/// Reads a `<mujoco>` and the files it includes.
pub(crate) fn read_mujoco(mut input: Input<'_>) -> Read<Robot> {
    expand_files(&mut input)?;
    let (document, root) = (input.document, input.root);
    let root = document.element(root);
    let name = root.attribute("model").unwrap_or("robot");
    let mut robot = Robot::new(name);
    let mut context = Context {
        compiler: read_compiler(root)?,
        defaults: Defaults::read(root)?,
        sites: BTreeMap::new(),
    };
    let world = robot.add_link("world", RigidMotion::IDENTITY);
    robot.world = Some(world);
    for w in root.children_named("worldbody") {
        let at_world = Waiting {
            element: w,
            link: world,
            place: RigidMotion::IDENTITY,
            class: w.attribute("childclass"),
        };
        read_bodies(at_world, &mut context, &mut robot)?;
    }
    for section in root.children() {
        match section.name() {
            "worldbody" | "compiler" | "default" => {}
            "equality" => equality::read_equalities(section, root, &context, &mut robot)?,
            "actuator" => section
                .children()
                .for_each(|a| read_actuator(a, root, &mut robot)),
            "deformable" => {
                let what = "deformable bodies are not links; omitted";
                robot.report.add_approximation(&section.label(), what);
            }
            _ if section.is_one_of(SECTIONS) => {}
            _ => leave_out(section, None, &mut robot),
        }
    }
    Ok(robot)
}

/// Records the joint that an actuator drives, or those that it pulls by a tendon.
fn read_actuator(a: Element<'_>, root: Element<'_>, robot: &mut Robot) {
    // The frame in which it acts does not matter.
    let joint = a.attribute("joint").or(a.attribute("jointinparent"));
    let mut joints = robot.joints.iter_mut();
    if let Some(j) = joints.find(|j| Some(j.id.as_str()) == joint) {
        j.drive = true;
        return;
    }
    let pulled = of_tendon(root, a);
    for j in &mut robot.joints {
        j.pulled |= pulled.contains(&j.id.as_str());
    }
}

/// Returns the names of the joints that an actuator moves by a fixed tendon.
fn of_tendon<'a>(root: Element<'a>, actuator: Element<'a>) -> Vec<&'a str> {
    let Some(name) = actuator.attribute("tendon") else {
        return Vec::new();
    };
    let all = root.children_named("tendon");
    let all = all.flat_map(|s| s.children_named("fixed"));
    let called = all.filter(|f| f.attribute("name") == Some(name));
    let joints = called.flat_map(|f| f.children_named("joint"));
    joints.filter_map(|j| j.attribute("joint")).collect()
}

fn read_bodies<'a>(start: Waiting<'a>, context: &mut Context<'a>, robot: &mut Robot) -> Read<()> {
    let mut stack = vec![start];
    while let Some(w) = stack.pop() {
        let mut here = Vec::new();
        for e in w.element.children() {
            let inner = |link, place| w.at_element(e, link, place);
            match e.name() {
                "body" => {
                    let place = w.place.then(&context.compiler.read_place(e)?);
                    let link = read_body(inner(w.link, place), context, robot)?;
                    here.push(inner(link, RigidMotion::IDENTITY));
                }
                "frame" => {
                    let place = w.place.then(&context.compiler.read_place(e)?);
                    here.push(inner(w.link, place));
                }
                "site" => read_site(inner(w.link, w.place), context, robot)?,
                "joint" | "freejoint" if w.link != 0 => {}
                "joint" | "freejoint" => {
                    let remedy = "put the joint into a body";
                    return Err(e.unsupported_error("the world cannot move", remedy));
                }
                "flexcomp" | "attach" => {
                    let what = "its result when the model is compiled is omitted; save the compiled model from MuJoCo as XML to include it";
                    match e.name() {
                        "attach" => robot.report.leave_out(&e.label(), 6, what),
                        _ => robot.report.add_approximation(&e.label(), what),
                    }
                }
                "replicate" if e.children().all(|c| c.is_one_of("geom site light camera")) => {}
                "composite" | "replicate" => {
                    let why = "it makes bodies when the model is compiled";
                    let remedy = "save the compiled model from MuJoCo as XML and import that file";
                    return Err(e.unsupported_error(why, remedy));
                }
                "geom" => {
                    robot.shown.insert(w.link);
                }
                _ => {}
            }
        }
        stack.extend(here.into_iter().rev());
    }
    Ok(())
}

fn read_site(w: Waiting<'_>, context: &mut Context<'_>, robot: &mut Robot) -> Read<()> {
    let e = w.element;
    let place = w.place.then(&context.compiler.read_place(e)?);
    let Some(name) = e.attribute("name") else {
        return Ok(());
    };
    let here = (w.link, place);
    if context.sites.insert(name.to_owned(), here).is_some() {
        return Err(e.duplicate_error());
    }
    robot.frames.entry(name.to_owned()).or_insert(here);
    robot.shown.insert(w.link);
    Ok(())
}

/// Reads a body on its parent and its joints, in series through extra links if there are several.
fn read_body<'a>(at: Waiting<'a>, context: &Context<'a>, robot: &mut Robot) -> Read<usize> {
    let (e, parent, place) = (at.element, at.link, at.place);
    let name = match e.attribute("name") {
        Some(n) if robot.frame(n).is_some() && robot.links.iter().any(|l| l == n) => {
            return Err(e.duplicate_error());
        }
        Some(n) => n.to_owned(),
        None => format!("body-{}", robot.links.len()),
    };
    e.check_room("bodies", robot.links.len())?;
    e.check_room("joints", robot.joints.len())?;
    let world = robot.places[parent].then(&place);
    let mut joints = Vec::new();
    let mut own = at;
    own.place = RigidMotion::IDENTITY;
    own_joints(own, context, &mut joints)?;
    if joints.is_empty() {
        let link = robot.add_link(&name, world);
        // A hand or a recording moves it in six freedoms: it is a drive, and not part of the frame.
        let sides = [place, RigidMotion::IDENTITY];
        let mut part = Part::new(&name, [parent, link], sides, JointType::Fixed).said_by(e);
        if e.attribute("mocap") == Some("true") {
            part = Part::new(&name, [parent, link], sides, free_joint()).said_by(e);
            part.drive = true;
        }
        robot.joints.push(part);
        return Ok(link);
    }
    let (mut from, mut at) = (parent, place);
    for (i, j) in joints.iter().enumerate() {
        let between = format!("{name}~{}", i + 1);
        let last = i + 1 == joints.len();
        let link = robot.add_link(if last { &name } else { &between }, world);
        let part = read_joint(j, &name, [from, link], at, context, robot)?;
        robot.joints.push(part);
        (from, at) = (link, RigidMotion::IDENTITY);
    }
    Ok(from)
}

/// Returns the joints of a body, including those in its frames, with the places of these in the body and their classes.
fn own_joints<'a>(at: Waiting<'a>, context: &Context<'a>, out: &mut Vec<Waiting<'a>>) -> Read<()> {
    for c in at.element.children() {
        match c.name() {
            "joint" | "freejoint" => out.push(Waiting { element: c, ..at }),
            "frame" => {
                let place = at.place.then(&context.compiler.read_place(c)?);
                own_joints(at.at_element(c, at.link, place), context, out)?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// Returns the name of a joint: its own, or one made from its body's and its type.
fn joint_id(e: Element<'_>, body: &str, word: &str, robot: &Robot) -> Read<String> {
    match e.attribute("name") {
        Some(n) if robot.joints.iter().any(|j| j.id == n) => Err(e.duplicate_error()),
        Some(n) => Ok(n.to_owned()),
        None => Ok(format!("{body}.{word}")),
    }
}

fn read_joint<'a>(
    own: &Waiting<'a>,
    body: &str,
    links: [usize; 2],
    place: RigidMotion,
    context: &Context<'a>,
    robot: &mut Robot,
) -> Read<Part> {
    let (e, inner) = (own.element, own.place);
    let tag = if e.name() == "freejoint" { "" } else { "joint" };
    let look = context.defaults.lookup(e, tag, own.class)?;
    let word = if tag.is_empty() {
        "free"
    } else {
        look.find_element("type")
            .attribute("type")
            .unwrap_or("hinge")
    };
    let joint_type = joint_of_word(word, TYPES);
    let joint_type = joint_type.ok_or_else(|| e.unknown_word("type", word, TYPES))?;
    let id = joint_id(e, body, word, robot)?;
    let pos = look.find_element("pos").read_vector("pos", [0.0; 3])?;
    let at = if word == "free" {
        RigidMotion::IDENTITY
    } else {
        RigidMotion::from_translation(inner.map_point(pos))
    };
    let mut part = Part::new(&id, links, [place.then(&at), at], joint_type).said_by(e);
    if matches!(word, "hinge" | "slide") {
        let axis = read_axis(e, look.find_element("axis"))?;
        part.set_axis(inner.map_direction(axis));
        let unit = match word {
            "hinge" => context.compiler.angle,
            _ => 1.0,
        };
        let zero = look.find_element("ref").read_numbers::<1>("ref")?;
        part.zero = zero.map_or(0.0, |[x]| x * unit);
        if let Some([low, high]) = look.find_element("range").read_numbers::<2>("range")? {
            part.limits = (low < high).then_some((low * unit - part.zero, high * unit - part.zero));
        }
    }
    Ok(part)
}

/// Returns the direction of a hinge or a slide, which an element gives for it.
fn read_axis(e: Element<'_>, given: Element<'_>) -> Read<Vector> {
    let axis = given.read_vector("axis", Z)?;
    if length(axis) >= 1e-9 {
        return Ok(axis);
    }
    let found = given.attribute("axis").unwrap_or("");
    let want = "give a direction such as 0 0 1";
    Err(e.error_at(Some("axis"), bad_value(&e.label(), "axis", found, want)))
}
