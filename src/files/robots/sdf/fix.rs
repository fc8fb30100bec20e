//! Joints of one more freedom in an SDF file: a link and a joint put in between a joint and its child.

use crate::geom::rigid::RigidMotion;
use crate::robots::description::Part;
use crate::robots::description::origin::Origin;
use crate::robots::description::physical::Light;
use crate::robots::edit::{Edits, Freeing};
use crate::robots::mechanism::series_of_single_joints::{escape, numbers};
use crate::robots::sdf::include::is_old;
use crate::robots::warning::Read;
use crate::robots::xml::element::Element;

/// Gives joints freedoms.
pub(crate) fn free(origin: &Origin, all: &[Freeing<'_>], edits: &mut Edits<'_>) -> Read<()> {
    let light = Light::in_description(&origin.document).sdf();
    for &(part, e, freed) in all {
        let remedy = "choose another joint";
        let (Some(child), "joint") = (e.child("child"), e.name()) else {
            return Err(e.unsupported("no link can be inserted there", remedy));
        };
        let mut nodes = origin.document.nodes.iter();
        let model = nodes
            .position(|n| n.children.contains(&e.id))
            .unwrap_or(origin.root);
        let model = origin.element(model);
        let named = |l: &Element<'_>| l.attribute("name") == Some(child.text());
        let Some(link) = model.named("link").find(named) else {
            return Err(e.unsupported("its child is not a link of the same model", remedy));
        };
        let frame = axes_frame(origin, model, part, e)?;
        let pose = |e: Element<'_>| e.child("pose").map_or("", |p| edits.raw(p)).to_owned();
        let (link_pose, joint_pose) = (pose(link), pose(e));
        let mut lines = Vec::new();
        let mut chain = Vec::new();
        for (slides, direction, why) in freed {
            let (kind, word) = if *slides {
                ("prismatic", "slide")
            } else {
                ("revolute", "turn")
            };
            let between = edits.name(&format!("{}_{word}_link", part.id.replace("::", "_")));
            let name = edits.name(&format!("{}_{word}", part.id.replace("::", "_")));
            let axis = numbers(frame.inverse().direction(*direction));
            lines.push(format!("<!-- {why} -->"));
            lines.push(format!(
                "<link name=\"{}\">{link_pose}{light}</link>",
                escape(&between)
            ));
            chain.push((name, kind, between, axis));
        }
        for (i, (name, kind, between, axis)) in chain.iter().enumerate() {
            let next = chain.get(i + 1).map_or(child.text(), |c| &c.2);
            lines.push(format!(
                "<joint name=\"{}\" type=\"{kind}\">{joint_pose}<parent>{}</parent><child>{}</child><axis><xyz>{axis}</xyz><limit><lower>-1e16</lower><upper>1e16</upper></limit></axis></joint>",
                escape(name),
                escape(between),
                escape(next),
            ));
        }
        let inner = child.node().span.end..child.node().close.start;
        edits.replace(child, inner, escape(&chain[0].2));
        edits.after(e, &lines);
    }
    Ok(())
}

/// Returns the frame, in the world, in which axes of a joint's followers are given: of the joint, or of its model before SDF 1.5.
fn axes_frame(
    origin: &Origin,
    model: Element<'_>,
    part: &Part,
    e: Element<'_>,
) -> Read<RigidMotion> {
    // A joint with two axes that are not square is two parts; its child hangs on the last.
    let mut parts = origin.robot.joints.iter().rev();
    let last = parts.find(|p| p.element == Some(e.id)).unwrap_or(part);
    let to = last.links[1];
    if !is_old(origin.element(origin.root)) {
        return Ok(origin.places[to].then(&last.sides[1]));
    }
    let back = origin.robot.places[to].then(&origin.places[to].inverse());
    let pose = model.child("pose").map(|p| p.text_numbers::<6>());
    let [_, _, _, roll, pitch, yaw] = pose.transpose()?.unwrap_or_default();
    let model = RigidMotion::roll_pitch_yaw([0.0; 3], [roll, pitch, yaw]);
    Ok(back.inverse().then(&model))
}
