//! Settings, default classes and sites that the sections of an MJCF file share.

use crate::robots::prelude::*;

/// The settings of `<compiler>`.
#[derive(Debug, Clone)]
pub(super) struct Compiler {
    /// Radians in the file's unit of angle.
    pub(super) angle: f64,
    eulerseq: String,
}

/// The data that the sections of a file share.
pub(super) struct Context<'a> {
    pub(super) compiler: Compiler,
    pub(crate) defaults: Defaults<'a>,
    /// Sites by name: the link and the place on it.
    pub(crate) sites: BTreeMap<String, (usize, RigidMotion)>,
}

pub(super) fn read_compiler(root: Element<'_>) -> Read<Compiler> {
    let degree = std::f64::consts::PI / 180.0;
    let mut out = Compiler {
        angle: degree,
        eulerseq: "xyz".to_owned(),
    };
    for c in root.children_named("compiler") {
        match c.attribute("angle") {
            None => {}
            Some("radian") => out.angle = 1.0,
            Some("degree") => out.angle = degree,
            Some(other) => return Err(c.unknown_word("angle", other, "radian, degree")),
        }
        if let Some(seq) = c.attribute("eulerseq") {
            if seq.chars().count() != 3 || !seq.chars().all(|c| "xyzXYZ".contains(c)) {
                return Err(c.unknown_word("eulerseq", seq, "three of x, y, z, X, Y, Z"));
            }
            seq.clone_into(&mut out.eulerseq);
        }
        if c.attribute("coordinate") == Some("global") {
            let remedy = "save the model with MuJoCo 2.3 or later";
            return Err(c.unsupported_error("global coordinates", remedy));
        }
    }
    Ok(out)
}

/// The five forms of an orientation.
const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

impl Compiler {
    /// Returns the placement given by `pos` and one of the five forms of orientation.
    pub(super) fn read_place(&self, e: Element<'_>) -> Read<RigidMotion> {
        let mut out = self.read_rotation(e)?;
        out.translation = e.read_vector("pos", [0.0; 3])?;
        Ok(out)
    }

    /// Returns the rotation given by one of the five forms.
    pub(super) fn read_rotation(&self, e: Element<'_>) -> Read<RigidMotion> {
        let nonzero = |name: &str, size: f64| {
            let want = "give a direction or quaternion that is not zero";
            let found = e.attribute(name).unwrap_or("");
            let problem = || e.error_at(Some(name), bad_value(&e.label(), name, found, want));
            (size >= 1e-9).then_some(()).ok_or_else(problem)
        };
        let given = ORIENTATIONS.into_iter();
        let given: Vec<&str> = given.filter(|w| e.attribute(w).is_some()).collect();
        if given.len() > 1 {
            let why = format!("it has two orientations, {}", given.join(" and "));
            return Err(e.unsupported_error(&why, "keep one"));
        }
        let mut pose = RigidMotion::IDENTITY;
        if let Some(q) = e.read_numbers::<4>("quat")? {
            nonzero("quat", q.iter().fold(0.0, |most, x| x.abs().max(most)))?;
            pose = RigidMotion::from_quaternion([0.0; 3], q);
        } else if let Some([x, y, z, angle]) = e.read_numbers::<4>("axisangle")? {
            nonzero("axisangle", length([x, y, z]))?;
            pose = pose.then(&RigidMotion::from_turn([x, y, z], angle * self.angle));
        } else if let Some([a, b, c, d, f, g]) = e.read_numbers::<6>("xyaxes")? {
            let x = unit_or_z([a, b, c]);
            let y = sub([d, f, g], scale(x, dot(x, [d, f, g])));
            nonzero("xyaxes", length([a, b, c]).min(length(y)))?;
            let (y, z) = (unit_or_z(y), cross(x, unit_or_z(y)));
            pose.rotation = [0, 1, 2].map(|i| [x[i], y[i], z[i]]);
        } else if let Some(z) = e.read_numbers::<3>("zaxis")? {
            nonzero("zaxis", length(z))?;
            pose = pose.then(&RigidMotion::z_to(z));
        } else if let Some(angles) = e.read_numbers::<3>("euler")? {
            pose = pose.then(&self.euler_rotation(angles));
        }
        Ok(pose)
    }

