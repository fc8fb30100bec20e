//! FreeCAD documents with assemblies, `.FCStd`: the parts of an assembly at their places, and its joints.

mod distance;
mod objects;
mod reference;

use crate::robots::cad::archive::Archive;
use crate::robots::cad::fcstd::distance::{Held, Shapes, Slide, joint_constraint, joint_frames};
use crate::robots::cad::fcstd::objects::{Object, Objects};
use crate::robots::cad::fcstd::reference::NoReference::{Broken, Invalid};
use crate::robots::cad::fcstd::reference::{Documents, Reference};
use crate::robots::cad::{Assembly, Connection, NO_LIMITS};
use crate::robots::prelude::*;

/// The member of the archive that lists the objects.
pub(crate) const DOCUMENT: &str = "Document.xml";

/// Maximum number of documents that one may link to, including indirect links.
const MAX_LINKED: usize = 100;
/// Rows of a joint of an unknown type: the maximum that still allows a motion.
const UNKNOWN_ROWS: usize = 5;

/// Properties that enable the limits of a joint.
const LIMITS: &str = "EnableLengthMin EnableLengthMax EnableAngleMin EnableAngleMax";

/// Reads the assembly of a document as a robot.
///
/// # Errors
/// Returns the first problem found, with its place.
pub(crate) fn read_document(input: Input<'_>) -> Read<Robot> {
    let (document, root, read) = (input.document, input.root, input.read);
    let mut robot = Robot::new("");
    let roots = read_linked(document, root, read, &mut robot)?;
    let objects = |(file, root): (String, usize)| {
        let objects = Objects::read_objects(document.element(root))?;
        Ok((file, objects))
    };
    let all: BTreeMap<String, Objects<'_>> = roots.into_iter().map(objects).collect::<Read<_>>()?;
    let assembly = choose_assembly(document.element(root), &all[""], input.options, &mut robot)?;
    let shapes = |member: &str| String::from_utf8(read(member).ok()?).ok();
    let reading = Assembling {
        joints: assembly_joints(&all[""], &assembly),
        documents: Documents { all, assembly },
        shapes: &shapes,
    };
    let assembly = reading.read_assembly(document.element(root), &mut robot)?;
    Ok(assembly.to_robot(robot, input.options))
}

/// Reads the documents that links lead to, with those that these lead to. Returns their root elements by the names of their files;
/// that of the first document has no name.
fn read_linked(
    document: &mut Document,
    root: usize,
    read: Reader<'_>,
    robot: &mut Robot,
) -> Read<BTreeMap<String, usize>> {
    let mut out = BTreeMap::from([(String::new(), root)]);
    let mut wanted = linked_files(document, root)?;
    let mut seen: BTreeSet<String> = wanted.iter().cloned().collect();
    while let Some(file) = wanted.pop() {
        if out.len() > MAX_LINKED {
            let problem = too_many("linked documents", MAX_LINKED);
            return Err(document.element(root).error_at(None, problem));
        }
        let bytes = match read(&file) {
            Ok(bytes) => bytes,
            Err(why) => {
                let what = format!("linked document that cannot be read ({why})");
                robot.report.drop_element(&what, &file);
                continue;
            }
        };
        let archive = Archive::find_archive(&file, &bytes);
        let member = archive.map(|a| a.read_member(DOCUMENT)).transpose()?;
        let Some(member) = member.flatten() else {
            let what = "linked document that is not a FreeCAD document";
            robot.report.drop_element(what, &file);
            continue;
        };
        let name = format!("{file}/{DOCUMENT}");
        let inner = document.read(&name, decode_utf8(&name, &member)?)?;
        out.insert(file, inner);
        for more in linked_files(document, inner)? {
            if seen.insert(more.clone()) {
                wanted.push(more);
            }
        }
    }
    Ok(out)
}

/// Returns the files that links of a document refer to.
fn linked_files(document: &Document, root: usize) -> Read<Vec<String>> {
    let objects = Objects::read_objects(document.element(root))?;
    let files = objects
        .all_objects()
        .filter_map(|o| Some(o.linked_object()?.0.to_owned()));
    let files: BTreeSet<String> = files.filter(|f| !f.is_empty()).collect();
    Ok(files.into_iter().collect())
}

