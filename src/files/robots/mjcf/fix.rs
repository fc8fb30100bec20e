//! Joints of one more freedom in an MJCF file. `<joint>`s are added to a body behind its own joints, and bodies are inserted between the
//! two sides of a `<connect>` or `<weld>`. Keyframes get the numbers of the new joints.

use crate::robots::description::origin::Origin;
use crate::robots::description::physical::LIGHT_MJCF;
use crate::robots::edit::{Edits, Freed, Freeing};
use crate::robots::mechanism::series_of_single_joints::{format_numbers, write_attributes};
use crate::robots::prelude::*;

/// Armature of a new joint, in kg for a slide and in kg·m² for a hinge: more than any robot weighs. MuJoCo softens a constraint by the
/// mean weight of its bodies in all directions, so a light body in between would let the loop open. The new joint does not move while the
/// loop stays closed, so its armature changes no motion, however large it is.
const ARMATURE: f64 = 1000.0;

/// Attributes that undo the defaults of the classes around a new joint.
const NEUTRAL: &str = "limited=\"false\" stiffness=\"0\" springdamper=\"0 0\" frictionloss=\"0\" ref=\"0\" springref=\"0\"";

/// Gives joints freedoms.
pub(crate) fn free_joints(origin: &Origin, all: &[Freeing<'_>], edits: &mut Edits<'_>) -> Read<()> {
    let mut file = MjcfFile {
        origin,
        parents: find_parents(origin),
        inserted: Vec::new(),
    };
    for joint in all {
        let &(_, e, freed) = joint;
        // A connect that may slide in three directions has no constraints.
        let slides = freed.iter().filter(|f| f.0).count();
        if e.name() == "connect" && slides == 3 {
            let why = "ozols fix: disabled, because other joints impose the same constraints";
            deactivate(e.id, why, edits)?;
            continue;
        }
        match e.name() {
            "connect" | "weld" => file.at_closure(joint, edits)?,
            _ => file.in_body(e, freed, edits)?,
        }
    }
    file.extend_keyframes(edits)
}

/// Removes an equality of joints.
pub(crate) fn deactivate(element: usize, why: &str, edits: &mut Edits<'_>) -> Read<()> {
    let e = edits.origin.element(element);
    edits.set_attribute(e, "active", "false")?;
    edits.insert_after(e, &[format!("<!-- {why} -->")]);
    Ok(())
}

/// The position of new joints among those of a keyframe.
#[derive(Debug, Clone, Copy, PartialEq)]
enum KeyframeMark {
    /// Behind a joint.
    Joint(usize),
    /// Behind all elements within a body or the world.
    Within(usize),
}

/// The numbers of `qpos` and of `qvel` before each mark.
type Marks = Vec<(KeyframeMark, [usize; 2])>;

struct MjcfFile<'a> {
    origin: &'a Origin,
    parents: Vec<Option<usize>>,
    /// Inserted joints.
    inserted: Vec<(KeyframeMark, usize)>,
}