    /// Returns three rotations in the order that the file asks for.
    fn euler_rotation(&self, angles: [f64; 3]) -> RigidMotion {
        let mut turn = RigidMotion::IDENTITY;
        for (axis, angle) in self.eulerseq.chars().zip(angles) {
            let about = match axis.to_ascii_lowercase() {
                'x' => X,
                'y' => Y,
                _ => Z,
            };
            let step = RigidMotion::from_turn(about, angle * self.angle);
            // Small letters turn with the frame, capitals about the fixed axes.
            let moves = axis.is_lowercase();
            let (first, then) = if moves { (turn, step) } else { (step, turn) };
            turn = first.then(&then);
        }
        turn
    }
}

/// The name of a class, if there is one.
type Class<'a> = Option<&'a str>;

/// The classes: for each the class around it and its `<default>` elements.
pub(crate) struct Defaults<'a> {
    classes: BTreeMap<&'a str, (Option<&'a str>, Vec<Element<'a>>)>,
}

/// The elements in which an element's attributes are looked up: itself, then its classes from the innermost out.
pub(crate) struct Lookup<'a> {
    places: Vec<Element<'a>>,
}

impl<'a> Defaults<'a> {
    pub(crate) fn read(root: Element<'a>) -> Read<Defaults<'a>> {
        let mut classes: BTreeMap<&str, (Option<&str>, Vec<Element<'_>>)> = BTreeMap::new();
        let mut stack: Vec<(Element<'_>, Option<&str>)> =
            root.children_named("default").map(|d| (d, None)).collect();
        stack.reverse();
        while let Some((d, outer)) = stack.pop() {
            let class = match (d.attribute("class"), outer) {
                (Some(c), _) => c,
                (None, None) => "main",
                (None, Some(_)) => return Err(d.missing_error("attribute class")),
            };
            let entry = classes.entry(class).or_insert((outer, Vec::new()));
            if entry.0 != outer {
                let message =
                    format!("default class \"{class}\" is defined twice; names must be unique");
                return Err(d.error_at(Some("class"), syntax_problem(message)));
            }
            entry.1.push(d);
            let inner = d.children_named("default");
            stack.extend(inner.map(|inner| (inner, Some(class))));
        }
        Ok(Defaults { classes })
    }

    /// Returns the elements that hold the attributes of an element. The first is the element itself. The second is `tag` in its class,
    /// otherwise in the class of the bodies around it, otherwise in the main one.
    pub(crate) fn lookup(&self, e: Element<'a>, tag: &str, class: Class<'a>) -> Read<Lookup<'a>> {
        let given = e.attribute("class").or(class);
        if let Some(c) = given
            && !self.classes.contains_key(c)
        {
            let what = ["default class", "classes"];
            return Err(e.unknown_name(Some("class"), what, c, self.classes.keys()));
        }
        let mut places = vec![e];
        // A class is only ever within one that was read before, so that this ends; the bound is for repeated names.
        let mut all = self.classes.iter();
        let outermost = || all.find(|(_, (outer, _))| outer.is_none()).map(|(c, _)| *c);
        let mut next = given.or_else(outermost);
        for _ in 0..=self.classes.len() {
            let Some((outer, elements)) = next.and_then(|c| self.classes.get(c)) else {
                break;
            };
            places.extend(elements.iter().rev().filter_map(|d| d.first_child(tag)));
            next = *outer;
        }
        Ok(Lookup { places })
    }
}

impl<'a> Lookup<'a> {
    /// Returns the element that gives an attribute. If none does, returns the first.
    pub(crate) fn find_element(&self, name: &str) -> Element<'a> {
        let given = self.places.iter().find(|e| e.attribute(name).is_some());
        *given.unwrap_or(&self.places[0])
    }
}
