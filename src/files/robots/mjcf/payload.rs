//! What the bodies and joints of an MJCF file carry.

use crate::file::problem::ImportError;
use crate::geom::rigid::RigidMotion;
use crate::robots::convert::payload::{Dynamics, Payload, Weight};
use crate::robots::convert::solid::together;
use crate::robots::description::parts::Robot;
use crate::robots::mjcf::actuators::actuators;
use crate::robots::mjcf::context::{Context, compiler};
use crate::robots::mjcf::defaults::{Defaults, Lookup};
use crate::robots::mjcf::geoms::{Geoms, geom};
use crate::robots::xml::Element;
use std::collections::BTreeMap;

/// Words of a joint that only MuJoCo's solver knows.
const SOLVER: [&str; 6] = [
    "solreflimit",
    "solimplimit",
    "solreffriction",
    "solimpfriction",
    "margin",
    "actuatorgravcomp",
];
/// The same of an equality.
const EQUALITY: [&str; 3] = ["solref", "solimp", "torquescale"];
/// What holds for the whole file.
struct Settings {
    autolimits: bool,
    /// The least mass and moment of inertia of a body.
    least: [f64; 2],
    balance: bool,
    /// Whether shapes say what bodies weigh, and whether even where these say so.
    from_geoms: (bool, bool),
}

/// Reads it; the robot is that of the same document.
pub(crate) fn read(root: Element<'_>, robot: &Robot) -> Result<Payload, ImportError> {
    let context = Context {
        compiler: compiler(root)?,
        defaults: Defaults::read(root)?,
        sites: BTreeMap::new(),
    };
    let mut out = Payload::default();
    let settings = settings(root, &mut out)?;
    let geoms = Geoms::of(root)?;
    let joints: BTreeMap<usize, usize> = robot
        .joints
        .iter()
        .enumerate()
        .filter_map(|(j, p)| Some((p.element?, j)))
        .collect();
    let bodies = BodyReader {
        robot,
        context: &context,
        settings: &settings,
        geoms: &geoms,
        joints: &joints,
    };
    for w in root.named("worldbody") {
        bodies.read(w, &mut out)?;
    }
    for section in root.children() {
        match section.name() {
            "worldbody" | "default" | "compiler" => {}
            "option" => {
                for a in section.attributes() {
                    out.option.push((a.0.to_owned(), a.1.to_owned()));
                }
                section
                    .children()
                    .for_each(|c| out.lost.not_read(c.name(), None));
            }
            "equality" => equalities(section, &context, &joints, &mut out)?,
            "actuator" => actuators(section, &context, robot, &mut out)?,
            "asset" => {
                for a in section
                    .children()
                    .filter(|a| !["mesh", "material"].contains(&a.name()))
                {
                    out.lost
                        .not_read(a.name(), a.attribute("name").or(a.attribute("file")));
                }
            }
            "sensor" | "tendon" | "contact" | "keyframe" | "deformable" | "custom" => {
                for c in section.children() {
                    out.lost.not_read(
                        &format!("{} of <{}>", c.name(), section.name()),
                        c.attribute("name"),
                    );
                }
            }
            other => out.lost.not_read(other, section.attribute("name")),
        }
    }
    Ok(out)
}

/// What `<compiler>` says of weights and limits.
fn settings(root: Element<'_>, out: &mut Payload) -> Result<Settings, ImportError> {
    let mut found = Settings {
        autolimits: true,
        least: [0.0; 2],
        balance: false,
        from_geoms: (true, false),
    };
    for c in root.named("compiler") {
        let is = |key: &str, word: &str| c.attribute(key) == Some(word);
        found.autolimits &= !is("autolimits", "false");
        found.balance |= is("balanceinertia", "true");
        for (x, key) in found.least.iter_mut().zip(["boundmass", "boundinertia"]) {
            *x = c.numbers::<1>(key)?.map_or(*x, |[x]| x);
        }
        match c.attribute("inertiafromgeom") {
            Some("true") => found.from_geoms = (true, true),
            Some("false") => found.from_geoms = (false, false),
            _ => {}
        }
        if c.attribute("settotalmass").is_some() {
            out.lost.not_read("settotalmass", None);
        }
    }
    Ok(found)
}

/// A body or frame still to be read: its link, its place there, and the class of what is in it.
struct Waiting<'a> {
    element: Element<'a>,
    link: usize,
    place: RigidMotion,
    class: Option<&'a str>,
}

/// Reads what bodies carry, with what holds for all of them.
struct BodyReader<'a, 'c> {
    robot: &'c Robot,
    context: &'c Context<'a>,
    settings: &'c Settings,
    geoms: &'c Geoms<'a>,
    /// The joints of the robot by the elements that say them.
    joints: &'c BTreeMap<usize, usize>,
}

