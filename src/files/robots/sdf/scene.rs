//! Elements with a place in an SDF file, and their places.

use crate::robots::prelude::*;

/// An element with a place: a model, link, frame or joint.
pub(crate) struct Placed<'a> {
    pub(super) element: Element<'a>,
    /// The name of the element that its place is relative to.
    pub(super) relative_to: String,
    /// Place relative to that element.
    pub(super) raw: RigidMotion,
    /// The element it moves with: itself for links, another name for frames, the child for joints.
    pub(super) attached_to: String,
    /// Its place in the world, once known.
    pub(super) world: Option<RigidMotion>,
    pub(crate) link: Option<usize>,
}

impl<'a> Placed<'a> {
    /// Creates an element that is not a link, whose place in the world is not known yet.
    pub(crate) fn new(
        element: Element<'a>,
        relative_to: String,
        raw: RigidMotion,
        attached_to: String,
    ) -> Placed<'a> {
        Placed {
            element,
            relative_to,
            raw,
            attached_to,
            world: None,
            link: None,
        }
    }
}

/// An element and the scope of its names.
pub(crate) type Scoped<'a> = (Element<'a>, String);

#[derive(Default)]
pub(crate) struct SdfScene<'a> {
    pub(super) placed: BTreeMap<String, Placed<'a>>,
    pub(super) joints: Vec<Scoped<'a>>,
    pub(crate) constraints: Vec<Scoped<'a>>,
    /// Links of static models.
    pub(super) fixed: Vec<usize>,
    /// By file, whether axes are given in the model's frame: before SDF 1.5.
    pub(super) old_axes: Vec<bool>,
    /// Whether joints put their parent frame onto the child.
    pub(super) assemble: bool,
    /// Plugins of models and worlds, each with its scope.
    pub(super) plugins: Vec<Scoped<'a>>,
    /// Elements of models that are not known.
    pub(super) unknown: Vec<Element<'a>>,
    /// The link that is the world.
    pub(crate) world: usize,
}

/// Suffix of the name of a joint's frame, if a link has the same name.
pub(crate) const BESIDE: &str = "~joint";

/// Returns the place of a joint, once known.
pub(crate) fn of_joint(scene: &SdfScene<'_>, e: Element<'_>, name: &str) -> Option<RigidMotion> {
    let own = |p: &&Placed<'_>| p.element.id == e.id;
    let found = scene.placed.get(name).filter(own);
    let found = found.or_else(|| scene.placed.get(&format!("{name}{BESIDE}")));
    found.and_then(|p| p.world)
}

/// Returns a name as seen from a scope.
pub(crate) fn absolute_name(scope: &str, name: &str) -> String {
    if name == "world" {
        name.to_owned()
    } else {
        format!("{scope}{name}")
    }
}

pub(crate) fn insert<'a>(scene: &mut SdfScene<'a>, name: String, p: Placed<'a>) -> Read<()> {
    p.element
        .check_room("links, frames and joints", scene.placed.len())?;
    if name == "world" || scene.placed.contains_key(&name) {
        return Err(p.element.duplicate_error());
    }
    scene.placed.insert(name, p);
    Ok(())
}

pub(crate) fn unknown_name_error(e: Element<'_>, name: &str, scene: &SdfScene<'_>) -> ImportError {
    e.unknown_name(None, ["link or frame", "names"], name, scene.placed.keys())
}

/// Works out all places in the world.
pub(crate) fn resolve_places(scene: &mut SdfScene<'_>) -> Read<()> {
    let names: Vec<String> = scene.placed.keys().cloned().collect();
    for name in names {
        // Down to an element whose place is known, then back.
        let mut path: Vec<String> = Vec::new();
        let mut at = name;
        let mut base = loop {
            if at == "world" {
                break RigidMotion::IDENTITY;
            }
            let from = path.last().map(|p| scene.placed[p].element);
            let Some(p) = scene.placed.get(&at) else {
                let Some(e) = from else {
                    break RigidMotion::IDENTITY;
                };
                return Err(unknown_name_error(e, &at, scene));
            };
            if let Some(w) = p.world {
                break w;
            }
            if path.len() > scene.placed.len() {
                let why = "its place is relative to itself through other elements";
                let remedy = "change one of their relative_to";
                return Err(p.element.unsupported_error(why, remedy));
            }
            let next = p.relative_to.clone();
            path.push(at);
            at = next;
        };
        for n in path.iter().rev() {
            if let Some(p) = scene.placed.get_mut(n) {
                base = base.then(&p.raw);
                p.world = Some(base);
            }
        }
    }
    Ok(())
}