impl<'a> MjcfFile<'a> {
    /// Returns the body, or world, around an element.
    fn body_around(&self, id: usize) -> Element<'a> {
        let mut at = self.parents[id];
        while let Some(id) = at {
            if ["body", "worldbody"].contains(&self.origin.element(id).name()) {
                break;
            }
            at = self.parents[id];
        }
        self.origin.element(at.unwrap_or(self.origin.root))
    }

    /// Inserts joints after the joints of a body.
    fn in_body(&mut self, e: Element<'a>, freed: Freed<'_>, edits: &mut Edits<'_>) -> Read<()> {
        let body = self.body_around(e.id);
        let own = self.origin.robot.joints.iter().rev();
        let own = own.filter_map(|p| Some((p, p.element?)));
        let last = own.into_iter().find(|&(p, id)| {
            let joint = self.origin.element(id).name() != "body";
            joint && !p.closes && self.body_around(id).id == body.id
        });
        let (Some((link, last)), Some(part)) = (last, self.part_of(e.id)) else {
            return Err(e.unsupported_error("it is not a joint of a body", "choose another"));
        };
        let last = self.origin.element(last);
        if self.parents[last.id] != Some(body.id) {
            return Err(e.unsupported_error("its body has joints in a <frame>", "choose another"));
        }
        let frame = self.origin.places[link.links[1]];
        let at = self.origin.places[part.links[1]].then(&part.sides[1]);
        let point = at.translation;
        let lines = write_joints(part, point, &frame, freed, edits);
        edits.insert_after(last, &lines);
        let mark = KeyframeMark::Joint(last.id);
        self.inserted.push((mark, freed.len()));
        Ok(())
    }

    fn part_of(&self, element: usize) -> Option<&'a Part> {
        let all = self.origin.robot.joints.iter();
        all.rev().find(|p| p.element == Some(element))
    }

    /// Returns the first element with the given tag and, if one is given, with the given name.
    fn find_named(&self, tag: &str, name: Option<&str>) -> Option<Element<'a>> {
        let mut all = (0..self.parents.len()).map(|id| self.origin.element(id));
        all.find(|e| e.name() == tag && (name.is_none() || e.attribute("name") == name))
    }

    /// Inserts a body that moves on the first body and is held in its place. If sites are held together, it has one in place of the
    /// first.
    fn at_closure(&mut self, joint: &Freeing<'a>, edits: &mut Edits<'_>) -> Read<()> {
        let &(part, e, freed) = joint;
        let (robot, one) = (&self.origin.robot, part.links[0]);
        let site = e.attribute("site1");
        let body = if let Some(site) = site {
            let found = self.find_named("site", Some(site));
            found.map(|found| self.body_around(found.id))
        } else if robot.world == Some(one) {
            self.find_named("worldbody", None)
        } else {
            self.find_named("body", Some(&robot.links[one]))
        };
        let body =
            body.ok_or_else(|| e.unsupported_error("its first body has no name", "give it one"))?;
        let frame = self.origin.places[one];
        let at = part.sides[0];
        let between = edits.name(&format!("{}_between", part.id));
        let place = format_numbers(at.translation);
        let own = write_attributes([("name", &*between)]);
        let mut lines = vec![
            format!("<body{own}>"),
            format!("  <inertial pos=\"{place}\" {LIGHT_MJCF}/>"),
        ];
        let point = frame.map_point(at.translation);
        let inner = write_joints(part, point, &frame, freed, edits);
        lines.extend(inner.into_iter().map(|l| format!("  {l}")));
        if let Some(site) = site {
            let copy = edits.name(&format!("{site}_between"));
            let [x, y] = [0, 1].map(|k| format_numbers(at.rotation.map(|row| row[k])));
            let axes = format!("{x} {y}");
            let own = [("name", &*copy), ("pos", &*place), ("xyaxes", &*axes)];
            lines.push(format!("  <site{}/>", write_attributes(own)));
            edits.set_attribute(e, "site1", &copy)?;
        } else {
            edits.set_attribute(e, "body1", &between)?;
        }
        lines.push("</body>".to_owned());
        edits.append_child(body, &lines);
        let mark = KeyframeMark::Within(body.id);
        self.inserted.push((mark, freed.len()));
        Ok(())
    }

    /// Zeros for the new joints in the positions and speeds of keyframes.
    fn extend_keyframes(&self, edits: &mut Edits<'_>) -> Read<()> {
        let root = self.origin.element(self.origin.root);
        let keys = root.children_named("keyframe");
        let keys = keys.flat_map(|k| k.children_named("key").collect::<Vec<_>>());
        let keys: Vec<Element<'a>> = keys.collect();
        if keys.is_empty() {
            return Ok(());
        }
        let (mut total, mut marks) = ([0, 0], Vec::new());
        for w in root.children_named("worldbody") {
            self.walk_below(w, &mut total, &mut marks);
        }
        for key in keys {
            for (which, attribute) in ["qpos", "qvel"].into_iter().enumerate() {
                let Some(text) = key.attribute(attribute) else {
                    continue;
                };
                if text.split_whitespace().count() != total[which] {
                    let why = format!("{attribute} has not {} numbers", total[which]);
                    return Err(key.unsupported_error(&why, "correct or remove the keyframe"));
                }
                let Some(span) = key.value_span(attribute) else {
                    let why = "it has character references";
                    return Err(key.unsupported_error(why, "write it as plain text"));
                };
                let start = key.node().span.start;
                let starts =
                    word_starts(&edits.raw_text(key)[span.start - start..span.end - start]);
                for (mark, count) in &self.inserted {
                    let place = marks.iter().find(|(m, _)| m == mark);
                    let Some((_, sizes)) = place else { continue };
                    let zeros = " 0".repeat(*count);
                    match starts.get(sizes[which]) {
                        Some(at) => {
                            let at = span.start + at;
                            edits.replace_span(key, at..at, format!("{} ", zeros.trim_start()));
                        }
                        None => edits.replace_span(key, span.end..span.end, zeros),
                    }
                }
            }
        }
        Ok(())
    }

    /// Walks through bodies in the order of MuJoCo, depth first, each with its own joints first, and marks the numbers of `qpos` and of
    /// `qvel` so far.
    fn walk_below(&self, e: Element<'a>, sizes: &mut [usize; 2], marks: &mut Marks) {
        let is_joint = |c: &Element<'_>| ["joint", "freejoint"].contains(&c.name());
        for j in e.children().filter(is_joint) {
            let part = self.part_of(j.id);
            let freedoms = part.map_or(0, |p| p.joint_type.freedoms().len());
            // A ball's and a free joint's turns are quaternions.
            sizes[0] += freedoms + usize::from(freedoms > 1);
            sizes[1] += freedoms;
            marks.push((KeyframeMark::Joint(j.id), *sizes));
        }
        for c in e.children() {
            if ["body", "frame"].contains(&c.name()) {
                self.walk_below(c, sizes, marks);
            }
        }
        marks.push((KeyframeMark::Within(e.id), *sizes));
    }
}