impl<'a> BodyReader<'a, '_> {
    /// Reads what the bodies below `w` carry.
    fn read(&self, w: Element<'a>, out: &mut Payload) -> Result<(), ImportError> {
        let mut stack = vec![Waiting {
            element: w,
            link: 0,
            place: RigidMotion::IDENTITY,
            class: w.attribute("childclass"),
        }];
        let mut of_shapes: BTreeMap<usize, Vec<Weight>> = BTreeMap::new();
        while let Some(at) = stack.pop() {
            for e in at.element.children() {
                let inner = |link, place| Waiting {
                    element: e,
                    link,
                    place,
                    class: e.attribute("childclass").or(at.class),
                };
                match e.name() {
                    "body" => {
                        if let Some(&link) = self.robot.said.get(&e.id) {
                            stack.push(inner(link, RigidMotion::IDENTITY));
                            lost_of_body(e, out);
                        }
                    }
                    "frame" => {
                        let place = at.place.then(&self.context.compiler.place(e)?);
                        stack.push(inner(at.link, place));
                    }
                    "geom" => {
                        if let Some(weight) = self.shape(e, &at, out)? {
                            of_shapes.entry(at.link).or_default().push(weight);
                        }
                    }
                    "inertial" => {
                        out.weights.insert(at.link, inertial(e, self.context)?);
                    }
                    "joint" | "freejoint" => self.joint(e, at.class, out)?,
                    "site" => self.site(e, out),
                    other => out.lost.not_read(other, e.attribute("name")),
                }
            }
        }
        weigh(self.robot, of_shapes, self.settings, out);
        Ok(())
    }

    /// Adds a shape to its link; gives what it weighs there.
    fn shape(
        &self,
        e: Element<'a>,
        at: &Waiting<'a>,
        out: &mut Payload,
    ) -> Result<Option<Weight>, ImportError> {
        let look = self.context.defaults.of(e, "geom", at.class)?;
        let Some((mut shape, weight)) = geom(e, &look, self.context, self.geoms, out)? else {
            return Ok(None);
        };
        shape.place = at.place.then(&shape.place);
        out.shape(at.link, shape);
        Ok(weight.map(|w| Weight {
            place: at.place.then(&w.place),
            ..w
        }))
    }

    fn joint(
        &self,
        e: Element<'a>,
        class: Option<&'a str>,
        out: &mut Payload,
    ) -> Result<(), ImportError> {
        let Some(&j) = self.joints.get(&e.id) else {
            return Ok(());
        };
        let part = &self.robot.joints[j];
        let tag = if e.name() == "joint" { "joint" } else { "" };
        let look = self.context.defaults.of(e, tag, class)?;
        let own = dynamics(&look, &part.id, self.settings, out);
        let turns = part.joint_type.freedoms().iter().all(|f| f.turns());
        let unit = if turns {
            self.context.compiler.angle
        } else {
            1.0
        };
        let rest = own.rest * unit - part.zero;
        let rest = if own.stiffness > 0.0 { rest } else { 0.0 };
        out.dynamics.insert(j, vec![Dynamics { rest, ..own }]);
        Ok(())
    }

    fn site(&self, e: Element<'a>, out: &mut Payload) {
        if let Some((link, place)) = e.attribute("name").and_then(|n| self.robot.frame(n)) {
            let name = e.attribute("name").unwrap_or("").to_owned();
            out.frames.push((name, link, place));
        }
    }
}

/// Notes what a body says that is not read.
fn lost_of_body(e: Element<'_>, out: &mut Payload) {
    let words = e
        .attributes()
        .filter(|(k, _)| ["gravcomp", "user"].contains(k));
    words.for_each(|(k, _)| {
        out.lost
            .not_read(&format!("{k} of a body"), e.attribute("name"));
    });
}