/// Objects of the groups of another, groups within groups and parts of assemblies that move by themselves, too.
fn collect_below<'a>(objects: &Objects<'a>, of: &Object<'a>, out: &mut Vec<Object<'a>>) {
    for name in of.linked_names("Group") {
        let Some(&child) = objects.get(name) else {
            continue;
        };
        if out.iter().any(|o| o.name == child.name) {
            continue;
        }
        out.push(child);
        if child.is_group() || child.kind == "Assembly::JointGroup" {
            collect_below(objects, &child, out);
        }
    }
}

/// Returns the joints of an assembly, in the order of its groups.
fn assembly_joints<'a>(objects: &Objects<'a>, assembly: &Object<'a>) -> Vec<Object<'a>> {
    let mut all = Vec::new();
    collect_below(objects, assembly, &mut all);
    all.retain(|o| {
        o.find_property("JointType").is_some() || o.find_property("ObjectToGround").is_some()
    });
    all
}

/// Returns the chosen assembly: the named one, or else the one with most joints.
fn choose_assembly<'a>(
    root: Element<'a>,
    objects: &Objects<'a>,
    options: &Options,
    robot: &mut Robot,
) -> Read<Object<'a>> {
    let all = (objects.all_objects()).filter(|o| o.kind == "Assembly::AssemblyObject");
    let all: Vec<Object<'a>> = all.copied().collect();
    if let Some(wanted) = &options.assembly {
        let named = |o: &&Object<'a>| o.label() == wanted || o.name == wanted;
        return all.iter().find(named).copied().ok_or_else(|| {
            let (what, known) = (["assembly", "assemblies"], all.iter().map(Object::label));
            let problem = unknown_name("the option `assembly`", what, wanted, known);
            root.error_at(None, problem)
        });
    }
    let count = |o: &&Object<'a>| assembly_joints(objects, o).len();
    // Of assemblies with equally many joints, the first.
    let Some(&most) = all.iter().rev().max_by_key(count) else {
        let message =
            "there is no assembly in the document; make one with FreeCAD's Assembly workbench";
        return Err(root.error_at(None, syntax_problem(message)));
    };
    for other in all.iter().filter(|o| o.name != most.name) {
        let what = format!(
            "another assembly of the document, which is not read; this is assembly \"{}\" (the option `assembly` selects another)",
            most.label()
        );
        robot.report.drop_element(&what, other.label());
    }
    Ok(most)
}

/// The assembly being read.
struct Assembling<'a, 'd> {
    documents: Documents<'a>,
    joints: Vec<Object<'a>>,
    shapes: Shapes<'d>,
}

/// Two ends of a joint, and its place among the joints.
type Ended<'a> = (Object<'a>, &'a str, [Reference<'a>; 2]);

/// The parts of an assembly.
struct Parts<'a> {
    /// Labels and places; the first is the ground.
    parts: Vec<(String, RigidMotion)>,
    /// Index of the part of an object, by the object's name.
    place: BTreeMap<&'a str, usize>,
}

