//! Joints of one more freedom in a URDF file: light links and joints put in between the parent
//! of a joint, or the first link of a loop, and the joint.

use crate::robots::description::origin::Origin;
use crate::robots::description::physical::Light;
use crate::robots::edit::{Edits, Freeing};
use crate::robots::mechanism::series_of_single_joints::{comment, escape, numbers};
use crate::robots::warning::Read;
use crate::robots::xml::element::Element;

/// Gives joints freedoms. Inserted joints come before the joint: its child, its name and its followers stay.
pub(crate) fn free(origin: &Origin, all: &[Freeing<'_>], edits: &mut Edits<'_>) -> Read<()> {
    let light = Light::in_description(&origin.document).urdf();
    for &(part, e, freed) in all {
        // A loop's first link has the place of the loop in its own attributes, a joint in an element of its own.
        let (tag, at) = match e.name() {
            "joint" => ("parent", e.child("origin")),
            _ => ("link1", e.child("link1")),
        };
        let Some(end) = e.child(tag) else {
            return Err(e.unsupported("it has no end that can be changed", "choose another joint"));
        };
        let frame = origin.places[part.links[0]].then(&part.sides[0]);
        let mut from = end.required("link")?.to_owned();
        let mut place = at.map_or(String::new(), origin_of);
        let mut lines = Vec::new();
        for (slides, direction, why) in freed {
            let (kind, word, limit) = match slides {
                true => ("prismatic", "slide", LIMIT),
                false => ("continuous", "turn", ""),
            };
            let between = edits.name(&format!("{}_{word}_link", part.id));
            let name = edits.name(&format!("{}_{word}", part.id));
            lines.push(format!("<!-- {why} -->"));
            lines.push(format!(
                "<link name=\"{}\">{light}</link>",
                escape(&between)
            ));
            lines.push(format!(
                "<joint name=\"{}\" type=\"{kind}\"><parent link=\"{}\"/><child link=\"{}\"/>{place}<axis xyz=\"{}\"/>{limit}</joint>",
                escape(&name),
                escape(&from),
                escape(&between),
                numbers(frame.inverse().direction(*direction)),
            ));
            place.clear();
            from = between;
        }
        edits.after(e, &lines);
        edits.set(end, "link", &from)?;
        for (key, zero) in [("xyz", "0 0 0"), ("rpy", "0 0 0"), ("quat_xyzw", "0 0 0 1")] {
            if let Some(at) = at.filter(|at| at.attribute(key).is_some()) {
                edits.set(at, key, zero)?;
            }
        }
    }
    Ok(())
}

/// Limits of sliding joints, which URDF requires.
const LIMIT: &str = "<limit lower=\"-1\" upper=\"1\" effort=\"0\" velocity=\"0\"/>";

/// Returns the placement that an element gives, as the origin of a joint.
fn origin_of(at: Element<'_>) -> String {
    let given = ["xyz", "rpy", "quat_xyzw"].into_iter().filter_map(|key| {
        let value = at.attribute(key)?;
        Some(format!(" {key}=\"{}\"", escape(value)))
    });
    format!("<origin{}/>", given.collect::<String>())
}

/// Makes a `<mimic>` a comment.
pub(crate) fn uncouple(
    origin: &Origin,
    element: usize,
    why: &str,
    edits: &mut Edits<'_>,
) -> Read<()> {
    let e = origin.element(element);
    let raw = comment(edits.raw(e));
    let span = e.node().span.start..crate::robots::edit::end(e);
    edits.replace(e, span, format!("<!-- {why}; it was {raw} -->"));
    Ok(())
}
