//! Joints of an assembly of a CAD program changed to another of its types.

use crate::robots::cad::fcstd::DOCUMENT;
use crate::robots::description::origin::Origin;
use crate::robots::edit::Edits;
use crate::robots::import::Imported;
use crate::robots::prelude::*;

/// Sines below this count as zero.
const SAME: f64 = 1e-4;

/// The names, in FreeCAD and in OndselSolver, of a type that a joint can be changed to in its place, without another element or
/// figure.
type SimpleType = (&'static str, &'static str);

const CYLINDRICAL: SimpleType = ("Cylindrical", "CylindricalJoint");

/// The turns and the slides that each of these types leaves.
const SIMPLE: [([Left; 2], SimpleType); 6] = [
    ([Left::None, Left::None], ("Fixed", "FixedJoint")),
    ([Left::Along, Left::None], ("Revolute", "RevoluteJoint")),
    ([Left::None, Left::Along], ("Slider", "TranslationalJoint")),
    ([Left::Along, Left::Along], CYLINDRICAL),
    ([Left::All, Left::None], ("Ball", "SphericalJoint")),
    ([Left::Along, Left::All], ("Parallel", "ParallelAxesJoint")),
];

/// Freedoms, each a slide or a turn and its direction.
type Freedoms = [(bool, Vector)];

/// The turns, or the slides, that a joint allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Left {
    None,
    Along,
    All,
    Other,
}

/// Returns the span of directions in addition to an axis.
fn span_left(all: &[Vector], axis: Vector) -> Left {
    let mut square: Vec<Vector> = Vec::new();
    for d in all {
        let rest = square
            .iter()
            .fold(unit_or_z(*d), |v, s| add_scaled(v, -dot(v, *s), *s));
        if length(rest) > SAME {
            square.push(unit_or_z(rest));
        }
    }
    match square[..] {
        [] => Left::None,
        [d] if length(cross(d, axis)) < SAME => Left::Along,
        [_, _, _] => Left::All,
        _ => Left::Other,
    }
}

impl Origin {
    /// Returns the CAD type of a joint with additional freedoms, each a translation or a rotation and its direction. `None` if
    /// there is no such type.
    #[must_use]
    pub fn cad_type(&self, joint: JointId, more: &[(bool, Vector)]) -> Option<&'static str> {
        simple_type(self, joint, more).map(|(freecad, _)| freecad)
    }

    /// Returns true if a joint can be given a freedom in its place: a translation or rotation, and its direction.
    #[must_use]
    pub fn can_be_freed(&self, joint: JointId, freedom: (bool, Vector)) -> bool {
        if self.is_assembly() {
            simple_type(self, joint, &[freedom]).is_some()
        } else {
            self.takes_joints(joint)
        }
    }
}

/// Returns a joint with additional freedoms, each a translation or a rotation and its direction in the world. `None` if there is
/// no such type.
fn simple_type(origin: &Origin, joint: JointId, more: &Freedoms) -> Option<SimpleType> {
    let part = origin.part_of(joint);
    let frame = origin.places[part.links[0]].then(&part.sides[0]);
    let axis = frame.map_direction(part.axis);
    let own = part.joint_type.freedoms().iter();
    let own = own.filter(|f| **f != Freedom::Screw);
    let own = own.map(|&f| (f.is_slide(), frame.map_direction(part.direction(f))));
    let own: Vec<(bool, Vector)> = own.collect();
    if own.len() < part.joint_type.freedoms().len() {
        return None;
    }
    let whole: Vec<(bool, Vector)> = own.iter().chain(more).copied().collect();
    // A direction that the joint already has, except for rounding, does not change its type.
    let other = |then: &SimpleType| more.is_empty() || type_with(&own, axis) != Some(*then);
    type_with(&whole, axis).filter(other)
}

/// Returns the type with these freedoms, each a translation or a rotation and its direction, about an axis.
fn type_with(freedoms: &Freedoms, axis: Vector) -> Option<SimpleType> {
    let left = |slides: bool| {
        let all = freedoms.iter().filter(|(s, _)| *s == slides);
        let all: Vec<Vector> = all.map(|(_, d)| *d).collect();
        span_left(&all, axis)
    };
    let all = [left(false), left(true)];
    let found = SIMPLE.iter().find(|(left, _)| *left == all);
    found.map(|(_, names)| *names)
}

/// Returns the file with the types of joints that get freedoms. `uncoupled` is the element of a coupling that would have to be removed.
///
/// # Errors
/// Returns an error if there is no such type, or if a coupling would have to be removed.
pub(crate) fn retype_joints(
    imported: &Imported,
    freed: &BTreeMap<JointId, Vec<(bool, Vector, String)>>,
    uncoupled: Option<usize>,
) -> Read<Vec<u8>> {
    let origin = &imported.origin;
    if let Some(element) = uncoupled {
        let why = "it couples joints, so its type cannot be changed";
        let remedy = "suppress the joint in the CAD program, or choose another joint";
        return Err(origin.element(element).unsupported_error(why, remedy));
    }
    let mut edits = Edits::new(origin);
    for (&joint, more) in freed {
        let part = origin.part_of(joint);
        let Some(element) = part.element.map(|e| origin.element(e)) else {
            continue;
        };
        let more = more
            .iter()
            .map(|(slides, direction, _)| (*slides, *direction));
        let Some((freecad, ondsel)) = simple_type(origin, joint, &more.collect_vec()) else {
            let format = imported.format.name;
            let why = format!("{format} has no joint type with the required freedoms");
            return Err(retype_error(part, element, why));
        };
        match imported.format.word {
            "asmt" => edits.replace_span(element, element.node().span.clone(), ondsel.to_owned()),
            _ => set_enumeration(part, element, freecad, &mut edits)?,
        }
    }
    let text = edits.apply_edits()?;
    match &origin.archive {
        Some(archive) => archive.with_member(DOCUMENT, text.as_bytes()),
        None => Ok(text.into_bytes()),
    }
}

fn retype_error(part: &Part, element: Element<'_>, why: String) -> ImportError {
    let joint = format!("joint \"{}\"", part.id);
    let problem = unsupported_problem(&joint, &why, "choose another joint");
    element.error_at(None, problem)
}

/// Returns the index of a type in the list next to it, as FreeCAD writes it.
fn set_enumeration(part: &Part, e: Element<'_>, word: &str, edits: &mut Edits<'_>) -> Read<()> {
    let list = e.first_child("CustomEnumList");
    let mut words = list.iter().flat_map(|l| l.children_named("Enum"));
    let place = words.position(|w| w.attribute("value") == Some(word));
    let (Some(integer), Some(place)) = (e.first_child("Integer"), place) else {
        let why = format!("this version of FreeCAD has no joint type {word}");
        return Err(retype_error(part, e, why));
    };
    edits.set_attribute(integer, "value", &place.to_string())?;
    // FreeCAD then solves the assembly again when it opens the file.
    let root = edits.origin.element(edits.origin.root);
    let has = |o: &Element<'_>| {
        let all = o.first_child("Properties");
        all.is_some_and(|p| p.children().any(|c| c.id == e.id))
    };
    let data = root.first_child("ObjectData");
    let name = data.and_then(|d| d.children_named("Object").find(has)?.attribute("name"));
    let listed = root.first_child("Objects");
    let listed = listed.and_then(|l| {
        l.children_named("Object")
            .find(|o| o.attribute("name") == name)
    });
    if let Some(object) = listed.filter(|o| o.attribute("Touched") != Some("1")) {
        edits.set_attribute(object, "Touched", "1")?;
    }
    Ok(())
}