impl<'a> Assembling<'a, '_> {
    fn read_assembly(&self, root: Element<'a>, robot: &mut Robot) -> Read<Assembly> {
        let ended = self.joints_with_ends(robot)?;
        let grounded = self.grounded_parts(&ended, robot);
        let Parts { parts, place } = self.find_parts(&ended, &grounded, root)?;
        let slides = slide_directions(&ended)?;
        let of = |end: &Reference<'_>| end.part.map_or(0, |p| place.get(p).copied().unwrap_or(0));
        let mut connections = Vec::new();
        let mut labels = BTreeSet::new();
        for (joint, word, ends) in &ended {
            let label = joint.label();
            let mut id = label.to_owned();
            if !labels.insert(label) {
                id += &format!(" ({})", joint.name);
            }
            let element = format!("joint \"{id}\"");
            let Some(found) = joint_constraint(word, joint, ends, &slides, self.shapes)? else {
                let what = format!("omitted: its type {word} is not known");
                robot.report.leave_out(&element, UNKNOWN_ROWS, what);
                continue;
            };
            let Held {
                holds,
                frames,
                swap,
                doubt,
            } = found;
            let doubts = ends.iter().filter_map(|e| e.doubt.clone());
            for doubt in doubts.chain(doubt.map(str::to_owned)) {
                robot.report.add_assumption(&element, doubt);
            }
            if LIMITS.split(' ').any(|l| joint.is_true(l) == Some(true)) {
                robot.report.add_approximation(&element, NO_LIMITS);
            }
            let [a, b] = [of(&ends[0]), of(&ends[1])];
            let property = joint.find_property("JointType");
            connections.push(Connection {
                id,
                parts: if swap { [b, a] } else { [a, b] },
                frames,
                holds,
                element: property.map_or(joint.listed.id, |p| p.id),
            });
        }
        Ok(Assembly {
            name: self.documents.assembly.label().to_owned(),
            unit: "mm",
            parts,
            connections,
        })
    }

    /// Returns the parts that joints hold; grounded parts are merged with the ground and name it.
    fn find_parts(
        &self,
        ended: &[Ended<'a>],
        grounded: &BTreeSet<&'a str>,
        root: Element<'_>,
    ) -> Read<Parts<'a>> {
        let mut parts: Vec<(String, RigidMotion)> = vec![(
            self.documents.assembly.label().to_owned(),
            RigidMotion::IDENTITY,
        )];
        let mut place: BTreeMap<&str, usize> = BTreeMap::new();
        let ends = ended.iter().flat_map(|(_, _, ends)| ends);
        for (end, part) in ends.filter_map(|e| Some((e, e.part?))) {
            if place.contains_key(part) {
                continue;
            }
            root.check_room("parts", parts.len())?;
            let label = self.documents.main().get(part).map_or(part, Object::label);
            if grounded.contains(part) {
                if place.values().all(|p| *p != 0) {
                    label.clone_into(&mut parts[0].0);
                }
                place.insert(part, 0);
            } else {
                place.insert(part, parts.len());
                parts.push((label.to_owned(), end.place));
            }
        }
        Ok(Parts { parts, place })
    }

    /// Returns the joints whose two ends are known; the others are reported.
    fn joints_with_ends(&self, robot: &mut Robot) -> Read<Vec<Ended<'a>>> {
        let mut out = Vec::new();
        for joint in &self.joints {
            let Some(word) = joint.enumeration_word("JointType")? else {
                continue;
            };
            let off = joint.is_true("Suppressed") == Some(true)
                || joint.is_true("Activated") == Some(false);
            if off {
                robot.report.drop_element("suppressed joint", joint.label());
                continue;
            }
            let ends = ["Reference1", "Reference2"].map(|which| {
                let found = self.documents.read_reference(joint, which);
                found.map_err(|e| (which, e))
            });
            match ends {
                [Ok(a), Ok(b)] => out.push((*joint, word, [a, b])),
                [Err((_, Invalid(e))), _] | [_, Err((_, Invalid(e)))] => return Err(e),
                [Err((which, Broken(why))), _] | [_, Err((which, Broken(why)))] => {
                    let what = format!("omitted, as in FreeCAD: {which} {why}");
                    let element = format!("joint \"{}\"", joint.label());
                    robot.report.leave_out(&element, UNKNOWN_ROWS, what);
                }
            }
        }
        Ok(out)
    }

    /// Returns the grounded parts, or the first part of the first joint if nothing is grounded.
    fn grounded_parts(&self, ended: &[Ended<'a>], robot: &mut Robot) -> BTreeSet<&'a str> {
        let mut grounded: BTreeSet<&str> = (self.joints.iter())
            .flat_map(|j| j.linked_names("ObjectToGround"))
            .collect();
        let mut ends = ended.iter().flat_map(|(_, _, ends)| ends);
        let still = |e: &Reference<'_>| e.part.is_none_or(|p| grounded.contains(p));
        let first = ended.first().and_then(|(_, _, ends)| ends[0].part);
        if let (false, Some(part)) = (ends.any(still), first) {
            grounded.insert(part);
            let label = self.documents.main().get(part).map_or(part, Object::label);
            let what =
                format!("nothing that joints hold is grounded; {label} is taken as the ground");
            robot.report.moved.push(what);
        }
        grounded
    }
}

/// Returns the directions of sliders, by the parts they join.
fn slide_directions<'a>(ended: &[Ended<'a>]) -> Read<Vec<Slide<'a>>> {
    let mut out = Vec::new();
    for (joint, word, ends) in ended {
        if *word == "Slider" {
            let [frame, _] = joint_frames(joint, ends)?;
            let direction = frame.rotation.map(|row| row[2]);
            out.extend(ends.iter().map(|e| (e.part, direction)));
        }
    }
    Ok(out)
}