/// Returns the link that a name moves with, and the name's place in the world.
pub(crate) fn moves_with(scene: &SdfScene<'_>, name: &str) -> Result<End, Option<String>> {
    if name == "world" {
        return Ok((scene.world, RigidMotion::IDENTITY));
    }
    let find = |n: &str| scene.placed.get(n).ok_or_else(|| Some(n.to_owned()));
    let first = find(name)?;
    let world = first.world.unwrap_or(RigidMotion::IDENTITY);
    let mut at = first;
    for _ in 0..=scene.placed.len() {
        if let Some(l) = at.link {
            return Ok((l, world));
        }
        if at.attached_to == "world" {
            return Ok((scene.world, world));
        }
        at = find(&at.attached_to)?;
    }
    Err(None)
}

pub(crate) fn locate_name(e: Element<'_>, name: &str, scene: &SdfScene<'_>) -> Read<End> {
    moves_with(scene, name).map_err(|missing| match missing {
        Some(n) => unknown_name_error(e, &n, scene),
        None => {
            let why = format!("{name} is attached to itself through other elements");
            e.unsupported_error(&why, "attach it to a link")
        }
    })
}

/// Returns the parent or child of a joint: the element and the name, which old files have as an attribute.
pub(crate) fn joint_end<'a>(e: Element<'a>, tag: &str) -> Read<(Element<'a>, &'a str)> {
    let name = |c: Element<'a>| match c.text() {
        "" => c.attribute("link").unwrap_or(""),
        text => text,
    };
    let found = e.first_child(tag).map(|c| (c, name(c)));
    let found = found.filter(|(_, name)| !name.is_empty());
    found.ok_or_else(|| e.missing_error(&format!("<{tag}> with the name of a link")))
}

/// Adds a frame or joint, whose place is relative to `own` by default; a joint that shares its name has its own frame.
pub(crate) fn named_place<'a>(
    e: Element<'a>,
    scope: &str,
    own: &str,
    shared: bool,
    scene: &mut SdfScene<'a>,
) -> Read<()> {
    let mut name = format!("{scope}{}", e.required_attribute("name")?);
    let (raw, relative) = read_pose(e)?;
    let attached_to = if e.name() == "joint" {
        e.check_room("joints", scene.joints.len())?;
        scene.joints.push((e, scope.to_owned()));
        if shared {
            name += BESIDE;
        }
        absolute_name(scope, joint_end(e, "child")?.1)
    } else {
        let to = e.attribute("attached_to").filter(|a| !a.is_empty());
        to.map_or_else(|| own.to_owned(), |a| absolute_name(scope, a))
    };
    let relative_to = relative.map_or_else(|| attached_to.clone(), |r| absolute_name(scope, r));
    insert(scene, name, Placed::new(e, relative_to, raw, attached_to))
}

/// Reads the pose child: its numbers, its reference frame, and its unit.
pub(crate) fn read_pose(e: Element<'_>) -> Read<(RigidMotion, Option<&str>)> {
    let Some(p) = e.first_child("pose") else {
        return Ok((RigidMotion::IDENTITY, None));
    };
    let relative = p.attribute("relative_to").or(p.attribute("frame"));
    let relative = relative.filter(|r| !r.is_empty());
    if p.text().is_empty() {
        return Ok((RigidMotion::IDENTITY, relative));
    }
    if p.attribute("rotation_format") == Some("quat_xyzw") {
        let [a, b, c, x, y, z, w] = p.text_numbers::<7>()?;
        let place = RigidMotion::from_quaternion([a, b, c], [w, x, y, z]);
        return Ok((place, relative));
    }
    let [x, y, z, roll, pitch, yaw] = p.text_numbers::<6>()?;
    let degrees = p.attribute("degrees");
    let degrees = degrees.is_some_and(|d| ["true", "1"].contains(&d));
    let degree = std::f64::consts::PI / 180.0;
    let turn = scale([roll, pitch, yaw], if degrees { degree } else { 1.0 });
    Ok((RigidMotion::roll_pitch_yaw([x, y, z], turn), relative))
}