/// Writes the new joints of a joint, in a frame at a place in the world.
fn write_joints(
    part: &Part,
    point: Vector,
    frame: &RigidMotion,
    freed: Freed<'_>,
    edits: &mut Edits<'_>,
) -> Vec<String> {
    let (mut out, inside) = (Vec::new(), frame.inverse());
    let (origin, mut neutral) = (edits.origin, String::new());
    let root = origin.element(origin.root);
    if root.first_child("default").is_some() {
        neutral = format!(" {NEUTRAL}");
        // Releases of MuJoCo before 3.0 do not know this attribute.
        let mut sources = origin.document.sources.iter();
        if sources.any(|s| s.text.contains("actuatorfrc")) {
            neutral += " actuatorfrclimited=\"false\"";
        }
    }
    for (slides, direction, why) in freed {
        let (kind, word) = if *slides {
            ("slide", "slide")
        } else {
            ("hinge", "turn")
        };
        let name = edits.name(&format!("{}_{word}", part.id));
        out.push(format!("<!-- {why} -->"));
        let pos = format_numbers(inside.map_point(point));
        let axis = format_numbers(inside.map_direction(*direction));
        let own = [
            ("name", &*name),
            ("type", kind),
            ("pos", &pos),
            ("axis", &axis),
        ];
        let own = write_attributes(own);
        out.push(format!("<joint{own} armature=\"{ARMATURE}\"{neutral}/>"));
    }
    out
}

/// Returns the starts of the words of a text.
fn word_starts(text: &str) -> Vec<usize> {
    let start = text.as_ptr() as usize;
    text.split_whitespace()
        .map(|w| w.as_ptr() as usize - start)
        .collect()
}

/// Returns the parent of each element.
fn find_parents(origin: &Origin) -> Vec<Option<usize>> {
    let mut out = vec![None; origin.document.nodes.len()];
    for (id, node) in origin.document.nodes.iter().enumerate() {
        for &c in &node.children {
            out[c] = Some(id);
        }
    }
    out
}