/// Weights of bodies by their shapes where nothing else is said, and no less than what the file asks for.
fn weigh(
    robot: &Robot,
    of_shapes: BTreeMap<usize, Vec<Weight>>,
    settings: &Settings,
    out: &mut Payload,
) {
    if settings.from_geoms.0 {
        // What stands still for good needs no weight.
        for (link, all) in of_shapes.into_iter().filter(|(l, _)| *l != 0) {
            let asked = settings.from_geoms.1 || !out.weights.contains_key(&link);
            let known = all.iter().filter(|w| !w.mass.is_nan()).copied();
            let known: Vec<Weight> = known.collect();
            if asked && known.len() < all.len() {
                let name = robot.links.get(link).map(String::as_str);
                let why =
                    "a body without <inertial> weighs what its mesh does, whose file is not read";
                out.lost.one("mass of a mesh", name, why);
            }
            if let (true, Some(w)) = (asked, together(&known)) {
                out.weights.insert(link, w);
            }
        }
    }
    let [mass, inertia] = settings.least;
    for &l in robot.said.values().filter(|l| **l != 0) {
        if mass > 0.0 || inertia > 0.0 {
            let empty = Weight {
                mass: 0.0,
                place: RigidMotion::IDENTITY,
                tensor: [0.0; 6],
            };
            let w = out.weights.entry(l).or_insert(empty);
            w.mass = w.mass.max(mass);
            w.tensor[..3].iter_mut().for_each(|x| *x = x.max(inertia));
        }
        if let (true, Some(w)) = (settings.balance, out.weights.get_mut(&l)) {
            let [x, y, z, ..] = w.tensor;
            if x + y < z || x + z < y || y + z < x {
                w.tensor[..3].fill((x + y + z) / 3.0);
            }
        }
    }
}

fn inertial(e: Element<'_>, context: &Context<'_>) -> Result<Weight, ImportError> {
    let mass = e.numbers::<1>("mass")?.map_or(0.0, |[x]| x);
    let mut tensor = [0.0; 6];
    if let Some(d) = e.numbers::<3>("diaginertia")? {
        tensor[..3].copy_from_slice(&d);
    }
    if let Some(all) = e.numbers::<6>("fullinertia")? {
        tensor = all;
    }
    let place = context.compiler.place(e)?;
    Ok(Weight {
        mass,
        place,
        tensor,
    })
}

/// The first number of an attribute, told where there are more or where it is none.
fn first(look: &Lookup<'_>, key: &str, joint: &str, out: &mut Payload) -> Option<f64> {
    let (_, text) = look.attribute(key)?;
    let mut words = text
        .split_whitespace()
        .map(|w| w.parse::<f64>().ok().filter(|x| x.is_finite()));
    let found = words.next().flatten();
    if words.any(|w| w != Some(0.0)) {
        out.lost
            .not_read(&format!("higher terms of {key}"), Some(joint));
    }
    found
}

fn dynamics(look: &Lookup<'_>, joint: &str, settings: &Settings, out: &mut Payload) -> Dynamics {
    let mut one = |key: &str| first(look, key, joint, out).unwrap_or(0.0);
    let mut d = Dynamics {
        damping: one("damping"),
        friction: one("frictionloss"),
        armature: one("armature"),
        stiffness: one("stiffness"),
        rest: one("springref"),
        ..Dynamics::default()
    };
    d.unlimited = match look.attribute("limited").map(|a| a.1) {
        Some("true") => false,
        Some("false") => true,
        _ => !settings.autolimits,
    };
    if let Ok(Some([low, high])) = look.numbers::<2>("actuatorfrcrange") {
        let held = look
            .attribute("actuatorfrclimited")
            .is_none_or(|a| a.1 != "false");
        if held && low < high {
            d.effort = high.max(-low);
        }
    }
    if look.attribute("springdamper").is_some() {
        out.lost.not_read("springdamper", Some(joint));
    }
    d.words = look.words(&SOLVER);
    d
}

fn equalities(
    section: Element<'_>,
    context: &Context<'_>,
    joints: &BTreeMap<usize, usize>,
    out: &mut Payload,
) -> Result<(), ImportError> {
    for e in section.children() {
        let look = context.defaults.of(e, "equality", None)?;
        let own = look.words(&EQUALITY);
        if look.attribute("active").is_some_and(|(_, v)| v == "false") {
            out.lost.not_read("inactive equality", e.attribute("name"));
            continue;
        }
        match (e.name(), joints.get(&e.id)) {
            ("connect" | "weld", Some(&j)) => {
                // A weld that holds no turns is read as a ball.
                let ball = look
                    .attribute("torquescale")
                    .is_some_and(|(_, v)| v.trim() == "0");
                let own = own.into_iter().filter(|(k, _)| k != "torquescale" || !ball);
                out.closures.insert(j, own.collect());
            }
            ("joint", _) => {
                out.couplings.insert(
                    e.id,
                    own.into_iter()
                        .filter(|(k, _)| k != "torquescale")
                        .collect(),
                );
                let offset = e
                    .attribute("polycoef")
                    .and_then(|t| t.split_whitespace().next()?.parse::<f64>().ok());
                match (e.attribute("joint2"), offset) {
                    (Some(_), Some(x)) if x != 0.0 => {
                        out.offsets.insert(e.id, x);
                    }
                    _ => {}
                }
            }
            (other, _) => out
                .lost
                .not_read(&format!("{other} of <equality>"), e.attribute("name")),
        }
    }
    Ok(())
}
